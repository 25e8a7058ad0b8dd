"""Names what makes all heights wrong alike: another unit, or another vertical datum."""

from __future__ import annotations

import numpy as np

from ...crs.unit_names import FOOT

# An offset that is told is larger than this, in metres, and than so many times its spread.
_LEAST = 1.0
_TIMES_SPREAD = 5.0
# The same for one or two checkpoints, which have no spread.
_LEAST_OF_FEW = 5.0
_FEW = 3
# The largest distances between ellipsoid and geoid in metres, and those that are common on land.
_UNDULATIONS = 8.0, 110.0
# A standard deviation in median absolute deviations of normal errors.
_DEVIATION = 1.4826


def offset_in_words(heights: np.ndarray, checkpoints: np.ndarray) -> str:
    """Return a sentence on what makes all heights, in metres, differ alike from those of
    checkpoints; empty if nothing does.
    """
    errors = heights - checkpoints
    if not len(errors):
        return ""
    offset, spread = _middle(errors)
    count = len(errors)
    if abs(offset) <= (_LEAST if count >= _FEW else _LEAST_OF_FEW):
        return ""
    feet = _feet(heights, checkpoints, offset, spread)
    if feet:
        return feet
    if abs(offset) <= _TIMES_SPREAD * spread:
        return ""
    who = "The checkpoint lies" if count == 1 else f"The {count:,} checkpoints lie"
    alike = f", all alike (spread {spread:.2f} m)" if count >= _FEW else ""
    side = "above" if offset < 0 else "below"
    return f"{who} {abs(offset):.2f} m {side} the data{alike}. {_cause(abs(offset))}"


def _middle(errors: np.ndarray) -> tuple[float, float]:
    """Return the median, and the spread round it as a standard deviation."""
    middle = float(np.median(errors))
    return middle, _DEVIATION * float(np.median(np.abs(errors - middle)))


def _feet(heights: np.ndarray, checkpoints: np.ndarray, offset: float, spread: float) -> str:
    """Return a sentence if one of both is in feet; empty if not."""
    for factor, who, others in (
        (FOOT, "checkpoints", "data"), (1.0 / FOOT, "data", "checkpoints")
    ):  # fmt: skip
        left, still = _middle(heights - checkpoints * factor)
        # On land that is high, a geoid could be left. On flat land, the spread does not shrink.
        if abs(left) < min(0.03 * abs(offset), _LEAST) and still <= spread + 0.05:
            return (
                f"The heights of the {who} are feet where those of the {others} are metres: they"
                f" are {1.0 / FOOT:.3f} times as high. US survey feet and international feet look"
                " the same here. State the unit, as in a column named 'Elevation (ft)', or the CRS"
                " of the points."
            )
    return ""


def _cause(offset: float) -> str:
    least, most = _UNDULATIONS
    if least <= offset <= most:
        return (
            "Heights above the ellipsoid and above the geoid differ like this: one of both is of"
            " the other kind. Give both in one vertical datum."
        )
    if offset < least:
        return (
            "Another vertical datum looks like this, or the height of an antenna or a pole that was"
            " not taken off. Give both in one vertical datum."
        )
    return "Another unit or another height looks like this. Check the column of the heights."
