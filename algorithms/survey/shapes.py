"""Lines and polygons that a user gives: their CRS, and whether they lie where the points are."""

from __future__ import annotations

from typing import Any, Iterator, NamedTuple, Sequence, Tuple, TypeVar, cast

import numpy as np

from ..core.errors import BareEarthError
from ..core.points import Box, box_in_words, box_round
from ..core.progress import SILENT, Progress
from ..crs.provider import LONGITUDE_LATITUDE, library, transformed
from ..crs.system import Crs
from .rings import area_lost

_Shape = TypeVar("_Shape", np.ndarray, Tuple[np.ndarray, ...])  # a line, or the rings of a polygon


class Place(NamedTuple):
    """Where the points of a run lie."""

    name: str  # the file, or "the files", for messages
    crs: Crs
    box: Box | None = None  # in units of the CRS; None if it is not known


class Shapes(Tuple[Any, ...]):
    """Polygons as in `Area`, or lines, float64 (n, 3), with the name of their file (`source`, for
    messages) and the CRS that it states, as code or well-known text.
    """

    crs: str | None
    source: str

    def __new__(
        cls, shapes: Sequence[Any] = (), crs: str | None = None, source: str = ""
    ) -> Shapes:
        """Return the shapes with their CRS."""
        new = super().__new__(cls, shapes)
        new.crs, new.source = crs, source
        return new


class Outside(BareEarthError):
    """Geometry and points do not touch."""


class Geometry:
    """Base of what holds lines and polygons: an area, corrections, constraints."""

    def located(self, place: Place, progress: Progress = SILENT) -> Geometry:
        """Return the geometry in the CRS of the points; refuse lines or polygons that all lie
        outside of the points.
        """
        raise NotImplementedError


def located(
    shapes: Sequence[_Shape],
    words: str,
    place: Place,
    progress: Progress = SILENT,
    near: float | None = None,
) -> tuple[_Shape, ...]:
    """Return lines or polygons in the CRS of the points; refuse them if all lie outside of the
    points, or farther than `near` metres from the points.
    """
    # Shapes of a file (`Shapes`) are transformed from the CRS that the file states. If it states
    # none, they are taken as longitudes and latitudes if all their coordinates can be degrees and
    # those of the points cannot. Other shapes are in the CRS of the points. Heights (z) stay.
    if place.crs.is_geographic:  # the run refuses such points
        return tuple(shapes)
    in_crs: tuple[_Shape, ...] = tuple(shapes)
    if isinstance(shapes, Shapes):
        in_crs = _in_crs(shapes, place, progress)
    boxes = np.array([_box_of(shape) for shape in in_crs if len(shape)]).reshape(-1, 4)
    if place.box is not None and len(boxes):
        reach = (near or 0.0) / place.crs.horizontal_unit
        west, south, east, north = place.box
        touches = (boxes[:, 0] <= east + reach) & (boxes[:, 2] >= west - reach)
        touches &= (boxes[:, 1] <= north + reach) & (boxes[:, 3] >= south - reach)
        if not touches.any():
            raise outside(words, box_round(boxes), place.name, place.box, near)
    polygons: list[tuple[np.ndarray, ...]] = [
        shape for shape in cast(Sequence[Any], in_crs) if isinstance(shape, tuple)
    ]
    lost = area_lost(polygons)
    if lost:
        lost *= place.crs.horizontal_unit**2
        progress.warning(
            f"A ring of {words} overlaps itself: what it covers twice, about {lost:,.3g} m², counts"
            " as outside. Draw it so that it does not cross itself."
        )
    return in_crs


def outside(words: str, bounds: Box, of: str, box: Box, near: float | None = None) -> Outside:
    """Return the error for geometry that lies outside of the points, or farther than `near` metres
    from them; `words` name the geometry, and `of` the files of the points.
    """
    lies = "in" if near is None else f"within {near:g} m of"
    return Outside(
        f"No point of {of} lies {lies} {words} ({box_in_words(bounds)}): the points lie"
        f" in {box_in_words(box)}. Give {words} in the CRS of the points."
    )


def _in_crs(shapes: Shapes, place: Place, progress: Progress) -> tuple[Any, ...]:
    stated, target = shapes.crs, place.crs
    is_guess = stated is None and _are_degrees(shapes) and not _is_in_degrees(place.box)
    if stated is None and not is_guess:
        return tuple(shapes)
    source = stated or LONGITUDE_LATITUDE
    if target.wkt is None and target.epsg is None:
        progress.warning(
            f"{shapes.source} is in another CRS than the points may be, which state none: its"
            " coordinates are taken as in the CRS of the points."
        )
        return tuple(shapes)
    if target.epsg is not None and source == f"EPSG:{target.epsg}":
        return tuple(shapes)
    named = "longitude and latitude" if is_guess else _name_of(source)
    if library() is None:
        raise BareEarthError(
            f"{shapes.source} is in {named}, and the points are in {target.name or 'another CRS'}:"
            " pip install pyproj, which transforms it."
        )
    corners = np.concatenate([np.zeros((0, 2)), *(part[:, :2] for part in _parts(shapes))])
    moved = transformed(source, target.wkt or f"EPSG:{target.epsg}", corners)
    if moved is None:
        raise BareEarthError(
            f"{shapes.source} cannot be transformed from {named} to the CRS of the points"
            f" ({target.name or f'EPSG:{target.epsg}'}). Save it in the CRS of the points."
        )
    if is_guess:
        named += ", as its numbers say"
    progress.info(f"{shapes.source} is transformed to the CRS of the points from {named}.")
    places = iter(
        np.split(moved, np.cumsum([len(part) for part in _parts(shapes)], dtype=np.int64))
    )
    return tuple(_moved(shape, places) for shape in shapes)


def _parts(shapes: Shapes) -> Iterator[np.ndarray]:
    """Yield all lines and rings, in order."""
    for shape in shapes:
        yield from (shape,) if isinstance(shape, np.ndarray) else shape


def _moved(shape: _Shape, places: Iterator[np.ndarray]) -> _Shape:
    """Return a shape with other x and y, and the same z."""
    if isinstance(shape, np.ndarray):
        return np.column_stack((next(places), shape[:, 2:]))
    return tuple(_moved(ring, places) for ring in shape)


def _box_of(shape: np.ndarray | tuple[np.ndarray, ...]) -> Box:
    corners = shape if isinstance(shape, np.ndarray) else np.concatenate(shape)
    return (*corners[:, :2].min(axis=0), *corners[:, :2].max(axis=0))


def _are_degrees(shapes: Shapes) -> bool:
    """Return whether all coordinates can be longitudes and latitudes."""
    boxes = [_box_of(shape) for shape in shapes if len(shape)]
    return all(map(_is_in_degrees, boxes))


def _is_in_degrees(box: Box | None) -> bool:
    return box is not None and bool((np.abs(box) <= (180.0, 90.0, 180.0, 90.0)).all())


def _name_of(crs: str) -> str:
    """Return a short name of a CRS: its code, or the name in its well-known text."""
    return crs.partition('["')[2].partition('"')[0] or crs
