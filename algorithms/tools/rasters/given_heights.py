"""Heights of given lines that cannot be: they are taken from the ground instead."""

from __future__ import annotations

from typing import Sequence

import numpy as np

from ...core.progress import Progress
from ...grids.lines import NearestHeights

# Heights that stand for none, in any unit; and the largest that can be, in metres.
_NODATA = (-9999.0, -99999.0, -999999.0, -999.0, -32768.0, -32767.0)
_LARGEST = 50_000.0
# A corner of a line is wrong if it is so far above or below all ground near it, in metres, or so
# far from that of the other corners where no ground is near.
_FAR = 10.0
_FAR_FROM_OTHERS = 100.0
# A line whose heights are all 0 has none, unless the ground is as near to 0, in metres.
_NOT_ZERO = 0.5


def without_wrong_heights(
    lines: Sequence[np.ndarray], ground: NearestHeights, unit: float, progress: Progress
) -> list[np.ndarray]:
    """Return lines, corners in metres of shape (n, 3), with NaN in place of heights that cannot be,
    and warn of these; `unit` is metres in the unit in which they are written.
    """
    if not lines:
        return []
    corners = np.concatenate(lines)
    z = corners[:, 2]
    # The ground on both sides of the corners of each line.
    sides = np.concatenate([ground.beside(line)[:, 2].reshape(2, -1) for line in lines], axis=1)
    low, high = np.fmin(*sides), np.fmax(*sides)
    usual = float(np.nanmedian(sides)) if np.isfinite(sides).any() else np.nan
    is_far = _away(z, low, high) > _FAR
    alone = np.isnan(low)
    is_far |= alone & (_away(z, usual, usual) > _FAR_FROM_OTHERS)
    is_none = np.isin(np.round(z / unit, 6), _NODATA) | (np.abs(z) > _LARGEST)
    all_zero = np.concatenate([np.full(len(line), not line[:, 2].any()) for line in lines])
    is_zero = (z == 0.0) & ~is_none & (is_far | (all_zero & (_away(z, low, high) > _NOT_ZERO)))
    is_far &= ~is_none & ~is_zero
    wrong = is_none | is_zero | is_far
    away = np.where(alone, np.nan, _away(z, low, high))[is_zero | is_far]
    if wrong.any():
        reasons = {
            f"{is_none.sum():,} stand for no height": is_none,
            f"{is_zero.sum():,} are 0": is_zero,
            f"{is_far.sum():,} lie more than {_FAR:g} m from it": is_far,
        }
        said = ", ".join(reason for reason, mask in reasons.items() if mask.any())
        if np.isfinite(away).any() and np.nanmax(away):
            said += f", up to {np.nanmax(away):,.1f} m away"
        progress.warning(
            f"Heights of breaklines that cannot be: {wrong.sum():,} of {(~np.isnan(z)).sum():,}"
            f" corners. The ground near them counts instead ({said})."
        )
    mended = np.column_stack((corners[:, :2], np.where(wrong, np.nan, z)))
    return np.split(mended, np.cumsum([len(line) for line in lines], dtype=np.int64)[:-1])


def _away(z: np.ndarray, low: np.ndarray | float, high: np.ndarray | float) -> np.ndarray:
    """Return how far heights lie above or below others; 0 where either is not known."""
    with np.errstate(invalid="ignore"):
        return np.nan_to_num(np.maximum(np.maximum(low - z, z - high), 0.0), nan=0.0)
