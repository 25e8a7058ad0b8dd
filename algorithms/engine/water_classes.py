"""The step that gives classes to ground points in water, and beside its shore."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud
from ..las.edits import Edits
from ..las.lasfile import LasFile
from ..las.records import check_class
from ..products.water_classes import NO_WATER, WaterClasses, WaterPolygons, classes_at_water
from ..survey.ground_classes import GroundClasses, GroundCounts
from ..survey.point_counts import by_class, count_classes
from .blocks import Blocks
from .memory import Resources
from .steps import Allocate, CountedClasses, PointResult, PointStep, RememberedClasses
from .store import Marks, Store


@dataclass(frozen=True, order=True)
class WaterClassSummary(CountedClasses):
    """The points of a file that became water or ignored ground.

    Attributes
    ----------
    name : str
        Name of the output.
    point_count, water_count, ignored_count : int
        Numbers of all points, and of those that became water, and ignored ground.
    class_counts : dict of int to int
        Points of each class in the output.
    """

    name: str
    point_count: int
    water_count: int
    ignored_count: int
    class_counts: dict[int, int] = field(default_factory=dict)

    @property
    def text(self) -> str:
        """The summary as a sentence."""
        return (
            f"{self.name}: {self.water_count:,} of {self.point_count:,} points became water, and"
            f" {self.ignored_count:,} ignored ground beside the shore"
        )


@dataclass(frozen=True)
class ClassifyWater(PointStep):
    """Finds the ground points in water, and those beside its shore.

    Attributes
    ----------
    parameters : WaterClasses
        The classes, and the distance from the shore.
    ground : GroundClasses
        Which points are ground.
    water : WaterPolygons
        The water.
    """

    parameters: WaterClasses = field(default_factory=WaterClasses)
    ground: GroundClasses = field(default_factory=GroundClasses)
    water: WaterPolygons = NO_WATER

    counts = GroundCounts
    blocks = Blocks.of(1.0)
    summary_type = WaterClassSummary
    vpc_name = "water_classes.vpc"

    def marks(self, part: PointCloud, counts: GroundCounts) -> Marks:
        """Count the ground points. No point needs others, so none is marked."""
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

    def classes_of(self, part: PointCloud) -> np.ndarray:
        """Return the new classes of points; uint8, shape (n,)."""
        part.require_projected()
        x, y = (
            np.asarray(column, dtype=np.float64) * scale + offset
            for column, scale, offset in zip((part.x, part.y), part.scale, part.offset)
        )
        ground = self.ground.points_of(part, self.ground.ground_classes)
        polygons, unit = self.water.polygons, part.crs.horizontal_unit
        return classes_at_water(x, y, part.classification, ground, polygons, self.parameters, unit)

    def result(self, path: Path, allocate: Allocate) -> WaterOfPoints:
        """Return an object that collects the classes of a file."""
        return WaterOfPoints(self, allocate)


class WaterOfPoints(PointResult):
    """The new classes of the points of a file.

    Parameters
    ----------
    step : ClassifyWater
        The step.
    allocate : callable
        Returns an array of one value for each point.
    """

    def __init__(self, step: ClassifyWater, allocate: Allocate) -> None:
        self._step, self._memory = step, RememberedClasses(allocate)
        self._classes = allocate(np.uint8)
        self._counts = np.zeros(256, dtype=np.int64)
        self._water_count = self._ignored_count = 0

    def add(self, where: slice, part: PointCloud, values: np.ndarray) -> None:
        """Find the classes of some points; the values are not used."""
        classes, how = self._step.classes_of(part), self._step.parameters
        self._classes[where] = classes
        self._memory.add(where, part, classes)
        self._counts += count_classes(classes)
        new = classes[classes != part.classification]
        self._water_count += int(np.count_nonzero(new == how.water_class))
        self._ignored_count += int(np.count_nonzero(new == how.ignored_class))

    def edits(self, cloud: PointCloud, progress: Progress = SILENT) -> Edits:
        """Return the classes."""
        return self._memory.added_to(Edits(classification=self._classes))

    def summary(self, name: str) -> WaterClassSummary:
        """Return the numbers of points."""
        found = self._water_count, self._ignored_count
        return WaterClassSummary(name, len(self._classes), *found, by_class(self._counts))
