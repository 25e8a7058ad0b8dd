"""The points round a block, which only decide about the points in it.

Far from the block they matter by the surface that they lie on alone, so that the lowest of them are
enough. This saves time and memory where points are dense.
"""

from __future__ import annotations

import numpy as np

from ...core.points import Box, Points
from ...engine.store import BlockPoints
from ...filters.stages.noise import UNTHINNED
from ...grids.cells import Cells, keep_spacing

# The box that all points are in.
EVERYWHERE = (-np.inf, -np.inf, np.inf, np.inf)
# Metres from a block up to which all points are used: farther than any rule looks that counts
# points.
_NEAR = 40.0
# Side in metres of the cells of whose points only the lowest is used farther away. The cells of the
# filters are made of such cells, so that their lowest points stay.
_CELL = 0.5


def near(box: Box) -> Box:
    """Return the box round a block in which all points are used."""
    west, south, east, north = box
    return west - _NEAR, south - _NEAR, east + _NEAR, north + _NEAR


def thinned(contents: BlockPoints, box: Box) -> BlockPoints:
    """Return the points of a block and its buffer, without most of those far from a `near` box."""
    if not contents.points.count or contents.points.are_within(box):
        return contents
    stays = contents.points.within(box)
    # One side after the other, since a grid of all would have many cells in the middle.
    west, south, east, north = box
    x, y = contents.points.x, contents.points.y
    beside = (y >= south) & (y < north)
    for side in (y < south, y >= north, beside & (x < west), beside & (x >= east)):
        far = np.flatnonzero(side)
        if len(far):
            some = contents.points.take(far)
            stays[far[Cells.over(some, _CELL).lowest_points(some)]] = True
    stays |= contents.known
    return contents.take(stays)


def tell_spacing(points: Points, box: Box) -> None:
    """Let points have the spacing and the noise of those in a box, which are not thinned."""
    if points.are_within(box):
        return
    inside = points.within(box)
    if inside.any():
        keep_spacing(points, points.take(inside))
        points.found[UNTHINNED] = box
