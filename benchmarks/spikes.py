"""Spikes and pits of terrain models: places that anybody sees in a hillshade.

`python -m benchmarks.spikes --tile conifer_2 --folder pictures` draws each of them: the relief
round it, a profile through it, and the rule that decided its cell.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Sequence

import numpy as np

from bare_earth.algorithms.classes.point_counts import PointCounts
from bare_earth.algorithms.classes.selection import Selection
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.relief.hillshade import hillshade

from . import data
from .accuracy import method_name
from .deciding_rules import name_of
from .measure import ReferenceModel
from .places import FROM, places_off

# Metres round a place that its picture shows, and half the width of the strip of its profile.
_AROUND, _STRIP = 25.0, 0.75


def main(arguments: Sequence[str] | None = None) -> None:
    """Draw the spikes and pits that the command line asks for."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.spikes",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--method", type=method_name, default="tin-densification", help="of ours")
    tiles = {tile.title: tile for tile in data.REAL if data.real(tile.name).exists()}
    parser.add_argument("--tile", nargs="+", choices=list(tiles), default=list(tiles))
    parser.add_argument("--folder", type=Path, required=True, help="where pictures are written")
    options = parser.parse_args(arguments)
    for title in options.tile:
        for line in draw_tile(tiles[title].name, options.method, options.folder):
            print(line, flush=True)


def draw_tile(name: str, method: str, folder: Path) -> list[str]:
    """Draw the spikes and pits of a tile, and return a line about each of them."""
    cloud, reference = data.load(data.real(name))
    model = ReferenceModel(cloud, reference)
    points = cloud.points(np.ones(cloud.count, dtype=bool))
    # As a run chooses them: last and single returns.
    part = np.flatnonzero(Selection().choose(cloud, PointCounts(), None, None))
    several = cloud.number_of_returns[part] > 1
    chosen = METHODS[method]
    found = chosen.ground(
        points.take(part), chosen.parameters(), multi_return=several, explains=True
    )
    ground, codes = np.zeros(cloud.count, dtype=bool), np.zeros(cloud.count, dtype=np.int64)
    ground[part], codes[part] = found.ground, found.decided.codes
    difference = model.of(ground) - model.heights
    lines = []
    for number, place in enumerate(places_off(difference), start=1):
        x, y = model.centre(place.row, place.column)
        near = (np.abs(points.x - x) <= 1.5) & (np.abs(points.y - y) <= 1.5)
        some = near & ground if (near & ground).any() else near
        rule = _deciding(codes[some], found.decided.rules)
        kind = "spike" if place.height > 0 else "pit"
        stem = f"{Path(name).stem.split('.')[0]}-{kind}-{number:02}-{rule}"
        title = f"{stem}: {place.height:+.1f} m in {place.cells} cells at ({x:.0f}, {y:.0f})"
        target = folder / f"{stem}.png"
        _draw(model, points, reference, ground, difference, place, title, target)
        lines.append(title)
    return lines or [f"{name}: no spike and no pit"]


def _deciding(codes: np.ndarray, rules: tuple[str, ...]) -> str:
    """Return the rule that decided most of some points."""
    codes = codes[codes > 0]
    if not len(codes):
        return "none"
    return name_of(int(np.bincount(codes).argmax()), rules)


def _draw(model, points, reference, ground, difference, place, title, target) -> None:
    """Draw the relief round a place, and a profile through it."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    reach = int(_AROUND)
    rows = slice(max(place.row - reach, 0), place.row + reach + 1)
    columns = slice(max(place.column - reach, 0), place.column + reach + 1)
    heights = model.heights[rows, columns]
    figure = Figure(figsize=(9.0, 6.5), layout="constrained")
    FigureCanvasAgg(figure)
    upper, below = figure.subfigures(2, 1)
    for axes, values, words in zip(
        upper.subplots(1, 2), (heights + difference[rows, columns], heights), ("ours", "reference")
    ):
        shade = np.ma.masked_equal(hillshade(values, model.cell_size), 0)
        axes.imshow(shade, cmap="gray", vmin=1, vmax=255, interpolation="nearest")
        if words == "ours":
            off = np.abs(np.nan_to_num(difference[rows, columns])) > FROM
            if off.any() and not off.all():
                axes.contour(off, levels=[0.5], colors="#e02020", linewidths=1.0)
        axes.set_title(words, fontsize=9)
        axes.set_axis_off()
    axes = below.subplots()
    x, y = model.centre(place.row, place.column)
    strip = (np.abs(points.y - y) <= _STRIP) & (np.abs(points.x - x) <= _AROUND)
    for some, colour, words in (
        (strip & ~ground, "#b0b0b0", "other"), (strip & ground, "#9c5a1a", "our ground"),
        (strip & (reference == 2), "#1565d8", "ground of the reference"),
    ):  # fmt: skip
        size = 4 if words == "other" else 14 if words == "our ground" else 5
        axes.scatter(
            points.x[some] - x, points.z[some], s=size, c=colour, label=words, linewidths=0
        )
    along = np.arange(columns.start, min(columns.stop, model.heights.shape[1])) - place.column
    for values, colour in ((heights, "#1565d8"), (heights + difference[rows, columns], "#9c5a1a")):
        axes.plot(along, values[place.row - rows.start], c=colour, linewidth=0.8)
    axes.set_xlabel("m to the east")
    axes.set_ylabel("m")
    axes.legend(fontsize=7)
    figure.suptitle(title, fontsize=9)
    target.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(target, dpi=90)


if __name__ == "__main__":
    main()
