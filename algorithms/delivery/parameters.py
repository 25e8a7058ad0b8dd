"""Parameters of deliveries; for some that the user leaves empty, the delivery has values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Collection, Iterable, Mapping, TypeVar

from ..classes.ground_classes import GroundClasses
from ..classes.selection import Selection
from ..core.parameters import Declaration, ParameterSet, parameter, parameter_of
from ..engine.memory import Resources
from ..engine.options import TileInput, TileOutput
from ..filters import DEFAULT_METHOD, METHODS
from ..tools.declaration import FileTool, MapTool, Tool
from ..tools.ground.method import TileMethod
from ..tools.quality.specifications import SPECIFICATIONS
from ..tools.rasters.parameters import MapTerrain
from ..tools.water.finding import Water
from .deliveries import DELIVERIES

GivenSet = TypeVar("GivenSet", bound=ParameterSet)
_METHODS = tuple(method.parameters for method in METHODS.values())
NO_DELIVERY = "own"  # outputs that the user chooses
AS_DELIVERY = "as-delivery"  # the specification that a delivery has


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
    """Options of a delivery: its specification, key points, and points to hold out."""

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
    """The terrain model of a delivery, whose cell size can be empty."""

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
        """Return the parameters of maps, with this cell size in metres if the user gave none."""
        values = dict(vars(self))
        if self.dtm_cell_size is None:
            values |= {"dtm_cell_size": size, "dtm_cell_unit": "m"}
        return MapTerrain(**values)


@dataclass(frozen=True)
class DeliveryWater(Water):
    """The water of a delivery, whose limits can be empty."""

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


class Settings:
    """The parameters of a delivery: the values that the user gave, even if they equal the defaults,
    or else those of the delivery.
    """

    def __init__(
        self,
        sets: Iterable[ParameterSet],
        values: Mapping[str, object],
        named: Collection[str] = (),
    ) -> None:
        self.values = dict(values)  # of parameters that the user did not give, by name
        self.named = frozenset(named)  # given by the user
        of_user = [
            values.parameters if isinstance(values, TileMethod) else values for values in sets
        ]
        self._count = len(of_user)
        self.sets: list[ParameterSet] = [*of_user, METHODS[DEFAULT_METHOD].parameters()]
        self.sets.append(GroundClasses.of_selection(self.set_of(Selection)))

    def sets_of(self, tool: Tool) -> list[ParameterSet]:
        """Return the parameters of a tool."""
        kinds = tool.sets
        if isinstance(tool, MapTool) and tool.classifies:
            kinds = type(self.method), *kinds
        if not isinstance(tool, (FileTool, MapTool)):
            kinds = *kinds, TileInput, TileOutput, Resources
        return [self.set_of(kind) for kind in kinds]

    def set_of(self, kind: type[GivenSet]) -> GivenSet:
        """Return parameters, with the values of the delivery where the user gave none."""
        values: dict[str, object] = {}
        given = self.given(kind)
        asked = self.asked() if any(isinstance(known, kind) for known in self.sets) else {}
        for declared in given.declarations():
            value, name = getattr(given, declared.name), declared.name
            if value == declared.default and name not in asked:
                value = self.values.get(name, value)
                if declared.choices and value not in declared.choices:
                    value = declared.default
            # A value that neither the user nor the delivery gives has the default of the tool.
            if value is not None or declared.default is not None:
                values[name] = value
        return kind(**values)

    def given(self, kind: type[GivenSet]) -> GivenSet:
        """Return parameters as the user gave them."""
        return next((known for known in self.sets if isinstance(known, kind)), kind())

    def asked(self) -> dict[str, object]:
        """Return the values that the user gave, by name."""
        asked: dict[str, object] = {}
        for values, declared in self._of_user():
            value = getattr(values, declared.name)
            # QGIS chooses the format of the points.
            is_changed = value != declared.default and not isinstance(values, TileOutput)
            if is_changed or declared.name in self.named:
                asked[declared.name] = value
        return asked

    def chosen(self) -> dict[str, object]:
        """Return the values of the delivery that replace defaults, by name."""
        asked, chosen = self.asked(), dict[str, object]()
        for _, declared in self._of_user():
            value = self.values.get(declared.name, declared.default)
            is_possible = not declared.choices or value in declared.choices
            if declared.name not in asked and value != declared.default and is_possible:
                chosen[declared.name] = value
        return chosen

    def _of_user(self) -> list[tuple[ParameterSet, Declaration]]:
        """Return the parameters that a user can give, with their sets."""
        sets = self.sets[: self._count]
        return [(values, declared) for values in sets for declared in values.declarations()]

    @property
    def method(self) -> ParameterSet:
        """The parameters of the ground filter, without values of the delivery."""
        return next(values for values in self.sets if isinstance(values, _METHODS))
