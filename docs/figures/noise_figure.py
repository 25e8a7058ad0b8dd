"""The figure of the page about low and high noise: reliefs, and a section through birds."""

from __future__ import annotations

import numpy as np
from drawing import ADDED, GROUND, LINE, OTHER, save, shade
from matplotlib import pyplot

from bare_earth.algorithms.classes.selection import Selection
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.tin.dense_surface import DenseSurface
from benchmarks.clouds import classify_cloud
from benchmarks.scenes import make

_SEED, _CELL, _WIDTH = 4, 0.5, 3.0


def noise() -> None:
    """Draw the relief of a slope with low groups, and a section through birds above a village."""
    scene = make("low_groups_slope", seed=_SEED, size=60.0, slope=0.3, density=8.0)
    parameters = METHODS["tin-densification"].parameters()
    selection = Selection(low_noise_class=True, high_noise_class=True)
    found, _ = classify_cloud(scene.cloud(), parameters, selection)
    figure, panels = pyplot.subplots(1, 3, figsize=(8.4, 2.7), layout="constrained")
    alone = scene.ground | (scene.classes == 7)
    for panel, mask, title in (
        (panels[0], alone, "low groups taken for ground"),
        (panels[1], found == 2, "left out"),
    ):
        shade(panel, _terrain(scene.points.take(mask)), _CELL)
        panel.set_title(title)
    birds = make("birds", seed=_SEED, size=90.0)
    found, _ = classify_cloud(birds.cloud(), parameters, selection)
    x, y, z = birds.points
    middle = np.median(y[birds.classes == 18])
    near = np.abs(y - middle) <= 2.0 * _WIDTH
    for value, colour, name in (
        (1, OTHER, "other"), (2, GROUND, "ground"), (7, LINE, "7"), (18, ADDED, "18"),
    ):  # fmt: skip
        which = near & (found == value)
        size = 9.0 if value in (7, 18) else 1.0
        panels[2].scatter(x[which] - x.min(), z[which], size, colour, lw=0, label=name)
    panels[2].set_title("birds above a village: high noise")
    panels[2].set_xlabel("m")
    panels[2].legend(fontsize=6, markerscale=1.5, loc="upper right")
    save(figure, "noise")


def _terrain(ground: Points) -> np.ndarray:
    """Return heights of the TIN, from north to south."""
    west, south, east, north = ground.box
    shape = int((north - south) / _CELL), int((east - west) / _CELL)
    return DenseSurface(ground, _CELL, (west, south)).raster(shape)[::-1]
