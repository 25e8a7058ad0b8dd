"""The order of the four numbers of an extent: QGIS and PDAL write both of x before both of y."""

from __future__ import annotations

import math
from typing import Sequence

from .errors import BareEarthError
from .points import Box, box_in_words
from .progress import Progress

# An extent that is this many times as wide or high as that of the points may have another order.
_TIMES = 3.0


def valid_box(values: Sequence[float]) -> Box | None:
    """Return four numbers as smallest x and y, largest x and y, also from the order of QGIS if they
    are valid only so; None if they are no rectangle.
    """
    west, south, east, north = map(float, values)
    box = west, south, east, north
    return next((read for read in (box, _exchanged(box)) if _is_valid(read)), None)


def not_a_box(values: Sequence[float]) -> BareEarthError:
    """Return the error on four numbers that are no rectangle."""
    return BareEarthError(
        "The extent must be XMIN YMIN XMAX YMAX, XMIN below XMAX and YMIN below YMAX, not"
        f" {' '.join(f'{value:.10g}' for value in values)}."
    )


def in_order(box: Box, points: Box, was_given: bool, progress: Progress) -> Box:
    """Return an extent, in the order of QGIS if it lies in the box of points only so; refuse one
    that reaches far beyond the points but would be small in that order.
    """
    other = _exchanged(box)
    if not was_given:  # `valid_box` has exchanged them
        other, box = box, other
        if not (_is_like(other, points) or _contains(other, points)):
            raise not_a_box(box)
    elif _is_like(box, points) or not (_is_valid(other) and _is_like(other, points)):
        return box
    elif not _touches(other, points):
        raise BareEarthError(
            f"The extent ({box_in_words(box)}) reaches far beyond the points, and in the order XMIN"
            f" XMAX YMIN YMAX ({box_in_words(other)}) it lies outside of the points: they lie in"
            f" {box_in_words(points)}. Give XMIN YMIN XMAX YMAX."
        )
    progress.warning(
        f"The extent is taken as XMIN XMAX YMIN YMAX ({box_in_words(other)}), as QGIS and PDAL"
        " write it: as XMIN YMIN XMAX YMAX it does not fit the points."
    )
    return other


def _exchanged(box: Box) -> Box:
    return box[0], box[2], box[1], box[3]


def _is_valid(box: Box) -> bool:
    return all(map(math.isfinite, box)) and box[0] < box[2] and box[1] < box[3]


def _is_like(box: Box, points: Box) -> bool:
    """Return whether a box is not much larger than that of the points."""
    sides, most = _sides(box), max(_sides(points))
    return max(sides) <= _TIMES * most


def _sides(box: Box) -> tuple[float, float]:
    return box[2] - box[0], box[3] - box[1]


def _contains(box: Box, points: Box) -> bool:
    west, south, east, north = points
    return box[0] <= west and box[1] <= south and box[2] >= east and box[3] >= north


def _touches(box: Box, points: Box) -> bool:
    west, south, east, north = points
    return box[0] <= east and box[2] >= west and box[1] <= north and box[3] >= south
