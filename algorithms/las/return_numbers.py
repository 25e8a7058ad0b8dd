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
    number, total = cloud.return_number, cloud.number_of_returns
    if number.all():
        return cloud
    numbers, totals = begin_at_zero(pulses_of(number, total))
    if numbers:
        number += 1
        cloud.from_zero = True
    if totals:
        total += 1
    return cloud


def pulses_of(number: np.ndarray, total: np.ndarray) -> np.ndarray:
    """Return how many points have each return number (row) and number of returns (column); int
    (16, 16).
    """
    pairs = number.astype(np.uint8) << np.uint8(4) | total.astype(np.uint8)
    return np.bincount(pairs, minlength=256).reshape(16, 16)


def begin_at_zero(pulses: np.ndarray) -> tuple[bool, bool]:
    """Return whether return numbers, and whether numbers of returns, begin at 0 instead of 1."""
    # They begin at 0 if pulses with several returns have a return 0 and higher ones, but no return
    # whose number is the number of returns; or if numbers of returns begin at 0 as well, so that as
    # many points have return 0 as have the number of returns. A file whose return numbers are all 0
    # does not count returns.
    number, total = np.indices(pulses.shape)
    last = number >= total
    firsts, lasts = pulses[0, 2:].sum(), pulses[last & (total > 1)].sum()
    if firsts > 0 and lasts <= _MOST_WRONG * firsts and pulses[1:, 2:].any():
        return True, False
    firsts, lasts = pulses[0, 1:].sum(), pulses[last & (total > 0)].sum()
    both = firsts > 0 and abs(firsts - lasts) <= _CUT_OFF * firsts and pulses[:, 0].any()
    return bool(both), bool(both)
