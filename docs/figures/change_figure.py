"""The figure of the tutorial on change: what was put in, and what was found."""

from __future__ import annotations

import json
import tempfile
from pathlib import Path

import laspy
import numpy as np
import rasterio
from drawing import save, shade
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.image import AxesImage
from matplotlib.patches import Rectangle

import bare_earth
from demo.change import PUT, write_change
from demo.land import LANDS

_PUT, _FOUND = "#7a2fb5", "#111111"
_FULL = 1.0  # metres from which colours are full


def change_tutorial() -> None:
    """Draw the surface of the changed half, its terrain, and the changes of both pairs."""
    figure, panels = pyplot.subplots(2, 2, figsize=(8.2, 5.4), layout="constrained")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_change(folder)
        made = {kind: folder / f"{kind}.tif" for kind in ("dtm", "dsm")}
        bare_earth.classify(folder / "new.laz", folder / "ground.las", dtm=made["dtm"])
        bare_earth.terrain(folder / "ground.las", dsm=made["dsm"])
        for panel, kind in zip(panels[0], ("dsm", "dtm")):
            shade(panel, _cells(made[kind])[0])
        for panel, new in zip(panels[1], ("same", "new")):
            image = _change(panel, folder, new)
        for panel in (panels[0, 0], panels[1, 1]):
            _outline(panel, _cells(made["dtm"])[1])
        figure.colorbar(image, ax=panels[1], shrink=0.7, pad=0.01, label="m")
    titles = (
        "new.laz: all points, and what was put in", "new.laz: its ground",
        "same.laz minus old.laz", "new.laz minus old.laz; black: the places found",
    )  # fmt: skip
    for panel, title in zip(panels.flat, titles):
        panel.set_title(title)
    save(figure, "change-tutorial")


def _cells(path: Path) -> tuple[np.ndarray, rasterio.Affine]:
    """Return the cells of a raster, and the rows and columns of coordinates."""
    with rasterio.open(path) as raster:
        return raster.read(1, masked=True).astype(float).filled(np.nan), ~raster.transform


def _change(panel: Axes, folder: Path, new: str) -> AxesImage:
    """Draw the change of a pair, and the places that were found."""
    files = [folder / name for name in ("old.laz", f"{new}.laz", "change.tif")]
    bare_earth.change(*files, places=folder / "places.geojson")
    values, to_cells = _cells(files[-1])
    image = panel.imshow(values, cmap="RdBu", vmin=-_FULL, vmax=_FULL)
    for feature in json.loads((folder / "places.geojson").read_text("utf-8"))["features"]:
        column, row = to_cells * np.array(feature["geometry"]["coordinates"][0]).T
        panel.plot(column - 0.5, row - 0.5, color=_FOUND, lw=1.0)
    panel.set(xticks=[], yticks=[])
    return image


def _outline(panel: Axes, to_cells: rasterio.Affine) -> None:
    """Draw the rectangles in which something was put, with their names."""
    west, south, _ = laspy.read(LANDS["campus"].path).header.mins
    for put in PUT:
        column, row = to_cells * (west + put.x - put.along, south + put.y + put.across)
        corner, sides = (column - 0.5, row - 0.5), (2 * put.along, 2 * put.across)
        panel.add_patch(Rectangle(corner, *sides, fill=False, ec=_PUT, lw=0.9))
        style = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.6}
        panel.text(column, row - 1.8, put.name, color=_PUT, fontsize=6.5, bbox=style)
