"""Polygons of water with their level, and the cells of rasters that lie in them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Iterator, Sequence

import numpy as np

from ...core.points import Box
from ...grids.cell_window import CellWindow
from ...grids.lines import NearestHeights, near_rings
from ...grids.outline import Outline, Span, spans
from ...survey.area import Area
from ...tin.triangulation import Tin

# Metres from the shore within which a place lies in the water: the border belongs to it.
_ON_SHORE = 1e-3


@dataclass(frozen=True, eq=False)
class LevelWater:
    """A polygon of water with its level, in metres."""

    # float64, (n, 3): shore and islands, closed; z is the level, which falls evenly between two
    # corners; NaN if it is not known
    rings: tuple[np.ndarray, ...]
    rivers: tuple[np.ndarray, ...] = ()  # float64, (m, 3): parts of rivers in it, downstream

    @property
    def levels(self) -> tuple[float, float]:
        """The highest and the lowest level; NaN if it is not known."""
        heights = np.concatenate(self.rings)[:, 2]
        return float(heights.max()), float(heights.min())

    @property
    def is_known(self) -> bool:
        """Whether the level is known."""
        return not np.isnan(self.levels).any()

    @property
    def area(self) -> float:
        """Its area in square metres."""
        shore, *islands = map(_area_in, self.rings)
        return shore - sum(islands)

    @property
    def bounds(self) -> Box:
        """Smallest x and y, largest x and y."""
        return self._outline.bounds

    def contains(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return which places lie in the water or on its shore; bool, shape (k,)."""
        return self._outline.contains(x, y) | near_rings(
            x, y, [ring[:, :2] for ring in self.rings], _ON_SHORE
        )

    def level_at(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the level at places in the water: that of the TIN of its shore and rivers."""
        high, low = self.levels
        if not high > low:
            return np.full(len(x), high)
        found = self._surface.interpolate(x, y)
        beyond = np.isnan(found)
        corners = NearestHeights(np.concatenate((*self.rings, *self.rivers)), np.inf)
        found[beyond] = corners.near(np.column_stack((x, y))[beyond])
        return found

    @cached_property
    def _outline(self) -> Area:
        return Area(None, (tuple(ring[:, :2] for ring in self.rings),))

    @cached_property
    def _surface(self) -> Tin:
        return Tin(*np.concatenate((*self.rings, *self.rivers)).T)


def _area_in(ring: np.ndarray) -> float:
    """Return the area inside a ring in square metres."""
    x, y = (ring[:, :2] - ring[0, :2]).T
    return abs(float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))) / 2.0


class WaterCells:
    """The cells of rasters, `cell` metres wide, whose centres lie in water with a level."""

    def __init__(self, waters: Sequence[LevelWater], window: CellWindow, cell: float) -> None:
        self._cell = cell
        self._parts = [
            (water, part, _cells_in(water, part, cell))
            for water in waters
            if not (part := CellWindow.around(water.bounds, cell).within(window)).is_empty
        ]

    def meets(self, window: CellWindow) -> bool:
        """Return whether water can lie in a window."""
        return not all(part.within(window).is_empty for _, part, _ in self._parts)

    def inside(self, window: CellWindow) -> np.ndarray:
        """Return which cells of a window lie in water, rows from the south; bool."""
        found = np.zeros(window.shape, dtype=bool)
        for where, cells, *_ in self._among(window):
            found[where] |= cells
        return found

    def burn(self, heights: np.ndarray, window: CellWindow, kept: np.ndarray | None = None) -> None:
        """Set the heights in metres of cells in water to its level, in place, but for those `kept`;
        rows of the window go from the south.
        """
        for where, cells, water, part in self._among(window):
            rows, columns = np.nonzero(cells if kept is None else cells & ~kept[where])
            x, y = (part.column + columns + 0.5) * self._cell, (part.row + rows + 0.5) * self._cell
            heights[where][rows, columns] = water.level_at(x, y)

    def _among(
        self, window: CellWindow
    ) -> Iterator[tuple[tuple[slice, slice], np.ndarray, LevelWater, CellWindow]]:
        """Yield, for each water, its part of a window, which cells of it lie in it, and these."""
        for water, whole, cells in self._parts:
            part = whole.within(window)
            if not part.is_empty:
                rows, columns = whole.slices(part)
                inside = cells.cells(Span(rows.start, rows.stop, columns.start, columns.stop))
                yield window.slices(part), inside, water, part


NO_WATER_CELLS = WaterCells((), CellWindow(0, 0, 0, 0), 1.0)


def _cells_in(water: LevelWater, window: CellWindow, cell: float) -> Outline:
    """Return which cells of a window have their centre in water."""
    cells = Outline(window.shape)
    x, y = window.centres(cell)
    for span in spans(window.shape):
        east, north = np.meshgrid(x[span.first : span.last], y[span.start : span.end])
        inside = water.contains(east.ravel(), north.ravel())
        cells.set(span, inside.reshape(east.shape))
    return cells
