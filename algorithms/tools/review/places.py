"""The places of a terrain model that a person should look at first, by its expected error."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Iterator, NamedTuple

import numpy as np

from ...core.parameters import ParameterSet, parameter
from ...grids.isolines import rings_of
from ...grids.quantile import quantile_of
from ...rasters.windows import Windows, parts_of, stored_of
from ...report.units import Units
from .reasons import PlaceFigures, reason_of

# Places end at the lines of a square grid of this side in metres, so that one can be looked at as a
# whole: a forest would be a single place.
_WIDEST = 100.0
# Share of the cells that are no places, and the least error of places in metres, if the user gives
# no limit.
_USUAL = 0.95
_LEAST = 0.3
# Errors and weights that differ by this share are equal: last bits depend on the processor.
_SAME = 1e-6


@dataclass(frozen=True)
class Review(ParameterSet):
    """Which places are worth a look."""

    least_error: float | None = parameter(
        None,
        kind="number",
        label="Least expected error",
        unit="m",
        minimum=0.01,
        maximum=100.0,
        empty="automatic",
        help="Cells with a larger expected error belong to places. Empty: the error that 95 of 100"
        " cells do not exceed, at least 0.3 m, so that there are not more places than one can look"
        " at.",
    )
    least_area: float = parameter(
        4.0,
        label="Least area",
        unit="m2",
        minimum=0.0,
        maximum=100_000.0,
        help="Smaller places are left out.",
    )
    most_places: int = parameter(
        200,
        label="Most places",
        minimum=1,
        maximum=100_000,
        help="The places with the largest product of expected error and area are written.",
    )

    def limit(self, error: Windows) -> float:
        """Return what expected errors of places exceed, in metres, given those of all cells."""
        least = self.least_error
        if least is None:
            usual = quantile_of(lambda: (error[window] for window in parts_of(error)), _USUAL)
            least = max(usual, _LEAST)
        return least * (1.0 + _SAME)  # many cells may have that very value


class Rasters(NamedTuple):
    """What places are found in; float32 (rows, columns), in metres, NaN for no value."""

    error: Windows  # the expected error
    terrain: Windows | None  # the terrain model
    cause: Windows | None  # 1 for the first piece of `Evidence`, 0 or NaN for none
    cell: float  # side of a cell in metres


class PlaceToReview(NamedTuple):
    """A connected place; rows and columns are those of the raster, from north and west."""

    window: tuple[slice, slice]
    cells: np.ndarray  # bool, those of the window that belong to it
    weight: float  # the sum of expected error times area, m3
    worst: tuple[int, int]  # row and column of the cell with the largest expected error
    error: float  # there, in metres
    area: float  # m2
    low: float  # lowest and highest cell of the terrain model in metres; NaN without one
    high: float
    reason: str

    @property
    def rings(self) -> list[np.ndarray]:
        """The outline and those of the holes, row and column, (n, 2); the centres of cells are
        whole numbers.
        """
        rows, columns = self.window
        return [ring + np.array((rows.start, columns.start)) for ring in rings_of(self.cells)]


def places_of(
    rasters: Rasters, how: Review, limit: float, units: Units
) -> tuple[list[PlaceToReview], int]:
    """Return the places of cells whose expected error is over a limit in metres, those with the
    largest product of error and area first, and how many are too small.
    """
    found, small = [], 0
    for window, cells in _regions(rasters, limit):
        if np.count_nonzero(cells) * rasters.cell**2 >= how.least_area:
            found.append(_place(rasters, window, cells, units))
        else:
            small += 1
    return sorted(found, key=lambda place: (-float(f"{place.weight:.6g}"), place.worst)), small


def _regions(rasters: Rasters, least: float) -> Iterator[tuple[tuple[slice, slice], np.ndarray]]:
    """Yield the connected regions of cells with a larger expected error, as window and mask."""
    from scipy import ndimage

    side = max(math.ceil(_WIDEST / rasters.cell), 1)
    for row in range(0, rasters.error.shape[0], side):
        runs = stored_of(rasters.error).runs(row, row + side)
        for column in sorted({k for a, b in runs for k in range(a // side * side, b, side)}):
            square = rasters.error[row : row + side, column : column + side]
            with np.errstate(invalid="ignore"):  # NaN is not larger
                is_over = square > least
            if not is_over.any():
                continue
            labels, _ = ndimage.label(is_over, np.ones((3, 3)))
            for number, (rows, columns) in enumerate(ndimage.find_objects(labels), start=1):
                window = (
                    slice(row + rows.start, row + rows.stop),
                    slice(column + columns.start, column + columns.stop),
                )
                yield window, labels[rows, columns] == number


def _place(
    rasters: Rasters, window: tuple[slice, slice], cells: np.ndarray, units: Units
) -> PlaceToReview:
    """Return a place with its figures and the reason."""
    errors = np.where(cells, rasters.error[window], 0.0).astype(np.float64)
    row, column = np.unravel_index(_first_of_largest(errors), errors.shape)
    low = high = math.nan
    if rasters.terrain is not None:
        heights = rasters.terrain[window][cells]
        known = heights[np.isfinite(heights)]
        if len(known):
            low, high = float(known.min()), float(known.max())
    return PlaceToReview(
        window,
        cells,
        float(errors.sum()) * rasters.cell**2,
        (window[0].start + int(row), window[1].start + int(column)),
        float(errors[row, column]),
        float(np.count_nonzero(cells)) * rasters.cell**2,
        low,
        high,
        _reason(rasters, window, cells, errors, high - low, units),
    )


def _first_of_largest(values: np.ndarray) -> int:
    """Return the place of the first of the values that are the largest but for their last bits."""
    return int(np.argmax(values.ravel() >= values.max() * (1.0 - _SAME)))


def _reason(
    rasters: Rasters,
    window: tuple[slice, slice],
    cells: np.ndarray,
    errors: np.ndarray,
    rise: float,
    units: Units,
) -> str:
    """Return in words why the expected error of a place is large."""
    from scipy import ndimage

    cause = 0
    if rasters.cause is not None:
        causes = np.where(cells, np.nan_to_num(rasters.cause[window]), 0).astype(np.intp)
        cause = _first_of_largest(np.bincount(causes.ravel(), errors.ravel()))
    inner = ndimage.distance_transform_edt(np.pad(cells, 1)).max()
    width = round(2.0 * float(inner) * rasters.cell)
    around = tuple(slice(max(part.start - 1, 0), part.stop + 1) for part in window)
    is_border = any(
        part.start == 0 or part.stop == whole for part, whole in zip(window, rasters.error.shape)
    )
    is_border = is_border or bool(np.isnan(rasters.error[around]).any())
    return reason_of(cause, PlaceFigures(rise, width, float(errors.max())), is_border, units)
