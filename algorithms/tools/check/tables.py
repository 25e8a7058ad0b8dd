"""Tables of points: text files, whose delimiter, decimal sign and header are recognised."""

from __future__ import annotations

import csv
import math
import re
from itertools import zip_longest
from pathlib import Path
from typing import NamedTuple, Sequence

from ...core.errors import BareEarthError
from ...las.sources import open_source
from .columns import ColumnName, columns_of

# Endings of tables; other files are vector files.
SUFFIXES = (".csv", ".txt", ".tsv", ".tab", ".xyz", ".dat", ".pts")
SPREADSHEETS = (".xlsx", ".xlsm", ".xlsb", ".xls", ".ods", ".numbers")
_DELIMITERS = (";", "\t", "|", ",", " ")
# Rows that are looked at to find the delimiter.
_SAMPLE = 50
_COMMENTS = ("#", "//", "%", "!")
# A line with the CRS: the first one in lists of ODM, a comment in lists of Agisoft.
_CRS = re.compile(
    r"(?:[#/%!\s]*(?:coordinate\s?system|crs|srs|projection)\s*[:=]\s*)?"
    r"(EPSG:\d+|\+proj=.+|(?:PROJ|GEOG|COMPD|PROJCRS|GEOGCRS)[A-Z]*\[.+|WGS ?84 UTM ?\d+ ?[NS])\s*",
    re.IGNORECASE,
)
_UTM = re.compile(r"WGS ?84 UTM ?(\d+) ?([NS])", re.IGNORECASE)
_IMAGE = re.compile(r".+\.(jpe?g|tiff?|png|dng|raw|arw|cr2|nef)", re.IGNORECASE)
# Prefix of names in lists of ODM for points that its adjustment does not use.
_CHECK = "CHK-"


class Table(NamedTuple):
    """The cells of a table."""

    names: tuple[str, ...] | None  # of the columns; None without a header
    rows: list[list[str]]  # the cells
    numbers: list[int]  # the line of each row in the file
    crs: str | None = None  # that it states

    @property
    def columns(self) -> list[str]:
        """The names of the columns, or their numbers from 1 on."""
        width = max(map(len, self.rows))
        return [*(self.names or map(str, range(1, width + 1)))]


class _Line(NamedTuple):
    """A line of a file that is not empty."""

    number: int
    text: str
    is_comment: bool


def read_table(path: Path) -> Table:
    """Read a text file with one point in each row, in UTF-8, UTF-16 or the code page 1252; refuse
    one without rows with three numbers.
    """
    # Cells are separated by semicolons, tabs, bars, commas or spaces. Rows without any value and
    # lines that begin with #, //, % or ! are skipped; one of those before the first row may hold
    # the names of the columns, or the CRS.
    lines, crs = _lines_of(path)
    sample = [line.text for line in lines if not line.is_comment][:_SAMPLE]
    counts = {sign: sum(map(_is_point, _cells(sample, sign))) for sign in _DELIMITERS}
    delimiter = max(counts, key=counts.__getitem__)
    if not counts[delimiter]:
        raise BareEarthError(
            f"{path} holds no table of points: no row has three numbers. Give a text file with the"
            " columns x, y and z, such as CSV."
        )
    cells = _cells([line.text for line in lines], delimiter)
    is_row = [_is_point(row) and not line.is_comment for row, line in zip(cells, lines)]
    first = is_row.index(True)
    names, first = _header_of(cells[:first], lines[:first])
    rows, numbers = [], []
    for row, line in zip(cells[first:], lines[first:]):
        is_header = names is not None and tuple(map(str.strip, row)) == names
        if any(map(str.strip, row)) and not line.is_comment and not is_header:
            rows.append(row)
            numbers.append(line.number)
    table = Table(names, rows, numbers, crs)
    return _control_points(table) if names is None and crs is not None else table


def _lines_of(path: Path) -> tuple[list[_Line], str | None]:
    """Return the lines of a file that are not empty, and the CRS that one of them states."""
    lines: list[_Line] = []
    crs, markers = None, 0
    for number, text in enumerate(_text_of(path).splitlines(), start=1):
        stated = _CRS.fullmatch(text)
        if stated is not None:
            utm = _UTM.fullmatch(stated[1])
            crs = crs or (f"EPSG:32{'67'[utm[2] in 'sS']}{int(utm[1]):02}" if utm else stated[1])
        elif text.strip():
            is_comment = text.lstrip().startswith(_COMMENTS)
            lines.append(_Line(number, text.lstrip("#/%! ") if is_comment else text, is_comment))
            if is_comment and lines[-1].text.lower().startswith("markers"):  # cameras come before
                markers = len(lines)
    return lines[markers:], crs


def _header_of(cells: list[list[str]], lines: list[_Line]) -> tuple[tuple[str, ...] | None, int]:
    """Return the names of the columns, None for none, and the number of lines before the rows."""
    # The lines are those before the first that holds three numbers. If none of them has known
    # names, the last is the header.
    units: list[str] = []
    last, start = None, len(cells)
    for number in reversed(range(len(cells))):
        row, is_comment = cells[number], lines[number].is_comment
        roles = columns_of(row, {}, "") if len(row) >= 3 else {}
        if roles and roles["x"] and roles["y"]:
            return _with_units(row, units), start if units else number + 1
        if not is_comment and not units and last is None and _are_units(row):
            units, start = row, number + 1
        elif not is_comment and last is None and len(row) >= 3:
            last = row
    return (None if last is None else _with_units(last, units)), start


def _with_units(names: list[str], units: list[str]) -> tuple[str, ...]:
    """Return the names of the columns with the units that stand below them."""
    units = [*units, *[""] * (len(names) - len(units))]
    return tuple(f"{name.strip()} {unit.strip()}".strip() for name, unit in zip(names, units))


def _are_units(row: list[str]) -> bool:
    """Return whether a row below the names holds the units of the columns."""
    given = [ColumnName.of(f"x {cell}") for cell in row if cell.strip(" -()[]")]
    return bool(given) and all(name.words == ("x",) and name.unit for name in given)


def _control_points(table: Table) -> Table:
    """Return the points of a list of ground control points of ODM, each once."""
    # A row holds x, y, z, a place in an image, the image, and the name of the point, which may be
    # missing.
    first = table.rows[0]
    if len(first) < 6 or not _is_point(first[:5], 5) or not _IMAGE.fullmatch(first[5]):
        return table
    lines: dict[tuple[str, ...], int] = {}
    for row, number in zip(table.rows, table.numbers):
        x, y, z = (*row, "", "")[:3]
        lines.setdefault((x, y, z, row[6] if len(row) > 6 else ""), number)
    is_check = [point[-1].upper().startswith(_CHECK) for point in lines]
    usual = "control" if any(is_check) else ""
    rows = [[*point, "check" if check else usual] for point, check in zip(lines, is_check)]
    return Table(("x", "y", "z", "name", "point type"), rows, list(lines.values()), table.crs)


def places_without_names(rows: Sequence[Sequence[str]]) -> dict[str, int]:
    """Return the places of the columns of a table without a header: name, x, y, z, cover."""
    # The first column is the name if it is no number, or if it holds whole numbers before three
    # other columns of numbers. The cover is the first column of words behind z.
    columns = list(zip(*(row for row in rows[:_SAMPLE] if _is_point(row))))
    numeric = [place for place, cells in enumerate(columns) if None not in map(number_of, cells)]
    whole = [place for place in numeric if all(cell.strip().isdigit() for cell in columns[place])]
    named = 0 not in numeric or (len(numeric) > 3 and 0 in whole and whole != numeric)
    axes = [place for place in numeric if place or not named][:3]
    places = dict(zip("xyz", axes))
    if named:
        places["name"] = 0
    # Codes may be missing in some rows.
    first = max(axes, default=-1) + 1
    behind = zip_longest(*(row[first:] for row in rows[:_SAMPLE] if _is_point(row)), fillvalue="")
    for column, cells in enumerate(behind, start=first):
        given = [cell for cell in cells if cell.strip()]
        if None in map(number_of, given):
            return {**places, "cover": column}
    return places


def number_of(value: object) -> float | None:
    """Return the number in a cell such as "512345,67", "5'400'000.5" or "1.234,5"; None for other
    texts.
    """
    if isinstance(value, (int, float)):
        return float(value) if math.isfinite(value) else None
    text = re.sub("['\u2019\u00a0\u202f]", "", str(value)).strip()
    comma, point = text.rfind(","), text.rfind(".")
    if comma > point:
        text = text.replace(".", "").replace(",", "." if text.count(",") == 1 else "")
    elif comma >= 0:
        text = text.replace(",", "")
    if not re.fullmatch(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", text):
        return None
    return float(text) if math.isfinite(float(text)) else None


def _text_of(path: Path) -> str:
    """Return the contents of a text file in any usual encoding."""
    with open_source(path) as file:
        data = file.read()
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", errors="replace")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:  # of Windows, in Western Europe and America
        return data.decode("cp1252", errors="replace")


def _cells(lines: Sequence[str], delimiter: str) -> list[list[str]]:
    if delimiter == " ":
        return [line.split() for line in lines]
    # One line at a time, so that a stray quote cannot swallow the others.
    return [next(csv.reader([line], delimiter=delimiter, skipinitialspace=True)) for line in lines]


def _is_point(row: Sequence[str], least: int = 3) -> bool:
    """Return whether a row has three numbers."""
    return sum(number_of(cell) is not None for cell in row) >= least
