"""Places with an answer: they are left out, carried over to the next layer, and compared."""

from __future__ import annotations

from typing import Any, Iterable, Iterator, Mapping, NamedTuple, Sequence

import numpy as np

from ...classes.corrections import SKIP, Corrections
from ...core.words import counted
from ...rasters.geotiff import HeightBand
from ...rasters.windows import Windows, parts_of
from ...survey.area import Area, Polygon
from ...survey.feature_files import Feature
from ...survey.vector_files import ANSWER_FIELD, CLASS_FIELD
from ..contours import corners_of
from .places import PlaceToReview, Rasters

# Heights are in the unit of the raster, errors and areas in metres and square metres. X1 to Y2 are
# the ends of the profile line in the CRS.
FIELDS: dict[str, type] = {
    "RANK": int, "REASON": str, "ERROR": float, "AREA": float, "SHARE": float, "LOW": float,
    "HIGH": float, CLASS_FIELD: int, ANSWER_FIELD: str,
    "X1": float, "Y1": float, "X2": float, "Y2": float,
}  # fmt: skip
_LINE = ("X1", "Y1", "X2", "Y2")
_CHANGED = 0.01  # metres, from which on the height of a cell has changed


def sorted_by_answers(
    places: Sequence[PlaceToReview], raster: HeightBand, corrections: Corrections
) -> tuple[list[PlaceToReview], int]:
    """Return the places without an answer, skipped ones last, and how many have one."""
    waits = [answer == SKIP for answer in corrections.answers]
    done = _are_in(places, raster, _chosen(corrections, waits, False))
    skipped = _are_in(places, raster, _chosen(corrections, waits, True))
    left = [place for place, is_done in zip(places, done) if not is_done]
    later = {place.worst for place, is_skipped in zip(places, skipped) if is_skipped}
    return sorted(left, key=lambda place: place.worst in later), int(np.count_nonzero(done))


def _chosen(corrections: Corrections, waits: Sequence[bool], which: bool) -> tuple[Polygon, ...]:
    return tuple(one for one, wait in zip(corrections.polygons, waits) if wait == which)


def _are_in(
    places: Sequence[PlaceToReview], raster: HeightBand, polygons: tuple[Polygon, ...]
) -> np.ndarray:
    """Return whether the worst cell of each place lies in a polygon; bool, (n,)."""
    if not polygons or not places:
        return np.zeros(len(places), dtype=bool)
    x, y = corners_of(np.array([place.worst for place in places]), raster).T
    return Area(None, polygons).contains(x, y)


def carried_over(corrections: Corrections, rank: int) -> Iterator[Feature]:
    """Yield the places with an answer as they were, with ranks after a given one; skipped places
    come again as new ones.
    """
    columns = zip(
        corrections.polygons, corrections.classes, corrections.answers, corrections.values
    )
    for polygon, value, answer, values in columns:
        if answer != SKIP:
            rank += 1
            own = {**values, "RANK": rank, CLASS_FIELD: value, ANSWER_FIELD: answer}
            if not _is_near(polygon, values):  # such as in another CRS
                own = {name: one for name, one in own.items() if name not in _LINE}
            row = (own.get(name) for name in FIELDS)
            yield Feature(tuple(map(_fitting, row, FIELDS.values())), _closed(polygon))


def _is_near(polygon: Polygon, values: Mapping[str, Any]) -> bool:
    """Return whether the profile line of a place crosses the box round its polygon."""
    if not all(isinstance(values.get(name), (int, float)) for name in _LINE):
        return False
    corners = np.vstack(polygon)[:, :2]
    ends = np.array([values[name] for name in _LINE], dtype=np.float64).reshape(2, 2)
    return bool(
        (ends.min(axis=0) <= corners.max(axis=0)).all()
        and (ends.max(axis=0) >= corners.min(axis=0)).all()
    )


def _fitting(value: object, kind: type) -> object:
    """Return a value that a field of a type can hold, None for any other."""
    if isinstance(value, (int, float)) and kind in (int, float):
        return kind(value)
    return value if isinstance(value, kind) else None


def _closed(polygon: Polygon) -> Polygon:
    return tuple(
        ring if np.array_equal(ring[0], ring[-1]) else np.vstack((ring, ring[:1]))
        for ring in polygon
    )


class Change(NamedTuple):
    """What changed in the terrain model since the run before, in one place or in all cells."""

    name: str
    answer: str
    cells: int  # that changed
    area: float  # m2, of these cells
    mean: float  # metres, of these cells; 0 without any
    largest: float  # metres, up or down

    @property
    def text(self) -> str:
        """The change in a sentence."""
        if not self.cells:
            return "The terrain model is the same as in the run before."
        return (
            f"The terrain model changed in {counted(self.cells, 'cell')} ({self.area:,.0f} m2), by"
            f" {self.mean:+.2f} m on average and {self.largest:+.2f} m at most."
        )


def changes_of(
    rasters: Rasters, before: Windows, raster: HeightBand, corrections: Corrections
) -> list[Change]:
    """Return what changed in all cells, and in each place whose answer changes classes."""
    rises = _RiseWindows(rasters.terrain, before)
    found = [_change("all cells", "", (rises[window] for window in parts_of(before)), rasters.cell)]
    polygons, codes, numbers = corrections.effects
    for polygon, code, number in zip(polygons, codes, numbers):
        rank = corrections.values[number].get("RANK", number + 1)
        answer = corrections.answers[number] or f"class {code}"
        inside = _inside(rises, polygon, raster)
        found.append(_change(f"place {rank}", answer, [inside], rasters.cell))
    return found


class _RiseWindows:
    """By how much the terrain rose, 0 without a value; of no terrain, what was before is lost."""

    def __init__(self, terrain: Windows | None, before: Windows) -> None:
        self._terrain, self._before = terrain, before

    def __getitem__(self, window: tuple[slice, slice]) -> np.ndarray:
        before = self._before[window]
        terrain = np.zeros_like(before) if self._terrain is None else self._terrain[window]
        return np.nan_to_num(terrain - before)


def _inside(rises: _RiseWindows, polygon: Polygon, raster: HeightBand) -> np.ndarray:
    """Return the values of the cells in a polygon."""
    x0, a, _, y0, _, d = raster.geotransform
    corners = np.vstack(polygon)[:, :2]
    columns, rows = ((corners - (x0, y0)) / (a, d)).T
    window = tuple(
        slice(max(int(np.floor(values.min())), 0), max(int(np.ceil(values.max())), 0))
        for values in (rows, columns)
    )
    part = rises[window[0], window[1]]
    places = np.argwhere(np.ones(part.shape, dtype=bool)) + [one.start for one in window]
    x, y = corners_of(places, raster).T
    return part.ravel()[Area(None, (polygon,)).contains(x, y)]


def _change(name: str, answer: str, parts: Iterable[np.ndarray], cell: float) -> Change:
    """Return the figures of the heights by which some cells rose."""
    count, total, largest = 0, 0.0, 0.0
    for rises in parts:
        changed = rises[np.abs(rises) >= _CHANGED].astype(np.float64)
        if len(changed):
            most = float(changed[np.abs(changed).argmax()])
            largest = most if abs(most) > abs(largest) else largest
        count, total = count + len(changed), total + float(changed.sum())
    return Change(name, answer, count, count * cell**2, total / max(count, 1), largest)
