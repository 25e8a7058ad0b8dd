"""Colour ramps of the maps; ramps for layers above a hillshade are light."""

from __future__ import annotations

from typing import Sequence

from qgis.core import QgsGradientColorRamp, QgsGradientStop
from qgis.PyQt.QtGui import QColor

Stops = Sequence[tuple[float, str]]

# Position from 0 to 1, and colour; #aarrggbb for transparent colours.
TERRAIN: Stops = (
    (0.0, "#6fb59c"), (0.2, "#a9d39e"), (0.4, "#e6eeb4"), (0.6, "#f2d79b"), (0.8, "#d9a77c"),
    (1.0, "#f4e9e2"),
)  # fmt: skip
SURFACE: Stops = (
    (0.0, "#352a5e"), (0.2, "#35618f"), (0.4, "#2a9d8f"), (0.6, "#8cc97a"), (0.8, "#f0d864"),
    (1.0, "#fbf6e3"),
)  # fmt: skip
# Heights above ground. Bare ground is transparent.
CANOPY: Stops = (
    (0.0, "#00f7f4e6"), (0.04, "#60e8e7b4"), (0.15, "#c5dd8b"), (0.4, "#6cb35c"), (0.7, "#1f7a4a"),
    (1.0, "#0b3a52"),
)  # fmt: skip
HEIGHTS: Stops = ((0.0, "#c9a26b"), (0.04, "#e8dfa8"), *CANOPY[2:])
# Low and high values differ in lightness, for colour-blind people.
CONFIDENCE: Stops = (
    (0.0, "#7a0f3d"), (0.3, "#d4523f"), (0.6, "#f5b25b"), (0.85, "#f2ecb0"), (1.0, "#9fcdb9"),
)  # fmt: skip
ERRORS: Stops = (
    (0.0, "#00ffffff"), (0.02, "#a0f7d9a0"), (0.25, "#f2934d"), (0.6, "#c23b3f"), (1.0, "#5a0a3c"),
)  # fmt: skip
# Hollows and rises, with a transparent middle.
RELIEF: Stops = (
    (0.0, "#21598f"), (0.3, "#8fbbd9"), (0.5, "#00f5f3ee"), (0.7, "#e3a07a"), (1.0, "#9c2f2b"),
)  # fmt: skip
# Densities, dark where they are high, as on the page about the quality of a survey.
DENSITY: Stops = (
    (0.0, "#f7fbff"), (0.25, "#c6dbef"), (0.5, "#6baed6"), (0.75, "#2171b5"), (1.0, "#08306b"),
)  # fmt: skip
# Pictures of the relief: what is hidden or steep is dark.
GREY: Stops = ((0.0, "#000000"), (1.0, "#ffffff"))
GREY_UPSIDE_DOWN: Stops = ((0.0, "#ffffff"), (1.0, "#000000"))


def ramp_of(stops: Stops) -> QgsGradientColorRamp:
    """Return a colour ramp that QGIS can show and users can change."""
    inner = [QgsGradientStop(place, QColor(colour)) for place, colour in stops[1:-1]]
    return QgsGradientColorRamp(QColor(stops[0][1]), QColor(stops[-1][1]), False, inner)
