"""Checkpoints: points that were surveyed on the ground, from tables and vector files."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Mapping, Sequence

import numpy as np

from ...core.errors import BareEarthError
from ...core.points import Box
from ...core.progress import SILENT, Progress
from ...crs.stated import stated_wkt
from ...crs.unit_names import FOOT, US_FOOT
from ...survey.shapes import Geometry, Place, Shapes, located
from ...survey.vector_files import read_points
from .column_names import columns_in
from .surveyed_points import OtherHeights, Record, SurveyedPoints
from .tables import SUFFIXES, places_without_names, read_table

# For the help of options.
FORMATS = (
    "CSV and other tables in the CRS of the points, GeoJSON, or with pyogrio GeoPackage, shapefile"
    " and others, whose CRS is transformed to that of the points"
)
_MOST = 100_000


@dataclass(frozen=True, eq=False)
class Checkpoints(Geometry):
    """Points that were surveyed on the ground.

    Attributes
    ----------
    places : tuple of numpy.ndarray of float64, shape (1, 3)
        x, y and z of each point, in units of the CRS of the points; before `located`, x and y may
        be in the CRS that their file states (`Shapes`), and all in `units`.
    names : tuple of str
        Their names.
    covers : tuple of str
        The land cover of each; empty if it is not known.
    types : tuple of str
        What each is used for, such as NVA, VVA or Control; empty if it is not known.
    notes : tuple of str
        What their reader warns of; `located` passes it on.
    units : tuple of float or None
        Metres in a unit of x and y, and of z, if the names of the columns state these.
    is_ordered : bool
        Whether it is known which column is x.
    others : tuple of tuple
        All heights that the points may have: where they stand, numpy.ndarray of float64, shape
        (n,), and their unit; in the unit of the points after `located`.

    Raises
    ------
    BareEarthError
        If there are none, or too many.
    """

    places: Sequence[np.ndarray]
    names: tuple[str, ...]
    covers: tuple[str, ...]
    types: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    units: tuple[float | None, float | None] = (None, None)
    is_ordered: bool = True
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
        """Return checkpoints in the CRS of the points.

        Parameters
        ----------
        places : array_like of float, shape (n, 3)
            x, y and z of each.
        names, covers, types : sequence of str, optional
            Names, by default numbers from 1 on, land covers, and uses.

        Examples
        --------
        >>> Checkpoints.of([(1.0, 2.0, 3.0)], covers=["forest"]).names
        ('1',)
        """
        rows = tuple(np.asarray(each, dtype=np.float64).reshape(1, 3) for each in places)
        numbers = (str(each) for each in range(1, len(rows) + 1))
        none = [""] * len(rows)
        return cls(rows, tuple(names or numbers), tuple(covers or none), tuple(types or none))

    @classmethod
    def of_points(
        cls, found: SurveyedPoints, crs: str | None = None, source: str = ""
    ) -> Checkpoints:
        """Return what was read from a file or a layer.

        Parameters
        ----------
        found : SurveyedPoints
            The points.
        crs : str, optional
            The CRS of x and y; None for that of the points.
        source : str
            The file, for messages.
        """
        places = Shapes([each.reshape(1, 3) for each in found.places], crs, source)
        return cls(
            places, found.names, found.covers, found.types, found.notes,
            (None if crs else found.units[0], found.units[1]), found.is_ordered,
            found.others,
        )  # fmt: skip

    @property
    def count(self) -> int:
        """Number of checkpoints."""
        return len(self.places)

    @property
    def xyz(self) -> np.ndarray:
        """x, y and z of all, shape (n, 3)."""
        return np.concatenate(self.places)

    def located(self, place: Place, progress: Progress = SILENT, near: float = 0.0) -> Checkpoints:
        """Return them in the CRS and units of the points.

        Parameters
        ----------
        place : Place
            Where the points lie.
        progress : Progress
            Receives messages on what was transformed.
        near : float
            It is an error if all lie farther from the points than this, in metres.

        Raises
        ------
        BareEarthError
            If the CRS cannot be transformed, all lie outside of the points, or x and y seem to be
            exchanged.
        """
        for note in self.notes:
            progress.warning(note)
        given = self._in_units(place, progress)
        if place.box is not None:
            given = given._in_order(place.box, progress)
        found = located(given.places, "the checkpoints", place, progress, near)
        return replace(given, places=found, notes=(), units=(None, None), is_ordered=True)

    def _in_order(self, box: Box, progress: Progress) -> Checkpoints:
        """Return them with x before y, if this can be seen by where the points lie."""
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

    def with_heights(self, heights: np.ndarray) -> Checkpoints:
        """Return them with other heights, shape (n,)."""
        return self._moved(np.column_stack((self.xyz[:, :2], heights)))

    def _moved(self, rows: np.ndarray) -> Checkpoints:
        """Return them at other places of the same CRS."""
        crs, source = (getattr(self.places, each, None) for each in ("crs", "source"))
        return replace(self, places=Shapes([row.reshape(1, 3) for row in rows], crs, source or ""))

    def _in_units(self, place: Place, progress: Progress) -> Checkpoints:
        """Return them in the units of the points, where the names of columns state others."""
        wanted = place.crs.horizontal_unit, place.crs.vertical_unit
        across, up = map(_factor, self.units, wanted)
        others = tuple((name, z * _factor(unit, wanted[1]), None) for name, z, unit in self.others)
        if across == up == 1.0:
            return replace(self, others=others)
        what = {"x and y": (across, self.units[0]), "heights": (up, self.units[1])}
        for name, (factor, unit) in what.items():
            if factor != 1.0:
                progress.info(
                    f"The {name} of the checkpoints are converted: the name of their column states"
                    f" {_named(unit)}."
                )
        return replace(self._moved(self.xyz * (across, across, up)), others=others)


def _factor(given: float | None, wanted: float) -> float:
    """Return units of the points in a unit that the name of a column states."""
    feet = (FOOT, US_FOOT)
    # "ft" is said of both feet. The CRS knows which of them.
    both_feet = given in feet and min(abs(wanted - each) for each in feet) < 1e-9
    return 1.0 if given is None or both_feet else given / wanted


def _named(unit: float | None) -> str:
    names = {1.0: "metres", FOOT: "feet", US_FOOT: "US survey feet"}
    return names.get(unit or 1.0, f"units of {unit:g} m")


def _inside(x: np.ndarray, y: np.ndarray, box: Box) -> bool:
    """Return whether a place lies in a box."""
    west, south, east, north = box
    return bool(((x >= west) & (x <= east) & (y >= south) & (y <= north)).any())


def read_checkpoints(
    path: Path | str, columns: str | None = None, crs: str | None = None
) -> Checkpoints:
    """Read checkpoints from a table or a vector file.

    Parameters
    ----------
    path : Path or str
        A text file with one point in each row, in UTF-8, UTF-16 or the code page 1252, cells
        separated by semicolons, tabs, bars, commas or spaces; or a vector file of points as for
        `read_boundary`, but no .wkt.
    columns : str, optional
        Columns or attributes in place of those that are recognised by their names, such as
        ``x=E,y=N,z=H,cover=Class,type=Use,name=ID``. Those of tables can also be numbers from 1 on.
        A column for z counts before the z of a geometry.
    crs : str, optional
        The CRS of x and y in place of the one that the file states: an EPSG code, such as
        "EPSG:25832", or "EPSG:2230+6360" with that of the heights, or well-known text. If none is
        stated, a table is in the CRS of the points.

    Raises
    ------
    BareEarthError
        If the file cannot be read, a column is missing, or a height is.
    """
    chosen = columns_in(columns)
    if Path(path).suffix.lower() == ".wkt":
        raise BareEarthError(f"{path} holds no names and land covers. Give CSV or GeoJSON.")
    is_table = Path(path).suffix.lower() in SUFFIXES
    found, stated = _of_table(Path(path), chosen) if is_table else _of_layer(path, chosen)
    return Checkpoints.of_points(found, stated_wkt(crs) or stated, str(path))


def _of_table(path: Path, chosen: Mapping[str, str]) -> tuple[SurveyedPoints, str | None]:
    """Return the points of a table, and the CRS that it states."""
    table = read_table(path)
    names, usual = table.names, None
    if names is None:
        width = max(map(len, table.rows))
        names = tuple(str(each) for each in range(1, width + 1))
        usual = places_without_names(table.rows)
    records = [
        Record(f"Line {number} of {path}", (*row, *[""] * (len(names) - len(row))))
        for number, row in zip(table.numbers, table.rows)
    ]
    found = SurveyedPoints.of(names, records, chosen, path, usual)
    return found, stated_wkt(table.crs)


def _of_layer(path: Path | str, chosen: Mapping[str, str]) -> tuple[SurveyedPoints, str | None]:
    """Return the points of a vector file, and the CRS that it states."""
    points = read_points(Path(path))
    fields = list(dict.fromkeys(field for _, attributes in points for field in attributes))
    records = [
        Record(f"Point {number} of {path}", tuple(map(attributes.get, fields)), place)
        for number, (place, attributes) in enumerate(points, start=1)
    ]
    return SurveyedPoints.of(fields, records, chosen, path), getattr(points, "crs", None)
