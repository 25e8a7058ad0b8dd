"""The figure of the expected error beside the error as it is, on three kinds of land."""

from __future__ import annotations

import numpy as np
from drawing import save
from matplotlib import pyplot
from matplotlib.colors import LogNorm

from benchmarks.data import real
from benchmarks.expected_error import all_cells

# Tiles of the benchmarks, and what a reader calls them.
TILES = {"conifer_1.laz": "forest", "ahn3_urban.laz": "town", "hillside_images.laz": "images"}
# Errors in metres between which the colours differ.
LIMITS = (0.03, 3.0)


def expected_and_found() -> None:
    """Draw the expected error of the default filter, and its error, of three tiles."""
    figure, axes = pyplot.subplots(2, 3, figsize=(8.2, 5.6), layout="constrained")
    drawn = None
    for (name, title), (above, below) in zip(TILES.items(), axes.T):
        values, error = all_cells(real(name))
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
