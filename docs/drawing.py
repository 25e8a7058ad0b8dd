"""What the figures of the pages share: colours, reliefs, and pictures that are small."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib import pyplot
from PIL import Image

from bare_earth.algorithms.grids.hillshade import hillshade

IMAGES = Path(__file__).parent / "images"
GROUND, OTHER, ADDED, LINE = "#a5692a", "#9aa5b1", "#d7263d", "#1565d8"
# How many colours a picture has; reliefs side by side do with few.
COLOURS, FEW_COLOURS = 96, 28


def save(
    figure: pyplot.Figure, name: str, dots_per_inch: int = 110, colours: int = COLOURS
) -> None:
    """Save a figure with few colours, which makes it small."""
    target = IMAGES / f"{name}.png"
    figure.savefig(target, dpi=dots_per_inch, metadata={"Software": None})
    pyplot.close(figure)
    with Image.open(target) as image:
        shrink(image, target, colours)
    print(f"{target.name}: {target.stat().st_size // 1000} kB")


def shrink(image: Image.Image, target: Path, colours: int = COLOURS) -> None:
    """Save a picture with few colours."""
    few = image.convert("RGB").quantize(colours, kmeans=2, dither=Image.Dither.NONE)
    few.save(target, optimize=True)


def shade(panel: pyplot.Axes, heights: np.ndarray, cell_size: float = 1.0, faint: bool = False):
    """Draw the hillshade of a grid whose first row is the north."""
    grey = np.ma.masked_equal(hillshade(heights, cell_size), 0)
    panel.imshow(grey, cmap="gray", vmin=-200 if faint else 1, vmax=255, interpolation="nearest")
    panel.set_xticks([])
    panel.set_yticks([])
