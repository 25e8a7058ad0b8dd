"""An ensemble of ground filters: one with other cells, and the other ones; where they differ, the
terrain is less certain. It ranks errors a little better than the expected error of one run does
(`python -m benchmarks.expected_error --ensemble`), and takes five times as long.
"""

from __future__ import annotations

from typing import Iterator, NamedTuple, Sequence

import numpy as np

from bare_earth.algorithms.core.parameters import ParameterSet
from bare_earth.algorithms.filters import METHODS, method_of
from bare_earth.algorithms.grids.cells import Cells
from bare_earth.algorithms.grids.expected_error import RELAXATIONS
from bare_earth.algorithms.grids.inpaint import inpaint

# Metres by which points are moved against the cells of the filter, east and north; cells are 1 m
# and a few metres wide.
_SHIFTS = ((0.75, 0.57), (0.51, 0.14))


class Member(NamedTuple):
    """A further run of a ground filter."""

    parameters: ParameterSet
    shift: tuple[float, float]  # metres


def further_members(parameters: ParameterSet) -> Iterator[Member]:
    """Yield the members besides a filter: two with other cells, and each other filter with the
    preset and the changed values, as far as it has them.
    """
    own = method_of(parameters)
    usual = vars(type(parameters)())
    changed = {name: value for name, value in vars(parameters).items() if value != usual[name]}
    preset = changed.pop("preset", None)
    for shift in _SHIFTS:
        yield Member(parameters, shift)
    for method in METHODS.values():
        if method.name != own.name:
            names = {declared.name for declared in method.parameters().declarations()}
            values = {name: value for name, value in changed.items() if name in names}
            if preset in method.presets:
                values["preset"] = preset
            yield Member(method.parameters(**values), (0.0, 0.0))


def spread_of(
    cells: Cells,
    z: np.ndarray,
    grounds: Sequence[np.ndarray],
    rows: np.ndarray,
    columns: np.ndarray,
) -> np.ndarray:
    """Return the standard deviation in metres of the terrains of several ground masks, float32, for
    rows and columns as in `evidence`; infinite if a mask is empty.
    """
    total, squares = np.zeros((2, len(rows), len(columns)), dtype=np.float64)
    first = None
    for ground in grounds:
        if not ground.any():
            return np.full(total.shape, np.inf, dtype=np.float32)
        heights = cells.minimum(z, np.flatnonzero(ground))
        surface = inpaint(heights, RELAXATIONS, cells.first)
        values = surface.take(rows, axis=0).take(columns, axis=1).astype(np.float64)
        first = values if first is None else first
        total += values - first
        squares += (values - first) ** 2
    count = len(grounds)
    variance = squares / count - (total / count) ** 2
    return np.sqrt(np.maximum(variance, 0.0)).astype(np.float32)
