"""Regions of a height grid, judged by how their borders drop or rise."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

# Least share of a pit's border that must be a rise.
_PIT_SHARE = 0.9
# Least share of an object's border that must be a drop: first of the known border, then of the
# whole border, including the border of the survey. It is more than half, because the one drop of a
# topmost terrace tread winds.
_OBJECT_SHARE = 0.65
_WHOLE_SHARE, _CLASSIC_WHOLE_SHARE = 0.55, 0.4
# Least mean height of the drop over the width of the region; lower and wider regions are terrain.
_LEAST_STEEPNESS = 0.15
# Regions of at least this width (m) are terrain if at least this share of their drops is on the
# face of a cliff. The share is lower for wide regions: few plants hide the walls of a large
# building.
_FACE_WIDTHS, _FACE_SHARES = (10.0, 25.0), (0.4, 0.25)
# Rounds in which regions that others hid are tested again.
_ROUNDS = 3


class Border(NamedTuple):
    """The pairs of neighbouring cells that lie in different regions.

    Attributes
    ----------
    regions : int
        One more than the largest number of a region.
    first, second : numpy.ndarray of int32, shape (pairs,)
        Region of the first and of the second cell; 0 where nothing is known.
    sign : numpy.ndarray of int8, shape (pairs,)
        1 where the second is higher by more than is allowed, -1 where it is lower, else 0.
    rise : numpy.ndarray of float32, shape (pairs,)
        Height of the second above the first in metres, beyond the trend.
    face : numpy.ndarray of float32, shape (pairs,)
        Slope (rise over run) of the face that the step between them is part of. It is the slope of
        the face's second step, because the first may be a wall below a roof. 0 where there is no
        face, NaN where this is unknown.
    """

    regions: int
    first: np.ndarray
    second: np.ndarray
    sign: np.ndarray
    rise: np.ndarray
    face: np.ndarray

    def length(self) -> np.ndarray:
        """Return the length of each region's border in cells, if neighbours are one apart."""
        all_ = np.ones(len(self.sign), dtype=bool)
        # Each cell of a straight border has three neighbours beyond it.
        return self._total(all_, all_) / 3.0

    def faces(self) -> np.ndarray:
        """Return the share of each region's drops that are part of a face, where this is known."""
        first, second = (self.sign == sign for sign in (-1, 1))
        known = self._total(first & ~np.isnan(self.face), second & ~np.isnan(self.face))
        on_face = self._total(first & (self.face > 0.0), second & (self.face > 0.0))
        return on_face / np.maximum(known, 1)

    def drops(
        self, removed: np.ndarray, sign: int
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Count where each region drops (sign 1) or rises (-1) to regions that are not removed.

        Returns, for each region, the number of pairs of cells with a drop, with a known neighbour,
        and of all pairs; and the mean height of the drops in metres.
        """
        pairs = ~(removed[self.first] | removed[self.second])
        known = pairs & (self.first > 0) & (self.second > 0)
        down, up = known & (self.sign == -sign), known & (self.sign == sign)
        drops = self._total(down, up)
        height = self._total(down, up, np.abs(self.rise)) / np.maximum(drops, 1)
        return drops, self._total(known, known), self._total(pairs, pairs), height

    def _total(
        self, first: np.ndarray, second: np.ndarray, weights: np.ndarray | None = None
    ) -> np.ndarray:
        """Count pairs, or add up their weights, for the region of each of their cells."""
        total = np.zeros(self.regions)
        for region, which in ((self.first, first), (self.second, second)):
            counted = weights if weights is None else weights[which]
            total += np.bincount(region[which], counted, self.regions)
        return total


class Regions:
    """The regions between rims.

    Attributes
    ----------
    number : numpy.ndarray of int32, shape (rows, columns)
        The region of each cell; 0 where nothing is known.
    width : numpy.ndarray of float, shape (count,)
        Width (shorter side) of each region in metres.
    """

    def __init__(self, number: np.ndarray, border: Border, size: float, step: int) -> None:
        self.number = number
        self._border = border
        area = np.bincount(number.ravel(), minlength=border.regions)
        self.width = _shorter_side(area, border.length() / step) * size

    def raised(self, max_size: float, classic: bool = False) -> np.ndarray:
        """Return the cells of the regions whose border is mostly a drop, but not a cliff.

        More than half of the border, including the border of the survey, must be a drop: the
        topmost tread of a terrace has a drop on one side, and the border of the survey on the
        other.

        Parameters
        ----------
        max_size : float
            Largest width in metres.
        classic : bool
            True for the rules of other programs' presets: less than half is enough, and cliffs are
            not treated differently.

        Returns
        -------
        numpy.ndarray of bool, shape (rows, columns)
        """
        share = _CLASSIC_WHOLE_SHARE if classic else _WHOLE_SHARE
        fits = True if classic else self._is_no_cliff()
        return self._bounded(max_size, 1, _OBJECT_SHARE, share, _LEAST_STEEPNESS, fits)

    def plateaus(self, max_size: float, least_size: float = 0.0) -> np.ndarray:
        """Return the cells of the same regions, and of regions too low for their width.

        Regions narrower than `least_size` metres are left out.
        """
        fits = self._is_no_cliff() & (self.width >= least_size)
        return self._bounded(max_size, 1, _OBJECT_SHARE, _WHOLE_SHARE, 0.0, fits)

    def _is_no_cliff(self) -> np.ndarray:
        """Return which regions are narrow, or have no faces round them."""
        most = np.interp(self.width, _FACE_WIDTHS, _FACE_SHARES)
        return (self.width < _FACE_WIDTHS[0]) | (self._border.faces() < most)

    def sunken(self, max_size: float) -> np.ndarray:
        """Return the cells of pits: regions whose border is a rise nearly all round."""
        return self._bounded(max_size, -1, _PIT_SHARE, _PIT_SHARE, 0.0, True)

    def _bounded(
        self,
        max_size: float,
        sign: int,
        share: float,
        least_share: float,
        least_steepness: float,
        fits: np.ndarray | bool,
    ) -> np.ndarray:
        """Return the cells of regions bounded by drops (1) or rises (-1).

        Regions that one round finds are unknown in the next, which finds regions that they hid: a
        roof below a tower, a pit within a pit.
        """
        fits = fits & (self.width <= max_size)
        fits[0] = False
        found = np.zeros(len(fits), dtype=bool)
        for _ in range(_ROUNDS):
            drops, known, pairs, height = self._border.drops(found, sign)
            new = fits & ~found & (drops > 0) & (height >= least_steepness * self.width)
            new &= (drops >= share * known) & (drops > least_share * pairs)
            if not new.any():
                break
            found |= new
        return found[self.number]


def _shorter_side(area: np.ndarray, perimeter: np.ndarray) -> np.ndarray:
    """Return the shorter side of rectangles; for rounder shapes, the side of a square."""
    quarter = perimeter / 4.0
    rest = quarter**2 - area
    return np.where(rest < 0, np.sqrt(area), quarter - np.sqrt(np.maximum(rest, 0.0)))
