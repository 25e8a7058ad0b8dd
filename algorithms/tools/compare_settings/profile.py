"""A profile as SVG: the terrain, and the points along a line, coloured by class."""

from __future__ import annotations

import math
from typing import Sequence

import numpy as np

from ...grids.cells import are_inside
from ...las.class_names import CLASSES
from ...report.page import Html, data_uri, key
from ...report.pictures import rgb
from ...report.units import round_length
from ...survey.kept_classes import NOISE
from .window import Outcome, Window

# Pixels of the picture, and of the axes to its left and below it.
_WIDTH, _HEIGHT, _LEFT, _BELOW = 900, 220, 56, 24
_GROUND, _OTHER, _TERRAIN, _FIRST = "#9c5a1a", "#9aa5ad", "#111111", "#1f6fd0"
_COLOURS = {
    2: _GROUND, 3: "#86bf5a", 4: "#4f9e3f", 5: "#2c7a2c", 6: "#d3473a", 9: "#3f8fd6",
    17: "#8a57c4",
}  # fmt: skip
# The strip along a profile has so many points a metre. Limits of half its width, in metres.
_POINTS_A_METRE, _NARROWEST, _WIDEST = 8.0, 0.5, 3.0
# Heights are shown between these quantiles of the points.
_LOWEST, _HIGHEST = 0.0005, 0.9995
# Space above and below the points, as a share of their height range; and the least range in metres.
_SPACE, _LEAST_RANGE = 0.04, 2.0

# Both ends of a line, in metres from the lower left corner of the window.
Line = tuple[tuple[float, float], tuple[float, float]]


def line_between(window: Window, ends: Sequence[float]) -> Line:
    """Return the line between two points, given as x1, y1, x2, y2 in units of the CRS."""
    unit = window.crs.horizontal_unit
    x1, y1, x2, y2 = ((place - start) * unit for place, start in zip(ends, window.box[:2] * 2))
    return (x1, y1), (x2, y2)


def line_across(window: Window, outcomes: Sequence[Outcome]) -> Line:
    """Return a line across the window where terrains differ most, or else through its middle."""
    first, (width, height) = outcomes[0].terrain, window.sides
    apart = sum(np.nan_to_num(np.abs(outcome.terrain - first)) for outcome in outcomes)
    rows, columns = apart.mean(axis=1)[::-1], apart.mean(axis=0)
    y, x = (
        min(float(window.cell_size * (np.argmax(differences) + 0.5)), side)
        for differences, side in ((rows, height), (columns, width))
    )
    if not apart.any():
        x, y = width / 2.0, height / 2.0
    if rows.max() >= columns.max():
        return (0.0, y), (width, y)
    return (x, 0.0), (x, height)


class Profile:
    """Position and points of a profile, the same for all settings."""

    def __init__(self, window: Window, line: Line, first: Outcome) -> None:
        self._window, self.line, self._first = window, line, first
        self._length = math.dist(*line)
        points, (start, end) = window.points, line
        east, north = ((b - a) / self._length for a, b in zip(start, end))
        x, y = points.x - start[0], points.y - start[1]
        distance, aside = x * east + y * north, y * east - x * north
        density = np.count_nonzero(window.inside) / math.prod(window.sides)
        # Greatest distance in metres of points that are shown.
        self.strip = min(max(_POINTS_A_METRE / (2.0 * density), _NARROWEST), _WIDEST)
        near = (np.abs(aside) <= self.strip) & (distance >= 0.0) & (distance <= self._length)
        withheld = np.concatenate([cloud.withheld for cloud in window.clouds])
        self._near = np.flatnonzero(near & ~np.isin(first.classes, NOISE) & ~withheld)
        self._distance = distance[self._near]
        heights = np.sort(points.z[self._near])
        low = high = 0.0
        if len(heights):
            low, high = (heights[int(share * (len(heights) - 1))] for share in (_LOWEST, _HIGHEST))
        middle, half = (low + high) / 2.0, max(high - low, _LEAST_RANGE) * (0.5 + _SPACE)
        # Heights in metres at the edges of the picture.
        self._lowest, self._highest = float(middle - half), float(middle + half)

    @property
    def exaggeration(self) -> float:
        """Vertical exaggeration: the scale of heights divided by the scale of lengths."""
        return (_HEIGHT / (self._highest - self._lowest)) / (_WIDTH / self._length)

    def cells(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return distances along the line, one side of a cell apart, and row and column of the
        terrain cell at each, without places outside the window.
        """
        cell, shape = self._window.cell_size, self._window.shape
        distance = np.arange(0.0, self._length, cell) + 0.5 * min(cell, self._length)
        share = distance / self._length
        column, row = (
            np.floor((first + share * (last - first)) / cell).astype(np.int64)
            for first, last in zip(*self.line)
        )
        row = shape[0] - 1 - row
        inside = are_inside(row, column, shape)
        return distance[inside], row[inside], column[inside]

    def svg(self, outcome: Outcome) -> Html:
        """Return the drawing of a setting, together with the terrain of the first setting."""
        lines = ""
        if outcome is not self._first:
            lines = self._terrain(self._first, f'stroke="{_FIRST}" stroke-dasharray="5 4"')
        lines += self._terrain(outcome, f'stroke="{_TERRAIN}"')
        grid, labels = self._axes()
        return Html(f"""<svg viewBox="{-_LEFT} -8 {_WIDTH + _LEFT + 20} {_HEIGHT + _BELOW + 8}"
 role="img" aria-label="Profile"><image width="{_WIDTH}" height="{_HEIGHT}" \
href="{data_uri(self._points(outcome))}"/>
<g stroke="#000" stroke-opacity=".13">{grid}</g>
<g fill="none" stroke-width="1.1">{lines}</g>
<rect width="{_WIDTH}" height="{_HEIGHT}" fill="none" stroke="#888"/>
<g font-size="12" fill="#333">{labels}</g></svg>""")

    def key(self, outcome: Outcome) -> Html:
        """Return the legend of a drawing."""
        shown = np.unique(outcome.classes[self._near]).tolist()
        entries = [key(_COLOURS[value], CLASSES[value]) for value in shown if value in _COLOURS]
        if set(shown) - set(_COLOURS):
            entries.append(key(_OTHER, "other"))
        entries.append(key(_TERRAIN, "terrain"))
        if outcome is not self._first:
            entries.append(key(_FIRST, "terrain of the first setting (dashed)"))
        return Html("".join(entries))

    def _points(self, outcome: Outcome) -> np.ndarray:
        """Return the picture of the points, with ground points on top."""
        pixels = np.full((_HEIGHT, _WIDTH, 3), 255, dtype=np.uint8)
        row, column = self._places(self._distance, self._window.points.z[self._near])
        order = np.argsort(outcome.ground[self._near], kind="stable")
        inside = order[(row >= 0)[order] & (row < _HEIGHT - 1)[order]]
        colours = np.full((256, 3), rgb(_OTHER), dtype=np.uint8)
        for value, colour in _COLOURS.items():
            colours[value] = rgb(colour)
        row, column = row[inside].astype(int), np.minimum(column[inside].astype(int), _WIDTH - 2)
        for down, right in ((0, 0), (0, 1), (1, 0), (1, 1)):
            pixels[row + down, column + right] = colours[outcome.classes[self._near[inside]]]
        return pixels

    def _places(self, distance: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return rows and columns of the picture."""
        row = (self._highest - z) / (self._highest - self._lowest) * _HEIGHT
        return row, distance / self._length * _WIDTH

    def _terrain(self, outcome: Outcome, look: str) -> str:
        distance, row, column = self.cells()
        row, column = self._places(distance, outcome.terrain[row, column])
        # One line for each part between gaps.
        parts = np.split(np.arange(len(row)), np.flatnonzero(np.diff(np.isnan(row))) + 1)
        rows = np.clip(row, 0.0, _HEIGHT)
        return "".join(
            f'<polyline {look} points="'
            + " ".join(f"{column[k]:.1f},{rows[k]:.1f}" for k in part)
            + '"/>'
            for part in parts
            if len(part) > 1 and not np.isnan(row[part[0]])
        )

    def _axes(self) -> tuple[str, str]:
        """Return lines and labels of round heights and distances."""
        grid, labels, units = "", "", self._window.units
        low, high = self._lowest / units.vertical, self._highest / units.vertical
        step = round_length((high - low) / 3)
        for height in np.arange(np.ceil(low / step), high / step) * step:
            y = float(self._places(np.zeros(1), np.array([height * units.vertical]))[0][0])
            grid += f'<path d="M0 {y:.1f}H{_WIDTH}"/>'
            text = f"{height + 0.0:g} {units.up}"
            labels += f'<text x="-6" y="{y + 4:.1f}" text-anchor="end">{text}</text>'
        whole = self._length / units.horizontal
        step = round_length(whole / 4)
        for length in np.arange(0.0, whole + step / 100, step):
            x, y = length / whole * _WIDTH, _HEIGHT + 16
            grid += f'<path d="M{x:.1f} 0V{_HEIGHT}"/>'
            text = f"{length:g} {units.across}"
            labels += f'<text x="{x:.1f}" y="{y}" text-anchor="middle">{text}</text>'
        return grid, labels
