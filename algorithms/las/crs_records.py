"""The coordinate reference system that the records of a file state."""

from __future__ import annotations

from ..core.progress import SILENT, Progress
from ..crs.geokeys import read_geokeys
from ..crs.system import Crs, crs_of_geokeys, crs_of_wkt
from .lasfile import LasFile

WKT_RECORD = ("LASF_Projection", 2112)
# The directory of the keys, their numbers and their texts.
GEOKEY_RECORDS = tuple(("LASF_Projection", number) for number in (34735, 34736, 34737))
_WKT_BIT = 0x10


def read_crs(layout: LasFile, progress: Progress = SILENT) -> Crs:
    """Return the CRS that the records of a file state.

    Well-known text and GeoTIFF keys may both be there: the global encoding of the header says which
    one holds, and the other is read where that one is not there or not understood.

    Parameters
    ----------
    layout : LasFile
        The file.
    progress : Progress
        Told which units are assumed where none is stated.
    """
    readers = [_from_geokeys, _from_wkt]
    if layout.global_encoding & _WKT_BIT:
        readers.reverse()
    for reader in readers:
        crs = reader(layout, progress)
        if crs is not None:
            return crs
    progress.warning(
        f"{layout.path.name} does not say its CRS: its coordinates are taken as metres."
    )
    return Crs()


def wkt_text(data: bytes) -> str:
    """Return the well-known text in the bytes of its record."""
    return data.split(b"\0")[0].decode("utf-8", "replace").strip()


def _from_wkt(layout: LasFile, progress: Progress) -> Crs | None:
    record = layout.vlr(WKT_RECORD)
    return crs_of_wkt(wkt_text(record.data), progress) if record and record.data else None


def _from_geokeys(layout: LasFile, progress: Progress) -> Crs | None:
    records = [layout.vlr(key) for key in GEOKEY_RECORDS]
    keys = read_geokeys(*(record.data or b"" if record else b"" for record in records))
    return None if keys is None else crs_of_geokeys(keys, progress)
