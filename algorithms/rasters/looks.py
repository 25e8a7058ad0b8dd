"""How a map shows rasters: colours, limits and order, as data that QGIS draws."""

from __future__ import annotations

from typing import NamedTuple, Tuple, Union

# Places from 0 to 1 with their colours; #aarrggbb for transparent ones. Ramps for layers above a
# hillshade are light.
Stops = Tuple[Tuple[float, str], ...]

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
# The same for points.
HEIGHTS: Stops = ((0.0, "#c9a26b"), (0.04, "#e8dfa8"), *CANOPY[2:])
ERRORS: Stops = (
    (0.0, "#00ffffff"), (0.02, "#a0f7d9a0"), (0.25, "#f2934d"), (0.6, "#c23b3f"), (1.0, "#5a0a3c"),
)  # fmt: skip
# What makes the expected error large; nothing is transparent.
CAUSES: Stops = (
    (0.0, "#00ffffff"), (0.1429, "#3a7d44"), (0.2857, "#8c6d46"), (0.4286, "#b9a58a"),
    (0.5714, "#7fb3d5"), (0.7143, "#1f4e8c"), (0.8571, "#d4523f"), (1.0, "#e3c94b"),
)  # fmt: skip
# Hollows and rises, with a transparent middle.
RISES: Stops = (
    (0.0, "#21598f"), (0.3, "#8fbbd9"), (0.5, "#00f5f3ee"), (0.7, "#e3a07a"), (1.0, "#9c2f2b"),
)  # fmt: skip
# What sank in red, and what rose in blue, with a transparent middle.
CHANGES: Stops = (
    (0.0, "#9c2f2b"), (0.3, "#e3a07a"), (0.5, "#00f5f3ee"), (0.7, "#8fbbd9"), (1.0, "#21598f"),
)  # fmt: skip
# Densities, dark where they are high, as on the page about the quality of a survey.
DENSITY: Stops = (
    (0.0, "#f7fbff"), (0.25, "#c6dbef"), (0.5, "#6baed6"), (0.75, "#2171b5"), (1.0, "#08306b"),
)  # fmt: skip
# Pictures of the relief: what is hidden or steep is dark.
GREY: Stops = ((0.0, "#000000"), (1.0, "#ffffff"))
GREY_UPSIDE_DOWN: Stops = ((0.0, "#ffffff"), (1.0, "#000000"))


class Ramp(NamedTuple):
    """Colours from a low to a high value."""

    stops: Stops
    low: float | None = None  # None: nearly all cells are higher
    high: float | None = None  # None: nearly all cells are lower
    least: float = 0.5  # least difference of both: noise of millimetres must not look like relief
    is_even: bool = False  # whether it reaches as far below 0 as above
    multiplies: bool = False  # whether a hillshade below stays visible
    line: str = ""  # colour in profiles if the layer is one of elevations


class PictureStyle(NamedTuple):
    """Greys, or red, green and blue as the bands are; without a legend."""

    limits: tuple[float, float] | None = None  # values that are black and white; None: as they are


class Categories(NamedTuple):
    """A label and a colour for some values."""

    entries: tuple[tuple[int, str, str], ...]


class ColourSteps(NamedTuple):
    """A colour up to each limit, in metres, and one beyond the last."""

    limits: tuple[float, ...]
    colours: tuple[str, ...]


Style = Union[Ramp, PictureStyle, Categories, ColourSteps]


class Look(NamedTuple):
    """How the layer of a raster looks, and where it lies among those of its run."""

    style: Style
    height: int  # the greatest is on top
    # Of layers that hide each other, only the one with the greatest number is visible at first; 0
    # for a layer that hides no other.
    hides: int = 0
