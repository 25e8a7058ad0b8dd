"""The figure of the expected error beside the error as it is, on three kinds of land."""

from __future__ import annotations

import numpy as np
from drawing import save
from matplotlib import pyplot
from matplotlib.colors import LogNorm

from bare_earth.algorithms.grids.dense_surface import DenseSurface
from bare_earth.algorithms.grids.expected_error import CELL, expected_error
from bare_earth.algorithms.grids.surface import Surface
from bare_earth.algorithms.survey.point_counts import PointCounts
from bare_earth.algorithms.survey.selection import Selection
from benchmarks import data
from benchmarks.measure import GROUND, Filter

# Tiles of the benchmarks, and what a reader calls them.
TILES = {"conifer_1.laz": "forest", "ahn3_urban.laz": "town", "hillside_images.laz": "images"}
# Errors in metres between which the colours differ.
LIMITS = (0.03, 3.0)


def expected_and_found() -> None:
    """Draw the expected error of the default filter, and its error, of three tiles."""
    figure, axes = pyplot.subplots(2, 3, figsize=(8.2, 5.6), layout="constrained")
    drawn = None
    for (name, title), (above, below) in zip(TILES.items(), axes.T):
        cloud, reference = data.load(data.real(name))
        points = cloud.points(np.ones(cloud.count, dtype=bool))
        takes_part = Selection().choose(cloud, PointCounts())
        ground = Filter("tin-densification").ground(cloud)[takes_part]
        used = points.take(takes_part)
        cells, values = expected_error(used, ground)
        y, x = (
            (first + np.arange(count) + 0.5) * CELL
            for first, count in zip(cells.first, cells.shape)
        )
        centres = [axis.ravel() for axis in np.meshgrid(x, y)]
        heights, truth = (
            Surface(some.take(DenseSurface(some, CELL).vertices)).heights(*centres)
            for some in (used.take(ground), points.take(reference == GROUND))
        )
        error = np.abs(heights - truth).reshape(cells.shape)
        known = np.isfinite(error)
        inside = np.mean(error[known] <= values[known])
        for panel, shown in ((above, values), (below, error)):
            drawn = panel.imshow(
                np.where(known, np.clip(shown, *LIMITS), np.nan),
                cmap="magma_r", norm=LogNorm(*LIMITS), origin="lower", interpolation="nearest",
            )  # fmt: skip
            panel.set(xticks=[], yticks=[])
        above.set_title(f"{title}: expected")
        below.set_title(f"{title}: as it is, {inside:.0%} inside")
    if drawn is not None:
        figure.colorbar(drawn, ax=axes, label="metres", shrink=0.7)
    save(figure, "expected-error")
