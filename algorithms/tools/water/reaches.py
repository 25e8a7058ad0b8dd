"""Cuts a region of water across into reaches: a network with its branches and its islands.

The reaches are the connected parts of bands of equal distance from one end (a Reeb graph).
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .descent import Network

if TYPE_CHECKING:
    from scipy.sparse import csr_matrix

# Most cells in which the ways along a river are searched.
_MOST_CELLS = 200_000
_DEPTHS = 2.0  # length of a reach, mean depths: about half the width of a river
_LEAST = 2.0  # its least length, cells
_ELONGATED = 2.0  # least length of a branch, widths; what is shorter is a bay
_FEWEST = 3  # fewest reaches of a branch


class Reaches(NamedTuple):
    """The reaches of a region of water."""

    network: Network  # which of them are neighbours
    places: np.ndarray  # float64, (size, 2): row and column of the middle of each reach
    # int32, (rows, columns): the reach of each group of cells, also on land, where it is that of
    # the nearest water
    numbers: np.ndarray
    along: np.ndarray  # float64, (rows, columns): distance of groups from one end, in cells
    middles: np.ndarray  # float64, (size,): the mean of `along` in each reach
    group: int  # side of a group in cells
    width: float  # mean of the chains, weighted by their area, in cells
    length: float  # of all chains, in cells

    def of(self, places: np.ndarray) -> np.ndarray:
        """Return the reach at rows and columns, shape (k, 2)."""
        return self.numbers[self._groups(places)]

    def _groups(self, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        row, column = np.floor((np.asarray(places) + 0.5) / self.group).astype(np.int64).T
        rows, columns = self.numbers.shape
        return np.clip(row, 0, rows - 1), np.clip(column, 0, columns - 1)

    def between(self, values: np.ndarray, places: np.ndarray) -> np.ndarray:
        """Return values of reaches at rows and columns, interpolated along the water."""
        groups = self._groups(places)
        reach = self.numbers[groups]
        off = self.along[groups] - self.middles[reach]
        found, nearest = values[reach], np.full(len(reach), np.inf)
        edges = np.concatenate((self.network.edges, self.network.edges[:, ::-1]))
        edges = edges[np.argsort(edges[:, 0], kind="stable")]
        starts = np.searchsorted(edges[:, 0], np.arange(self.network.size + 1))
        for turn in range(int(np.diff(starts).max(initial=0))):
            indices = np.flatnonzero(starts[reach] + turn < starts[reach + 1])
            start = reach[indices]
            end = edges[starts[start] + turn, 1]
            # The share of the way between the middles of both reaches. Where branches meet, a reach
            # belongs to all of them, so the distance from one end of the water is not enough.
            line = self.places[end] - self.places[start]
            place = places[indices] - self.places[start]
            squared = np.maximum((line**2).sum(axis=1), 1e-9)
            share = np.clip((line * place).sum(axis=1) / squared, 0.0, 1.0)
            far = np.hypot(*(place - share[:, None] * line).T)
            length = self.middles[end] - self.middles[start]
            share += np.clip(off[indices] / np.where(length == 0, np.inf, length), 0.0, 1.0)
            closer = far < nearest[indices]
            indices, start, end, share = indices[closer], start[closer], end[closer], share[closer]
            nearest[indices] = far[closer]
            found[indices] = values[start] + (values[end] - values[start]) * share / 2.0
        return found


def reaches_of(water: np.ndarray, longest: float) -> Reaches:
    """Return the reaches, at most `longest` cells long, of a connected region."""
    from scipy.ndimage import distance_transform_edt
    from scipy.sparse.csgraph import dijkstra

    group = max(1, math.ceil(math.sqrt(np.count_nonzero(water) / _MOST_CELLS)))
    cells = np.pad(water, [(0, -side % group) for side in water.shape])
    rows, columns = (side // group for side in cells.shape)
    cells = cells.reshape(rows, group, columns, group).max(axis=(1, 3))
    deep = distance_transform_edt(np.pad(cells, 1))[1:-1, 1:-1][cells]
    ends, apart = _neighbours(cells)
    graph = _matrix(ends, apart, len(deep))
    start = _farthest(graph, _farthest(graph, 0))
    away = dijkstra(graph, directed=False, indices=start)
    away[~np.isfinite(away)] = 0.0
    side = max(_LEAST, round(min(_DEPTHS * float(deep.mean()), longest / group)))
    reach, edges = _bands(ends, np.floor(away / side).astype(np.int64))
    sizes = np.bincount(reach)
    middles = np.bincount(reach, away) / sizes
    owner = _without_bays(edges, sizes, middles, side)
    # A bay is as far along as the water that it belongs to.
    away = np.where(owner[reach] == reach, away, middles[owner[reach]])
    names, reach = np.unique(owner[reach], return_inverse=True)
    network = Network(len(names), _links(np.searchsorted(names, owner[edges])))
    weights = deep**4
    sums = [np.bincount(reach, weights * axis) for axis in np.nonzero(cells)]
    places = np.column_stack(sums) / np.bincount(reach, weights)[:, None]
    width, length = _width_and_length(network, places, np.bincount(reach), side)
    nearest = distance_transform_edt(~cells, return_distances=False, return_indices=True)
    numbers, along = np.zeros(cells.shape, np.int32), np.zeros(cells.shape)
    numbers[cells], along[cells] = reach, away
    return Reaches(
        network, (places + 0.5) * group - 0.5, numbers[tuple(nearest)], along[tuple(nearest)],
        middles[names], group, width * group, length * group,
    )  # fmt: skip


def _neighbours(cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the numbers of neighbouring cells of a region, (n, 2), and their distances."""
    rows, columns = cells.shape
    number = np.full((rows + 1, columns + 2), -1, dtype=np.int64)
    number[:-1, 1:-1][cells] = np.arange(np.count_nonzero(cells))
    ends, apart = [], []
    for down, right in ((0, 1), (1, 0), (1, 1), (1, -1)):
        beside = number[down:, 1 + right :][:rows, :columns][cells]
        cell = np.flatnonzero(beside >= 0)
        ends.append(np.column_stack((cell, beside[cell])))
        apart.append(np.full(len(cell), math.hypot(down, right)))
    return np.concatenate(ends), np.concatenate(apart)


def _matrix(ends: np.ndarray, weights: np.ndarray, size: int) -> csr_matrix:
    from scipy.sparse import coo_matrix

    return coo_matrix((weights, ends.T), shape=(size, size)).tocsr()


def _links(edges: np.ndarray) -> np.ndarray:
    """Return the pairs of different numbers, each pair once."""
    return np.unique(np.sort(edges[edges[:, 0] != edges[:, 1]], axis=1), axis=0)


def _farthest(graph: csr_matrix, start: int) -> int:
    from scipy.sparse.csgraph import dijkstra

    far = dijkstra(graph, directed=False, indices=start)
    return int(np.argmax(np.where(np.isfinite(far), far, -1.0)))


def _bands(ends: np.ndarray, band: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the number of the connected part of its band for each cell, and which parts touch."""
    from scipy.sparse.csgraph import connected_components

    same = np.equal(*band[ends].T)
    graph = _matrix(ends[same], np.ones(np.count_nonzero(same)), len(band))
    reach = connected_components(graph, directed=False)[1]
    return reach, _links(reach[ends[~same]])


def _without_bays(
    edges: np.ndarray, sizes: np.ndarray, middles: np.ndarray, side: float
) -> np.ndarray:
    """Return the reach that each one belongs to when short branches belong to their junction."""
    owner, sizes = np.arange(len(sizes)), sizes.astype(np.float64)
    while True:
        links = _links(owner[edges])
        degree = np.bincount(links.ravel(), minlength=len(owner))
        bays: dict[int, tuple[float, np.ndarray]] = {}
        for chain in Network(len(owner), links).chains():
            if degree[chain[0]] > degree[chain[-1]]:
                chain = chain[::-1]
            if degree[chain[0]] != 1 or degree[chain[-1]] < 3:
                continue
            tip, junction = chain[0], int(chain[-1])
            length = abs(middles[tip] - middles[junction]) + side / 2.0
            width = sizes[chain[:-1]].sum() / length
            is_short = length < _ELONGATED * width or len(chain) <= _FEWEST
            if is_short and (junction not in bays or length < bays[junction][0]):
                bays[junction] = length, chain[:-1]
        if not bays:
            return owner
        # Only the shortest bay at each junction, since the next one can then be the main water.
        for junction, (_, chain) in bays.items():
            owner[np.isin(owner, chain)] = junction


def _width_and_length(
    network: Network, places: np.ndarray, sizes: np.ndarray, side: float
) -> tuple[float, float]:
    """Return the mean width, in which narrow branches count little, and the whole length."""
    degree = np.bincount(network.edges.ravel(), minlength=network.size)
    # A junction belongs to all its chains.
    shares = sizes / np.where(degree > 2, degree, 1)
    sums, total = 0.0, 0.0
    for chain in network.chains():
        length = float(np.hypot(*np.diff(places[chain], axis=0).T).sum())
        length += np.count_nonzero(degree[chain[[0, -1]]] <= 1) * side / 2.0
        sums, total = sums + float(shares[chain].sum()) ** 2 / max(length, 1.0), total + length
    return sums / float(sizes.sum()), total
