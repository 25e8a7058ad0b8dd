"""Which points stand far above a neighbour: the decision of the classic slope filter."""

from __future__ import annotations

import math
import threading
from typing import Callable

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT, Progress
from ...core.threads import in_threads
from .cell_bounds import CellBounds, Rule
from .neighbourhood import Neighbourhood
from .point_comparison import PointComparison

# Points of a block, about. Its tables fit into the processor's cache, and it takes less than a
# second.
_POINTS_A_BLOCK = 400_000
# Heights above the opening, and so the result, depend on points up to so many radii away.
_REACH = 3.0
# Least width of a block in radii. Otherwise most of the points that it needs would lie round it.
_LEAST_WIDTH = 16.0
# Number of values that are enough to find where to cut.
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
        When a point stands far above a neighbour.
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
            return _with_grown(neighbourhood, points, rule, progress)
    above = np.zeros(points.count, dtype=bool)
    done = 0.0
    sides = math.sqrt(points.count / _POINTS_A_BLOCK)
    for south, north in _intervals(points.y, sides, rule.radius):
        asked = (points.y >= south) & (points.y < north)
        share = np.count_nonzero(asked) / points.count
        reach = _REACH * rule.radius * (1.0 + _ROUNDING)
        near = np.flatnonzero((points.y >= south - reach) & (points.y < north + reach))
        part = progress.part(done, done + share)
        above[near] |= _of_strip(points.take(near), rule, asked[near], reach, part)
        done += share
    return above


def _of_strip(
    points: Points, rule: Rule, asked: np.ndarray, reach: float, progress: Progress
) -> np.ndarray:
    """Return which of the points asked for (n,) stand above a neighbour, block by block."""
    x, above = points.x, np.zeros(points.count, dtype=bool)
    blocks = _intervals(x, np.count_nonzero(asked) / _POINTS_A_BLOCK, rule.radius)
    caller = threading.get_ident()

    def fill(block: tuple[int, tuple[float, float]]) -> None:
        number, (west, east) = block
        near = np.flatnonzero((x >= west - reach) & (x < east + reach))
        wanted = asked[near] & (x[near] >= west) & (x[near] < east)

        def alive() -> None:
            # Progress is for the calling thread only.
            if threading.get_ident() == caller:
                progress(number / len(blocks))

        if wanted.any():
            above[near[_of_block(points.take(near), rule, wanted, alive)]] = True

    in_threads(fill, enumerate(blocks), progress)
    return above


def _of_block(
    points: Points, rule: Rule, asked: np.ndarray, alive: Callable[[], None]
) -> np.ndarray:
    """Return which of the points asked for (n,) stand above a neighbour: by cell, then exactly."""
    bounds = CellBounds(points, rule, alive)
    above, doubtful = bounds.decide(asked)
    if len(doubtful):
        above[doubtful] = PointComparison(bounds, alive).stands_above(doubtful)
    return bounds.points.as_given(above)


def _intervals(values: np.ndarray, count: float, radius: float) -> list[tuple[float, float]]:
    """Return about `count` intervals, from -inf to inf, that hold about equally many values."""
    widest = float(np.ptp(values)) / (_LEAST_WIDTH * radius)
    count = max(math.ceil(min(count, widest)), 1)
    sample = values[:: max(len(values) // _SAMPLE, 1)]
    between = np.quantile(sample, np.arange(1, count) / count).tolist()
    return list(zip([-np.inf, *between], [*between, np.inf]))


def _with_grown(
    neighbourhood: Neighbourhood, points: Points, rule: Rule, progress: Progress
) -> np.ndarray:
    """Return which points stand above a neighbour if some neighbourhoods have grown."""
    z = points.z
    if rule.top_hat:
        eroded = neighbourhood.minimum(z, progress.part(0.0, 0.4))
        opened = neighbourhood.maximum(eroded, progress.part(0.4, 0.8))
        # In neighbourhoods that grew, a point need not be a neighbour of its neighbours, so the
        # opening can be higher than the point.
        z = z - np.minimum(opened, z)
    rule, part = rule._replace(top_hat=False), progress.part(0.8, 1.0)
    above = stands_above(points._replace(z=z), rule, progress=part)
    for point, neighbour, distance in neighbourhood.grown_pairs():
        rise = z[point] - z[neighbour]
        above[point[(rise >= rule.height) & (rise > rule.slope * distance)]] = True
    return above
