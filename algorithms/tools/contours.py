"""Contour lines of a terrain model, of its heights smoothed for the lines only."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Iterator, NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet, parameter
from ..core.progress import SILENT, Progress
from ..grids.isolines import Isoline, Isolines
from ..grids.morphology import within_square
from ..rasters.content import NO_CELLS, Source
from ..rasters.geotiff import HeightBand, read_raster
from ..relief.local_relief import Sigma, local_trend, reach_of
from ..survey.feature_files import DxfLayers, Feature, FeatureLayer, feature_writer
from .declaration import RASTER, TERRAIN, FileTool, Input, Output

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
# Smoothing moves no line by more than this share of the interval in height, measured from heights
# that are smoothed over this share of the distance: what is left of these is no noise.
_MOST_MOVED = 0.25
_LITTLE = 0.2
# A short closed line stays if the land inside rises or falls by this share of the interval. It is
# compared with land as wide as a line of this length at most, in metres.
_LEAST_RISE = 0.5
_WIDEST = 30.0
_FIELDS = {"ID": int, "ELEV": float, "INDEX": int, "DEPRESSION": int}
# The layers of a drawing by INDEX and DEPRESSION, and the numbers of their colours.
_LAYERS = {
    (0, 0): "CONTOUR", (1, 0): "CONTOUR_INDEX",
    (0, 1): "DEPRESSION", (1, 1): "DEPRESSION_INDEX",
}  # fmt: skip
_COLOURS = dict(zip(_LAYERS.values(), (34, 32, 24, 22)))
_DRAWING = DxfLayers(_COLOURS, lambda values: (_LAYERS[values[2], values[3]], float(values[1])))


class ContourLine(NamedTuple):
    """A line to write."""

    height: float  # in the unit of the raster
    is_index: bool  # drawn thick
    is_depression: bool  # closed, and the land inside is lower
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
        " distance, so that they do not show noise, but changes by no more than a quarter of the"
        " interval. The terrain model does not change. 0: as the terrain model is.",
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
    contour_knolls: bool = parameter(
        True,
        label="Keep small knolls and pits",
        advanced=True,
        help="Shorter closed lines stay where the land inside rises or falls by more than half an"
        " interval.",
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
    line_count: int = 0

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
    return replace(interval, line_count=count)


def contours_of(
    raster: HeightBand, contours: Contours, progress: Progress
) -> tuple[Interval, FeatureLayer, Iterator[Feature]]:
    """Return the contour lines of a raster."""
    low, high = _range_of(raster, progress.part(0.0, 0.2))
    raster.report(progress)
    if low > high:
        progress.warning(f"{raster.source} has no cell with a height, so it has no contour lines.")
        low = high = 0.0
    height = contours.interval(low, high, raster.frame.vertical_unit)
    interval = Interval(height, raster.unit_symbol)
    if (high - low) / height > _MOST_LEVELS:
        raise BareEarthError(
            f"An interval of {interval.in_words()} would give more than {_MOST_LEVELS:,} heights of"
            " contour lines. Choose a larger one."
        )
    layer = FeatureLayer(
        "contours", "LineString", _FIELDS, raster.frame.wkt, raster.crs.epsg, _DRAWING
    )
    lines = enumerate(_lines_of(raster, contours, height, progress.part(0.2, 1.0)))
    features = (
        Feature((number, line.height, int(line.is_index), int(line.is_depression)), line.corners)
        for number, line in lines
    )
    return interval, layer, features


def _range_of(raster: HeightBand, progress: Progress) -> tuple[float, float]:
    """Return the lowest and the highest height; infinite ones of a raster without any."""
    low, high, stored = math.inf, -math.inf, raster.stored
    for start, end in stored.strips(_CELLS):
        for run in stored.runs(start, end):
            heights = raster.rows(start, end, *run)
            known = heights[np.isfinite(heights)]
            if len(known):
                low, high = min(low, float(known.min())), max(high, float(known.max()))
        progress(end / raster.whole[0])
    return low, high


def _lines_of(
    raster: HeightBand, how: Contours, interval: float, progress: Progress
) -> Iterator[ContourLine]:
    """Yield the lines of a raster."""
    (count, columns), unit, stored = raster.whole, raster.frame.horizontal_unit, raster.stored
    rows = stored.step(_CELLS)
    smoothing, lines = _Smoothing.of(raster, how, interval), Isolines(interval, columns)
    for start in range(0, max(count - 1, 1), rows):
        end = min(start + rows + 1, count)  # the next strip begins with the last row
        first = max(start - smoothing.reach, 0)
        # Columns without data on both sides are left out.
        runs = stored.runs(start, end, smoothing.reach) or [(0, 1)]
        heights = smoothing.smoothed(raster.within(runs, first, end + smoothing.reach))
        rises, corner = smoothing.rises(heights), np.array((first, runs[0][0]))
        strip = heights[start - first : end - first]
        for line in lines.add(strip, start, end == count, runs[0][0]):
            corners = corners_of(line.places, raster)
            is_short = _is_short(line, corners * unit, how.contour_min_length)
            if not is_short or _greatest(rises, line.places - corner) > _LEAST_RISE * interval:
                height = float(f"{line.level * interval:.9g}")
                yield ContourLine(height, line.level % INDEX == 0, line.is_depression, corners)
        progress(end / count)


class _Smoothing(NamedTuple):
    """How heights are smoothed for lines, and what rises from the land or falls from it."""

    sigma: Sigma  # in cells, of the smoothing
    little: Sigma  # of heights from which lines keep a share of the interval
    wide: Sigma  # of the land with which what lies in short closed lines is compared
    most: float  # by which smoothing may change heights beyond `little`
    reach: int  # in rows

    @classmethod
    def of(cls, raster: HeightBand, how: Contours, interval: float) -> _Smoothing:
        """Return the smoothing of a raster, given the interval in its unit."""
        _, a, b, _, c, d = raster.geotransform
        unit = raster.frame.horizontal_unit
        cells = math.hypot(b, d) * unit, math.hypot(a, c) * unit
        metres = how.contour_smoothing / 2
        ring = min(how.contour_min_length, _WIDEST) if how.contour_knolls else 0.0
        sigma, little, wide = (
            (size / cells[0], size / cells[1])
            for size in (metres, _LITTLE * metres, ring / math.pi)
        )
        # A ring that ends in a strip lies in the rows of it, and in some before.
        reach = max(reach_of(sigma[0]), 3 * _half(sigma)) if _smooths(sigma) else 0
        reach += reach_of(wide[0]) + math.ceil(ring / 2 / cells[0]) if _smooths(wide) else 0
        return cls(sigma, little, wide, _MOST_MOVED * interval, reach)

    def smoothed(self, heights: np.ndarray) -> np.ndarray:
        """Return the heights from which lines are drawn."""
        if not _smooths(self.sigma):
            return heights
        near = local_trend(heights, self.little) if _smooths(self.little) else heights
        trend = np.clip(local_trend(heights, self.sigma), near - self.most, near + self.most)
        return np.where(_is_level(heights, _half(self.sigma)), heights, trend)

    def rises(self, heights: np.ndarray) -> np.ndarray:
        """Return by how much the land rises from its surroundings or falls from them."""
        if not _smooths(self.wide):
            return np.zeros(heights.shape)
        return np.abs(heights - local_trend(heights, self.wide))


def _smooths(sigma: Sigma) -> bool:
    return max(sigma) > _LEAST_SIGMA


def _half(sigma: Sigma) -> int:
    return max(round(max(sigma)), 1)


def _greatest(values: np.ndarray, places: np.ndarray) -> float:
    """Return the greatest value in the rectangle round a line."""
    (top, left), (bottom, right) = np.floor(places.min(axis=0)), np.ceil(places.max(axis=0))
    part = values[max(int(top), 0) : int(bottom) + 1, max(int(left), 0) : int(right) + 1]
    return float(np.fmax.reduce(part, axis=None, initial=0.0))


def corners_of(places: np.ndarray, raster: HeightBand) -> np.ndarray:
    """Return x and y of rows and columns of a raster, (n, 2); the centres of cells are whole."""
    x, a, b, y, c, d = raster.geotransform
    row, column = places.T + 0.5
    corners = np.column_stack((x + a * column + b * row, y + c * column + d * row))
    # On the map too, higher ground is on the left.
    return corners if a * d - b * c <= 0.0 else corners[::-1]


def _is_level(heights: np.ndarray, half: int) -> np.ndarray:
    """Return which cells are as high as a square near them, of twice the side `half`, that has
    exactly one height; up to three times as far cells matter.
    """
    # Such squares are water that was flattened. Smoothing would draw the lines of its banks into
    # it.
    low, high = (within_square(extreme, heights, half) for extreme in (np.minimum, np.maximum))
    levels = np.where(low == high, heights, -np.inf)
    return within_square(np.maximum, levels, 2 * half) == heights


def _is_short(line: Isoline, corners: np.ndarray, least: float) -> bool:
    """Return whether a line is closed and shorter than `least` metres."""
    return line.is_closed and float(np.hypot(*np.diff(corners, axis=0).T).sum()) < least


CONTOUR_HELP = (
    "Lines of equal height, with the height as the field ELEV. The field INDEX is 1 for every fifth"
    " line, DEPRESSION is 1 for closed lines round lower land. The lines are smoothed, so that they"
    " do not show noise. In a drawing (.dxf) these fields are layers."
)
TOOL = FileTool(
    work=draw_contours,
    sets=(Contours,),
    inputs=(
        Input(
            "source",
            "raster",
            help="A raster file with a band of heights.",
            label="Terrain model",
            named="INPUT",
        ),
    ),
    outputs=(
        Output(
            "output",
            "features",
            help=CONTOUR_HELP,
            label="Contour lines",
            is_main=True,
            look="contours",
        ),
    ),
    flags={"contour_interval": "interval"},
    command="contours",
    identifier="contours",
    title="Contour lines",
    about="The heights are smoothed for the lines only, so that they do not show noise. Knolls and"
    " pits stay. Every fifth line is an index contour; closed lines round lower land are marked as"
    " depressions. A drawing (.dxf) for CAD and OCAD has the layers CONTOUR, CONTOUR_INDEX,"
    " DEPRESSION and DEPRESSION_INDEX.",
    page="terrain-model#contour-lines",
    run_name="contours",
    words=(TERRAIN, RASTER, "contours,isolines,contour map,depression,knoll,dxf,cad,ocad"),
    numbers=(("LINE_COUNT", "Contour lines"), ("HEIGHT", "Contour interval")),
    shown=("contour_interval",),
)
