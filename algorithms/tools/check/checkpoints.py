"""Checkpoints: points that were surveyed on the ground."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Optional, Sequence, Tuple

import numpy as np

from ...core.errors import BareEarthError
from ...core.points import Box
from ...core.progress import SILENT, Progress
from ...crs.unit_names import FOOT, US_FOOT
from ...survey.shapes import Geometry, Place, Shapes, located

_MOST = 100_000
_UNIT_NAMES: dict[float | None, str] = {1.0: "metres", FOOT: "feet", US_FOOT: "US survey feet"}
# The name of a column, its heights, and metres in a unit of them if it is known.
OtherHeights = Tuple[str, np.ndarray, Optional[float]]
# Nodata values in the place of heights, in any unit; and values that are nodata only if the ground
# is more than `_ELSEWHERE` metres away.
_NODATA = (-999.0, -999.9, -999.99, -99.0, -99.9, -99.99, 9999.0, 9999.9, 9999.99, 32767.0)
_DOUBTFUL = (0.0, -1.0, 999.0)
_ELSEWHERE = 5.0
# Limits in metres or feet: no land is so low or so high.
_LOWEST, _HIGHEST = -1_500.0, 50_000.0


@dataclass(frozen=True, eq=False)
class Checkpoints(Geometry):
    """Points that were surveyed on the ground."""

    # float64 (1, 3): x, y and z of each point, in units of the CRS of the points; before `located`,
    # x and y may be in the CRS that their file states (`Shapes`), and all in `units`
    places: Sequence[np.ndarray]
    names: tuple[str, ...]  # their names
    covers: tuple[str, ...]  # the land cover of each; empty if it is not known
    # The use of each point, such as NVA, VVA or Control; empty if it is not known
    types: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()  # warnings of the reader, which `located` passes on
    # Metres in a unit of x and y, and of z, if the names of the columns state the units
    units: tuple[float | None, float | None] = (None, None)
    is_ordered: bool = True  # whether it is known which column is x
    # All columns that may hold the heights: their name, float64 (n,), and their unit; in the unit
    # of the points after `located`
    others: tuple[OtherHeights, ...] = ()

    def __post_init__(self) -> None:
        if not 0 < len(self.places) <= _MOST:
            raise BareEarthError(
                f"There are {len(self.places):,} checkpoints. Give 1 to {_MOST:,} of them."
            )

    @classmethod
    def of(
        cls,
        places: Sequence[Sequence[float]],
        names: Sequence[str] | None = None,
        covers: Sequence[str] | None = None,
        types: Sequence[str] | None = None,
    ) -> Checkpoints:
        """Return checkpoints in the CRS of the points."""
        rows = tuple(np.asarray(places, dtype=np.float64).reshape(len(places), 1, 3))
        numbers = map(str, range(1, len(rows) + 1))
        none = [""] * len(rows)
        return cls(rows, tuple(names or numbers), tuple(covers or none), tuple(types or none))

    @property
    def count(self) -> int:
        """Number of checkpoints."""
        return len(self.places)

    @property
    def xyz(self) -> np.ndarray:
        """x, y and z of all, shape (n, 3)."""
        return np.concatenate(self.places)

    def located(self, place: Place, progress: Progress = SILENT, near: float = 0.0) -> Checkpoints:
        """Return the checkpoints in the CRS and units of the points."""
        for note in self.notes:
            progress.warning(note)
        given = self._in_units(place, progress)
        if place.box is not None:
            given = given._in_order(place.box, progress)
        found = located(given.places, "the checkpoints", place, progress, near)
        return replace(given, places=found, notes=(), units=(None, None), is_ordered=True)

    def with_heights(self, heights: np.ndarray) -> Checkpoints:
        """Return the checkpoints with other heights, shape (n,)."""
        return self._moved(np.column_stack((self.xyz[:, :2], heights)))

    def _moved(self, xyz: np.ndarray) -> Checkpoints:
        """Return the checkpoints at other places in the same CRS."""
        places, rows = self.places, list(xyz[:, None])
        if isinstance(places, Shapes):
            return replace(self, places=Shapes(rows, places.crs, places.source))
        return replace(self, places=tuple(rows))

    def _in_order(self, box: Box, progress: Progress) -> Checkpoints:
        """Return the checkpoints with x before y, if the box of the points shows their order."""
        x, y, _ = self.xyz.T
        if not _inside(y, x, box):
            return self
        if _inside(x, y, box):
            if not self.is_ordered:
                progress.warning(
                    "The columns of the checkpoints have no names, and x may come first or second:"
                    " the first is taken. If it is y, say so, such as x=3,y=2 for the columns."
                )
            return self
        if self.is_ordered:
            raise BareEarthError(
                "No checkpoint lies in the points, but some would if x and y were exchanged. Say"
                " which columns they are, such as x=East,y=North or x=3,y=2."
            )
        progress.info("The columns of the checkpoints have no names: north comes before east.")
        return self._moved(self.xyz[:, [1, 0, 2]])

    def _in_units(self, place: Place, progress: Progress) -> Checkpoints:
        """Return the checkpoints in the units of the points, if the columns state other units."""
        wanted = place.crs.horizontal_unit, place.crs.vertical_unit
        across, up = factors = tuple(map(_factor, self.units, wanted))
        for name, factor, unit in zip(("x and y", "heights"), factors, self.units):
            if factor != 1.0:
                progress.info(
                    f"The {name} of the checkpoints are converted: the name of their column states"
                    f" {_UNIT_NAMES.get(unit, f'units of {unit:g} m')}."
                )
        others = tuple((name, z * _factor(unit, wanted[1]), None) for name, z, unit in self.others)
        return replace(self._moved(self.xyz * (across, across, up)), others=others)


def is_height(values: np.ndarray) -> np.ndarray:
    """Return which numbers can be heights."""
    return (values > _LOWEST) & (values < _HIGHEST) & ~np.isin(values, _NODATA)


def has_height(given: np.ndarray, ground: np.ndarray, unit: float) -> np.ndarray:
    """Return which heights of checkpoints are heights, by those of the ground there in metres."""
    with np.errstate(invalid="ignore"):
        is_elsewhere = np.abs(given * unit - ground) > _ELSEWHERE
    return is_height(given) & ~(np.isin(given, _DOUBTFUL) & is_elsewhere)


def _factor(given: float | None, wanted: float) -> float:
    """Return the factor from a unit that the name of a column states to that of the points."""
    feet = (FOOT, US_FOOT)
    # "ft" can be both feet, international and US survey. The CRS says which of them.
    both_feet = given in feet and min(abs(wanted - foot) for foot in feet) < 1e-9
    return 1.0 if given is None or both_feet else given / wanted


def _inside(x: np.ndarray, y: np.ndarray, box: Box) -> bool:
    """Return whether any place lies in a box."""
    west, south, east, north = box
    return bool(((x >= west) & (x <= east) & (y >= south) & (y <= north)).any())
