"""Classifying a file that does not fit into memory: it is read twice, part by part."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..core.parameters import ParameterSet
from ..core.progress import SILENT, Progress, Unsaid
from ..las.cloud import PointCloud
from ..las.reading import read_parts
from ..products.raster_block import BlockRasters
from ..survey.scope import Scope
from ..survey.selection import Selection, count_classes
from .blocks import BRIDGE, GROUND, LOW
from .disk_points import DiskPoints
from .ground import blocks_of, label_ground
from .heights import DiskHeights
from .memory import GIGABYTE, Resources
from .rasters import RasterRequest, rasters_of_store

# Bytes that a cloud in memory takes a point, besides what a filter takes for those it sees.
_BYTES_A_POINT_KEPT, _BYTES_A_POINT_SEEN, _MOST_SEEN = 40, 110, 12_000_000
# How much of the memory the blocks may take.
_MOST_FOR_BLOCKS = GIGABYTE


@dataclass
class ClassifiedPoints:
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
    rasters : list of BlockRasters or None
        The rasters of the blocks, if any are wanted.
    heights : numpy.ndarray of float32, shape (n,), or None
        Heights above ground, in the vertical unit of the CRS, where they are measured already.
    """

    cloud: PointCloud
    classification: np.ndarray
    class_counts: np.ndarray = field(default_factory=lambda: np.zeros(256, dtype=np.int64))
    area_ground_count: int = 0
    area_low_count: int = 0
    area_deck_count: int = 0
    rasters: list[BlockRasters] | None = None
    heights: np.ndarray | None = None

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
    request: RasterRequest = RasterRequest(),
    with_heights: bool = False,
    progress: Progress = SILENT,
) -> ClassifiedPoints:
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
    request : RasterRequest
        Which rasters are wanted.
    with_heights : bool
        Whether heights above ground are wanted.
    progress : Progress
        Receives progress and messages.

    Returns
    -------
    ClassifiedPoints
        The same as that of all points in memory.

    Raises
    ------
    BareEarthError
        If the file cannot be read, the disk is full, or no point is left to classify.
    Cancelled
        If the user asked to stop.
    """
    selection = scope.selection
    blocks = blocks_of(parameters)
    fewer = _for_blocks(resources)
    with contextlib.ExitStack() as files:
        spill = files.enter_context(DiskPoints(target, blocks.leaf_side))
        for part in read_parts(source, progress.part(0.0, 0.3)):
            inside, selected = scope.choose(part)
            known = selection.known_ground(part, selected)
            spill.append(part, selected, known, inside)
        scope.tell(progress)
        spill.finish(scope.lowest)
        label_ground(spill, parameters, blocks, selection.special, fewer, progress.part(0.3, 0.7))
        ground = heights = None
        if request.files.wanted:
            ground = files.enter_context(DiskPoints(target, request.blocks.leaf_side))
        if with_heights:
            heights = files.enter_context(DiskHeights(target))
        outcome = ClassifiedPoints(spill.cloud, np.empty(scope.tally.points, dtype=np.uint8))
        start = taken = 0
        for part in read_parts(source, Unsaid(progress.part(0.7, 0.85))):
            inside, selected = scope.choose_again(part)
            labels = spill.labels_of(part, selected, taken)
            is_ground = outcome.add(start, part, labels, inside, selection) & ~part.withheld
            if ground is not None:
                ground.append(part, is_ground, is_ground, np.zeros(part.count, dtype=bool))
            if heights is not None:
                heights.append(part, is_ground)
            start += part.count
            taken += int(np.count_nonzero(selected))
        scope.tell_of_special(outcome.area_low_count, outcome.area_deck_count, progress)
        if ground is not None:
            ground.finish(scope.lowest)
            outcome.rasters = rasters_of_store(ground, request, fewer, progress.part(0.85, 0.9))
        if heights is not None:
            parts, rest = read_parts(source, Unsaid(SILENT)), progress.part(0.9, 1.0)
            outcome.heights = heights.measured(scope.lowest, parts, np.float32, fewer, rest)
    return outcome


def _for_blocks(resources: Resources) -> Resources:
    """Return the resources with no more memory than is good for the blocks of one run."""
    memory = min(resources.bytes, _MOST_FOR_BLOCKS) / GIGABYTE
    return Resources(threads=resources.threads, memory=max(memory, 0.001))
