"""One picture of a classified cloud: relief, plan, a profile, and errors where truth is known."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import laspy
import matplotlib
import numpy as np

matplotlib.use("Agg")

from matplotlib import pyplot
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from bare_earth.algorithms.crs.system import unit_symbol
from bare_earth.algorithms.rasters.geotiff import read_raster

GROUND = 2
_PIXELS = 700
_STRIPS = 40
# Told apart by colour-blind eyes, and in print.
_COLOURS = {
    "none": "#ffffff",
    "ground": "#c9a368",
    "other": "#1f6f78",
    "ground taken for other": "#d1157f",
    "other taken for ground": "#f07f09",
}
_SUPTITLE = {"fontsize": 15, "x": 0.012, "ha": "left", "fontweight": "bold"}


@dataclass(frozen=True)
class View:
    """What is drawn: the points, what they became, and the terrain model.

    Attributes
    ----------
    kind : numpy.ndarray of uint8
        Index of the colour of each point in `_COLOURS`.
    extent : tuple of float
        West, east, south, north, in units of the CRS.
    units : tuple of str
        Symbols of the units of the CRS and of the heights.
    """

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    kind: np.ndarray
    dtm: np.ndarray
    hillshade: np.ndarray
    geotransform: tuple[float, ...]
    extent: tuple[float, float, float, float]
    units: tuple[str, str]


class Truth(NamedTuple):
    """The same points with their true classes."""

    path: Path
    ground_classes: tuple[int, ...] = (GROUND,)
    unlabelled: tuple[int, ...] = ()  # classes of points whose truth is not known


def draw(
    cloud: Path,
    dtm: Path,
    hillshade: Path,
    target: Path,
    truth: Truth | None = None,
    northing: float | None = None,
    title: str = "",
) -> None:
    """Draw a classified cloud and its terrain model.

    Parameters
    ----------
    cloud, dtm, hillshade : Path
        What the classification made.
    target : Path
        The PNG file to write.
    truth : Truth, optional
        With it, errors are marked.
    northing : float, optional
        Where to cut the profile; where most is standing on the ground if it is not given.
    title : str
        The heading.
    """
    view = _view(cloud, dtm, hillshade, truth)
    count = 2 if truth is None else 3
    figure = pyplot.figure(figsize=(6.0 * count, 10.4), layout="constrained", dpi=110)
    figure.suptitle(title, **_SUPTITLE)
    upper, lower = figure.subfigures(2, 1, height_ratios=(6.2, 4.0))
    panels = upper.subplots(1, count)
    northing = busiest_northing(view) if northing is None else northing
    _draw_relief(panels[0], view)
    _draw_plan(panels[1], view)
    if truth is not None:
        _draw_errors(panels[2], view)
    for panel in panels:
        panel.axhline(northing, color="black", linewidth=0.8, linestyle=(0, (6, 4)))
        panel.set(xticks=[], yticks=[], xlim=view.extent[:2], ylim=view.extent[2:])
    _draw_profile(lower.subplots(), view, northing, truth is not None)
    figure.savefig(target)
    pyplot.close(figure)


def _view(cloud: Path, dtm: Path, hillshade: Path, truth: Truth | None) -> View:
    las = laspy.read(cloud)
    ground = np.asarray(las.classification) == GROUND
    kind = np.where(ground, 1, 2).astype(np.uint8)
    if truth is not None:
        classes = np.asarray(laspy.read(truth.path).classification)
        should, is_known = (
            np.isin(classes, truth.ground_classes),
            ~np.isin(classes, truth.unlabelled),
        )
        kind[is_known & should & ~ground] = 3
        kind[is_known & ~should & ground] = 4
    terrain, shade = read_raster(dtm), read_raster(hillshade).heights
    west, width, _, north, _, height = terrain.geotransform
    rows, columns = terrain.heights.shape
    extent = west, west + columns * width, north + rows * height, north
    frame = terrain.frame
    units = unit_symbol(frame.horizontal_unit), unit_symbol(frame.vertical_unit)
    # Plain arrays: each access to a column of laspy scales it anew.
    x, y, z = (np.asarray(column) for column in (las.x, las.y, las.z))
    return View(x, y, z, kind, terrain.heights, shade, terrain.geotransform, extent, units)


def _draw_relief(panel: pyplot.Axes, view: View) -> None:
    shade = np.ma.masked_invalid(view.hillshade)
    panel.imshow(shade, cmap="gray", extent=view.extent, vmin=0, vmax=255)
    # A few odd heights must not take the colours of all the rest.
    low, high = np.nanpercentile(view.dtm, (1, 99))
    image = panel.imshow(
        view.dtm, cmap="gist_earth", extent=view.extent, alpha=0.35, vmin=low, vmax=high
    )
    bar = panel.figure.colorbar(image, ax=panel, shrink=0.6, pad=0.01)
    bar.solids.set_alpha(1)
    bar.set_label(f"Height [{view.units[1]}]")
    panel.set_title("Terrain model", loc="left")


def _draw_plan(panel: pyplot.Axes, view: View) -> None:
    """Draw the highest point of each pixel, as one sees it from above."""
    as_classified = np.choose(view.kind, (0, 1, 2, 2, 1))
    order = np.argsort(view.z, kind="stable")
    _imshow(panel, _pixels(view, order, as_classified[order]), view)
    panel.set_title("Seen from above", loc="left")
    share = 100 * np.count_nonzero(as_classified == 1) / len(view.z)
    panel.legend(
        handles=_handles({"ground": f"ground ({share:.1f} %)", "other": "other"}),
        loc="lower right",
        framealpha=1,
    )


def _draw_errors(panel: pyplot.Axes, view: View) -> None:
    wrong = np.flatnonzero(view.kind > 2)
    panel.imshow(view.hillshade, cmap="gray", extent=view.extent, vmin=-250, vmax=255, alpha=0.6)
    pixels = _pixels(view, wrong, view.kind[wrong])
    # A single pixel is too small to see.
    for axis, step in ((0, 1), (1, 1)):
        pixels = np.maximum(pixels, np.roll(pixels, step, axis))
    _imshow(panel, np.ma.masked_equal(pixels, 0), view)
    names = list(_COLOURS)
    counts = {
        names[kind]: f"{names[kind]} ({np.count_nonzero(view.kind == kind):,})" for kind in (3, 4)
    }
    panel.set_title("Errors against the truth", loc="left")
    panel.legend(handles=_handles(counts), loc="lower right", framealpha=1)


def _draw_profile(panel: pyplot.Axes, view: View, northing: float, with_errors: bool) -> None:
    west, east, south, north = view.extent
    half = (north - south) / 200
    cut = np.flatnonzero(np.abs(view.y - northing) < half)
    column = np.arange(view.dtm.shape[1])
    row = int((northing - view.geotransform[3]) / view.geotransform[5])
    line = view.dtm[min(max(row, 0), view.dtm.shape[0] - 1)]
    names = list(_COLOURS)
    for kind in range(1, 5):
        which = cut[view.kind[cut] == kind]
        size = 2.5 if kind < 3 else 14
        colour = _COLOURS[names[kind]]
        panel.scatter(view.x[which] - west, view.z[which], size, colour, linewidths=0, zorder=kind)
    centres = (column + 0.5) * view.geotransform[1]
    panel.plot(centres, line, color="black", linewidth=1.0, zorder=5)
    spread = np.nanmax(line) - np.nanmin(line)
    # Noise far above and far below would flatten all the rest.
    panel.set_ylim(
        min(np.percentile(view.z[cut], 0.05), np.nanmin(line)) - 0.1 * spread - 1,
        np.percentile(view.z[cut], 99.9) + 0.1 * spread + 2,
    )
    panel.set_xlim(0, east - west)
    across = f"{2 * half:.1f} {view.units[0]} wide"
    panel.set_title(f"Profile from west to east, {across}, along the dashed line", loc="left")
    panel.set(xlabel=f"From the west [{view.units[0]}]", ylabel=f"Height [{view.units[1]}]")
    shown = names[1:] if with_errors else names[1:3]
    handles = _handles({name: name for name in shown})
    handles += panel.plot([], [], color="black", label="terrain model")
    panel.legend(handles=handles, loc="upper left", ncols=len(handles), framealpha=1)
    panel.grid(color="#dddddd", linewidth=0.5)
    panel.set_axisbelow(True)


def busiest_northing(view: View) -> float:
    """Return where a cut from west to east meets most points that are not ground.

    Only in the middle: the border shows little of a tile.
    """
    south, north = view.extent[2:]
    northings = view.y[np.isin(view.kind, (2, 3))]
    quarter = (north - south) / 4
    counts, edges = np.histogram(northings, _STRIPS, (south + quarter, north - quarter))
    best = int(np.argmax(counts))
    return float(edges[best] + edges[best + 1]) / 2


def _pixels(view: View, which: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return an image of values of points, of which a later one covers an earlier one."""
    west, east, south, north = view.extent
    pixel = max(east - west, north - south) / _PIXELS
    # Where points are sparse, pixels follow them, so that few stay empty.
    pixel = max(pixel, 1.8 * np.sqrt((east - west) * (north - south) / max(len(view.x), 1)))
    shape = int(np.ceil((north - south) / pixel)), int(np.ceil((east - west) / pixel))
    row = np.clip((north - view.y[which]) / pixel, 0, shape[0] - 1).astype(int)
    column = np.clip((view.x[which] - west) / pixel, 0, shape[1] - 1).astype(int)
    image = np.zeros(shape, dtype=np.uint8)
    image[row, column] = values
    return image


def _imshow(panel: pyplot.Axes, pixels: np.ndarray, view: View) -> None:
    colours = ListedColormap(list(_COLOURS.values()))
    panel.imshow(pixels, cmap=colours, vmin=0, vmax=4, extent=view.extent, interpolation="nearest")


def _handles(labels: dict[str, str]) -> list[Patch]:
    return [Patch(color=_COLOURS[name], label=label) for name, label in labels.items()]


def main() -> None:
    """Draw the files that the command line names."""
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("cloud", "dtm", "hillshade", "target"):
        parser.add_argument(name, type=Path)
    parser.add_argument("--truth", type=Path)
    parser.add_argument("--ground-classes", type=int, nargs="+", default=(GROUND,))
    options = parser.parse_args()
    truth = Truth(options.truth, tuple(options.ground_classes)) if options.truth else None
    draw(
        options.cloud, options.dtm, options.hillshade, options.target, truth,
        title=options.cloud.name,
    )  # fmt: skip


if __name__ == "__main__":
    main()
