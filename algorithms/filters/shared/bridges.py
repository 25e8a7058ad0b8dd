"""Decks of bridges among the ground, found by cross-sections.

References
----------
Sithole, G., Vosselman, G. (2006): Bridge detection in airborne laser scanner data. ISPRS Journal of
Photogrammetry and Remote Sensing 61 (1), 33-46. From there: a bridge shows in cross-sections of the
landscape that are raised at both ends, whatever its shape, and these are joined to decks. What
tells a deck from a dam or a house is ours.
"""

from __future__ import annotations

import math

import numpy as np

from ...core.points import Points
from ...grids.morphology import within_square
from .cross_sections import Rule, Sections, raised_sections
from .relief import Relief

# At the sides of a deck the ground lies at least so much lower, and so much more for each metre of
# distance, to which this share of the spacing of the points is added.
_DROP, _DROP_SLOPE, _DROP_SPACING = 0.5, 1.0, 0.75
# Where a deck is proven, it goes on for so many metres, or spacings, if it is raised by this.
_GROWTH, _GROWTH_SPACINGS, _WEAK_RULE = 8.0, 4.0, Rule(0.25, 0.9, False)
_LEAST_AREA, _LEAST_CELLS, _LEAST_SPAN, _LEAST_SPACINGS = 12.0, 4, 3.0, 2.0
# Ground at an end must be level with the deck: metres, and metres a metre.
_LEVEL, _LEVEL_SLOPE = 0.25, 0.03
# Cross-sections at this angle to the deck are across, and at least this share must be.
_OBLIQUE, _MOSTLY = math.radians(30.0), 0.5
# So many of them cross each cell of a deck, on average. On a table mountain a few meet no point on
# the face of the cliff by chance.
_CROSSING = 2.5
# Metres of ground that must lie within some metres of an end, over this share of the deck's width.
_GROUND, _END, _CARRIED = 4.0, 12.0, 0.5
# Points so near to the surface of a deck in metres are on it.
_NEAR = 0.5


def bridge_decks(points: Points, ground: np.ndarray) -> np.ndarray:
    """Return which points lie on decks of bridges.

    A deck is level along short cross-sections, and falls at both ends of them to ground of
    nearly one height, without ground on the face; it goes on into ground of its own height at
    both of its own ends. Ramps, dams and embankments have slopes at their sides, houses and piers
    no ground at the ends: they stay what they are.

    Parameters
    ----------
    points : Points
        All points.
    ground : numpy.ndarray of bool, shape (n,)
        Which of them a filter takes for ground: all of the deck, some of it or nothing.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
        Ground and other points on the surface of a deck.
    """
    none = np.zeros(points.count, dtype=bool)
    if not ground.any():
        return none
    relief, cells = Relief.over(points, ground)
    decks, crossed = _decks(relief)
    if not decks.any():
        return none
    surface = _surface(relief, decks & crossed)
    on_deck = relief.inside(decks).ravel()[cells.index]
    surface = relief.inside(surface).ravel()[cells.index] + relief.level
    return on_deck & (np.abs(points.z - surface) <= _NEAR)


def _decks(relief: Relief) -> tuple[np.ndarray, np.ndarray]:
    """Return the cells of decks, and those that cross-sections cross.

    Other cells of decks are holes: cars, or what is seen through gaps.
    """
    from scipy import ndimage

    decks, square = np.zeros(relief.heights.shape, dtype=bool), np.ones((3, 3))
    rule = Rule(_DROP + _DROP_SLOPE * _DROP_SPACING * relief.spacing, _DROP_SLOPE, True)
    sections = raised_sections(relief, _joins_ground, rule)
    if not len(sections.steps):
        return decks, decks
    crossed = sections.cells_of(relief)
    # Along the uneven edge of a terrace what is raised at both ends is narrow.
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


def _joins_ground(relief: Relief) -> np.ndarray:
    """Return the cells of smooth surfaces of which some is ground, unlike most roofs."""
    from scipy import ndimage

    lowest, highest = (within_square(each, relief.heights, 1) for each in (np.fmin, np.fmax))
    label, _ = ndimage.label(highest - lowest <= 2.0 * relief.step)
    has_ground = np.bincount(label.ravel(), weights=relief.is_ground.ravel()) > 0
    has_ground[0] = False
    return within_square(np.maximum, has_ground[label], relief.apart + 1)


def _is_carried(relief: Relief, row: np.ndarray, column: np.ndarray, sections: Sections) -> bool:
    """Return whether the ground goes on level with some cells at both of their ends.

    They are sought along the greatest extent of the cells and across: an underpass below a wide
    road is a deck that is shorter than it is wide. Most of the cross-sections must lie across:
    along the uneven edge of a terrace they run with it.
    """
    _, axes = np.linalg.eigh(np.cov(row, column))
    for up, right in axes.T:
        oblique = np.abs(np.sin(sections.angles - math.atan2(up, right))) >= math.sin(_OBLIQUE)
        mostly = sections.steps[oblique].sum() > _MOSTLY * sections.steps.sum()
        if mostly and _has_ends(relief, row, column, up, right):
            return True
    return False


def _has_ends(relief: Relief, row: np.ndarray, column: np.ndarray, up: float, right: float) -> bool:
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
    relief: Relief, row: np.ndarray, column: np.ndarray, up: float, right: float
) -> np.ndarray:
    """Return from which cells lines in a direction come to ground without a step, and stay on."""
    start = last = relief.heights[row, column]
    on, ground = np.ones(len(row), dtype=bool), np.zeros(len(row), dtype=np.intp)
    for step in range(1, int(_END / relief.cell) + 1):
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


def _surface(relief: Relief, known: np.ndarray) -> np.ndarray:
    """Return the heights of the decks, for each cell that of the nearest known one."""
    from scipy import ndimage

    unknown = ~known | np.isnan(relief.heights)
    nearest = ndimage.distance_transform_edt(unknown, return_distances=False, return_indices=True)
    return relief.heights[tuple(nearest)]


def _grown(relief: Relief, decks: np.ndarray, crossed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the same as `_decks` with what is raised beside the decks, up to a few metres off."""
    from scipy import ndimage

    reach = round(max(_GROWTH, _GROWTH_SPACINGS * relief.spacing) / relief.cell)
    near = within_square(np.maximum, decks, reach)
    weak = raised_sections(relief, lambda _: near, _WEAK_RULE).cells_of(relief) & near
    label, _ = ndimage.label(weak | decks, np.ones((3, 3)))
    return np.isin(label, np.unique(label[decks])), crossed | weak
