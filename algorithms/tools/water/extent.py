"""Where a survey ends: the corners of its box without points are not water."""

from __future__ import annotations

import numpy as np


def surveyed(full: np.ndarray) -> np.ndarray:
    """Return which cells lie within the survey, the convex hull of the cells with points."""
    rows, columns = full.shape
    low, high = np.zeros(rows), np.full(rows, float(columns))
    middles = np.arange(rows) + 0.5
    for start, outwards in _edges(full):
        if abs(outwards[1]) > 1e-9:
            column = start[1] - (middles - start[0]) * outwards[0] / outwards[1]
            if outwards[1] > 0:
                high = np.minimum(high, column)
            else:
                low = np.maximum(low, column)
        else:
            high[(middles - start[0]) * outwards[0] > 0] = 0.0
    centres = np.arange(columns) + 0.5
    return (centres >= low[:, None]) & (centres <= high[:, None])


def _edges(full: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """Return a corner and the outward normal of the edges of the hull, in rows and columns."""
    from scipy.spatial import ConvexHull

    rows = np.flatnonzero(full.any(axis=1))
    if not len(rows):
        return []
    first = full[rows].argmax(axis=1)
    last = full.shape[1] - full[rows, ::-1].argmax(axis=1)
    corners = np.concatenate(
        [np.column_stack((rows + down, side)) for down in (0, 1) for side in (first, last)]
    ).astype(np.float64)
    hull = ConvexHull(corners)
    return [
        (corners[start], normal[:2]) for start, normal in zip(hull.simplices[:, 0], hull.equations)
    ]
