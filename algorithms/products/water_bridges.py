"""Water below the decks of bridges: the returns from a deck cut a river into pieces."""

from __future__ import annotations

import numpy as np

from ..grids.morphology import closing, dilation
from .water_grid import WaterGrid

# Cells this near to a deck, in metres and at least in cells, have few returns from the water.
_EDGE, _EDGE_CELLS = 2.0, 1.5
# Pieces of water are joined by a disc whose radius is so many times half the width of the deck: it
# hardly reaches between them from the land. Half the width in metres up to which decks join.
_RADIUS, _MOST_HALF = 3.0, 25.0
# The ground this near to a deck, in metres and at least in cells, may be that of an abutment.
_ABUTMENT, _ABUTMENT_CELLS = 4.0, 3.0


def below_decks(water: np.ndarray, grid: WaterGrid) -> np.ndarray:
    """Return the cells below decks that lie between cells of water.

    Only the cells of a deck and of its edges change, so that the land on both sides of a river
    stays. A deck without water on both sides has none below it.

    Parameters
    ----------
    water : numpy.ndarray of bool, shape (rows, columns)
        The cells of water, without those below decks.
    grid : WaterGrid
        Counts and heights of all points.

    Returns
    -------
    numpy.ndarray of bool, shape (rows, columns)
    """
    from scipy.ndimage import distance_transform_edt, find_objects, label

    below = np.zeros(grid.shape, dtype=bool)
    if grid.decks is None:
        return below
    edge = max(_EDGE / grid.cell, _EDGE_CELLS)
    most = _MOST_HALF / grid.cell + edge
    # A disc that lies beyond the window touches no water that matters.
    reach = int(2.0 * _RADIUS * most) + 1
    labels, _ = label(dilation(grid.decks, edge))
    for number, box in enumerate(find_objects(labels), start=1):
        window = tuple(slice(max(side.start - reach, 0), side.stop + reach) for side in box)
        seen = water[window]
        if not seen.any():
            continue
        deck = grid.decks[window] & (labels[window] == number)
        land = np.isfinite(grid.ground[window]) & ~deck
        hiding = dilation(deck, edge) & ~land & ~seen
        half = float(distance_transform_edt(np.pad(hiding, 1)).max())
        if half <= most:
            below[window] |= closing(seen, _RADIUS * half) & hiding
    return below


def beside_decks(grid: WaterGrid, rows: slice, columns: slice) -> np.ndarray:
    """Return the cells of a window whose ground may be that of an abutment."""
    if grid.decks is None:
        return np.zeros(grid.shape, dtype=bool)[rows, columns]
    return dilation(grid.decks[rows, columns], max(_ABUTMENT / grid.cell, _ABUTMENT_CELLS))
