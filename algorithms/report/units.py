"""Lengths and heights as text in the units of a survey; all are computed in metres."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np


class Units(NamedTuple):
    """The horizontal and the vertical unit of a survey, in metres."""

    horizontal: float = 1.0
    vertical: float = 1.0

    @property
    def across(self) -> str:
        """Symbol of the horizontal unit."""
        return _symbol(self.horizontal)

    @property
    def up(self) -> str:
        """Symbol of the vertical unit."""
        return _symbol(self.vertical)

    @property
    def cubic(self) -> str:
        """Symbol of the unit of volumes."""
        return f"{self.across}³" if self.across == self.up else f"{self.across}² {self.up}"

    def length(self, metres: float, digits: int = 3) -> str:
        """Return a length in the unit of the survey, and in metres if that is another unit."""
        if self.horizontal == 1.0:
            return f"{metres:g} m"
        return f"{metres / self.horizontal:.{digits}g} {self.across} ({metres:g} m)"

    def height(self, metres: float) -> str:
        """Return a height difference in the unit of the survey."""
        return f"{metres / self.vertical:.2f} {self.up}"


def _symbol(metres: float) -> str:
    """Return the symbol of a unit; on a page, both kinds of feet are the same."""
    if metres == 1.0:
        return "m"
    return "ft" if math.isclose(metres, 0.3048, rel_tol=1e-5) else f"units of {metres:g} m"


def round_length(most: float) -> float:
    """Return the largest number of the form 1, 2, 5, 10, 20 ... up to `most`."""
    power = 10.0 ** np.floor(np.log10(most))
    return float(next(step * power for step in (5, 2, 1) if step * power <= most * (1 + 1e-9)))


def percent(value: float) -> str:
    """Return a percentage as text; "none" for NaN."""
    return "none" if np.isnan(value) else f"{value:.2f} %"
