"""Low, narrow banks of earth, which openings cut off as they cut off a hedge."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Iterator

import numpy as np

from ...core.points import Points
from ...grids.morphology import within_square
from ...grids.planes import plane_slopes
from ..pipeline import PointRule, Stage
from ..state import State

_LEAST_SQUARE = 1e-6  # added to the variances of places, in square metres
_RAISED = 0.3  # share of the height of a strip above which points are compared with its crest
_UNEVEN = 0.1  # largest share of a strip that may be lower than its crest
_HIGH = 90.0  # percentage of the heights that are below this crest: the others are of bushes


@dataclass(frozen=True)
class Bunds(PointRule):
    """The points of a low, narrow strip are seeds if smooth sides lead up to it from the ground."""

    # The heights of a hedge vary from point to point. At the sides of a wall, of a row of panels or
    # of cars, points are not at all heights, or they lie on an upright face.

    stage: ClassVar = Stage.SEEDS
    writes: ClassVar = ("seeds",)

    area: float = 50.0  # least area in square metres
    height: float = 1.2  # largest median height above the ground in metres
    width: float = 6.0  # largest width in metres
    # Sides are what lies between these shares of the height, in classes of height. Each class has
    # at least the share `least` of their mean number of points.
    sides: tuple[float, float] = (0.1, 0.8)
    classes: int = 5
    least: float = 0.4
    share: float = 0.3  # least share of the points above the lower limit that are on the sides
    top: float = 2.5  # metres above the ground from which on points are those of trees
    nearest: int = 6  # number of nearest points through which a plane is laid at each point
    # Largest median distance of the points from these planes, as a share of the height.
    smooth: float = 0.06
    steepest: float = 1.7  # largest median slope of these planes, rise over run
    # Bushes in a row have smooth sides, too, but no crest: `beside` metres beyond half its width, a
    # strip has at least this share of the height that it has within `along` metres.
    beside: float = 1.0
    along: float = 6.0
    crest: float = 0.85

    def apply(self, state: State) -> None:
        """Add the points of banks to the seeds."""
        banks = [
            which[self.on_bank(state.points.take(which), above, half)]
            for which, above, half in self._strips(state)
        ]
        if banks:
            # `numpy.union1d` takes a hundred times as long.
            seeds = np.zeros(state.points.count, dtype=bool)
            for some in (state.seeds, *banks):
                seeds[some] = True
            state.seeds = np.flatnonzero(seeds)

    def _strips(self, state: State) -> Iterator[tuple[np.ndarray, np.ndarray, float]]:
        """Yield the points of each low, narrow strip without seeds and of the cells beside it,
        their heights above the surface of the seeds, and half the width of its cells in metres.
        """
        from scipy import ndimage

        grid, points, size = state.grids[0], state.points, state.grids[0].cells.size
        has_seed = grid.cells.holding(state.seeds)
        raised = grid.heights.known & ~has_seed
        number, count = ndimage.label(within_square(np.maximum, raised, 1), np.ones((3, 3)))
        number[~raised] = 0
        fits = np.bincount(number.ravel(), minlength=count + 1) * size**2 >= self.area
        fits[0] = False
        if not fits.any():
            return
        surface, all_of_them = grid.heights.where(has_seed).filled(), np.arange(count + 1)
        inside = ndimage.distance_transform_cdt(np.pad(raised, 1), "chessboard")[1:-1, 1:-1]
        half = size * ndimage.maximum(inside, number, all_of_them)
        fits &= 2 * half <= self.width + size
        above = np.where(raised, grid.heights.values - surface, 0.0)
        fits &= ndimage.median(above, number, all_of_them) <= self.height
        around = within_square(np.maximum, np.where(fits[number], number, 0), 1)
        around[raised & ~fits[number]] = 0
        which = grid.cells.points_in(around > 0)
        strip = around.ravel()[grid.cells.index[which]]
        which = which[np.argsort(strip, kind="stable")]
        x, y, z = points.take(which)
        above = z - grid.cells.interpolated(surface, x, y)
        ends = np.cumsum(np.bincount(strip, minlength=count + 1))
        for each in np.flatnonzero(fits):
            part = slice(ends[each - 1], ends[each])
            is_low = above[part] <= self.top
            yield which[part][is_low], above[part][is_low], float(half[each])

    def on_bank(self, points: Points, above: np.ndarray, half: float = 1.0) -> np.ndarray:
        """Return which points (n,) of a strip are smooth parts of a bank, given their heights above
        the ground round it and half its width in metres; none if it is no bank.
        """
        if len(above) < self.nearest:
            return np.zeros(len(above), dtype=bool)
        height = float(np.percentile(above, 95.0))
        low, high = (share * height for share in self.sides)
        side, none = (above > low) & (above < high), np.zeros(points.count, dtype=bool)
        counts = np.histogram(above[side], self.classes, (low, max(high, low + 1e-9)))[0]
        if counts.min() < max(self.least * counts.mean(), 2):
            return none
        if np.count_nonzero(side) < self.share * np.count_nonzero(above > low):
            return none
        above_plane, apart, slope = _planes(points, self.nearest)
        if np.median(apart[side]) > self.smooth * height or np.median(slope[side]) > self.steepest:
            return none
        smooth = np.abs(above_plane) <= self.smooth * height
        raised = smooth & (above > _RAISED * height)
        return smooth if self._has_crest(points.take(raised), above[raised], half) else none

    def _has_crest(self, points: Points, above: np.ndarray, half: float) -> bool:
        """Return whether a strip is as high as a few metres farther along it, almost everywhere."""
        from scipy.spatial import cKDTree

        squares, square = np.unique(
            np.floor(points.x) + 1j * np.floor(points.y), return_inverse=True
        )
        highest = np.zeros(len(squares))
        np.maximum.at(highest, square, above)
        places = np.column_stack((squares.real, squares.imag))
        tree = cKDTree(places)
        here, along = (
            [np.percentile(highest[near], rank) for near in tree.query_ball_point(places, reach)]
            for reach, rank in zip((half + self.beside, self.along), (100.0, _HIGH))
        )
        lower = np.array(here) < self.crest * np.array(along)
        return len(lower) > 0 and bool(np.mean(lower) <= _UNEVEN)


def _planes(points: Points, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return, for the plane through the nearest points of each point: how far the point lies above
    it and the root mean square distance of all, in metres, and its slope, rise over run.
    """
    from scipy.spatial import cKDTree

    places = np.column_stack(points[:2])
    near = cKDTree(places).query(places, count)[1]
    middle = [axis[near].mean(axis=1) for axis in points]
    x, y, z = (axis[near] - mean[:, None] for axis, mean in zip(points, middle))
    # Where points coincide, the plane is nearly level.
    moments = ((a * b).mean(axis=1) for a, b in ((x, x), (x, y), (y, y), (x, z), (y, z)))
    xx, xy, yy, *with_z = moments
    east, north = plane_slopes(xx + _LEAST_SQUARE, xy, yy + _LEAST_SQUARE, *with_z)
    rest = z - x * east[:, None] - y * north[:, None]
    above = points.z - middle[2] - (points.x - middle[0]) * east - (points.y - middle[1]) * north
    return above, np.sqrt(np.mean(rest**2, axis=1)), np.hypot(east, north)
