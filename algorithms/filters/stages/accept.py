"""Which points are ground: those between two surfaces on a grid, or only their key points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.points import Points
from ...core.progress import SILENT, Progress
from ...core.threads import in_threads, over_parts
from ...grids.cells import Cells
from ...grids.morphology import within_square
from ...tin.model_key_points import ModelKeyPoints, model_key_points
from ..pipeline import PointRule, Stage
from ..state import State

_POINTS_A_PART = 1 << 16
# Largest error of single precision in metres, for heights up to 16 km. Points so close to a limit
# are tested again.
_IN_DOUBT = np.float32(0.005)


@dataclass(frozen=True)
class NearSurface(PointRule):
    """A point between the lowest and the highest height of ground at its place is ground."""

    stage: ClassVar = Stage.ACCEPTED
    writes: ClassVar = ("ground",)

    def apply(self, state: State) -> None:
        """Accept the points between the limits."""
        cells = state.grids[0].cells
        state.ground = near_surface(state.points, cells, state.limits, state.progress)


@dataclass(frozen=True)
class OnlyKeyPoints(PointRule):
    """Of the ground points, only the model key points stay ground."""

    stage: ClassVar = Stage.ACCEPTED
    writes: ClassVar = ("ground",)

    closeness: ModelKeyPoints  # how far other ground points may lie from the TIN of key points

    def apply(self, state: State) -> None:
        """Accept the key points only."""
        if not state.ground.any():
            return
        key = np.zeros(state.points.count, dtype=bool)
        ground = state.points.take(state.ground)
        key[state.ground] = model_key_points(ground, self.closeness, state.progress)
        state.ground = key


def near_surface(
    points: Points, cells: Cells, limits: np.ndarray, progress: Progress = SILENT
) -> np.ndarray:
    """Return which points (n,) lie between the lower and the upper of two surfaces (rows, columns,
    2), in metres, bilinear between the centres of cells and level beyond them.
    """
    # For most points, the extremes of both surfaces round their cell are enough to decide. Only for
    # the others the surfaces are interpolated.
    bounds = _bounds(limits)
    between = np.empty(points.count, dtype=bool)

    def decide(part: slice) -> None:
        z = points.z[part].astype(np.float32)
        least, sure_least, sure_most, most = bounds.take(cells.index[part], axis=0).T
        possible = (z >= least) & (z <= most)
        certain = (z >= sure_least) & (z <= sure_most)
        doubtful = np.flatnonzero(possible & ~certain) + part.start
        between[part] = certain
        north = points.y.take(doubtful) / cells.size - (cells.first_row + 0.5)
        east = points.x.take(doubtful) / cells.size - (cells.first_column + 0.5)
        least, most = _bilinear(limits, north, east)
        z = points.z.take(doubtful)
        between[doubtful] = (z >= least) & (z <= most)

    over_parts(decide, points.count, _POINTS_A_PART, progress)
    return between


def _bilinear(
    grids: np.ndarray, north: np.ndarray, east: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Interpolate two grids (rows, columns, 2) at places counted from the first centre."""
    rows, columns, _ = grids.shape
    flat = grids.reshape(-1, 2)
    south, up = _lower(north, rows)
    west, right = _lower(east, columns)
    next_row, next_column = min(rows - 1, 1) * columns, min(columns - 1, 1)

    def at_row(corner: np.ndarray) -> np.ndarray:
        value = flat.take(corner, axis=0)
        return value + (flat.take(corner + next_column, axis=0) - value) * right

    corner = south * columns + west
    south_side = at_row(corner)
    values = south_side + (at_row(corner + next_row) - south_side) * up
    return values[:, 0], values[:, 1]


def _lower(place: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return the centre before each place, and how far beyond it the place lies."""
    place = np.clip(place, 0.0, count - 1.0)
    lower = np.minimum(place.astype(np.intp), max(count - 2, 0))
    return lower, (place - lower)[:, None]


def _bounds(limits: np.ndarray) -> np.ndarray:
    """Return the lowest and the highest height of the lower, then of the upper surface round each
    cell, float32 (cells, 4).
    """
    # A point between the second and the third height certainly lies between the surfaces. One below
    # the first or above the fourth certainly does not. All others are doubtful.
    rows, columns, _ = limits.shape
    bounds = np.empty((rows * columns, 4), dtype=np.float32)

    def fill(column: int) -> None:
        grid = limits[..., column // 2].astype(np.float32)
        if column % 2:
            bounds[:, column] = (within_square(np.maximum, grid, 1) + _IN_DOUBT).ravel()
        else:
            bounds[:, column] = (within_square(np.minimum, grid, 1) - _IN_DOUBT).ravel()

    in_threads(fill, range(4))
    return bounds
