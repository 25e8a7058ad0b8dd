"""What the rules of a pipeline have found out about the points and about grids of cells."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from ..core.points import Points
from ..core.progress import Progress
from ..core.threads import in_threads
from ..grids.cells import Cells, first_of_each, spacing
from ..grids.morphology import closing_by_square
from .height_grid import HeightGrid

_LEAST_SPACING = 0.01  # least spacing of points in metres; a smaller one counts as this
_IMAGE_SPACING = 0.22  # largest spacing in metres of clouds from images
_GAP = 4  # half the width in cells of the largest gaps that count as surveyed


@dataclass(frozen=True)
class RuleTime:
    """How long a rule took."""

    stage: str  # name of the stage
    name: str  # name of the rule
    seconds: float  # wall-clock time


@dataclass
class GridState:
    """The lowest points of the cells of a grid, and what is known of these cells."""

    points: Points  # the points that take part
    spacing: float  # usual distance between points in metres
    cells: Cells  # the cells
    shift: float  # metres by which the cells begin farther west and south
    lowest: np.ndarray  # intp (occupied,): The lowest point of each occupied cell
    heights: HeightGrid  # heights of the lowest points; NaN for low outliers
    woods: np.ndarray  # bool (rows, columns): Cells under trees
    raised: np.ndarray  # bool (rows, columns): Cells that stand out of the ground, so far
    objects: np.ndarray  # bool (rows, columns): Cells of objects with drops all round
    # bool (rows, columns): Cells of regions that are too low for their width to be objects for
    # certain.
    plateaus: np.ndarray
    from_images: bool = False  # as in `State`

    @classmethod
    def of(cls, points: Points, spacing: float, size: float, shift: float = 0.0) -> GridState:
        """Return the state of a grid with only its lowest points known."""
        cells = Cells.over(points, size, shift)
        lowest = cells.lowest_points(points)
        heights = np.full(cells.rows * cells.columns, np.nan)
        heights[cells.index[lowest]] = points.z[lowest]
        grid = HeightGrid(heights.reshape(cells.shape), cells.size, cells.first)
        masks = np.zeros((4, *cells.shape), dtype=bool)
        return cls(points, spacing, cells, shift, lowest, grid, *masks)

    @property
    def cell(self) -> np.ndarray:
        """The cell of each lowest point, in the flattened grid."""
        return self.cells.index[self.lowest]

    @property
    def is_ground(self) -> np.ndarray:
        """Which cells are ground so far; boolean, shape (rows, columns)."""
        return self.heights.known & ~self.raised

    @cached_property
    def surveyed(self) -> np.ndarray:
        """Which cells have a lowest point that is no outlier, or lie in a small gap."""
        return covered(self.heights.known)

    @cached_property
    def filled(self) -> np.ndarray:
        """Heights as float32, with gaps filled smoothly; beyond the survey those of its border, so
        that a roof at the border does not become wider.
        """
        from scipy import ndimage

        filled = self.heights.filled().astype(np.float32)
        if self.surveyed.all():
            return filled
        nearest = ndimage.distance_transform_edt(
            ~self.surveyed, return_distances=False, return_indices=True
        )
        return filled[tuple(nearest)]

    @cached_property
    def surface(self) -> np.ndarray:
        """Heights of the cells that are ground when this is first used, with gaps filled."""
        return self.heights.where(~self.raised).filled()

    def take_again(self, points: Points, changed: np.ndarray) -> None:
        """Take the lowest points anew in the cells of points that have `changed`."""
        self.points = points
        cells = np.zeros(self.cells.rows * self.cells.columns, dtype=bool)
        cells[self.cells.index[changed]] = True
        inside = self.cells.points_in(cells)
        inside = inside[np.isfinite(points.z[inside])]
        x, y, z = points.take(inside)
        first = first_of_each(self.cells.index[inside], cells.size, z, x, y)
        lowest = np.concatenate((self.lowest[~cells[self.cell]], inside[first]))
        self.lowest = lowest[np.argsort(self.cells.index[lowest])]
        heights = self.heights.values.ravel()
        heights[cells] = np.nan
        heights[self.cell] = points.z[self.lowest]

    def remove(self, outliers: np.ndarray) -> None:
        """Take the lowest points of a mask of cells for low outliers."""
        self.heights.values[outliers] = np.nan
        self.__dict__.pop("surveyed", None)


@dataclass
class State:
    """What the rules of a pipeline have found out about the points."""

    points: Points  # the points that take part; low noise is infinitely high
    progress: Progress  # receives progress and messages of the rule that is applied
    known_ground: np.ndarray | None = None  # bool (n,): Which points are known to be ground
    multi_return: np.ndarray | None = None  # bool (n,): Which are of pulses with several returns
    low_noise: np.ndarray | None = None  # bool (n,): Which are left out as low noise
    grids: list[GridState] = field(default_factory=list)  # one or two grids of lowest points
    # intp (k,): Indices of the points that are taken for ground, and of others that may join them.
    seeds: np.ndarray = field(default_factory=lambda: np.empty(0, dtype=np.intp))
    candidates: np.ndarray = field(default_factory=lambda: np.empty(0, dtype=np.intp))
    # float (rows, columns): Metres by which the mean surface of the seeds rises over a cell.
    rise: np.ndarray | None = None
    # float64 (rows, columns, 2): Lowest and highest height of ground points on the cells of the
    # first grid.
    limits: np.ndarray = field(default_factory=lambda: np.empty((0, 0, 2)))
    # bool (n,): Which of `points` are ground.
    ground: np.ndarray = field(default_factory=lambda: np.empty(0, dtype=bool))
    times: list[RuleTime] = field(default_factory=list)  # how long each rule took
    # int16 (rows, columns): Number, from 1, of the rule that decided each cell of the first grid;
    # negative if the cell is not ground.
    decided: np.ndarray | None = None
    _was_ground: np.ndarray | None = None
    _noted: Cells | None = None

    @cached_property
    def spacing(self) -> float:
        """Usual distance between points in metres, at least 0.01."""
        return spacing(self.points, _LEAST_SPACING)

    @property
    def has_multi_returns(self) -> bool:
        """Whether some pulse is known to have several returns."""
        return self.multi_return is not None and bool(self.multi_return.any())

    @property
    def from_images(self) -> bool:
        """Whether the points come from images: they are dense, and no pulse has several returns."""
        is_known = self.multi_return is not None
        return is_known and self.spacing <= _IMAGE_SPACING and not self.has_multi_returns

    @property
    def seed_spacing(self) -> float:
        """Usual distance between seeds in metres: at least 1, and a cell of the grid."""
        return max(self.spacing, 1.0, self.grids[0].cells.size)

    def add_low_noise(self, found: np.ndarray) -> None:
        """Leave some points out from now on, except known ground."""
        if self.known_ground is not None:
            found = found & ~self.known_ground
        if not found.any():
            return
        self.low_noise = found if self.low_noise is None else self.low_noise | found
        # Infinitely high, they are never the lowest of a cell, and not close to any surface.
        before, noise, heights = self.points, np.flatnonzero(found), self.points.z.copy()
        heights[noise] = np.inf
        self.points = Points(before.x, before.y, heights)
        self.points.found.update(before.found)  # such as the spacing
        in_threads(lambda grid: grid.take_again(self.points, noise), self.grids)

    def codes(self, not_ground: int) -> tuple[np.ndarray, float]:
        """Return the number of the rule that decided the cell of each point, plus `not_ground` if
        the cell is not ground, and the side of a cell in metres.
        """
        if self.decided is None:
            return np.zeros(self.points.count, dtype=np.uint8), 1.0
        cells = self.grids[0].cells
        codes = np.where(self.decided < 0, not_ground - self.decided, self.decided)
        return codes.astype(np.uint8).ravel()[cells.index], cells.size

    def note(self, rule: int) -> None:
        """Note that a rule decided the cells that have changed since the rule before."""
        if not self.grids:
            return
        grid = self.grids[0]
        if len(self.ground):
            is_ground = grid.cells.holding(self.ground)
        elif len(self.seeds):
            is_ground = grid.cells.holding(self.seeds)
        else:
            is_ground = grid.is_ground
        if self.decided is None or self._noted is None:
            self.decided = np.zeros(grid.cells.shape, dtype=np.int16)
            self._was_ground = ~grid.cells.occupied
        elif self._noted is not grid.cells:
            # A rule has made a finer grid, whose cells are decided as the wide ones were.
            wide, index = self.decided.ravel(), self._noted.index
            self.decided = np.zeros(grid.cells.shape, dtype=np.int16)
            self.decided.ravel()[grid.cells.index] = wide[index]
            self.decided.ravel()[grid.cells.index[grid.lowest]] = wide[index[grid.lowest]]
            self._was_ground = self.decided > 0
        self._noted = grid.cells
        changed = grid.cells.occupied & (is_ground != self._was_ground)
        self.decided[changed] = np.where(is_ground[changed], rule + 1, -rule - 1)
        self._was_ground = is_ground


def covered(known: np.ndarray) -> np.ndarray:
    """Return which cells were surveyed: cells with a height (rows, columns), and small gaps."""
    return closing_by_square(np.pad(known, _GAP), _GAP)[_GAP:-_GAP, _GAP:-_GAP]
