"""Cells with a usual value for no data which their raster does not declare."""

from __future__ import annotations

from typing import Iterable, NamedTuple

import numpy as np

from ..core.words import counted

# Values that programs write where there is no terrain.
_USUAL = (
    -999.0, -9999.0, -10_000.0, -32_767.0, -32_768.0, -99_999.0, -999_999.0, -(2.0**31),
    9999.0, 32_767.0, 65_535.0, 99_999.0, 999_999.0,
)  # fmt: skip
# None of these values lies between the two.
_LOW = -999.0
_HIGH = 9999.0
# No terrain is so high or so low in any unit, but the least number of float32 is.
_ABSURD = 1e9
# Such a value is no terrain if all other heights differ from it by more than this, in the unit of
# the band, and than this share of their range: terrain would have heights in between.
_FAR = 500.0
_SHARE = 0.1


class Undeclared(NamedTuple):
    """The values of a raster that are no terrain."""

    counts: dict[float, int]  # number of cells with each value

    def among(self, values: np.ndarray, valid: np.ndarray) -> np.ndarray:
        """Return which valid cells have one of these values, or an absurd one."""
        found = valid & ((values <= _LOW) | (values >= _HIGH))
        doubtful = values[found]  # few, but in high mountains in feet
        is_absurd = np.isfinite(doubtful) & ((doubtful <= -_ABSURD) | (doubtful >= _ABSURD))
        found[found] = is_absurd | np.isin(doubtful, [*self.counts])
        return found

    def text(self, source: object) -> str:
        """The sentence for users; empty if there are none."""
        if not self.counts:
            return ""
        cells = (f"{counted(count, 'cell')} of {value:.6g}" for value, count in self.counts.items())
        return (
            f"{source} has {', '.join(cells)}, far from all other heights: they are taken as no"
            " data, although the raster does not declare them as such."
        )


_USUAL_ONES = Undeclared(dict.fromkeys(_USUAL, 0))


def suspects(values: np.ndarray, valid: np.ndarray) -> np.ndarray:
    """Return which valid cells have a usual value for no data, which may be terrain."""
    if values.dtype.kind not in "iuf" or values.dtype.itemsize == 1:
        return np.zeros(values.shape, dtype=bool)
    return _USUAL_ONES.among(values, valid)


def undeclared_in(parts: Iterable[tuple[np.ndarray, np.ndarray]]) -> Undeclared:
    """Return the values of a whole raster that are no terrain, given the cells of its parts and
    which are valid.
    """
    low, high = np.inf, -np.inf
    counts: dict[float, int] = {}
    for values, valid in parts:
        suspect = suspects(values, valid)
        others = values[valid & ~suspect & np.isfinite(values)]
        if len(others):
            low, high = min(low, float(others.min())), max(high, float(others.max()))
        for value, count in zip(*np.unique(values[suspect], return_counts=True)):
            key = float(f"{value:.6g}") if abs(float(value)) >= _ABSURD else float(value)
            counts[key] = counts.get(key, 0) + int(count)
    far = max(_FAR, _SHARE * (high - low))
    found = {}
    for value, count in sorted(counts.items()):
        if abs(value) >= _ABSURD or max(low - value, value - high) > far:
            found[value] = count
    return Undeclared(found)
