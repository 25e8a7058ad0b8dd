"""Which points stand far above a neighbour: the decision of the classic slope filter."""

from __future__ import annotations

import math
from typing import Iterator

import numpy as np

from ..points import Points
from ..progress import SILENT, Progress
from ..threads import in_threads, workers
from .block import Block, Rule
from .neighbourhood import Neighbourhood

# Blocks of about so many points: their tables fit into the processor's cache, and they are done in
# less than a second.
_POINTS_A_BLOCK = 250_000
# Heights above the opening depend on points so many radii away, and with them the answer.
_REACH = 3.0
# A block is so many radii wide or more, or most of the points looked at would lie round it.
_LEAST_WIDTH = 16.0
# So many values tell well enough where to cut.
_SAMPLE = 10_000
_ROUNDING = 1e-6


def stands_above(
    points: Points, rule: Rule, at_least: int = 0, progress: Progress = SILENT
) -> np.ndarray:
    """Return which points stand far above one of their neighbours.

    Parameters
    ----------
    points : Points
        All points.
    rule : Rule
        Which points are compared, and what counts.
    at_least : int
        See `Neighbourhood`.
    progress : Progress
        Receives progress.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)

    Raises
    ------
    BareEarthError
        If the points spread too far for a grid.
    """
    if at_least:
        neighbourhood = Neighbourhood(points, rule.radius, at_least)
        if not neighbourhood.same_radius:
            return _everywhere(neighbourhood, points.z, rule, progress)
    above = np.zeros(points.count, dtype=bool)

    def fill(part: tuple[np.ndarray, np.ndarray]) -> None:
        which, asked = part
        found = Block(points.take(which), rule).stands_above(asked)
        above[which[asked]] = found[asked]

    blocks = _blocks(points, rule.radius)
    done = 0
    while True:
        parts = [part for _, part in zip(range(workers()), blocks)]
        if not parts:
            return above
        in_threads(fill, parts)
        done += sum(int(np.count_nonzero(asked)) for _, asked in parts)
        progress(done / points.count)


def _blocks(points: Points, radius: float) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield points (k,) near a block as indices, and which of them belong to it (k,).

    Every point belongs to one block.
    """
    reach = _REACH * radius * (1.0 + _ROUNDING)
    sides = math.sqrt(points.count / _POINTS_A_BLOCK)
    for south, north in _intervals(points.y, sides, radius):
        strip = np.flatnonzero((points.y >= south - reach) & (points.y < north + reach))
        x, y = points.x[strip], points.y[strip]
        inside = (y >= south) & (y < north)
        sides = np.count_nonzero(inside) / _POINTS_A_BLOCK
        for west, east in _intervals(x, sides, radius):
            near = np.flatnonzero((x >= west - reach) & (x < east + reach))
            asked = inside[near] & (x[near] >= west) & (x[near] < east)
            if asked.any():
                yield strip[near], asked


def _intervals(values: np.ndarray, count: float, radius: float) -> list[tuple[float, float]]:
    """Return about `count` intervals, from -inf to inf, that hold about equally many values."""
    widest = float(np.ptp(values)) / (_LEAST_WIDTH * radius)
    count = max(math.ceil(min(count, widest)), 1)
    sample = values[:: max(len(values) // _SAMPLE, 1)]
    between = np.quantile(sample, np.arange(1, count) / count).tolist()
    return list(zip([-np.inf, *between], [*between, np.inf]))


def _everywhere(
    neighbourhood: Neighbourhood, z: np.ndarray, rule: Rule, progress: Progress
) -> np.ndarray:
    """Return the same where the neighbourhoods of some points have grown: all heights exact."""
    heights = z
    if rule.top_hat:
        eroded = neighbourhood.minimum(z, progress.part(0.0, 0.4))
        opened = neighbourhood.maximum(eroded, progress.part(0.4, 0.8))
        # Where a neighbourhood grew it may not contain the point itself from the other's view.
        heights = z - np.minimum(opened, z)
    return neighbourhood.stands_above(heights, rule.height, rule.slope, progress.part(0.8, 1.0))
