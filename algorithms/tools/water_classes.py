"""Classify water: classes of ground points in water, and of those beside its shore."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Sequence

import numpy as np

from ..classes.ground_classes import GroundClasses, GroundCounts
from ..classes.kept_classes import IGNORED_GROUND
from ..classes.without_ground import UNCHANGED, WithoutGround
from ..core.parameters import ParameterSet, parameter
from ..core.progress import SILENT, Progress
from ..engine.blocks import Blocks
from ..engine.step import PointStep, with_classes
from ..engine.store import Marks
from ..engine.summary import TileSummary
from ..grids.lines import near_rings
from ..las.cloud import PointCloud
from ..las.lasfile import LasFile
from ..las.records import check_class
from ..survey.area import Area, Polygon
from ..survey.files import Inputs
from ..survey.shapes import Geometry, Place, located
from .declaration import CLOUD, Input, PointTool


@dataclass(frozen=True)
class WaterClasses(ParameterSet):
    """Which classes ground points in water and beside its shore get."""

    shore_distance: float = parameter(
        0.7,
        label="Ignored ground beside the shore",
        unit="m",
        minimum=0.0,
        maximum=1000.0,
        help="Ground points outside of the water, up to this far from its shore, become ignored"
        " ground: there the breakline alone decides the terrain. The Lidar Base Specification asks"
        " for one nominal point spacing: 0.7 m for QL2, 0.35 m for QL1. 0: none.",
    )
    water_class: int = parameter(
        9,
        label="Class of water",
        minimum=0,
        maximum=255,
        advanced=True,
        help="The class that ground points in the water get. Point formats 0 to 5 hold classes up"
        " to 31.",
    )
    ignored_class: int = parameter(
        IGNORED_GROUND,
        label="Class of ignored ground",
        minimum=0,
        maximum=255,
        advanced=True,
        help="The class that ground points beside the shore get. Points that have it already keep"
        " it, also in the water, unless it is one of the ground classes.",
    )


@dataclass(frozen=True, eq=False)
class WaterPolygons(Geometry):
    """Polygons of water, in coordinates of the CRS."""

    # As in `Area`: shores, and islands as holes. Those of a file can be in another CRS until the
    # points are known.
    polygons: tuple[Polygon, ...] = ()

    def __post_init__(self) -> None:
        if self.polygons:
            # This refuses corners that are not finite.
            Area(None, self.polygons)

    def located(self, place: Place, progress: Progress = SILENT) -> WaterPolygons:
        """Return the polygons in the CRS of the points."""
        if not self.polygons:
            progress.warning("There is no polygon of water, so that no class changes.")
        return WaterPolygons(located(self.polygons, "the polygons of water", place, progress))


NO_WATER = WaterPolygons()


def _found(sources: Inputs, ground: GroundClasses, progress: Progress) -> WaterPolygons:
    """Return the water that is found in classified files, with the default values."""
    from .water.tool import found_water

    water, _ = found_water(sources, ground, progress)
    return WaterPolygons(tuple(water.outlines))


def classes_at_water(
    x: np.ndarray,
    y: np.ndarray,
    classes: np.ndarray,
    ground: np.ndarray,
    polygons: tuple[Polygon, ...],
    how: WaterClasses,
    unit: float = 1.0,
) -> np.ndarray:
    """Return the classes of points, uint8 (n,), with those of water and of ignored ground beside
    its shore; points that are not ground keep their class.
    """
    # Places and polygons are in units of the CRS, distances in metres. The classes 9 and 20 are
    # those of the Lidar Base Specification 2.1 of the U.S. Geological Survey.
    found, candidates = classes.copy(), np.flatnonzero(ground)
    if not polygons or not len(candidates):
        return found
    inside = Area(None, polygons).contains(x[candidates], y[candidates])
    found[candidates[inside]] = how.water_class
    if how.shore_distance > 0.0:
        land = candidates[~inside]
        rings = [ring for polygon in polygons for ring in polygon]
        beside = near_rings(x[land], y[land], rings, how.shore_distance / unit)
        found[land[beside]] = how.ignored_class
    return found


@dataclass(frozen=True, order=True)
class WaterClassSummary(TileSummary):
    """The points of a file that became water or ignored ground."""

    name: str  # of the output
    point_count: int = 0
    water_count: int = 0
    ignored_count: int = 0
    was_ground_count: int = 0  # ground before
    class_counts: dict[int, int] = field(default_factory=dict)  # in the output

    @property
    def text(self) -> str:
        """The summary as a sentence."""
        return (
            f"{self.name}: {self.water_count:,} of {self.point_count:,} points became water, and"
            f" {self.ignored_count:,} ignored ground beside the shore"
        )


@dataclass(frozen=True)
class ClassifyWater(PointStep):
    """Finds the ground points in water, and those beside its shore."""

    # The classes, and the distance from the shore
    parameters: WaterClasses = field(default_factory=WaterClasses)
    ground: GroundClasses = field(default_factory=GroundClasses)  # which points are ground
    water: WaterPolygons = NO_WATER  # the water

    counts = GroundCounts
    blocks = Blocks.of(1.0)
    summary_type = WaterClassSummary

    def marks(self, part: PointCloud, counts: GroundCounts) -> Marks:
        """Count the ground points, and mark none, since no point needs others."""
        self.check_file(part)
        self.ground.of(part, counts)
        none = np.zeros(part.count, dtype=bool)
        return Marks(none, none, none)

    def report_counts(self, counts: GroundCounts, path: Path, progress: Progress) -> None:
        """Refuse a file without ground."""
        self.ground.check(counts, path)

    def report_survey(
        self, done: Sequence[WaterClassSummary], empty: Sequence[LasFile], progress: Progress
    ) -> None:
        """Warn of files without ground; refuse them if no file has any."""
        files = [
            (summary.was_ground_count, WithoutGround(summary.name, summary.point_count, UNCHANGED))
            for summary in done
        ]
        self.ground.report_survey(files, progress)

    def check_file(self, file: LasFile | PointCloud) -> None:
        """Refuse a file whose points cannot hold the classes."""
        how = self.parameters
        for value, use in ((how.water_class, "water"), (how.ignored_class, "ignored ground")):
            check_class(file.path, file.point_format, value, use)

    def applied(self, part: PointCloud, values: np.ndarray) -> PointCloud:
        """Return points with their classes; the values are not used."""
        part.require_projected()
        ground = self.ground.points_of(part, self.ground.ground_classes)
        polygons, unit = self.water.polygons, part.crs.horizontal_unit
        classes = classes_at_water(
            *part.coordinates(), part.classification, ground, polygons, self.parameters, unit
        )
        return with_classes(part, classes)

    def numbers(self, part: PointCloud, after: PointCloud, values: np.ndarray) -> dict[str, int]:
        """Return how many points became water, and how many ignored ground."""
        new = after.classification[after.classification != part.classification]
        ground = self.ground.points_of(part, self.ground.ground_classes)
        return {
            "was_ground_count": int(np.count_nonzero(ground)),
            "water_count": int(np.count_nonzero(new == self.parameters.water_class)),
            "ignored_count": int(np.count_nonzero(new == self.parameters.ignored_class)),
        }


TOOL = PointTool(
    step=ClassifyWater,
    list_name="water_classes.vpc",
    sets=(WaterClasses, GroundClasses),
    inputs=(
        Input(
            "water",
            "polygons",
            WaterPolygons,
            help="Polygons of water, with islands as holes. In place of them, the word automatic,"
            " or an empty field: the water is found first, as `water()` does by default.",
            label="Water",
            found=_found,
        ),
    ),
    command="water-classes",
    identifier="waterclasses",
    title="Classify water",
    about="Ground points in polygons of water become water (9), and those within a distance of the"
    " shore ignored ground (20), as the Lidar Base Specification asks for. Nothing else in the"
    " file changes: points with other classes keep them.",
    page="water#classes-of-points-in-the-water",
    words=(
        CLOUD,
        "lake,river,pond,shore,breaklines,hydro-flattening,class 9,class 20,ignored ground,"
        "usgs,lbs,classes,classification",
    ),
    output_label="Point cloud with water",
    output_help="The same points, with the classes of water and of ignored ground.",
    numbers=(
        ("POINT_COUNT", "Points"),
        ("WATER_COUNT", "Points that became water"),
        ("IGNORED_COUNT", "Points that became ignored ground"),
    ),
)
