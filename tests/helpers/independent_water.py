"""Compares water, breaklines, contour lines and rasters of a delivery cell by cell.

No code of ours has a say: GeoPackages are read by sqlite3, rasters by rasterio.
"""

import sqlite3
import struct
from typing import NamedTuple

import numpy as np
import rasterio
from rasterio.features import geometry_mask

# Bytes of the envelope in front of a geometry of a GeoPackage, by its flags.
_ENVELOPES = {0: 0, 1: 32, 2: 48, 3: 48, 4: 64}
_LINE = 2


class Compared(NamedTuple):
    """The differences of a polygon of water from the rasters and lines beside it, in their unit.

    `missing` are its cells without a height in any raster, `level` is how far the terrain lies
    outside of LEVEL and LEVEL_LOW, `lines` how far from the z of the breaklines.
    """

    cells: int
    missing: int
    level: float
    lines: float


def features(path):
    """Yield the fields, and the rings or the line, of each feature of a GeoPackage."""
    with sqlite3.connect(path) as file:
        table, column = file.execute(
            "SELECT table_name, column_name FROM gpkg_geometry_columns"
        ).fetchone()
        rows = file.execute(f'SELECT * FROM "{table}"')
        names = [row[0] for row in rows.description]
        for row in rows:
            fields = dict(zip(names, row))
            geometry = fields.pop(column)
            yield fields, _parts(geometry[8 + _ENVELOPES[(geometry[3] >> 1) & 7] :])


def _parts(geometry):
    (kind,) = struct.unpack_from("<I", geometry, 1)
    size, start, count, found = 3 if kind > 1000 else 2, 5, 1, []
    if kind % 1000 != _LINE:
        (count,) = struct.unpack_from("<I", geometry, start)
        start += 4
    for _ in range(count):
        (corners,) = struct.unpack_from("<I", geometry, start)
        some = np.frombuffer(geometry, "<f8", size * corners, start + 4)
        found.append(some.reshape(-1, size))
        start += 4 + 8 * size * corners
    return found


def compare(water, lines, dtm, *others):
    """Return what was compared for each polygon on the rasters, by its ID.

    `others` are further rasters, of which only missing cells count.
    """
    rasters = [_raster(path) for path in (dtm, *others)]
    heights, to = rasters[0]
    levels = [(feature["ID"], line) for feature, (line,) in features(lines)]
    found = {}
    for fields, rings in features(water):
        inside = _inside(rings, heights, to)
        if not inside.any():
            continue
        missing = sum(int(np.isnan(raster[inside]).sum()) for raster, _ in rasters)
        low, high = fields["LEVEL_LOW"], fields["LEVEL"]
        off = np.maximum(heights[inside] - high, low - heights[inside])
        near = [0.0]
        for number, line in levels:
            if number == fields["ID"]:
                rows, columns = _cells(line, to, heights.shape)
                beside = np.abs(heights[rows, columns] - line[:, 2])[inside[rows, columns]]
                near.extend(beside.tolist())
        found[fields["ID"]] = Compared(
            int(inside.sum()), missing, float(np.nanmax(off)), float(np.nanmax(near))
        )
    return found


def share_at_level(water, path):
    """Return the share of the cells of a raster in all water that lie at its level."""
    heights, to = _raster(path)
    count = wrong = 0
    for fields, rings in features(water):
        some = heights[_inside(rings, heights, to)]
        low, high = fields["LEVEL_LOW"] - 0.01, fields["LEVEL"] + 0.01
        count, wrong = count + len(some), wrong + np.count_nonzero((some < low) | (some > high))
    return 1.0 - wrong / count


def corners_in_flat_water(water, contours, dtm):
    """Return how many corners of contour lines lie inside of water with one level."""
    heights, to = _raster(dtm)
    count = 0
    for fields, rings in features(water):
        if fields["LEVEL"] > fields["LEVEL_LOW"]:
            continue
        inside = np.pad(_inside(rings, heights, to), 1)
        middle = inside[1:-1, 1:-1].copy()
        for along, by in ((0, 1), (0, -1), (1, 1), (1, -1)):
            middle &= np.roll(inside, by, along)[1:-1, 1:-1]
        for _, (line,) in features(contours):
            count += int(middle[_cells(line, to, heights.shape)].sum())
    return count


def _raster(path):
    with rasterio.open(path) as raster:
        return raster.read(1, masked=True).filled(np.nan), raster.transform


def _inside(rings, heights, to):
    shape = {"type": "Polygon", "coordinates": [ring[:, :2].tolist() for ring in rings]}
    return geometry_mask([shape], heights.shape, to, invert=True)


def _cells(line, to, shape):
    """Return row and column of the cells that hold the corners of a line, inside a raster."""
    columns, rows = ~to @ line[:, :2].T
    rows, columns = (np.floor(places).astype(int) for places in (rows, columns))
    last = np.array(shape) - 1
    return np.clip(rows, 0, last[0]), np.clip(columns, 0, last[1])
