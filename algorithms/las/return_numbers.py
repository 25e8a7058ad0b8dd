"""Return numbers that begin at 0, where the LAS specification counts from 1."""

from __future__ import annotations

import numpy as np

from .cloud import PointCloud

FROM_ZERO = (
    "The return numbers begin at 0, not at 1 as in the LAS specification: each counts as one"
    " higher."
)
# Of pulses with several returns, the last one has the number of returns if they count from 1. In
# files that count from 0, at most so many are wrong for each first return.
_MOST_WRONG = 0.02


def count_from_one(cloud: PointCloud) -> PointCloud:
    """Return points whose return numbers begin at 1, also if those of the file begin at 0.

    They do if pulses with several returns have a return 0, others above it, and none with the
    number of returns. Files whose return numbers are all 0 do not count returns at all.

    Parameters
    ----------
    cloud : PointCloud
        Points that were just read; those that count from 0 get other return numbers.
    """
    number, several = cloud.return_number, cloud.number_of_returns > 1
    first = several & (number == 0)
    firsts = int(np.count_nonzero(first))
    if not firsts:
        return cloud
    lasts = int(np.count_nonzero(several & (number >= cloud.number_of_returns)))
    if lasts <= _MOST_WRONG * firsts and np.any(several & (number > 0)):
        number += 1
        cloud.from_zero = True
    return cloud
