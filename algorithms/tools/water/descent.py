"""Levels that never rise downstream, on a network of stations with branches and loops."""

from __future__ import annotations

from typing import NamedTuple, Sequence

import numpy as np

# Metres: heights this near to a level have full weight, others less with their distance. After
# these rounds of weighted means the level is a median.
_NEAR = 0.02
_ROUNDS = 6
# Stations over which levels are smoothed to learn which end of a chain is the upper one.
_SMOOTH = 3.0
# Metres: a chain whose lowest level is this far below both ends has two upper ends, such as two
# rivers that meet where the survey ends.
_VALLEY = 0.3
_NO_HEIGHT = 1e-4  # weight of a station without heights, compared to a height
_PROJECTIONS = 200  # most rounds of projections
_SAME = 1e-4  # metres: levels that move by less in a round are final
# Metres from the median height of the next stations, this many on each side, beyond which heights
# do not count. So the end of a chain is not that of a single wall.
_STRAY = 0.5
_STRAY_STATIONS = 2
# Stations on each side whose median difference between percentile and median is used.
_STATIONS = 5
_MEET = 0.1  # metres: stations this near are one
# A line joins another one if it ends within a multiple of half the width of the water, and metres
# beyond it.
_WIDER = 1.5
_JOINED = 10.0


class Network(NamedTuple):
    """Stations in water, and which of them are neighbours."""

    size: int  # number of stations
    edges: np.ndarray  # int64 (m, 2), pairs of neighbours, each once

    def chains(self) -> list[np.ndarray]:
        """Return the paths between ends and junctions: stations that have not two neighbours."""
        beside: list[list[int]] = [[] for _ in range(self.size)]
        for first, second in self.edges.tolist():
            beside[first].append(second)
            beside[second].append(first)
        found, passed = [], np.zeros(self.size, dtype=bool)
        ends = [station for station in range(self.size) if len(beside[station]) != 2]
        used: set[tuple[int, int]] = set()
        # A ring has no end, so it can begin at any station.
        for start in (*ends, *(n for n in range(self.size) if len(beside[n]) == 2)):
            if passed[start] and len(beside[start]) == 2:
                continue
            if not beside[start]:
                found.append(np.array([start]))
            for second in beside[start]:
                if (start, second) not in used:
                    way = _way_on(beside, start, second)
                    used |= {(start, second), (way[-1], way[-2])}
                    passed[way] = True
                    found.append(np.array(way))
        return found

    def matrix(self) -> np.ndarray:
        """Return the symmetric matrix of neighbours, sparse."""
        from scipy.sparse import coo_matrix

        first, second = self.edges.reshape(-1, 2).T
        half = coo_matrix((np.ones(len(first)), (first, second)), shape=(self.size, self.size))
        return (half + half.T).tocsr()


def _way_on(beside: list[list[int]], start: int, second: int) -> list[int]:
    """Return the path from a station by a neighbour to the next end or junction."""
    way = [start, second]
    while len(beside[way[-1]]) == 2 and way[-1] != start:
        first, second = beside[way[-1]]
        way.append(second if first == way[-2] else first)
    return way


class Descent(NamedTuple):
    """Levels on a network."""

    levels: np.ndarray  # float64 (size,), at each station
    chains: list[np.ndarray]  # int64, the stations of each chain, downstream


def descent(
    network: Network, station: np.ndarray, heights: np.ndarray, percentile: float = 50.0
) -> Descent:
    """Return the levels nearest to heights (n,) beside stations (n,), n > 0, that never rise
    downstream.
    """
    # A level is the percentile of the heights beside a station, compared with their trend.
    # The sum of distances is least (isotonic regression), so that single heights do not count; the
    # direction of each chain is that of smoothed levels. Chains share the level of a junction.
    usual = _percentiles(network.size, station, heights, 50.0)
    usual = _medians_near(network, usual, _STRAY_STATIONS)
    near = np.abs(heights - usual[station]) <= _STRAY
    if near.any():
        station, heights = station[near], heights[near]
    smooth = _smoothed(network, station, heights)
    chains = _directed(network.chains(), smooth)
    levels = smooth
    for _ in range(_ROUNDS):
        weights = 1.0 / np.maximum(np.abs(heights - levels[station]), _NEAR)
        mean, total = _means(network.size, station, heights, weights)
        levels = _ordered(np.where(total > 0, mean, levels), total + _NO_HEIGHT, chains)
    if percentile != 50.0:
        off = _percentiles(network.size, station, heights - levels[station], percentile)
        levels = levels + _medians_near(network, off, _STATIONS)
        levels = _ordered(levels, np.ones(network.size), chains)
    return Descent(levels, chains)


def _means(
    count: int, station: np.ndarray, heights: np.ndarray, weights: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the weighted mean of the heights at each station, and their weight."""
    total = np.bincount(station, weights, count)
    mean = np.bincount(station, weights * heights, count) / np.maximum(total, 1e-300)
    return mean, total


def _smoothed(network: Network, station: np.ndarray, heights: np.ndarray) -> np.ndarray:
    """Return levels that change little between neighbours, in either direction."""
    from scipy.sparse import diags
    from scipy.sparse.linalg import spsolve

    beside = network.matrix()
    laplace = _SMOOTH**2 * (diags(np.asarray(beside.sum(axis=1)).ravel()) - beside)
    levels = np.full(network.size, np.median(heights))
    weights = np.ones(len(heights))
    for _ in range(_ROUNDS):
        mean, total = _means(network.size, station, heights, weights)
        matrix = (laplace + diags(total + _NO_HEIGHT)).tocsc()
        right = total * mean + _NO_HEIGHT * levels
        levels = np.atleast_1d(spsolve(matrix, right))
        # Weights as for a median, but equal for all heights up to the height of a bank away.
        weights = 0.5 / np.maximum(np.abs(heights - levels[station]), 0.5)
    return levels


def _directed(chains: list[np.ndarray], smooth: np.ndarray) -> list[np.ndarray]:
    """Return the chains downstream, with rings and chains with a valley cut in two."""
    found = []
    for chain in chains:
        heights = smooth[chain]
        cut = int(np.argmin(heights))
        if chain[0] == chain[-1] and len(chain) > 2:
            cut = int(np.argmax(np.abs(heights - heights[0])))
        elif heights[cut] > min(heights[0], heights[-1]) - _VALLEY:
            cut = 0
        parts = [chain[: cut + 1], chain[cut:]] if 0 < cut < len(chain) - 1 else [chain]
        found += [part if smooth[part[0]] >= smooth[part[-1]] else part[::-1] for part in parts]
    return sorted(found, key=lambda chain: -float(smooth[chain[0]]))


def _ordered(values: np.ndarray, weights: np.ndarray, chains: list[np.ndarray]) -> np.ndarray:
    """Return the values with the least squared distance that rise in no chain (Dykstra 1983)."""
    levels = values.copy()
    moved = [np.zeros(len(chain)) for chain in chains]
    for _ in range(_PROJECTIONS if len(chains) > 1 else 1):
        before = levels.copy()
        for number, chain in enumerate(chains):
            wanted = levels[chain] + moved[number]
            levels[chain] = -isotonic(-wanted, weights[chain])
            moved[number] = wanted - levels[chain]
        if np.abs(levels - before).max() < _SAME:
            break
    # Small rises that remain are removed from the highest junction to the lowest.
    for chain in chains:
        levels[chain] = np.minimum.accumulate(levels[chain])
    return levels


def _percentiles(
    count: int, station: np.ndarray, heights: np.ndarray, percentile: float
) -> np.ndarray:
    """Return the percentile of the heights beside each station; NaN without any."""
    order = np.argsort(station, kind="stable")
    names, starts = np.unique(station[order], return_index=True)
    found = np.full(count, np.nan)
    parts = np.split(heights[order], starts[1:])
    found[names] = [np.percentile(part, percentile) for part in parts]
    return found


def _medians_near(network: Network, values: np.ndarray, steps: int) -> np.ndarray:
    """Return the median of the values up to `steps` stations away, without NaN."""
    from scipy.sparse import identity

    beside, near = network.matrix(), identity(network.size, format="csr")
    for _ in range(steps):
        near = near @ beside + near
    result = np.full(network.size, float(np.nanmedian(values)))
    for number, (first, last) in enumerate(zip(near.indptr[:-1], near.indptr[1:])):
        nearby = values[near.indices[first:last]]
        nearby = nearby[~np.isnan(nearby)]
        if len(nearby):
            result[number] = np.median(nearby)
    return result


def isotonic(values: np.ndarray, weights: np.ndarray | None = None) -> np.ndarray:
    """Return the non-decreasing values with the least squared distance, shape (n,), such as 1, 2.5,
    2.5, 4 for [1, 3, 2, 4].
    """
    # Neighbours that violate the order are pooled (Ayer et al. 1955).
    values = np.asarray(values, dtype=np.float64)
    shares = np.ones(len(values)) if weights is None else weights
    pools: list[tuple[float, float, int]] = []
    for value, share in zip(values.tolist(), shares.tolist()):
        mean, weight, count = value, share, 1
        while pools and pools[-1][0] > mean:
            before, share_before, more = pools.pop()
            mean = (mean * weight + before * share_before) / (weight + share_before)
            weight, count = weight + share_before, count + more
        pools.append((mean, weight, count))
    means, _, counts = zip(*pools) if pools else ((), (), ())
    return np.repeat(np.array(means, dtype=np.float64), np.array(counts, dtype=np.int64))


def falling(
    lines: Sequence[np.ndarray],  # (n, 2), stations of a branch, up or down, two or more
    border: np.ndarray,  # (m, 2), on the banks
    heights: np.ndarray,  # (m,), of the ground there, not all NaN
    places: np.ndarray,
    percentile: float,
) -> np.ndarray:
    """Return the water level at `places` (k, 2) along a river and its branches, a percentile of the
    heights of the banks beside; downstream it never rises.
    """
    from scipy.spatial import cKDTree

    stations, network = joined(lines, border)
    tree, known = cKDTree(stations), ~np.isnan(heights)
    beside = tree.query(border[known])[1]
    levels = descent(network, beside, heights[known], percentile).levels
    return levels[tree.query(places)[1]]


def joined(lines: Sequence[np.ndarray], border: np.ndarray) -> tuple[np.ndarray, Network]:
    """Return the stations (k, 2) of lines (n, 2) as one network, in which a line that ends near
    another one, by the distance of its banks (m, 2), joins it.
    """
    from scipy.spatial import cKDTree

    together = np.concatenate(lines)
    # Ends that meet are one station.
    _, first, name = np.unique(
        np.round(together / _MEET), axis=0, return_index=True, return_inverse=True
    )
    name, stations = name.reshape(-1), together[first]
    banks, edges, start = cKDTree(border), [], 0
    for line in lines:
        own = name[start : start + len(line)]
        start += len(line)
        edges.append(np.column_stack((own[:-1], own[1:])))
        others = np.setdiff1d(name, own)
        if len(others):
            far, nearest = cKDTree(stations[others]).query(stations[own[[0, -1]]])
            half = banks.query(stations[others[nearest]])[0]
            near = far <= _WIDER * half + _JOINED
            # The head of a short branch is near another line, too.
            near &= far <= np.hypot(*(line[-1] - line[0])) / 2.0
            edges.append(np.column_stack((own[[0, -1]], others[nearest]))[near])
    pairs = np.sort(np.concatenate(edges), axis=1)
    pairs = np.unique(pairs[pairs[:, 0] != pairs[:, 1]], axis=0)
    return stations, Network(len(stations), pairs)
