"""Which points lie close to a surface given on a grid."""

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
    """Points between the limits of the heights of ground are ground."""

    stage: ClassVar = Stage.ACCEPTED
    writes: ClassVar = ("ground",)

    def apply(self, state: State) -> None:
        """Accept the points between the limits."""
        cells = state.grids[0].cells
        state.ground = near_surface(state.points, cells, state.limits, state.progress)


@dataclass(frozen=True)
class OnlyKeyPoints(PointRule):
    """Of the ground, only the points that a terrain model needs are taken."""

    stage: ClassVar = Stage.ACCEPTED
    writes: ClassVar = ("ground",)

    closeness: ModelKeyPoints  # how close to their TIN all other ground points are

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
    # The extremes of both round a cell decide most points; only the others need the interpolation.
    bounds = _bounds(limits)
    near = np.empty(points.count, dtype=bool)

    def decide(part: slice) -> None:
        z = points.z[part].astype(np.float32)
        least, sure_least, sure_most, most = bounds.take(cells.index[part], axis=0).T
        open_ = (z >= least) & (z <= most)
        sure = (z >= sure_least) & (z <= sure_most)
        open_ = np.flatnonzero(open_ & ~sure) + part.start
        near[part] = sure
        north = points.y.take(open_) / cells.size - (cells.first_row + 0.5)
        east = points.x.take(open_) / cells.size - (cells.first_column + 0.5)
        least, most = _bilinear(limits, north, east)
        z = points.z.take(open_)
        near[open_] = (z >= least) & (z <= most)

    over_parts(decide, points.count, _POINTS_A_PART, progress)
    return near


def _bilinear(
    grids: np.ndarray, north: np.ndarray, east: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Interpolate two grids (rows, columns, 2) at places counted from the first centre."""
    rows, columns, _ = grids.shape
    flat = grids.reshape(-1, 2)
    south, up = _lower(north, rows)
    west, right = _lower(east, columns)
    next_row, next_column = min(rows - 1, 1) * columns, min(columns - 1, 1)

    def between(corner: np.ndarray) -> np.ndarray:
        value = flat.take(corner, axis=0)
        return value + (flat.take(corner + next_column, axis=0) - value) * right

    corner = south * columns + west
    south_side = between(corner)
    values = south_side + (between(corner + next_row) - south_side) * up
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
    # Points between the second and the third lie between the surfaces, points outside the first and
    # the fourth do not, and others are in doubt.
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
