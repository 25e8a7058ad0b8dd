"""A quantile of more values than fit into memory."""

from __future__ import annotations

import math
from typing import Callable, Iterable

import numpy as np

_HALF = 16  # bits
_COUNT = 1 << _HALF


def quantile_of(parts: Callable[[], Iterable[np.ndarray]], share: float) -> float:
    """Return a quantile of float32 values without NaN, of parts that are asked for
    twice, as `numpy.nanquantile` does of all of them; NaN without any.
    """
    # The bits of numbers are sorted as these: the upper half of the bits tells where the quantile
    # lies nearly, and the lower half exactly.
    upper = np.zeros(_COUNT, dtype=np.int64)
    for values in parts():
        upper += _counted(_sortable(values) >> _HALF)
    count = int(upper.sum())
    if not count:
        return math.nan
    place = share * (count - 1)
    ranks = np.array([math.floor(place), math.ceil(place)])
    ends = np.cumsum(upper)
    bins = np.searchsorted(ends, ranks, side="right")
    lower = {number: np.zeros(_COUNT, dtype=np.int64) for number in bins.tolist()}
    for values in parts():
        numbers = _sortable(values)
        for number, counts in lower.items():
            counts += _counted(numbers[numbers >> _HALF == number] & (_COUNT - 1))
    rests = ranks - (ends - upper)[bins]
    low, high = (
        _value(number << _HALF | int(np.searchsorted(np.cumsum(lower[number]), rest, side="right")))
        for number, rest in zip(bins.tolist(), rests)
    )
    return low + (high - low) * (place - math.floor(place))


def _counted(numbers: np.ndarray) -> np.ndarray:
    return np.bincount(numbers.astype(np.intp), minlength=_COUNT)


def _sortable(values: np.ndarray) -> np.ndarray:
    """Return numbers, uint32 (n,), that are sorted as the values that are not NaN."""
    known = values[~np.isnan(values)].astype(np.float32, copy=False) + np.float32(0.0)
    bits = known.view(np.uint32)
    return np.where(bits >> 31 == 1, ~bits, bits | np.uint32(1 << 31))


def _value(number: int) -> float:
    """Return the value that `_sortable` made a number of."""
    bits = number & 0x7FFFFFFF if number >> 31 else number ^ 0xFFFFFFFF
    return float(np.array(bits, dtype=np.uint32).view(np.float32))
