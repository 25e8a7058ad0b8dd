"""Reads checkpoints from the rows of a table or the points of a layer: which column holds what."""

from __future__ import annotations

import re
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import Any, Mapping, NamedTuple, Sequence

import numpy as np

from ...core.errors import BareEarthError
from ...crs.stated import stated_wkt
from ...survey.shapes import Shapes
from ...survey.vector_files import read_points, value_of
from .checkpoints import Checkpoints, OtherHeights, is_height
from .columns import ColumnName, answer_in, columns_in, columns_of, parts_of
from .tables import SPREADSHEETS, SUFFIXES, number_of, places_without_names, read_table

# For the help of options.
FORMATS = (
    "CSV and other tables in the CRS of the points, GeoJSON, or with pyogrio GeoPackage, shapefile"
    " and others, whose CRS is transformed to that of the points"
)
# Cells without a value, as programs write them.
_EMPTY = ("", "-", "--", "nan", "null", "none", "n/a", "na", "#n/a", "nodata", "inf", "-inf")
# Two columns of heights that differ by less, in metres, hold the same.
_SAME = 0.002


class CheckpointRow(NamedTuple):
    """A row of a table, or a point of a layer."""

    where: str  # the row, for messages
    cells: Sequence[object]  # the value of each column
    place: np.ndarray | None = None  # float64 (3,); z is NaN without one, None for rows of tables


def read_checkpoints(path: Any, columns: str | None = None, crs: str | None = None) -> Checkpoints:
    """Read checkpoints from a table, a vector file, a GeoDataFrame, or GeoJSON in memory."""
    chosen, suffix = columns_in(columns), ""
    if isinstance(path, (str, PathLike)):
        path = Path(path)
        suffix = path.suffix.lower()
    if suffix in SPREADSHEETS:
        raise BareEarthError(f"{path} is a spreadsheet. Save the table as CSV, and give that file.")
    usual = None
    if suffix in SUFFIXES:
        table = read_table(path)
        stated, names = stated_wkt(table.crs), table.columns
        if table.names is None:
            usual = places_without_names(table.rows)
        records = [
            CheckpointRow(f"Line {number} of {path}", (*row, *[""] * (len(names) - len(row))))
            for number, row in zip(table.numbers, table.rows)
        ]
    else:
        points = read_points(path)
        path = getattr(points, "source", path)
        stated = getattr(points, "crs", None)
        names = list(dict.fromkeys(name for _, attributes in points for name in attributes))
        records = [
            CheckpointRow(
                f"Point {number} of {path}",
                tuple(value_of(attributes, name) for name in names),
                place,
            )
            for number, (place, attributes) in enumerate(points, start=1)
        ]
    return checkpoints_of_rows(names, records, chosen, str(path), usual, stated_wkt(crs) or stated)


def checkpoints_of_rows(
    names: Sequence[str],  # of the columns
    records: Sequence[CheckpointRow],  # at least one
    chosen: Mapping[str, str],  # columns of x, y, z, cover, type and name
    path: str,
    usual: Mapping[str, int] | None = None,  # columns of a table without names
    crs: str | None = None,  # of x and y; None for that of the points
) -> Checkpoints:
    """Return the checkpoints of a table or a layer; refuse a missing column or coordinate."""
    is_layer = records[0].place is not None
    if is_layer:
        chosen = {role: name for role, name in chosen.items() if role not in "xy"}
    columns = {role: [column] for role, column in (usual or {}).items()}
    columns.update(
        (role, places) for role, places in columns_of(names, chosen, path).items() if places
    )
    rows = _Rows(names, records, columns, "z" in chosen, path)
    if is_layer:
        across = None
        z, up, notes = rows.heights_of_layer()
        x, y, _ = rows.places.T
    else:
        axes = rows.axes()
        rows, notes = rows.with_values(axes)
        x, y, z = (rows.numbers(axes[axis], axis) for axis in "xyz")
        across, up = (ColumnName.of(names[axes[axis]]).unit for axis in "xz")
        notes = (*notes, *rows.notes_on(axes["z"]))
    xyz = np.column_stack((x, y, z))
    numbers = map(str, range(1, len(xyz) + 1))
    labels = tuple(name or number for name, number in zip(rows.texts("name"), numbers))
    found = Checkpoints(
        Shapes(list(xyz[:, None]), crs, path), labels, rows.texts("cover"), rows.texts("type"),
        notes, (None if crs else across, up), usual is None or not {"x", "y"}.isdisjoint(chosen),
        () if rows.has_chosen else rows.other_heights(),
    )  # fmt: skip
    return _with_kind_of_file(found, path)


class _Rows(NamedTuple):
    """Rows, and the columns that can hold each role, the best first."""

    names: Sequence[str]
    records: Sequence[CheckpointRow]
    columns: Mapping[str, list[int]]
    has_chosen: bool  # whether the user chose the column of z
    path: str

    def axes(self) -> dict[str, int]:
        """Return the columns of x, y and z of a table."""
        missing = [axis for axis in "xyz" if axis not in self.columns]
        if missing:
            raise BareEarthError(
                f"{self.path} has no column that is known as {' and '.join(missing)} among"
                f" {', '.join(self.names)}. Say which it is, such as"
                f" {missing[0]}={self.names[-1]} for the columns."
            )
        return {axis: self._best(axis) for axis in "xyz"}

    def with_values(self, axes: Mapping[str, int]) -> tuple[_Rows, tuple[str, ...]]:
        """Return the rows with any coordinate, and a note on the other rows."""
        cells = [
            [_word(record.cells[column]) for column in axes.values()] for record in self.records
        ]
        kept = [record for record, words in zip(self.records, cells) if any(words)]
        left = [record for record, words in zip(self.records, cells) if not any(words)]
        if not left:
            return self, ()
        if not kept:
            raise BareEarthError(f"{self.path} holds no coordinates. Give a table of points.")
        rows = "1 row" if len(left) == 1 else f"{len(left):,} rows"
        note = f"{self.path} has no coordinates in {rows}, which are left out: {left[0].where}"
        return self._replace(records=kept), (f"{note}{' and others' if left[1:] else ''}.",)

    def heights_of_layer(self) -> tuple[np.ndarray, float | None, tuple[str, ...]]:
        """Return the heights of points of a layer, their unit, and notes on their choice."""
        given = self.places[:, 2]
        if not self._of_z:
            return self._of_geometry(given), None, ()
        column = self._best("z")
        name, heights = self.names[column], self._metres(column)
        if not self.has_chosen and self._geometry_counts(given, column):
            note = (
                f"The heights of the checkpoints are z of the points, not the attribute {name}."
                f" z={name} for the columns takes these."
            )
            is_other = _differ(given, heights) and _differ(given, self._values(column))
            return self._of_geometry(given), None, (note,) * is_other
        notes = self.notes_on(column)
        if not self.has_chosen and _differ(given, heights):
            note = f"The heights of the checkpoints are the attribute {name}, not z of the points."
            notes = (*notes, note)
        return self.numbers(column, "z"), ColumnName.of(name).unit, notes

    @property
    def places(self) -> np.ndarray:
        """x, y and z of the points of a layer, shape (n, 3); NaN for rows of a table."""
        nowhere = np.full(3, np.nan)
        return np.array([nowhere if r.place is None else r.place for r in self.records])

    @property
    def _of_z(self) -> list[int]:
        return self.columns.get("z", [])

    def _best(self, role: str) -> int:
        """Return the first column with a number in each row, or in some, or the first."""
        counts = [np.isfinite(self._values(column)).sum() for column in self.columns[role]]
        return self.columns[role][int(np.argmax(counts))]

    def _values(self, column: int) -> np.ndarray:
        """Return the numbers in a column; NaN for other texts, and for nodata among heights."""
        values = np.array([number_of(r.cells[column]) for r in self.records], dtype=np.float64)
        return np.where(is_height(values), values, np.nan) if column in self._of_z else values

    def _metres(self, column: int) -> np.ndarray:
        return self._values(column) * (ColumnName.of(self.names[column]).unit or 1.0)

    def numbers(self, column: int, axis: str) -> np.ndarray:
        """Return the numbers in a column, NaN for missing heights of some rows; refuse rows without
        x or y, or with another text.
        """
        values = self._values(column)
        is_wrong = np.isnan(values)
        if axis == "z" and not is_wrong.all():
            is_wrong &= [not _is_empty(record.cells[column]) for record in self.records]
        if is_wrong.any():
            record = self.records[int(np.argmax(is_wrong))]
            is_layer = record.place is not None
            raise BareEarthError(
                f"{record.where} has no number for {'its height' if is_layer else axis}, but"
                f" {record.cells[column]!r}. Correct it, or say which"
                f" {'attribute' if is_layer else 'column'} it is."
            )
        return values

    def notes_on(self, column: int) -> tuple[str, ...]:
        """Return notes on heights above the ellipsoid, and on other columns of heights."""
        name, heights, notes = self.names[column], self._metres(column), []
        others = [
            self.names[place]
            for place in self.columns["z"]
            if place != column and _differ(self._metres(place), heights)
        ]
        if others:
            notes.append(
                f"The heights of the checkpoints are those of the column {name}, not"
                f" of {' and '.join(others)}."
            )
        if ColumnName.of(name).height_kind == 2:
            notes.append(
                f"The heights in the column {name} are above the ellipsoid, by its"
                " name. They must be of the vertical datum of the points."
            )
        return tuple(notes)

    def _of_geometry(self, given: np.ndarray) -> np.ndarray:
        """Return z of the points; refuse what is missing."""
        if np.isnan(given).all():
            fields = ", ".join(self.names) or "there are none"
            raise BareEarthError(
                f"The points of {self.path} have no heights: neither their geometry nor an"
                f" attribute that is known as z has one ({fields}). Say which attribute it is, such"
                " as z=HEIGHT for the columns."
            )
        known = is_height(given)
        if not given[known].any():
            wrong = given[np.argmax(known if known.any() else ~np.isnan(given))]
            raise BareEarthError(
                f"The points of {self.path} have heights of {wrong:g}, a nodata value. Say which"
                " attribute has the heights, such as z=HEIGHT for the columns."
            )
        return np.where(known, given, np.nan)

    def _geometry_counts(self, given: np.ndarray, column: int) -> bool:
        """Return whether z of the points is taken, not a column with a usual name."""
        heights = self._metres(column)
        if not np.isfinite(heights).any():
            return True
        is_zero = (given == 0.0) & ~(np.abs(heights) < 1.0)
        is_one = len(given) > 2 and np.ptp(given) == 0.0 and _differ(given, heights)
        is_orthometric = ColumnName.of(self.names[column]).height_kind == 0
        return bool(is_height(given).all() and not (is_zero.any() or is_one or is_orthometric))

    def other_heights(self) -> tuple[OtherHeights, ...]:
        """Return all complete heights that the points may have."""
        found: list[OtherHeights] = [
            (f"the column {self.names[column]}", values, ColumnName.of(self.names[column]).unit)
            for column in self._of_z
            if np.isfinite(values := self._values(column)).all()
        ]
        given = self.places[:, 2]
        if is_height(given).all() and given.any():
            found.append(("z of the points", given, None))
        return tuple(found)

    def texts(self, role: str) -> tuple[str, ...]:
        """Return the texts of a role: of the first column that has any."""
        for column in self.columns.get(role, []):
            texts = tuple(_word(record.cells[column]) for record in self.records)
            if any(texts):
                return tuple(answer_in(text, self.names[column]) for text in texts)
        return ("",) * len(self.records)


def _with_kind_of_file(found: Checkpoints, path: str) -> Checkpoints:
    """Return points with the kind that the name of their file or layer states, if none is known."""
    if any(found.types):
        return found
    words = {word.lower() for word in parts_of(re.split(r"[/\\]", path)[-1])}
    kinds, note = words & {"nva", "vva"}, ""
    if len(kinds) == 1 and not any(found.covers):
        kind = kinds.pop().upper()
        note = f"All points of {path} count as {kind}, as the name of the file says."
        found = replace(found, types=(kind,) * found.count)
    elif "gcp" in words or all("gcp" in map(str.lower, parts_of(name)) for name in found.names):
        note = (
            f"{path} lists ground control points, by its name or theirs: if the points were fitted"
            " to them, they do not test these."
        )
    return replace(found, notes=(*found.notes, note)) if note else found


def _is_empty(cell: object) -> bool:
    """Return whether a cell holds a number, or a word for a missing one."""
    return number_of(cell) is not None or _word(cell).lower() in _EMPTY


def _differ(heights: np.ndarray, others: np.ndarray) -> bool:
    """Return whether two columns of heights hold different ones."""
    with np.errstate(invalid="ignore"):
        return bool((np.abs(heights - others) > _SAME).any())


def _word(value: object) -> str:
    """Return a name or a land cover as text."""
    if value is None or (isinstance(value, float) and np.isnan(value)):
        return ""
    if isinstance(value, float) and value.is_integer():
        value = int(value)
    return str(value).strip()
