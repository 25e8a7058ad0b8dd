"""A point cloud in memory, with the columns that a classification needs."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any, Iterator, NamedTuple, Sequence

import numpy as np

from ..core.points import Box, Frame, Points
from ..core.progress import SILENT
from ..core.threads import in_threads, over_parts, parts_of
from ..crs.measurable import refuse_degrees, require_measurable
from ..crs.system import Crs
from .lasfile import LasFile

_POINTS_A_PART = 1 << 15
# Points of the parts of a cloud.
_PART = 1 << 19
# Most points that are copied together for each point that is wanted.
_LOOSE = 4
# Units of the CRS: the origin of the frame of a cloud is a multiple of this.
_ORIGINS = 10_000.0
# The share of the scale by which rounded offsets may differ from one of its multiples.
_WHOLE = 0.01


@dataclass
class PointCloud:
    """The points of one file in file order, 16 to 19 bytes each."""

    path: Path
    x: np.ndarray  # int32 (n,), as in the file
    y: np.ndarray  # int32 (n,)
    z: np.ndarray  # int32 (n,)
    scale: tuple[float, float, float]  # of x, y and z; the CRS has integer times scale plus offset
    offset: tuple[float, float, float]  # in units of the CRS
    classification: np.ndarray  # uint8 (n,)
    return_number: np.ndarray  # uint8 (n,)
    number_of_returns: np.ndarray  # uint8 (n,), of the pulse of each point
    withheld: np.ndarray  # bool (n,), points that the producer excluded
    point_format: int  # 0 to 10
    crs: Crs
    # uint8 (n,), of point formats 6 to 10, if it was read.
    scanner_channel: np.ndarray | None = None
    # bool (n,), overlap of flight strips, of point formats 6 to 10.
    overlap: np.ndarray | None = None
    # uint8 (n,), classes of an earlier run, the dimension `REMEMBERED`.
    remembered: np.ndarray | None = None
    gps_time: np.ndarray | None = None  # float64 (n,), if it was read
    # uint16 (n,), flight strips (point source ids; where these are 0, that of the file), if read.
    strip: np.ndarray | None = None
    synthetic: np.ndarray | None = None  # bool (n,), points made and not measured, if it was read
    number: np.ndarray | None = None  # int64 (n,), places in the file from 0 on, if asked for
    records: np.ndarray | None = None  # uint8 (n, record length), if they were kept for writing
    file: LasFile | None = None
    from_zero: bool = False  # whether returns begin at 0 in the file; here they are one higher

    @property
    def count(self) -> int:
        """Number of points."""
        return len(self.x)

    @property
    def columns(self) -> dict[str, np.ndarray]:
        """The arrays with one value for each point, by name."""
        return {
            name: value
            for name, value in vars(self).items()
            if isinstance(value, np.ndarray) and name != "records"
        }

    def take(self, selected: np.ndarray | slice) -> PointCloud:
        """Return the points that a mask, indices or a slice select, without the records."""
        columns: dict[str, Any] = {name: column[selected] for name, column in self.columns.items()}
        return replace(self, records=None, **columns)

    def parts(self) -> Iterator[tuple[slice, PointCloud]]:
        """Yield indices and points part by part, without the records."""
        for where in parts_of(self.count, _PART):
            yield where, self.take(where)

    def coordinates(self, selected: slice = slice(None)) -> tuple[np.ndarray, np.ndarray]:
        """Return x and y of points in units of the CRS, float64 (n,)."""
        (east, north, _), (x0, y0, _) = self.scale, self.offset
        return self.x[selected] * east + x0, self.y[selected] * north + y0

    @cached_property
    def lowest(self) -> tuple[int, int]:
        """The smallest x and y, as integers."""
        return self._extremes[0]

    @cached_property
    def highest(self) -> tuple[int, int]:
        """The largest x and y, as integers."""
        return self._extremes[1]

    @cached_property
    def _extremes(self) -> tuple[tuple[int, int], tuple[int, int]]:
        """The smallest x and y, and the largest."""

        def extremes(part: slice) -> list[tuple[int, int]]:
            # Coordinates among records are far apart in memory, so they are copied once.
            x, y = (np.ascontiguousarray(axis[part]) for axis in (self.x, self.y))
            return [(int(x.min()), int(y.min())), (int(x.max()), int(y.max()))]

        of_parts = np.array(in_threads(extremes, parts_of(self.count, _POINTS_A_PART)))
        lowest, highest = of_parts[:, 0].min(axis=0), of_parts[:, 1].max(axis=0)
        return tuple(lowest.tolist()), tuple(highest.tolist())

    @property
    def frame(self) -> Frame:
        """The default frame of `points`, with its origin near the smallest x and y."""
        # The origin is a multiple of a large number, so that it hardly depends on the extent.
        x, y = (
            math.floor((minimum * scale + offset) / _ORIGINS) * _ORIGINS
            for minimum, scale, offset in zip(self.lowest, self.scale, self.offset)
        )
        return replace(survey_frame(self.crs), origin=(x, y))

    def points(self, selected: np.ndarray | slice, frame: Frame | None = None) -> Points:
        """Return the points of a mask or indices in metres from the origin of a frame, by default
        that of the cloud; refuse a CRS that is not projected.
        """
        # If files have equal scales, equal places become equal numbers, whatever the offsets.
        return Points(*self._metres(selected, frame, 3))

    def places(
        self, selected: np.ndarray | slice, frame: Frame | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return x and y as in `points`, without the heights."""
        x, y = self._metres(selected, frame, 2)
        return x, y

    def _metres(
        self, selected: np.ndarray | slice, frame: Frame | None, count: int
    ) -> list[np.ndarray]:
        """Return the first one, two or three coordinates of points in metres."""
        self.require_projected()
        if isinstance(selected, np.ndarray) and selected.dtype == bool:
            selected = np.flatnonzero(selected)
        axes = self._axes(self.frame if frame is None else frame)[:count]
        columns = [self.x, self.y, self.z][:count]
        chosen = None if isinstance(selected, slice) else selected
        if chosen is None:
            columns = [column[selected] for column in columns]
        length = len(columns[0]) if chosen is None else len(chosen)
        metres = [np.empty(length) for _ in axes]

        def convert(part: slice) -> None:
            picked = _picked(columns, part if chosen is None else chosen[part])
            for axis, integers, target in zip(axes, picked, metres):
                axis.convert(integers, target[part])

        over_parts(convert, length, _POINTS_A_PART, SILENT)
        return metres

    @property
    def box(self) -> Box:
        """Smallest x and y, largest x and y, in units of the CRS; there must be a point."""
        (east, north, _), (x0, y0, _) = self.scale, self.offset
        (west, south), (right, top) = self.lowest, self.highest
        return west * east + x0, south * north + y0, right * east + x0, top * north + y0

    @property
    def outer_box(self) -> Box:
        """The box, wider by one step of the coordinates, as that of a file with these points."""
        (west, south, east, north), (x, y) = self.box, self.scale[:2]
        return west - x, south - y, east + x, north + y

    def bounds(self, frame: Frame) -> tuple[float, float, float, float]:
        """Return smallest x and y, largest x and y in metres of a frame, as in `points`."""
        corners = np.empty((2, 2))
        for axis, lowest_and_highest, target in zip(
            self._axes(frame), zip(self.lowest, self.highest), corners.T
        ):
            axis.convert(np.array(lowest_and_highest), target)
        west, south, east, north = corners.ravel().tolist()
        return west, south, east, north

    def _axes(self, frame: Frame) -> list[_Axis]:
        origin = (*frame.origin, 0.0)
        units = (self.crs.horizontal_unit, self.crs.horizontal_unit, self.crs.vertical_unit)
        return [
            _Axis.of(scale, offset, start, unit)
            for scale, offset, start, unit in zip(self.scale, self.offset, origin, units)
        ]

    def require_projected(self) -> None:
        """Refuse coordinates in which distances cannot be measured, such as degrees."""
        if self.file is not None:
            self.file.check_limits()
        if self.file is not None and self.crs.wkt is None and self.crs.epsg is None:
            refuse_degrees(self.path, self.file.minimum, self.file.maximum, min(self.scale[:2]))
        require_measurable(self.path, self.crs, self.file.box if self.file else None)


def joined(parts: Sequence[PointCloud]) -> PointCloud:
    """Return the points of several parts of a file, at least one, as one cloud."""
    columns: dict[str, list[np.ndarray]] = {}
    for part in parts:
        for name, column in part.columns.items():
            columns.setdefault(name, []).append(column)
    # One column after the other, so that not all are in memory twice at the same time.
    whole: dict[str, Any] = {name: np.concatenate(columns.pop(name)) for name in list(columns)}
    return replace(parts[0], from_zero=any(part.from_zero for part in parts), **whole)


def survey_frame(crs: Crs, origin: tuple[float, float] = (0.0, 0.0)) -> Frame:
    """Return the frame of a survey and its blocks, with an origin in units of the CRS, such as a
    corner of the cells of a raster.
    """
    return Frame(origin, crs.horizontal_unit, crs.vertical_unit, crs.wkt)


class _Axis(NamedTuple):
    """Converts integers to metres."""

    # If the offset is a multiple of the scale, it is added to the integers. So no digits are lost,
    # and equal places become equal numbers, whatever the offset.

    whole: float  # added to the integers
    scale: float  # metres in one unit of the integers
    rest: float  # metres added at the end

    @classmethod
    def of(cls, scale: float, offset: float, start: float, unit: float) -> _Axis:
        """Return the axis of a scale and an offset, relative to a start, in units of metres."""
        (whole, rest), (before, beyond) = (_multiple(value, scale) for value in (offset, start))
        return cls(whole - before, scale * unit, (rest - beyond) * unit)

    def convert(self, integers: np.ndarray, metres: np.ndarray) -> None:
        """Convert integers to metres, into an array."""
        metres[:] = integers
        metres += self.whole
        metres *= self.scale
        if self.rest:
            metres += self.rest


def _multiple(value: float, scale: float) -> tuple[float, float]:
    """Return a value as a whole number of scales and the rest."""
    whole = float(np.rint(value / scale))
    rest = value - whole * scale
    return whole, rest if abs(rest) > _WHOLE * scale else 0.0


def _picked(columns: Sequence[np.ndarray], indices: np.ndarray | slice) -> list[np.ndarray]:
    if isinstance(indices, np.ndarray):
        first, last = int(indices.min()), int(indices.max())
        # If indices are close together, all values between them are copied first.
        if last - first < _LOOSE * len(indices):
            near, places = slice(first, last + 1), (indices - first).astype(np.intp)
            return [np.ascontiguousarray(column[near]).take(places) for column in columns]
    return [column[indices] for column in columns]
