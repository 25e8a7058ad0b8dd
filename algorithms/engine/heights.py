"""Heights above ground of the points of a store, block by block."""

from __future__ import annotations

from functools import partial
from typing import Callable, NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud, survey_frame
from ..products.height_above_ground import height_above_ground
from .blocks import Block, Blocks, Store
from .cloudstore import CloudStore, Part
from .ground import over_blocks
from .memory import Resources

# Metres round a block in which ground points matter for its heights.
_REACH = 100.0
HEIGHT_BLOCKS = Blocks.of(_REACH)


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
        raise BareEarthError(
            f"All ground points of {cloud.path} are withheld, so that no height above ground can be"
            " measured."
        )
    part = Part(cloud, np.ones(cloud.count, dtype=bool), ground)
    frame, first = survey_frame(cloud.crs), progress.part(0.0, 0.1)
    store = CloudStore([part], frame, HEIGHT_BLOCKS, first, np.float64)
    measure_heights(store, resources, progress.part(0.1, 1.0))
    return in_unit(store.labels[0], cloud)


def in_unit(heights: np.ndarray, cloud: PointCloud) -> np.ndarray:
    """Return heights in metres in the vertical unit of a cloud, without the noise of rounding."""
    # Ground points have 0, not -0.
    return np.round(heights / cloud.crs.vertical_unit, 6) + 0.0


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
