"""Reads the coordinate reference system from the records of a file."""

from __future__ import annotations

import functools
import json
from typing import Protocol, Sequence

from ..core.progress import SILENT, Notes, Progress
from ..crs.geokeys import read_geokeys
from ..crs.matching import described, has_same_units, is_same_crs
from ..crs.provider import library, wkt_of_text
from ..crs.records import crs_of_records
from ..crs.stated import how_to_state
from ..crs.system import Crs, crs_of_wkt
from .lasfile import FIRST_EXTENDED_FORMAT, LasFile, text_of

WKT_RECORD = ("LASF_Projection", 2112)
# Records with the directory of GeoTIFF keys, their numbers and their texts.
GEOKEY_RECORDS = tuple(("LASF_Projection", number) for number in (34735, 34736, 34737))
# Records with well-known text and PROJJSON that are not in the LAS specification.
_OTHER_WKT = (("LASF_Projection", 4224), ("PDAL", 4224), ("liblas", 2112))
_PROJJSON = (("LASF_Projection", 4225), ("PDAL", 4225))
# All records with a CRS: none may stay in a file whose CRS changes.
CRS_RECORDS = (WKT_RECORD, *GEOKEY_RECORDS, *_OTHER_WKT, *_PROJJSON)
_LONGEST_PROJJSON = 100_000
_WKT_BIT = 0x10


class CrsRecord(Protocol):
    """A VLR or an EVLR."""

    @property
    def key(self) -> tuple[str, int]:
        """User id and record id."""

    @property
    def data(self) -> bytes | None:
        """The bytes after the header of the record, None if they were not read."""


def read_crs(file: LasFile, progress: Progress = SILENT) -> Crs:
    """Return the CRS of a file: that of its records, or the one that the user states instead;
    report differences between both, and assumed units.
    """
    prefers_text = bool(file.global_encoding & _WKT_BIT)
    prefers_text |= file.point_format >= FIRST_EXTENDED_FORMAT
    every: tuple[CrsRecord, ...] = (*file.vlrs, *file.evlrs)
    return crs_among(every, prefers_text, file.stated, file.path.name, progress)


def crs_among(
    every: Sequence[CrsRecord],
    prefers_text: bool,
    stated: str | None,
    name: str,
    progress: Progress,
) -> Crs:
    """Return the CRS of a file, given its name, all of its records, and the WKT of the CRS that the
    user states; see `read_crs`.
    """
    # A file can have both well-known text and GeoTIFF keys. Point formats 6 to 10 need text; for
    # others, the global encoding in the header says which one is valid. Facts that it lacks come
    # from the other one.
    texts = _data_of(every, (WKT_RECORD,)), _data_of(every, _OTHER_WKT), _data_of(every, _PROJJSON)
    records = (next((one for one in every if one.key == key), None) for key in GEOKEY_RECORDS)
    keys = tuple(record.data or b"" if record else b"" for record in records)
    crs, messages = _stated(*texts, keys, prefers_text, library())
    if stated is not None:
        crs, messages = _given(stated, crs)
    for tell, text in messages:
        getattr(progress, tell)(text)
    if crs is None:
        progress.warning(
            f"{name} does not say its CRS: its coordinates are taken as metres. If they are not,"
            f" give the CRS: {how_to_state()}."
        )
    return crs or Crs()


def _data_of(every: Sequence[CrsRecord], keys: Sequence[tuple[str, int]]) -> tuple[bytes, ...]:
    """Return the different contents of records with some keys, in the order of the keys."""
    contents = (record.data or b"" for key in keys for record in every if record.key == key)
    return tuple(dict.fromkeys(contents))


@functools.lru_cache(maxsize=64)
def _given(wkt: str, stated: Crs | None) -> tuple[Crs | None, tuple[tuple[str, str], ...]]:
    """Return the CRS that the user gives, with messages, given the one that the file states."""
    notes = Notes()
    crs = crs_of_wkt(wkt, notes)
    if crs is not None and stated is not None and not is_same_crs(crs, stated):
        tell = notes.info if has_same_units(crs, stated) else notes.warning
        tell(
            f"The CRS that was given is used, {described(crs)}, and not the one that the file"
            f" states, {described(stated)}. Point clouds that are written keep their records."
        )
    return crs, tuple(notes.messages)


@functools.lru_cache(maxsize=64)
def _stated(
    texts: tuple[bytes, ...],
    others: tuple[bytes, ...],
    projjson: tuple[bytes, ...],
    keys: tuple[bytes, ...],
    prefers_text: bool,
    library: object,
) -> tuple[Crs | None, tuple[tuple[str, str], ...]]:
    notes = Notes()
    every = [text_of(data) for data in (*texts, *others)]
    geokeys = read_geokeys(*keys)
    crs = crs_of_records(every, geokeys, prefers_text, notes)
    if crs is None and projjson:
        every = [text for data in projjson if (text := _wkt_of_projjson(text_of(data)))]
        crs = crs_of_records(every, geokeys, prefers_text, notes)
        if crs is None:
            lack = "without pyproj: pip install pyproj" if library is None else "here"
            notes.warning(f"The record {_PROJJSON[0][1]} (PROJJSON) states a CRS, but cannot be"
                          f" read {lack}.")  # fmt: skip
    return crs, tuple(notes.messages)


def _wkt_of_projjson(text: str) -> str | None:
    """Return the well-known text of a CRS in PROJJSON, None if no library understands it."""
    if len(text) > _LONGEST_PROJJSON or not text.startswith("{"):
        return None
    try:
        # The address of the schema is left out, since it is not needed.
        return wkt_of_text(json.dumps({**json.loads(text), "$schema": ""}))
    except (ValueError, RecursionError):
        return None
