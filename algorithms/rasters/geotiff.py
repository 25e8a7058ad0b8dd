"""The grid of rasters, and heights of raster files."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple, Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.points import Box, Frame, Points
from ..core.progress import SILENT, Progress
from ..crs.measurable import length_scale, wrong_lengths
from ..crs.system import Crs, crs_of_wkt, same_unit, unit_name, unit_symbol
from ..crs.unit_names import unit_in
from ..crs.wkt import read_wkt
from .content import MOST_WITH_EMPTY, Content, Source, Window, read_content, report_undeclared
from .stored import Stored, stored_in

NODATA = -9999.0
NO_GROUND = (
    "There is no ground point to make a terrain model of. Check the selection of points and the"
    " parameters."
)
# What bands of pictures show, as GDAL names it.
_COLOURS = "red", "green", "blue", "palette"


@dataclass(frozen=True)
class RasterGrid:
    """A north-up grid of square cells in the CRS of the survey."""

    # Western and northern border in units of the CRS; multiples of the cell size, so that the
    # cells of tiles fit together.
    west: float
    north: float
    cell_size: float  # in units of the CRS
    columns: int
    rows: int
    frame: Frame  # the frame of local coordinates in metres

    @classmethod
    def over(cls, points: Points, frame: Frame, cell_size: float) -> RasterGrid:
        """Return the grid that covers points, with cells of `cell_size` metres; refuse a cloud
        without points, and too large a grid.
        """
        if points.count == 0:
            raise BareEarthError(NO_GROUND)
        cell = cell_size / frame.horizontal_unit
        (x0, x1), (y0, y1) = (
            [(start + end / frame.horizontal_unit) / cell for end in (column.min(), column.max())]
            for start, column in zip(frame.origin, points)
        )
        west, north = math.floor(x0), math.ceil(y1)
        columns, rows = max(math.ceil(x1) - west, 1), max(north - math.floor(y0), 1)
        check_cells(columns, rows, cell_size)
        return cls(west * cell, north * cell, cell, columns, rows, frame)

    @property
    def geotransform(self) -> tuple[float, ...]:
        """Geotransform of GDAL."""
        return self.west, self.cell_size, 0.0, self.north, 0.0, -self.cell_size

    @property
    def box(self) -> Box:
        """Smallest x and y, largest x and y, in units of the CRS."""
        south, east = self.north - self.rows * self.cell_size, self.columns * self.cell_size
        return self.west, south, self.west + east, self.north

    @property
    def cell_metres(self) -> float:
        """Side of a cell in metres."""
        return self.cell_size * self.frame.horizontal_unit

    @property
    def corner(self) -> tuple[float, float]:
        """X and y of the lower left corner, in local metres."""
        south = self.north - self.rows * self.cell_size
        (east, north), unit = self.frame.origin, self.frame.horizontal_unit
        return (self.west - east) * unit, (south - north) * unit

    @property
    def x(self) -> np.ndarray:
        """Cell centres from west to east, in local metres."""
        centres = (
            self.west - self.frame.origin[0] + (np.arange(self.columns) + 0.5) * self.cell_size
        )
        return centres * self.frame.horizontal_unit

    @property
    def y(self) -> np.ndarray:
        """Cell centres from north to south, in local metres."""
        centres = self.north - self.frame.origin[1] - (np.arange(self.rows) + 0.5) * self.cell_size
        return centres * self.frame.horizontal_unit


def check_cells(columns: int, rows: int, cell_metres: float) -> None:
    """Refuse a raster with too many cells."""
    if columns * rows > MOST_WITH_EMPTY:
        raise BareEarthError(
            f"The raster would have {columns:,} x {rows:,} cells of {cell_metres:g} m. Choose a"
            " larger cell size, or remove points with stray coordinates."
        )


class HeightBand(NamedTuple):
    """A band of a raster file in memory."""

    # float32 (rows, columns), in file order and the vertical unit; NaN without value.
    heights: np.ndarray
    geotransform: tuple[float, ...]  # as of GDAL
    frame: Frame  # its origin is not used
    unit: str = ""  # unit of the band; empty if it states none
    whole: tuple[int, int] = (0, 0)  # rows and columns of the whole file
    states_unit: bool = False  # whether the band, its description or the CRS states the unit
    source: Source = ""
    band: int = 1

    def rows(self, start: int, end: int, first: int = 0, last: int | None = None) -> np.ndarray:
        """Read rows and columns within the file as `heights`."""
        (rows, columns), start, first = self.whole, max(start, 0), max(first, 0)
        last = columns if last is None else min(last, columns)
        window = first, start, last - first, min(end, rows) - start
        return read_raster(self.source, self.band, window=window).heights

    def within(self, runs: Sequence[tuple[int, int]], start: int, end: int) -> np.ndarray:
        """Read the columns from the first of some runs to the last, NaN between the runs."""
        start, end = max(start, 0), min(end, self.whole[0])
        west, east = runs[0][0], runs[-1][1]
        heights = np.full((end - start, east - west), np.nan, dtype=np.float32)
        for first, last in runs:
            heights[:, first - west : last - west] = self.rows(start, end, first, last)
        return heights

    @property
    def stored(self) -> Stored:
        """Which tiles of the file are stored."""
        return stored_in(self.source, self.band, self.whole)

    def report(self, progress: Progress) -> None:
        """Warn, after the cells have been read, of undeclared values for no data."""
        report_undeclared(self.source, self.band, progress)

    @property
    def crs(self) -> Crs:
        """The CRS that the file states; an empty one if it states none."""
        return (crs_of_wkt(self.frame.wkt) if self.frame.wkt else None) or Crs()

    @property
    def unit_symbol(self) -> str:
        """Symbol of the unit of heights; empty if the file states neither unit nor CRS."""
        is_known = self.states_unit or self.frame.wkt
        return unit_symbol(self.frame.vertical_unit) if is_known else ""

    @property
    def cell_metres(self) -> tuple[float, float]:
        """Distance in metres between neighbours in a row, and between neighbours in a column."""
        _, a, b, _, c, d = self.geotransform
        unit = self.frame.horizontal_unit
        return math.hypot(a, c) * unit, math.hypot(b, d) * unit


def read_raster(
    source: Source,
    band: int = 1,
    progress: Progress = SILENT,
    window: Window | None = None,
) -> HeightBand:
    """Read one band (from 1) of a raster file, or of a part as GDAL names it
    (``GPKG:survey.gpkg:dsm``), as heights; refuse a geographic CRS.
    """
    # A window is first column and row, and numbers of columns and rows; the geotransform stays that
    # of the whole file.
    content = read_content(source, band, window)
    values, valid = content.values, content.valid
    if content.colour.lower() in _COLOURS:
        raise BareEarthError(
            f"{source} is a picture in colours, not a raster of heights. Give the terrain model"
            " itself."
        )
    if values.dtype.kind not in "iuf":
        raise BareEarthError(f"Cannot read {source}: its cells hold {values.dtype}, not heights.")
    if (content.scale, content.offset) != (1.0, 0.0):
        values = values * content.scale + content.offset
    with np.errstate(over="ignore"):  # of cells that are not valid
        heights = values.astype(np.float32)
    heights[~(valid & np.isfinite(values))] = np.nan
    frame = frame_of(source, content, progress)
    return HeightBand(
        heights,
        content.geotransform,
        frame,
        content.unit,
        content.shape,
        any(stated_units(content)),
        source,
        band,
    )


def frame_of(source: Source, content: Content, progress: Progress = SILENT) -> Frame:
    """Return a frame with the units of the band and the CRS, or metres if none are stated."""
    facts = read_wkt(content.wkt) if content.wkt else None
    _require_measurable(source, content)
    if facts is not None and facts.is_geographic:
        raise BareEarthError(
            f"{source} is not in a projected CRS ({facts.name}), so that nothing can be measured in"
            " it. Reproject it first: in QGIS with 'Warp (reproject)', elsewhere with 'gdalwarp"
            " -t_srs EPSG:... INPUT OUTPUT'."
        )
    horizontal = facts.horizontal_unit if facts is not None else None
    if horizontal is None:
        progress.warning(
            f"{source} does not say its CRS, or the unit of it: its coordinates are taken as"
            " metres."
        )
        horizontal = 1.0
    of_band, of_crs = stated_units(content)
    report_units(source, of_band, of_crs, progress)
    vertical = of_band or of_crs
    if vertical is None:
        vertical = horizontal
        if not math.isclose(horizontal, 1.0):
            progress.info(
                "The raster does not state the unit of its heights: that of x and y is used,"
                f" {unit_name(horizontal)}."
            )
    return Frame((0.0, 0.0), horizontal, vertical, content.wkt or None)


def report_units(
    source: Source, used: float | None, of_crs: float | None, progress: Progress
) -> None:
    """Warn if the CRS states another unit of heights than the one that is used."""
    if used and of_crs and not same_unit(used, of_crs):
        progress.warning(
            f"The heights of {source} are in {unit_name(used)} by its band, which is used, and in"
            f" {unit_name(of_crs)} by its CRS."
        )


def stated_units(content: Content) -> tuple[float | None, float | None]:
    """Return the units of heights that the band, or its description, and the CRS state."""
    facts = read_wkt(content.wkt) if content.wkt else None
    of_crs = facts.vertical_unit if facts is not None else None
    of_band, described = unit_in(content.unit), unit_in(content.description)
    # GDAL gives the unit of the CRS to bands without one, and may take feet for metres there.
    if described and (of_band is None or same_unit(of_band, of_crs)):
        of_band = described
    return of_band, of_crs


def _require_measurable(source: Source, content: Content) -> None:
    """Refuse Mercator projections in which lengths are wrong at the place of the raster."""
    crs = crs_of_wkt(content.wkt) if content.wkt else None
    west, a, b, north, c, d = content.geotransform
    rows, columns = content.shape
    centre = west + (a * columns + b * rows) / 2.0, north + (c * columns + d * rows) / 2.0
    wrong = "" if crs is None else wrong_lengths(length_scale(crs, (*centre, *centre)))
    if wrong:
        raise BareEarthError(
            f"{source} is in a Mercator projection, in which {wrong}. Reproject it first: in QGIS"
            " with 'Warp (reproject)', elsewhere with 'gdalwarp -t_srs EPSG:... INPUT OUTPUT'."
        )
