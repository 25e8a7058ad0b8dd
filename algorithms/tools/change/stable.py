"""What stable land tells of two terrains: how they lie apart, and how much they differ by chance.

Vertical shift and tilt are a plane through the differences, fitted robustly. The horizontal shift
follows from how differences depend on slope and aspect: Nuth, C., and Kääb, A. (2011), The
Cryosphere 5, 271-290, doi:10.5194/tc-5-271-2011. How differences of single cells scatter is found
for each size of the expected error, or each slope, by the NMAD: Höhle, J., and Höhle, M. (2009),
ISPRS Journal 64, 398-406, doi:10.1016/j.isprsjprs.2009.02.003, and Hugonnet, R., et al. (2022),
IEEE JSTARS 15, 6456-6472, doi:10.1109/JSTARS.2022.3188922. How far they are correlated is told by
their variogram, from which follows the error of a mean over an area: Rolstad, C., Haug, T., and
Denby, B. (2009), Journal of Glaciology 55, 666-680, doi:10.3189/002214309789470950.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ...core.errors import BareEarthError
from ...core.progress import Progress
from .pair import CellStrip, Pair, refuse_other_units

_MOST = 1_000_000  # cells that are drawn
_LEAST = 100  # cells that are enough
LEAST_SHARE = 1 / 3  # of the common cells that must be stable
_STEEP = 0.36  # rise over run up to which land is level enough for an alignment
_ROUNDS = 12
_TUKEY = 4.685  # of his biweight: larger residuals, in standard deviations, do not count
_NORMAL = 1.4826  # the standard deviation of normal errors in median absolute deviations
_OF_A_THIRD = 2.32  # the same in what a third of the absolute errors do not exceed
LIMIT = 1.96  # standard deviations of a limit that 95 of 100 normal errors do not exceed
# Errors have long tails: 95 of 100 lie within up to so many times what the NMAD lets expect, where
# expected errors tell where they are larger, and where only slopes do.
_TAILS, _TAILS_OF_SLOPES = 1.5, 3.0
_FINEST = 0.05  # metres: the least limit that follows from slopes
# Blocks along a side, whose mean residuals tell how certain the plane is.
_BLOCKS = 8
_CERTAIN = 3.0  # standard errors from which a tilt is taken off
_CLASSES = 12  # of the spread, or of the slope, each with its own scatter
# The least and largest factor by which stable land changes what the expected errors let expect.
_FACTORS = 0.85, 4.0
_FARTHEST = 10.0  # metres: two dates that lie farther apart have other heights
_LAGS = 2.0 ** np.arange(10)  # distances in cells at which the correlation is found
_WINDOW = 1024  # cells along a side of the windows in which it is found
_WINDOWS = 4  # along a side of the raster, at most
_LEVEL = 0.05  # rise over run from which slopes tell of a horizontal shift


class Sample(NamedTuple):
    """Cells that were drawn of the common ones; all (n,), metres, slopes as rise over run."""

    common: int  # number of all common cells
    east: np.ndarray  # from the middle of the grid
    north: np.ndarray
    change: np.ndarray  # new minus old
    slopes: np.ndarray  # (n, 2), of the old terrain towards east and north
    spread: np.ndarray  # by the expected errors; NaN without them
    is_seen: np.ndarray  # whether ground points of both dates lie near

    @property
    def slope(self) -> np.ndarray:
        """How steep the cells are."""
        return np.hypot(*self.slopes.T)


@dataclass(frozen=True)
class Alignment:
    """How the new terrain lies above the old one on stable land."""

    shift: float = 0.0  # metres, in the middle of the grid
    tilt: tuple[float, float] = (0.0, 0.0)  # metres a metre, towards east and north
    error: float = 0.0  # standard error of the plane in metres, the mean over the area
    stable: float = 1.0  # share of the common cells that are stable
    # Horizontal shift of the new terrain in metres and its standard error; NaN on level land.
    east: float = math.nan
    north: float = math.nan
    horizontal_error: float = math.nan
    is_moved: bool = False  # whether the horizontal shift was taken off

    @property
    def limit(self) -> float:
        """What the error of the plane does not exceed in 95 of 100 cases, in metres."""
        return LIMIT * self.error

    @property
    def text(self) -> str:
        """What was taken off, in words."""
        if not self.shift and not any(self.tilt):
            return "nothing"
        steep = 1e3 * math.hypot(*self.tilt)
        tilted = f" and a tilt of {steep:.3f} m a kilometre" if steep else ""
        return f"a vertical shift of {self.shift:+.3f} ± {self.limit:.3f} m{tilted}"

    @property
    def moved(self) -> str:
        """The horizontal shift, in words."""
        if math.isnan(self.east):
            return "The land is too level to tell a horizontal shift."
        return (
            f"The new terrain lies {self.east:+.2f} m east and {self.north:+.2f} m north of the old"
            f" one (± {2 * self.horizontal_error:.2f} m); this was"
            f" {'' if self.is_moved else 'not '}taken off."
        )

    def at(self, east: np.ndarray, north: np.ndarray) -> np.ndarray:
        """Return what is taken off the change at places."""
        return self.shift + self.tilt[0] * east + self.tilt[1] * north

    def of_strip(self, pair: Pair, strip: CellStrip) -> np.ndarray:
        """Return the change of a strip without shift and tilt, float32."""
        rows, columns = (np.arange(count) for count in strip.old.shape)
        east, north = pair.places(rows[:, None] + strip.row, columns + strip.column)
        return (strip.change - self.at(east, north)).astype(np.float32)


@dataclass(frozen=True)
class Scatter:
    """How much two terrains differ by chance, in single cells and in means over areas."""

    knots: np.ndarray  # spreads by the expected errors in metres, or slopes
    values: np.ndarray  # factors of these spreads, or limits in metres, at the knots
    by_error: bool  # whether it follows from expected errors
    lags: np.ndarray  # distances in metres
    correlation: np.ndarray  # of the differences of two cells, at these distances
    nmad: float  # of all stable cells, metres

    def limit(self, spread: np.ndarray, slope: np.ndarray) -> np.ndarray:
        """Return what 95 of 100 differences of cells without change do not exceed, in metres."""
        if self.by_error:
            return spread * np.interp(spread, self.knots, self.values)
        return np.where(np.isfinite(slope), np.interp(slope, self.knots, self.values), np.nan)

    def share_of_mean(self, area: np.ndarray) -> np.ndarray:
        """Return the standard error of the mean of areas in square metres, as a share of that of a
        cell (Rolstad et al. 2009, equation 8).
        """
        radius = np.sqrt(np.maximum(area, 0.0) / np.pi)
        r = np.geomspace(self.lags[0] / 8.0, max(self.lags[-1], float(np.max(radius))), 400)
        rho = np.interp(r, self.lags, self.correlation)
        middle = np.diff(r, prepend=0.0) * 2.0 * np.pi * r * rho
        inside = np.interp(radius, r, np.cumsum(middle))
        # No mean is more certain than that of independent cells.
        least = (self.lags[0] ** 2 / np.maximum(area, self.lags[0] ** 2)) ** 0.5
        return np.clip(np.sqrt(inside / np.maximum(area, 1e-9)), least, 1.0)

    @property
    def reach(self) -> float:
        """The distance in metres from which errors are hardly correlated."""
        low = np.flatnonzero(self.correlation < 0.1)
        return float(self.lags[low[0]] if len(low) else self.lags[-1])


def sample_of(pair: Pair, names: tuple[str, str], progress: Progress) -> Sample:
    """Draw cells that have a value in both terrains; refuse terrains without any."""
    found, heights, common = [], [], 0
    step = max(round((np.prod(pair.grid.whole) / _MOST) ** 0.5), 1)
    for strip in pair.strips(progress):
        known = np.isfinite(strip.change) & (np.isfinite(strip.spread) | (pair.errors is None))
        known[: strip.own.start] = known[strip.own.stop :] = False
        common += int(np.count_nonzero(known))
        slopes = np.stack(strip.slopes(pair.cell), axis=-1)
        known &= np.isfinite(slopes).all(axis=-1)
        row, column = np.nonzero(known)
        drawn = ((row + strip.row) % step == 0) & (column % step == 0)
        row, column = row[drawn], column[drawn]
        values = (of[row, column] for of in (strip.change, slopes, strip.spread, strip.is_seen))
        found.append((*pair.places(row + strip.row, column), *values))
        heights.append((strip.old[row, column], strip.new[row, column]))
    if not common:
        raise BareEarthError(
            f"No cell has a value in both {names[0]} and {names[1]}. Give two surveys of the same"
            " place, neither of which is empty."
        )
    sample = Sample(common, *map(np.concatenate, zip(*found)))
    if len(sample.change) < _LEAST:
        raise BareEarthError(
            f"{names[0]} and {names[1]} have only {common:,} cells in common: too few to tell a"
            " change from an error."
        )
    old, new = map(np.concatenate, zip(*heights))
    refuse_other_units(old, new, names)
    return sample


def aligned(sample: Sample, kind: str, names: tuple[str, str]) -> Alignment:
    """Return how the new terrain lies above the old one on stable land: nothing of it (`kind` is
    "none"), its vertical shift, or shift and tilt; refuse too little stable land.
    """
    common, *columns = sample
    level = sample.slope <= _STEEP
    if np.count_nonzero(level) < max(len(level) * LEAST_SHARE, _LEAST):
        level[:] = True
    some = Sample(common, *(column[level] for column in columns))
    shift, tilt, weights = _plane(some, kind == "tilt")
    error, errors = _certainty(some, shift, tilt, weights)
    if kind == "tilt" and (np.abs(tilt) < _CERTAIN * errors).all():
        shift, tilt, weights = _plane(some, False)
        error, _ = _certainty(some, shift, tilt, weights)
    found = Alignment(shift, (float(tilt[0]), float(tilt[1])), error)
    residual = sample.change - found.at(sample.east, sample.north)
    stable = _are_stable(residual, sample.spread)
    found = replace(found, stable=float(np.mean(stable)))
    _check(found, names, kind != "none")
    east_off, north_off, off = _horizontal(sample, residual, stable)
    found = replace(found, east=east_off, north=north_off, horizontal_error=off)
    return found if kind != "none" else replace(found, shift=0.0, tilt=(0.0, 0.0))


def _check(found: Alignment, names: tuple[str, str], is_used: bool) -> None:
    """Refuse terrains that are not comparable."""
    if abs(found.shift) > _FARTHEST:
        raise BareEarthError(
            f"{names[1]} lies {found.shift:+,.1f} m above {names[0]} where both are alike: their"
            " heights are not above the same datum, or not in the same unit. State or transform"
            " them."
        )
    if is_used and found.stable < LEAST_SHARE:
        raise BareEarthError(
            f"Only {found.stable:.0%} of the common area is stable, and a third of it is needed to"
            " align both dates. Compare a larger area, or leave out the alignment."
        )


def _plane(some: Sample, is_tilted: bool) -> tuple[float, np.ndarray, np.ndarray]:
    """Return shift, tilt and the weights of cells: a plane by Tukey's biweight, from where most
    differences are.
    """
    change = some.change.astype(np.float64)
    spread = np.where(np.isfinite(some.spread), some.spread, 1.0)
    certain = 1.0 / np.maximum(spread, 0.05) ** 2
    shift, tilt = _densest(change), np.zeros(2)
    places = np.column_stack((np.ones(len(change)), some.east, some.north))
    scale = max(float(np.ptp(places[:, 1:])), 1.0)
    places[:, 1:] /= scale
    weights = certain
    for _ in range(_ROUNDS):
        residual = change - places @ np.array((shift, *(tilt * scale)))
        width = _TUKEY * max(_usual(residual), 0.01)
        weights = certain * np.maximum(1.0 - (residual / width) ** 2, 0.0) ** 2
        if is_tilted:
            left = places * weights[:, None]
            solved = np.linalg.lstsq(left.T @ places, left.T @ change, rcond=1e-9)[0]
            shift, tilt = float(solved[0]), solved[1:] / scale
        else:
            shift = float(np.average(change, weights=weights))
    return shift, tilt, weights


def _densest(change: np.ndarray) -> float:
    """Return the middle of the shortest interval that holds a third of values."""
    ordered = np.sort(change)
    count = max(int(len(ordered) * LEAST_SHARE), 1)
    widths = ordered[count:] - ordered[: len(ordered) - count]
    first = int(np.argmin(widths))
    return float(np.median(ordered[first : first + count]))


def _certainty(
    some: Sample, shift: float, tilt: np.ndarray, weights: np.ndarray
) -> tuple[float, np.ndarray]:
    """Return the standard errors of a plane, in the mean over the area and of the tilts, from the
    mean residuals of large blocks, which are nearly independent.
    """
    residual = some.change - shift - np.column_stack((some.east, some.north)) @ tilt
    columns = []
    for along in (some.east, some.north):
        low, wide = along.min(), max(float(np.ptp(along)), 1e-6)
        columns.append(np.minimum((along - low) / wide * _BLOCKS, _BLOCKS - 1).astype(np.intp))
    block = columns[0] * _BLOCKS + columns[1]
    total = np.bincount(block, weights, _BLOCKS**2)
    used = total > total.max() / 20.0
    means, east, north = (
        np.bincount(block, weights * values, _BLOCKS**2)[used] / total[used]
        for values in (residual, some.east, some.north)
    )
    scatter = max(_NORMAL * float(np.median(np.abs(means - np.median(means)))), 1e-4)
    design = np.column_stack((np.ones(len(means)), east, north))
    covariance = scatter**2 * np.linalg.pinv(design.T @ design)
    over_area = np.sqrt(np.mean(np.einsum("ij,jk,ik->i", design, covariance, design)))
    return float(over_area), np.sqrt(np.diag(covariance)[1:])


def _usual(residual: np.ndarray) -> float:
    """Return the standard deviation of residuals of which up to two thirds may be changes."""
    return _OF_A_THIRD * float(np.quantile(np.abs(residual), LEAST_SHARE))


def _are_stable(residual: np.ndarray, spread: np.ndarray) -> np.ndarray:
    """Return which cells differ no more than is expected, or than most do."""
    usual = _usual(residual)
    most = np.full(len(residual), LIMIT * 1.5 * usual)
    known = np.isfinite(spread)
    most[known] = np.clip(LIMIT * usual, spread[known], _FACTORS[1] * spread[known])
    return np.abs(residual) <= most


def _horizontal(sample: Sample, residual: np.ndarray, stable: np.ndarray) -> tuple[float, ...]:
    """Return the horizontal shift of the new terrain and its error, by least squares on slopes of
    stable land; NaN where that is level.
    """
    some = stable & (sample.slope > _LEVEL)
    if np.count_nonzero(some) < _LEAST:
        return (math.nan,) * 3
    slopes, change = sample.slopes[some].astype(np.float64), residual[some].astype(np.float64)
    normal = slopes.T @ slopes
    # A terrain that is moved towards a rising slope is lower there.
    east, north = -np.linalg.solve(normal, slopes.T @ change)
    rest = change + slopes @ (east, north)
    # Neighbours are correlated: of the cells, about one in a hundred tells something of its own.
    error = float(np.std(rest) * np.sqrt(np.trace(np.linalg.inv(normal)) / 2.0) * 10.0)
    return float(east), float(north), error


def scatter_of(pair: Pair, sample: Sample, alignment: Alignment, progress: Progress) -> Scatter:
    """Return how much cells of stable land differ by chance."""
    residual = np.abs(sample.change - alignment.at(sample.east, sample.north)).astype(np.float64)
    by_error = pair.errors is not None
    of_what = (sample.spread if by_error else sample.slope).astype(np.float64)
    edges = np.unique(np.quantile(of_what, np.linspace(0.0, 1.0, _CLASSES + 1)))
    numbers = np.clip(np.searchsorted(edges, of_what, side="right") - 1, 0, max(len(edges) - 2, 0))
    tails = _TAILS if by_error else _TAILS_OF_SLOPES
    knots, values = [], []
    for number in range(max(len(edges) - 1, 1)):
        inside = numbers == number
        if np.count_nonzero(inside) < _LEAST // 4:
            continue
        usual = LIMIT * _NORMAL * float(np.median(residual[inside]))
        value = float(np.clip(np.quantile(residual[inside], 0.95), usual, tails * usual))
        middle = float(np.median(of_what[inside]))
        knots.append(middle)
        values.append(np.clip(value / middle, *_FACTORS) if by_error else max(value, _FINEST))
    scatter = Scatter(
        np.array(knots), np.array(values), by_error, _LAGS * pair.cell, np.ones(len(_LAGS)),
        _NORMAL * float(np.median(residual)),
    )  # fmt: skip
    if not by_error:
        scatter = replace(scatter, values=np.maximum.accumulate(scatter.values))
    return replace(scatter, correlation=_correlation(pair, alignment, scatter, progress))


def _correlation(
    pair: Pair, alignment: Alignment, scatter: Scatter, progress: Progress
) -> np.ndarray:
    """Return the correlation of the differences of stable cells at the lags, by their variogram."""
    rows, columns = pair.grid.whole
    squares, counts = np.zeros((2, len(_LAGS)))
    total, count = 0.0, 0
    corners = [
        np.unique(np.linspace(0, max(side - _WINDOW, 0), min(-(-side // _WINDOW), _WINDOWS)))
        for side in (rows, columns)
    ]
    for number, row in enumerate(corners[0].astype(int)):
        for column in corners[1].astype(int):
            window = slice(row, row + _WINDOW), slice(column, column + _WINDOW)
            strip = pair.strip(window)
            limit = scatter.limit(strip.spread, strip.steepness(pair.cell))
            ratio = alignment.of_strip(pair, strip).astype(np.float64) / limit
            ratio[~(np.abs(ratio) <= 1.5)] = np.nan
            total += float(np.nansum(ratio**2))
            count += int(np.count_nonzero(np.isfinite(ratio)))
            for place, lag in enumerate(_LAGS.astype(int)):
                for apart in (ratio[lag:] - ratio[:-lag], ratio[:, lag:] - ratio[:, :-lag]):
                    squares[place] += float(np.nansum(apart**2))
                    counts[place] += np.count_nonzero(np.isfinite(apart))
        progress((number + 1) / len(corners[0]))
    variance = max(total / max(count, 1), 1e-12)
    known = counts > _LEAST
    found = 1.0 - squares / np.maximum(2.0 * counts, 1.0) / variance
    found = np.where(known, found, 0.0)
    return np.clip(np.minimum.accumulate(found), 0.0, 1.0)
