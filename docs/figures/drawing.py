"""What the figures of the pages share: colours, reliefs, and pictures that are small.

tools/environment python docs/figures/drawing.py PICTURE.png ...    makes other pictures small
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from bare_earth.algorithms.relief.hillshade import hillshade

IMAGES = Path(__file__).parents[1] / "images"
GROUND, OTHER, ADDED, LINE = "#a5692a", "#9aa5b1", "#d7263d", "#1565d8"
# How many colours a picture has; reliefs side by side do with few.
COLOURS, FEW_COLOURS = 96, 28


def save(figure: Figure, name: str, dots_per_inch: int = 110, colours: int = COLOURS) -> None:
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


def shade(panel: Axes, heights: np.ndarray, cell_size: float = 1.0, faint: bool = False) -> None:
    """Draw the hillshade of a grid whose first row is the north."""
    grey = np.ma.masked_equal(hillshade(heights, cell_size), 0)
    panel.imshow(grey, cmap="gray", vmin=-200 if faint else 1, vmax=255, interpolation="nearest")
    panel.set_xticks([])
    panel.set_yticks([])


def draw_errors(panel: Axes, true_heights: np.ndarray, error: np.ndarray) -> None:
    """Draw a terrain model: red where it is too high, blue where it is too low."""
    shade(panel, true_heights + error, faint=True)
    colours = np.zeros((*error.shape, 4))
    colours[error > 0] = mpl.colors.to_rgba(ADDED)
    colours[error <= 0] = mpl.colors.to_rgba(LINE)
    # Errors of less than 0.2 m are not shown; from 1 m on they are so in full colour.
    colours[..., 3] = np.clip((np.abs(np.nan_to_num(error)) - 0.2) / 0.8, 0, 0.9)
    panel.imshow(colours, interpolation="nearest")


if __name__ == "__main__":
    for name in sys.argv[1:]:
        with Image.open(name) as picture:
            shrink(picture, Path(name), 256)
