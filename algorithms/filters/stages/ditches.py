"""Land between narrow ditches, which has drops on all sides as an object has."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...core.progress import SILENT, Progress
from ...grids.morphology import within_square
from ..pipeline import GridRule, Stage
from ..state import GridState
from .raised_regions import even_cells


@dataclass(frozen=True)
class BetweenDitches(GridRule):
    """Even land with ditches beside it, and land as high beyond them, is ground.

    No real tile needs it so far. Without it the slope filter and grid minimum lose a fifth to three
    quarters of generated land with a ditch each 10 or 15 m.

    Attributes
    ----------
    width, depth : float
        The largest width and depth of a ditch in metres.
    least_area, least_width : float
        The least area (m2) and width (m) of the land between ditches.
    share : float
        Least share of the land's border that drops into a ditch.
    beyond : float
        The land beyond the ditch may be lower by this share of the drop.
    even_share : float
        Least share of its cells that are even; plants are not even.
    """

    stage: ClassVar = Stage.TERRAIN
    reads: ClassVar = ("filled", "surface", "raised")
    writes: ClassVar = ("raised",)

    width: float = 6.0
    depth: float = 2.2
    least_area: float = 100.0
    least_width: float = 2.5
    share: float = 0.5
    beyond: float = 0.35
    even_share: float = 0.6

    def apply(self, grid: GridState, progress: Progress = SILENT) -> None:
        """Let even land between ditches be ground."""
        from scipy import ndimage

        filled, raised, size = grid.filled, grid.raised, grid.cells.size
        number, count = ndimage.label(raised & (filled <= grid.surface + self.depth))
        cells_of = np.bincount(number.ravel(), minlength=count + 1)
        fits = cells_of * size**2 >= self.least_area
        fits[0] = False
        if not fits.any():
            return
        reach = max(round(self.width / size / 2.0), 1)
        closed = within_square(np.minimum, within_square(np.maximum, filled, reach), reach)
        into_ditch, border = np.zeros((2, count + 1))
        for ahead, behind in ((np.s_[1:], np.s_[:-1]), (np.s_[:, 1:], np.s_[:, :-1])):
            for here, there in ((ahead, behind), (behind, ahead)):
                beside = fits[number[here]] & (number[here] != number[there])
                of, drop = number[here][beside], (filled[here] - filled[there])[beside]
                is_ditch = ~raised[there][beside] & (drop > 0.0)
                is_ditch &= closed[there][beside] >= filled[here][beside] - self.beyond * drop
                border += np.bincount(of, minlength=count + 1)
                into_ditch += np.bincount(of, is_ditch, count + 1)
        fits &= (into_ditch >= self.share * border) & (
            2.0 * cells_of * size >= self.least_width * border
        )
        even = np.bincount(number[even_cells(filled)], minlength=count + 1)
        fits &= even >= self.even_share * cells_of
        grid.raised &= ~fits[number]
