"""What a block sees of the points, and how its layers are made."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Mapping, NamedTuple, Tuple

import numpy as np

from ...core.points import Box, Points, box_round
from ...grids.cell_window import CellWindow
from ...tin.lattice_sample import LatticeSample

# Longest edge of the triangles in a block, in metres and in cells. Triangles across wider gaps need
# points from farther away than a block sees, so they are made when all blocks are done.
_LONGEST_EDGE = 50.0
_LONGEST_CELLS = 20.0
# Reach of a triangle in longest edges. Its circumcircle hardly ever reaches farther.
_EDGES = 2.0
# The cells of layers by their names, and the points that fill wide gaps by the names of the layers
# whose wide gaps are filled.
LayerCells = Tuple[Mapping[str, np.ndarray], Mapping[str, np.ndarray]]
Made = Mapping[str, np.ndarray]  # the layers that are made already


@dataclass(frozen=True)
class LayerSizes:
    """The layers of blocks, their cells and their gaps."""

    cell: float  # metres
    layers: tuple[str, ...] = ("terrain",)  # of `LAYERS`
    max_edge: float | None = None  # triangles with a longer edge, in metres, are gaps

    @property
    def longest_edge(self) -> float:
        """Longest edge of triangles in a block, in metres."""
        return self.max_edge or max(_LONGEST_EDGE, _LONGEST_CELLS * self.cell)

    @property
    def reach(self) -> float:
        """Distance in metres up to which points around a block are needed."""
        return _EDGES * self.longest_edge


class BlockView(NamedTuple):
    """The points that a block sees, in it and in its surroundings."""

    points: Points  # relative to `corner`
    ground: np.ndarray  # bool, (n,)
    top: np.ndarray  # bool, (n,): which belong to the surface
    core: np.ndarray  # bool, (n,): which lie in the block
    corner: tuple[float, float]  # origin of `points` in the frame of the survey
    edges: np.ndarray | None = None  # bool, (n,): ground on lines that no triangle may cross
    # the ground as another step has thinned it, and which of its points lie in the block
    thinned: tuple[LatticeSample, np.ndarray] | None = None
    lacks_ground: bool = False  # that ground is not among the points

    @property
    def parts(self) -> list[tuple[Points, np.ndarray, np.ndarray, np.ndarray]]:
        """All points in one or two parts, with `ground`, `top` and `core` of each."""
        parts = [(self.points, self.ground, self.top, self.core)]
        if self.thinned is not None and self.lacks_ground:
            points, core = self.thinned[0].points, self.thinned[1]
            parts.append((points, *np.broadcast_to([[True], [False]], (2, points.count)), core))
        return parts

    def window(self, box: Box, cell: float) -> CellWindow:
        """Return the cells whose centres lie in a box, and not a cell beyond the points."""
        west, south, east, north = box
        boxes = [points.box for points, *_ in self.parts if points.count]
        if not boxes:
            return CellWindow.with_centres_in((west, south, west, south), cell)
        whole = box_round(np.array(boxes))
        low_x, low_y, high_x, high_y = np.add(whole, np.tile(self.corner, 2)).tolist()
        west, south = max(west, low_x - cell), max(south, low_y - cell)
        east, north = min(east, high_x + cell), min(north, high_y + cell)
        return CellWindow.with_centres_in((west, south, max(east, west), max(north, south)), cell)

    def in_survey(self, points: Points) -> np.ndarray:
        """Return points in the frame of the survey, shape (n, 3)."""
        return np.add(np.column_stack(points), (*self.corner, 0.0))

    def start(self, window: CellWindow, cell: float) -> tuple[float, float]:
        """Return the corner of a window in the frame of the points."""
        (x, y), (west, south) = self.corner, window.corner(cell)
        return west - x, south - y
