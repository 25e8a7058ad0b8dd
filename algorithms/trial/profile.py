"""A profile as SVG: the terrain, and the points along a line, coloured by class."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..las.class_names import CLASSES
from ..report.page import Html, data_uri, key
from ..report.pictures import rgb
from ..report.units import round_length
from ..survey.kept_classes import NOISE
from .window import Line, Outcome, Window

# Pixels of the picture, and of the axes to its left and below it.
_WIDTH, _HEIGHT, _LEFT, _BELOW = 900, 220, 56, 24
_GROUND, _OTHER, _TERRAIN, _FIRST = "#9c5a1a", "#9aa5ad", "#111111", "#1f6fd0"
_COLOURS = {
    2: _GROUND, 3: "#86bf5a", 4: "#4f9e3f", 5: "#2c7a2c", 6: "#d3473a", 9: "#3f8fd6",
    17: "#8a57c4",
}  # fmt: skip
# Heights are shown between these quantiles of the points.
_LOWEST, _HIGHEST = 0.0005, 0.9995
# Space above and below the points, as a share of their height range; and the least range in metres.
_SPACE, _LEAST_RANGE = 0.04, 2.0


class Profile(NamedTuple):
    """Position and points of a profile, the same for all settings."""

    line: Line
    near: np.ndarray  # int, (k,): indices of the points that are shown
    distance: np.ndarray  # float64, (k,): their distances along the line in metres
    lowest: float  # height at the lower edge in metres
    highest: float  # height at the upper edge in metres

    @classmethod
    def of(cls, window: Window, line: Line, shown: np.ndarray) -> Profile:
        """Return the profile along a line; `shown` (n,) is a mask of the points to show."""
        distance, aside = line.along(window.points.x, window.points.y)
        near = (np.abs(aside) <= window.strip) & (distance >= 0.0) & (distance <= line.length)
        near = np.flatnonzero(near & shown)
        heights = np.sort(window.points.z[near])
        low = high = 0.0
        if len(heights):
            low, high = (heights[int(share * (len(heights) - 1))] for share in (_LOWEST, _HIGHEST))
        middle, half = (low + high) / 2.0, max(high - low, _LEAST_RANGE) * (0.5 + _SPACE)
        return cls(line, near, distance[near], float(middle - half), float(middle + half))

    @property
    def exaggeration(self) -> float:
        """Vertical exaggeration: the scale of heights divided by the scale of lengths."""
        return (_HEIGHT / (self.highest - self.lowest)) / (_WIDTH / self.line.length)

    def svg(self, window: Window, outcome: Outcome, first: Outcome) -> Html:
        """Return the drawing of a setting, together with the terrain of the first setting."""
        points = data_uri(self._points(window, outcome))
        lines = []
        if outcome is not first:
            lines.append(self._terrain(window, first, f'stroke="{_FIRST}" stroke-dasharray="5 4"'))
        lines.append(self._terrain(window, outcome, f'stroke="{_TERRAIN}"'))
        grid, labels = self._axes(window)
        return Html(f"""<svg viewBox="{-_LEFT} -8 {_WIDTH + _LEFT + 20} {_HEIGHT + _BELOW + 8}"
 role="img" aria-label="Profile"><image width="{_WIDTH}" height="{_HEIGHT}" href="{points}"/>
<g stroke="#000" stroke-opacity=".13">{grid}</g>
<g fill="none" stroke-width="1.1">{"".join(lines)}</g>
<rect width="{_WIDTH}" height="{_HEIGHT}" fill="none" stroke="#888"/>
<g font-size="12" fill="#333">{labels}</g></svg>""")

    def key(self, outcome: Outcome, is_first: bool) -> Html:
        """Return the legend of a drawing."""
        shown = np.unique(outcome.classes[self.near]).tolist()
        entries = [key(_COLOURS[each], CLASSES[each]) for each in shown if each in _COLOURS]
        if set(shown) - set(_COLOURS):
            entries.append(key(_OTHER, "other"))
        entries.append(key(_TERRAIN, "terrain"))
        if not is_first:
            entries.append(key(_FIRST, "terrain of the first setting (dashed)"))
        return Html("".join(entries))

    def _points(self, window: Window, outcome: Outcome) -> np.ndarray:
        """Return the picture of the points, with ground points on top."""
        pixels = np.full((_HEIGHT, _WIDTH, 3), 255, dtype=np.uint8)
        row, column = self._places(self.distance, window.points.z[self.near])
        classes = outcome.classes[self.near]
        order = np.argsort(outcome.ground[self.near], kind="stable")
        inside = order[(row >= 0)[order] & (row < _HEIGHT - 1)[order]]
        colours = np.full((256, 3), rgb(_OTHER), dtype=np.uint8)
        for value, colour in _COLOURS.items():
            colours[value] = rgb(colour)
        row, column = row[inside].astype(int), np.minimum(column[inside].astype(int), _WIDTH - 2)
        for down, right in ((0, 0), (0, 1), (1, 0), (1, 1)):
            pixels[row + down, column + right] = colours[classes[inside]]
        return pixels

    def _places(self, distance: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return rows and columns of the picture."""
        row = (self.highest - z) / (self.highest - self.lowest) * _HEIGHT
        return row, distance / self.line.length * _WIDTH

    def _terrain(self, window: Window, outcome: Outcome, look: str) -> str:
        distance, row, column = self.line.cells(window)
        row, column = self._places(distance, outcome.terrain[row, column])
        # One line for each part between gaps.
        parts = np.split(np.arange(len(row)), np.flatnonzero(np.diff(np.isnan(row))) + 1)
        rows = np.clip(row, 0.0, _HEIGHT)
        return "".join(
            f'<polyline {look} points="'
            + " ".join(f"{column[each]:.1f},{rows[each]:.1f}" for each in part)
            + '"/>'
            for part in parts
            if len(part) > 1 and not np.isnan(row[part[0]])
        )

    def _axes(self, window: Window) -> tuple[str, str]:
        """Return lines and labels of round heights and distances."""
        grid, labels, units = [], [], window.units
        low, high = self.lowest / units.vertical, self.highest / units.vertical
        step = round_length((high - low) / 3)
        for height in np.arange(np.ceil(low / step), high / step) * step:
            y = float(self._places(np.zeros(1), np.array([height * units.vertical]))[0][0])
            grid.append(f'<path d="M0 {y:.1f}H{_WIDTH}"/>')
            labels.append(
                f'<text x="-6" y="{y + 4:.1f}" text-anchor="end">{height + 0.0:g} {units.up}</text>'
            )
        whole = self.line.length / units.horizontal
        step = round_length(whole / 4)
        for length in np.arange(0.0, whole + step / 100, step):
            x = length / whole * _WIDTH
            grid.append(f'<path d="M{x:.1f} 0V{_HEIGHT}"/>')
            labels.append(
                f'<text x="{x:.1f}" y="{_HEIGHT + 16}" text-anchor="middle">{length:g}'
                f" {units.across}</text>"
            )
        return "".join(grid), "".join(labels)


def can_be_shown(classes: np.ndarray, withheld: np.ndarray) -> np.ndarray:
    """Return which points a profile can show: all except noise and withheld points."""
    return ~np.isin(classes, NOISE) & ~withheld
