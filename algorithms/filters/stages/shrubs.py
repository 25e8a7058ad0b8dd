"""Shrubs and canopies that are wider than a few cells, so that their own points surround a seed."""

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

# Seeds of blocks are neighbours within this multiple of their width, but not within this share of
# it.
_REACH = 5.0
_APART = 0.5
# Places at which planes are laid at a time.
_AT_ONCE = 1 << 11


@dataclass(frozen=True)
class Shrubs(PointRule):
    """A seed above the planes of all sides through the lowest seeds of blocks is a shrub."""

    # Most of the seeds next to it may belong to the same shrub, but the lowest of a block that is
    # as wide lies beside it. Where there are few seeds, their planes reach farther than those that
    # `Plants` compares.

    stage: ClassVar = Stage.SEEDS
    writes: ClassVar = ("seeds", "waiting", "rise")

    widths: tuple[float, ...] = (2.0, 4.0)  # sides of the blocks in metres, one after another
    # Least height in metres above the planes, and the share of the width of a block that a slope of
    # 45 degrees adds to it.
    height: float = 0.3
    per_slope: float = 0.15
    misfit: float = 0.5  # the share of the misfit of a plane that is added
    # Metres: a group of such seeds that is as long is a bank or a dyke, and stays.
    longest: float = 10.0
    tallest: float = 2.0  # metres above the planes of a rock, which stays but under trees
    in_woods: float = 0.15  # least height under trees, on any slope
    # Nothing is judged where a larger share of the points round about lies near the lowest ones of
    # their cells, unless this is 1.
    most_open: float = 1.0
    steepest: float = 1.0  # where the land is steeper (rise over run), nothing is judged

    def apply(self, state: State) -> None:
        """Let the wrong seeds wait."""
        cells, woods = state.grids[0].cells, state.grids[0].woods.ravel()
        judged = np.ones(woods.size, dtype=bool)
        if self.most_open < 1.0:
            judged = (openness_of(state) < self.most_open).ravel()
        for width in self.widths:
            cell = cells.index[state.seeds]
            seeds, in_wood = state.points.take(state.seeds), woods[cell]
            wrong = self._wrong(seeds, in_wood, judged[cell], width)
            wrong &= ~self._long(cells, state.seeds, wrong, in_wood)
            state.waiting = np.append(state.waiting, state.seeds[wrong])
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
        # The planes are those round the middle of a quarter of a block, for all seeds in it.
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

        # Planes of all seeds together would take more memory than all else.
        over_parts(judge, len(occupied), _AT_ONCE, SILENT)
        wrong[doubtful] = above > limit
        wrong[doubtful] &= in_wood[doubtful] | (above < self.tallest)
        return wrong

    def _long(
        self, cells: Cells, seeds: np.ndarray, wrong: np.ndarray, in_wood: np.ndarray
    ) -> np.ndarray:
        """Return which seeds lie in long groups of cells with wrong seeds."""
        from scipy import ndimage

        # Groups may have gaps, but not under trees, where plants stand close together.
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
