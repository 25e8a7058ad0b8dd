"""By how much places would rise if they were ground, before anybody says so."""

from __future__ import annotations

import math
from functools import partial
from typing import Sequence

import numpy as np

from ...core.points import Box, Points
from ...core.progress import SILENT, Progress
from ...grids.cells import first_of_each
from ...grids.continued_ground import continued_ground
from ...las.cloud import PointCloud
from ...rasters.content import Source
from ...rasters.sampling import HeightRaster, HeightSampler
from ...survey.area import Area, Polygon
from ...survey.files import Inputs
from ...survey.window import taken_near

_GROUND, _NOISE = 2, (7, 18)
# Metres: how far round a place the ground is read, and the side of the squares in which only
# the lowest point of either kind is kept.
_AROUND, _SQUARE = 5.0, 0.5
_NEARLY_ALL = 0.95  # of the points that become ground rise less than the place


def lifts_of(
    sources: Inputs, places: Sequence[Polygon], dtm: Source, progress: Progress = SILENT
) -> list[float]:
    """Return by how many metres points of each place that would continue the ground lie above the
    terrain model, NaN where none would; each file is read once.
    """
    survey = sources.open(progress.part(0.0, 0.05))
    across, up = survey.crs.horizontal_unit, survey.crs.vertical_unit
    boxes = [Area(None, (place,)).buffered_box(_AROUND / across) for place in places]
    found: list[list[np.ndarray]] = [[] for _ in places]
    take = partial(_near, boxes=boxes, square=_SQUARE / across)
    shares = progress.part(0.05, 1.0).shares(*(max(tile.count, 1) for tile in survey.tiles))
    for tile, share in zip(survey.tiles, shares):
        for part in taken_near(tile, boxes, take, share):
            for columns, some in zip(found, part):
                columns.append(some)
        share(1.0)
    sampler = HeightSampler(HeightRaster.of(dtm))
    return [
        _lift(np.hstack(columns), place, sampler, (across, up)) if columns else math.nan
        for columns, place in zip(found, places)
    ]


def _near(part: PointCloud, boxes: Sequence[Box], square: float) -> list[np.ndarray]:
    """Return the points of each box as x, y, z and whether they are ground, (4, n): of each square
    the lowest of either kind.
    """
    x, y = part.coordinates()
    is_used = (part.return_number >= part.number_of_returns) & ~part.withheld
    used = np.flatnonzero(is_used & ~np.isin(part.classification, _NOISE))
    used = used[np.argsort(x[used], kind="stable")]  # so that a box holds a slice of them
    ground = part.classification[used] == _GROUND
    rows = np.array((x[used], y[used], part.z[used] * part.scale[2] + part.offset[2], ground))
    found = []
    for west, south, east, north in boxes:
        some = rows[:, slice(*np.searchsorted(rows[0], (west, east)))]
        some = some[:, (some[1] >= south) & (some[1] <= north)]
        column, row = np.floor((some[:2] - [[west], [south]]) / square).astype(np.int64)
        columns = int((east - west) / square) + 1
        index = 2 * (row * columns + column) + some[3].astype(np.int64)
        found.append(some[:, first_of_each(index, int(index.max(initial=-1)) + 1, some[2])])
    return found


def _lift(
    rows: np.ndarray, place: Polygon, sampler: HeightSampler, units: tuple[float, float]
) -> float:
    """Return by how much the points of a place that would continue the ground rise."""
    across, up = units
    ground, inside = rows[3] > 0, Area(None, (place,)).contains(rows[0], rows[1])
    corner = rows[:2].min(axis=1, keepdims=True) if rows.size else rows[:2]
    x, y = (rows[:2] - corner) * across
    points = Points(x, y, rows[2] * up)
    new = continued_ground(points, ground, inside & ~ground)
    rises = rows[2, new] * up - sampler.heights(*rows[:2, new]) * (sampler.unit or up)
    rises = rises[np.isfinite(rises)]
    return float(np.quantile(rises, _NEARLY_ALL)) if len(rises) else math.nan
