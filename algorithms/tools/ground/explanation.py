"""Tells which rule of a filter decided each cell, and writes it as a raster."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple, Sequence

import numpy as np

from ...core.errors import BareEarthError
from ...core.points import Frame, Points
from ...core.progress import Progress
from ...engine.store import Corner
from ...filters.method import NOT_GROUND, Decisions
from ...grids.cells import cells_at
from ...rasters.geotiff import RasterGrid
from ...rasters.scattered import ScatteredCells, write_scattered
from ...survey.area import Area

# What the description of the band begins with; a list of the rules follows.
_MEANING = f"rule that decided (+{NOT_GROUND}: not ground): "


def described(rules: tuple[str, ...]) -> str:
    """Return the description of the band: what it shows, and the rules with their numbers."""
    names = (f"{number} {name}" for number, name in enumerate(rules, start=1))
    return _MEANING + ", ".join(names)


def rules_in(description: str) -> dict[int, str]:
    """Return the names of rules in the description of a band, by number; else none."""
    if not description.startswith(_MEANING):
        return {}
    rules = (rule.split(" ", 1) for rule in description[len(_MEANING) :].split(", "))
    return {int(number): name for number, name in rules}


class ExplainedCells(NamedTuple):
    """The cells of some points; arrays of shape (cells,)."""

    row: np.ndarray  # int64, counted from (0, 0) of the frame, in cells
    column: np.ndarray  # as row
    code: np.ndarray  # uint8, as in `Decisions`
    size: float  # metres
    rules: tuple[str, ...]

    @classmethod
    def of(cls, x: np.ndarray, y: np.ndarray, decided: Decisions, corner: Corner) -> ExplainedCells:
        """Return the cells that hold points, given in metres from a corner."""
        size = decided.size
        row, column = cells_at(x, y, size, (-corner[0], -corner[1]))
        (row, column), first = np.unique(np.stack((row, column)), axis=1, return_index=True)
        return cls(row, column, decided.codes[first], size, decided.rules)

    def in_cells_of(self, size: float) -> ExplainedCells:
        """Return the codes in smaller cells, as parts of a survey that are not sparse have; each
        gets the code of the cell that holds its centre.
        """
        if size == self.size:
            return self
        start = np.stack((self.row, self.column)) * self.size / size
        # The first centre that is not before the cell, and the first that is behind it.
        first = np.ceil(start - 0.5).astype(np.int64)
        end = np.ceil(start + self.size / size - 0.5).astype(np.int64)
        parts = []
        for offset in np.ndindex(*(end - first).max(axis=1)):
            places = first + np.reshape(offset, (2, 1))
            inside = (places < end).all(axis=0)
            parts.append((*places[:, inside], self.code[inside]))
        row, column, code = (np.concatenate(values) for values in zip(*parts))
        return ExplainedCells(row, column, code, size, self.rules)


def write_explanation(
    path: Path,
    blocks: Sequence[ExplainedCells],
    frame: Frame,
    progress: Progress,
    area: Area | None = None,
) -> None:
    """Write the codes of all cells in an area as a raster whose band lists the names of rules."""
    parts = [part for part in blocks if part.code.any()]
    if not parts:
        raise BareEarthError(
            "This preset decides points, not cells: there is nothing to explain. Choose another"
            " preset, or leave out the raster of rules."
        )
    size, rules = min(part.size for part in parts), parts[0].rules
    finest = (part.in_cells_of(size)[:3] for part in parts)
    row, column, code = (np.concatenate(values) for values in zip(*finest))
    x, y = (column + 0.5) * size, (row + 0.5) * size
    if area is not None:
        inside = area.scaled(frame.horizontal_unit, frame.origin).contains(x, y)
        if not inside.any():  # the area lies between the centres of cells
            inside[:] = True
        x, y, row, column, code = (values[inside] for values in (x, y, row, column, code))
    middles = Points(x, y, np.zeros(len(code)))
    grid = RasterGrid.over(middles, frame, size)
    cells = ScatteredCells(row.max() - row, column - column.min(), code)
    write_scattered(path, cells, grid, 0.0, progress, described(rules))
