"""The grids in which the quality of a survey is measured."""

from __future__ import annotations

from typing import NamedTuple, Sequence

from ...core.points import Box
from ...grids.cell_window import CellWindow
from ...grids.piece_grid import PieceGrid

# Side in metres of the squares that decide which area belongs to the survey.
SQUARE = 10.0
# Metres between pieces beyond the distance of voids, farther than other cells matter.
_APART = 200.0


class Grids(NamedTuple):
    """The grids of a survey."""

    fine: PieceGrid  # with cells of the size that was chosen
    coarse: PieceGrid  # with cells of twice that size
    spaced: PieceGrid  # with cells in which first returns are looked for

    @classmethod
    def over(cls, boxes: Sequence[Box], size: float, spacing: float, void: float) -> Grids:
        """Return the grids that cover the boxes of pieces; all lengths are in metres, `void` that
        of a void.
        """
        coarse = _beside(boxes, 2 * size, void, max(round(SQUARE / (2 * size)), 1))
        fine = tuple(piece.scaled(2) for piece in coarse.pieces)
        window = CellWindow(*(2 * count for count in coarse.window))
        return cls(PieceGrid(window, size, fine), coarse, _beside(boxes, spacing, void, 1))


def _beside(boxes: Sequence[Box], size: float, void: float, multiple: int) -> PieceGrid:
    """Return the grid of pieces, so far apart that none matters for another one."""
    windows = [CellWindow.around(box, size) for box in boxes]
    return PieceGrid.of(windows, size, int((void + _APART) / size), multiple)
