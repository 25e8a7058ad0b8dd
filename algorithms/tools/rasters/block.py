"""Makes the layers of a block of a survey, which rasters are made of."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any, Callable, Mapping, NamedTuple

import numpy as np

from ...core.points import Box, Points, box_round
from ...core.progress import SILENT, Progress
from ...core.threads import over_parts
from ...grids.cell_window import CellWindow
from ...grids.cells import Cells, are_inside
from ...grids.expected_error import CELL, Evidence, causes_of, error_of, evidence
from ...grids.morphology import within_square
from ...tin.dense_surface import DenseSurface
from .block_view import BlockView, LayerCells, LayerSizes, Made
from .surfaces import surfaces
from .terrain_edges import TerrainAtEdges

# The layer that tells what each cell contains: bits for ground points in its four quarters, from
# southwest to northeast, a bit for any points, and one for points of the surface.
CONTENTS = "contents"
QUARTERS = 4
ANY = 16
TOP = 32
_LOOSE = "loose "  # before the names of `BlockRasters.loose`
# Rounding error of coordinates in metres.
_ROUNDING = 1e-6
_POINTS_SEEN = 1 << 16  # points whose arrays stay in the cache


class BlockRasters(NamedTuple):
    """The layers of a block, with rows from south to north."""

    window: CellWindow  # the cells of the block
    # float32, (rows, columns), NaN for no value, by names in `LAYERS`; also `CONTENTS`, of uint8;
    # arrays or `RowsOnDisk`
    layers: Mapping[str, Any]
    # float64, (n, 3): for layers with filled gaps, the points of the block that are needed across
    # wide gaps, corners of the convex hull and points beside cells without a height
    loose: Mapping[str, np.ndarray]
    box: np.ndarray  # float64, (4,): extent of the points in the block; NaN if it has none
    counts: np.ndarray  # int64, (2,): points of terrain and of surface in the block

    @property
    def arrays(self) -> dict[str, Any]:
        """The arrays by name, as a run stores them."""
        loose = {f"{_LOOSE}{name}": places for name, places in self.loose.items()}
        window = np.array(self.window)
        return {"window": window, "box": self.box, "counts": self.counts, **loose, **self.layers}

    @classmethod
    def of(cls, arrays: Mapping[str, Any]) -> BlockRasters:
        """Return the layers of a block, given their arrays."""
        layers = dict(arrays)
        window, box, counts = (layers.pop(name) for name in ("window", "box", "counts"))
        names = [name for name in layers if name.startswith(_LOOSE)]
        loose = {name[len(_LOOSE) :]: np.asarray(layers.pop(name)) for name in names}
        return cls(CellWindow(*window.tolist()), layers, loose, box, counts)


@dataclass(frozen=True)
class LayerMaker(LayerSizes):
    """Makes the layers of a block."""

    def of(self, view: BlockView, box: Box, progress: Progress = SILENT) -> BlockRasters:
        """Return the layers of a block, a box in the frame of the survey."""
        window = view.window(box, self.cell)
        layers: dict[str, Any] = {CONTENTS: _contents(self, view, window)}
        loose: dict[str, np.ndarray] = {}
        # The canopy needs the terrain, which is the first of `LAYERS`.
        names = [name for name in LAYERS if name in self.layers]
        parts = progress.shares(*(LAYERS[name].cost for name in names))
        for name, part in zip(names, parts):
            if name in layers:  # made together with another one
                continue
            found, at_gaps = LAYERS[name].make(self, view, window, layers, part)
            layers.update(found)
            loose.update(at_gaps)
        counts, boxes, extent = np.zeros(2, dtype=np.int64), [], np.full(4, np.nan)
        for points, ground, top, core in view.parts:
            counts += [np.count_nonzero(flags & core) for flags in (ground, top)]
            if core.any():
                low, high = (
                    [of(axis, where=core, initial=start) for axis in points[:2]]
                    for of, start in ((np.min, np.inf), (np.max, -np.inf))
                )
                boxes.append([*low, *high])
        if boxes:
            extent = box_round(np.array(boxes)) + np.tile(view.corner, 2)
        progress(1.0)
        return BlockRasters(window, layers, loose, extent, counts)


def _contents(step: LayerSizes, view: BlockView, window: CellWindow) -> np.ndarray:
    """Return what each cell contains, as `CONTENTS` says."""
    quarters = CellWindow(*(2 * number for number in window))
    any_points, ground, top = np.zeros((3, quarters.rows * quarters.columns), dtype=bool)

    def see(points: Points, are_ground: np.ndarray, are_top: np.ndarray, part: slice) -> None:
        x, y = points.x[part], points.y[part]
        row, column = quarters.places(x, y, view.corner, step.cell / 2.0)
        inside = are_inside(row, column, quarters.shape)
        index = row * quarters.columns + column
        any_points[index[inside]] = True
        top[index[inside & are_top[part]]] = True
        inside &= are_ground[part]
        ground[index[inside]] = True
        # A point on the middle line of a cell lies in the quarters on both sides.
        before = quarters.places(x - _ROUNDING, y - _ROUNDING, view.corner, step.cell / 2.0)
        is_south, is_west = (
            inside & (low < own) & (own % 2 > 0) for own, low in zip((row, column), before)
        )
        for on_border, cells in ((is_south, quarters.columns), (is_west, 1)):
            ground[index[on_border] - cells] = True
        ground[index[is_south & is_west] - quarters.columns - 1] = True

    for points, are_ground, are_top, _ in view.parts:
        over_parts(partial(see, points, are_ground, are_top), points.count, _POINTS_SEEN, SILENT)
    any_points, ground, top = (flags.reshape(quarters.shape) for flags in (any_points, ground, top))
    contents = np.zeros(window.shape, dtype=np.uint8)
    for number in range(QUARTERS):
        quarter = slice(number // 2, None, 2), slice(number % 2, None, 2)
        contents |= ground[quarter].view(np.uint8) << number
        contents |= any_points[quarter].view(np.uint8) * np.uint8(ANY)
        contents |= top[quarter].view(np.uint8) * np.uint8(TOP)
    return contents


def _terrain(
    step: LayerSizes,
    view: BlockView,
    window: CellWindow,
    made: Made,
    progress: Progress,
) -> LayerCells:
    """Return heights of the terrain."""
    known, core = view.thinned or (None, view.core[view.ground])
    points = view.points.take(view.ground) if known is None else known.points
    if not points.count or window.is_empty:
        nothing = np.full(window.shape, np.nan, dtype=np.float32)
        return {"terrain": nothing}, {"terrain": view.in_survey(points.take(core))}
    start = view.start(window, step.cell)
    surface = DenseSurface(points, step.cell, start, progress.part(0.05, 0.3), known)
    heights = surface.raster(window.shape, step.longest_edge, progress.part(0.3, 0.95))
    loose = np.zeros(points.count, dtype=bool)
    if step.max_edge is None:
        missing = np.isnan(heights)
        if missing.any():
            vertices = surface.vertices
            places = window.places(*points.take(vertices)[:2], view.corner, step.cell)
            cells = (np.clip(place, 0, most - 1) for place, most in zip(places, window.shape))
            loose[vertices[within_square(np.maximum, missing, 1)[tuple(cells)]]] = True
        loose[surface.hull] = True
    heights = heights.astype(np.float32)
    if view.edges is not None and view.edges.any():
        edges = TerrainAtEdges(points, view.edges[view.ground], step.cell)
        edges.follow_in_cells(heights, window, step.cell, view.corner)
    return {"terrain": heights}, {"terrain": view.in_survey(points.take(loose & core))}


# What the evidence for errors tells, by the layers.
OF_EVIDENCE: dict[str, Callable[[Evidence], np.ndarray]] = {
    "expected_error": error_of,
    "error_cause": causes_of,
    "ground_distance": lambda pieces: pieces.gap,
}


def _errors(
    step: LayerSizes,
    view: BlockView,
    window: CellWindow,
    made: Made,
    progress: Progress,
) -> LayerCells:
    """Return what the evidence for errors tells, of what is wanted, at the centre of each cell; it
    is found once, in cells of 1 m.
    """
    found = {
        name: np.full(window.shape, np.nan, dtype=np.float32)
        for name in OF_EVIDENCE
        if name in step.layers
    }
    if not view.points.count or window.is_empty:
        return found, {}
    cells = Cells.over(view.points, CELL)
    x, y = (centres - start for centres, start in zip(window.centres(step.cell), view.corner))
    row, column = (
        np.floor(centres / cells.size).astype(np.int64) - first
        for centres, first in zip((y, x), cells.first)
    )
    inside = [(places >= 0) & (places < count) for places, count in zip((row, column), cells.shape)]
    # Several small cells can lie in one of 1 m.
    (rows, of_rows), (columns, of_columns) = (
        np.unique(places[mask], return_inverse=True) for places, mask in zip((row, column), inside)
    )
    pieces = evidence(cells, view.points.z, view.ground, rows, columns)
    for name, values in found.items():
        of_cells = OF_EVIDENCE[name](pieces)
        values[np.ix_(*inside)] = of_cells[np.ix_(of_rows, of_columns)]
    return found, {}


class BlockLayer(NamedTuple):
    """A layer from which rasters are made."""

    # returns its cells, perhaps with those of others
    make: Callable[[LayerSizes, BlockView, CellWindow, Made, Progress], LayerCells]
    cost: float  # time that it takes, in relation to the other layers
    of_ground: bool  # needs ground points
    of_all: bool  # needs points that are not ground


LAYERS = {
    "terrain": BlockLayer(_terrain, 3.0, of_ground=True, of_all=False),
    "surface": BlockLayer(surfaces, 4.0, of_ground=False, of_all=True),
    "canopy": BlockLayer(surfaces, 6.0, of_ground=True, of_all=True),
    **dict.fromkeys(OF_EVIDENCE, BlockLayer(_errors, 1.5, of_ground=True, of_all=True)),
}
