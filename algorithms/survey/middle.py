"""A window in the middle of a survey, for those who give none."""

from __future__ import annotations

import math
from typing import Sequence

import numpy as np

from ..core.points import Box, box_round
from ..core.progress import SILENT, Progress
from ..las.lasfile import LasFile
from ..las.reading import read_chunks

# Side of the window in metres.
_SIDE = 250.0


def middle_window(files: Sequence[LasFile], unit: float) -> Box:
    """Return a square window in the middle of the extent of a survey, in units of the CRS (`unit`
    metres), without reading points, so that it may hold none.
    """
    # Its borders are whole numbers, except where the survey ends before.
    west, south, east, north = extent = _extent(files)
    return _square((west + east) / 2.0, (south + north) / 2.0, unit, extent)


def nearest_window(files: Sequence[LasFile], unit: float, progress: Progress = SILENT) -> Box:
    """Return a square window as `middle_window` round the point that is nearest to the middle of a
    survey; all points of the nearest files are read.
    """
    west, south, east, north = extent = _extent(files)
    middle = (west + east) / 2.0, (south + north) / 2.0
    best, place = math.inf, middle
    ordered = sorted(files, key=lambda file: _distance(file, middle))
    for file, part in zip(ordered, progress.shares(*[1.0] * len(ordered))):
        if not file.count or _distance(file, middle) > best:
            continue
        done = 0
        for chunk in read_chunks(file):
            x, y = (
                np.asarray(chunk[name]) * file.scale[axis] + file.offset[axis]
                for axis, name in enumerate("XY")
            )
            apart = np.hypot(x - middle[0], y - middle[1])
            nearest = int(apart.argmin())
            if apart[nearest] < best:
                best, place = float(apart[nearest]), (float(x[nearest]), float(y[nearest]))
            done += len(x)
            part(done / file.count)
    return _square(*place, unit, extent)


def _square(x: float, y: float, unit: float, extent: Box) -> Box:
    """Return the window round a place, cut off where the survey ends."""
    half = float(np.rint(_SIDE / 2.0 / unit))
    x, y = float(np.rint(x)), float(np.rint(y))
    return (
        max(x - half, extent[0]), max(y - half, extent[1]),
        min(x + half, extent[2]), min(y + half, extent[3]),
    )  # fmt: skip


def _extent(files: Sequence[LasFile]) -> Box:
    """Return smallest x and y, largest x and y of files that have points."""
    boxes = np.array([file.outer_box for file in files if file.count] or [files[0].outer_box])
    return box_round(boxes)


def _distance(file: LasFile, place: tuple[float, float]) -> float:
    """Return the distance of a place from the extent of a file; 0 inside."""
    west, south, east, north = file.outer_box
    x, y = place
    return math.hypot(max(west - x, x - east, 0.0), max(south - y, y - north, 0.0))
