"""Points in local metres, as ground filters use them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from .threads import in_threads

# Least number of points to be selected in several threads.
_MANY = 1 << 18

# Smallest x and y, largest x and y.
Box = tuple[float, float, float, float]


def box_round(boxes: np.ndarray) -> Box:
    """Return the box that holds boxes, shape (n, 4)."""
    return (*boxes[:, :2].min(axis=0).tolist(), *boxes[:, 2:].max(axis=0).tolist())


def scaled(box: Box, factor: float) -> Box:
    """Return a box with coordinates that are multiplied, such as by the metres in a unit."""
    west, south, east, north = box
    return west * factor, south * factor, east * factor, north * factor


@dataclass(frozen=True)
class Frame:
    """The position of local metres in the coordinate reference system of the survey."""

    origin: tuple[float, float] = (0.0, 0.0)  # x and y of local (0, 0), in units of the CRS
    horizontal_unit: float = 1.0  # metres in one unit of the CRS
    vertical_unit: float = 1.0  # metres in one unit of the CRS
    wkt: str | None = None  # the CRS, if the survey has one

    def moved(self, corner: tuple[float, float]) -> Frame:
        """Return a frame with another origin, given in metres of this one."""
        east, north = (
            start + metres / self.horizontal_unit for start, metres in zip(self.origin, corner)
        )
        return replace(self, origin=(east, north))


class _Columns(NamedTuple):
    x: np.ndarray
    y: np.ndarray
    z: np.ndarray


class Points(_Columns):
    """Easting, northing and height in metres from an origin, each float64 (n,), which must not
    change after `box` was used.
    """

    @property
    def count(self) -> int:  # type: ignore[override]
        """Number of points (`len` of a named tuple counts its fields)."""
        return len(self.x)

    @cached_property
    def box(self) -> Box:
        """Smallest x and y, largest x and y; there must be at least one point."""
        return (
            float(self.x.min()),
            float(self.y.min()),
            float(self.x.max()),
            float(self.y.max()),
        )

    @cached_property
    def found(self) -> dict[str, Any]:
        """A cache in which functions keep what they have found out about the points, by name."""
        return {}

    @property
    def sides(self) -> tuple[float, float]:
        """Width and height of the box in metres."""
        west, south, east, north = self.box
        return east - west, north - south

    def within(self, box: Box) -> np.ndarray:
        """Return which points lie in a box, without its largest x and y; boolean, shape (n,)."""
        west, south, east, north = box
        inside = (self.x >= west) & (self.x < east)
        inside &= (self.y >= south) & (self.y < north)
        return inside

    def are_within(self, box: Box) -> bool:
        """Return whether all points lie in a box; there must be at least one point."""
        west, south, east, north = self.box
        return west >= box[0] and south >= box[1] and east < box[2] and north < box[3]

    def take(self, selected: np.ndarray | slice) -> Points:
        """Return the points that a boolean mask, an index array or a slice selects."""
        if isinstance(selected, np.ndarray) and selected.dtype == bool:
            selected = np.flatnonzero(selected)  # faster than to use the mask three times
        if isinstance(selected, slice) or len(selected) < _MANY:
            return Points(self.x[selected], self.y[selected], self.z[selected])
        return Points(*in_threads(lambda column: column[selected], self))

    def and_also(self, more: Points) -> Points:
        """Return these points, followed by others."""
        return Points(*(np.concatenate(pair) for pair in zip(self, more)))


def box_in_words(box: Box) -> str:
    """Return the limits of a box in words."""
    west, south, east, north = box
    return f"x {west:.10g} to {east:.10g}, y {south:.10g} to {north:.10g}"
