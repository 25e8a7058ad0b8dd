"""Hold-out: how well ground points predict others that were left out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.progress import SILENT, Progress
from .accuracy import Figures
from .survey_ground import SurveyGround

# Most points at which errors are measured. More would hardly change the figures.
MOST = 10_000
# Side in metres of the cells by which points are left out: all points of a place, or none.
_CELL = 0.01
_STEEP = 20.0
# Numbers that mix the bits of the coordinates (Steele, Lea & Flood 2014, SplitMix64).
_MIX = tuple(
    np.uint64(number) for number in (0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9, 0x94D049BB133111EB)
)


@dataclass(frozen=True)
class HoldOut:
    """Errors (TIN minus point) at up to 10,000 ground points that were left out of the TIN."""

    share: float  # of the ground points, that was left out
    left_out: int  # points
    no_height: int  # points that no short triangle of the others holds
    all: Figures | None
    open: Figures | None  # neither steep nor under trees
    under_trees: Figures | None  # not steep, of pulses with several returns
    steep: Figures | None  # where the slope is more than 20 degrees
    single: bool = False  # whether all left-out points are of pulses with a single return

    def limits(self) -> str:
        """Return sentences on what the errors do not show."""
        single = (
            " No pulse has several returns, as in clouds of images: below plants nothing was"
            " measured."
        )
        return (
            "How well ground points agree with each other, not how right the terrain is: objects"
            " and dense plants that were taken for ground do not show, nor does an error in height"
            f" that all points share.{single if self.single else ''}"
        )


def hold_out(
    ground: SurveyGround, share: float, max_edge: float, progress: Progress = SILENT
) -> HoldOut:
    """Leave out a share, 0 to 1, of the ground points, and measure how well the TIN of the others
    predicts them, without triangles with edges longer than `max_edge` metres.
    """
    # The points are chosen by their coordinates alone. So a survey has the same ones in each run,
    # however it is cut into files.
    limit = np.uint64(min(int(share * 2.0**64), 2**64 - 1))
    # x, y, z, and whether their pulses had several returns.
    kept = np.empty((4, 0))
    codes, count = np.empty(0, dtype=np.uint64), 0
    for cloud, is_ground in ground.parts(progress.part(0.0, 0.4)):
        indices = np.flatnonzero(is_ground)
        points = cloud.points(indices, ground.frame)
        code = _codes(points.x, points.y)
        chosen = np.flatnonzero(code < limit)
        count += len(chosen)
        several = cloud.number_of_returns[indices[chosen]] > 1
        new = np.array([*(column[chosen] for column in points), several])
        kept, codes = np.concatenate((kept, new), axis=1), np.concatenate((codes, code[chosen]))
        # Sorted also by height, since points of one place have the same code.
        order = np.lexsort((*kept, codes))[:MOST]
        kept, codes = kept[:, order], codes[order]
    ground.check()
    if not len(codes):
        return HoldOut(share, 0, 0, None, None, None, None)
    found = ground.heights(
        kept[:2].T, max_edge, progress.part(0.4, 1.0), lambda x, y: _codes(x, y) >= limit
    )
    errors, known = found.heights - kept[2], np.isfinite(found.heights)
    rises, several = found.slopes > _STEEP, kept[3] > 0.0
    lands = (known, known & ~rises & ~several, known & ~rises & several, known & rises)
    every, level, trees, steep = (Figures.of(errors[land]) for land in lands)
    no_height, single = int(np.count_nonzero(~known)), not kept[3].any()
    return HoldOut(share, count, no_height, every, level, trees, steep, single)


def _codes(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return a pseudorandom number for the cell of each place, which depends only on the cell."""
    column, row = (np.rint(axis / _CELL).astype(np.int64).view(np.uint64) for axis in (x, y))
    first, second, third = _MIX
    with np.errstate(over="ignore"):
        code = column * first
        code = (code ^ (code >> np.uint64(29))) + row
        for by, shift in ((second, 30), (third, 27)):
            code = (code ^ (code >> np.uint64(shift))) * by
        return code ^ (code >> np.uint64(31))
