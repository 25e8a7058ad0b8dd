"""Finds lakes and rivers: regions with hardly any last return, whose shore is level.

Lasers get few returns from water. A void is also a gap between strips, the outside of the survey,
or a roof that swallows light. So the shore must be level, or fall steadily along a river, and the
land must rise from it; or the points there have class 9. A level shore as a mark of water, and its
spread as a measure of quality, are those of r.hydro.flatten of GRASS.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Callable, Iterator, NamedTuple

import numpy as np

from ...core.parameters import ParameterSet, parameter
from ...core.progress import SILENT, Progress
from ...grids.morphology import closing, dilation, erosion
from ..rasters.constraints import STATION
from .body import WaterBody, divided, rings_of
from .bridges import below_decks, beside_decks
from .extent import surveyed
from .grid import WaterGrid
from .levels import Levels, Shore, lake_level, margin, river_level, shore_of, surface_of
from .steps import STEP, parts_of_step
from .surfaces import level_surfaces

# Radius in cells of the disc that closes single stray cells, and of that which cuts thin links.
_CLOSE, _OPEN = 1.5, 1.5
# Radius in cells of the disc that closes gaps between points of class 9 alone.
_CLOSE_CLASS = 3.5
# Fewest segments of a shore.
_FEWEST = 3
# Islands smaller than this, in square metres, belong to the water.
_LEAST_ISLAND = 100.0
# Spread in metres of a shore from its level, up to which it is water. In coarse cells, banks have
# so many metres for each metre of a cell.
_MOST_SPREAD, _SPREAD_A_METRE = 0.3, 0.12
# Share of the shore from which the land rises if it is one of banks: in few points, twice that
# spread is that of the places along the bank where these happen to lie.
_RISING_FROM_BANKS = 0.8
# A river falls by so many metres, is so many times as long as wide, and its shore fits a falling
# level so much better than one level.
_FALL, _ELONGATED, _BETTER = 0.15, 3.0, 0.8
# Least share of the shore with ground, and of its segments from which the land rises by so much.
_LEAST_KNOWN, _LEAST_RISING, _RISE = 0.2, 0.6, 0.05
# The same share where a region goes on beyond the survey: its border on flat land is level, too.
_LEAST_RISING_OUTSIDE = 0.75
# Cells this near to the shore can hold its bank.
_BANK = 2.0
# Returns so many metres above the level are not water; most share of cells with such.
_ABOVE, _MOST_ABOVE = 2.0, 0.05
# Most returns inside lie at most so far from the level, in metres, unless they are as few.
_MOST_OFF = 0.5
# Share of class 9 among the points from which a region needs no rising shore.
_CLASSIFIED = 0.5
# A part of water beyond a step of its level has at least this share of the smallest area.
_LEAST_PART = 0.1
# Most certainty where a part of the shore is farther from the level than the spread of water, or
# the whole shore has such a spread, in metres.
_MOST_MISFITTING, _CERTAIN_SPREAD = 0.7, 0.25


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


class _Region(NamedTuple):
    """Connected cells, with a margin."""

    water: np.ndarray
    below: np.ndarray  # those below decks of bridges
    outside: np.ndarray  # those beyond the points of the survey
    level: np.ndarray  # those of dead-level surfaces full of returns
    rows: slice
    columns: slice
    other: np.ndarray | None = None  # cells of water with another level, and those beside it

    @property
    def open(self) -> np.ndarray:
        """The cells that the laser sees."""
        return self.water & ~self.below & ~self.outside


class _Marks(NamedTuple):
    """What tells the level of a region."""

    shore: Shore
    share: float  # of class 9
    rising: float  # share of the shore from which the land rises


_Measure = Callable[[_Region, WaterGrid], "_Marks | None"]


def find_water(grid: WaterGrid, how: Water, progress: Progress = SILENT) -> list[WaterBody]:
    """Return the water of a survey, from north to south."""
    usual, outside = grid.usual(), ~surveyed(grid.counts > 0)
    covered = np.zeros(grid.shape, dtype=bool)
    found: list[WaterBody] = []
    # Level surfaces full of returns are water only where there is none by its voids and shore.
    for number in range(2):
        level = np.zeros(grid.shape, dtype=bool)
        if number:
            level = level_surfaces(grid, outside, how.min_area / grid.cell**2) & ~covered
            if not level.any():
                break
        part = progress.part(number / 2.0, (number + 1) / 2.0)
        for region in _regions(grid, how, outside, level, covered, part):
            if number and not region.level.any():
                continue
            bodies = _water_of(region, grid, usual, how)
            if bodies:
                covered[region.rows, region.columns] |= region.water
            found += bodies
    return sorted(found, key=lambda each: (-each.rings[0][:, 1].max(), each.rings[0][:, 0].min()))


def _water_of(region: _Region, grid: WaterGrid, usual: np.ndarray, how: Water) -> list[WaterBody]:
    """Return the water of a region, perhaps without what no point shows."""
    bodies = list(_bodies_of(region, grid, usual, how))
    for unseen in (region.outside, region.below, region.outside | region.below):
        if bodies or not unseen.any():
            continue
        seen = _without_links(region.water & ~unseen)
        for part in _labelled(seen, how.min_area / grid.cell**2):
            alone = region._replace(
                water=part, below=region.below & part, outside=region.outside & part
            )
            bodies += _bodies_of(alone, grid, usual, how)
    return bodies


def _regions(
    grid: WaterGrid,
    how: Water,
    outside: np.ndarray,
    level: np.ndarray,
    covered: np.ndarray,
    progress: Progress,
) -> Iterator[_Region]:
    """Yield the connected regions that are large enough, without those that are covered."""
    from scipy.ndimage import find_objects, label

    cells = _without_links(closing(grid.candidates() | level, _CLOSE) & ~covered)
    below = below_decks(cells, grid)
    cells |= below
    labels, _ = label(cells)
    sizes = np.bincount(labels.ravel())
    reach, least = margin(), how.min_area / grid.cell**2
    boxes = find_objects(labels)
    for number, box in enumerate(boxes, start=1):
        progress(number / len(boxes))
        if sizes[number] < least:
            continue
        rows, columns = (
            slice(max(each.start - reach, 0), min(each.stop + reach, side))
            for each, side in zip(box, grid.shape)
        )
        water = labels[rows, columns] == number
        water = _with_small_islands(water, grid.cell)
        below_deck, beyond, is_level = (
            water & each[rows, columns] for each in (below, outside, level)
        )
        yield _Region(water, below_deck, beyond, is_level, rows, columns)


def _without_links(cells: np.ndarray) -> np.ndarray:
    """Return cells without thin links."""
    # Cells beyond the survey must not eat its border away.
    kept = erosion(cells.view(np.uint8), _OPEN).view(bool)
    return cells & dilation(kept, _OPEN)


def _with_small_islands(water: np.ndarray, cell: float) -> np.ndarray:
    from scipy.ndimage import label

    others, count = label(np.pad(~water, 1, constant_values=True), np.ones((3, 3)))
    sizes = np.bincount(others.ravel(), minlength=count + 1)
    small = sizes * cell**2 < _LEAST_ISLAND
    small[others[0, 0]] = False
    return water | small[others[1:-1, 1:-1]]


def _bodies_of(
    region: _Region, grid: WaterGrid, usual: np.ndarray, how: Water
) -> Iterator[WaterBody]:
    """Yield a region as water; if it is something else, its parts of class 9."""
    window = region.rows, region.columns
    is_class = region.water & grid.class_in(*window)
    if not region.open.any():
        return
    if (is_class | region.level)[region.open].mean() < _CLASSIFIED:
        bodies = _parts_of(region, _by_shore, grid, usual, how)
        if bodies:
            yield from bodies
            return
    classified = closing(is_class, _CLOSE_CLASS) | region.level | region.below
    for cells in _labelled(classified, how.min_area / grid.cell**2):
        cells = _with_small_islands(cells, grid.cell)
        part = region._replace(water=cells, below=cells & region.below)
        yield from _parts_of(part, _by_class, grid, usual, how)


def _by_shore(region: _Region, grid: WaterGrid) -> _Marks | None:
    """Return what tells the level of a region with a shore; None if that is not one of water."""
    window = region.rows, region.columns
    hidden = beside_decks(grid, *window)
    if region.other is not None:
        hidden = hidden | region.other
    shore = shore_of(region.water, grid.ground[window], grid.cell, hidden)
    rising = _rising(shore)
    least = _LEAST_RISING_OUTSIDE if region.outside.any() else _LEAST_RISING
    if shore is None or shore.known < _LEAST_KNOWN or rising < least:
        return None
    return _Marks(shore, _share_of_class(region, grid), rising)


def _by_class(region: _Region, grid: WaterGrid) -> _Marks:
    """Return what tells the level of a region of class 9, or of a level surface: its points."""
    window = region.rows, region.columns
    is_class = region.water & (grid.class_in(*window) | region.level)
    shore = surface_of(is_class, grid.lowest[window], grid.cell)
    return _Marks(shore, _share_of_class(region, grid), 1.0)


def _share_of_class(region: _Region, grid: WaterGrid) -> float:
    is_class = grid.class_in(region.rows, region.columns)[region.open]
    return float(is_class.mean()) if len(is_class) else 0.0


def _parts_of(
    region: _Region, measured: _Measure, grid: WaterGrid, usual: np.ndarray, how: Water
) -> list[WaterBody]:
    """Return a region as water, or what it falls into at steps of its level."""
    marks = measured(region, grid)
    if marks is None or len(marks.shore.lowest) < _FEWEST:
        return []
    surface = _inner_returns(region.open, grid.lowest[region.rows, region.columns])
    banks = marks.rising >= _RISING_FROM_BANKS and not region.outside.any()
    most = max(_MOST_SPREAD, _SPREAD_A_METRE * grid.cell)
    most *= 1.0 + (marks.share >= _CLASSIFIED or banks)
    kind, levels = _levels_of(region.water, marks.shore, surface, most)
    if kind == "river":
        parts = parts_of_step(region.water, levels, grid.ground[region.rows, region.columns])
        if len(parts) == 1:
            # The water goes round a step, where its level is that of neither side.
            levels = levels._replace(misfit=max(levels.misfit, STEP))
            parts = []
        bodies: list[WaterBody] = []
        for cells, other in parts:
            if np.count_nonzero(cells) * grid.cell**2 >= _LEAST_PART * how.min_area:
                beside = other if region.other is None else other | region.other
                part = region._replace(water=cells, below=region.below & cells, other=beside)
                bodies += _parts_of(part, measured, grid, usual, how)
        if bodies:
            return bodies
    return _body_of(region, marks, (kind, levels, surface), most, grid, usual, how)


def _labelled(cells: np.ndarray, least: float) -> Iterator[np.ndarray]:
    """Yield the connected regions with at least so many cells."""
    from scipy.ndimage import label

    labels, _ = label(cells)
    for number in np.flatnonzero(np.bincount(labels.ravel()) >= least):
        if number:
            yield labels == number


def _body_of(
    region: _Region, marks: _Marks, measured: tuple[str, Levels, np.ndarray], most: float,
    grid: WaterGrid, usual: np.ndarray, how: Water,
) -> list[WaterBody]:  # fmt: skip
    """Return a region as water; nothing if its level is not that of water."""
    kind, levels, surface = measured
    width = levels.width * grid.cell
    if levels.spread > most or width < (how.min_width if kind == "river" else 0.0):
        return []
    if not _is_free(surface, levels):
        return []
    filled = _filled(region, grid, usual)
    certainty = _certainty(max(1.0 - filled, marks.share), levels.spread, marks.rising)
    if levels.misfit > _MOST_SPREAD or levels.spread > _CERTAIN_SPREAD:
        certainty = min(certainty, _MOST_MISFITTING)
    if (
        marks.share < _CLASSIFIED
        and (region.water & region.level).mean() > 0.5 * region.water.mean()
    ):
        # A field can be as even, and lie as low.
        certainty = min(certainty, _MOST_MISFITTING)
    return [_made(kind, region, grid, levels, (certainty, marks.share, filled, width))]


def _rising(shore: Shore | None) -> float:
    """Return the share of segments of a shore from which the land rises."""
    if shore is None:
        return 0.0
    known = shore.rises[~np.isnan(shore.rises)]
    return float((known > _RISE).mean()) if len(known) else 0.0


def _levels_of(
    water: np.ndarray, shore: Shore, surface: np.ndarray, most: float
) -> tuple[str, Levels]:
    """Return the kind of water, and its level; a shore is at most so far from it."""
    flat, falling = lake_level(water, shore, surface), river_level(water, shore, surface)
    if falling is None:
        return "lake", flat
    is_long = falling.length >= _ELONGATED * falling.width
    fits = falling.spread < _BETTER * flat.spread
    if not is_long:
        # A river that flows into a wide lake is a small part of the shore.
        fits = flat.misfit > most and falling.misfit < flat.misfit / 2.0
    if fits and np.ptp(falling.heights) >= _FALL:
        return "river", falling
    # A long region with one level is a river that hardly falls, or a long lake: both are flat.
    return "lake", flat._replace(width=falling.width) if is_long else flat


def _inner_returns(water: np.ndarray, lowest: np.ndarray) -> np.ndarray:
    """Return row, column and height of the lowest returns in a region, away from its banks; cells
    without returns have the height NaN.
    """
    inner = erosion(np.pad(water, 1).view(np.uint8), _BANK).view(bool)[1:-1, 1:-1]
    rows, columns = np.nonzero(inner)
    heights = lowest[rows, columns].astype(np.float64)
    heights[~np.isfinite(heights)] = np.nan
    return np.column_stack((rows, columns, heights))


def _is_free(inner: np.ndarray, levels: Levels) -> bool:
    """Return whether what lies in a region is at its level, away from its banks."""
    known = inner[~np.isnan(inner[:, 2])]
    if not len(known):
        return True
    off = known[:, 2] - levels.at(known[:, :2])
    few = _MOST_ABOVE * len(inner)
    above, elsewhere = np.count_nonzero(off > _ABOVE), np.count_nonzero(np.abs(off) > _MOST_OFF)
    return bool(above <= few and elsewhere <= max(few, len(off) / 2.0))


def _filled(region: _Region, grid: WaterGrid, usual: np.ndarray) -> float:
    """Return the number of last returns relative to that of as much land."""
    counts = grid.counts[region.rows, region.columns][region.open]
    expected = grid.by_cell(usual, region.rows, region.columns)[region.open]
    return float(min(counts.sum() / max(expected.sum(), 1e-9), 1.0))


def _certainty(evidence: float, spread: float, rising: float) -> float:
    """Return how certain it is that a region is water, 0 to 1."""
    level = max(1.0 - spread / (2.0 * _MOST_SPREAD), 0.0)
    return float(evidence * level * rising) ** (1.0 / 3.0)


def _made(
    kind: str,
    region: _Region,
    grid: WaterGrid,
    levels: Levels,
    figures: tuple[float, float, float, float],
) -> WaterBody:
    """Return a region as water with coordinates."""
    certainty, share, filled, width = figures
    start = np.array((region.rows.start + grid.row, region.columns.start + grid.column))

    def placed(places: np.ndarray) -> np.ndarray:
        y, x = ((places + start + 0.5) * grid.cell).T
        return np.column_stack((x, y, levels.at(places)))

    rings = rings_of(region.water)
    if kind == "river":
        # The level also changes between the corners.
        rings = [divided(each, STATION / grid.cell) for each in rings]
    lines = (np.column_stack((placed(each[:, :2])[:, :2], each[:, 2])) for each in levels.lines)
    high, low = float(levels.heights.max()), float(levels.heights.min())
    return WaterBody(
        kind, tuple(map(placed, rings)), tuple(lines), high, low, levels.spread,
        certainty, float(region.water.sum()) * grid.cell**2, width, share, filled,
    )  # fmt: skip
