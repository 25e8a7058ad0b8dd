"""Surveyed points from the rows of a table or of a layer: which column holds what."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any, Mapping, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from ...core.errors import BareEarthError
from .column_names import ColumnName, columns_of, parts_of
from .tables import number_of

# Heights that stand for none.
_NODATA = (-9999.0, -999.0, -32768.0, -32767.0)
_LIMIT = 50_000.0
# A column of such a name may say yes or no.
_PLANTS = ("vegetation", "vegetated", "vegetacion", "vegetatie", "begroeiing", "bewuchs")
_YES = ("yes", "y", "true", "1", "ja", "j", "oui", "si", "sí", "x")
_NO = ("no", "n", "false", "0", "none", "nein", "non", "nee", "geen", "keine", "kein", "aucune")
# Two columns of heights that differ by less, in metres, hold the same.
_SAME = 0.002


class Record(NamedTuple):
    """A row of a table, or a point of a layer."""

    where: str  # the row, for messages
    cells: Sequence[Any]  # the value of each column
    place: np.ndarray | None = None  # float64 (3,); z is NaN without one, None for rows of tables


# Where heights stand, the heights, and metres in a unit of them if it is known.
OtherHeights = Tuple[str, np.ndarray, Optional[float]]


class SurveyedPoints(NamedTuple):
    """Points with what their columns say."""

    places: np.ndarray  # float64 (n, 3), x, y and z as they are written
    names: tuple[str, ...]
    covers: tuple[str, ...]  # land covers
    types: tuple[str, ...]  # uses
    # Metres in a unit of x and y, and of z, if names of columns state them.
    units: tuple[float | None, float | None] = (None, None)
    notes: tuple[str, ...] = ()  # what the user must know about the choice of columns
    is_ordered: bool = True  # whether it is known which column is x
    # Other heights: where they stand, float64 (n,), and their unit.
    others: tuple[OtherHeights, ...] = ()

    @classmethod
    def of(
        cls,
        names: Sequence[str],
        records: Sequence[Record],
        chosen: Mapping[str, str],  # columns of x, y, z, cover, type and name
        path: Path | str,
        usual: Mapping[str, int] | None = None,  # columns of a table without names
    ) -> SurveyedPoints:
        """Return the points of rows, at least one; refuse a missing column or coordinate."""
        if records[0].place is not None:
            chosen = {role: name for role, name in chosen.items() if role not in "xy"}
        given = {role: found for role, found in columns_of(names, chosen, path).items() if found}
        columns = {**{role: [column] for role, column in (usual or {}).items()}, **given}
        is_ordered = usual is None or not {"x", "y"}.isdisjoint(chosen)
        reader = _Reader(names, list(records), columns, "z" in chosen, str(path))
        return _with_kind_of_file(reader.points(is_ordered), str(path))


class _Reader(NamedTuple):
    """Reads points from rows; `columns` are those that can hold each role, the best first."""

    names: Sequence[str]
    records: list[Record]
    columns: dict[str, list[int]]
    has_chosen: bool  # whether the user chose the column of z
    path: str

    def points(self, is_ordered: bool) -> SurveyedPoints:
        """Return the points."""
        if self.records[0].place is not None:
            heights, unit, notes = self._heights_of_layer()
            x, y = np.array([record.place[:2] for record in self.records]).T  # type: ignore[index]
            across, kept = None, self
        else:
            axes = self._axes()
            kept, notes = self._with_values(axes)
            x, y, heights = (kept._numbers(axes[axis], axis) for axis in "xyz")
            across, unit = (ColumnName.of(self.names[axes[axis]]).unit for axis in "xz")
            notes = (*notes, *kept._other_heights(axes["z"]))
        texts = (kept._texts(role) for role in ("name", "cover", "type"))
        names, covers, types = texts
        numbered = (name or str(number) for number, name in enumerate(names, start=1))
        return SurveyedPoints(
            np.column_stack((x, y, heights)), tuple(numbered), covers, types, (across, unit), notes,
            is_ordered, () if self.has_chosen else kept._candidates(),
        )  # fmt: skip

    def _axes(self) -> dict[str, int]:
        """Return the columns of x, y and z of a table."""
        missing = [axis for axis in "xyz" if axis not in self.columns]
        if missing:
            raise BareEarthError(
                f"{self.path} has no column that is known as {' and '.join(missing)} among"
                f" {', '.join(self.names)}. Say which it is, such as"
                f" {missing[0]}={self.names[-1]} for the columns."
            )
        return {axis: self._best(axis) for axis in "xyz"}

    def _best(self, role: str) -> int:
        """Return the first column with a number in each row, or in some, or the first."""
        counts = [np.isfinite(self._values(each)).sum() for each in self.columns[role]]
        return self.columns[role][int(np.argmax(counts))]

    def _values(self, column: int) -> np.ndarray:
        """Return the numbers in a column; NaN where there is none, or one that stands for none."""
        found = [number_of(record.cells[column]) for record in self.records]
        values = np.array([np.nan if each is None else each for each in found])
        return np.where(_is_height(values), values, np.nan) if column in self._of_z else values

    @property
    def _of_z(self) -> list[int]:
        return self.columns.get("z", [])

    def _with_values(self, axes: Mapping[str, int]) -> tuple[_Reader, tuple[str, ...]]:
        """Return the same with the rows that have any coordinate, and a note on the others."""
        is_empty = [
            all(_word(record.cells[axes[axis]]) == "" for axis in "xyz") for record in self.records
        ]
        kept = [record for record, empty in zip(self.records, is_empty) if not empty]
        left = [record for record, empty in zip(self.records, is_empty) if empty]
        if not left:
            return self, ()
        if not kept:
            raise BareEarthError(f"{self.path} holds no coordinates. Give a table of points.")
        rows = "1 row" if len(left) == 1 else f"{len(left):,} rows"
        note = f"{self.path} has no coordinates in {rows}, which are left out: {left[0].where}"
        return self._replace(records=kept), (f"{note}{' and others' if left[1:] else ''}.",)

    def _numbers(self, column: int, axis: str) -> np.ndarray:
        """Return the numbers in a column; refuse rows without one."""
        values = self._values(column)
        if np.isnan(values).any():
            record = self.records[int(np.argmax(np.isnan(values)))]
            is_layer = record.place is not None
            raise BareEarthError(
                f"{record.where} has no number for {'its height' if is_layer else axis}, but"
                f" {record.cells[column]!r}. Correct it, or say which"
                f" {'attribute' if is_layer else 'column'} it is."
            )
        return values

    def _other_heights(self, column: int) -> tuple[str, ...]:
        """Return notes on heights above the ellipsoid, and on other columns of heights."""
        heights = self._metres(column)
        others = [
            self.names[each]
            for each in self.columns["z"]
            if each != column and _differ(self._metres(each), heights)
        ]
        notes = []
        if others:
            notes.append(
                f"The heights of the checkpoints are those of the column {self.names[column]}, not"
                f" of {' and '.join(others)}."
            )
        if ColumnName.of(self.names[column]).height_kind == 2:
            notes.append(
                f"The heights in the column {self.names[column]} are above the ellipsoid, by its"
                " name. They must be of the vertical datum of the points."
            )
        return tuple(notes)

    def _metres(self, column: int) -> np.ndarray:
        return self._values(column) * (ColumnName.of(self.names[column]).unit or 1.0)

    def _heights_of_layer(self) -> tuple[np.ndarray, float | None, tuple[str, ...]]:
        """Return the heights of points of a layer, their unit, and notes on their choice."""
        given = np.array([record.place[2] for record in self.records])  # type: ignore[index]
        column = self._best("z") if self._of_z else None
        if column is None:
            return self._of_geometry(given), None, ()
        name = self.names[column]
        if not self.has_chosen and self._geometry_counts(given, column):
            note = (
                f"The heights of the checkpoints are z of the points, not the attribute {name}."
                f" z={name} for the columns takes these."
            )
            is_other = _differ(given, self._metres(column)) and _differ(given, self._values(column))
            return self._of_geometry(given), None, (note,) * is_other
        notes = self._other_heights(column)
        if not self.has_chosen and _differ(given, self._metres(column)):
            note = f"The heights of the checkpoints are the attribute {name}, not z of the points."
            notes = (*notes, note)
        return self._numbers(column, "z"), ColumnName.of(name).unit, notes

    def _of_geometry(self, given: np.ndarray) -> np.ndarray:
        """Return z of the points; refuse what is missing."""
        if np.isnan(given).any():
            fields = ", ".join(self.names) or "there are none"
            raise BareEarthError(
                f"The points of {self.path} have no heights: neither their geometry nor an"
                f" attribute that is known as z has one ({fields}). Say which attribute it is, such"
                " as z=HEIGHT for the columns."
            )
        if not _is_height(given).all() or not given.any():
            wrong = given[np.argmax(~_is_height(given))]
            raise BareEarthError(
                f"The points of {self.path} have heights of {wrong:g}, which stand for none. Say"
                " which attribute has the heights, such as z=HEIGHT for the columns."
            )
        return given

    def _candidates(self) -> tuple[OtherHeights, ...]:
        """Return all complete heights that the points may have."""
        found: list[OtherHeights] = [
            (f"the column {self.names[each]}", values, ColumnName.of(self.names[each]).unit)
            for each in self._of_z
            if np.isfinite(values := self._values(each)).all()
        ]
        places = [record.place for record in self.records]
        given = np.array([np.nan if each is None else each[2] for each in places])
        is_usable = _is_height(given).all() and given.any()
        return (*found, ("z of the points", given, None)) if is_usable else tuple(found)

    def _geometry_counts(self, given: np.ndarray, column: int) -> bool:
        """Return whether z of the points is taken, not a column with a usual name."""
        heights = self._metres(column)
        if not np.isfinite(heights).any():
            return True
        is_zero = (given == 0.0) & ~(np.abs(heights) < 1.0)
        is_one = len(given) > 2 and np.ptp(given) == 0.0 and _differ(given, heights)
        is_orthometric = ColumnName.of(self.names[column]).height_kind == 0
        return bool(_is_height(given).all() and not (is_zero.any() or is_one or is_orthometric))

    def _texts(self, role: str) -> tuple[str, ...]:
        """Return the texts of a role: of the first column that has any."""
        for column in self.columns.get(role, []):
            texts = tuple(_word(record.cells[column]) for record in self.records)
            if any(texts):
                return tuple(map(_answer, texts)) if self._asks_for_plants(column) else texts
        return ("",) * len(self.records)

    def _asks_for_plants(self, column: int) -> bool:
        words = {each.lower() for each in ColumnName.of(self.names[column]).words}
        return not words.isdisjoint(_PLANTS)


def _with_kind_of_file(found: SurveyedPoints, path: str) -> SurveyedPoints:
    """Return points with the kind that the name of their file or layer states, if none is known."""
    words = {each.lower() for each in parts_of(re.split(r"[/\\]", path)[-1])}
    kinds = sorted(words & {"nva", "vva"})
    if len(kinds) == 1 and not any(found.types) and not any(found.covers):
        kind = kinds[0].upper()
        note = f"All points of {path} count as {kind}, as the name of the file says."
        return found._replace(types=(kind,) * len(found.names), notes=(*found.notes, note))
    if "gcp" in words and not any(found.types):
        note = (
            f"{path} lists ground control points, by its name: if the points were fitted to them,"
            " they do not test these."
        )
        return found._replace(notes=(*found.notes, note))
    return found


def _answer(text: str) -> str:
    """Return yes or no to plants as a land cover."""
    answers = {**dict.fromkeys(_YES, "vegetated"), **dict.fromkeys(_NO, "not vegetated")}
    return answers.get(text.lower(), text)


def _is_height(values: np.ndarray) -> np.ndarray:
    """Return which numbers can be heights."""
    return np.isfinite(values) & (np.abs(values) < _LIMIT) & ~np.isin(values, _NODATA)


def _differ(some: np.ndarray, others: np.ndarray) -> bool:
    """Return whether two columns of heights hold different ones."""
    with np.errstate(invalid="ignore"):
        return bool((np.abs(some - others) > _SAME).any())


def _word(value: Any) -> str:
    """Return a name or a land cover as text."""
    if value is None or (isinstance(value, float) and np.isnan(value)):
        return ""
    is_whole = isinstance(value, float) and value.is_integer()
    return str(int(value) if is_whole else value).strip()
