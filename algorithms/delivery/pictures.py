"""Small pictures of the rasters of a delivery."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from ..rasters.content import NO_CELLS
from ..rasters.geotiff import read_raster
from ..relief.hillshade import hillshade
from ..report.page import keys
from ..report.pictures import HEIGHTS, NOWHERE, Picture, ramped, reduced, rgb
from ..report.units import Units
from .deliveries import WITH_BUILDINGS

LONGEST_SIDE = 900
# Cells that are read at a time.
_CELLS = 4_000_000
_CANOPY = ("#f4f1e4", "#c9d98f", "#7fb258", "#3c7d3c", "#0f4023")
_OF_HEIGHTS = ("dtm", "dsm", WITH_BUILDINGS)
# Greatest share of black in the shading of heights.
_DARKEST = 0.35


def picture_of(raster: Path, name: str, units: Units = Units()) -> tuple[Picture, str]:
    """Return a raster, read in strips, as a picture, and its legend as HTML, empty for reliefs."""
    values, cell = _small(raster)
    known = values[~np.isnan(values)]
    if not len(known):
        return Picture(np.full((*values.shape, 3), 255, dtype=np.uint8), cell), ""
    if name in _OF_HEIGHTS:
        return _heights(values, known, cell, units)
    if name == "chm":
        high = max(float(np.percentile(known, 99.5)), 1e-6)
        ends = (units.height(0.0), units.height(high * units.vertical))
        legend = keys((_CANOPY[0], _CANOPY[-1]), ends)
        return Picture(ramped(values, _CANOPY, 0.0, high), cell), legend
    grey = np.rint(np.where(np.isnan(values), 255.0, values)).astype(np.uint8)
    return Picture(np.repeat(grey[..., None], 3, axis=2), cell), ""


def _small(raster: Path) -> tuple[np.ndarray, float]:
    """Return the values of a raster in larger cells, and their side in metres."""
    opened = read_raster(raster, window=NO_CELLS)
    rows, columns = opened.whole
    step = math.ceil(max(rows, columns) / LONGEST_SIDE)
    stored, found = opened.stored, np.full((-(-rows // step), -(-columns // step)), np.nan)
    rows_at_once = max(_CELLS // columns // step, 1) * step
    for start in range(0, rows, rows_at_once):
        end = min(start + rows_at_once, rows)
        for first, last in stored.runs(start, end):
            first, last = first // step, -(-last // step)
            values = reduced(opened.rows(start, end, first * step, last * step), step)
            found[start // step : -(-end // step), first:last] = values
    return found, opened.cell_metres[0] * step


def _heights(
    values: np.ndarray, known: np.ndarray, cell: float, units: Units
) -> tuple[Picture, str]:
    """Return heights in colours with shades, and the legend."""
    low, high = (float(np.percentile(known, share)) for share in (1.0, 99.0))
    high = max(high, low + 1e-6)
    shade = hillshade(values * units.vertical, cell)[..., None] / 255.0
    light = _DARKEST + (1.0 - _DARKEST) * shade
    pixels = ramped(values, HEIGHTS, low, high) * light
    pixels[np.isnan(values)] = rgb(NOWHERE)
    ends = (units.height(end * units.vertical) for end in (low, high))
    return Picture(np.rint(pixels).astype(np.uint8), cell), keys((HEIGHTS[0], HEIGHTS[-1]), ends)
