"""Figures of the outline of a survey and of pits in the canopy, on generated points."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import laspy
import numpy as np
from drawing import FEW_COLOURS, save
from matplotlib import pyplot

import bare_earth
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.grids.canopy import without_pits
from bare_earth.algorithms.rasters.geotiff import read_raster
from bare_earth.algorithms.tin.dense_surface import DenseSurface

_SIDE = 300


def _height(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return 100 + 8 * np.sin(x / 40) + 0.05 * y - ((y - 150) / 40) ** 2


def terrain_outline() -> None:
    """Draw the terrain of a survey like an L with a lake: in its hull, and in its outline."""
    x, y = np.random.default_rng(1).uniform(0, _SIDE, (2, 90_000))
    keep = ((x < 110) | (y < 90)) & (np.hypot(x - 55, y - 190) > 30)
    x, y = x[keep], y[keep]
    z = _height(x, y)
    hull = DenseSurface(Points(x, y, z), 1.0).raster((_SIDE, _SIDE))[::-1]
    ended = _made(x, y, z, np.full(len(x), 2), "dtm")
    figure, panels = pyplot.subplots(1, 2, figsize=(7.2, 3.6), layout="constrained")
    titles = "in the convex hull of the points", "in the outline of the survey"
    for panel, heights, title in zip(panels, (hull, ended), titles):
        panel.imshow(heights, cmap="terrain", vmin=80, vmax=125, extent=(0, _SIDE, 0, _SIDE))
        panel.plot(x[::60], y[::60], ",", color="black")
        panel.set(title=title, xticks=[], yticks=[])
    save(figure, "terrain-outline")


def canopy_pits() -> None:
    """Draw the canopy of a forest, as it is and without pits."""
    random = np.random.default_rng(2)
    x, y = random.uniform(0, 60, (2, 30_000))
    crowns = np.zeros(len(x))
    for _ in range(60):
        (at_x, at_y), top = random.uniform(0, 60, 2), random.uniform(10, 24)
        far = np.hypot(x - at_x, y - at_y) / (0.16 * top + 0.8)
        crowns = np.maximum(crowns, np.where(far < 1, top * (1 - 0.5 * far**2), 0))
    through = (crowns > 0) & (random.random(len(x)) < 0.5)
    z = crowns * np.where(through, random.uniform(0, 1, len(x)), 1)
    z[random.random(len(x)) < 0.1] = 0
    canopy = _made(x, y, z, np.where(z > 0.5, 5, 2), "chm", 0.5)
    figure, panels = pyplot.subplots(1, 2, figsize=(7.2, 3.6), layout="constrained")
    titles = "canopy height", "with pits filled"
    for panel, heights, title in zip(panels, (canopy, without_pits(canopy)), titles):
        panel.imshow(heights, cmap="Greens", interpolation="nearest")
        panel.set(title=title, xticks=[], yticks=[])
    save(figure, "canopy-pits", colours=FEW_COLOURS)


def _made(
    x: np.ndarray, y: np.ndarray, z: np.ndarray, classes: np.ndarray, name: str, cell: float = 1.0
) -> np.ndarray:
    """Return a raster of points, rows from north to south, NaN where there is no value."""
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = (0.01,) * 3, (0.0,) * 3
    las = laspy.LasData(header)
    las.x, las.y, las.z = x, y, z
    las.classification[:] = classes
    las.return_number[:] = las.number_of_returns[:] = 1
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "points.las")
        las.write(str(path))
        target = Path(folder, "raster.tif")
        rasters: dict[str, Any] = {name: target}
        bare_earth.terrain(path, dtm_cell_size=cell, **rasters)
        return read_raster(target)[0]
