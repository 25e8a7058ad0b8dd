"""Counts what a file holds, in one pass over its points."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...las.lasfile import FIRST_EXTENDED_FORMAT, LasFile
from ...las.records import attributes_of, named
from ...las.return_numbers import pulses_of
from ...survey.repeated_points import count_repeated, keys_of
from ...survey.scratch import ScratchArrays
from .times import TimeTally

FLAGS = ("synthetic", "key_point", "withheld", "overlap")
# Attributes that many programs leave at 0, as far as a point format has them.
_ATTRIBUTES = (
    "intensity", "return_number", "gps_time", "point_source_id", "scan_angle", "scan_angle_rank",
    "scan_direction_flag", "edge_of_flight_line", "red", "green", "blue", "nir",
)  # fmt: skip
_COLOURS = ("red", "green", "blue")
_GROUND = 2
# Largest possible scan angle of formats 6 to 10, in steps of 0.006 degrees.
_STEEPEST = 30_000
_KEYS = ("places", "ground", "ground places", "returns")
BYTES_A_POINT = 8 * len(_KEYS)


class PointKeys:
    """Collects keys of points, some of them equal."""

    def __init__(self, keys: np.ndarray) -> None:
        self._keys, self._count = keys, 0

    def add(self, count: int, *columns: np.ndarray) -> None:
        """Add points, whose keys are equal if all columns of 64 bits are equal."""
        self._keys[self._count : self._count + count] = keys_of(count, columns)
        self._count += count

    def close(self) -> None:
        """Release the array, which may be a file."""
        self._keys = np.zeros(0, dtype=np.uint64)

    def repeated(self) -> int:
        """Return how many points have the key of an earlier point."""
        return count_repeated(self._keys[: self._count])


class Tally:
    """The counts of a file, to which its records are added part by part."""

    def __init__(self, layout: LasFile, scratch: ScratchArrays) -> None:
        self._layout = layout
        self._is_extended = layout.point_format >= FIRST_EXTENDED_FORMAT
        names = attributes_of(layout)
        self.lowest = np.full(3, np.iinfo(np.int64).max)  # x, y and z as integers
        self.highest = np.full(3, np.iinfo(np.int64).min)
        self.outside = 0  # points outside of the box in the header
        self.at_limit = 0  # points with a coordinate at the limit of 32 bits
        self.classes = np.zeros(256, dtype=np.int64)
        self.pulses = np.zeros((16, 16), dtype=np.int64)  # by return number, number of returns
        self.flags = {name: 0 for name in FLAGS if name in names}
        self.strips = np.zeros(1 << 16, dtype=np.int64)
        self.times = TimeTally()
        self.zero = [name for name in _ATTRIBUTES if name in names]  # attributes that are all 0
        self.steep = 0  # points with an impossible scan angle
        self.has_colours = "red" in names
        self.brightest = 0  # the largest value of a colour
        every = [PointKeys(scratch.array(name, (max(layout.count, 1),), "u8")) for name in _KEYS]
        self.places, self.ground, self.ground_places, self.returns = every

    def add(self, records: np.ndarray) -> None:
        """Add some records."""
        points = named(self._layout, records)
        classes = np.asarray(points["classification"])
        self.classes += np.bincount(classes, minlength=256)
        self._add_places([np.array(points[name]) for name in "XYZ"], classes == _GROUND)
        self._add_pulses(points)
        for name in self.flags:
            self.flags[name] += int(np.count_nonzero(np.asarray(points[name])))
        self.zero = [name for name in self.zero if not np.asarray(points[name]).any()]
        if self.has_colours:
            most = max(int(np.asarray(points[name]).max()) for name in _COLOURS)
            self.brightest = max(self.brightest, most)
        angles, most = ("scan_angle", _STEEPEST) if self._is_extended else ("scan_angle_rank", 90)
        angle = np.asarray(points[angles]).astype(np.int32)
        self.steep += int(np.count_nonzero(np.abs(angle) > most))

    def close(self) -> None:
        """Release the keys, which may be in files."""
        for keys in (self.places, self.ground, self.ground_places, self.returns):
            keys.close()

    def _add_places(self, xyz: list[np.ndarray], is_ground: np.ndarray) -> None:
        """Add coordinates as integers."""
        self.lowest = np.minimum(self.lowest, [axis.min() for axis in xyz])
        self.highest = np.maximum(self.highest, [axis.max() for axis in xyz])
        limits, layout = np.iinfo(np.int32), self._layout
        is_outside, is_at_limit = np.zeros((2, len(is_ground)), dtype=bool)
        corners = zip(layout.minimum, layout.maximum, layout.scale, layout.offset)
        for axis, (lowest, highest, scale, offset) in zip(xyz, corners):
            # Headers are rounded.
            is_outside |= axis < (lowest - offset) / scale - 1.0
            is_outside |= axis > (highest - offset) / scale + 1.0
            is_at_limit |= (axis == limits.min) | (axis == limits.max)
        self.outside += int(np.count_nonzero(is_outside))
        self.at_limit += int(np.count_nonzero(is_at_limit))
        x, y, z = (axis.astype(np.int64) for axis in xyz)
        place = x << 32 | y & 0xFFFFFFFF
        self.places.add(len(x), place, z)
        place, z = place[is_ground], z[is_ground]
        self.ground_places.add(len(z), place)
        self.ground.add(len(z), place, z)

    def _add_pulses(self, points: Any) -> None:
        """Add return numbers, strips and GPS times."""
        number, total, strip = (
            np.array(points[name])
            for name in ("return_number", "number_of_returns", "point_source_id")
        )
        # LAS specification: a point source id of 0 means the file source id.
        strip[strip == 0] = self._layout.source_id
        self.pulses += pulses_of(number, total)
        self.strips += np.bincount(strip, minlength=1 << 16)
        if not self._layout.has_gps_times:
            return
        times = np.array(points["gps_time"], dtype=np.float64)
        has_time = self.times.add(times, strip)
        key = number.astype(np.int64) | strip.astype(np.int64) << 16
        if self._is_extended:
            key |= np.asarray(points["scanner_channel"]).astype(np.int64) << 8
        self.returns.add(int(np.count_nonzero(has_time)), times[has_time], key[has_time])
