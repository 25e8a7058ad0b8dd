"""Contour lines of a terrain model, of its heights smoothed for the lines only."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Iterator, NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet, parameter
from ..core.progress import SILENT, Progress
from ..grids.isolines import Isoline, Isolines
from ..grids.morphology import within_square
from ..rasters.content import NO_CELLS, Source
from ..rasters.geotiff import Raster, read_raster
from ..relief.local_relief import local_trend, reach_of
from ..survey.feature_files import Feature, Layer, feature_writer
from .declaration import FileTool, Input, Output

# About as many lines make a map that is easy to read.
_LINES = 20
_STEPS = (1.0, 2.0, 5.0, 10.0)
# A smaller interval, in metres, would show noise.
_LEAST = 0.2
# Most heights of lines: nobody could distinguish more, and memory is bounded.
_MOST_LEVELS = 20_000
# Every fifth line is drawn thick, and has its height as a label.
INDEX = 5
# Cells that are worked on at a time.
_CELLS = 4_000_000
# A smaller standard deviation, in cells, changes nothing.
_LEAST_SIGMA = 0.3
_FIELDS = {"ID": int, "ELEV": float, "INDEX": int}


class ContourLine(NamedTuple):
    """A line to write."""

    height: float  # in the unit of the raster
    is_index: bool  # drawn thick
    corners: np.ndarray  # float64, (n, 2): x and y


@dataclass(frozen=True)
class Contours(ParameterSet):
    """How contour lines are drawn."""

    contour_interval: float | None = parameter(
        None,
        kind="number",
        label="Contour interval",
        unit="m or ft",
        minimum=0.001,
        maximum=10_000.0,
        advanced=True,
        empty="automatic",
        help="The height between contour lines, in the vertical unit of the CRS: metres, or feet if"
        " the heights are feet. Empty: 1, 2 or 5 times a power of ten, so that there are about"
        f" {_LINES} lines. Every fifth line is an index contour.",
    )
    contour_smoothing: float = parameter(
        3.0,
        label="Smoothing of the contour lines",
        unit="m",
        minimum=0.0,
        maximum=1000.0,
        advanced=True,
        help="For the lines, each height is averaged with its surroundings up to about this"
        " distance, so that they do not show noise. The terrain model does not change. 0: as the"
        " terrain model is.",
    )
    contour_min_length: float = parameter(
        10.0,
        label="Shortest closed contour line",
        unit="m",
        minimum=0.0,
        maximum=10_000.0,
        advanced=True,
        help="Closed lines that are shorter are left out: they show single plants and noise.",
    )

    def interval(self, low: float, high: float, unit: float = 1.0) -> float:
        """Return the interval for terrain between two heights; `unit` is their unit in metres."""
        if self.contour_interval is not None:
            return self.contour_interval
        wanted = max((high - low) / _LINES, _LEAST / unit)
        power = 10.0 ** math.floor(math.log10(wanted))
        # The step that is nearest by its factor.
        step = min(_STEPS, key=lambda step: abs(math.log(step * power / wanted)))
        return float(f"{step * power:.6g}")


@dataclass(frozen=True)
class Interval:
    """The height between contour lines."""

    height: float  # in the unit of the raster
    unit: str = ""  # symbol of that unit; empty if the raster does not state it

    def in_words(self, lines: int = 1) -> str:
        """Return the height between a number of lines, with its unit, such as 10 m."""
        return f"{lines * self.height:g} {self.unit}".rstrip()

    @property
    def text(self) -> str:
        """What was drawn, in words."""
        return f"one contour line every {self.in_words()}"


def draw_contours(
    source: Source, output: Path, contours: Contours = Contours(), progress: Progress = SILENT
) -> Interval:
    """Write the contour lines of a raster, each with its height in the field ELEV."""
    raster = read_raster(source, window=NO_CELLS)
    interval, layer, features = contours_of(raster, contours, progress)
    count = feature_writer(output)(output, features, layer, progress)
    progress.info(f"{count:,} contour lines, one every {interval.in_words()}")
    return interval


def contours_of(
    raster: Raster, contours: Contours, progress: Progress
) -> tuple[Interval, Layer, Iterator[Feature]]:
    """Return the contour lines of a raster."""
    low, high = _range_of(raster, progress.part(0.0, 0.2))
    raster.tell(progress)
    height = contours.interval(low, high, raster.frame.vertical_unit)
    interval = Interval(height, raster.unit_symbol)
    if (high - low) / height > _MOST_LEVELS:
        raise BareEarthError(
            f"An interval of {interval.in_words()} would give more than {_MOST_LEVELS:,} heights of"
            " contour lines. Choose a larger one."
        )
    layer = Layer("contours", "LineString", _FIELDS, raster.frame.wkt, raster.crs.epsg)
    lines = enumerate(_lines_of(raster, contours, height, progress.part(0.2, 1.0)))
    features = (
        Feature((number, line.height, int(line.is_index)), line.corners) for number, line in lines
    )
    return interval, layer, features


def _range_of(raster: Raster, progress: Progress) -> tuple[float, float]:
    """Return the lowest and the highest height."""
    low, high, count = math.inf, -math.inf, raster.whole[0]
    rows = _rows_of(raster)
    for start in range(0, count, rows):
        heights = raster.rows(start, start + rows)
        known = heights[np.isfinite(heights)]
        if len(known):
            low, high = min(low, float(known.min())), max(high, float(known.max()))
        progress(min(start + rows, count) / count)
    return (low, high) if low <= high else (0.0, 0.0)


def _rows_of(raster: Raster) -> int:
    return max(_CELLS // raster.whole[1], 1)


def _lines_of(
    raster: Raster, how: Contours, interval: float, progress: Progress
) -> Iterator[ContourLine]:
    """Yield the lines of a raster."""
    (count, columns), rows = raster.whole, _rows_of(raster)
    (_, a, b, _, c, d), unit = raster.geotransform, raster.frame.horizontal_unit
    cells = math.hypot(b, d) * unit, math.hypot(a, c) * unit
    sigma = how.contour_smoothing / 2 / cells[0], how.contour_smoothing / 2 / cells[1]
    smooths = max(sigma) > _LEAST_SIGMA
    half = max(round(max(sigma)), 1)
    reach, lines = max(reach_of(sigma[0]), 3 * half) if smooths else 0, Isolines(interval, columns)
    for start in range(0, max(count - 1, 1), rows):
        end = min(start + rows + 1, count)  # the next strip begins with the last row
        first = max(start - reach, 0)
        heights = raster.rows(first, end + reach)
        if smooths:
            heights = np.where(_is_level(heights, half), heights, local_trend(heights, sigma))
        for line in lines.add(heights[start - first : end - first], start, end == count):
            corners = corners_of(line.places, raster)
            if not _is_speck(line, corners * unit, how.contour_min_length):
                height = float(f"{line.level * interval:.9g}")
                yield ContourLine(height, line.level % INDEX == 0, corners)
        progress(end / count)


def corners_of(places: np.ndarray, raster: Raster) -> np.ndarray:
    """Return x and y of rows and columns of a raster, (n, 2); the centres of cells are whole."""
    x, a, b, y, c, d = raster.geotransform
    row, column = places.T + 0.5
    return np.column_stack((x + a * column + b * row, y + c * column + d * row))


def _is_level(heights: np.ndarray, half: int) -> np.ndarray:
    """Return which cells are as high as a square near them, of twice the side `half`, that has
    exactly one height; up to three times as far cells matter.
    """
    # Such squares are water that was flattened. Smoothing would draw the lines of its banks into
    # it.
    low, high = (within_square(extreme, heights, half) for extreme in (np.minimum, np.maximum))
    levels = np.where(low == high, heights, -np.inf)
    return within_square(np.maximum, levels, 2 * half) == heights


def _is_speck(line: Isoline, corners: np.ndarray, least: float) -> bool:
    """Return whether a line is closed and shorter than `least` metres."""
    return line.is_closed and float(np.hypot(*np.diff(corners, axis=0).T).sum()) < least


CONTOUR_HELP = (
    "Lines of equal height, with the height as the field ELEV. The field INDEX is 1 for every fifth"
    " line. The lines are smoothed, so that they do not show noise."
)
TOOL = FileTool(
    work=draw_contours,
    sets=(Contours,),
    inputs=(
        Input("source", "raster", help="A raster file with a band of heights.", named="INPUT"),
    ),
    outputs=(
        Output(
            "output",
            "features",
            help=CONTOUR_HELP,
            is_main=True,
        ),
    ),
    flags={"contour_interval": "interval"},
    command="contours",
    about="The heights are smoothed for the lines only, so that they do not show noise.",
)
