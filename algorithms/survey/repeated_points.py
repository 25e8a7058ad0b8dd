"""Finds points that a survey holds several times: shared by tiles, or duplicates."""

from __future__ import annotations

import math
from typing import Callable, Iterable, Iterator, Sequence

import numpy as np

from ..las.cloud import PointCloud
from ..las.lasfile import LasFile

# Keys that are sorted together.
_SORTED_TOGETHER = 1 << 25
# Multipliers that spread the bits of a number (Steele, Lea and Flood 2014, SplitMix64).
_SPREAD = (0xBF58476D1CE4E5B9, 0x94D049BB133111EB)


def keys_of(count: int, columns: Iterable[np.ndarray]) -> np.ndarray:
    """Return keys of rows, uint64, which are equal if all columns of 64 bits are equal."""
    keys = np.zeros(count, dtype=np.uint64)
    for column in columns:
        keys ^= column.view(np.uint64)
        for shift, factor in zip((30, 27), _SPREAD):
            keys ^= keys >> np.uint64(shift)
            keys *= np.uint64(factor)
        keys ^= keys >> np.uint64(31)
    return keys


def count_repeated(keys: np.ndarray) -> int:
    """Return how many keys repeat an earlier one."""
    parts = (np.sort(keys[places]) for places in _parts(keys))
    return sum(int(np.count_nonzero(part[1:] == part[:-1])) for part in parts)


def _parts(keys: np.ndarray) -> Iterator[np.ndarray | slice]:
    """Yield the places of keys that begin with the same bits, group by group."""
    bits = math.ceil(math.log2(max(len(keys) / _SORTED_TOGETHER, 1.0)))
    if not bits:
        yield slice(None)
        return
    for number in range(1 << bits):
        yield np.flatnonzero(keys >> np.uint64(64 - bits) == number)


class RepeatedPoints:
    """Finds the points of a survey that repeat an earlier point, in the order of the files;
    `array(name, shape, kind)` returns an array of zeros, in memory or on disk.
    """

    # Points are the same if their coordinates, return numbers and, where all files have them, GPS
    # times are equal. They are compared by keys of 64 bits: of a billion points, one in thirty
    # surveys has a pair of equal keys by chance.

    def __init__(
        self, tiles: Sequence[LasFile], array: Callable[[str, tuple[int, ...], str], np.ndarray]
    ) -> None:
        # Whether the parts must have GPS times.
        self.has_times = all(tile.has_gps_times for tile in tiles)
        self.shared = 0  # points that an earlier file holds as well
        self.duplicates = 0  # other points that repeat a point of the same file
        # Coordinates are compared in the smallest unit of all files.
        self._unit = tuple(min(tile.scale[axis] for tile in tiles) for axis in range(3))
        self._starts = np.cumsum([0, *(tile.count for tile in tiles)], dtype=np.int64)
        total = int(self._starts[-1])
        self._keys = array("keys", (max(total, 1),), "u8")[:total]
        self._is_repeated = array("repeated", (max(total, 1),), "?")[:total]
        self._place = 0

    def add(self, part: PointCloud) -> None:
        """Add the next part of the survey."""
        stop = self._place + part.count
        self._keys[self._place : stop] = self._keys_of(part)
        self._place = stop

    def _keys_of(self, part: PointCloud) -> np.ndarray:
        columns: list[np.ndarray] = [
            np.rint((whole * scale + offset) / unit).astype(np.int64)
            for whole, scale, offset, unit in zip(
                (part.x, part.y, part.z), part.scale, part.offset, self._unit
            )
        ]
        columns.append(part.return_number.astype(np.uint64))
        if self.has_times and part.gps_time is not None:
            columns.append(part.gps_time + 0.0)  # + 0.0: there is a -0.0, too
        return keys_of(part.count, columns)

    def find(self) -> None:
        """Find the repeated points, after all parts were added; `among` starts again with them."""
        for places in _parts(self._keys):
            indices = np.arange(len(self._keys)) if isinstance(places, slice) else places
            self._find_among(indices, self._keys[places])
        self._place = 0

    def _find_among(self, places: np.ndarray, keys: np.ndarray) -> None:
        """Find the repeated points among points whose keys begin with the same bits."""
        in_order = np.sort(keys)
        if not np.any(in_order[1:] == in_order[:-1]):
            return
        order = np.argsort(keys, kind="stable")
        places, keys = places[order], keys[order]
        is_first = np.concatenate(([True], keys[1:] != keys[:-1]))
        first = places[is_first][np.cumsum(is_first) - 1]
        again = places[~is_first]
        self._is_repeated[again] = True
        first_file, file = (
            np.searchsorted(self._starts, indices, "right") for indices in (first[~is_first], again)
        )
        shared = int(np.count_nonzero(first_file != file))
        self.shared += shared
        self.duplicates += len(again) - shared

    def among(self, part: PointCloud) -> np.ndarray:
        """Return which points of the next part repeat an earlier point; boolean, shape (n,)."""
        start, self._place = self._place, self._place + part.count
        return np.asarray(self._is_repeated[start : self._place])
