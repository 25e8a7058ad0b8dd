"""Finds lakes and rivers: regions with hardly any last return, whose shore is level.

Lasers get few returns from water. A void is also a gap between strips, the outside of the survey,
or a roof that swallows light. So the shore must be level, or fall steadily along a river, and the
land must rise from it; or the points there have class 9. A level shore as a mark of water, and its
spread as a measure of quality, are those of r.hydro.flatten of GRASS.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Iterator, NamedTuple

import numpy as np

from ...core.parameters import ParameterSet, parameter
from ...core.progress import SILENT, Progress
from ...grids.isolines import rings_of
from ...grids.lines import along
from ...grids.morphology import closing, dilation, erosion
from ..rasters.constraints import STATION
from .bridges import below_decks, beside_decks
from .grid import WaterGrid, Window, regions_of
from .level_areas import level_areas
from .levels import (
    FEW_RETURNS,
    MARGIN,
    STEP,
    Levels,
    Shore,
    levels_of,
    parts_of_step,
    shore_of,
    surface_of,
)

_CLOSE = 1.5  # radius of the disc that closes single stray cells, cells
_OPEN = 1.5  # radius of the disc that cuts thin links, cells
# Radius in cells of the disc that closes gaps where only points of class 9 show the water.
_CLOSE_CLASS = 3.5
# Fewest segments of a shore.
_FEWEST = 3
# Islands smaller than this, in square metres, belong to the water.
_LEAST_ISLAND = 100.0
_MOST_SPREAD = 0.3  # spread of a shore from its level up to which it is water, m
_SPREAD_A_METRE = 0.12  # spread of banks in coarse cells, m for each metre of a cell
# Least share of the shore from which the land rises for a shore with banks. Such a shore may have
# twice the spread, since sparse points lie at different heights of the bank.
_RISING_FROM_BANKS = 0.8
_LEAST_KNOWN = 0.2  # least share of the shore with ground
_LEAST_RISING = 0.6  # least share of its segments from which the land rises
_RISE = 0.05  # rise of the land that counts, m
# The same share where a region goes on beyond the survey: its border on flat land is level, too.
_LEAST_RISING_OUTSIDE = 0.75
# Cells this near to the shore can hold its bank.
_BANK = 2.0
_ABOVE = 2.0  # height above the level from which returns are not water, m
_MOST_ABOVE = 0.05  # largest share of cells with such returns
# Largest distance of most returns inside from the level, in metres, unless returns are as few.
_MOST_OFF = 0.5
# Share of class 9 among the points from which a region needs no rising shore.
_CLASSIFIED = 0.5
# A part of water beyond a step of its level, or of class 9 that the border of the survey cuts, has
# at least this share of the smallest area.
_LEAST_PART = 0.1
# Largest certainty where a part of the shore is farther from the level than `_MOST_SPREAD`.
_MOST_MISFITTING = 0.7
_CERTAIN_SPREAD = 0.25  # spread of the whole shore that has the same effect, m
# Least certainty of each grade.
GRADES = {"certain": 0.75, "likely": 0.5, "doubtful": 0.0}


@dataclass(frozen=True)
class Water(ParameterSet):
    """Which water is found."""

    min_area: float = parameter(
        8000.0,
        label="Smallest area",
        unit="m2",
        minimum=100.0,
        maximum=900_000.0,
        help="Smaller water is left out. The Lidar Base Specification asks for lakes of 8,000 m² (2"
        " acres) and more.",
    )
    min_width: float = parameter(
        30.0,
        label="Smallest width of a river",
        unit="m",
        minimum=1.0,
        maximum=10_000.0,
        help="Rivers that are narrower on average are left out. The Lidar Base Specification asks"
        " for 30 m (100 ft) and more.",
    )
    water_cell: float | None = parameter(
        None,
        kind="number",
        label="Cell size",
        unit="m",
        minimum=0.1,
        maximum=100.0,
        advanced=True,
        empty="automatic",
        help="Side of the cells in which points are counted. Empty: twice the distance between"
        " points, at least 1 m, and up to 5 m if a large survey would have too many cells.",
    )


class WaterBody(NamedTuple):
    """A lake, or a part of a river, in metres."""

    kind: str  # "lake" or "river"
    rings: tuple[np.ndarray, ...]  # float64, (n, 3): shore and islands, closed, with their level
    # float64, (m, 3): middle of each branch of a river, downstream, with its level
    lines: tuple[np.ndarray, ...]
    level: float  # of a river, at its upper end
    lowest: float  # of a river, the level at its lower end
    area: float  # square metres
    # The following figures are NaN for water of the user.
    spread: float = math.nan  # robust standard deviation of the shore from the level
    certainty: float = math.nan  # 0 to 1
    width: float = math.nan  # mean
    class_share: float = math.nan  # of cells with mostly points of class 9
    filled: float = math.nan  # number of last returns relative to land

    @property
    def grade(self) -> str:
        """The grade of certainty: certain, likely or doubtful, or given for water of the user."""
        grades = (name for name, least in GRADES.items() if self.certainty >= least)
        return next(grades, "given")


class _Region(NamedTuple):
    """Connected cells in a window with a margin; bool."""

    window: Window
    water: np.ndarray
    below: np.ndarray  # cells of it below decks of bridges
    outside: np.ndarray  # cells of it beyond the points of the survey
    level: np.ndarray  # cells of it on dead-level surfaces full of returns
    beside: np.ndarray  # cells of water with another level, and those beside it

    @property
    def open(self) -> np.ndarray:
        """The cells that the laser sees."""
        return self.water & ~self.below & ~self.outside


class _LevelEvidence(NamedTuple):
    """The evidence for the level of a region."""

    shore: Shore
    share: float  # of class 9
    rising: float  # share of the shore from which the land rises


def find_water(grid: WaterGrid, how: Water, progress: Progress = SILENT) -> list[WaterBody]:
    """Return the water of a piece of a survey, from north to south."""
    search = _Search(grid, how)
    none, covered = (np.zeros(grid.shape, dtype=bool) for _ in range(2))
    first, second = progress.shares(1.0, 1.0)
    bodies: list[WaterBody] = []
    for region in search.regions(none, covered, first):
        bodies += search.bodies_in(region, covered)
    # Level surfaces full of returns are searched only where voids and shores show no water.
    level = level_areas(grid, search.outside, search.least) & ~covered
    if level.any():
        for region in search.regions(level, covered, second):
            if region.level.any():
                bodies += search.bodies_in(region, covered)
    return sorted(bodies, key=north_first)


def north_first(body: WaterBody) -> tuple[float, float]:
    """Return a key that sorts water from north to south."""
    shore = body.rings[0]
    return -float(shore[:, 1].max()), float(shore[:, 0].min())


class _Search:
    """The search for water in a grid."""

    def __init__(self, grid: WaterGrid, how: Water) -> None:
        self.grid, self.how = grid, how
        self.usual, self.outside = grid.usual(), ~grid.surveyed()
        self.least = how.min_area / grid.cell**2  # cells

    def regions(
        self, level: np.ndarray, covered: np.ndarray, progress: Progress
    ) -> Iterator[_Region]:
        """Yield the connected regions that are large enough and not covered."""
        cells = _without_links(closing(self.grid.candidates() | level, _CLOSE) & ~covered)
        below = below_decks(cells, self.grid)
        least = _LEAST_PART * self.least
        for window, water in regions_of(cells | below, least, MARGIN, progress):
            if self._is_small(water) and not self._goes_on(water, window):
                continue
            water = self._with_small_islands(water)
            under, beyond, flat = (water & part[window] for part in (below, self.outside, level))
            yield _Region(window, water, under, beyond, flat, np.zeros_like(water))

    def _is_small(self, water: np.ndarray) -> bool:
        return int(np.count_nonzero(water)) < self.least

    def _goes_on(self, water: np.ndarray, window: Window) -> bool:
        """Return whether a region has points of class 9 and reaches the border of the survey."""
        # The margin of a window is missing only where the grid ends, as the survey does.
        beside = dilation(water, 1.5) & self.outside[window]
        ends = (water[[0, -1]].any(), water[:, [0, -1]].any(), beside.any())
        count = int(np.count_nonzero(water & self.grid.class_in(window)))
        return any(ends) and count >= FEW_RETURNS

    def _with_small_islands(self, water: np.ndarray) -> np.ndarray:
        from scipy.ndimage import label

        land, count = label(np.pad(~water, 1, constant_values=True), np.ones((3, 3)))
        small = np.bincount(land.ravel(), minlength=count + 1) * self.grid.cell**2 < _LEAST_ISLAND
        small[land[0, 0]] = False
        return water | small[land[1:-1, 1:-1]]

    def bodies_in(self, region: _Region, covered: np.ndarray) -> list[WaterBody]:
        """Return the water of a region, if need be without unseen cells, and mark it as covered."""
        bodies = self._bodies_of(region)
        for unseen in (region.outside, region.below, region.outside | region.below):
            if bodies or not unseen.any():
                continue
            for _, cells in regions_of(_without_links(region.water & ~unseen), self.least):
                below, outside = region.below & cells, region.outside & cells
                part = region._replace(water=cells, below=below, outside=outside)
                bodies += self._bodies_of(part)
        if bodies:
            covered[region.window] |= region.water
        return bodies

    def _bodies_of(self, region: _Region) -> list[WaterBody]:
        """Return a region as water, or else its parts of class 9 that are water."""
        if not region.open.any():
            return []
        is_class = region.water & self.grid.class_in(region.window)
        if (is_class | region.level)[region.open].mean() < _CLASSIFIED:
            bodies = self._parts_of(region, is_shore=True)
            if bodies:
                return bodies
        classified = closing(is_class, _CLOSE_CLASS) | region.level | region.below
        bodies = []
        for _, part in regions_of(classified, self.least):
            cells = self._with_small_islands(part)
            part_of = region._replace(water=cells, below=cells & region.below)
            bodies += self._parts_of(part_of, is_shore=False)
        return bodies

    def _marks_of(self, region: _Region, is_shore: bool) -> _LevelEvidence | None:
        """Return the evidence for the level of a region: its shore, or its points of class 9 or on
        a level surface; None for a shore that is not that of water.
        """
        grid, window = self.grid, region.window
        is_class = grid.class_in(window)
        share = float(is_class[region.open].mean()) if region.open.any() else 0.0
        if not is_shore:
            cells = region.water & (is_class | region.level)
            return _LevelEvidence(surface_of(cells, grid.lowest[window], grid.cell), share, 1.0)
        hidden = beside_decks(grid, window) | region.beside
        shore = shore_of(region.water, grid.ground[window], grid.cell, hidden)
        if shore is None or shore.known < _LEAST_KNOWN:
            return None
        known = shore.rises[~np.isnan(shore.rises)]
        rising = float((known > _RISE).mean()) if len(known) else 0.0
        least = _LEAST_RISING_OUTSIDE if region.outside.any() else _LEAST_RISING
        return _LevelEvidence(shore, share, rising) if rising >= least else None

    def _parts_of(self, region: _Region, is_shore: bool) -> list[WaterBody]:
        """Return a region as water, or its parts, into which steps of the level divide it."""
        grid = self.grid
        marks = self._marks_of(region, is_shore)
        if marks is None or len(marks.shore.lowest) < _FEWEST:
            return []
        banks = marks.rising >= _RISING_FROM_BANKS and not region.outside.any()
        most = max(_MOST_SPREAD, _SPREAD_A_METRE * grid.cell)
        most *= 1.0 + (marks.share >= _CLASSIFIED or banks)
        lowest = grid.lowest[region.window]
        surface = _inner_returns(region.open, lowest)
        is_water = region.water & grid.class_in(region.window) & np.isfinite(lowest) & is_shore
        points = np.column_stack((np.argwhere(is_water), lowest[is_water].astype(np.float64)))
        levels = levels_of(region.water, marks.shore, surface, most, points)
        parts = parts_of_step(region.water, levels, grid.ground[region.window])
        if len(parts) == 1:
            # The water goes round a step, where its level is that of neither side.
            levels = levels._replace(misfit=max(levels.misfit, STEP))
        elif parts:
            bodies = []
            for cells, beside in parts:
                if np.count_nonzero(cells) >= _LEAST_PART * self.least:
                    part = region._replace(
                        water=cells, below=region.below & cells, beside=region.beside | beside
                    )
                    bodies += self._parts_of(part, is_shore)
            if bodies:
                return bodies
        # Water that the border of the survey cuts off is judged by its width, not by its area.
        has_width = levels.reaches is not None or self._is_small(region.water)
        is_narrow = has_width and levels.width * grid.cell < self.how.min_width
        if levels.spread > most or is_narrow or not _is_free(surface, levels):
            return []
        return [self._body_of(region, marks, levels)]

    def _body_of(self, region: _Region, marks: _LevelEvidence, levels: Levels) -> WaterBody:
        """Return a region as water with its figures."""
        grid, cell = self.grid, self.grid.cell
        # The last returns, relative to those of as much land.
        expected = grid.by_cell(self.usual, region.window)[region.open].sum()
        count = grid.counts[region.window][region.open].sum()
        filled = float(min(count / max(expected, 1e-9), 1.0))
        fits = max(1.0 - levels.spread / (2.0 * _MOST_SPREAD), 0.0)
        certainty = float(max(1.0 - filled, marks.share) * fits * marks.rising) ** (1.0 / 3.0)
        is_misfit = levels.misfit > _MOST_SPREAD or levels.spread > _CERTAIN_SPREAD
        # A field can be as even, and lie as low.
        is_level = (region.water & region.level).mean() > 0.5 * region.water.mean()
        if is_misfit or (marks.share < _CLASSIFIED and is_level):
            certainty = min(certainty, _MOST_MISFITTING)
        rings = [np.pad(ring, ((0, 0), (0, 1))) for ring in rings_of(region.water)]
        if levels.reaches is not None:
            # The level also changes between the corners.
            rings = [along(ring, STATION / cell) for ring in rings]
        rings = [np.column_stack((ring[:, :2], levels.level_at(ring[:, :2]))) for ring in rings]
        rows, columns = region.window
        start = columns.start + grid.column, rows.start + grid.row

        def placed(line: np.ndarray) -> np.ndarray:
            """Return x, y and level of row, column and level."""
            return np.column_stack(((line[:, 1::-1] + start + 0.5) * cell, line[:, 2]))

        return WaterBody(
            "lake" if levels.reaches is None else "river",
            tuple(map(placed, rings)), tuple(map(placed, levels.lines())),
            float(levels.heights.max()), float(levels.heights.min()),
            float(region.water.sum()) * cell**2, levels.spread, certainty, levels.width * cell,
            marks.share, filled,
        )  # fmt: skip


def _without_links(cells: np.ndarray) -> np.ndarray:
    """Return cells without thin links."""
    # Cells beyond the survey must not eat its border away.
    return cells & dilation(erosion(cells, _OPEN), _OPEN)


def _inner_returns(water: np.ndarray, lowest: np.ndarray) -> np.ndarray:
    """Return row, column and height of the lowest returns in a region, away from its banks; cells
    without returns have the height NaN.
    """
    cells = np.argwhere(erosion(np.pad(water, 1), _BANK)[1:-1, 1:-1])
    heights = lowest[tuple(cells.T)].astype(np.float64)
    heights[~np.isfinite(heights)] = np.nan
    return np.column_stack((cells, heights))


def _is_free(inner: np.ndarray, levels: Levels) -> bool:
    """Return whether the returns in a region, away from its banks, lie at its level."""
    known = inner[~np.isnan(inner[:, 2])]
    off = known[:, 2] - levels.level_at(known[:, :2])
    few = _MOST_ABOVE * len(inner)
    above, elsewhere = np.count_nonzero(off > _ABOVE), np.count_nonzero(np.abs(off) > _MOST_OFF)
    return bool(above <= few and elsewhere <= max(few, len(off) / 2.0))
