"""A raster as somebody would add it: all that it is stands in one row."""

import numpy as np

from bare_earth.algorithms.library import tools
from bare_earth.algorithms.rasters.looks import GREY, Look, Ramp
from bare_earth.algorithms.tools.rasters.rows import RASTERS, RasterRow


def _roughness(terrain, how):
    from scipy import ndimage

    highest = ndimage.maximum_filter(terrain, 3, mode="nearest")
    return how.radius * (highest - ndimage.minimum_filter(terrain, 3, mode="nearest"))


NAME = "toy_roughness"
ROW = RasterRow(
    "Roughness",
    "How far the heights around a cell differ, many times.",
    "Roughness, {unit}",
    _roughness,
    Look(Ramp(GREY, low=0.0, least=2.0), 4),
    reach=lambda how: 1,
    is_height=True,
)


def add_toy(monkeypatch):
    """Add the row, as its lines in the table of rasters do."""
    monkeypatch.setitem(RASTERS, NAME, ROW)
    forget()
    return ROW


def forget():
    """Let the library declare its functions anew."""
    tools.declared.cache_clear()
    tools.function.cache_clear()


def is_right(values):
    """Return whether a file holds what the row says, of a plane that rises by 1 in each cell."""
    return np.allclose(values[2:-2, 2:-2], 20.0, atol=0.1)
