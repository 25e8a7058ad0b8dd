"""The figures of the page about relief: one place of a forest, one of fields, in each picture."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
import rasterio
from drawing import save
from matplotlib import pyplot
from matplotlib.axes import Axes

from bare_earth.algorithms import (
    ClassifyRequest,
    RasterFiles,
    TerrainModel,
    classify,
    write_relief,
)
from benchmarks.data import real

# A tile, side of its cells, first row and column that are shown, and a word for it.
_FOREST = "hawaii_forest", 1.0, 0, 60
_FIELDS = "nrw_rural", 0.5, 370, 120
_ROWS, _COLUMNS = 330, 300
# The picture, its title, and the values that are black and white in forest and fields.
_PICTURES = {
    "hillshade": ("hillshade, four lights", (20, 255), (20, 255)),
    "slope": ("slope, 0° white", (50, 0), (15, 0)),
    "local-relief": ("local relief", (-1.0, 1.0), (-0.4, 0.4)),
    "multi-scale-relief": ("multi-scale relief", (-1.0, 1.0), (-0.4, 0.4)),
    "sky-view": ("sky-view factor", (0.6, 1.0), (0.85, 1.0)),
    "openness": ("positive openness", (68, 95), (82, 93)),
    "negative-openness": ("negative openness, upside down", (105, 75), (96, 84)),
    "local-dominance": ("local dominance", (0.5, 1.8), (0.7, 1.5)),
    "vat": ("archaeological topography (VAT)", (1, 255), (1, 255)),
}


def relief() -> None:
    """Draw a figure of the forest and one of the fields, and red relief of both."""
    with tempfile.TemporaryDirectory() as name:
        for number, (tile, cell, top, left) in enumerate((_FOREST, _FIELDS)):
            folder = Path(name) / tile
            folder.mkdir()
            _draw(folder, tile, cell, np.s_[..., top : top + _ROWS, left : left + _COLUMNS], number)


def _draw(folder: Path, tile: str, cell: float, window: tuple[slice, ...], number: int) -> None:
    """Draw all pictures of a part of a tile."""
    dtm = folder / "dtm.tif"
    request = ClassifyRequest(
        rasters=RasterFiles(dtm=dtm), terrain=TerrainModel(dtm_cell_size=cell)
    )
    classify(real(f"{tile}.laz"), folder / "ground.laz", request)
    figure, axes = pyplot.subplots(2, 5, figsize=(12.5, 5.9), layout="constrained")
    for panel, (kind, (title, *ends)) in zip(axes.flat, _PICTURES.items()):
        (values,) = _made(dtm, kind, window)
        black, white = ends[number]
        grey = np.clip((values - black) / (white - black), 0.0, 1.0)
        _show(panel, np.repeat(grey[..., None], 3, axis=2), title)
    red = np.moveaxis(_made(dtm, "red-relief", window), 0, -1) / 255.0
    _show(axes[-1, -1], red, "red relief")
    save(figure, f"relief-{tile.replace('_', '-')}", 75, 64)


def _made(dtm: Path, kind: str, window: tuple[slice, ...]) -> np.ndarray:
    """Return a picture of a terrain model; shape (bands, rows, columns)."""
    target = dtm.with_name(f"{kind}.tif")
    write_relief(dtm, target, kind)
    with rasterio.open(target) as raster:
        return raster.read()[window].astype(float)


def _show(panel: Axes, colours: np.ndarray, title: str) -> None:
    panel.imshow(colours, interpolation="nearest")
    panel.set_title(title)
    panel.set_xticks([])
    panel.set_yticks([])
