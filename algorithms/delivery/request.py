"""The request for a delivery, and the requests for the steps that follow from it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Mapping, TypeVar

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet, parameter, parameter_of
from ..engine.options import TileInput
from ..filters import DEFAULT_METHOD, METHODS
from ..rasters.cell_grid import ANYWHERE, RasterTarget
from ..runs.requests import ClassifyRequest, PointRequest, Request
from ..survey.area import Area
from ..survey.corrections import NO_CORRECTIONS, Corrections
from ..survey.ground_classes import GroundClasses
from ..survey.selection import Selection
from ..tools import point_tool
from ..tools.above_ground.classes import ThenAboveGround
from ..tools.check.accuracy import Accuracy
from ..tools.check.checkpoints import Checkpoints
from ..tools.contours import Contours
from ..tools.ground.output import Output
from ..tools.quality import QualityOptions
from ..tools.quality.specifications import SPECIFICATIONS
from ..tools.rasters.constraints import NO_CONSTRAINTS, Constraints
from ..tools.rasters.parameters import MapTerrain, SurfaceModel
from ..tools.water.finding import Water
from .deliveries import DEFAULT_DELIVERY, DELIVERIES, STATED, Delivery

_Set = TypeVar("_Set", bound=ParameterSet)
# No delivery but outputs that the user chooses, and the specification that a delivery has.
NO_DELIVERY, AS_DELIVERY = "own", "as-delivery"
_BRIDGE_CLASS = 17
# Values of the tools that change classified points, in all deliveries.
_VALUES = {"mark_as": "flag"}


@dataclass(frozen=True)
class DeliveryChoice(ParameterSet):
    """Which delivery is made, if any."""

    # Optional, since it is newer than saved models of the step from a point cloud to maps.
    delivery: str | None = parameter(
        NO_DELIVERY,
        label="Delivery",
        optional=True,
        choices={
            NO_DELIVERY: "Own choice of outputs",
            **{name: delivery.label for name, delivery in DELIVERIES.items()},
        },
        help="All outputs that a job hands over, in one folder, with a page that lists them. Only"
        " with your own choice of outputs are the fields of single outputs used.",
    )


@dataclass(frozen=True)
class DeliveryOptions(ParameterSet):
    """What a delivery contains beside its outputs, and with what it is compared."""

    specification: str = parameter(
        AS_DELIVERY,
        label="Specification",
        choices={
            AS_DELIVERY: "The usual one of the delivery",
            **{name: asked.label for name, asked in SPECIFICATIONS.items()},
        },
        advanced=True,
        help="The specification with which a delivery is compared. It also sets the cell size of"
        " the delivery for surveys, and the classes that it asks for.",
    )
    key_points: bool = parameter(
        False,
        label="Mark model key points",
        advanced=True,
        help="Marks the ground points of a delivery that a terrain model needs, by the key-point"
        " flag of LAS.",
    )
    hold_out_share: float | None = parameter(
        0.02,
        kind="number",
        label="Share of ground points to hold out",
        minimum=0.0001,
        maximum=0.5,
        optional=True,
        advanced=True,
        help="Leaves out so large a share of the ground points of a delivery, and states how well"
        " the others predict them. Empty: this is not measured.",
    )


@dataclass(frozen=True)
class DeliveryTerrain(MapTerrain):
    """The same as for maps, with a cell size that can be left open."""

    dtm_cell_size: float | None = parameter_of(  # type: ignore[assignment]
        MapTerrain,
        "dtm_cell_size",
        label="Cell size",
        default=None,
        optional=True,
        empty="by the density of the ground points",
        help="Side of a cell of the terrain model and of its hillshade. Empty: 1 m, and for a"
        " delivery as fine as the ground points allow, or as the specification states.",
    )

    def with_cells(self, size: float) -> MapTerrain:
        """Return the parameters of maps, with a cell size in metres if it is left open."""
        values = dict(vars(self))
        if self.dtm_cell_size is None:
            values |= {"dtm_cell_size": size, "dtm_cell_unit": "m"}
        return MapTerrain(**values)


@dataclass(frozen=True)
class DeliveryWater(Water):
    """The same as for water, with sizes that can be left open."""

    min_area: float | None = parameter_of(  # type: ignore[assignment]
        Water,
        "min_area",
        label="Smallest water",
        default=None,
        optional=True,
        advanced=True,
        empty="as the delivery",
        help="A delivery leaves out smaller water. Empty: 8,000 m² for a survey, 1,000 m² for a"
        " flood model.",
    )
    min_width: float | None = parameter_of(  # type: ignore[assignment]
        Water,
        "min_width",
        default=None,
        optional=True,
        advanced=True,
        empty="as the delivery",
        help="A delivery leaves out rivers that are narrower on average. Empty: 30 m for a survey,"
        " 5 m for a flood model.",
    )
    water_cell: float | None = parameter_of(Water, "water_cell", label="Cell size of the water")


@dataclass(frozen=True)
class DeliveryRequest(Request):
    """A request for a delivery."""

    # "survey", "archaeology", "forestry", "flood" or "drone-site"; see `DELIVERIES`
    delivery: str = DEFAULT_DELIVERY
    # Specification, key points, and points to hold out
    options: DeliveryOptions = field(default_factory=DeliveryOptions)
    # The parameters of one method. Those that are left to the preset get the values of the
    # delivery.
    parameters: ParameterSet = field(default_factory=METHODS[DEFAULT_METHOD].parameters)
    # Which points take part. Noise and bridges get their classes in any case.
    selection: Selection = field(default_factory=Selection)
    # Cell size, light and so on of the rasters. Defaults get the values of the delivery.
    terrain: DeliveryTerrain = field(default_factory=DeliveryTerrain)
    surface: SurfaceModel = field(default_factory=SurfaceModel)
    contours: Contours = field(default_factory=Contours)  # how contour lines are drawn
    # Which water is found. Sizes that are None are those of the delivery.
    water: DeliveryWater = field(default_factory=DeliveryWater)
    # What the errors at checkpoints are compared with
    accuracy: Accuracy = field(default_factory=Accuracy)
    checkpoints: Checkpoints | None = None  # points that were surveyed on the ground
    area: Area | None = None  # what is delivered; None for everything
    corrections: Corrections = NO_CORRECTIONS  # polygons in which the class is known
    # Breaklines, water, and areas without ground. If they have water, none is looked for.
    constraints: Constraints = NO_CONSTRAINTS
    raster_target: RasterTarget = ANYWHERE  # A raster whose grid the rasters get, and their extent

    def __post_init__(self) -> None:
        if self.delivery not in DELIVERIES:
            raise BareEarthError(
                f"There is no delivery '{self.delivery}'. Choose one of {', '.join(DELIVERIES)}."
            )

    @property
    def content(self) -> Delivery:
        """What the delivery contains."""
        return DELIVERIES[self.delivery]

    @property
    def specification(self) -> str:
        """The name of the specification with which the survey is compared."""
        given = self.options.specification
        return self.content.specification if given == AS_DELIVERY else given

    @property
    def above_ground(self) -> ThenAboveGround:
        """Whether the points above the ground get classes, and which."""
        if not self.content.needs_classes(self.specification):
            return ThenAboveGround()
        return ThenAboveGround(above_ground=STATED[self.specification].get("above_ground", "asprs"))

    @property
    def ground(self) -> GroundClasses:
        """Which points of the classified files are ground."""
        return self.classify.ground

    @property
    def quality(self) -> QualityOptions:
        """How the quality is measured."""
        return QualityOptions(specification=self.specification)

    @property
    def classify(self) -> ClassifyRequest:
        """The request to classify the points, and to add their heights if they are wanted."""
        return ClassifyRequest(
            files=self.files,
            tiles=self.tiles,
            resources=self.resources,
            crs=self.crs,
            parameters=self._method(),
            selection=replace(
                self.selection,
                low_noise_class=True,
                high_noise_class=True,
                bridge_class=self.selection.bridge_class or _BRIDGE_CLASS,
            ),
            area=self.area,
            corrections=self.corrections,
            above_ground=self.above_ground,
            output=Output(
                area_only=self.area is not None, height_above_ground=self.content.heights
            ),
        )

    def _method(self) -> ParameterSet:
        """Return the parameters of the method, with values of the delivery for those left open."""
        content, given = self.content, self.parameters
        presets = {declared.name: declared.choices for declared in given.declarations()}["preset"]
        preset = {"preset": content.preset} if content.preset in presets else {}
        return _or_else(given, {**preset, **content.values})

    def terrain_with(self, cell_size: float) -> MapTerrain:
        """Return the parameters of the rasters, with a cell size in metres if none is given."""
        return _or_else(self.terrain, self.content.terrain).with_cells(cell_size)

    @property
    def water_wanted(self) -> Water | None:
        """Which water is found; None if none is looked for, as the user gives it."""
        values = self.content.water
        if values is None or self.constraints.water:
            return None
        given = {name: value for name, value in vars(self.water).items() if value is not None}
        return Water(**{**values, **given})

    def sets_of(self, command: str) -> list[ParameterSet]:
        """Return the parameters of a tool that changes the classified points, given its command."""
        values = {**_VALUES, **STATED[self.specification]}
        return [
            self.ground if declared is GroundClasses else _or_else(declared(), values)
            for declared in point_tool(command).sets
        ]

    def to_change(self, command: str, inputs: Mapping[str, Any]) -> PointRequest:
        """Return the request for such a tool and its further inputs."""
        options = TileInput(), self.tiles, self.resources
        return PointRequest.of(
            point_tool(command), [*self.sets_of(command), *options], inputs, self.crs
        )

    @property
    def surface_model(self) -> SurfaceModel:
        """The parameters of the surface and canopy models."""
        return _or_else(self.surface, self.content.surface)


def _or_else(given: _Set, values: Any) -> _Set:
    """Return parameters in which defaults are replaced by those of the values that they have."""
    missing = {
        declared.name: values[declared.name]
        for declared in given.declarations()
        if declared.name in values and getattr(given, declared.name) == declared.default
    }
    return replace(given, **missing)
