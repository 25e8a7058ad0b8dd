"""The figures of the page about relief: a forest and fields in pictures, and a table of walls."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import laspy
import numpy as np
import rasterio
from drawing import save
from matplotlib import pyplot
from matplotlib.axes import Axes

import bare_earth
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
            _draw(folder, tile, cell, np.s_[:, top : top + _ROWS, left : left + _COLUMNS], number)


def _draw(folder: Path, tile: str, cell: float, window: tuple[slice, ...], number: int) -> None:
    """Draw all pictures of a part of a tile."""
    dtm = folder / "dtm.tif"
    source = real(f"{tile}.laz")
    bare_earth.classify(source, folder / "ground.laz", dtm=dtm, dtm_cell_size=cell)
    figure, axes = pyplot.subplots(2, 5, figsize=(12.5, 5.9), layout="constrained")
    for panel, (kind, (title, *ends)) in zip(axes.flat, _PICTURES.items()):
        (values,) = _made(dtm, kind, window)
        black, white = ends[number]
        grey = np.clip((values - black) / (white - black), 0.0, 1.0)
        _show(panel, np.repeat(grey[..., None], 3, axis=2), title)
    red = np.moveaxis(_made(dtm, "red-relief", window), 0, -1) / 255.0
    _show(axes[-1, -1], red, "red relief")
    save(figure, f"relief-{tile.replace('_', '-')}", 75, 64)


def _made(dtm: Path, kind: Any, window: tuple[slice, ...]) -> np.ndarray:
    """Return a picture of a terrain model; shape (bands, rows, columns)."""
    target = dtm.with_name(f"{kind}.tif")
    bare_earth.relief(dtm, target, kind=kind)
    with rasterio.open(target) as raster:
        return raster.read()[window].astype(float)


def _show(panel: Axes, colours: np.ndarray, title: str) -> None:
    panel.imshow(colours, interpolation="nearest")
    panel.set_title(title)
    panel.set_xticks([])
    panel.set_yticks([])


# Walls and banks of these widths and heights in metres, on a slope half in a wood.
_WALLS = ((1.0, 0.4), (1.0, 0.7), (1.0, 1.0), (2.0, 0.7), (2.0, 1.0))
_TOLERANCES = 0.18, 0.5, 0.8, 1.0
_SIDE, _DENSITY, _APART, _SEED = 160.0, 8.0, 25.0, 2


def walls() -> None:
    """Print which share of walls and banks is ground, by the tolerance."""
    draw = np.random.default_rng(_SEED)
    count = int(_SIDE**2 * _DENSITY)
    x, y = draw.uniform(0, _SIDE, (2, count))
    z = 100.0 + 0.1 * x + 1.5 * np.sin(y / 25.0) + draw.normal(0, 0.03, count)
    on, long = np.zeros(count, dtype=int), (x > 20) & (x < _SIDE - 20)
    for number, (width, height) in enumerate(_WALLS, 1):
        off = np.abs(y - _APART * number)
        # Their sides are as steep as 59 degrees.
        lift = np.clip((width / 2 + 0.3 * height - off) / (0.6 * height), 0, 1)
        z += np.where(long, height * lift, 0.0)
        on[long & (off < width / 2)] = number
    wood, kind = x > _SIDE / 2, draw.uniform(size=count)
    tree, plant = wood & (kind < 0.6), wood & (kind >= 0.6) & (kind < 0.68)
    z[tree] += draw.uniform(3, 18, np.count_nonzero(tree))
    z[plant] += draw.uniform(0.1, 0.6, np.count_nonzero(plant))
    header = laspy.LasHeader(version="1.4", point_format=6)
    header.scales = [0.001] * 3
    cloud = laspy.LasData(header)
    cloud.x, cloud.y, cloud.z = x, y, z
    with tempfile.TemporaryDirectory() as name:
        source, target = Path(name) / "in.las", Path(name) / "out.las"
        cloud.write(source)
        for tolerance in _TOLERANCES:
            bare_earth.classify(source, target, ground_tolerance=tolerance)
            ground = np.asarray(laspy.read(target).classification) == 2
            shares = [
                ", ".join(
                    _percent(ground[(on == number) & side & ~tree & ~plant])
                    for side in (~wood, wood)
                )
                for number, _ in enumerate(_WALLS, 1)
            ]
            cells = f"{tolerance:g} m", *shares, _percent(ground[plant])
            print(f"| {' | '.join(cells)} |")


def _percent(values: np.ndarray) -> str:
    return f"{100 * np.mean(values):.0f} %"
