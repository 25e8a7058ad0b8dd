"""Results of settings on the points in a window: terrain, figures, differences, a profile."""

from __future__ import annotations

import math
from typing import NamedTuple, Sequence

import numpy as np

from ..core.points import Points
from ..grids.cells import are_inside
from ..grids.confidence import confidence
from ..grids.dense_surface import VERTICES_A_SIDE, DenseSurface
from ..report.units import Units

# Greatest number of cells along the longer side of the terrain, and the sides in metres that cells
# can have below one metre. Larger cells have whole metres.
_MOST_CELLS = 300
_CELL_SIZES = (0.25, 0.5)
# The strip along a profile has so many points a metre. Limits of half its width, in metres.
_POINTS_A_METRE, _NARROWEST, _WIDEST = 8.0, 0.5, 3.0
# Distance in metres up to which points around the window are used for the confidence.
_NEAR = 20.0


class Window(NamedTuple):
    """The points on which settings are tried, in a window and around it."""

    points: Points  # in metres from the lower left corner of the window
    inside: np.ndarray  # bool, (n,)
    width: float  # metres
    height: float  # metres
    units: Units = Units()  # of the survey

    @property
    def size(self) -> str:
        """The size in words, in the unit of the survey and in metres."""
        unit, metric = self.units.horizontal, f"{self.width:.0f} x {self.height:.0f} m"
        if unit == 1.0:
            return metric
        return f"{self.width / unit:.0f} x {self.height / unit:.0f} {self.units.across}, {metric}"

    @property
    def cell_size(self) -> float:
        """Side of a cell of the terrain in metres."""
        least = max(self.width, self.height) / _MOST_CELLS
        return next((each for each in _CELL_SIZES if each >= least), float(math.ceil(least)))

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the terrain."""
        return math.ceil(self.height / self.cell_size), math.ceil(self.width / self.cell_size)

    @property
    def strip(self) -> float:
        """Greatest distance of points that a profile shows, in metres."""
        density = np.count_nonzero(self.inside) / (self.width * self.height)
        return min(max(_POINTS_A_METRE / (2.0 * density), _NARROWEST), _WIDEST)


class Outcome(NamedTuple):
    """The result of a setting."""

    name: str
    label: str
    classes: np.ndarray  # uint8, (n,)
    ground: np.ndarray  # bool, (n,)
    terrain: np.ndarray  # float64, (rows, columns): metres, from north to south; NaN for none
    confidence: float  # mean probability in the window that the terrain is right, 0 to 1


def outcome_of(
    window: Window,
    names: tuple[str, str],
    classes: np.ndarray,
    ground: np.ndarray,
    selected: np.ndarray,
) -> Outcome:
    """Return the result of a setting, given its name and label, with terrain and confidence;
    `selected` says which points took part, bool (n,).
    """
    terrain = _terrain(window, ground)
    return Outcome(*names, classes, ground, terrain, _confidence(window, ground, selected))


def _terrain(window: Window, ground: np.ndarray) -> np.ndarray:
    """Return the heights of the terrain, from north to south."""
    if not ground.any():
        return np.full(window.shape, np.nan)
    # One vertex a cell is enough for a picture, and faster than the four of a terrain model.
    surface = DenseSurface(window.points.take(ground), VERTICES_A_SIDE * window.cell_size)
    y, x = ((np.arange(count) + 0.5) * window.cell_size for count in window.shape)
    heights = surface.heights(np.tile(x, len(y)), np.repeat(y, len(x)))
    return heights.reshape(window.shape)[::-1]


def _confidence(window: Window, ground: np.ndarray, selected: np.ndarray) -> float:
    """Return the mean confidence of the cells of 1 m in the window."""
    x, y, _ = window.points
    near = (x >= -_NEAR) & (y >= -_NEAR) & (x <= window.width + _NEAR)
    near &= selected & (y <= window.height + _NEAR)
    cells, values = confidence(window.points.take(near), ground[near])
    rows, columns = (
        slice(max(-first, 0), max(math.ceil(side / cells.size) - first, 0))
        for first, side in zip(cells.first, (window.height, window.width))
    )
    inside = values[rows, columns]
    return float(inside.mean()) if inside.size else 0.0


class Figures(NamedTuple):
    """Figures of a setting for the points and cells in the window."""

    name: str
    label: str
    point_count: int
    ground_count: int
    ground_share: float  # percent
    confidence: float  # mean, in percent
    gained: int  # points that are ground, but not with the first setting
    lost: int  # the reverse
    # mean absolute, in metres, from the first setting; None without terrain
    terrain_difference: float | None


def figures_of(window: Window, outcome: Outcome, first: Outcome) -> Figures:
    """Return the figures of a setting, compared with the first setting."""
    ground, before = outcome.ground[window.inside], first.ground[window.inside]
    apart = np.abs(outcome.terrain - first.terrain)
    apart = apart[np.isfinite(apart)]

    shared = int(np.count_nonzero(ground & before))
    ground_count, first_count = (int(np.count_nonzero(each)) for each in (ground, before))
    return Figures(
        outcome.name,
        outcome.label,
        len(ground),
        ground_count,
        100.0 * ground_count / len(ground),
        100.0 * outcome.confidence,
        ground_count - shared,
        first_count - shared,
        float(apart.mean()) if apart.size else None,
    )


class Line(NamedTuple):
    """A straight line in metres from the lower left corner of the window."""

    start: tuple[float, float]
    end: tuple[float, float]

    @property
    def length(self) -> float:
        """Metres."""
        return math.dist(self.start, self.end)

    def along(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the distances of places along the line, and to its left, in metres."""
        east, north = ((last - first) / self.length for first, last in zip(self.start, self.end))
        x, y = x - self.start[0], y - self.start[1]
        return x * east + y * north, y * east - x * north

    def cells(self, window: Window) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return distances along the line, one side of a cell apart, and row and column of the
        terrain cell at each, without places outside the window.
        """
        cell = window.cell_size
        distance = np.arange(0.0, self.length, cell) + 0.5 * min(cell, self.length)
        share = distance / self.length
        column, row = (
            np.floor((first + share * (last - first)) / cell).astype(np.int64)
            for first, last in zip(self.start, self.end)
        )
        row = window.shape[0] - 1 - row
        inside = are_inside(row, column, window.shape)
        return distance[inside], row[inside], column[inside]


def line_across(window: Window, outcomes: Sequence[Outcome]) -> Line:
    """Return a line across the window where terrains differ most, or else through its middle."""
    first = outcomes[0].terrain
    apart = sum(np.nan_to_num(np.abs(each.terrain - first)) for each in outcomes)
    rows, columns = apart.mean(axis=1)[::-1], apart.mean(axis=0)
    at = window.cell_size * (np.argmax(rows) + 0.5), window.cell_size * (np.argmax(columns) + 0.5)
    y, x = (min(float(each), side) for each, side in zip(at, (window.height, window.width)))
    if not apart.any():
        x, y = window.width / 2.0, window.height / 2.0
    if rows.max() >= columns.max():
        return Line((0.0, y), (window.width, y))
    return Line((x, 0.0), (x, window.height))
