"""Lines as points: places along them, and the level of water that falls along one."""

from __future__ import annotations

import numpy as np

from ..core.points import Box

# Stations to each side of one along a river that say how high the water is there.
_STATIONS = 5


def along(line: np.ndarray, step: float, is_closed: bool = False) -> np.ndarray:
    """Return places along a line, its corners among them, no farther apart than a step.

    Parameters
    ----------
    line : numpy.ndarray of float64, shape (n, 3)
        x, y and z of its corners.
    step : float
        In the unit of x and y.
    is_closed : bool
        Whether the line goes back from its end to its beginning.

    Returns
    -------
    numpy.ndarray of float64, shape (m, 3)
        z lies on the line as well; NaN between corners of which one has none.

    Examples
    --------
    >>> along(np.array([[0.0, 0.0, 1.0], [2.0, 0.0, 3.0]]), 1.0).tolist()
    [[0.0, 0.0, 1.0], [1.0, 0.0, 2.0], [2.0, 0.0, 3.0]]
    """
    if is_closed and len(line) and not np.array_equal(line[0, :2], line[-1, :2]):
        line = np.concatenate((line, line[:1]))
    if len(line) < 2:
        return line
    lengths = np.hypot(*np.diff(line[:, :2], axis=0).T)
    counts = np.maximum(np.ceil(lengths / step), 1).astype(np.int64)
    segment = np.repeat(np.arange(len(counts)), counts)
    first = np.cumsum(counts) - counts
    share = (np.arange(len(segment)) - first[segment]) / counts[segment]
    start, end = line[segment], line[segment + 1]
    return np.concatenate((start + share[:, None] * (end - start), line[-1:]))


def inside_grid(box: Box, step: float) -> np.ndarray:
    """Return places of a grid in a box whose lines are multiples of a step, shape (n, 2)."""
    west, south, east, north = box
    x, y = (
        np.arange(np.ceil(low / step), np.floor(high / step) + 1) * step
        for low, high in ((west, east), (south, north))
    )
    return np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)


def falling(
    line: np.ndarray,
    border: np.ndarray,
    heights: np.ndarray,
    places: np.ndarray,
    percentile: float,
) -> np.ndarray:
    """Return the level of water at some places, which falls along a line and nowhere rises.

    Parameters
    ----------
    line : numpy.ndarray of float64, shape (n, 2)
        Stations along the river, in order, up or down.
    border : numpy.ndarray of float64, shape (m, 2)
        Places on its banks.
    heights : numpy.ndarray of float64, shape (m,)
        Heights of the ground there; NaN where it is not known, but not everywhere.
    places : numpy.ndarray of float64, shape (k, 2)
        Where the level is wanted.
    percentile : float
        The level at a station is this percentile of the heights of the banks beside it.

    Returns
    -------
    numpy.ndarray of float64, shape (k,)
    """
    from scipy.spatial import cKDTree

    tree, known = cKDTree(line), ~np.isnan(heights)
    station, heights = tree.query(border[known])[1], heights[known]
    order = np.argsort(station, kind="stable")
    station, heights = station[order], heights[order]
    every = np.arange(len(line))
    firsts = np.searchsorted(station, every - _STATIONS)
    lasts = np.searchsorted(station, every + _STATIONS, side="right")
    filled = np.flatnonzero(lasts > firsts)
    levels = np.array(
        [np.percentile(heights[firsts[each] : lasts[each]], percentile) for each in filled]
    )
    levels = np.interp(every, filled, levels)
    half = max(len(line) // 2, 1)
    if levels[:half].mean() >= levels[-half:].mean():
        levels = np.minimum.accumulate(levels)
    else:
        levels = np.minimum.accumulate(levels[::-1])[::-1]
    return levels[tree.query(places)[1]]
