"""Height above ground: a height of each point, as an extra dimension or in place of z."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Sequence

import numpy as np

from ..classes.ground_classes import ROADS_FLAG, GroundClasses, GroundCounts
from ..classes.without_ground import WithoutGround
from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet, parameter
from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..crs.system import unit_name
from ..engine.blocks import Blocks, Visit
from ..engine.memory import Cost
from ..engine.step import MORE, Allocate, PointResult, PointStep
from ..engine.store import OTHERS, BlockPoints, Marks
from ..engine.summary import TileSummary
from ..las.cloud import PointCloud
from ..las.crs_records import read_crs
from ..las.edits import Edits
from ..las.extrabytes import ExtraDimension
from ..las.lasfile import LasFile
from ..rasters.sampling import FAR_ABOVE, HeightRaster, HeightSampler
from ..survey.area import Area
from ..tin.height_above_ground import GroundSurface, with_roads
from .declaration import CANOPY, CLOUD, TIN, Input, PointTool

HEIGHT_DIMENSION = "HeightAboveGround"
# The buffer of a block in metres, and the memory that it takes.
_BLOCKS = Blocks.of(100.0, Cost(150.0, 50.0))
_INTEGERS = np.iinfo(np.int32)


@dataclass(frozen=True)
class HeightOutput(ParameterSet):
    """Where the heights above ground go."""

    output_as: str = parameter(
        "dimension",
        label="Write the heights as",
        choices={
            "dimension": f"Extra dimension {HEIGHT_DIMENSION}",
            "z": "Z, in place of the elevation",
        },
        help="An extra dimension leaves everything else as it is. If the height replaces z,"
        " programs that cannot show extra dimensions show it too, but the terrain is flat.",
    )


@dataclass(frozen=True, order=True)
class HeightSummary(TileSummary):
    """The heights above ground of a file, in the vertical unit of the CRS."""

    name: str  # of the output
    point_count: int
    ground_count: int
    minimum: float  # height
    maximum: float  # height
    unit: str  # name of the unit
    unit_size: float = 1.0  # metres in it
    class_counts: dict[int, int] = field(default_factory=dict)  # in the output

    @property
    def without_ground(self) -> WithoutGround:
        """The warning about one of many files without ground."""
        fate = "measured above the ground of other files"
        if math.isnan(self.minimum):
            fate = "written without a height"
        return WithoutGround(self.name, self.point_count, fate)

    @property
    def text(self) -> str:
        """The summary as a sentence."""
        extremes = f"{self.minimum:.2f} to {self.maximum:.2f} {self.unit}"
        return f"{self.name}: heights above ground are {extremes}"


@dataclass(frozen=True)
class MeasureHeights(PointStep):
    """Measures the height of each point above the ground."""

    ground: GroundClasses = field(default_factory=GroundClasses)  # which points are ground
    # Whether the heights are an extra dimension or replace z; both in the vertical unit
    output: HeightOutput = field(default_factory=HeightOutput)
    area: Area | None = None  # where heights are wanted; None for everywhere
    roads: tuple[int, ...] = ()  # classes that are ground as well, where they lie on it
    # Heights are measured above this raster, and the points need no ground
    dtm: HeightRaster | None = None

    counts = GroundCounts
    kind = np.float64
    imports = ("scipy.spatial",)
    blocks = _BLOCKS
    changes = frozenset({MORE})
    summary_type = HeightSummary

    def marks(self, part: PointCloud, counts: GroundCounts) -> Marks:
        """Return all points, which of them are ground, and which lie in the area."""
        every = np.ones(part.count, dtype=bool)
        if self.dtm is not None:  # no point needs others
            part.require_projected()
            self.dtm.check(part.crs, part.path)
            return Marks(~every, ~every, ~every)
        inside = every if self.area is None else self.area.of(part)
        roads = self.ground.roads_of(part, self.roads)
        return Marks(every, self.ground.of(part, counts), inside, {ROADS_FLAG: roads})

    def report_counts(self, counts: GroundCounts, path: Path, progress: Progress) -> None:
        """Refuse a file without ground."""
        if self.dtm is None:
            self.ground.check(counts, path)

    def report_survey(
        self, done: Sequence[HeightSummary], empty: Sequence[LasFile], progress: Progress
    ) -> None:
        """Warn of files without ground; refuse them if no file has any."""
        if self.dtm is not None:
            if done and all(math.isnan(summary.minimum) for summary in done):
                raise self.dtm.covers_nothing("the files")
        else:
            files = [(summary.ground_count, summary.without_ground) for summary in done]
            self.ground.report_survey(files, progress)

    def check_file(self, file: LasFile) -> None:
        """Refuse a file in another CRS than the raster."""
        if self.dtm is not None:
            self.dtm.check(read_crs(file), file.path)

    def in_block(self, visit: Visit, progress: Progress) -> tuple[np.ndarray, np.ndarray]:
        """Return the positions of the wanted points of a block above the ground, and their heights
        in metres, NaN without ground; only the ground is in memory as a whole.
        """
        ground = visit.contents(progress.part(0.0, 0.1), ROADS_FLAG)
        if ground.flags[ROADS_FLAG].any():
            part, on_roads = progress.part(0.1, 0.15), ground.flags[ROADS_FLAG]
            ground = ground.take(with_roads(ground.points, ground.known, on_roads, part))
        roads = np.sort(ground.positions[ground.flags[ROADS_FLAG]])

        def wanted(piece: BlockPoints) -> tuple[np.ndarray, Points]:
            inner = visit.core(piece)
            if len(roads):
                inner &= ~np.isin(piece.positions, roads)
            return piece.positions[inner], piece.points.take(inner)

        leaves, part = visit.store.leaves.within(visit.block.box), progress.part(0.15, 0.3)
        found = visit.store.over_pieces(leaves, wanted, visit.corner, part, OTHERS)
        positions = np.concatenate([ground.positions[:0], *(positions for positions, _ in found)])
        if not len(positions) or not ground.points.count:
            return positions, np.full(len(positions), np.nan)
        surface = GroundSurface(ground.points, progress.part(0.3, 0.45))
        visit.findings[self.ground, self.roads] = surface.thinned
        points = Points(*map(np.concatenate, zip(*(points for _, points in found))))
        return positions, surface.heights_above(points, progress.part(0.45, 1.0))

    def result(self, path: Path, allocate: Allocate) -> HeightsOfPoints:
        return HeightsOfPoints(self, path, allocate)


class HeightsOfPoints(PointResult):
    """The heights above ground of a file; `allocate` returns an array, one value a point."""

    def __init__(self, step: MeasureHeights, path: Path, allocate: Allocate) -> None:
        super().__init__(step)
        self._path = path
        self._as_z = step.output.output_as == "z"
        # Single precision is enough for a dimension. Heights that replace z are rounded as z is.
        # float, (n,): vertical unit of the CRS; NaN far from ground
        self.heights = allocate(np.float64 if self._as_z else np.float32)
        self._lowest, self._highest = np.inf, -np.inf
        self._ground_count, self._unit, self._unknown_count = 0, 1.0, 0
        self._sampler = None if step.dtm is None else HeightSampler(step.dtm)

    def add(self, where: slice, before: PointCloud, values: np.ndarray) -> tuple[PointCloud, None]:
        """Convert heights from metres to the vertical unit, without noise from rounding."""
        unit = before.crs.vertical_unit
        if self._sampler is not None:
            values = _above_raster(before, self._sampler)
        # So that ground points have 0, not -0.
        heights = np.round(values / unit, 6) + 0.0
        self.heights[where] = heights
        ground = self._step.ground.points_of(before, self._step.ground.ground_classes)
        self._ground_count += int(np.count_nonzero(ground))
        self._unit = unit
        self._unknown_count += int(np.count_nonzero(np.isnan(heights)))
        self._lowest = min(self._lowest, float(np.fmin.reduce(heights, initial=np.inf)))
        self._highest = max(self._highest, float(np.fmax.reduce(heights, initial=-np.inf)))
        return before, None

    def report(self, progress: Progress, failure: str | None = None) -> None:
        """Refuse a raster that has no value at any point of the only file."""
        dtm, is_alone = self._step.dtm, failure is None
        if dtm is not None and is_alone and self._unknown_count == len(self.heights):
            raise dtm.covers_nothing(str(self._path))

    def edits(self, cloud: PointCloud, progress: Progress = SILENT) -> Edits:
        """Return the heights as z or as a dimension, or refuse heights that do not fit into z."""
        dtm = self._step.dtm
        if dtm is not None:
            dtm.report(cloud.crs, progress)
            if self._unknown_count and self._as_z:
                raise self._no_z(dtm)
            dtm.report_heights(self.heights, self._unit, FAR_ABOVE, progress)
        if self._unknown_count and not self._as_z:
            why = "no ground is near" if dtm is None else "the raster has no value there"
            words = f"{self._unknown_count:,} of {len(self.heights):,} points"
            progress.warning(f"{words} have no height (NaN): {why}.")
        if self._as_z:
            z, offset = _z_of(cloud, self.heights)
            return Edits(z=z, z_offset=offset)
        return Edits(extra=height_dimension(cloud, self.heights))

    def _no_z(self, raster: HeightRaster) -> BareEarthError:
        """Return the error for points that cannot get a height as z."""
        return BareEarthError(
            f"{raster.path} has no value at {self._unknown_count:,} of the {len(self.heights):,}"
            f" points of {self._path}, so that these have no height. Write the heights as an extra"
            " dimension."
        )

    def summary(self, name: str, class_counts: dict[int, int]) -> HeightSummary:
        extremes = self._lowest, self._highest
        if self._lowest > self._highest:
            extremes = np.nan, np.nan
        unit = unit_name(self._unit), self._unit
        count = len(self.heights)
        return HeightSummary(name, count, self._ground_count, *extremes, *unit, class_counts)


def height_dimension(cloud: PointCloud, heights: np.ndarray) -> ExtraDimension:
    """Return heights above ground as an extra dimension."""
    unit = unit_name(cloud.crs.vertical_unit)
    return ExtraDimension(
        HEIGHT_DIMENSION, f"Above ground, {unit}", heights.astype(np.float32, copy=False)
    )


def _above_raster(part: PointCloud, raster: HeightSampler) -> np.ndarray:
    """Return heights of points above a raster in metres; NaN where it has no value."""
    z, unit = part.z * part.scale[2] + part.offset[2], part.crs.vertical_unit
    return z * unit - raster.heights(*part.coordinates()) * (raster.unit or unit)


def _z_of(cloud: PointCloud, heights: np.ndarray) -> tuple[np.ndarray, float]:
    """Return heights as integers in the scale of the file, and its offset, or else their own."""
    # That offset suits elevations: with a fine scale, heights far from it would need larger
    # integers.
    if np.isnan(heights).any():
        raise BareEarthError(
            f"Some points of {cloud.path} are kilometres from any ground, so that they have no"
            " height above ground. Write the heights as an extra dimension."
        )
    scale, (lowest, highest) = cloud.scale[2], (float(heights.min()), float(heights.max()))
    for offset in (cloud.offset[2], 0.0, float(np.rint((lowest + highest) / 2.0))):
        ends = (np.rint((height - offset) / scale) for height in (lowest, highest))
        if all(_INTEGERS.min <= end <= _INTEGERS.max for end in ends):
            return np.rint((heights - offset) / scale).astype(np.int32), offset
    raise BareEarthError(
        f"Heights above ground from {lowest:.2f} to {highest:.2f} do not fit the scale"
        f" {scale:g} of z in {cloud.path}. Write them as an extra dimension."
    )


TOOL = PointTool(
    step=MeasureHeights,
    list_name="heights.vpc",
    sets=(HeightOutput, GroundClasses),
    dialog_sets=(GroundClasses, HeightOutput),
    inputs=(
        Input(
            "dtm",
            "raster",
            HeightRaster.of,
            optional=True,
            help="Heights are measured above this raster, in the CRS of the points, and not above"
            " the ground points. The points need no classes. Empty: above the ground points.",
            label="Terrain model",
            is_last=True,
        ),
    ),
    command="height",
    about="Heights are measured above the triangulation (TIN) of the ground points or, outside of"
    " it, above the nearest ground point, in the vertical unit of the CRS. They become an extra"
    " dimension, HeightAboveGround, or replace z; nothing else in the file changes.\n"
    "With a terrain model, heights are measured above that raster, and the points need no"
    " classes.",
    identifier="heightaboveground",
    title="Height above ground",
    page="heights",
    words=(CLOUD, CANOPY, TIN, "height,extra bytes"),
    output_label="Point cloud with heights",
    output_help="The same points with their heights above ground.",
    numbers=(
        ("POINT_COUNT", "Points"),
        ("GROUND_COUNT", "Ground points"),
        ("MINIMUM", "Lowest height"),
        ("MAXIMUM", "Highest height"),
    ),
    shows="heights",
)
