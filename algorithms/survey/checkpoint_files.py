"""Checkpoints: points that were surveyed on the ground, from tables and vector files."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Mapping, Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..crs.stated import stated_wkt
from .point_tables import (
    SUFFIXES,
    columns_in,
    number_of,
    places_without_names,
    read_table,
    recognised,
)
from .shapes import Geometry, Place, Shapes, located
from .vector_files import read_points

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
        be in the CRS that their file states (`Shapes`).
    names : tuple of str
        Their names.
    covers : tuple of str
        The land cover of each; empty if it is not known.

    Raises
    ------
    BareEarthError
        If there are none, or too many.
    """

    places: Sequence[np.ndarray]
    names: tuple[str, ...]
    covers: tuple[str, ...]

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
    ) -> Checkpoints:
        """Return checkpoints in the CRS of the points.

        Parameters
        ----------
        places : array_like of float, shape (n, 3)
            x, y and z of each.
        names, covers : sequence of str, optional
            Names, by default numbers from 1 on, and land covers.

        Examples
        --------
        >>> Checkpoints.of([(1.0, 2.0, 3.0)], covers=["forest"]).names
        ('1',)
        """
        rows = tuple(np.asarray(each, dtype=np.float64).reshape(1, 3) for each in places)
        numbers = (str(each) for each in range(1, len(rows) + 1))
        return cls(rows, tuple(names or numbers), tuple(covers or [""] * len(rows)))

    @property
    def count(self) -> int:
        """Number of checkpoints."""
        return len(self.places)

    @property
    def xyz(self) -> np.ndarray:
        """x, y and z of all, shape (n, 3)."""
        return np.concatenate(self.places)

    def located(self, place: Place, progress: Progress = SILENT, near: float = 0.0) -> Checkpoints:
        """Return them in the CRS of the points; see `Geometry.located`.

        Parameters
        ----------
        place, progress
            As for `Geometry.located`.
        near : float
            It is an error if all lie farther from the points than this, in metres.

        Raises
        ------
        BareEarthError
            As for `Geometry.located`, and if x and y seem to be exchanged.
        """
        x, y, _ = self.xyz.T
        if place.box is not None and not _inside(x, y, place.box) and _inside(y, x, place.box):
            raise BareEarthError(
                "No checkpoint lies in the points, but some would if x and y were exchanged. Say"
                " which columns they are, such as x=East,y=North or x=3,y=2."
            )
        return replace(self, places=located(self.places, "the checkpoints", place, progress, near))


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
        A text file with one point in each row, as for `read_table`, or a vector file as for
        `read_points`.
    columns : str, optional
        Columns or attributes in place of those that are recognised by their names, such as
        ``x=E,y=N,z=H,cover=Class,name=ID``. Those of tables can also be numbers from 1 on. A column
        for z counts before the z of a geometry.
    crs : str, optional
        The CRS of x and y, as for `stated_wkt`; it replaces what the file states. Without it, a
        table is in the CRS of the points.

    Raises
    ------
    BareEarthError
        If the file cannot be read, a column is missing, or a height is.
    """
    chosen = columns_in(columns)
    if Path(path).suffix.lower() == ".wkt":
        raise BareEarthError(f"{path} holds no names and land covers. Give CSV or GeoJSON.")
    is_table = Path(path).suffix.lower() in SUFFIXES
    rows, stated = _of_table(Path(path), chosen) if is_table else _of_layer(path, chosen)
    names = [name or str(number) for number, (_, name, _) in enumerate(rows, start=1)]
    places = Shapes([each[0] for each in rows], stated_wkt(crs) or stated, str(path))
    return Checkpoints(places, tuple(names), tuple(each[2] for each in rows))


_Row = tuple[np.ndarray, str, str]


def _of_table(path: Path, chosen: Mapping[str, str]) -> tuple[list[_Row], None]:
    """Return place, name and cover of each row of a table; tables state no CRS."""
    table = read_table(path)
    if table.names is not None:
        places = recognised(table.names, chosen, path)
    else:
        width = max(map(len, table.rows))
        numbers = [str(each) for each in range(1, width + 1)]
        places = {**places_without_names(table.rows), **recognised(numbers, chosen, path)}
    missing = [axis for axis in "xyz" if axis not in places]
    if missing:
        raise BareEarthError(
            f"{path} has no column that is known as {' and '.join(missing)} among"
            f" {', '.join(table.names or ())}. Say which it is, such as"
            f" {missing[0]}={(table.names or ('NAME',))[-1]} for the columns."
        )
    found: list[_Row] = []
    for number, row in zip(table.numbers, table.rows):
        cells = {role: row[each] if each < len(row) else "" for role, each in places.items()}
        place = [number_of(cells[axis]) for axis in "xyz"]
        if None in place:
            axis = "xyz"[place.index(None)]
            raise BareEarthError(
                f"Line {number} of {path} has no number for {axis}, but {cells[axis]!r}. Correct"
                " it, or say which column it is."
            )
        name, cover = (_word(cells.get(role)) for role in ("name", "cover"))
        found.append((np.array([place], dtype=np.float64), name, cover))
    return found, None


def _of_layer(path: Path | str, chosen: Mapping[str, str]) -> tuple[list[_Row], str | None]:
    """Return place, name and cover of each point of a vector file, and the CRS that it states."""
    points = read_points(Path(path))
    fields = list(dict.fromkeys(field for _, attributes in points for field in attributes))
    places = recognised(fields, {k: v for k, v in chosen.items() if k not in "xy"}, path)
    has_z = not any(np.isnan(place[2]) for place, _ in points)
    if not has_z and "z" not in places:
        raise BareEarthError(
            f"The points of {path} have no heights: neither their geometry nor an attribute that is"
            f" known as z has one ({', '.join(fields) or 'there are none'}). Say which attribute it"
            " is, such as z=HEIGHT for the columns."
        )
    found: list[_Row] = []
    for number, (place, attributes) in enumerate(points, start=1):
        cells = {role: attributes.get(fields[each]) for role, each in places.items()}
        if "z" in chosen or not has_z:
            height = number_of(cells["z"]) if cells["z"] is not None else None
            if height is None:
                raise BareEarthError(
                    f"Point {number} of {path} has no number for its height, but {cells['z']!r}."
                    " Correct it, or say which attribute it is."
                )
            place = np.array([*place[:2], height])
        name, cover = (_word(cells.get(role)) for role in ("name", "cover"))
        found.append((place.reshape(1, 3), name, cover))
    return found, getattr(points, "crs", None)


def _word(value: Any) -> str:
    """Return a name or a land cover as text."""
    if value is None or (isinstance(value, float) and np.isnan(value)):
        return ""
    is_whole = isinstance(value, float) and value.is_integer()
    return str(int(value) if is_whole else value).strip()
