"""Why the expected error of a place is large, in words that other programs find again."""

from __future__ import annotations

import math
import re
from typing import Mapping, NamedTuple

from ...grids.expected_error import Evidence
from ...report.units import Units

# By the piece of evidence with the largest share in the expected error; {width} is that of the gap,
# {error} the expected error.
_REASONS = {
    "holes": "hardly any ground under plants or on roofs",
    "roughness": "rough ground: a step, rocks or plants that were kept as ground",
    "slope": "steep ground",
    "gap": "a gap of {width} without ground",
    "gap_at_step": "a gap of {width} without ground, beside a step or a slope",
    "doubtful": "plants or ground: low points were not taken for ground, up to {error} off",
    "low_plants": "low plants: the ground may be up to {error} too high",
}
_UNKNOWN = "a large expected error"
# Of these, also the difference between the lowest and the highest cell.
_OF_RELIEF = (_UNKNOWN, *(_REASONS[name] for name in ("holes", "roughness", "slope")))
_RELIEF = "{rise} of relief"
# Of a place beside cells without a value.
_BORDER = "beside water or the border of the survey"
# All parts of reasons, with fields for figures.
TEXTS = (*_REASONS.values(), _UNKNOWN, _RELIEF, _BORDER)
CAUSES = len(_REASONS)  # numbers from 1 on; 0 is no cause


class PlaceFigures(NamedTuple):
    """The figures of a place in metres."""

    rise: float  # NaN without a terrain model
    width: float
    error: float


def reason_of(cause: int, figures: PlaceFigures, is_border: bool, units: Units) -> str:
    """Return the reason for a cause, the number of a piece of `Evidence` or 0 for none."""
    first = _REASONS[Evidence._fields[cause - 1]] if cause else _UNKNOWN
    has_relief = first in _OF_RELIEF and not math.isnan(figures.rise)
    parts = [first, *[_RELIEF] * has_relief, *[_BORDER] * is_border]
    return ", ".join(parts).format(
        rise=units.height(figures.rise),
        width=units.length(figures.width),
        error=units.height(figures.error),
    )


def parts_of(reason: str) -> list[tuple[str, Mapping[str, str]]]:
    """Return the texts of a reason, each with its figures; none if it is in other words."""
    for first in (*_REASONS.values(), _UNKNOWN):
        whole = f"{first}(, {_RELIEF})?(, {_BORDER})?"
        found = re.fullmatch(re.sub(r"{(\w+)}", r"(?P<\1>[0-9].*?)", whole), reason)
        if found:
            figures = found.groupdict()
            there = [first, *[_RELIEF] * bool(found["rise"]), *[_BORDER] * reason.endswith(_BORDER)]
            return [(text, figures) for text in there]
    return []
