"""Return numbers, which the LAS specification counts from 1, and some files from 0."""

from __future__ import annotations

import numpy as np

from .cloud import PointCloud

FROM_ZERO = (
    "The return numbers begin at 0, not at 1 as in the LAS specification: each counts as one"
    " higher."
)
# The flag of points of pulses with several returns.
MULTI_RETURN = "multi return"
# If a file counts from 0, the largest share of pulses that seem to count from 1.
_MOST_WRONG = 0.02
# The share by which the numbers of first and last returns may differ, since some returns of pulses
# lie outside of the points that are read.
_CUT_OFF = 0.2


class SeveralReturns:
    """Returns which of some points are of pulses with several returns, without an array for all."""

    def __init__(self, cloud: PointCloud) -> None:
        self._counts = cloud.number_of_returns

    def __getitem__(self, indices: np.ndarray) -> np.ndarray:
        return self._counts[indices] > 1


def count_from_one(cloud: PointCloud) -> PointCloud:
    """Return points that were just read with return numbers that begin at 1, even if they begin at
    0 in the file.
    """
    # They begin at 0 if pulses with several returns have a return 0 and higher ones, but no return
    # whose number is the number of returns; or if numbers of returns begin at 0 as well, so that as
    # many points have return 0 as have the number of returns. A file whose return numbers are all 0
    # does not count returns.
    number, total = cloud.return_number, cloud.number_of_returns
    if number.all():
        return cloud
    zero, last = number == 0, number >= total
    if _is_first_of_several(zero, last, total > 1):
        number += 1
        cloud.from_zero = True
    elif _are_both_from_zero(zero, last, total):
        number += 1
        total += 1
        cloud.from_zero = True
    return cloud


def _is_first_of_several(zero: np.ndarray, last: np.ndarray, several: np.ndarray) -> bool:
    firsts, lasts = (int(np.count_nonzero(several & mask)) for mask in (zero, last))
    return firsts > 0 and lasts <= _MOST_WRONG * firsts and bool(np.any(several & ~zero))


def _are_both_from_zero(zero: np.ndarray, last: np.ndarray, total: np.ndarray) -> bool:
    several = total > 0
    firsts, lasts = (int(np.count_nonzero(several & mask)) for mask in (zero, last))
    return firsts > 0 and abs(firsts - lasts) <= _CUT_OFF * firsts and not several.all()
