"""Which points stand far above a neighbour: the decision of the classic slope filter.

Exact, but exact heights above the opened surface are found only for the few points whose answer
depends on them. Bounds by cell decide all others.
"""

from __future__ import annotations

import math

import numpy as np

from ..progress import SILENT, Progress
from .morphology import erosion
from .neighbourhood import ROUNDING, Neighbourhood

# Discs whose lowest cell is compared grow by this factor.
_DISC_STEP = math.sqrt(2.0)


def stands_above(
    neighbourhood: Neighbourhood,
    z: np.ndarray,
    height: float,
    slope: float,
    top_hat: bool,
    progress: Progress = SILENT,
) -> np.ndarray:
    """Return which points stand far above one of their neighbours.

    Parameters
    ----------
    neighbourhood : Neighbourhood
        Which points are compared.
    z : numpy.ndarray of float, shape (n,)
        Heights in metres.
    height, slope : float
        See `Neighbourhood.stands_above`.
    top_hat : bool
        Whether heights are compared above the opening of the heights by the neighbourhood, that
        is the highest erosion among the neighbours (white top-hat).
    progress : Progress
        Receives progress.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
    """
    if not neighbourhood.same_radius:
        return _everywhere(neighbourhood, z, height, slope, top_hat, progress)
    cell = neighbourhood.cell
    lowest = neighbourhood.lowest(z)
    occupied = np.isfinite(lowest)
    opening = _Opening(neighbourhood, z, lowest) if top_hat else None
    low = high = z
    lowest_low = lowest_high = lowest
    if opening:
        high = z - opening.low.ravel()[cell]
        low = z - np.minimum(opening.high.ravel()[cell], z)
        lowest_low, lowest_high = lowest.copy(), lowest.copy()
        lowest_high[occupied] -= opening.low[occupied]
        lowest_low[occupied] -= np.minimum(opening.high, lowest)[occupied]
    progress(0.2)
    # Lower than the one no point of the cell stands out, from the other on each does.
    least = (erosion(lowest_low, neighbourhood.outer) + (height - ROUNDING)).ravel()
    enough = _enough(neighbourhood, lowest_high, height, slope).ravel()
    progress(0.3)
    above = low >= enough[cell]
    asked = np.flatnonzero((high >= least[cell]) & ~above)
    if not opening or not len(asked):
        above[asked] = neighbourhood.stands_above(z, height, slope, progress.part(0.3, 1.0), asked)
        return above
    low[asked] = high[asked] = opening.heights(asked, progress.part(0.3, 0.6))
    own = low[asked]
    above[asked] = own >= enough[cell[asked]]
    asked = asked[(own >= least[cell[asked]]) & ~above[asked]]
    above[asked] = neighbourhood.stands_above(
        high, height, slope, progress.part(0.6, 0.7), asked, low[asked]
    )
    asked = asked[~above[asked]]
    matters = np.zeros(len(z), dtype=bool)
    possible = neighbourhood.stands_above(
        low, height, slope, progress.part(0.7, 0.8), asked, below=matters
    )
    # What is left stands above a neighbour or not, depending on how high exactly that is.
    asked = asked[possible]
    which = np.flatnonzero(matters & (low < high))
    low[which] = opening.heights(which, progress.part(0.8, 0.9))
    above[asked] = neighbourhood.stands_above(low, height, slope, progress.part(0.9, 1.0), asked)
    return above


def _everywhere(
    neighbourhood: Neighbourhood,
    z: np.ndarray,
    height: float,
    slope: float,
    top_hat: bool,
    progress: Progress,
) -> np.ndarray:
    """Return the same where the neighbourhoods of some points have grown: all heights exact."""
    heights = z
    if top_hat:
        eroded = neighbourhood.minimum(z, progress.part(0.0, 0.4))
        opened = neighbourhood.maximum(eroded, progress.part(0.4, 0.8))
        # Where a neighbourhood grew it may not contain the point itself from the other's view.
        heights = z - np.minimum(opened, z)
    return neighbourhood.stands_above(heights, height, slope, progress.part(0.8, 1.0))


def _enough(
    neighbourhood: Neighbourhood, highest: np.ndarray, height: float, slope: float
) -> np.ndarray:
    """Return the height from which on any point of a cell stands above another.

    Parameters
    ----------
    neighbourhood : Neighbourhood
        Which points are compared.
    highest : numpy.ndarray of float, shape (rows, columns)
        In each cell there is a point not higher than this.
    height, slope : float
        What must be exceeded.
    """
    enough = np.full(neighbourhood.shape, np.inf)
    # Between centres; two points of the cells lie at most a diagonal farther apart.
    radius, size = neighbourhood.inner, neighbourhood.cell_size
    while radius >= 0.0:
        allowed = max(height, slope * (radius + math.sqrt(2.0)) * size)
        np.minimum(enough, erosion(highest, radius) + (allowed + ROUNDING), out=enough)
        if allowed == height:
            break  # smaller discs allow no less
        radius = (radius + math.sqrt(2.0)) / _DISC_STEP - math.sqrt(2.0)
    return enough


class _Opening:
    """The opening of heights by the neighbourhood: bounds for each cell, exact where asked.

    Attributes
    ----------
    low, high : numpy.ndarray of float, shape (rows, columns)
        The opening at any point of a cell is not below and not above these.
    """

    def __init__(self, neighbourhood: Neighbourhood, z: np.ndarray, lowest: np.ndarray) -> None:
        self._neighbourhood, self._z = neighbourhood, z
        inner, outer = neighbourhood.inner, neighbourhood.outer
        self._occupied = occupied = np.isfinite(lowest)
        eroded = erosion(lowest, outer)
        self._eroded_high = np.full(lowest.shape, np.inf)
        self.low = eroded
        if inner >= 0.0:
            self._eroded_high = erosion(lowest, inner)
            self.low = -erosion(np.where(occupied, -eroded, np.inf), inner)
        self.high = -erosion(np.where(occupied, -self._eroded_high, np.inf), outer)

    def heights(self, at: np.ndarray, progress: Progress) -> np.ndarray:
        """Return the heights of some points (k,) above the opening, shape (k,)."""
        if not len(at):
            return np.empty(0)
        neighbourhood, cell = self._neighbourhood, self._neighbourhood.cell
        low = self.low.ravel()[cell[at]]
        # The erosion of a neighbour matters if it exceeds what the opening is at least.
        least = np.full(neighbourhood.shape, np.inf)
        np.minimum.at(least.ravel(), cell[at], low)
        least = erosion(least, neighbourhood.outer)
        matters = self._occupied & (self._eroded_high > least)
        which = np.flatnonzero(matters.ravel()[cell])
        # Points higher than all the erosions asked for change none of them.
        highest = np.where(matters, -self._eroded_high, np.inf)
        highest = -erosion(highest, neighbourhood.outer).ravel()
        eroded = np.empty(len(self._z))
        eroded[which] = neighbourhood.minimum(
            self._z,
            progress.part(0.0, 0.5),
            which,
            among=np.flatnonzero(self._z <= highest[cell]),
            start=np.minimum(self._z[which], self._eroded_high.ravel()[cell[which]]),
        )
        which = which[eroded[which] > least.ravel()[cell[which]]]
        opened = neighbourhood.maximum(eroded, progress.part(0.5, 1.0), at, which, start=low)
        return self._z[at] - np.minimum(opened, self._z[at])
