"""Decks of bridges among the ground, found by cross-sections.

References
----------
Sithole, G., Vosselman, G. (2006): Bridge detection in airborne laser scanner data. ISPRS Journal of
Photogrammetry and Remote Sensing 61 (1), 33-46. From there: a bridge of any shape has
cross-sections that are raised at both ends, and these are joined to decks. The rules that tell a
deck from a dam or a house are ours.
"""

from __future__ import annotations

import math

import numpy as np

from ..core.points import Points
from .bridge_relief import BridgeRelief
from .bridge_sections import SectionRule, Sections, raised_sections
from .morphology import within_square

_DROP = 0.5  # least height of a deck above the ground at its sides, m
_DROP_SLOPE = 1.0  # what a metre of distance adds to it, m
_DROP_SPACING = 0.75  # what is added to that distance, spacings of the points
_WEAK_RULE = SectionRule(0.25, 0.9, False)  # of cross-sections by which a deck that was found grows
_GROWTH = 8.0  # the most that it grows, m
_GROWTH_SPACINGS = 4.0  # or in spacings of the points, if that is more
_LEAST_AREA = 12.0  # of a deck, m²
_LEAST_CELLS = 4
_LEAST_SPAN = 3.0  # least length of a deck, m
_LEAST_SPACINGS = 2.0  # and in spacings of the points
_LEVEL = 0.25  # largest difference in height between a deck and the ground at its end, m
_LEVEL_SLOPE = 0.03  # what a metre of distance adds to it, m
_OBLIQUE = math.radians(30.0)  # least angle to a deck of cross-sections that lie across it
_MOSTLY = 0.5  # share of all cross-sections that must lie across it
# Least number of cross-sections through each cell of a deck, on average. On a table mountain there
# are a few, which meet no point on the face of the cliff by chance.
_CROSSING = 2.5
_GROUND = 4.0  # least length of the ground at an end of a deck, m
_END = 12.0  # distance from the end within which it lies, m
_CARRIED = 0.5  # share of the deck's width over which it does
# Largest distance in metres of points on a deck from its surface.
_NEAR = 0.5


def bridge_decks(points: Points, ground: np.ndarray, is_cleared: bool = False) -> np.ndarray:
    """Return which points (n,) lie on decks of bridges, given what a filter takes for ground: all
    of a deck, some of it or nothing.
    """
    # A deck is level along short cross-sections. At both ends of these the land drops to ground of
    # nearly one height, without ground on the drop. At both ends of the deck, ground continues at
    # the height of the deck. Ramps, dams and embankments have slopes at their sides, and houses and
    # piers have no ground at their ends. Ground that `is_cleared` is that of a classification,
    # which may have taken decks out of it, with their ends.
    none = np.zeros(points.count, dtype=bool)
    if not ground.any():
        return none
    relief, cells = BridgeRelief.over(points, ground, is_cleared)
    decks, crossed = _decks(relief)
    if not decks.any():
        return none
    surface = _surface(relief, decks & crossed)
    on_deck = relief.inside(decks).ravel()[cells.index]
    surface = relief.inside(surface).ravel()[cells.index] + relief.level
    return on_deck & (np.abs(points.z - surface) <= _NEAR)


def _decks(relief: BridgeRelief) -> tuple[np.ndarray, np.ndarray]:
    """Return the cells of decks, and the cells that cross-sections cross; others are holes: cars,
    or points that are seen through gaps.
    """
    from scipy import ndimage

    decks, square = np.zeros(relief.heights.shape, dtype=bool), np.ones((3, 3))
    rule = SectionRule(_DROP + _DROP_SLOPE * _DROP_SPACING * relief.spacing, _DROP_SLOPE, True)
    sections = raised_sections(relief, _joins_ground, rule)
    if not len(sections.steps):
        return decks, decks
    crossed = sections.cells_of(relief)
    # Areas that are raised at both ends along the uneven edge of a terrace are narrow.
    narrowest = np.ones((relief.apart + 2, relief.apart + 2))
    wide = ndimage.binary_opening(ndimage.binary_closing(crossed, square), narrowest)
    label, _ = ndimage.label(wide, square)
    counts = np.bincount(label.ravel())
    is_large = (counts * relief.cell**2 >= _LEAST_AREA) & (counts >= _LEAST_CELLS)
    of_section = label.ravel()[sections.middles(relief)]
    is_large &= np.bincount(of_section, sections.steps + 1, len(counts)) >= _CROSSING * counts
    sections = sections.take(np.argsort(of_section, kind="stable"))
    first = np.searchsorted(np.sort(of_section), np.arange(len(counts) + 1))
    for number, box in enumerate(ndimage.find_objects(label), start=1):
        if is_large[number]:
            row, column = np.nonzero(label[box] == number)
            row, column = row + box[0].start, column + box[1].start
            its_sections = sections.take(slice(first[number], first[number + 1]))
            if _is_carried(relief, row, column, its_sections):
                decks[row, column] = True
    return _grown(relief, decks, crossed) if decks.any() else (decks, crossed)


def _joins_ground(relief: BridgeRelief) -> np.ndarray:
    """Return the cells of smooth surfaces that are partly ground, unlike most roofs."""
    from scipy import ndimage

    lowest, highest = (within_square(extreme, relief.heights, 1) for extreme in (np.fmin, np.fmax))
    label, _ = ndimage.label(highest - lowest <= 2.0 * relief.step)
    has_ground = np.bincount(label.ravel(), weights=relief.is_ground.ravel()) > 0
    has_ground[0] = False
    return within_square(np.maximum, has_ground[label], relief.apart + 1)


def _is_carried(
    relief: BridgeRelief, row: np.ndarray, column: np.ndarray, sections: Sections
) -> bool:
    """Return whether ground continues at the height of some cells at both of their ends."""
    # The ends are searched along the greatest extent of the cells and across it: the deck of a wide
    # road over an underpass is shorter than wide. Most of the cross-sections must lie across the
    # deck; along the uneven edge of a terrace they run with it.
    _, axes = np.linalg.eigh(np.cov(row, column))
    for up, right in axes.T:
        oblique = np.abs(np.sin(sections.angles - math.atan2(up, right))) >= math.sin(_OBLIQUE)
        mostly = sections.steps[oblique].sum() > _MOSTLY * sections.steps.sum()
        if mostly and _has_ends(relief, row, column, up, right):
            return True
    return False


def _has_ends(
    relief: BridgeRelief, row: np.ndarray, column: np.ndarray, up: float, right: float
) -> bool:
    """Return whether cells have ground at both ends in a direction."""
    along = relief.cell * (row * up + column * right)
    span = float(np.ptp(along)) + relief.cell
    if span < max(_LEAST_SPAN, _LEAST_SPACINGS * relief.spacing):
        return False
    wanted = _CARRIED * len(along) * relief.cell / span
    aside = np.rint(column * up - row * right).astype(int)
    middle = (along.min() + along.max()) / 2.0
    for sign in (-1.0, 1.0):
        # The outermost cells at this end, one in each line along the deck.
        order = np.lexsort((sign * along, aside))
        order = order[np.append(np.diff(aside[order]) > 0, True)]
        order = order[sign * (along[order] - middle) > 0.0]
        level = _comes_to_ground(relief, row[order], column[order], sign * up, sign * right)
        if np.count_nonzero(level) < wanted:
            return False
    return True


def _comes_to_ground(
    relief: BridgeRelief, row: np.ndarray, column: np.ndarray, up: float, right: float
) -> np.ndarray:
    """Return from which cells a line in a direction meets enough level ground without a step."""
    start = last = relief.heights[row, column]
    on, ground = np.ones(len(row), dtype=bool), np.zeros(len(row), dtype=np.intp)
    farthest = _END + (_growth(relief) if relief.is_cleared else 0.0)
    for step in range(1, int(farthest / relief.cell) + 1):
        if not on.any():
            break
        there_row, there_column = row + round(step * up), column + round(step * right)
        on &= ~relief.is_outside(there_row, there_column)
        where = np.where(on, there_row, row), np.where(on, there_column, column)
        there = relief.heights[where]
        known = np.isfinite(there)
        on &= ~known | (np.abs(there - last) <= relief.step)
        last = np.where(known, there, last)
        level = np.abs(there - start) <= _LEVEL + _LEVEL_SLOPE * step * relief.cell
        ground += on & level & relief.is_ground[where]
    return ground * relief.cell >= _GROUND


def _surface(relief: BridgeRelief, known: np.ndarray) -> np.ndarray:
    """Return the heights of the decks: each cell has the height of the nearest known cell."""
    from scipy import ndimage

    unknown = ~known | np.isnan(relief.heights)
    nearest = ndimage.distance_transform_edt(unknown, return_distances=False, return_indices=True)
    return relief.heights[tuple(nearest)]


def _growth(relief: BridgeRelief) -> float:
    """Return by how many metres a deck that was found is extended at most."""
    return max(_GROWTH, _GROWTH_SPACINGS * relief.spacing)


def _grown(
    relief: BridgeRelief, decks: np.ndarray, crossed: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the grids of `_decks`, extended by raised cells up to a few metres beside decks."""
    from scipy import ndimage

    reach = round(_growth(relief) / relief.cell)
    near = within_square(np.maximum, decks, reach)
    weak = raised_sections(relief, lambda _: near, _WEAK_RULE).cells_of(relief) & near
    label, _ = ndimage.label(weak | decks, np.ones((3, 3)))
    return np.isin(label, np.unique(label[decks])), crossed | weak
