"""Straight cross-sections of a relief that are raised at both ends.

References
----------
Sithole, G., Vosselman, G. (2006): Bridge detection in airborne laser scanner data. ISPRS Journal of
Photogrammetry and Remote Sensing 61 (1), 33-46: cross-sections in many directions. The definition
of a raised end is ours.
"""

from __future__ import annotations

import itertools
import math
from typing import Callable, NamedTuple

import numpy as np

from .bridge_relief import BORDER, STEP, STEP_SLOPE, BridgeRelief
from .cells import are_inside, numbered
from .morphology import within_square

_DIRECTIONS = 96  # of cross-sections, over a whole turn
_LONGEST = 70.0  # longest cross-section, m
_GAP = 3.0  # length over which the surface may be unknown along a cross-section, m
_FOOT = 6.0  # largest distance from an edge to its foot, m
_VOID_FOOT = 60.0  # the same beyond water or another void, m
_VOID_DROP = 2.0  # how much lower the ground beyond a void must be, m
_VOID_SLOPE = 0.05  # what a metre of distance adds to it, m
_TILT = 0.5  # largest difference in height between the ends of a cross-section, m
_TILT_SLOPE = 0.08  # what a metre of its length adds to it, m
# The feet may differ in height by this share of the lower drop.
_FEET = 0.5
# No ground may lie on a drop, except in the lowest and the highest part, which have this share of
# it.
_FACE = 0.25
_PIT = 0.5  # share of the drop by which the ground beyond the foot must be lower than the edge
_BEYOND = 4.0  # distance up to which this holds, m
# Distance up to which it holds at one end at least, m, as far as the relief reaches: beyond
# ditches on both sides there is land, beyond the gap between two bridges another bridge on one
# side.
_BEYOND_ONE = BORDER - _FOOT
# Radii in cells of the rings round an edge in which the lowest ground is compared with it.
_RINGS = (0, 1, 2, 4)


class SectionRule(NamedTuple):
    """How far the ground must lie below an edge."""

    drop: float  # metres
    slope: float  # further metres for each metre of distance
    is_strict: bool  # whether there must be no ground on the drop, and no rise beyond the foot


class Sections(NamedTuple):
    """Cross-sections: cells in a line."""

    # int (n,): The first cell in the flattened grid, and the number of the direction.
    start: np.ndarray
    direction: np.ndarray
    steps: np.ndarray  # int (n,): Number of steps to the last cell

    @property
    def angles(self) -> np.ndarray:
        """Their directions in radians, from east to north."""
        return 2.0 * math.pi / _DIRECTIONS * self.direction

    def take(self, selected: np.ndarray | slice) -> Sections:
        """Return the cross-sections that a mask, an index array or a slice selects."""
        return Sections(*(column[selected] for column in self))

    def middles(self, relief: BridgeRelief) -> np.ndarray:
        """Return the cells halfway, in the flattened grid."""
        return _Compass.of(relief).cells(self, self.steps // 2)

    def cells_of(self, relief: BridgeRelief) -> np.ndarray:
        """Return which cells of the grid they cross; boolean, shape (rows, columns)."""
        crossed = np.zeros(relief.heights.shape, dtype=bool)
        section = np.repeat(np.arange(len(self.steps)), self.steps + 1)
        offsets = _Compass.of(relief).offsets[self.direction[section], numbered(self.steps + 1)]
        crossed.ravel()[self.start[section] + offsets] = True
        return crossed


def raised_sections(
    relief: BridgeRelief, within: Callable[[BridgeRelief], np.ndarray], rule: SectionRule
) -> Sections:
    """Return the cross-sections of smooth surfaces with lower ground, at nearly one height, beyond
    both ends; `within` returns the cells where they may begin.
    """
    start = np.flatnonzero(_edges(relief, rule))
    if len(start):
        start = start[within(relief).ravel()[start]]
    compass = _Compass.of(relief)
    # Half a turn is enough, because a cross-section is found from either end. Neighbours share the
    # directions.
    row, column = np.divmod(start, relief.heights.shape[1])
    odd = (row + column + relief.parity) % 2
    direction = (np.arange(0, _DIRECTIONS // 2, 2) + odd[:, None]).ravel()
    start = np.repeat(start, _DIRECTIONS // 4)
    lines = Sections(start, direction, np.zeros_like(direction))
    foot, off = _feet(relief, compass, compass.back(lines), rule)
    found = off > 0
    lines, foot, off = lines.take(found), foot[found], off[found]
    steps = _lengths(relief, compass, lines)
    found = steps >= 0
    lines, foot, off = lines._replace(steps=steps).take(found), foot[found], off[found]
    heights, end = relief.heights.ravel(), compass.cells(lines, lines.steps)
    length = compass.length[lines.direction] * (lines.steps + 1)
    found = np.abs(heights[end] - heights[lines.start]) <= _TILT + _TILT_SLOPE * length
    lines, foot, off, end = lines.take(found), foot[found], off[found], end[found]
    other_foot, other_off = _feet(relief, compass, lines._replace(start=end), rule)
    found = other_off > 0
    lower = np.minimum(heights[lines.start] - foot, heights[end] - other_foot)
    found[found] = np.abs(foot - other_foot)[found] <= _FEET * lower[found]
    if rule.is_strict:
        left = lines.take(found)
        ends = (
            (compass.back(left), foot[found], off[found]),
            (left._replace(start=end[found]), other_foot[found], other_off[found]),
        )
        clear = np.logical_and(*(_is_clear(relief, compass, *side) for side in ends))
        near, far = (
            _is_open(relief, compass, edge, low, away, _BEYOND_ONE) for edge, low, away in ends
        )
        clear &= near | far
        found[found] = clear
    return lines.take(found)


class _Compass(NamedTuple):
    """Steps in each direction, from a cell to the next whose centre is near the line."""

    # int (directions, steps): Offset of the cell after each number of steps: in rows, in columns
    # and in the flattened grid.
    rows: np.ndarray
    columns: np.ndarray
    offsets: np.ndarray
    length: np.ndarray  # float (directions,): Length of a step in metres

    @classmethod
    def of(cls, relief: BridgeRelief) -> _Compass:
        angle = 2.0 * math.pi * np.arange(_DIRECTIONS) / _DIRECTIONS
        up, right = np.sin(angle), np.cos(angle)
        longest = np.maximum(np.abs(up), np.abs(right))
        step = np.arange(int((_LONGEST + _GAP) / relief.cell) + 3)
        rows, columns = (
            np.rint(np.outer(steps / longest, step)).astype(np.intp) for steps in (up, right)
        )
        length = relief.cell / longest
        return cls(rows, columns, rows * relief.heights.shape[1] + columns, length)

    def cells(self, lines: Sections, step: int | np.ndarray) -> np.ndarray:
        """Return the cells of some lines after `step` steps."""
        return lines.start + self.offsets[lines.direction, step]

    def back(self, lines: Sections) -> Sections:
        """Return the lines in the opposite direction."""
        return lines._replace(direction=(lines.direction + _DIRECTIONS // 2) % _DIRECTIONS)


def _edges(relief: BridgeRelief, rule: SectionRule) -> np.ndarray:
    """Return which cells of smooth surfaces may have a foot near them or a void beside them."""
    heights = relief.heights
    known = np.isfinite(heights)
    lowest = np.where(relief.is_ground, heights, np.float32(np.inf))
    edges = within_square(np.maximum, ~known, 1) & known
    farthest = int((_FOOT + relief.spacing) / relief.cell)
    for near, far in zip(_RINGS, (*_RINGS[1:], farthest)):
        lowest = within_square(np.minimum, lowest, far - near)
        edges |= heights - lowest >= rule.drop + rule.slope * (near + 1) * relief.cell
    # Keep the cells that are level with at least three of the eight cells at the distance of the
    # spacing.
    cells = np.flatnonzero(edges)
    off, columns = relief.apart, heights.shape[1]
    like = np.zeros(len(cells), dtype=np.int8)
    for up, right in itertools.product((-off, 0, off), repeat=2):
        beside = heights.ravel()[cells + (up * columns + right)]
        like += np.abs(beside - heights.ravel()[cells]) <= relief.step
    edges.ravel()[cells] = like > 3  # each also counts itself
    return edges


def _feet(
    relief: BridgeRelief, compass: _Compass, lines: Sections, rule: SectionRule
) -> tuple[np.ndarray, np.ndarray]:
    """Return the height of the foot below the edge where each line begins, and the steps to it, 0
    where there is none.
    """
    heights, is_ground = relief.heights.ravel(), relief.is_ground.ravel()
    foot = np.full(len(lines.start), np.inf, dtype=np.float32)
    off = np.zeros(len(lines.start), dtype=np.intp)
    edge, length = heights[lines.start], compass.length[lines.direction]
    left, farthest = np.arange(len(edge)), _FOOT + relief.spacing
    for step in range(1, int(farthest / relief.cell) + 1):
        left = left[step * length[left] <= farthest]
        cell = compass.offsets[:, step][lines.direction[left]]
        cell += lines.start[left]
        there = heights[cell]
        found = there <= edge[left] - rule.drop - rule.slope * step * length[left]
        found &= is_ground[cell]
        foot[left[found]], off[left[found]] = there[found], step
        left = left[~found]
    left = np.flatnonzero((off == 0) & np.isnan(heights[compass.cells(lines, 1)]))
    row, column = np.divmod(lines.start, relief.heights.shape[1])
    for step in range(2, int(_VOID_FOOT / relief.cell) + 1):
        if not len(left):
            break
        over_void = lines.take(left)
        there_row = row[left] + compass.rows[over_void.direction, step]
        there_column = column[left] + compass.columns[over_void.direction, step]
        inside = are_inside(there_row, there_column, relief.heights.shape)
        left, cell = left[inside], compass.cells(over_void, step)[inside]
        there = heights[cell]
        drop = _VOID_DROP + _VOID_SLOPE * step * length[left]
        found = is_ground[cell] & (there <= edge[left] - drop)
        foot[left[found]], off[left[found]] = there[found], step
        left = left[np.isnan(there)]
    return foot, off


def _lengths(relief: BridgeRelief, compass: _Compass, lines: Sections) -> np.ndarray:
    """Return how many steps a surface continues along lines; -1 where it continues too far."""
    heights = relief.heights.ravel()
    last, length = heights[lines.start], compass.length[lines.direction]
    steps, left = np.zeros(len(last), dtype=np.intp), np.arange(len(last))
    step = 0
    while len(left):
        step += 1
        there = heights[compass.cells(lines.take(left), step)]
        gap = (step - steps[left]) * length[left]
        rise = np.abs(there - last[left])
        on = rise <= STEP + STEP_SLOPE * np.maximum(gap, relief.spacing)
        last[left[on]], steps[left[on]] = there[on], step
        left = left[on | (np.isnan(rise) & (gap < _GAP))]
        wide = step * length[left] > _LONGEST
        steps[left[wide]] = -1
        left = left[~wide]
    return steps


def _is_clear(
    relief: BridgeRelief, compass: _Compass, lines: Sections, foot: np.ndarray, off: np.ndarray
) -> np.ndarray:
    """Return where no ground lies between an edge and its foot, and the foot is in no pit."""
    heights, is_ground = relief.heights.ravel(), relief.is_ground.ravel()
    edge = heights[lines.start]
    drop = edge - foot
    low, high = foot + _FACE * drop, edge - _FACE * drop
    clear = np.ones(len(edge), dtype=bool)
    apart, columns = relief.apart, relief.heights.shape[1]
    for share in (0.25, 0.5, 0.75):
        middle = compass.cells(lines, np.rint(share * off).astype(np.intp))
        for up, right in itertools.product((-apart, 0, apart), repeat=2):
            cell = middle + (up * columns + right)
            there = heights[cell]
            clear &= ~(is_ground[cell] & (there > low) & (there < high))
    return clear & _is_open(relief, compass, lines, foot, off, _BEYOND)


def _is_open(
    relief: BridgeRelief,
    compass: _Compass,
    lines: Sections,
    foot: np.ndarray,
    off: np.ndarray,
    farthest: float,
) -> np.ndarray:
    """Return where no ground rises up to some metres beyond the foot of an edge."""
    heights, is_ground = relief.heights.ravel(), relief.is_ground.ravel()
    edge = heights[lines.start]
    highest, is_open = edge - _PIT * (edge - foot), np.ones(len(edge), dtype=bool)
    for step in range(1, round(farthest / relief.cell) + 1):
        cell = compass.cells(lines, off + step)
        is_open &= ~(is_ground[cell] & (heights[cell] > highest))
    return is_open
