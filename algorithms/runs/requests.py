"""Requests: what a run is to do, as one value. Command line, dialogs and library fill it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Iterable, Mapping, TypeVar

from ..core.errors import BareEarthError
from ..core.parameters import HasSets, ParameterSet
from ..engine.options import RunOptions
from ..engine.step import PointStep
from ..filters import DEFAULT_METHOD, METHODS
from ..rasters.cell_grid import ANYWHERE, RasterTarget
from ..survey.area import Area
from ..survey.corrections import NO_CORRECTIONS, Corrections
from ..survey.ground_classes import GroundClasses
from ..survey.selection import Selection
from ..tools.above_ground import ClassifyAboveGround
from ..tools.above_ground.classes import ThenAboveGround
from ..tools.contours import Contours
from ..tools.declaration import MapTool, PointTool
from ..tools.ground.method import TileMethod
from ..tools.ground.output import Output
from ..tools.ground.step import LabelGround
from ..tools.heights import MeasureHeights
from ..tools.rasters.constraints import NO_CONSTRAINTS, Constraints
from ..tools.rasters.parameters import Gaps, RasterOutput, SurfaceModel, TerrainModel
from ..tools.rasters.rows import RASTERS, RasterFiles
from ..tools.rasters.step import MakeRasters

_Request = TypeVar("_Request", bound="Request")


@dataclass(frozen=True)
class Request(RunOptions, HasSets):
    """Base of the requests that have a field for each parameter set."""

    @classmethod
    def of(cls: type[_Request], sets: Iterable[ParameterSet], **fields: Any) -> _Request:
        """Return a request with parameter sets in any order, also a method and its preset."""
        return super().of(map(_as_kept, sets), **fields)


def _as_kept(some: ParameterSet) -> ParameterSet:
    """Return a parameter set of a command in the form that requests keep."""
    if isinstance(some, TileMethod):
        return some.parameters
    return SurfaceModel(max_edge=some.max_edge) if isinstance(some, Gaps) else some


@dataclass(frozen=True)
class RasterRequest(Request):
    """Base of the requests that make rasters."""

    rasters: RasterFiles = field(default_factory=RasterFiles)
    terrain: TerrainModel = field(default_factory=TerrainModel)
    surface: SurfaceModel = field(default_factory=SurfaceModel)
    constraints: Constraints = NO_CONSTRAINTS  # breaklines, water, and areas without ground
    # whether each of many files gets its own rasters
    raster_output: RasterOutput = field(default_factory=RasterOutput)
    raster_target: RasterTarget = ANYWHERE  # a raster whose grid they get, and their extent
    area: Area | None = None  # where rasters have values, and points are classified
    contours: Contours = field(default_factory=Contours)
    contour_lines: Path | None = None  # the file of contour lines to write

    def rasters_of(self, ground: GroundClasses, roads: tuple[int, ...]) -> MakeRasters:
        """Return the step that makes them, given which points are ground; see `MakeRasters`."""
        return MakeRasters(
            self.rasters, self.terrain, self.surface, ground=ground, roads=roads,
            constraints=self.constraints, per_file=self.raster_output.raster_per_file,
            target=self.raster_target, area=self.area,
        )  # fmt: skip


@dataclass(frozen=True)
class _OfStep:
    """What a `PointRequest` has before the options of the run."""

    step: PointStep


@dataclass(frozen=True)
class PointRequest(RunOptions, _OfStep):
    """A request to write classified files with what a step finds for each point."""

    @classmethod
    def of(
        cls,
        tool: PointTool,
        sets: Iterable[ParameterSet] = (),
        inputs: Mapping[str, Any] = {},
        crs: str | None = None,
    ) -> PointRequest:
        """Return a request for a tool."""
        of_step = {type(value): name for name, value in vars(tool.step()).items()}
        of_run = {type(value): name for name, value in vars(RunOptions()).items()}
        fields: dict[str, Any] = dict(inputs)
        options: dict[str, Any] = {}
        for values in sets:
            if type(values) in of_run:
                options[of_run[type(values)]] = values
            else:
                fields[of_step[type(values)]] = values
        return cls(tool.step(**fields), crs=crs, **options)


@dataclass(frozen=True)
class ClassifyRequest(RasterRequest):
    """A request to classify the ground, and to make products of it."""

    # The parameters of one method. Their type chooses the method.
    parameters: ParameterSet = field(default_factory=METHODS[DEFAULT_METHOD].parameters)
    # Which points take part, and what their classes become
    selection: Selection = field(default_factory=Selection)
    corrections: Corrections = NO_CORRECTIONS  # polygons in which the class is known
    # Which points are written, and whether their heights above ground are
    output: Output = field(default_factory=Output)
    # Whether the points above the ground are classified too
    above_ground: ThenAboveGround = field(default_factory=ThenAboveGround)
    explain: Path | None = None  # raster of the rule that decided each cell, for one file

    def __post_init__(self) -> None:
        self.output.check_area(self.area is not None)
        if self.above_ground.wanted and self.output.ground_only:
            raise BareEarthError(
                "Classes above the ground need all points. Write all points, not only the ground."
            )
        if self.constraints.any and not (self.rasters.wanted or self.contour_lines):
            raise BareEarthError(
                "Breaklines, water, rivers and places without ground only change rasters. Choose a"
                " raster to make, such as the terrain model."
            )

    @property
    def step(self) -> LabelGround:
        """The step that finds the ground."""
        return LabelGround(
            self.parameters,
            self.selection,
            self.area,
            self.output,
            corrections=self.corrections,
            explain=self.explain,
        )

    @property
    def steps(self) -> list[PointStep]:
        """The steps for points."""
        steps: list[PointStep] = [self.step]
        if self.above_ground.wanted:
            steps.append(self.above_ground_step)
        if self.output.height_above_ground:
            steps.append(self.height_step)
        return steps

    @property
    def ground(self) -> GroundClasses:
        """Which points of the output are ground."""
        return GroundClasses.of_selection(self.selection)

    @property
    def raster_step(self) -> MakeRasters:
        """The step that makes the rasters from the classified points."""
        step = self.rasters_of(self.ground, self.selection.roads)
        return replace(step, covers_ground=self.output.ground_only and not step.needs_all)

    @property
    def above_ground_step(self) -> ClassifyAboveGround:
        """The step that classifies the points above the ground."""
        return ClassifyAboveGround(self.above_ground, self.ground, self.area, self.corrections)

    @property
    def height_step(self) -> MeasureHeights:
        """The step that measures the heights of the classified points."""
        area = self.area if self.output.area_only else None
        return MeasureHeights(self.ground, area=area, roads=self.selection.roads)


@dataclass(frozen=True)
class TerrainRequest(RasterRequest):
    """A request to make rasters of the terrain and of the objects on it."""

    ground: GroundClasses = field(default_factory=GroundClasses)  # which points are ground
    roads: tuple[int, ...] = ()  # classes whose points are ground as well, where they lie on it

    @property
    def raster_step(self) -> MakeRasters:
        """The step that makes the rasters."""
        return self.rasters_of(self.ground, self.roads)


def map_request(
    tool: MapTool,
    sets: Iterable[ParameterSet],
    outputs: Mapping[str, Path | None],
    **fields: Any,
) -> ClassifyRequest | TerrainRequest:
    """Return a request for a tool, given its sets, the outputs by their names, and its inputs."""
    fields["rasters"] = RasterFiles(**{name: outputs.get(name) for name in RASTERS})
    fields["contour_lines"] = outputs.get("contours")
    if not tool.classifies:
        return TerrainRequest.of(sets, **fields)
    return ClassifyRequest.of(sets, explain=outputs.get("explain"), **fields)
