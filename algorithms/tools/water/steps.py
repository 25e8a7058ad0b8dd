"""Cuts a region of water in two where its level steps: at dams, weirs and locks."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...grids.morphology import dilation
from .levels import Levels
from .reaches import Reaches

# A step is at least so high in metres, within so many reaches, and so many times what the water
# falls in as many of the reaches on either side of it. So many reaches count there, at least so
# many.
STEP, _WITHIN, _STEEPER, _BESIDE, _LEVEL_REACHES = 0.4, 3, 4.0, 4, 1
# Metres that a drop counts less for each reach over which it goes.
_BLURRED = 0.1
# The parts are so many cells from where the land says that the step is; cells of the banks.
_GAP, _BANK = 1.0, 2.0
# A step goes straight across if its ends are hardly so many cells apart along the water: single
# cells of a bank are too high.
_SLANTED = 8.0
# Cells this near to the other part are no shore: they may be its banks.
_HIDDEN = 4.0


class _Step(NamedTuple):
    """A step of the level, from the first to the last of some reaches."""

    before: np.ndarray  # the reaches upstream, with those at the step
    after: np.ndarray  # the reaches downstream, with those at the step
    reaches: int  # number of reaches from first to last
    middle: float
    drop: float

    @property
    def sharpness(self) -> float:
        """The drop, less for each reach: few reaches say better where the step is."""
        return self.drop - _BLURRED * self.reaches


def parts_of_step(
    water: np.ndarray, levels: Levels, ground: np.ndarray
) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return what a region of a river falls into at its highest step, as the cells of each part and
    those that are not its shore: nothing if it has none, one part if water goes round it.
    """
    # `ground` is infinite where there is none.
    from scipy.ndimage import label

    reaches = levels.reaches
    steps = [] if reaches is None else [_highest(levels, chain) for chain in levels.chains]
    found = [step for step in steps if step is not None]
    if reaches is None or not found:
        return []
    gap = _gap(water, reaches, max(found, key=lambda step: step.sharpness), ground)
    # Only side by side: a corner is no passage for a gap that is one cell wide.
    labels, count = label(water & ~gap)
    if count < 2:
        return [(water, np.zeros_like(water))]
    parts = [labels == number for number in range(1, count + 1)]
    return [(part, dilation(water & ~part, _HIDDEN)) for part in parts]


def _highest(levels: Levels, chain: np.ndarray) -> _Step | None:
    """Return the highest step of a chain of reaches, if it has one."""
    heights, count = levels.heights[chain], len(chain)
    found: list[_Step] = []
    for reach in range(_LEVEL_REACHES, count - _LEVEL_REACHES):
        for end in range(reach + 1, min(reach + _WITHIN, count - _LEVEL_REACHES - 1) + 1):
            drop, length = float(heights[reach] - heights[end]), end - reach
            beside = (_slope(heights[reach::-1]), _slope(heights[end:]))
            usual = max(beside) * length
            if drop >= max(STEP, _STEEPER * usual):
                before, after = chain[max(reach - 2, 0) : reach + 1], chain[end : end + 3]
                middle = float(heights[reach] + heights[end]) / 2.0
                found.append(_Step(before, after, length, middle, drop))
    return max(found, key=lambda step: step.sharpness, default=None)


def _slope(heights: np.ndarray) -> float:
    """Return how far the level changes beside a step at most, for each reach."""
    some = np.abs(heights[1 : _BESIDE + 1] - heights[0])
    return float((some / np.arange(1, len(some) + 1)).max())


def _gap(water: np.ndarray, reaches: Reaches, step: _Step, ground: np.ndarray) -> np.ndarray:
    """Return the cells across a region at a step."""
    # No land beside the upper water is lower than the middle of the step. So it begins where the
    # first such land is, on either bank.
    near = _near(reaches, step)
    places = np.argwhere(water)
    numbers = reaches.of(places)
    # Where the water is narrow, the direction in which it flows is sure.
    sizes = np.bincount(numbers, minlength=len(near))
    pairs = [pair for side in (step.before, step.after) for pair in zip(side[:-1], side[1:])]
    start, end = reaches.places[list(min(pairs, key=lambda pair: sizes[list(pair)].sum()))]
    down = (end - start) / max(float(np.hypot(*(end - start))), 1e-9)
    turned = np.array((-down[1], down[0]))
    places = places[near[numbers]]
    land = dilation(water, _BANK) & ~water & np.isfinite(ground) & (ground < step.middle)
    banks = np.argwhere(land)
    banks = banks[near[reaches.of(banks)]]
    middle = (reaches.places[step.before[-1]] + reaches.places[step.after[0]]) / 2.0
    across = (banks - middle) @ turned
    firsts = [
        first
        for bank in (across <= 0, across > 0)
        if (first := _first((banks[bank] - middle) @ down, across[bank])) is not None
    ]
    cut = np.zeros(len(places))
    if firsts:
        along, beside = np.array(sorted(firsts, key=lambda first: first[1])).T
        if np.ptp(along) < _SLANTED:
            along[:] = along.min()
        cut = np.interp((places - middle) @ turned, beside, along)
    gap = np.zeros(water.shape, dtype=bool)
    gap[tuple(places[np.abs((places - middle) @ down - cut) <= _GAP].T)] = True
    return gap


def _near(reaches: Reaches, step: _Step) -> np.ndarray:
    """Return which reaches lie between those of a step, or beside them."""
    beside = reaches.network.matrix()
    near = np.zeros(reaches.network.size, dtype=bool)
    near[[step.before[-1], step.after[0]]] = True
    for _ in range(_WITHIN - 1):
        near |= beside @ near.astype(float) > 0
    return near


def _first(along: np.ndarray, across: np.ndarray) -> tuple[float, float] | None:
    """Return where the low land of a bank begins; a single cell does not count."""
    if len(along) < 2:
        return None
    second = np.argsort(along)[1]
    return float(along[second]) - 1.0, float(across[second])
