"""Numbers of outputs in a form that the last bits, which depend on the processor, do not change.

Arrays are kept as sums of small groups of values, in quarters of a step, by their last digits.
A value that moves by two steps is seen, and all values of a group may move by its share of a step.
Numbers of texts are kept as printed, and may differ by one unit of the last place.
"""

from __future__ import annotations

import hashlib
import re
from decimal import Decimal
from typing import Callable, Iterable, Iterator, Sequence

import numpy as np

# Metres, degrees and shares to a thousandth, shades of pictures to four of 255.
STEP, SHADE = 1e-3, 4.0
# Cells of rasters on a side of a square, pixels of a picture, values of a column, coordinates.
CELLS, PIXELS, POINTS, COORDINATES = 6, 16, 25, 8
_QUARTERS = 4
# Rounding both sums moves them apart by one quarter at most: one step always passes, two never,
# also where last bits of all values of the group differ.
_ALIKE = 5
_LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
_VALUE = {letter: value for value, letter in enumerate(_LETTERS)}
_BASE = len(_LETTERS)
_NOTHING = -9876.5  # stands for NaN and no data, so that they are seen to come and go
_EXACT_LETTERS = 8
_SUMS = re.compile(r"(\d+)x(\d+)~([\w-]*)")
# What has decimals is measured; what has none is a count, a number or a code.
_DECIMAL = re.compile(r"(?<![\w.])[-+\u2212]?\d[\d,]*\.\d+(?!\d|\.\d)")
# Of numbers that are not rounded: the digits that count, and how far they may be apart.
_DIGITS, _SHARE, _FARTHEST = 10, 1e-6, 5e-4
# A number of JSON has no trailing zeros, which say how it was rounded.
_COARSEST = Decimal("0.01")


def exactly(parts: Iterable[bytes]) -> str:
    """Return the digest of what has to be equal."""
    found = hashlib.sha256()
    for part in parts:
        found.update(part)
    return found.hexdigest()[:_EXACT_LETTERS]


def in_squares(values: np.ndarray, side: int, step: float) -> str:
    """Return the sums of a raster (rows, columns) by squares of cells."""
    rows, columns = (range(0, size, side) for size in values.shape)
    whole = np.add.reduceat(np.add.reduceat(_finite(values), rows, 0), columns, 1)
    return _packed(whole, step)


def in_groups(values: Sequence[float] | np.ndarray, size: int, step: float) -> str:
    """Return the sums of values by groups of as many that follow each other."""
    finite = _finite(np.asarray(values, np.float64))
    sums = np.add.reduceat(finite, range(0, len(finite), size)) if len(finite) else finite
    return _packed(sums[None], step)


def _finite(values: np.ndarray) -> np.ndarray:
    values = values.astype(np.float64)
    return np.where(np.abs(values) < 1e9, values, _NOTHING)


def _packed(sums: np.ndarray, step: float) -> str:
    units = np.rint(sums * (_QUARTERS / step)).astype(np.int64) % _BASE**2
    letters = "".join(_LETTERS[unit // _BASE] + _LETTERS[unit % _BASE] for unit in units.flat)
    return f"{sums.shape[0]}x{sums.shape[1]}~{letters}"


def without_decimals(text: str) -> tuple[str, list[str]]:
    """Return a text with a sign in the place of each number that has decimals, and these."""
    found = [number.replace("\u2212", "-") for number in _DECIMAL.findall(text)]
    return _DECIMAL.sub("#", text), [number.replace(",", "").lstrip("+") for number in found]


def printed(found: Sequence[str]) -> str:
    """Return numbers as a text has them; nothing if there are none."""
    return "=" + " ".join(found) if found else ""


def rounded(found: Sequence[float]) -> str:
    """Return numbers of JSON or a table with as many digits as count; nothing if there are none."""
    return ":" + " ".join(f"{value:.{_DIGITS}g}" for value in found) if found else ""


def in_last_places(numbers: Sequence[str]) -> list[float]:
    """Return numbers of a text in units of their last place."""
    return [float(number.replace(".", "")) for number in numbers]


def difference(agreed: str, found: str) -> str | None:
    """Return what differs between two parts of digests in words, "" if only that they differ, or
    None if they are alike.
    """
    if agreed == found:
        return None
    before, after = _SUMS.fullmatch(agreed), _SUMS.fullmatch(found)
    if before and after and before.groups()[:2] == after.groups()[:2]:
        return _of_sums(before[3], after[3], int(before[2]))
    for first, alike in (("=", _printed_alike), (":", _rounded_alike)):
        if agreed.startswith(first) and found.startswith(first):
            return _of_numbers(agreed[1:].split(), found[1:].split(), alike)
    return ""


def _of_sums(agreed: str, found: str, columns: int) -> str | None:
    wrong = []
    for place, (before, after) in enumerate(zip(_units(agreed), _units(found))):
        apart = (after - before + _BASE**2 // 2) % _BASE**2 - _BASE**2 // 2
        if abs(apart) > _ALIKE:
            wrong.append(f"{place // columns}/{place % columns} by {apart / _QUARTERS:+g}")
    return _first(wrong, f"groups of {len(agreed) // 2}")


def _units(letters: str) -> Iterator[int]:
    for high, low in zip(letters[::2], letters[1::2]):
        yield _BASE * _VALUE[high] + _VALUE[low]


def _of_numbers(
    agreed: list[str], found: list[str], alike: Callable[[str, str], bool]
) -> str | None:
    if len(agreed) != len(found):
        return f"{len(found)} in the place of {len(agreed)}"
    pairs = [pair for pair in zip(agreed, found) if pair[0] != pair[1] and not alike(*pair)]
    return _first([f"{before} is {after}" for before, after in pairs], f"{len(found)}")


def _first(wrong: list[str], count: str) -> str | None:
    return f"{len(wrong)} of {count}: {'; '.join(wrong[:3])}" if wrong else None


def _printed_alike(agreed: str, found: str) -> bool:
    """Return whether numbers of texts, which have as many decimals, are one unit apart at most."""
    before, after = Decimal(agreed), Decimal(found)
    unit = Decimal(1).scaleb(_place(before))
    return _place(before) == _place(after) and abs(before - after) <= unit


def _rounded_alike(agreed: str, found: str) -> bool:
    """Return whether numbers are one unit apart at the last place that either has, or as far as
    numbers may be that are not rounded.
    """
    before, after = Decimal(agreed), Decimal(found)
    if not (before.is_finite() and after.is_finite()):
        return False
    unit = min(Decimal(1).scaleb(min(_place(before), _place(after))), _COARSEST)
    return abs(before - after) <= max(unit, Decimal(min(_SHARE * abs(float(before)), _FARTHEST)))


def _place(number: Decimal) -> int:
    """Return the power of ten of the last place of a number."""
    exponent = number.as_tuple().exponent
    return exponent if isinstance(exponent, int) else 0
