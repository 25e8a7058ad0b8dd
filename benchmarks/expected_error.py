"""Fits and measures the expected error: how often errors lie within what is expected.

The real tiles and the ISPRS samples are labelled by all three filters; the error of a cell is that
of the TIN of these labels from the TIN of the reference's ground. Figures are of tables that were
fitted to one half of the tiles and measured on the other half; the table that ships is fitted to
all of them.
"""

from __future__ import annotations

import argparse
import functools
import zlib
from pathlib import Path
from typing import Callable, Iterator, NamedTuple, Sequence

import numpy as np
from scipy.optimize import minimize
from scipy.special import expit

from bare_earth.algorithms.classes.point_counts import PointCounts
from bare_earth.algorithms.classes.selection import Selection
from bare_earth.algorithms.core.errors import BareEarthError
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.grids.cells import Cells
from bare_earth.algorithms.grids.expected_error import (
    CELL,
    FACTORS,
    LEAST,
    RMSE_SHARE,
    Evidence,
    Table,
    error_of,
    evidence,
    expected_error,
)
from bare_earth.algorithms.las.cloud import PointCloud
from bare_earth.algorithms.report.units import Units
from bare_earth.algorithms.tin.dense_surface import DenseSurface
from bare_earth.algorithms.tin.surface import Surface
from bare_earth.algorithms.tools.review.places import Rasters, Review, places_of

from . import data, marked
from .clouds import classify_cloud
from .ensemble import further_members, spread_of
from .measure import GROUND, Filter
from .phases import shifted
from .work import side_by_side

# Cells that are drawn of each tile.
_CELLS = 2500
# Places of which it is told how much of the error they hold.
_FIRST = 10
# The values of evidence at which factors are fitted.
KNOTS = Evidence(
    holes=(0.0, 0.25, 0.5, 0.75, 1.0),
    roughness=(0.01, 0.02, 0.04, 0.08, 0.16, 0.32, 0.64),
    slope=(0.0, 0.1, 0.3, 0.7, 1.5),
    gap=(0.0, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0),
    gap_at_step=(0.0, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0),
    doubtful=(0.0, 0.02, 0.05, 0.1, 0.2),
    low_plants=(0.0, 0.02, 0.05, 0.1, 0.2),
)
# What is added to errors before their logarithm is taken, in metres: less is noise.
_NOISE = 0.01
# Width of the bend of the quantile's loss, in logarithms.
_BEND = 0.1
# The logarithm by which a factor grows from knot to knot where nothing speaks for another one, and
# how much that weighs: some thirty tiles are few for as many numbers. Both were chosen by the AUC
# on tiles that were not fitted.
_PRIOR, _RIDGE = 0.15, 0.05
# The spreads of an ensemble in metres at which factors are fitted.
SPREADS = (0.0, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0)
PAGE = Path(__file__).parent / "results" / "expected_error.md"
_HELD_HEAD = (
    "| Tile | of the squared error, % | of the cells, % | places in all |",
    "|---|--:|--:|--:|",
)
LIMIT = 0.3  # metres from which an error is large
BEYOND = 0.05  # share of the errors that are larger than the expected one
_SHAPE = 0.4  # exponent of the Weibull distribution of the errors of a cell


class Seen(NamedTuple):
    """What one filter made of a tile, at cells drawn of it; arrays of shape (n,)."""

    tile: str
    method: str
    pieces: Evidence
    error: np.ndarray  # metres, positive
    slope: np.ndarray  # rise over run of the true terrain
    density: np.ndarray  # points in a square metre, in the tile
    # standard deviation of the terrains of an ensemble, in metres; None for one filter
    spread: np.ndarray | None = None


Terrain = Callable[[np.ndarray, np.ndarray], np.ndarray]  # heights at some x and y; NaN for none


class Tile(NamedTuple):
    """A tile, and the terrain of its reference."""

    cloud: PointCloud
    takes_part: np.ndarray  # bool, (n,): which points the filters see
    points: Points  # these points
    terrain: Terrain

    @classmethod
    def of(cls, path: Path) -> Tile:
        """Read a tile."""
        cloud, reference = data.load(path)
        points = cloud.points(np.ones(cloud.count, dtype=bool))
        takes_part = Selection().choose(cloud, PointCounts())
        terrain = tin(points.take(reference == GROUND))
        return cls(cloud, takes_part, points.take(takes_part), terrain)

    def ground(self, method: str) -> np.ndarray:
        """Return which of the points a filter takes for ground."""
        return Filter(method).ground(self.cloud)[self.takes_part]

    def further_grounds(self, method: str) -> Iterator[np.ndarray]:
        """Yield the same for the other members of an ensemble."""
        for one in further_members(Filter(method).parameters):
            cloud = shifted(self.cloud, *one.shift)
            try:
                yield (classify_cloud(cloud, one.parameters)[0] == GROUND)[self.takes_part]
            except BareEarthError:
                yield np.zeros(self.points.count, dtype=bool)


def all_cells(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Return the expected error of each cell of a tile by TIN densification, and the error as it
    is, NaN where it is not known; metres, shape (rows, columns).
    """
    tile = Tile.of(path)
    ground = tile.ground("tin-densification")
    cells, expected = expected_error(tile.points, ground)
    y, x = (
        (first + np.arange(count) + 0.5) * CELL for first, count in zip(cells.first, cells.shape)
    )
    centres = [axis.ravel() for axis in np.meshgrid(x, y)]
    error = np.abs(tin(tile.points.take(ground))(*centres) - tile.terrain(*centres))
    return expected, error.reshape(cells.shape)


def tiles() -> list[Path]:
    """Return the real tiles and the samples that are here."""
    found = [data.real(tile.name) for tile in data.REAL]
    return [path for path in found if path.exists()] + data.isprs()


def look(path: Path, several: bool = False) -> list[Seen]:
    """Run each filter on a tile, and compare its terrain with that of the reference; `several`:
    with the spread of an ensemble.
    """
    tile, results = Tile.of(path), []
    for method in METHODS:
        try:
            ground = tile.ground(method)
        except BareEarthError:  # no ground, no terrain
            continue
        grounds = [ground, *tile.further_grounds(method)] if several else []
        seen = compared(tile.points, ground, tile.terrain, path.stem, grounds)
        results.append(seen._replace(method=method))
    return results


def compared(
    points: Points,
    ground: np.ndarray,
    terrain: Terrain,
    tile: str = "",
    grounds: Sequence[np.ndarray] = (),
) -> Seen:
    """Compare the terrain of a ground mask with the true one, at cells drawn by the tile's name.

    Parameters
    ----------
    points : Points
        All that took part.
    ground : numpy.ndarray of bool, shape (n,)
        Which of them are taken for ground.
    terrain : callable
        Returns the true heights at some x and y; NaN where they are not known.
    tile : str
        Its name.
    grounds : sequence of numpy.ndarray of bool, shape (n,)
        The masks of an ensemble; the first is `ground`.
    """
    cells = Cells.over(points, CELL)
    random, count = np.random.default_rng(zlib.crc32(tile.encode())), cells.rows * cells.columns
    drawn = random.choice(count, min(_CELLS, count), replace=False)
    places = np.unravel_index(drawn, cells.shape)
    y, x = ((first + place + 0.5) * CELL for first, place in zip(cells.first, places))
    error = np.abs(tin(points.take(ground))(x, y) - terrain(x, y))
    half = CELL / 2.0
    rises = (
        terrain(x + half, y) - terrain(x - half, y),
        terrain(x, y + half) - terrain(x, y - half),
    )
    pieces = evidence(cells, points.z, ground, *map(np.arange, cells.shape))
    known = np.isfinite(error)
    every = tuple(map(np.arange, cells.shape))
    spread = spread_of(cells, points.z, grounds, *every)[places][known] if grounds else None
    return Seen(
        tile,
        "",
        Evidence(*(piece[places][known] for piece in pieces)),
        error[known],
        np.nan_to_num(np.hypot(*rises)[known]) / CELL,
        np.full(len(drawn), points.count / np.count_nonzero(cells.counts))[known],
        spread,
    )


def tin(ground: Points) -> Terrain:
    """Return the heights of the TIN of ground points."""
    return Surface(ground.take(DenseSurface(ground, CELL).vertices)).heights


class Held(NamedTuple):
    """How much of the squared error of a tile its first places to review hold."""

    tile: str
    share: float  # of the squared error
    area: float  # share of the cells
    places: int


def held(path: Path) -> Held:
    """Return what the first ten places of a tile hold, with the labels of TIN densification."""
    expected, error = all_cells(path)
    known = np.isfinite(error)
    expected = np.where(known, expected, np.nan)
    how, rasters = Review(), Rasters(expected, None, None, CELL)
    places, _ = places_of(rasters, how, how.limit(expected), Units())
    inside = np.zeros(known.shape, dtype=bool)
    for place in places[:_FIRST]:
        inside[place.window] |= place.cells
    share = (error[inside] ** 2).sum() / (error[known] ** 2).sum()
    area = np.count_nonzero(inside) / np.count_nonzero(known)
    return Held(path.stem, float(share), float(area), len(places))


class Fit(NamedTuple):
    """A table of factors, and the expected error where all of them are 1."""

    factors: Table
    least: float

    def of(self, seen: Seen) -> np.ndarray:
        """Return the expected error of each cell."""
        return error_of(seen.pieces, self.factors, self.least)


def fitted(seen: Sequence[Seen]) -> Fit:
    """Return the table that 95 % of the errors do not exceed, as a quantile regression of their
    logarithms with factors that only grow; every tile and method counts alike.
    """
    design = np.concatenate([_steps(one.pieces) for one in seen])
    best = _quantiles(design, *_wanted(seen))
    factors, first = {}, 1
    for name, knots in KNOTS._asdict().items():
        factors[name] = _factors(knots, best[first : first + len(knots) - 1])
        first += len(knots) - 1
    return Fit(factors, float(f"{np.exp(best[0]):.3g}"))


def _wanted(seen: Sequence[Seen]) -> tuple[np.ndarray, np.ndarray]:
    """Return the logarithms of all errors and their weights, of which every tile has the same."""
    errors = [one.error for one in seen]
    share = np.concatenate([np.full(len(error), 1.0 / len(error)) for error in errors])
    return np.log(np.concatenate(errors) + _NOISE), share / share.sum()


def _quantiles(design: np.ndarray, wanted: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Return a constant and weights of the columns of a design, at least 0, whose sum 95 % of the
    wanted values do not exceed; `share` is the weight of each value.
    """

    def loss(values: np.ndarray) -> tuple[float, np.ndarray]:
        rest = wanted - values[0] - design @ values[1:]
        bent = (1.0 - BEYOND) * rest + _BEND * np.logaddexp(0.0, -rest / _BEND)
        slope = share * (expit(-rest / _BEND) - (1.0 - BEYOND))
        ridge = _RIDGE * (values[1:] - _PRIOR)
        total = float(share @ bent + ridge @ (values[1:] - _PRIOR) / 2.0)
        return total, np.concatenate(([slope.sum()], design.T @ slope + ridge))

    start = np.full(design.shape[1] + 1, 0.1)
    start[0] = np.quantile(wanted, 0.5)
    limits = [(None, None)] + [(0.0, None)] * design.shape[1]
    return minimize(loss, start, jac=True, method="L-BFGS-B", bounds=limits).x


def _factors(
    knots: Sequence[float], logarithms: np.ndarray, first: float = 0.0
) -> tuple[tuple[float, float], ...]:
    """Return factors at knots, given the logarithms by which they grow, and that of the first."""
    rises = np.exp(first + np.cumsum(np.append(0.0, logarithms)))
    return tuple((at, float(f"{rise:.3g}")) for at, rise in zip(knots, rises))


def _steps(pieces: Evidence) -> np.ndarray:
    """Return how much of each step between knots the evidence of each cell has climbed, 0 to 1."""
    return np.column_stack([_climbed(*both) for both in zip(pieces, KNOTS)])


def _climbed(values: np.ndarray, knots: Sequence[float]) -> np.ndarray:
    """Return how much of each step between knots values have climbed; shape (n, steps)."""
    low, high = np.array(knots[:-1]), np.array(knots[1:])
    return np.clip((values[:, None] - low) / (high - low), 0.0, 1.0)


def spread_factors(
    seen: Sequence[Seen], expected: Sequence[np.ndarray]
) -> tuple[tuple[float, float], ...]:
    """Return the factors by which the expected error of one filter changes with the spread."""
    wanted, share = _wanted(seen)
    design = np.concatenate([_climbed(_spread(one), SPREADS) for one in seen])
    best = _quantiles(design, wanted - np.log(np.concatenate(expected)), share)
    return _factors(SPREADS, best[1:], float(best[0]))


def with_ensemble(seen: Sequence[Seen], expected: Sequence[np.ndarray]) -> list[np.ndarray]:
    """Return the errors that an ensemble expects, given those of one filter, by factors that were
    fitted to the other half of the tiles.
    """
    half, results = _halves(seen), []
    tables = [
        spread_factors(*zip(*((o, e) for o, e in zip(seen, expected) if half[o.tile] == other)))
        for other in (1, 0)
    ]
    for one, values in zip(seen, expected):
        knots, factors = np.array(tables[half[one.tile]]).T
        results.append(values * np.exp(np.interp(_spread(one), knots, np.log(factors))))
    return results


def _spread(seen: Seen) -> np.ndarray:
    """Return the spread of an ensemble, at most the largest that is fitted."""
    values = np.zeros(len(seen.error)) if seen.spread is None else seen.spread
    return np.minimum(values, SPREADS[-1])


def _halves(seen: Sequence[Seen]) -> dict[str, int]:
    """Return the half, 0 or 1, to which each tile belongs."""
    return {name: number % 2 for number, name in enumerate(sorted({one.tile for one in seen}))}


def share_over(limit: float, error: np.ndarray) -> np.ndarray:
    """Return the probability that the error of a cell exceeds a limit, given its expected error."""
    return BEYOND ** ((limit / error) ** _SHAPE)


class Score(NamedTuple):
    """How well the errors of a tile were expected."""

    inside: float  # share of the cells whose error is at most the expected one
    median: float  # of the expected error, in metres
    quantile: float  # the error that 95 % do not exceed, in metres
    auc: float  # how well it ranks cells with a large error, 0.5 is chance; NaN without such cells
    rmse: float  # of the errors, in relation to the root mean square of what is expected
    over: tuple[float, float]  # shares of cells with a large error: expected, and as they are


def score(error: np.ndarray, expected: np.ndarray) -> Score:
    """Return how well errors were expected."""
    large = error > LIMIT
    return Score(
        float(np.mean(error <= expected)),
        float(np.median(expected)),
        float(np.quantile(error, 1.0 - BEYOND)),
        auc(expected, large),
        float(np.sqrt(np.mean(error**2.0) / np.mean(expected**2.0))),
        (float(np.mean(share_over(LIMIT, expected))), float(np.mean(large))),
    )


def auc(values: np.ndarray, which: np.ndarray) -> float:
    """Return the probability that a cell of a mask has a larger value than one that is not."""
    some, others = np.count_nonzero(which), np.count_nonzero(~which)
    if not some or not others:
        return np.nan
    # Takes half a second to import, which each process of the tests would do.
    from scipy.stats import rankdata

    return float((rankdata(values)[which].sum() - some * (some + 1) / 2.0) / (some * others))


def crossed(seen: Sequence[Seen]) -> list[np.ndarray]:
    """Return the expected errors by tables that were fitted to the other half of the tiles."""
    half = _halves(seen)
    fits = [fitted([one for one in seen if half[one.tile] == other]) for other in (1, 0)]
    return [fits[half[one.tile]].of(one) for one in seen]


def table(seen: Sequence[Seen], expected: Sequence[np.ndarray]) -> str:
    """Return the scores of tiles in Markdown, means over the methods."""
    lines = [
        "| Tile | inside, % | expected: median, m | 95 % of errors, m | AUC over 0.3 m |",
        "|---|--:|--:|--:|--:|",
    ]
    every = {}
    for name in dict.fromkeys(one.tile for one in seen):
        scores = [score(one.error, e) for one, e in zip(seen, expected) if one.tile == name]
        every[name] = mean = [float(np.nanmean(column)) for column in zip(*(s[:4] for s in scores))]
        lines.append(_row(name, mean))
    means = np.array(list(every.values()))
    lines.append(_row("**mean**", [float(np.nanmean(column)) for column in means.T]))
    good = np.count_nonzero((means[:, 0] >= 0.9) & (means[:, 0] <= 0.98))
    few, least = np.count_nonzero(means[:, 0] < 0.9), np.count_nonzero(means[:, 0] < 0.75)
    lines.append(f"\n{good} of {len(means)} tiles: 90 to 98 % inside; below 90: {few}, 75: {least}")
    return "\n".join(lines).replace("nan", "-")


def _row(name: str, values: Sequence[float]) -> str:
    inside, median, quantile, area = values
    return f"| {name} | {100 * inside:.1f} | {median:.2f} | {quantile:.2f} | {area:.2f} |"


def by_kind(seen: Sequence[Seen], expected: Sequence[np.ndarray]) -> str:
    """Return the share inside by slope, gap, holes, density and low plants, in Markdown."""
    error, known = (np.concatenate(some) for some in ([one.error for one in seen], expected))
    share = np.concatenate([np.full(len(one.error), 1.0 / len(one.error)) for one in seen])
    pieces = Evidence(*(np.concatenate(some) for some in zip(*(one.pieces for one in seen))))
    slope, density = (
        np.concatenate([getattr(one, name) for one in seen]) for name in ("slope", "density")
    )
    lines = ["| | inside, % | share of all cells, % |", "|---|--:|--:|"]
    for name, values, limits in (
        ("slope, rise over run", slope, (0, 0.1, 0.3, 0.7, np.inf)),
        ("cells without ground within 2 m", pieces.holes, (0, 0.01, 0.5, 0.9, np.inf)),
        ("gap, m", pieces.gap, (0, 0.5, 3, 10, np.inf)),
        ("points in 1 m2", density, (0, 2, 10, 50, np.inf)),
        ("low plants", pieces.low_plants, (0, 0.02, 0.1, np.inf)),
    ):
        for low, high in zip(limits, limits[1:]):
            here = (values >= low) & (values < high)
            if here.any():
                inside = 100 * np.average(error[here] <= known[here], weights=share[here])
                part = 100 * share[here].sum() / share.sum()
                until = f"to {high:g}" if np.isfinite(high) else "and more"
                lines.append(f"| {name}: {low:g} {until} | {inside:.1f} | {part:.1f} |")
    return "\n".join(lines)


def main() -> None:
    """Print the tables by halves; with ``--fit`` also the factors fitted to all tiles."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--fit", action="store_true", help="print the factors fitted to all tiles")
    parser.add_argument("--ensemble", action="store_true", help="with the spread of five runs")
    parser.add_argument("--places", action="store_true", help="only what places to review hold")
    parser.add_argument("--tiles", nargs="+", help="only these, by their names without ending")
    parser.add_argument("--write", action="store_true", help="write results/expected_error.md")
    chosen = parser.parse_args()
    places = [path for path in tiles() if not chosen.tiles or path.stem in chosen.tiles]
    if chosen.places:
        lines = list(_HELD_HEAD)
        for found in side_by_side(held, places):
            share, area = 100 * found.share, 100 * found.area
            lines.append(f"| {found.tile} | {share:.0f} | {area:.1f} | {found.places} |")
            print(lines[-1], flush=True)
        if chosen.write:
            marked.fill(PAGE, "places", lines)
        return
    results = side_by_side(functools.partial(look, several=chosen.ensemble), places)
    seen = [one for some in results for one in some]
    expected = crossed(seen)
    scores = [score(one.error, values) for one, values in zip(seen, expected)]
    blocks = {"tiles": table(seen, expected), "kinds": by_kind(seen, expected)}
    print(*blocks.values(), sep="\n\n")
    for name in blocks if chosen.write else ():
        marked.fill(PAGE, name, blocks[name].splitlines())
    print(f"\nRMSE in relation to what is expected: {_middle([s.rmse for s in scores])}")
    over = np.array([s.over for s in scores])
    print(f"share over {LIMIT} m, expected and as it is: {over.mean(axis=0).round(4)}")
    if chosen.ensemble:
        print(f"\nWith an ensemble of five runs:\n\n{table(seen, with_ensemble(seen, expected))}")
    if chosen.fit:
        print(fitted(seen))
        if chosen.ensemble:
            print(spread_factors(seen, [error_of(one.pieces) for one in seen]))
    else:
        shipped = [error_of(one.pieces, FACTORS, LEAST) for one in seen]
        print(f"\nThe table that ships (RMSE share {RMSE_SHARE}):\n\n{table(seen, shipped)}")


def _middle(values: Sequence[float]) -> str:
    low, middle, high = np.quantile(values, (0.1, 0.5, 0.9))
    return f"median {middle:.2f}, from {low:.2f} to {high:.2f} in eight of ten tiles"


if __name__ == "__main__":
    main()
