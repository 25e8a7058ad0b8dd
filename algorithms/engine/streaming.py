"""Classifying a file that does not fit into memory: it is read twice, part by part."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet
from ..core.points import Frame, Points
from ..core.progress import SILENT, Progress, Unsaid
from ..las.cloud import PointCloud
from ..las.reading import read_parts
from ..products.terrain_model import TerrainModel, vertices_of
from ..survey.scope import Scope
from ..survey.selection import Selection, count_classes
from .blocks import BRIDGE, GROUND, LOW
from .ground import blocks_of, label_ground
from .memory import GIGABYTE, Resources
from .spill import Spill

# Bytes that a cloud in memory takes a point, besides what a filter takes for those it sees.
_BYTES_A_POINT_KEPT, _BYTES_A_POINT_SEEN, _MOST_SEEN = 40, 110, 12_000_000
# What a run may take whatever the memory that it is given, and how much of it the blocks.
_LEAST_MEMORY, _MOST_FOR_BLOCKS = 2 * GIGABYTE, GIGABYTE
# Bytes that a terrain model takes for each vertex of its TIN.
_BYTES_A_VERTEX = 700
# Ground points that are gathered, at least, before they are thinned together.
_STEP = 1 << 20


@dataclass
class Outcome:
    """What became of the points of a file.

    Attributes
    ----------
    cloud : PointCloud
        The points; none of them where they are not in memory.
    classification : numpy.ndarray of uint8, shape (n,)
        The new class of every point, in file order.
    class_counts : numpy.ndarray of int64, shape (256,)
        Points of each class.
    area_ground_count : int
        Points of the class of the ground in the area.
    area_low_count : int
        Points in the area that are labelled as low outliers.
    area_deck_count : int
        Points in the area that are labelled as decks of bridges.
    ground : Points or None
        The points of the class of the ground that a terrain model needs, if it is wanted.
    frame : Frame
        That of the survey.
    """

    cloud: PointCloud
    classification: np.ndarray
    frame: Frame
    class_counts: np.ndarray = field(default_factory=lambda: np.zeros(256, dtype=np.int64))
    area_ground_count: int = 0
    area_low_count: int = 0
    area_deck_count: int = 0
    ground: Points | None = None

    def add(
        self,
        start: int,
        part: PointCloud,
        labels: np.ndarray,
        inside: np.ndarray,
        selection: Selection,
    ) -> np.ndarray:
        """Put in the classes that follow from the labels of some points, and count them.

        Parameters
        ----------
        start : int
            Number of the first of the points in the file.
        part : PointCloud
            The points, with their present classes.
        labels : numpy.ndarray of uint8, shape (k,)
            What they are labelled.
        inside : numpy.ndarray of bool, shape (k,)
            Which lie in the area.
        selection : Selection
            What their classes become.

        Returns
        -------
        numpy.ndarray of bool, shape (k,)
            Which have the class of the ground now.
        """
        low, decks = labels == LOW, labels == BRIDGE
        classes = selection.classes(part, labels == GROUND, low, inside, decks)
        is_ground = classes == selection.to_class
        self.classification[start : start + part.count] = classes
        self.class_counts += count_classes(classes)
        self.area_ground_count += int(np.count_nonzero(is_ground & inside))
        self.area_low_count += int(np.count_nonzero(low & inside))
        self.area_deck_count += int(np.count_nonzero(decks & inside))
        return is_ground


def fits_in_memory(count: int, resources: Resources, record_length: int = 0) -> bool:
    """Return whether a file of `count` points can be classified with all of them in memory.

    Parameters
    ----------
    count : int
        Points of the file.
    resources : Resources
        How much memory there is.
    record_length : int
        Bytes of each point that are to be kept besides, as the file has them.
    """
    seen = _BYTES_A_POINT_SEEN * min(count, _MOST_SEEN)
    return (_BYTES_A_POINT_KEPT + record_length) * count + seen <= resources.bytes


def classify_parts(
    source: Path,
    target: Path,
    parameters: ParameterSet,
    scope: Scope,
    resources: Resources = Resources(),
    terrain: TerrainModel | None = None,
    progress: Progress = SILENT,
) -> Outcome:
    """Classify a file part by part, its points on disk until their block is filtered.

    Parameters
    ----------
    source, target : Path
        The file, and the output, in whose folder the temporary files are.
    parameters : ParameterSet
        Those of one method.
    scope : Scope
        Which points are to be classified, and which take part.
    resources : Resources
        Threads and memory.
    terrain : TerrainModel, optional
        The terrain model that is to be made afterwards.
    progress : Progress
        Receives progress and messages.

    Returns
    -------
    Outcome
        The same as that of all points in memory.

    Raises
    ------
    BareEarthError
        If the file cannot be read, the disk is full, no point is left to classify, or the terrain
        model would be too large.
    Cancelled
        If the user asked to stop.
    """
    selection = scope.selection
    blocks = blocks_of(parameters)
    with Spill(target, blocks.leaf_side) as spill:
        for part in read_parts(source, progress.part(0.0, 0.3)):
            inside, selected = scope.choose(part)
            known = selection.known_ground(part, selected)
            spill.append(part, selected, known, inside)
        scope.tell(progress)
        frame = spill.finish(scope.lowest)
        if terrain is not None:
            _check_terrain(spill, terrain, resources)
        fewer, special = _for_blocks(resources), selection.special
        label_ground(spill, parameters, blocks, special, fewer, progress.part(0.3, 0.8))
        classification = np.empty(scope.tally.points, dtype=np.uint8)
        outcome = Outcome(spill.cloud, classification, frame)
        thinned = None if terrain is None else _Thinned(terrain, frame)
        start = taken = 0
        for part in read_parts(source, Unsaid(progress.part(0.8, 1.0))):
            inside, selected = scope.choose_again(part)
            labels = spill.labels_of(part, selected, taken)
            is_ground = outcome.add(start, part, labels, inside, selection)
            if thinned is not None:
                thinned.add(part, is_ground)
            start += part.count
            taken += int(np.count_nonzero(selected))
        scope.tell_of_special(outcome.area_low_count, outcome.area_deck_count, progress)
    if thinned is not None:
        outcome.ground = thinned.points()
    return outcome


def _for_blocks(resources: Resources) -> Resources:
    """Return the resources with no more memory than is good for the blocks of one run."""
    memory = min(resources.bytes, _MOST_FOR_BLOCKS) / GIGABYTE
    return Resources(threads=resources.threads, memory=max(memory, 0.001))


def _check_terrain(spill: Spill, terrain: TerrainModel, resources: Resources) -> None:
    """Refuse a terrain model that would not fit into memory, before the long work begins."""
    side = spill.leaves.side
    cells_a_leaf = (side / terrain.dtm_cell_size) ** 2
    vertices = np.minimum(spill.leaves.counts, 4.0 * cells_a_leaf).sum()
    needed = _BYTES_A_VERTEX * vertices
    if needed > max(resources.bytes, _LEAST_MEMORY):
        raise BareEarthError(
            f"The terrain model of {spill.count:,} points would take about"
            f" {needed / GIGABYTE:.0f} GB of memory. Give more memory, a larger cell size or an"
            " extent, or classify without a terrain model."
        )


class _Thinned:
    """The ground points that a terrain model needs, gathered part by part."""

    def __init__(self, terrain: TerrainModel, frame: Frame) -> None:
        # As a raster has it: rounded to and from the unit of the CRS.
        self._cell = terrain.dtm_cell_size / frame.horizontal_unit * frame.horizontal_unit
        self._frame, self._kept, self._new = frame, Points(*[np.zeros(0)] * 3), []

    def add(self, part: PointCloud, is_ground: np.ndarray) -> None:
        """Add the ground points of a part."""
        points = part.points(is_ground, self._frame)
        if points.count:
            self._new.append(points.take(vertices_of(points, self._cell)))
        # Not each time: all that is kept is thinned anew.
        if sum(each.count for each in self._new) > max(self._kept.count, _STEP):
            self.points()

    def points(self) -> Points:
        """Return what is left of all points so far, in the order of the file."""
        both = [self._kept, *self._new]
        points = Points(*map(np.concatenate, zip(*both)))
        if points.count:
            points = points.take(vertices_of(points, self._cell))
        self._kept, self._new = points, []
        return points
