"""Heights on square cells, with their place in the grid of the CRS."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ..grids.inpaint import RELAXATIONS, First, inpaint


class HeightGrid(NamedTuple):
    """Heights on square cells."""

    values: np.ndarray  # (rows, columns), metres; NaN where nothing is known
    size: float  # side of a cell in metres
    origin: First = (0, 0)  # row and column of the first cell in the grid of the CRS

    @property
    def known(self) -> np.ndarray:
        """Which cells have a height; boolean, shape (rows, columns)."""
        return np.isfinite(self.values)

    def where(self, cells: np.ndarray) -> HeightGrid:
        """Return the heights of some cells only."""
        return self._replace(values=np.where(cells, self.values, np.nan))

    def filled(self, relaxations: int = RELAXATIONS) -> np.ndarray:
        """Return the heights with gaps filled smoothly; see `inpaint`."""
        return inpaint(self.values, relaxations, self.origin)
