"""Reads the coordinate reference system from the records of a file."""

from __future__ import annotations

import functools
from typing import Protocol, Sequence

from ..core.progress import SILENT, Notes, Progress
from ..crs.geokeys import read_geokeys
from ..crs.matching import described, has_same_units, is_same_crs
from ..crs.provider import library
from ..crs.records import crs_of_records
from ..crs.stated import how_to_state
from ..crs.system import Crs, crs_of_wkt
from .lasfile import FIRST_EXTENDED_FORMAT, LasFile, text_of

WKT_RECORD = ("LASF_Projection", 2112)
# Records with the directory of GeoTIFF keys, their numbers and their texts.
GEOKEY_RECORDS = tuple(("LASF_Projection", number) for number in (34735, 34736, 34737))
_WKT_BIT = 0x10


class Record(Protocol):
    """A VLR or an EVLR."""

    @property
    def key(self) -> tuple[str, int]:
        """User id and record id."""

    @property
    def data(self) -> bytes | None:
        """The bytes after the header of the record, None if they were not read."""


def read_crs(file: LasFile, progress: Progress = SILENT) -> Crs:
    """Return the CRS of a file: that of its records, or the one that the user states instead, which
    is told if it differs, as are assumed units.
    """
    prefers_text = bool(file.global_encoding & _WKT_BIT)
    prefers_text |= file.point_format >= FIRST_EXTENDED_FORMAT
    every: tuple[Record, ...] = (*file.vlrs, *file.evlrs)
    return crs_among(every, prefers_text, file.stated, file.path.name, progress)


def crs_among(
    every: Sequence[Record], prefers_text: bool, stated: str | None, name: str, progress: Progress
) -> Crs:
    """Return the CRS of all records of a file with a name, as `read_crs` does; `stated` is the WKT
    of the one that the user states.
    """
    # A file can have well-known text and GeoTIFF keys. Point formats 6 to 10 need text; of others,
    # the global encoding of the header says which one is valid. What that lacks comes from the
    # other.
    texts = (record.data or b"" for record in every if record.key == WKT_RECORD)
    records = (next((one for one in every if one.key == key), None) for key in GEOKEY_RECORDS)
    keys = tuple(record.data or b"" if record else b"" for record in records)
    crs, messages = _stated(tuple(dict.fromkeys(texts)), keys, prefers_text, library())
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
    texts: tuple[bytes, ...], keys: tuple[bytes, ...], prefers_text: bool, library: object
) -> tuple[Crs | None, tuple[tuple[str, str], ...]]:
    """Return the CRS from records, with messages about it."""
    notes = Notes()
    crs = crs_of_records([*map(text_of, texts)], read_geokeys(*keys), prefers_text, notes)
    return crs, tuple(notes.messages)
