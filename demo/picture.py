"""One picture of a classified cloud: relief, plan, a profile, and errors where truth is known."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path
from typing import Iterable, NamedTuple, Sequence

import laspy
import numpy as np

from bare_earth.algorithms.crs.system import unit_symbol
from bare_earth.algorithms.rasters.geotiff import read_raster
from bare_earth.algorithms.report.pictures import HEIGHTS, ramped, rgb

from .canvas import Canvas

GROUND = 2
_SIDE = 700  # pixels of the longer side of a map
_PROFILE = 360
_MARGIN = 70
_STRIPS = 40
_TICKS = 7
# Told apart by colour-blind eyes, and in print.
_COLOURS = {
    "none": "#ffffff",
    "ground": "#c9a368",
    "other": "#1f6f78",
    "ground taken for other": "#d1157f",
    "other taken for ground": "#f07f09",
}
_NAMES = list(_COLOURS)


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


class _Map(NamedTuple):
    title: str
    pixels: np.ndarray
    labels: dict[str, str]  # of its colours


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
    northing = busiest_northing(view) if northing is None else northing
    west, east, south, north = view.extent
    scale = _SIDE / max(east - west, north - south)
    shape = round((east - west) * scale), round((north - south) * scale)
    maps = [_relief(view), _plan(view)] + ([_errors(view)] if truth is not None else [])
    width = _MARGIN + len(maps) * (shape[0] + _MARGIN)
    canvas = Canvas(width, shape[1] + _PROFILE + 260)
    canvas.text(20, 14, title, 22)
    for number, (name, pixels, labels) in enumerate(maps):
        x = _MARGIN + number * (shape[0] + _MARGIN)
        canvas.text(x, 54, name, 16)
        canvas.pixels(pixels, x, 80, shape)
        cut = 80 + (north - northing) * scale
        for dash in range(0, shape[0] - 5, 12):
            canvas.line(np.array([x + dash, x + dash + 7]), np.array([cut, cut]))
        canvas.keys(x, 80 + shape[1] + 16, {_COLOURS[name]: key for name, key in labels.items()})
    _draw_bar(canvas, view, (_MARGIN, 80 + shape[1] + 16))
    top = shape[1] + 170
    _draw_profile(canvas, view, northing, (_MARGIN, top, width - 2 * _MARGIN), truth is not None)
    canvas.save(target)


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


def _limits(view: View) -> tuple[float, float]:
    """Return the heights that have the first and the last colour."""
    # A few odd heights must not take the colours of all the rest.
    low, high = np.nanpercentile(view.dtm, (1, 99))
    return float(low), float(max(high, low + 0.01))


def _relief(view: View) -> _Map:
    colours = ramped(view.dtm, HEIGHTS, *_limits(view))
    shade = np.nan_to_num(view.hillshade, nan=255.0)[..., None]
    pixels = np.where(np.isnan(view.dtm)[..., None], 255, 0.6 * shade + 0.4 * colours)
    return _Map("Terrain model", pixels.astype(np.uint8), {})


def _plan(view: View) -> _Map:
    """Return the highest point of each pixel, as one sees it from above."""
    as_classified = np.choose(view.kind, (0, 1, 2, 2, 1))
    order = np.argsort(view.z, kind="stable")
    pixels = _palette(_pixels(view, order, as_classified[order]))
    share = 100 * np.count_nonzero(as_classified == 1) / len(view.z)
    return _Map("Seen from above", pixels, {"ground": f"ground ({share:.1f} %)", "other": "other"})


def _errors(view: View) -> _Map:
    wrong = np.flatnonzero(view.kind > 2)
    kinds = _pixels(view, wrong, view.kind[wrong])
    # A single pixel is too small to see.
    for axis in (0, 1):
        kinds = np.maximum(kinds, np.roll(kinds, 1, axis))
    rows, columns = (np.arange(n) * of // n for n, of in zip(kinds.shape, view.hillshade.shape))
    shade = np.nan_to_num(view.hillshade, nan=255.0)[rows[:, None], columns]
    pale = (150 + 105 * shade / 255)[..., None]
    pixels = np.where(kinds[..., None] > 0, _palette(kinds), pale).astype(np.uint8)
    counts = {
        _NAMES[kind]: f"{_NAMES[kind]} ({np.count_nonzero(view.kind == kind):,})" for kind in (3, 4)
    }
    return _Map("Errors against the truth", pixels, counts)


def _draw_bar(canvas: Canvas, view: View, place: tuple[int, int]) -> None:
    """Draw the colours of heights below the relief."""
    x, y = place
    low, high = _limits(view)
    canvas.pixels(
        ramped(np.linspace(low, high, 200)[None], HEIGHTS, low, high), x, y - 6, (200, 12)
    )
    canvas.text(x + 210, y, f"height {low:.1f} to {high:.1f} {view.units[1]}", anchor="lm")


def _draw_profile(
    canvas: Canvas, view: View, northing: float, place: tuple[int, int, int], with_errors: bool
) -> None:
    left, top, width = place
    west, east, south, north = view.extent
    half = (north - south) / 200
    cut = np.flatnonzero(np.abs(view.y - northing) < half)
    row = int((northing - view.geotransform[3]) / view.geotransform[5])
    line = view.dtm[min(max(row, 0), view.dtm.shape[0] - 1)]
    spread = np.nanmax(line) - np.nanmin(line)
    # Noise far above and far below would flatten all the rest.
    low = min(np.percentile(view.z[cut], 0.05), np.nanmin(line)) - 0.1 * spread - 1
    high = np.percentile(view.z[cut], 99.9) + 0.1 * spread + 2

    def at(along: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return left + along / (east - west) * width, top + (high - z) / (high - low) * _PROFILE

    across = f"{2 * half:.1f} {view.units[0]} wide"
    canvas.text(left, top - 52, f"Profile from west to east, {across}, along the dashed line", 16)
    _draw_axes(canvas, place, (east - west, low, high), view.units)
    is_seen = (view.z[cut] > low) & (view.z[cut] < high)
    for kind in range(1, 5):
        which = cut[is_seen & (view.kind[cut] == kind)]
        size = 3 if kind < 3 else 5
        canvas.dots(*at(view.x[which] - west, view.z[which]), size, _COLOURS[_NAMES[kind]])
    centres = (np.arange(len(line)) + 0.5) * view.geotransform[1]
    known = np.flatnonzero(np.isfinite(line))
    for run in np.split(known, np.flatnonzero(np.diff(known) > 1) + 1):
        canvas.line(*at(centres[run], line[run]), width=1.5)
    shown = _NAMES[1:] if with_errors else _NAMES[1:3]
    canvas.keys(left, top + _PROFILE + 60, {_COLOURS[name]: name for name in shown})
    end = left + width
    canvas.line(np.array([end - 130, end - 100]), np.full(2, top + _PROFILE + 60), 1.5)
    canvas.text(end - 92, top + _PROFILE + 60, "terrain model", anchor="lm")


def _draw_axes(
    canvas: Canvas, place: tuple[int, int, int], ends: tuple[float, ...], units: Sequence[str]
) -> None:
    left, top, width = place
    length, low, high = ends
    bottom = top + _PROFILE
    for value in _round_values(0.0, length):
        x = left + value / length * width
        canvas.line(np.array([x, x]), np.array([top, bottom + 4]), colour="#dddddd")
        canvas.text(x, bottom + 8, f"{value:g}", anchor="ma")
    for value in _round_values(low, high):
        y = top + (high - value) / (high - low) * _PROFILE
        canvas.line(np.array([left, left + width]), np.array([y, y]), colour="#dddddd")
        canvas.text(left - 6, y, f"{value:g}", anchor="rm")
    right = left + width
    canvas.line(
        np.array([left, right, right, left, left]), np.array([top, top, bottom, bottom, top])
    )
    canvas.text(left + width / 2, bottom + 28, f"from the west [{units[0]}]", anchor="ma")
    canvas.text(left - 50, top - 8, f"height [{units[1]}]", anchor="ls")


def _round_values(low: float, high: float) -> Iterable[float]:
    """Return about `_TICKS` round values between two others."""
    rough = (high - low) / _TICKS
    power = 10.0 ** np.floor(np.log10(rough))
    step = next(power * one for one in (1, 2, 5, 10) if power * one >= rough)
    return np.arange(np.ceil(low / step), np.floor(high / step) + 1) * step


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
    pixel = max(east - west, north - south) / _SIDE
    # Where points are sparse, pixels follow them, so that few stay empty.
    pixel = max(pixel, 1.8 * np.sqrt((east - west) * (north - south) / max(len(view.x), 1)))
    shape = int(np.ceil((north - south) / pixel)), int(np.ceil((east - west) / pixel))
    row = np.clip((north - view.y[which]) / pixel, 0, shape[0] - 1).astype(int)
    column = np.clip((view.x[which] - west) / pixel, 0, shape[1] - 1).astype(int)
    image = np.zeros(shape, dtype=np.uint8)
    image[row, column] = values
    return image


def _palette(kinds: np.ndarray) -> np.ndarray:
    """Return the pixels of kinds in their colours."""
    return np.array([rgb(colour) for colour in _COLOURS.values()], dtype=np.uint8)[kinds]


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
