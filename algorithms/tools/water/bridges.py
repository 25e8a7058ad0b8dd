"""Water below the decks of bridges: the returns from a deck cut a river into pieces."""

from __future__ import annotations

import itertools

import numpy as np

from ...grids.morphology import closing, dilation
from ...survey.area import Area, Polygon
from .grid import WaterGrid, Window, regions_of

_EDGE = 2.0  # distance from a deck up to which cells have few returns from the water, m
_EDGE_CELLS = 1.5  # the least of it, cells
# Radius of the disc that joins pieces of water, in halves of the width of the deck: it hardly
# reaches between them from the land.
_RADIUS = 3.0
_MOST_HALF = 25.0  # half the width up to which decks join, m
_BESIDE = 1.5  # distance from a deck of the water at its side, cells
# The ends of two pieces of water are cells at most this many times as far apart as the nearest.
_STRAIGHT = 1.5
_CORNERS = np.array([(-0.5, -0.5), (-0.5, 0.5), (0.5, -0.5), (0.5, 0.5)])
_ABUTMENT = 4.0  # distance from a deck up to which the ground may be that of an abutment, m
_ABUTMENT_CELLS = 3.0  # the least of it, cells


def below_decks(water: np.ndarray, grid: WaterGrid) -> np.ndarray:
    """Return the cells below decks that lie between cells of `water`, in which cells below decks
    are missing; bool (rows, columns).
    """
    # Only the cells of a deck and of its edges change, so that the land on both sides of a river
    # stays. A deck without water on both sides has none below it.
    from scipy.ndimage import distance_transform_edt

    below = np.zeros(grid.shape, dtype=bool)
    edge = max(_EDGE / grid.cell, _EDGE_CELLS)
    most = _MOST_HALF / grid.cell + edge
    # A disc that lies beyond the window touches no water that matters.
    reach = int(2.0 * _RADIUS * most) + 1
    for window, widened in regions_of(dilation(grid.decks, edge), reach=reach):
        seen, deck = water[window], grid.decks[window] & widened
        if not seen.any():
            continue
        land = np.isfinite(grid.ground[window]) & ~deck
        hiding = dilation(deck, edge) & ~land & ~seen
        half = float(distance_transform_edt(np.pad(hiding, 1)).max())
        if half <= most:
            joined = closing(seen, _RADIUS * half) & hiding
            below[window] |= joined | _across(seen, joined, hiding, 2.0 * most)
    return below


def _across(seen: np.ndarray, joined: np.ndarray, hiding: np.ndarray, most: float) -> np.ndarray:
    """Return the cells below a deck between pieces of water that are at most `most` cells apart."""
    # A disc reaches between the pieces of a stream that is narrower than the deck.
    from scipy.ndimage import label
    from scipy.spatial import Delaunay, cKDTree

    between = np.zeros_like(hiding)
    labels, _ = label(seen | joined, np.ones((3, 3)))
    beside = np.where(seen & dilation(hiding, _BESIDE), labels, 0)
    pieces = [np.argwhere(beside == number) for number in np.unique(beside[beside > 0])]
    cells = np.argwhere(hiding)
    for pair in itertools.combinations(pieces, 2):
        away = [cKDTree(pair[1 - side]).query(pair[side])[0] for side in (0, 1)]
        nearest = away[0].min()
        if nearest <= most:
            ends = np.concatenate(
                [piece[far <= _STRAIGHT * nearest] for piece, far in zip(pair, away)]
            )
            corners = (ends[:, None] + _CORNERS).reshape(-1, 2)
            between[tuple(cells[Delaunay(corners).find_simplex(cells) >= 0].T)] = True
    return between


def decks_without_water(
    grid: WaterGrid, polygons: tuple[Polygon, ...]
) -> tuple[tuple[float, float], ...]:
    """Return the middles of decks without a cell in any polygon of water, in metres."""
    from scipy.ndimage import label

    labels, count = label(dilation(grid.decks, max(_EDGE / grid.cell, _EDGE_CELLS)))
    rows, columns = np.nonzero(labels)
    decks = labels[rows, columns]
    x, y = (columns + grid.column + 0.5) * grid.cell, (rows + grid.row + 0.5) * grid.cell
    wet = set(decks[Area(None, polygons).contains(x, y)].tolist()) if polygons else set()
    dry = [decks == number for number in range(1, count + 1) if number not in wet]
    return tuple((float(x[deck].mean()), float(y[deck].mean())) for deck in dry)


def beside_decks(grid: WaterGrid, window: Window) -> np.ndarray:
    """Return the cells of a window whose ground may be that of an abutment."""
    return dilation(grid.decks[window], max(_ABUTMENT / grid.cell, _ABUTMENT_CELLS))
