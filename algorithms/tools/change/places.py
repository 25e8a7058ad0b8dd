"""The places where the ground changed by more than its errors let expect."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Iterator, NamedTuple

import numpy as np

from ...core.parameters import ParameterSet, parameter
from ...core.progress import Progress
from ...grids.gradient import steepness
from ...grids.isolines import rings_of
from ...report.units import Units
from .pair import SEEN, Pair
from .stable import LIMIT, Alignment, Scatter

# Cells round a place that belong to it too, if they changed in the same direction by this share of
# their limits: so its volume is not cut off at the limit.
_RIM = 3
_PART = 0.3
# Standard errors by which the mean of a place must differ from none, as some of many thousand areas
# differ by chance: if half of its cells have ground points of both dates near them, where nobody
# knows, and where more is unforeseen: across gaps, and without expected errors.
_SEEN, _UNKNOWN, _UNFORESEEN = 3.8, 4.0, 6.0
# The edge of a place can lie anywhere between ground points: by this share of their distance.
_OFF = 0.5
_NEIGHBOURS = ((0, 1), (1, -1), (1, 0), (1, 1))


@dataclass(frozen=True)
class Places(ParameterSet):
    """Which places are told."""

    least_area: float = parameter(
        4.0,
        label="Least area",
        unit="m2",
        minimum=0.0,
        maximum=100_000.0,
        help="Smaller places are left out.",
    )


class ChangePlace(NamedTuple):
    """A connected place that rose or sank; arrays (n,) of its cells."""

    rows: np.ndarray
    columns: np.ndarray
    old: np.ndarray  # heights in metres
    change: np.ndarray  # metres
    limit: np.ndarray  # metres
    is_over: np.ndarray  # bool, which cells exceed their limit
    cell: float  # side of a cell in metres
    volume_error: float  # cubic metres, 95 %
    kind: str = ""  # what it probably is

    @property
    def area(self) -> float:
        """Square metres."""
        return len(self.rows) * self.cell**2

    @property
    def volume(self) -> float:
        """Cubic metres, negative where the ground sank."""
        return float(np.sum(self.change, dtype=np.float64)) * self.cell**2

    @property
    def mean(self) -> float:
        """The mean change in metres."""
        return float(np.mean(self.change, dtype=np.float64))

    @property
    def largest(self) -> float:
        """The largest change in metres."""
        return float(self.change[np.argmax(np.abs(self.change))])

    def in_units(self, units: Units) -> tuple[float, float, float, float, float, float]:
        """Return area, volume and its error, mean and largest change and mean limit in the units of
        a survey.
        """
        area, up = units.horizontal**2, units.vertical
        return (
            self.area / area, self.volume / (area * up), self.volume_error / (area * up),
            self.mean / up, self.largest / up, float(np.mean(self.limit)) / up,
        )  # fmt: skip

    @property
    def window(self) -> tuple[slice, slice]:
        """The rows and columns in which it lies."""
        rows, columns = self.rows, self.columns
        return (
            slice(int(rows.min()), int(rows.max()) + 1),
            slice(int(columns.min()), int(columns.max()) + 1),
        )

    @property
    def mask(self) -> np.ndarray:
        """Which cells of the window belong to it, bool (rows, columns)."""
        window = self.window
        cells = np.zeros([part.stop - part.start for part in window], dtype=bool)
        cells[self.rows - window[0].start, self.columns - window[1].start] = True
        return cells

    @property
    def rings(self) -> list[np.ndarray]:
        """The outline and those of the holes, row and column, (n, 2)."""
        return [ring + [part.start for part in self.window] for ring in rings_of(self.mask)]


def limits_of(
    scatter: Scatter, alignment: Alignment, spread: np.ndarray, slope: np.ndarray
) -> np.ndarray:
    """Return the detection limits of cells in metres, with the error of the alignment."""
    return np.hypot(scatter.limit(spread, slope), alignment.limit).astype(np.float32)


def places_of(
    pair: Pair, alignment: Alignment, scatter: Scatter, how: Places, progress: Progress
) -> list[ChangePlace]:
    """Return the places of significant change, those with the largest volume first."""
    places = []
    cells = list(_cells_over(pair, alignment, scatter, how, progress))
    for sign in (1, -1):
        some = [found for of_sign, found in cells if of_sign == sign]
        if some:
            places += _joined(pair, scatter, alignment, *map(np.concatenate, zip(*some)))
    places = [place for place in places if place.area >= how.least_area]
    return sorted(places, key=lambda place: (-float(f"{abs(place.volume):.6g}"), place.rows[0]))


def _cells_over(
    pair: Pair, alignment: Alignment, scatter: Scatter, how: Places, progress: Progress
) -> Iterator[tuple[int, list[np.ndarray]]]:
    """Yield sign, places in the raster, old height, change, limit, whether it is exceeded, distance
    to ground points, and the error of the change by it, of cells over their limits and those round
    them, strip by strip.
    """
    from scipy import ndimage

    square = np.ones((3, 3), dtype=bool)
    least = max(how.least_area / pair.cell**2, 1.0)
    for strip in pair.strips(progress):
        slope = strip.steepness(pair.cell)
        change = alignment.of_strip(pair, strip)
        limit = limits_of(scatter, alignment, strip.spread, slope)
        ratio = np.nan_to_num(change / limit)
        off = _OFF * (np.nan_to_num(strip.distance) + pair.cell / 2.0)
        off *= np.nan_to_num(steepness(change, pair.cell))
        for sign in (1, -1):
            labels, _ = ndimage.label(sign * ratio > 1.0, square)
            sizes = np.bincount(labels.ravel())
            sizes[0] = 0
            over = (sizes >= least)[labels]
            grown = ndimage.binary_dilation(over, square, _RIM, mask=sign * ratio > _PART)
            grown[: strip.own.start] = grown[strip.own.stop :] = False
            row, column = np.nonzero(grown)
            place = (row + strip.row).astype(np.int64) * pair.grid.whole[1] + column
            columns = strip.old, change, limit, over, strip.distance, off
            yield sign, [place, *(values[grown] for values in columns)]


def _joined(
    pair: Pair,
    scatter: Scatter,
    alignment: Alignment,
    cells: np.ndarray,
    *values: np.ndarray,
) -> list[ChangePlace]:
    """Return the connected cells as places, those that are significant as a whole."""
    places = []
    for some in connected(cells, pair.grid.whole[1]):
        rows, columns = np.divmod(cells[some], pair.grid.whole[1])
        old, change, limit, is_over, distance, off = (value[some] for value in values)
        place = ChangePlace(rows, columns, old, change, limit, is_over, pair.cell, 0.0)
        core = float(np.count_nonzero(place.is_over)) * pair.cell**2
        share = scatter.share_of_mean(np.array([core, place.area]))
        mean = float(np.mean((np.abs(place.change) / place.limit)[place.is_over])) * LIMIT
        if mean < _certain(scatter, distance[is_over]) * share[0]:
            continue
        by_chance, at_edges = (
            float(np.sum(errors, dtype=np.float64)) * pair.cell**2 for errors in (limit, off)
        )
        errors = by_chance * share[1], at_edges, alignment.limit * place.area
        places.append(place._replace(volume_error=math.hypot(*errors)))
    return places


def _certain(scatter: Scatter, distance: np.ndarray) -> float:
    """Return by how many standard errors a place must differ, given the distances of its cells."""
    middle = float(np.quantile(distance, 0.5))
    if middle > SEEN or not scatter.by_error:
        return _UNFORESEEN
    return _UNKNOWN if math.isnan(middle) else _SEEN


def connected(cells: np.ndarray, columns: int) -> list[np.ndarray]:
    """Return the indices of each connected group of cells, given their places in the raster,
    ascending.
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    if not len(cells):
        return []
    column, pairs = cells % columns, []
    for down, right in _NEIGHBOURS:
        there = (column + right >= 0) & (column + right < columns)
        wanted = cells + down * columns + right
        found = np.minimum(np.searchsorted(cells, wanted), len(cells) - 1)
        is_one = there & (cells[found] == wanted)
        pairs.append((np.flatnonzero(is_one), found[is_one]))
    first, second = map(np.concatenate, zip(*pairs))
    shape = len(cells), len(cells)
    graph = coo_matrix((np.ones(len(first), dtype=bool), (first, second)), shape)
    labels = connected_components(graph, directed=False)[1]
    order = np.argsort(labels, kind="stable")
    return np.split(order, np.flatnonzero(np.diff(labels[order])) + 1)
