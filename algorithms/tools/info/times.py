"""GPS times of the points of a file: their range, their order and their gaps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

# Seconds: a longer time without a point is a gap.
GAP = 1.0
WEEK = 604_800.0
# Seconds from 0 to which times count: about 8,000 years. Others are damaged.
_MOST = float(1 << 38)
# Seconds with points: more are not compared, since times that are no times have one a point.
_MOST_SECONDS = 5_000_000


@dataclass(frozen=True)
class GpsTimes:
    """The GPS times of the points, except times of 0."""

    minimum: float
    maximum: float
    in_order: bool  # whether no point is earlier than the one before it
    gaps: int | None  # times of more than a second without a point; None if there are too many
    longest_gap: float | None  # seconds; None without gaps

    @property
    def line(self) -> str:
        """The times in words."""
        text = f"{self.minimum:.10g} to {self.maximum:.10g}, {'' if self.in_order else 'not '}in"
        text += " the order of the points"
        if self.longest_gap is not None:
            count = "1 gap" if self.gaps == 1 else f"{self.gaps:,} gaps"
            text += f"; {count} over {GAP:g} s, the longest {self.longest_gap:,.1f} s"
        return text


class _Seconds(NamedTuple):
    """The seconds in which points were measured, sorted, with the first and last time of each."""

    number: np.ndarray  # int64 (n,), of the second, with the strip in the upper bits
    first: np.ndarray  # float64 (n,)
    last: np.ndarray  # float64 (n,)

    def joined(self) -> _Seconds:
        """Return each second once."""
        order = np.argsort(self.number, kind="stable")
        number = self.number[order]
        starts = np.flatnonzero(np.concatenate(([True], number[1:] != number[:-1])))
        first = np.minimum.reduceat(self.first[order], starts)
        return _Seconds(number[starts], first, np.maximum.reduceat(self.last[order], starts))

    def of_all_strips(self) -> _Seconds:
        """Return the seconds without their strips."""
        return self._replace(number=self.number & ((1 << 40) - 1)).joined()

    def gaps(self) -> np.ndarray:
        """Return the times without a point in a strip, in seconds."""
        same = self.number[1:] >> 40 == self.number[:-1] >> 40
        lengths = (self.first[1:] - self.last[:-1])[same]
        return lengths[lengths > GAP]


class TimeTally:
    """Collects the GPS times of a file part by part."""

    def __init__(self) -> None:
        empty = np.zeros(0)
        self._seconds = _Seconds(np.zeros(0, np.int64), empty, empty)
        self._before = self._highest = -np.inf
        self._lowest = np.inf
        self._in_order = True
        self.zero = 0  # points
        self.damaged = 0  # points whose time is not a number, or impossibly large
        self.beyond_week = 0  # points whose time is not a second of a GPS week

    def add(self, times: np.ndarray, strips: np.ndarray) -> np.ndarray:
        """Add the times and strips of some points, and return which points have a time."""
        with np.errstate(invalid="ignore"):
            is_sound = np.abs(times) < _MOST
        has_time = is_sound & (times != 0.0)
        self.damaged += len(times) - int(np.count_nonzero(is_sound))
        times, strips = times[has_time], strips[has_time]
        self.zero += int(np.count_nonzero(is_sound)) - len(times)
        if not len(times):
            return has_time
        self.beyond_week += int(np.count_nonzero((times < 0.0) | (times > WEEK)))
        self._in_order &= bool(times[0] >= self._before and np.all(times[1:] >= times[:-1]))
        self._before = times[-1]
        if self._is_complete:
            number = np.floor(times).astype(np.int64) + (1 << 38) | strips.astype(np.int64) << 40
            new = _Seconds(number, times, times).joined()
            self._seconds = _Seconds(*map(np.concatenate, zip(self._seconds, new))).joined()
        self._lowest = min(self._lowest, float(times.min()))
        self._highest = max(self._highest, float(times.max()))
        return has_time

    @property
    def _is_complete(self) -> bool:
        return len(self._seconds.number) <= _MOST_SECONDS

    def found(self) -> GpsTimes | None:
        """Return the times; None if no point has one."""
        if self._lowest > self._highest:
            return None
        if not self._is_complete:
            return GpsTimes(self._lowest, self._highest, self._in_order, None, None)
        gaps = self._seconds.of_all_strips().gaps()
        longest = float(gaps.max()) if len(gaps) else None
        return GpsTimes(self._lowest, self._highest, self._in_order, len(gaps), longest)

    def gaps_in_strips(self) -> int | None:
        """Return how many gaps are inside of a flight strip; None if strips are not numbered."""
        strips = self._seconds.number >> 40
        return len(self._seconds.gaps()) if strips.any() and self._is_complete else None
