"""Heights above ground of the points of a store, block by block."""

from __future__ import annotations

import tempfile
from functools import partial
from pathlib import Path
from typing import Callable, Iterable, NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud, survey_frame
from ..products.height_above_ground import height_above_ground
from .blocks import Block, Blocks, Store
from .disk_points import DiskPoints
from .ground import over_blocks
from .memory import Resources
from .memory_points import MemoryPoints, SurveyFile

# Metres round a block in which ground points matter for its heights.
_REACH = 100.0
HEIGHT_BLOCKS = Blocks.of(_REACH)
_NO_GROUND = "All ground points of {} are withheld, so that no height above ground can be measured."


class _Heights(NamedTuple):
    """Heights in metres of the points at some positions of a store."""

    positions: np.ndarray
    heights: np.ndarray


def heights_of(
    cloud: PointCloud,
    ground: np.ndarray,
    resources: Resources = Resources(),
    progress: Progress = SILENT,
) -> np.ndarray:
    """Return how high each point of a cloud stands above its ground.

    Parameters
    ----------
    cloud : PointCloud
        The points.
    ground : numpy.ndarray of bool, shape (n,)
        Which of them are ground.
    resources : Resources
        Threads and memory.
    progress : Progress
        Receives progress.

    Returns
    -------
    numpy.ndarray of float64, shape (n,)
        In the vertical unit of the CRS; NaN in blocks without ground.

    Raises
    ------
    BareEarthError
        If no point is ground, or the CRS is geographic.
    """
    if not ground.any():
        raise BareEarthError(_NO_GROUND.format(cloud.path))
    part = SurveyFile(cloud, np.ones(cloud.count, dtype=bool), ground)
    frame, first = survey_frame(cloud.crs), progress.part(0.0, 0.1)
    store = MemoryPoints([part], frame, HEIGHT_BLOCKS, first, np.float64)
    measure_heights(store, resources, progress.part(0.1, 1.0))
    return in_unit(store.labels[0], cloud)


def in_unit(heights: np.ndarray, cloud: PointCloud) -> np.ndarray:
    """Return heights in metres in the vertical unit of a cloud, without the noise of rounding."""
    # Ground points have 0, not -0.
    return np.round(heights / cloud.crs.vertical_unit, 6) + 0.0


class DiskHeights:
    """The heights of the points of a file, on disk until they are written.

    Parameters
    ----------
    target : Path
        The output, in whose folder the temporary files are.
    """

    def __init__(self, target: Path) -> None:
        self._target = target
        self._spill = DiskPoints(target, HEIGHT_BLOCKS.leaf_side, np.float64)

    def __enter__(self) -> DiskHeights:
        return self

    def __exit__(self, *exception: object) -> None:
        self._spill.__exit__(*exception)

    def append(self, part: PointCloud, ground: np.ndarray) -> None:
        """Add the next points of the file, and say which of them are ground."""
        every = np.ones(part.count, dtype=bool)
        self._spill.append(part, every, ground, every)

    def measured(
        self,
        lowest: tuple[int, int],
        parts: Iterable[PointCloud],
        kind: type,
        resources: Resources,
        progress: Progress,
    ) -> np.ndarray:
        """Measure the heights; return them in the order of the file, in its vertical unit.

        Parameters
        ----------
        lowest : tuple of int
            The smallest x and y of the file, as integers.
        parts : iterable of PointCloud
            The points once more, as they were appended.
        kind : type
            Of the numbers that are returned.
        resources : Resources
            Threads and memory.
        progress : Progress
            Receives progress.
        """
        if not self._spill.has_known:
            raise BareEarthError(_NO_GROUND.format(self._spill.cloud.path))
        self._spill.finish(lowest)
        measure_heights(self._spill, resources, progress)
        with tempfile.TemporaryFile(dir=self._target.parent) as file:
            heights = np.memmap(file, kind, "w+", shape=(self._spill.count,))
        start = 0
        for part in parts:
            every = np.ones(part.count, dtype=bool)
            found = self._spill.labels_of(part, every, start)
            heights[start : start + part.count] = in_unit(found, part)
            start += part.count
        return heights


def measure_heights(
    store: Store, resources: Resources = Resources(), progress: Progress = SILENT
) -> None:
    """Put the height in metres above the known ground of each wanted point of a store.

    Parameters
    ----------
    store : Store
        The points, all of which take part.
    resources : Resources
        Threads and memory.
    progress : Progress
        Receives progress.
    """
    job_of = partial(_job_of, store)
    for _, result in over_blocks(store, HEIGHT_BLOCKS, job_of, resources, progress):
        store.put(result.positions, result.heights)


def _job_of(store: Store, block: Block, is_only: bool) -> Callable[[Progress], _Heights]:
    def job(progress: Progress) -> _Heights:
        contents = HEIGHT_BLOCKS.contents(block, store)
        wanted = contents.wanted.copy()
        if not is_only:
            wanted &= block.holds(contents.points, HEIGHT_BLOCKS.corner(block))
        positions = contents.positions[wanted]
        if not contents.known.any():
            return _Heights(positions, np.full(len(positions), np.nan))
        if not len(positions):
            return _Heights(positions, np.zeros(0))
        heights = height_above_ground(contents.points, contents.known, progress, wanted)
        return _Heights(positions, heights[wanted])

    return job
