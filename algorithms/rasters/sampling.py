"""Heights of a raster at places. Only the cells that are needed are read, to limit the memory."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..crs.matching import is_same_map, other_datums
from ..crs.system import Crs, crs_of_wkt, same_unit, unit_name
from ..crs.wkt import read_wkt
from .content import MemoryRaster, Source, report_undeclared
from .geotiff import read_raster, report_units

_SIDE = 512  # cells along a side of the squares that are read
_MOST_KEPT = 16  # most squares in memory
# Metres above and below a terrain model: a warning tells if nearly all points lie farther away.
FAR_ABOVE = 20.0
FAR_BELOW = 2.0
_ENOUGH = 1_000_000  # number of points that are enough to know this
_STATE_IT = (
    "If the unit of the raster is another one, state it: 'gdal_edit.py -units ft RASTER', or m."
)


def _stamp_of(source: Source) -> tuple[int, ...]:
    """Return size and time of the last change of a file; an empty tuple without a file."""
    if isinstance(source, MemoryRaster) or not Path(source).exists():
        return ()
    state = Path(source).stat()
    return state.st_size, state.st_mtime_ns


@dataclass(frozen=True)
class HeightRaster:
    """A raster of heights, such as a terrain model, that need not fit into memory."""

    path: Source  # the file, or a part of one as GDAL names it
    state: tuple[int, ...]  # size and time of the last change of the file
    shape: tuple[int, int]  # rows and columns
    geotransform: tuple[float, ...]  # geotransform of GDAL
    crs: Crs | None  # its CRS; None if it states none
    # The unit of the heights in metres: that of the band or the CRS, else that of x and y; None if
    # it states neither a unit nor a CRS.
    unit: float | None
    states_unit: bool  # whether it states the unit of the heights

    @classmethod
    def of(cls, source: Source, progress: Progress = SILENT) -> HeightRaster:
        """Return the raster of a file; only one cell is read."""
        first = read_raster(source, progress=progress, window=(0, 0, 1, 1))
        wkt, name, stamp = first.frame.wkt, source, _stamp_of(source)
        if not isinstance(source, MemoryRaster):
            name = str(Path(source).absolute() if stamp else source)
        crs = crs_of_wkt(wkt) if wkt else None
        unit = first.frame.vertical_unit if first.states_unit or crs else None
        return cls(name, stamp, first.whole, first.geotransform, crs, unit, first.states_unit)

    def check(self, crs: Crs, points: str | Path) -> None:
        """Refuse points in another CRS."""
        if self.crs is None or crs == Crs() or is_same_map(self.crs, crs):
            return
        raise BareEarthError(
            f"{self.path} is in another CRS ({self.crs.name}) than {points} ({crs.name}). Reproject"
            " the raster first: in QGIS with 'Warp (reproject)', elsewhere with 'gdalwarp -t_srs"
            " EPSG:... INPUT OUTPUT'."
        )

    def covers_nothing(self, points: str) -> BareEarthError:
        """Return the error for a raster without a value at any of some points."""
        return BareEarthError(
            f"{self.path} has no value at any point of {points}. Give a raster that covers the"
            " points."
        )

    def report(self, crs: Crs, progress: Progress) -> None:
        """Warn if heights of points in a CRS may not be comparable with those of the raster."""
        facts = read_wkt(self.crs.wkt) if self.crs and self.crs.wkt else None
        report_undeclared(self.path, 1, progress)
        report_units(self.path, self.unit, facts and facts.vertical_unit, progress)
        if self.unit and not self.states_unit and not same_unit(self.unit, crs.vertical_unit):
            progress.warning(
                f"{self.path} does not state the unit of its heights: {unit_name(self.unit)} is"
                f" used, while heights of the points are in {unit_name(crs.vertical_unit)}."
                f" {_STATE_IT}"
            )
        if self.crs is not None:
            names = self.path, "of the points"
            if told := other_datums(names, self.crs, crs):
                progress.warning(f"{told} They are compared as they are.")

    def report_heights(
        self, heights: np.ndarray, unit: float, above: float, progress: Progress
    ) -> None:
        """Warn if nearly all points lie far above or far below the raster."""
        heights = heights[:: max(len(heights) // _ENOUGH, 1)]
        heights = heights[~np.isnan(heights)] * unit
        if not len(heights):
            return
        lowest, highest = np.percentile(heights, (5, 95)).tolist()
        if lowest > above or highest < -FAR_BELOW:
            off, side = (lowest, "above") if lowest > above else (-highest, "below")
            progress.warning(
                f"Nearly all points lie at least {off:.1f} m {side} {self.path}, so that their"
                f" heights do not belong together. Check the units and the vertical datums."
                f" {_STATE_IT}"
            )


class _Square(NamedTuple):
    """Cells of a raster, and row and column of the first."""

    row: int
    column: int
    heights: np.ndarray


class HeightSampler:
    """Returns heights of a raster at places, in the unit of the raster; for a single thread."""

    def __init__(self, raster: HeightRaster) -> None:
        self._raster, self.unit = raster, raster.unit
        self._kept: OrderedDict[tuple[int, int], _Square] = OrderedDict()
        _, a, b, _, c, d = raster.geotransform
        if not a * d - b * c:
            raise BareEarthError(f"{raster.path} states no place on the map. Georeference it.")
        self._inverse = np.linalg.inv([[a, b], [c, d]])

    def heights(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return heights at places (n,) in the CRS of the raster, bilinear between centres of cells
        that have a value, in its unit; NaN outside and in cells without one.
        """
        west, north = self._raster.geotransform[0], self._raster.geotransform[3]
        column, row = self._inverse @ np.array([x - west, y - north])
        (rows, columns), values = self._raster.shape, np.full(len(x), np.nan)
        inside = (row >= 0) & (row <= rows) & (column >= 0) & (column <= columns)
        indices = np.flatnonzero(inside)
        # The last row and column hold the border of the raster.
        cells = np.array(
            [np.minimum(row[indices], rows - 1), np.minimum(column[indices], columns - 1)]
        )
        squares = cells.astype(np.int64) // _SIDE
        codes = squares[0] * (columns // _SIDE + 1) + squares[1]
        order = np.argsort(codes, kind="stable")
        cuts = np.flatnonzero(np.diff(codes[order])) + 1
        for group in np.split(order, cuts) if len(order) else ():
            square = self._square(*squares[:, group[0]].tolist())
            here = indices[group]
            values[here] = _interpolated(square, row[here], column[here])
        return values

    def _square(self, row: int, column: int) -> _Square:
        """Return a square with a margin of one cell, which stays in memory for a while."""
        if (row, column) in self._kept:
            self._kept.move_to_end((row, column))
            return self._kept[row, column]
        (rows, columns), side = self._raster.shape, _SIDE
        top, left = max(row * side - 1, 0), max(column * side - 1, 0)
        bottom = min((row + 1) * side + 1, rows)
        right = min((column + 1) * side + 1, columns)
        window = left, top, right - left, bottom - top
        heights = read_raster(self._raster.path, window=window).heights
        square = self._kept[row, column] = _Square(top, left, heights)
        if len(self._kept) > _MOST_KEPT:
            self._kept.popitem(last=False)
        return square


def _interpolated(square: _Square, row: np.ndarray, column: np.ndarray) -> np.ndarray:
    """Return heights at places of a square, given in cells of the raster."""
    from scipy.ndimage import map_coordinates

    heights, (rows, columns) = square.heights, square.heights.shape
    row, column = row - square.row, column - square.column
    of_cell = heights[
        np.clip(row.astype(np.intp), 0, rows - 1), np.clip(column.astype(np.intp), 0, columns - 1)
    ]
    # Places are relative to the centres of cells. Beyond the outermost ones, heights are constant.
    known, places = ~np.isnan(heights), np.array((row - 0.5, column - 0.5))
    total, weights = (
        map_coordinates(values, places, np.float64, order=1, mode="nearest")
        for values in (np.where(known, heights, 0.0), known.astype(np.float64))
    )
    found = np.divide(total, weights, out=np.full(len(row), np.nan), where=weights > 0.0)
    return np.where(np.isnan(of_cell), np.nan, found)
