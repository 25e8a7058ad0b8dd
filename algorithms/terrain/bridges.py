"""Decks of bridges among the ground, found by cross-sections.

References
----------
Sithole, G., Vosselman, G. (2006): Bridge detection in airborne laser scanner data. ISPRS Journal of
Photogrammetry and Remote Sensing 61 (1), 33-46. From there: a bridge shows in cross-sections of the
landscape that are raised at both ends, whatever its shape, and these are joined to decks. The
grid, the rules for the drops and what tells a deck from a dam are ours.
"""

from __future__ import annotations

import itertools
import math
from typing import NamedTuple

import numpy as np

from ..points import Points
from .cells import Cells, lower_at, spacing
from .morphology import within_square

# Least side of a cell in metres; half the spacing of the points where they are sparse, in steps.
_CELL, _CELL_STEP = 1.0, 0.5
# A cell has the height of the nearest one that has a point, up to so many spacings off.
_FILLED = 1.5
# Cross-sections: how many directions, and the longest in metres.
_DIRECTIONS, _WIDEST = 48, 70.0
# A surface may rise so much from cell to cell (m, and m a metre) to be one.
_STEP, _STEP_SLOPE = 0.2, 0.2
# Along a cross-section it may be unknown over so many metres.
_GAP = 3.0
# Beyond an edge of a deck the ground must lie at least so much lower, and so much more for each
# metre of distance, to which this share of the spacing is added; no farther off than this.
_DROP, _DROP_SLOPE, _DROP_SPACING, _FOOT = 0.5, 1.0, 0.75, 6.0
# The same beyond water, or another void.
_VOID_DROP, _VOID_SLOPE, _VOID_FOOT = 2.0, 0.05, 60.0
# Where a deck is proven, its rest need only be raised so much.
_WEAK_DROP, _WEAK_SLOPE = 0.25, 0.9
_LEAST_WEAK_DROP = 0.75
# The ends of a cross-section may differ in height by so much, and so much a metre.
_TILT, _TILT_SLOPE = 0.5, 0.08
# The feet may differ by this share of the lower drop.
_FEET = 0.5
# Between this share of a drop and the rest of it no ground may lie beside the edge.
_FACE = 0.25
_LEAST_AREA, _LEAST_SPAN = 12.0, 3.0
# How far in metres a proven deck goes on.
_GROWTH = 2.0
# Ground at an end must be level with the deck: metres, and metres a metre.
_LEVEL, _LEVEL_SLOPE = 0.3, 0.1
# So many metres of it lie within so many metres, over this share of the deck's width.
_GROUND, _END, _CARRIED = 4.0, 12.0, 0.5
# Points so near to the surface of a deck in metres are on it.
_NEAR = 0.5


class _Rule(NamedTuple):
    """How far ground must lie below an edge: metres, and metres a metre of distance."""

    least: float
    drop: float
    slope: float
    looks_at_faces: bool


class _Rays(NamedTuple):
    """Straight lines over a grid, each from a cell in a direction; all are arrays (n,)."""

    row: np.ndarray
    column: np.ndarray
    up: np.ndarray
    right: np.ndarray

    def at(self, step: float | np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the row and column of the cells after so many steps."""
        row = np.rint(self.row + step * self.up).astype(np.intp)
        return row, np.rint(self.column + step * self.right).astype(np.intp)

    def take(self, which: np.ndarray) -> _Rays:
        return _Rays(*(each[which] for each in self))

    @property
    def length(self) -> np.ndarray:
        """How long a step is, in cells."""
        return np.hypot(self.up, self.right)

    def back(self) -> _Rays:
        """Return those that go the other way."""
        return self._replace(up=-self.up, right=-self.right)


class _Feet(NamedTuple):
    """Ground below edges.

    Attributes
    ----------
    height : numpy.ndarray of float, shape (n,)
        Metres; infinite where there is none.
    off : numpy.ndarray of int, shape (n,)
        How many steps it is off; 0 where there is none.
    """

    height: np.ndarray
    off: np.ndarray

    def put(self, which: np.ndarray, height: np.ndarray, off: int) -> None:
        self.height[which], self.off[which] = height, off

    def take(self, which: np.ndarray) -> _Feet:
        return _Feet(*(each[which] for each in self))


class _Sections(NamedTuple):
    """Cross-sections that are raised at both ends.

    Attributes
    ----------
    rays : _Rays
        From one end to the other.
    steps : numpy.ndarray of int, shape (n,)
        How many cells the other end is off.
    """

    rays: _Rays
    steps: np.ndarray

    def take(self, which: np.ndarray) -> _Sections:
        return _Sections(self.rays.take(which), self.steps[which])

    def cells_of(self, relief: _Relief) -> np.ndarray:
        """Return which cells of the grid they cross."""
        crossed = np.zeros(relief.heights.shape, dtype=bool)
        section = np.repeat(np.arange(len(self.steps)), self.steps + 1)
        first = np.cumsum(self.steps + 1) - (self.steps + 1)
        crossed[self.rays.take(section).at(np.arange(len(section)) - first[section])] = True
        return crossed


class _Relief(NamedTuple):
    """Heights on a grid, with a border of unknown cells round it.

    Attributes
    ----------
    cell : float
        Metres.
    spacing : float
        Metres between points; not less than the cell.
    heights : numpy.ndarray of float, shape (rows, columns)
        Of the lowest ground, else of the lowest point; NaN where there is none.
    is_ground : numpy.ndarray of bool, shape (rows, columns)
        Whether it is ground.
    """

    cell: float
    spacing: float
    heights: np.ndarray
    is_ground: np.ndarray

    @classmethod
    def over(cls, points: Points, ground: np.ndarray, cells: Cells, apart: float) -> _Relief:
        lowest, lowest_other = (np.full(cells.rows * cells.columns, np.inf) for _ in range(2))
        lower_at(lowest, cells.index, np.where(ground, points.z, np.inf))
        others = np.flatnonzero(~ground)
        lower_at(lowest_other, cells.index[others], points.z[others])
        is_ground = np.isfinite(lowest)
        heights = np.where(is_ground, lowest, lowest_other)
        heights[np.isinf(heights)] = np.nan
        heights, is_ground = heights.reshape(cells.shape), is_ground.reshape(cells.shape)
        apart = max(apart, cells.size)
        nearest = _nearest(np.isnan(heights), _FILLED * apart / cells.size)
        heights = np.pad(heights[nearest], 1, constant_values=np.nan)
        return cls(cells.size, apart, heights, np.pad(is_ground[nearest], 1))

    def inside(self, row: np.ndarray, column: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the same cells; those outside are of the border."""
        rows, columns = self.heights.shape
        return np.clip(row, 0, rows - 1), np.clip(column, 0, columns - 1)

    @property
    def steps(self) -> int:
        """The spacing in cells."""
        return round(self.spacing / self.cell)

    def smooth(self) -> np.ndarray:
        """Return which cells continue some of the eight that lie a spacing off."""
        most = _STEP + _STEP_SLOPE * self.spacing
        near, off = np.zeros(self.heights.shape, dtype=np.int8), self.steps
        heights, (rows, columns) = np.pad(self.heights, off, mode="edge"), self.heights.shape
        for up, right in itertools.product((0, off, 2 * off), repeat=2):
            beside = heights[up : rows + up, right : columns + right]
            near += np.abs(beside - self.heights) <= most
        return near > 3  # each is near itself


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
    apart = spacing(points)
    cells = Cells.over(points, max(_CELL, _CELL_STEP * round(apart / 2.0 / _CELL_STEP)))
    relief = _Relief.over(points, ground, cells, apart)
    strict = _Rule(0.0, _DROP + _DROP_SLOPE * _DROP_SPACING * relief.spacing, _DROP_SLOPE, True)
    sections = _sections(relief, _edges(relief, strict), strict)
    if not len(sections.steps):
        return none
    decks = _proven(relief, sections)
    if not decks.any():
        return none
    decks = _grown(relief, decks)
    nearest = _nearest(~decks | np.isnan(relief.heights), np.inf)
    surface = relief.heights[nearest][1:-1, 1:-1].ravel()[cells.index]
    near = np.abs(points.z - surface) <= _NEAR
    return near & decks[1:-1, 1:-1].ravel()[cells.index]


def _edges(relief: _Relief, rule: _Rule) -> np.ndarray:
    """Return which cells of a surface may have their foot near, or a void beside."""
    heights, cell = relief.heights, relief.cell
    known = np.isfinite(heights)
    lowest = np.where(relief.is_ground, heights, np.inf)
    least = np.full(heights.shape, np.inf)
    for reach in range(1, int((_FOOT + relief.spacing) / cell) + 1):
        allowed = max(rule.least, rule.drop + rule.slope * reach * cell)
        np.minimum(least, within_square(np.minimum, lowest, reach) + allowed, out=least)
    edges = heights >= least
    beside_void = within_square(np.maximum, ~known, 1) & known
    return (edges | beside_void) & relief.smooth()


def _sections(relief: _Relief, edges: np.ndarray, rule: _Rule) -> _Sections:
    """Return the cross-sections that begin at some cells and are raised at both ends."""
    row, column = np.nonzero(edges)
    angle = 2.0 * math.pi * np.arange(_DIRECTIONS) / _DIRECTIONS
    up, right = np.sin(angle), np.cos(angle)
    longest = np.maximum(np.abs(up), np.abs(right))
    count = len(row)
    rays = _Rays(
        np.repeat(row, _DIRECTIONS),
        np.repeat(column, _DIRECTIONS),
        np.tile(up / longest, count),
        np.tile(right / longest, count),
    )
    first = _feet(relief, rays.back(), rule)
    found = first.off > 0
    rays, first = rays.take(found), first.take(found)
    steps = _lengths(relief, rays)
    found = steps >= 0
    rays, first, steps = rays.take(found), first.take(found), steps[found]
    ends = _Rays(*rays.at(steps), rays.up, rays.right)
    last = _feet(relief, ends, rule)
    start, end = (relief.heights[each.row, each.column] for each in (rays, ends))
    drop = np.minimum(start - first.height, end - last.height)
    found = last.off > 0
    found &= np.abs(start - end) <= _TILT + _TILT_SLOPE * relief.cell * rays.length * (steps + 1)
    found &= np.abs(first.height - last.height) <= _FEET * drop
    if rule.looks_at_faces:
        found[found] = ~_has_face(relief, rays.back().take(found), first.take(found))
        found[found] = ~_has_face(relief, ends.take(found), last.take(found))
    return _Sections(rays.take(found), steps[found])


def _feet(relief: _Relief, rays: _Rays, rule: _Rule) -> _Feet:
    """Return the ground below the edges from which rays go out."""
    heights = relief.heights[rays.row, rays.column]
    feet = _Feet(np.full(len(heights), np.inf), np.zeros(len(heights), dtype=np.intp))
    length = relief.cell * rays.length
    left = np.arange(len(heights))
    step = 0
    while len(left):
        step += 1
        distance = step * length[left]
        row, column = relief.inside(*rays.take(left).at(step))
        allowed = heights[left] - np.maximum(rule.least, rule.drop + rule.slope * distance)
        found = relief.is_ground[row, column] & (relief.heights[row, column] <= allowed)
        feet.put(left[found], relief.heights[row, column][found], step)
        left = left[~found & (distance + length[left] <= _FOOT + relief.spacing)]
    _look_beyond_voids(relief, rays, feet)
    return feet


def _look_beyond_voids(relief: _Relief, rays: _Rays, feet: _Feet) -> None:
    """Put the feet beyond voids to those of rays that have none yet."""
    left = np.flatnonzero(feet.off == 0)
    heights, length = relief.heights[rays.row, rays.column], relief.cell * rays.length
    for step in range(1, int(_VOID_FOOT / relief.cell) + 1):
        if not len(left):
            return
        row, column = relief.inside(*rays.take(left).at(step))
        there = relief.heights[row, column]
        drop = _VOID_DROP + _VOID_SLOPE * step * length[left]
        found = relief.is_ground[row, column] & (there <= heights[left] - drop)
        feet.put(left[found], there[found], step)
        left = left[np.isnan(there)]


def _lengths(relief: _Relief, rays: _Rays) -> np.ndarray:
    """Return how many steps a surface goes on along rays; -1 where it goes on too far."""
    last = relief.heights[rays.row, rays.column].copy()
    steps, length = np.zeros(len(last), dtype=np.intp), relief.cell * rays.length
    left, step = np.arange(len(last)), 0
    while len(left):
        step += 1
        row, column = relief.inside(*rays.take(left).at(step))
        there = relief.heights[row, column]
        gap = (step - steps[left]) * length[left]
        known = np.isfinite(there)
        on = known & (
            np.abs(there - last[left]) <= _STEP + _STEP_SLOPE * np.maximum(gap, relief.spacing)
        )
        last[left[on]], steps[left[on]] = there[on], step
        left = left[on | (~known & (gap < _GAP))]
        wide = steps[left] * length[left] > _WIDEST
        steps[left[wide]] = -1
        left = left[~wide]
    return steps


def _has_face(relief: _Relief, rays: _Rays, feet: _Feet) -> np.ndarray:
    """Return where ground beside an edge lies at heights between it and its foot."""
    heights = relief.heights[rays.row, rays.column]
    drop = heights - feet.height
    low, high = feet.height + _FACE * drop, heights - _FACE * drop
    has_face = np.zeros(len(heights), dtype=bool)
    for share in (0.25, 0.5, 0.75):
        middle = rays.at(share * feet.off)
        for up, right in itertools.product((-relief.steps, 0, relief.steps), repeat=2):
            row, column = relief.inside(middle[0] + up, middle[1] + right)
            there = relief.heights[row, column]
            between = relief.is_ground[row, column] & (there > low) & (there < high)
            has_face |= between
    return has_face


def _proven(relief: _Relief, sections: _Sections) -> np.ndarray:
    """Return the cells of decks: sections that lie together, with level ground at both ends."""
    from scipy import ndimage

    decks, square = np.zeros(relief.heights.shape, dtype=bool), np.ones((3, 3))
    crossed = ndimage.binary_closing(sections.cells_of(relief), square)
    label, count = ndimage.label(crossed, square)
    cells = np.bincount(label.ravel(), minlength=count + 1)
    is_large = cells * relief.cell**2 >= _LEAST_AREA
    reach = math.ceil(_END / relief.cell)
    boxes = ndimage.find_objects(label)
    for number in (np.flatnonzero((is_large)[1:]) + 1).tolist():
        around = tuple(
            slice(max(each.start - reach, 0), each.stop + reach) for each in boxes[number - 1]
        )
        deck = label[around] == number
        part = relief._replace(heights=relief.heights[around], is_ground=relief.is_ground[around])
        if _is_carried(part, deck):
            decks[around] |= deck
    return decks


def _is_carried(relief: _Relief, deck: np.ndarray) -> bool:
    """Return whether the ground goes on level with a deck at both of its ends.

    They are sought along the greatest extent of the deck and across: an underpass below a wide
    road is a deck that is shorter than it is wide.
    """
    row, column = np.nonzero(deck & np.isfinite(relief.heights))
    _, axes = np.linalg.eigh(np.cov(row, column))
    return any(_has_ends(relief, row, column, axis) for axis in axes.T)


def _has_ends(
    relief: _Relief, row: np.ndarray, column: np.ndarray, direction: tuple[float, float]
) -> bool:
    """Return whether a deck, given by its cells, has ground at both ends in a direction."""
    up, right = direction
    along = relief.cell * (row * up + column * right)
    span = np.ptp(along) + relief.cell
    if span < max(_LEAST_SPAN, 2.0 * relief.spacing):
        return False
    width = len(along) * relief.cell**2 / span
    aside = np.rint((column * up - row * right)).astype(int)
    middle = (along.min() + along.max()) / 2.0
    for sign in (-1.0, 1.0):
        # The outermost cells at this end, one in each line along the deck.
        order = np.lexsort((sign * along, aside))
        order = order[np.append(np.diff(aside[order]) > 0, True)]
        order = order[sign * (along[order] - middle) > 0.0]
        ups, rights = np.full(len(order), sign * up), np.full(len(order), sign * right)
        level = _comes_to_ground(relief, _Rays(row[order], column[order], ups, rights))
        if np.count_nonzero(level) * relief.cell < _CARRIED * width:
            return False
    return True


def _comes_to_ground(relief: _Relief, rays: _Rays) -> np.ndarray:
    """Return which rays come from a deck to ground without a step, and stay on it."""
    last, most = relief.heights[rays.row, rays.column], _STEP + _STEP_SLOPE * relief.spacing
    on, start = np.ones(len(last), dtype=bool), last
    ground = np.zeros(len(last), dtype=np.intp)
    for step in range(1, int(_END / relief.cell) + 1):
        row, column = relief.inside(*rays.at(step))
        there = relief.heights[row, column]
        known = np.isfinite(there)
        on &= ~known | (np.abs(there - last) <= most)
        last = np.where(known, there, last)
        level = np.abs(there - start) <= _LEVEL + _LEVEL_SLOPE * step * relief.cell
        ground += on & level & relief.is_ground[row, column]
    return ground * relief.cell >= _GROUND


def _grown(relief: _Relief, decks: np.ndarray) -> np.ndarray:
    """Return decks with what is raised beside them, up to a few metres off."""
    from scipy import ndimage

    rule = _Rule(_LEAST_WEAK_DROP, _WEAK_DROP, _WEAK_SLOPE, False)
    reach = round(max(_GROWTH, 2.0 * relief.spacing) / relief.cell)
    near = within_square(np.maximum, decks, reach)
    weak = _sections(relief, _edges(relief, rule) & near, rule).cells_of(relief) & near
    label, _ = ndimage.label(weak | decks, np.ones((3, 3)))
    return np.isin(label, np.unique(label[decks]))


def _nearest(unknown: np.ndarray, farthest: float) -> tuple[np.ndarray, ...]:
    """Return the row and column of the nearest known cell of each, its own where it is too far."""
    from scipy import ndimage

    if not unknown.any():
        return tuple(np.indices(unknown.shape))
    distance, nearest = ndimage.distance_transform_edt(unknown, return_indices=True)
    return tuple(np.where(distance <= farthest, nearest, np.indices(unknown.shape)))
