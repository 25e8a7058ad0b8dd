"""Writes the values of some cells as a raster, without the whole raster in memory."""

from __future__ import annotations

from pathlib import Path
from typing import Iterator, NamedTuple, Tuple

import numpy as np

from ..core.progress import Progress
from .geotiff import RasterGrid
from .sparse import SIDE, RasterPart
from .writing import RasterCells, write_geotiff

_CELLS = 16_000_000  # cells of a strip


class ScatteredCells(NamedTuple):
    """Values of cells; all of shape (n,), at least one, no cell twice."""

    row: np.ndarray  # int64, from north
    column: np.ndarray  # int64
    values: np.ndarray  # float32 or uint8


def write_scattered(
    target: Path,
    cells: ScatteredCells,
    grid: RasterGrid,
    nodata: float,
    progress: Progress,
    shows: str,
) -> None:
    """Write cells as `write_geotiff`; all others have no data."""
    shape, kind = (grid.rows, grid.columns), cells.values.dtype.name
    cells = ScatteredCells(*(column[np.argsort(cells.row, kind="stable")] for column in cells))
    step = max(_CELLS // grid.columns // SIDE, 1) * SIDE
    spans = [span for strip in _strips(cells.row, step) for span in _spans(cells, strip, step)]
    made = sum(
        (min(start + step, shape[0]) - start) * (min(last, shape[1]) - first)
        for _, start, first, last in spans
    )
    parts = _parts(cells, spans, step, shape, nodata)
    write_geotiff(target, RasterCells(shape, kind, parts, made=made), grid, nodata, progress, shows)


# Which of the sorted cells lie in a part, its first row, its first column, and that after its last.
_Span = Tuple[slice, int, int, int]


def _strips(row: np.ndarray, step: int) -> Iterator[tuple[slice, int]]:
    """Yield the cells of each strip that has any, and its first row."""
    for number in np.unique(row // step).tolist():
        start = number * step
        yield slice(*np.searchsorted(row, (start, start + step)).tolist()), start


def _spans(cells: ScatteredCells, strip: tuple[slice, int], step: int) -> Iterator[_Span]:
    """Yield the parts of a strip, which are tiles of the file beside each other."""
    some, start = strip
    tiles = np.unique(cells.column[some] // SIDE)
    for run in np.split(tiles, np.flatnonzero(np.diff(tiles) > 1) + 1):
        yield some, start, int(run[0]) * SIDE, (int(run[-1]) + 1) * SIDE


def _parts(
    cells: ScatteredCells, spans: list[_Span], step: int, shape: tuple[int, int], nodata: float
) -> Iterator[RasterPart]:
    for some, start, first, last in spans:
        row, column, values = (axis[some] for axis in cells)
        inside = (column >= first) & (column < last)
        size = min(step, shape[0] - start), min(last, shape[1]) - first
        part = np.full(size, nodata, dtype=cells.values.dtype)
        part[row[inside] - start, column[inside] - first] = values[inside]
        yield RasterPart(start, first, part)
