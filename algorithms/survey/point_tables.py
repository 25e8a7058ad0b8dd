"""Tables of points: text files whose delimiter, decimal sign and columns are recognised."""

from __future__ import annotations

import csv
import math
import re
import unicodedata
from pathlib import Path
from typing import Any, Mapping, NamedTuple, Sequence

from ..core.errors import BareEarthError
from ..las.sources import open_source

# Endings of tables; other files are vector files.
SUFFIXES = (".csv", ".txt", ".tsv", ".tab", ".xyz", ".dat", ".pts")
# What a column can hold, and the names that it has in tables of several languages, as `_plain`
# returns them; earlier names count before later ones.
NAMES = {
    "x": "x e east easting eastings ost ostwert rechtswert rechts est este leste oost oosting"
    " xcoord coordx pointx xutm lon long lng longitude longitud longitudine lange laenge"
    " geolange geolaenge abscisse",
    "y": "y n north northing northings nord nordwert hochwert hoch norte noord noording ycoord"
    " coordy pointy yutm lat latitude latitud latitudine breite geobreite ordonnee",
    "z": "z h height elev elevation ele alt altitude hohe hoehe geohohe geohoehe hauteur altura"
    " cota elevacion quota altezza hoogte hojde hoyde hojd kote korkeus wysokosc rzedna vyska"
    " zcoord coordz pointz orthometric orthometricheight orthoheight nhn nn",
    "cover": "cover landcover landcoverclass landcovertype covertype vegetation landuse"
    " bodenbedeckung bedeckung landbedeckung nutzung occupation couverture cobertura copertura"
    " bodembedekking nvavva surface class klasse classe clase type category kategorie desc"
    " description",
    "name": "name id pointid pointname ptid point pt pnt nr no num number nummer punkt punktnr"
    " punktnummer pkt station label nom nombre nome numero naam navn namn gcp checkpoint",
}
_DELIMITERS = (";", "\t", "|", ",", " ")
# Rows that are looked at to find the delimiter.
_SAMPLE = 50
_LETTERS = str.maketrans({"ø": "o", "Ø": "O", "ł": "l", "Ł": "L", "ß": "ss"})
# Units and the like in names of columns, such as "Easting (m)".
_UNITS = {
    "m",
    "ft",
    "us",
    "survey",
    "meter",
    "metre",
    "meters",
    "metres",
    "feet",
    "coordinate",
    "utm",
}
_PAIR = re.compile(r"\s*(\w+)\s*=\s*(.+?)\s*$")


class Table(NamedTuple):
    """The cells of a table.

    Attributes
    ----------
    names : tuple of str or None
        The names of the columns; None if it has no header.
    rows : list of list of str
        The cells of each row.
    numbers : list of int
        The number of each row's line in the file, for messages.
    """

    names: tuple[str, ...] | None
    rows: list[list[str]]
    numbers: list[int]


def columns_in(text: str | None) -> dict[str, str]:
    """Return the columns that a user chooses, such as ``x=E,y=N,z=H,cover=Class,name=ID``.

    Raises
    ------
    BareEarthError
        If it is written in another way.
    """
    chosen = {}
    for part in filter(str.strip, (text or "").split(",")):
        pair = _PAIR.match(part)
        if pair is None or pair[1].lower() not in NAMES:
            raise BareEarthError(
                f"The columns must be written like x=E,y=N,z=H,cover=Class,name=ID, not {part!r}."
            )
        chosen[pair[1].lower()] = pair[2]
    return chosen


def recognised(names: Sequence[str], chosen: Mapping[str, str], path: Path | str) -> dict[str, int]:
    """Return the place of each column by its name: `chosen` ones, and those of usual names.

    Parameters
    ----------
    names : sequence of str
        The names of the columns.
    chosen : mapping of str to str
        Names, or numbers from 1 on, that the user gave for x, y, z, cover and name.
    path : Path or str
        The file, for messages.

    Raises
    ------
    BareEarthError
        If there is no column that the user chose.
    """
    places = {role: _place_of(each, names, path) for role, each in chosen.items()}
    plain = [_plain(each) for each in names]
    for role, words in NAMES.items():
        if role in places:
            continue
        free = (word for word in words.split() if word in plain)
        found = (plain.index(word) for word in free)
        place = next((each for each in found if each not in places.values()), None)
        if place is not None:
            places[role] = place
    return places


def _place_of(wanted: str, names: Sequence[str], path: Path | str) -> int:
    """Return the place of a column that the user gave by its name or number."""
    lower = [each.strip().lower() for each in names]
    if wanted.strip().lower() in lower:
        return lower.index(wanted.strip().lower())
    if wanted.isdigit() and 1 <= int(wanted) <= len(names):
        return int(wanted) - 1
    raise BareEarthError(f"{path} has no column {wanted}. It has {', '.join(map(str, names))}.")


def read_table(path: Path) -> Table:
    """Read a text file with one point in each row.

    Parameters
    ----------
    path : Path
        The file, in UTF-8, UTF-16 or the code page 1252. Cells are separated by semicolons, tabs,
        bars, commas or spaces. Lines that begin with # are comments, but for the first, which may
        hold the names of the columns.

    Raises
    ------
    BareEarthError
        If the file cannot be read, or holds no rows with three numbers.
    """
    lines = [
        (number, line)
        for number, line in enumerate(_text_of(path).splitlines(), start=1)
        if line.strip() and (number == 1 or not line.lstrip().startswith("#"))
    ]
    numbers, texts = [each[0] for each in lines], [each[1].lstrip("# ") for each in lines]
    counts = [_count(_cells(texts[:_SAMPLE], each)) for each in _DELIMITERS]
    if not lines or not max(counts):
        raise BareEarthError(
            f"{path} holds no table of points: no row has three numbers. Give a text file with the"
            " columns x, y and z, such as CSV."
        )
    rows = _cells(texts, _DELIMITERS[counts.index(max(counts))])
    has_header = _numbers_in(rows[0]) < 3
    names = tuple(each.strip() for each in rows[0]) if has_header else None
    return Table(names, rows[has_header:], numbers[has_header:])


def places_without_names(rows: Sequence[Sequence[str]]) -> dict[str, int]:
    """Return the places of the columns of a table without a header: name, x, y, z, cover.

    The first column is the name if it is no number, or if it holds whole numbers before three other
    columns of numbers. The cover is the first column of words behind z.
    """
    some = [row for row in rows[:_SAMPLE] if _numbers_in(row) >= 3]
    width = min(map(len, some))
    is_number = [all(number_of(row[each]) is not None for row in some) for each in range(width)]
    numeric = [each for each in range(width) if is_number[each]]
    whole = [each for each in numeric if all(row[each].strip().isdigit() for row in some)]
    named = not is_number[0] or (len(numeric) > 3 and 0 in whole and whole != numeric)
    axes = [each for each in numeric if each or not named][:3]
    places = dict(zip("xyz", axes))
    if named:
        places["name"] = 0
    words = [each for each in range(axes[-1] + 1, width) if not is_number[each]]
    return {**places, "cover": words[0]} if words else places


def number_of(value: Any) -> float | None:
    """Return the number in a cell; None if it is none.

    >>> number_of("512345,67"), number_of("5'400'000.5"), number_of("1.234,5"), number_of("P1")
    (512345.67, 5400000.5, 1234.5, None)
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


def _count(rows: Sequence[Sequence[str]]) -> int:
    """Return how many rows have three numbers."""
    return sum(_numbers_in(row) >= 3 for row in rows)


def _numbers_in(row: Sequence[str]) -> int:
    return sum(number_of(each) is not None for each in row)


def _plain(name: str) -> str:
    """Return the name of a column in small letters, without accents, signs and units."""
    text = unicodedata.normalize("NFKD", str(name).translate(_LETTERS)).lower()
    text = "".join(each for each in text if not unicodedata.combining(each))
    words = re.findall(r"[a-z0-9]+", text)
    kept = [each for each in words if each not in _UNITS]
    return "".join(kept or words)
