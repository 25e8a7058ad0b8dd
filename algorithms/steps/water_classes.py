"""The step that gives classes to ground points in water, and beside its shore."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..core.progress import Progress
from ..engine.blocks import Blocks
from ..engine.memory import Resources
from ..engine.step import Allocate, CountedClasses, PointResult, PointStep, with_classes
from ..engine.store import Marks, Store
from ..las.cloud import PointCloud
from ..las.lasfile import LasFile
from ..las.records import check_class
from ..products.water_classes import NO_WATER, WaterClasses, WaterPolygons, classes_at_water
from ..survey.ground_classes import GroundClasses, GroundCounts


@dataclass(frozen=True, order=True)
class WaterClassSummary(CountedClasses):
    """The points of a file that became water or ignored ground."""

    name: str  # of the output
    point_count: int
    water_count: int
    ignored_count: int
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

    parameters: WaterClasses = field(default_factory=WaterClasses)
    ground: GroundClasses = field(default_factory=GroundClasses)
    water: WaterPolygons = NO_WATER

    counts = GroundCounts
    blocks = Blocks.of(1.0)
    summary_type = WaterClassSummary
    vpc_name = "water_classes.vpc"

    def marks(self, part: PointCloud, counts: GroundCounts) -> Marks:
        """Count the ground points, and mark none, since no point needs others."""
        self.check_tile(part)
        self.ground.of(part, counts)
        none = np.zeros(part.count, dtype=bool)
        return Marks(none, none, none)

    def tell(self, counts: GroundCounts, path: Path, progress: Progress) -> None:
        """Refuse a file without ground."""
        self.ground.check(counts, path)

    def check_tile(self, tile: LasFile | PointCloud) -> None:
        """Refuse a file whose points cannot hold the classes."""
        how = self.parameters
        for value, what in ((how.water_class, "water"), (how.ignored_class, "ignored ground")):
            check_class(tile.path, tile.point_format, value, what)

    def work(self, store: Store, resources: Resources, progress: Progress) -> None:
        """Do nothing: each point is decided by its place alone."""

    def applied(self, part: PointCloud, values: np.ndarray) -> PointCloud:
        """Return points with their classes; the values are not used."""
        part.require_projected()
        x, y = (
            np.asarray(column, dtype=np.float64) * scale + offset
            for column, scale, offset in zip((part.x, part.y), part.scale, part.offset)
        )
        ground = self.ground.points_of(part, self.ground.ground_classes)
        polygons, unit = self.water.polygons, part.crs.horizontal_unit
        classes = classes_at_water(
            x, y, part.classification, ground, polygons, self.parameters, unit
        )
        return with_classes(part, classes)

    def result(self, path: Path, allocate: Allocate) -> WaterOfPoints:
        """Return an object that counts what changes in a file."""
        return WaterOfPoints(self)


class WaterOfPoints(PointResult):
    """The numbers of points of a file that become water or ignored ground."""

    def __init__(self, step: ClassifyWater) -> None:
        self._step, self._count = step, 0
        self._water_count = self._ignored_count = 0

    def add(self, where: slice, part: PointCloud, values: np.ndarray) -> PointCloud:
        """Count some points; return them with their classes."""
        after, how = self._step.applied(part, values), self._step.parameters
        new = after.classification[after.classification != part.classification]
        self._count += part.count
        self._water_count += int(np.count_nonzero(new == how.water_class))
        self._ignored_count += int(np.count_nonzero(new == how.ignored_class))
        return after

    def summary(self, name: str, class_counts: dict[int, int]) -> WaterClassSummary:
        """Return the numbers of points."""
        numbers = self._count, self._water_count, self._ignored_count
        return WaterClassSummary(name, *numbers, class_counts)
