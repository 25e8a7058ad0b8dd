"""Reads the coordinate reference system from the records of a file."""

from __future__ import annotations

import functools

from ..core.progress import SILENT, Notes, Progress
from ..crs.geokeys import read_geokeys
from ..crs.matching import described, is_same_crs
from ..crs.provider import library
from ..crs.stated import HOW
from ..crs.system import Crs, crs_of_geokeys, crs_of_wkt
from .lasfile import LasFile, text_of

WKT_RECORD = ("LASF_Projection", 2112)
# Records with the directory of GeoTIFF keys, their numbers and their texts.
GEOKEY_RECORDS = tuple(("LASF_Projection", number) for number in (34735, 34736, 34737))
_WKT_BIT = 0x10


def read_crs(file: LasFile, progress: Progress = SILENT) -> Crs:
    """Return the CRS of a file: that of its records, or the one that the user states instead.

    A file can have well-known text and GeoTIFF keys. The global encoding of the header decides
    which one is valid. If that is missing or not understood, the other one is read. Most files of a
    survey have equal records, which are read only once.

    Parameters
    ----------
    file : LasFile
        The file.
    progress : Progress
        Receives a message about units that are assumed, and one if the user states another CRS than
        the file.
    """
    records = (file.vlr(key) for key in (WKT_RECORD, *GEOKEY_RECORDS))
    content = tuple(record.data or b"" if record else b"" for record in records)
    crs, messages = _stated(content, bool(file.global_encoding & _WKT_BIT), library())
    if file.stated is not None:
        crs, messages = _given(file.stated, crs)
    for tell, text in messages:
        getattr(progress, tell)(text)
    if crs is None:
        progress.warning(
            f"{file.path.name} does not say its CRS: its coordinates are taken as metres. If they"
            f" are not, give the CRS: {HOW}."
        )
    return crs or Crs()


@functools.lru_cache(maxsize=64)
def _given(wkt: str, stated: Crs | None) -> tuple[Crs | None, tuple[tuple[str, str], ...]]:
    """Return the CRS that the user gives, with messages, given the one that the file states."""
    notes = Notes()
    crs = crs_of_wkt(wkt, notes)
    if crs is not None and stated is not None and not is_same_crs(crs, stated):
        notes.info(
            f"The CRS that was given is used, {described(crs)}, and not the one that the file"
            f" states, {described(stated)}. Point clouds that are written keep their records."
        )
    return crs, tuple(notes.messages)


@functools.lru_cache(maxsize=64)
def _stated(
    content: tuple[bytes, ...], is_wkt: bool, library: object
) -> tuple[Crs | None, tuple[tuple[str, str], ...]]:
    """Return the CRS from records, with messages about it.

    The result also depends on the library for EPSG codes.
    """
    text, keys = text_of(content[0]), read_geokeys(*content[1:])
    readers = [
        lambda notes: None if keys is None else crs_of_geokeys(keys, notes),
        lambda notes: crs_of_wkt(text, notes),
    ]
    for reader in reversed(readers) if is_wkt else readers:
        notes = Notes()
        crs = reader(notes)
        if crs is not None:
            return crs, tuple(notes.messages)
    return None, ()
