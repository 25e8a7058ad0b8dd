"""The lowest points of cells, where trees stand, and the first points of the ground."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.errors import NoGround
from ...core.points import Points
from ...core.progress import SILENT
from ...core.threads import in_threads, over_parts
from ...grids.cells import Cells
from ..pipeline import PointRule, Stage
from ..state import GridState, State

# Largest spacing in metres of a dense cloud, whose cells hold many points and have no gaps at
# breaks.
DENSE_SPACING = 0.17
_NO_SEED = "No point can be taken for ground with certainty."
# Openness: metres above the lowest point of a cell, beside the rise of the ground within it, up to
# which points are low; and the side in metres of the square in which they are counted.
_NEAR = 0.6
_WIDTH = 5.0
_POINTS_A_PART = 1 << 16
# What a point is on a grid.
_HIDDEN = 0  # not the lowest of its cell
_OBJECT = 1  # the lowest of its cell, but on an object, or a low outlier
_OPEN = 2  # the lowest of its cell, which may be ground
_GROUND = 3  # the lowest of its cell, which is ground


@dataclass(frozen=True)
class LowestPoints(PointRule):
    """Only the lowest point of each cell can be a seed of the ground."""

    # Where cells begin is arbitrary, so there can be a second grid, moved by half a cell.

    stage: ClassVar = Stage.LOWEST
    writes: ClassVar = ("grids",)

    size: float  # side of the cells in metres
    grids: int = 1  # 1 or 2

    def apply(self, state: State) -> None:
        """Make the grids."""
        shifts = (0.0, 0.5 * self.size)[: self.grids]
        state.grids = in_threads(
            lambda shift: GridState.of(state.points, state.spacing, self.size, shift), shifts
        )
        for grid in state.grids:
            grid.from_images = state.from_images


@dataclass(frozen=True)
class Seeds(PointRule):
    """The lowest points of ground cells are seeds; other lowest points may join them later."""

    # Of two grids, a point must be ground on each on which it is the lowest of its cell.

    stage: ClassVar = Stage.SEEDS
    writes: ClassVar = ("grids", "seeds", "candidates")

    objects_wait: bool = False  # whether lowest points on objects may join later as well
    hint: str | None = None  # what the user can check if there is no seed; None for no error

    def apply(self, state: State) -> None:
        """Take the seeds from the grids; later rules need only the first of these."""
        if len(state.grids) == 1:
            (grid,) = state.grids
            ground, is_open = self._judged(grid)
            state.seeds, state.candidates = grid.lowest[ground], grid.lowest[~ground & is_open]
        else:
            state.seeds, state.candidates = self._of_both(state)
            del state.grids[1:]  # they take four bytes a point
        if self.hint and not len(state.seeds):
            raise NoGround(f"{_NO_SEED} {self.hint}")

    def _judged(self, grid: GridState) -> tuple[np.ndarray, np.ndarray]:
        """Return which lowest points are ground, and which may be ground."""
        known = grid.heights.known
        is_open = known if self.objects_wait else known & ~grid.objects
        return grid.is_ground.ravel()[grid.cell], is_open.ravel()[grid.cell]

    def _of_both(self, state: State) -> tuple[np.ndarray, np.ndarray]:
        kinds = np.zeros((2, state.points.count), dtype=np.int8)
        for kind, grid in zip(kinds, state.grids):
            ground, is_open = self._judged(grid)
            kind[grid.lowest] = np.where(ground, _GROUND, np.where(is_open, _OPEN, _OBJECT))
        either = np.flatnonzero(kinds[0] | kinds[1])
        first, second = kinds[:, either]
        ground = (first == _GROUND) & ((second == _GROUND) | (second == _HIDDEN))
        ground |= (second == _GROUND) & (first == _HIDDEN)
        is_open = ~ground & ((first >= _OPEN) | (second >= _OPEN))
        return either[ground], either[is_open]


@dataclass(frozen=True)
class KnownGround(PointRule):
    """The lowest known ground point of each cell is a seed."""

    stage: ClassVar = Stage.SEEDS
    writes: ClassVar = ("seeds",)

    cell: float = 1.0  # side of the cells in metres

    def apply(self, state: State) -> None:
        """Add the known points to the seeds."""
        known = state.known_ground
        if known is not None and known.any():
            indices = np.flatnonzero(known)
            ground = state.points.take(indices)
            lowest = Cells.over(ground, self.cell).lowest_points(ground)
            state.seeds = np.append(state.seeds, indices[lowest])
        if not len(state.seeds):
            raise NoGround(
                f"{_NO_SEED} Check the maximum building size and the selection of points."
            )


@dataclass(frozen=True)
class Woods(PointRule):
    """A cell is under trees if many points round it are of pulses with several returns."""

    # On roofs, rocks and fields their share is below 0.1, in woods 0.25 to 1. In a file without
    # return numbers, no cell is known to be under trees.

    stage: ClassVar = Stage.LOWEST
    writes: ClassVar = ("grids",)

    share: float = 0.2  # least share of such points
    width: float = 5.0  # side in metres of the square in which they are counted

    def apply(self, state: State) -> None:
        """Find the cells under trees."""
        several = state.multi_return
        if several is None or not several.any():
            return

        def find(grid: GridState) -> None:
            grid.woods = share_around(several, grid.cells, self.width, 0.0) >= self.share

        in_threads(find, state.grids)


def share_around(counted: np.ndarray, cells: Cells, width: float, default: float) -> np.ndarray:
    """Return the share of some points in the square of `width` metres round each cell (rows,
    columns), or a default where there are none.
    """
    from scipy import ndimage

    side = max(2 * round(width / cells.size / 2.0 - 0.5) + 1, 1)
    total, found = (
        ndimage.uniform_filter(grid.astype(np.float32), side, mode="constant")
        for grid in (cells.counts, cells.counts_of(counted))
    )
    return np.where(total > 0.0, found / np.maximum(total, 1e-6), default)


def openness(points: Points, cells: Cells, lowest: np.ndarray, rise: np.ndarray) -> np.ndarray:
    """Return the share of low points round each cell (rows, columns), given the lowest point of
    each cell and the rise of the ground over a cell in metres.
    """
    # It is about 1 on open ground, on roofs and where points are sparse; under trees 0.2 to 0.6.
    heights = np.zeros(rise.size)
    heights[cells.index[lowest]] = points.z[lowest]
    highest, near = heights + rise.ravel() + _NEAR, np.empty(points.count, dtype=bool)

    def compare(part: slice) -> None:
        np.less_equal(points.z[part], highest.take(cells.index[part]), out=near[part])

    over_parts(compare, points.count, _POINTS_A_PART, SILENT)
    return share_around(near, cells, _WIDTH, 1.0)
