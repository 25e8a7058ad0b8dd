"""Several looks at the ground: the filter with other cells, and the other filters."""

from __future__ import annotations

from typing import Iterator, NamedTuple

import numpy as np

from ...core.errors import BareEarthError
from ...core.parameters import ParameterSet
from ...core.points import Points
from ...filters import METHODS, method_of
from ...filters.method import Method
from ...grids.expected_error import LOOKS

# Metres by which points are moved against the cells of the filter, east and north; cells are 1 m
# and a few metres wide.
_SHIFTS = ((0.75, 0.57), (0.51, 0.14))
# Bits of a value for the label of a point. The next bits are set for each look but the first in
# which the point is ground.
_BITS = 3


class Look(NamedTuple):
    """A further look at the ground."""

    method: Method
    parameters: ParameterSet
    shift: tuple[float, float]  # metres

    def ground(
        self, points: Points, known: np.ndarray | None, multi_return: np.ndarray
    ) -> np.ndarray:
        """Return which moved points are ground; none where the filter finds none."""
        try:
            found = self.method.ground(
                points, self.parameters, known=known, multi_return=multi_return
            )
        except BareEarthError:
            return np.zeros(points.count, dtype=bool)
        return found.ground

    def moved(self, points: Points) -> Points:
        """Return points, moved against the cells."""
        if self.shift == (0.0, 0.0):
            return points
        east, north = self.shift
        return Points(points.x + east, points.y + north, points.z)


def looks_of(parameters: ParameterSet) -> Iterator[Look]:
    """Yield the looks besides that of a filter: two with other cells, and one by each other filter,
    with the preset and the changed values of the user, as far as the filter has them.
    """
    own = method_of(parameters)
    usual = vars(type(parameters)())
    changed = {name: value for name, value in vars(parameters).items() if value != usual[name]}
    preset = changed.pop("preset", None)
    for shift in _SHIFTS:
        yield Look(own, parameters, shift)
    for method in METHODS.values():
        if method.name != own.name:
            names = {declared.name for declared in method.parameters().declarations()}
            values = {name: value for name, value in changed.items() if name in names}
            if preset in method.presets:
                values["preset"] = preset
            yield Look(method, method.parameters(**values), (0.0, 0.0))


def with_looks(labels: np.ndarray, grounds: Iterator[np.ndarray]) -> np.ndarray:
    """Return labels with the bits of the looks in which points are ground; uint8."""
    found = labels.copy()
    for number, ground in enumerate(grounds):
        found |= ground.astype(np.uint8) << np.uint8(_BITS + number)
    return found


def label_of(values: np.ndarray) -> np.ndarray:
    """Return the labels of points, without the bits of looks."""
    return values & np.uint8((1 << _BITS) - 1)


def looks_in(values: np.ndarray, ground: int) -> np.ndarray:
    """Return in which looks points are ground, given the label of ground; uint8, a bit for each of
    `LOOKS`, the first one for the filter itself.
    """
    others = (values >> np.uint8(_BITS)) << np.uint8(1)
    return others & np.uint8((1 << LOOKS) - 2) | (label_of(values) == ground)
