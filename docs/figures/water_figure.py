"""The figure of the page on water: a lake and a river that are found among generated points."""

from __future__ import annotations

import numpy as np
from drawing import FEW_COLOURS, save
from matplotlib import pyplot

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.tools.water.finding import Water, find_water
from bare_earth.algorithms.tools.water.grid import WaterGrid

_WIDE, _HIGH, _DENSITY = 500.0, 300.0, 4.0


def _to_lake(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the distance of places from a lake in metres; negative inside."""
    angle = np.arctan2(y - 200, x - 380)
    return np.hypot(x - 380, y - 200) - 60 * (1 + 0.25 * np.sin(3 * angle))


def _to_river(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.abs(y - 75 - 25 * np.sin(x / 80)) - 18


def water() -> None:
    """Draw the counts of last returns, and the water with its levels on the ground."""
    random = np.random.default_rng(5)
    x, y = random.uniform(0, (_WIDE, _HIGH), (int(_WIDE * _HIGH * _DENSITY), 2)).T
    z = 103 + 0.02 * y + 1.5 * np.sin(x / 37) * np.cos(y / 41)
    for away, level in ((_to_lake(x, y), 104.0), (_to_river(x, y), 101 - 0.003 * x)):
        z = np.minimum(z, level + 0.3 * np.clip(away, 0, None))
    z += random.normal(0, 0.03, len(x))
    wood = np.hypot(x - 120, y - 220) < 55
    inside = np.minimum(_to_lake(x, y), _to_river(x, y)) < 0
    keep = ~inside | (random.random(len(x)) < 0.04)
    points, ground = Points(x[keep], y[keep], z[keep]), ~(wood | inside)[keep]
    grid = WaterGrid((0.0, 0.0, _WIDE - 0.01, _HIGH - 0.01), 1.0)
    none = np.zeros(points.count, bool)
    grid.add(points, ground, none, ~none, none)
    figure, panels = pyplot.subplots(1, 2, figsize=(8.6, 3.0), layout="constrained")
    extent = (0, _WIDE, 0, _HIGH)
    panels[0].imshow(grid.counts, cmap="Greys", vmax=8, origin="lower", extent=extent)
    heights = np.where(np.isfinite(grid.ground), grid.ground, np.nan)
    panels[1].imshow(heights, cmap="terrain", vmin=96, vmax=116, origin="lower", extent=extent)
    for body in find_water(grid, Water()):
        panels[1].fill(*body.rings[0][:, :2].T, color="#7db4e6", ec="#1565d8", lw=1.5)
        text = f"{body.level:.1f} m"
        if body.kind == "river":
            for line in body.lines:
                panels[1].plot(*line[:, :2].T, color="#1565d8", lw=1, ls="--")
            text = f"{body.level:.1f} to {body.lowest:.1f} m"
        corners = np.concatenate(body.lines) if body.kind == "river" else body.rings[0]
        middle = corners[len(corners) // 2, :2] if body.kind == "river" else corners[:, :2].mean(0)
        panels[1].annotate(f"{body.kind}\n{text}", middle, ha="center", va="center", fontsize=8)
    titles = "last returns in each cell", "ground, and the water that is found"
    for panel, title in zip(panels, titles):
        panel.set(title=title, xticks=[], yticks=[])
    save(figure, "water", colours=FEW_COLOURS)
