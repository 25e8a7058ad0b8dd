"""Checkpoints that a list holds several times, such as after a join of tables."""

from __future__ import annotations

import numpy as np

# Places that differ by less, in metres, are one point with rounded or transformed coordinates.
_NEAR = 0.05
# Heights of one point that differ by more, in metres, contradict each other.
_ALIKE = 0.05


def first_at_place(places: np.ndarray) -> np.ndarray:
    """Return for each place, (n, 2) in metres, the first one that is the same point."""
    from scipy.spatial import cKDTree

    tree, first = cKDTree(places), np.full(len(places), -1)
    for place in range(len(places)):
        if first[place] < 0:
            near = np.array(tree.query_ball_point(places[place], _NEAR))
            first[near[first[near] < 0]] = place
    return first


def contradict(first: np.ndarray, heights: np.ndarray) -> np.ndarray:
    """Return which points have heights in metres, NaN for none, that differ at their place."""
    lowest, highest = heights.copy(), heights.copy()
    np.fmin.at(lowest, first, heights)
    np.fmax.at(highest, first, heights)
    return (highest - lowest)[first] > _ALIKE
