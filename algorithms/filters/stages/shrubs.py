"""Seeds on shrubs and canopies that are so wide that other points on them surround these seeds."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT
from ...core.threads import over_parts
from ...grids.cells import Cells, in_order
from ...grids.gradient import steepness
from ...grids.morphology import sum_of_nine, within_square
from ..pipeline import PointRule, Stage
from ..side_planes import LEAST, Sides
from ..state import State
from .breaks import mean_surface, openness_of

# Distances between which the lowest seeds of blocks are neighbours, in widths of a block.
_APART = 0.5
_REACH = 5.0
_AT_ONCE = 1 << 11  # places at which planes are fitted at a time


@dataclass(frozen=True)
class Shrubs(PointRule):
    """A seed above the planes of all sides through the lowest seeds of blocks is on a shrub."""

    # The seeds next to it may be on the same shrub, but the lowest seed of a block that is as wide
    # as the shrub lies beside it. Where there are few seeds, these planes reach farther than those
    # of `Plants`.

    stage: ClassVar = Stage.SEEDS
    writes: ClassVar = ("seeds", "candidates", "rise")

    widths: tuple[float, ...] = (2.0, 4.0)  # sides of the blocks in metres, one after another
    # Least height in metres above the planes, and the share of the width of a block that is added
    # on a slope of 45 degrees, on others in proportion.
    height: float = 0.3
    per_slope: float = 0.15
    misfit: float = 0.5  # share of the misfit of a plane that is added to the least height
    longest: float = 10.0  # metres: longer groups of such seeds are banks or dykes, and stay
    tallest: float = 2.0  # metres: seeds as high above the planes are rocks, and stay in open land
    in_woods: float = 0.15  # least height in metres above the planes under trees, on any slope
    # Largest openness of land that is judged. 1 for all land.
    most_open: float = 1.0
    steepest: float = 1.0  # largest slope of land that is judged, rise over run

    def apply(self, state: State) -> None:
        """Demote the wrong seeds to candidates."""
        cells, woods = state.grids[0].cells, state.grids[0].woods.ravel()
        judged = np.ones(woods.size, dtype=bool)
        if self.most_open < 1.0:
            judged = (openness_of(state) < self.most_open).ravel()
        for width in self.widths:
            cell = cells.index[state.seeds]
            seeds, in_wood = state.points.take(state.seeds), woods[cell]
            wrong = self._wrong(seeds, in_wood, judged[cell], width)
            wrong &= ~self._long(cells, state.seeds, wrong, in_wood)
            state.candidates = np.append(state.candidates, state.seeds[wrong])
            state.seeds = state.seeds[~wrong]

    def _wrong(
        self, seeds: Points, in_wood: np.ndarray, judged: np.ndarray, width: float
    ) -> np.ndarray:
        """Return which of the judged seeds lie above the planes of all sides."""
        wrong = np.zeros(seeds.count, dtype=bool)
        if not _have_neighbours(seeds, (_REACH + 1.0) * width):
            return wrong
        blocks = Cells.over(seeds, width)
        lowest = blocks.lowest_points(seeds)
        mean = mean_surface(seeds, lowest, blocks, width)
        slope = steepness(mean, width).ravel()[blocks.index]
        doubtful = np.flatnonzero(judged & (slope <= self.steepest))
        least = np.where(in_wood, self.in_woods, self.height)[doubtful]
        x, y, z = seeds.take(doubtful)
        doubtful = doubtful[z - blocks.interpolated(mean, x, y) > least]
        # All seeds in a quarter of a block are compared with the planes at the middle of it.
        quarters = Cells.over(seeds, width / 2.0)
        doubtful = doubtful[in_order(quarters.index[doubtful])]
        open_ = self.height + self.per_slope * width * slope[doubtful]
        limit = np.where(in_wood[doubtful], self.in_woods, open_)
        occupied, first = np.unique(quarters.index[doubtful], return_index=True)
        row, column = np.divmod(occupied, quarters.columns)
        x, y = (
            (np.array(number) + start + 0.5) * quarters.size
            for number, start in ((column, quarters.first_column), (row, quarters.first_row))
        )
        middles = Points(x, y, blocks.interpolated(mean, x, y))
        sides = Sides(seeds.take(lowest), _REACH * width, _APART * width, blocks)
        ends, above = np.append(first, len(doubtful)), np.empty(len(doubtful))

        def judge(part: slice) -> None:
            group, places = slice(ends[part.start], ends[part.stop]), middles.take(part)
            starts = ends[part.start : part.stop] - group.start
            inside = np.repeat(np.arange(places.count), np.diff(ends[part.start : part.stop + 1]))
            x, y, z = (seed[doubtful[group]] - place[inside] for seed, place in zip(seeds, places))

            def rises(*planes: np.ndarray) -> np.ndarray:
                rise, east, north, misfit = planes
                return (rise - self.misfit * misfit).T.take(inside, axis=-1) + (
                    z - east.T.take(inside, axis=-1) * x - north.T.take(inside, axis=-1) * y
                )

            def are_right(_: slice, *planes: np.ndarray) -> np.ndarray:
                return np.logical_and.reduceat(rises(*planes) <= limit[group], starts)

            above[group] = np.fmin.reduce(rises(*sides.planes(places, enough=are_right)), axis=0)

        # Part by part, because planes at all places would take much memory.
        over_parts(judge, len(occupied), _AT_ONCE, SILENT)
        wrong[doubtful] = above > limit
        wrong[doubtful] &= in_wood[doubtful] | (above < self.tallest)
        return wrong

    def _long(
        self, cells: Cells, seeds: np.ndarray, wrong: np.ndarray, in_wood: np.ndarray
    ) -> np.ndarray:
        """Return which seeds lie in groups of cells with wrong seeds that are banks or dykes."""
        from scipy import ndimage

        # Groups may have gaps of a cell, but not under trees, where plants stand close together.
        near = within_square(np.maximum, cells.holding(seeds[wrong & ~in_wood]), 1)
        groups, _ = ndimage.label(near | cells.holding(seeds[wrong]), np.ones((3, 3)))
        extents = [
            max(rows.stop - rows.start, columns.stop - columns.start)
            for rows, columns in ndimage.find_objects(groups)
        ]
        is_long = np.array([0, *extents]) * cells.size >= self.longest
        return is_long[groups.ravel()[cells.index[seeds]]]


def _have_neighbours(seeds: Points, reach: float) -> bool:
    """Return whether there are somewhere as many seeds within the reach as a plane needs."""
    # Sparse land has none, and a grid of blocks over it would cost more than all other rules.
    counts = Cells.over(seeds, reach).counts
    return bool(sum_of_nine(np.pad(counts, 1)).max() >= LEAST)
