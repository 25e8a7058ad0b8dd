"""The area in which points are classified: a rectangle, polygons, or both."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, cast

import numpy as np

from ..core.box_order import in_order, not_a_box, valid_box
from ..core.errors import BareEarthError
from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..core.threads import parts_of
from ..las.cloud import PointCloud
from .rings import is_odd
from .shapes import Geometry, Place, located

# Points that are sorted together: few enough for memory, and many enough for the loop over edges.
_POINTS_A_STEP = 1 << 21

Polygon = tuple[np.ndarray, ...]


@dataclass(frozen=True, eq=False)
class Area(Geometry):
    """A part of the plane, in coordinates of the CRS."""

    box: Box | None = None  # smallest x and y, largest x and y; the border belongs to the box
    # The rings of each polygon, float64 (n, 2), closed or not, in any direction. By the even-odd
    # rule, a ring inside another ring is a hole. A point on the common border of two polygons
    # belongs to one of them. If there is a box as well, the area is the part of the polygons in the
    # box. Polygons of a file can be in another CRS until the points are known; see `located`.
    polygons: tuple[Polygon, ...] = ()
    was_given: ClassVar[bool] = True  # whether the order of the numbers of the box was given so

    def __post_init__(self) -> None:
        if self.box is None and not any(map(len, self.polygons)):
            raise BareEarthError("The boundary holds no polygon. Choose one that does.")
        if self.box is not None:
            box = valid_box(self.box)
            if box is None:
                raise not_a_box(self.box)
            object.__setattr__(self, "was_given", box == tuple(self.box))
            object.__setattr__(self, "box", box)
        if not all(np.isfinite(ring).all() for polygon in self.polygons for ring in polygon):
            raise BareEarthError(
                "A corner of the boundary is not a finite number. Check the boundary and its CRS."
            )

    def located(self, place: Place, progress: Progress = SILENT) -> Area:
        """Return the area in the CRS of the points."""
        box = self.box
        if box is not None and place.box is not None:
            box = in_order(box, place.box, self.was_given, progress)
        return Area(box, located(self.polygons, "the area", place, progress))

    @property
    def bounds(self) -> Box:
        """Smallest x and y, largest x and y; smallest above largest if the area is empty."""
        boxes = [_bounds(polygon) for polygon in self.polygons if polygon]
        if not boxes:
            return cast(Box, self.box)  # an area has polygons or a box
        lowest, highest = np.min(boxes, axis=0)[:2], np.max(boxes, axis=0)[2:]
        if self.box is not None:
            lowest, highest = np.maximum(lowest, self.box[:2]), np.minimum(highest, self.box[2:])
        (west, south), (east, north) = lowest.tolist(), highest.tolist()
        return west, south, east, north

    def buffered_box(self, distance: float) -> Box:
        """Return the bounds, wider by a distance in units of the CRS on each side."""
        west, south, east, north = self.bounds
        return west - distance, south - distance, east + distance, north + distance

    def scaled(self, factor: float, origin: tuple[float, float] = (0.0, 0.0)) -> Area:
        """Return the area in other units: coordinates from an origin, multiplied by a factor."""
        box = None
        if self.box is not None:
            box = tuple(((np.array(self.box) - np.tile(origin, 2)) * factor).tolist())
        return Area(
            box,
            tuple(
                tuple((ring - np.array(origin)) * factor for ring in polygon)
                for polygon in self.polygons
            ),
        )

    def may_touch(self, box: Box) -> bool:
        """Return whether the bounds touch a box, including borders."""
        west, south, east, north = self.bounds
        return west <= box[2] and east >= box[0] and south <= box[3] and north >= box[1]

    def contains(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return which places lie in the area; boolean, shape (n,)."""
        return self._numbers(x, y) > 0

    def of(self, cloud: PointCloud) -> np.ndarray:
        """Return which points of a cloud lie in the area, in file order."""
        return self.polygon_of(cloud) > 0

    def polygon_of(self, cloud: PointCloud) -> np.ndarray:
        """Return the number of the last polygon that holds each point of a cloud."""
        numbers = np.empty(cloud.count, dtype=np.int32)
        for part in parts_of(cloud.count, _POINTS_A_STEP):
            numbers[part] = self._numbers(*cloud.coordinates(part))
        return numbers

    def _numbers(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        west, south, east, north = self.bounds
        inside = (x >= west) & (x <= east) & (y >= south) & (y <= north)
        numbers = inside.astype(np.int32)
        if self.polygons:
            indices = np.flatnonzero(inside)
            for step in parts_of(len(indices), _POINTS_A_STEP):
                part = indices[step]
                numbers[part] = _last_polygon(x[part], y[part], self.polygons)
        return numbers


def _bounds(polygon: Polygon) -> Box:
    corners = np.concatenate(polygon)
    return (*corners.min(axis=0), *corners.max(axis=0))


def _last_polygon(x: np.ndarray, y: np.ndarray, polygons: tuple[Polygon, ...]) -> np.ndarray:
    """Return the number of the last polygon that holds each place, from 1; 0 for none; int32."""
    # When sorted by y, the places beside an edge or a polygon are a slice.
    order = np.argsort(y, kind="stable")
    x, y = x[order], y[order]
    numbers = np.zeros(len(x), dtype=np.int32)
    for number, polygon in enumerate(polygons, start=1):
        if not polygon:
            continue
        west, south, east, north = _bounds(polygon)
        first, last = np.searchsorted(y, (south, north))
        near = x[first:last]
        in_box = first + np.flatnonzero((near >= west) & (near <= east))
        numbers[in_box[is_odd(x[in_box], y[in_box], polygon)]] = number
    result = np.empty(len(x), dtype=np.int32)
    result[order] = numbers
    return result
