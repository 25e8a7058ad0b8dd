"""What is wanted of the filters' speed, and whether a run of the benchmark shows it."""

from __future__ import annotations

import math
from typing import Iterator, NamedTuple

from bare_earth.algorithms.filters import METHODS

from .contestants import BESIDE_QGIS, OURS, OUT_OF_CORE, QGIS, SAME_RADIUS
from .process import STOPPED
from .results import Results, spread

# Times the floor, at most: on tiles of so many points and of such density.
TIMES_THE_FLOOR = {"grid-minimum": 1.4, "slope": 2.0, "tin-densification": 2.0}
LEAST_POINTS, DENSITIES = 3_000_000, (4.0, 20.0)
PEERS = {"cloth": "CSF", "morphological": "pysmrf"}
TIMES_FASTER, TIMES_FASTER_THAN_WHITEBOX = 5.0, 3.0
EXPONENT, LEAST_FOR_GROWTH = 1.05, 1_000_000
# Below this the interpreter and its libraries count more than the points.
LEAST_FOR_MEMORY = 1_000_000
BYTES_A_POINT, OUT_OF_CORE_BYTES = 120.0, 2e9
QGIS_SECONDS = 2.0

_NOTHING = math.nan, "-"
_AT_LEAST = ", at least"


class Goal(NamedTuple):
    """One line of the table: what is wanted, how much, what was reached (NaN: not measured)."""

    title: str
    limit: float
    reached: float
    where: str
    is_most: bool = True

    @property
    def is_met(self) -> bool:
        """Whether it is reached."""
        return self.reached <= self.limit if self.is_most else self.reached >= self.limit

    @property
    def verdict(self) -> str:
        """What to say of it."""
        if math.isnan(self.reached):
            return "not measured"
        if self.is_met:
            return "yes"
        # A lower bound that is too low says nothing.
        return "open" if self.where.endswith(_AT_LEAST) else "no"


def goals(results: Results) -> list[Goal]:
    """Return all goals with what the run reached, the worst where there are several tiles."""
    return [
        *_floor(results), *_peers(results), *_growth(results), *_memory(results), *_qgis(results)
    ]  # fmt: skip


def _floor(results: Results) -> Iterator[Goal]:
    tiles = [
        tile
        for tile in results.tiles
        if tile.count >= LEAST_POINTS and DENSITIES[0] <= tile.density <= DENSITIES[1]
    ]
    for name, limit in TIMES_THE_FLOOR.items():
        found = [
            (ratio.median, tile.name) for tile in tiles if (ratio := results.ratio(tile.name, name))
        ]
        title = f"{METHODS[name].label}: time, as a multiple of reading and writing"
        yield Goal(title, limit, *max(found, default=_NOTHING))


def _peers(results: Results) -> Iterator[Goal]:
    for peer, label in PEERS.items():
        found = [one for name in OURS for one in _faster(results, name, peer)]
        title = f"{label}: its time, as a multiple of that of the slowest of ours"
        yield Goal(title, TIMES_FASTER, *min(found, default=_NOTHING), False)
    for ours, peer in SAME_RADIUS:
        found = min(_faster(results, ours, peer), default=_NOTHING)
        radius = "2 m" if peer == "whitebox" else "18 m"
        title = f"Whitebox, {radius}: its time, as a multiple of that of our slope filter"
        yield Goal(title, TIMES_FASTER_THAN_WHITEBOX, *found, False)


def _faster(results: Results, ours: str, peer: str) -> list[tuple[float, str]]:
    """Return how many times longer a peer takes, on the largest tile that it finished.

    One that finished none took at least as long as it was let run, on the smallest.
    """
    tile = results.largest(ours, peer)
    if tile:
        ratio = results.ratio(tile.name, peer, to=ours)
        return [(ratio.median, tile.name)] if ratio else []
    for run in results.runs:
        cost = results.costs(run.tile, ours).get(run.round)
        if run.contestant == peer and run.cost.problem.startswith(STOPPED) and cost:
            return [(run.cost.wall / cost.wall, f"{run.tile}{_AT_LEAST}")]
    return []


def _growth(results: Results) -> Iterator[Goal]:
    for name in OURS:
        # What a process takes to start hides the growth of small tiles.
        tiles = [
            tile
            for tile in results.tiles
            if tile.is_generated
            and tile.count >= LEAST_FOR_GROWTH
            and results.costs(tile.name, name)
        ]
        found = _NOTHING
        if tiles and tiles[-1].count >= 10 * tiles[0].count:
            where = f"{tiles[0].name} to {tiles[-1].name}"
            exponent = results.exponent(name, least=LEAST_FOR_GROWTH)
            found = found if exponent is None else (exponent, where)
        yield Goal(f"{METHODS[name].label}: exponent of time against points", EXPONENT, *found)


def _memory(results: Results) -> Iterator[Goal]:
    for name in OURS:
        tile = results.largest(name)
        found = _NOTHING
        if tile and tile.count >= LEAST_FOR_MEMORY:
            peak = results.spread(tile.name, name, "memory")
            found = (peak.most / tile.count, tile.name) if peak else found
        title = f"{METHODS[name].label}: peak memory, bytes a point"
        yield Goal(title, BYTES_A_POINT, *found)
    peaks = [
        (peak.most / 1e9, tile.name)
        for tile in results.tiles
        if (peak := results.spread(tile.name, OUT_OF_CORE, "memory"))
    ]
    title = "Out of core: peak memory, GB"
    yield Goal(title, OUT_OF_CORE_BYTES / 1e9, *max(peaks, default=_NOTHING))


def _qgis(results: Results) -> Iterator[Goal]:
    added = []
    for tile in results.tiles:
        inside, beside = results.costs(tile.name, QGIS), results.costs(tile.name, BESIDE_QGIS)
        common = inside.keys() & beside.keys()
        more = spread([inside[number].wall - beside[number].wall for number in common])
        if more:
            added.append((more.median, tile.name))
    title = "QGIS: seconds more than the command takes with the same Python"
    yield Goal(title, QGIS_SECONDS, *max(added, default=_NOTHING))
