"""Finds the points of each leaf in a store, as runs of consecutive points."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

# Row and column of a square are packed into one number, each with an offset since it can be
# negative.
_SHIFT, _HALF = 32, 1 << 30


def code_of(row: np.ndarray, column: np.ndarray) -> np.ndarray:
    """Return one number for row and column of each square."""
    return (row.astype(np.int64) + _HALF << _SHIFT) + column.astype(np.int64) + _HALF


def row_and_column(codes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the row and column for numbers of `code_of`."""
    return (codes >> _SHIFT) - _HALF, (codes & ((1 << _SHIFT) - 1)) - _HALF


class Sorted(NamedTuple):
    """Some points sorted by the leaves that hold them.

    Attributes
    ----------
    order : numpy.ndarray of intp, shape (n,)
        The indices of the points; those of one leaf in their former order.
    codes, counts : numpy.ndarray of int64, shape (m,)
        The leaves that hold points, and their numbers of points.
    """

    order: np.ndarray
    codes: np.ndarray
    counts: np.ndarray

    @classmethod
    def of(cls, row: np.ndarray, column: np.ndarray) -> Sorted:
        """Sort points, given row and column of the leaf of each, float64 of shape (n,)."""
        codes = code_of(row, column)
        # Most points lie in the same leaf as the point before, and then a stable sort is fastest.
        order = np.argsort(codes, kind="stable")
        codes = codes[order]
        starts = np.flatnonzero(np.concatenate(([True], codes[1:] != codes[:-1]))[: len(codes)])
        return cls(order, codes[starts], np.diff(starts, append=len(codes)))


class LeafIndex:
    """The runs of all leaves of a store."""

    def __init__(self) -> None:
        self._added: list[np.ndarray] = []
        # Index of the first run of each leaf, and the number of all runs.
        self._bounds = np.zeros(1, dtype=np.intp)
        self._starts = self._counts = np.zeros(0, dtype=np.int64)

    def add(self, codes: np.ndarray, counts: np.ndarray, start: int) -> None:
        """Add points that were sorted together; `start` is the index of the first in the store."""
        starts = start + np.cumsum(counts) - counts
        self._added.append(np.column_stack((codes, starts, counts)).astype(np.int64))

    def finish(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Finish adding. Return row, column and number of points of each leaf."""
        added = np.concatenate([np.zeros((0, 3), np.int64), *self._added])
        self._added = []
        added = added[np.argsort(added[:, 0], kind="stable")]
        codes, first = np.unique(added[:, 0], return_index=True)
        self._bounds = np.append(first, len(added))
        self._starts, self._counts = added[:, 1].copy(), added[:, 2].copy()
        totals = np.add.reduceat(self._counts, first) if len(codes) else codes
        return (*row_and_column(codes), totals)

    def of(self, leaves: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the starts of the runs of some leaves, ascending, and the lengths of the runs."""
        of_each = [np.arange(*self._bounds[leaf : leaf + 2]) for leaf in leaves]
        runs = np.concatenate([np.zeros(0, np.intp), *of_each])
        runs = runs[np.argsort(self._starts[runs], kind="stable")]
        return self._starts[runs], self._counts[runs]


def smallest_integers(count: int) -> type:
    """Return the smallest integer type that holds the indices of `count` points."""
    return np.int32 if count < 1 << 31 else np.int64
