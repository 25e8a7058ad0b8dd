"""Point formats, header and records of COPC."""

from __future__ import annotations

import dataclasses

import numpy as np

from ..core.progress import Progress
from ..crs.system import compound_wkt
from . import header as fields
from .copc_octree import Cube
from .crs_records import GEOKEY_RECORDS, WKT_RECORD, read_crs
from .lasfile import (
    COPC_EXTENTS,
    COPC_HIERARCHY,
    COPC_INFO,
    FIRST_EXTENDED_FORMAT,
    LARGEST_VLR,
    LASZIP,
    RECORD_LENGTHS,
    WAVEFORM_PACKETS,
    Evlr,
    LasFile,
    Vlr,
    new_vlr,
    text_of,
)
from .records import HeaderCounts, as_points, laszip_vlr, named

# Bits of the global encoding.
_GPS_TIME_TYPE = 0x01
_SYNTHETIC_RETURNS = 0x08
_WKT = 0x10
_WAVEFORM_DESCRIPTORS = range(100, 355)
_WITH_WAVEFORMS = (4, 5, 9, 10)
NEW_FORMATS = (6, 6, 7, 7, 6, 7, 6, 7, 8, 6, 8)
# Degrees in one unit of scan angles since LAS 1.4.
_ANGLE_UNIT = 0.006


class Statistics(HeaderCounts):
    """Counts what header and info record state about points."""

    def __init__(self, layout: LasFile) -> None:
        super().__init__(layout)
        self._first, self._last = np.inf, -np.inf

    def add(self, records: np.ndarray) -> None:
        """Count points, given as their bytes."""
        super().add(records)
        points = named(self._layout, records)
        if "gps_time" in points.point_format.dimension_names:
            times = np.asarray(points["gps_time"])
            # Damaged times must not spoil the range.
            known = np.isfinite(times)
            self._first = float(times.min(where=known, initial=self._first))
            self._last = float(times.max(where=known, initial=self._last))

    @property
    def gps_time(self) -> tuple[float, float]:
        """The smallest and the largest GPS time; 0 and 0 if there are none."""
        return (self._first, self._last) if self._first <= self._last else (0.0, 0.0)

    @property
    def extent(self) -> tuple[np.ndarray, np.ndarray]:
        """The smallest and the largest coordinates."""
        scale, offset = np.array(self._layout.scale), np.array(self._layout.offset)
        return self.lowest * scale + offset, self.highest * scale + offset

    @property
    def cube(self) -> Cube:
        """The cube of the octree."""
        # Its corner has the smallest coordinates of the header, since some readers take these
        # instead of the corner in the info record.
        (lowest, highest), scale = self.extent, self._layout.scale
        side = max(float((highest - lowest).max()), *scale)
        return Cube(tuple(lowest.tolist()), side, scale, self._layout.offset)


def stated_cube(layout: LasFile) -> Cube:
    """Return the cube of the octree if the extent in the header is right."""
    stated = Statistics(layout)
    stated.lowest = stated.highest = np.zeros(3)
    if layout.states_extent:
        with np.errstate(over="ignore"):
            corners = (np.array([layout.minimum, layout.maximum]) - layout.offset) / layout.scale
        stated.lowest, stated.highest = np.rint(corners).clip(-(2.0**31), 2.0**31)
    return stated.cube


def record_length(layout: LasFile) -> int:
    """Return the record length of a file after it was converted to COPC."""
    return RECORD_LENGTHS[NEW_FORMATS[layout.point_format]] + layout.extra_bytes


def convert(layout: LasFile, old: np.ndarray, classes: np.ndarray, new: np.ndarray) -> None:
    """Convert records with new classes to a point format of COPC, and write them into `new`, an
    array of zeros, uint8 (n, new record length).
    """
    length = RECORD_LENGTHS[NEW_FORMATS[layout.point_format]]
    if layout.point_format >= FIRST_EXTENDED_FORMAT:
        # Formats 9 and 10 are 6 and 8, followed by waveforms.
        new[:, :length] = old[:, :length]
    else:
        _modernise(layout, old, new)
    new[:, length:] = old[:, RECORD_LENGTHS[layout.point_format] :]
    new[:, 16] = classes


def _modernise(layout: LasFile, old: np.ndarray, new: np.ndarray) -> None:
    """Convert points of the formats 0 to 5 to the formats 6 and 7."""
    before = named(layout, old)
    after = as_points(NEW_FORMATS[layout.point_format], [("extra", layout.extra_bytes)], new)
    after.copy_fields_from(before)
    after["scan_angle"] = np.rint(before["scan_angle_rank"] / _ANGLE_UNIT)


def new_header(layout: LasFile, point_format: int, statistics: Statistics) -> bytearray:
    """Return the header of the input as LAS 1.4, still without positions of points and records."""
    header = bytearray(fields.HEADER_SIZES[4])
    until = fields.EXTENT.start
    header[:until] = layout.header[:until]
    encoding = layout.global_encoding if layout.minor_version >= 2 else 0
    encoding = (encoding & (_GPS_TIME_TYPE | _SYNTHETIC_RETURNS)) | _WKT
    fields.GLOBAL_ENCODING.put(header, encoding)
    fields.VERSION.put(header, 1, 4)
    fields.HEADER_SIZE.put(header, len(header))
    # The old 32 bit numbers of points are 0 for formats 6 and higher.
    fields.LEGACY_COUNT.put(header, 0)
    fields.LEGACY_RETURNS.put(header, *[0] * 5)
    fields.POINT_FORMAT.put(header, point_format | 0x80)
    fields.RECORD_LENGTH.put(header, record_length(layout))
    lowest, highest = statistics.extent
    corners = np.column_stack((highest, lowest)).ravel()
    fields.EXTENT.put(header, *corners)
    fields.COUNT.put(header, layout.count)
    fields.RETURNS.put(header, *statistics.returns.tolist())
    return header


def new_vlrs(layout: LasFile, point_format: int, progress: Progress) -> list[Vlr]:
    """Return the records before the points; the first is the info record, still empty."""
    vlrs = [vlr for vlr in layout.vlrs if _is_kept(vlr)]
    wkt = _wkt(layout, progress)
    if wkt is not None:
        vlrs = [vlr for vlr in vlrs if vlr.key not in (*GEOKEY_RECORDS, WKT_RECORD)]
        vlrs.insert(0, wkt)
    laszip = laszip_vlr(point_format, layout.extra_bytes, variable_chunks=True)
    return [new_vlr(COPC_INFO, bytes(160), ""), laszip, *vlrs]


def kept_evlrs(layout: LasFile) -> list[Evlr]:
    """Return the records behind the points that are still valid."""
    return [evlr for evlr in layout.evlrs if _is_kept(evlr)]


def _is_kept(record: Vlr | Evlr) -> bool:
    """Return whether a record is still valid; those of COPC and LAZ are made again."""
    user, number = record.key
    if user == "LASF_Spec" and number in _WAVEFORM_DESCRIPTORS:
        return False
    return record.key not in (LASZIP, COPC_INFO, COPC_HIERARCHY, COPC_EXTENTS, WAVEFORM_PACKETS)


def _wkt(layout: LasFile, progress: Progress) -> Vlr | None:
    """Return the record of the CRS as well-known text, which COPC requires."""
    # As in LAS and LAZ, the file states the same CRS as before. If it stated none, it states the
    # user's, since COPC requires a CRS and its header is new in any case.
    of_file = read_crs(dataclasses.replace(layout, stated=None))
    text = compound_wkt(of_file)
    if text is None and of_file.epsg is None and layout.vlr(*GEOKEY_RECORDS) is None:
        text = compound_wkt(read_crs(layout))
    if text is None:
        if layout.vlr(*GEOKEY_RECORDS) is not None:
            progress.warning(
                "COPC needs the CRS as well-known text, which is not known for this input. The CRS"
                " stays in GeoTIFF keys, which not every program will read."
            )
        return None
    if len(text.encode()) >= LARGEST_VLR:
        progress.warning(
            "The well-known text of the CRS is too long for a record of COPC: its records stay as"
            " they are, which not every program will read."
        )
        return None
    for vlr in layout.vlrs:
        if vlr.key == WKT_RECORD and text_of(vlr.data) == text:
            return vlr
    if layout.vlr(*GEOKEY_RECORDS) is not None:
        progress.info("The CRS, given as GeoTIFF keys, becomes well-known text, as COPC needs it.")
    return new_vlr(WKT_RECORD, text.encode() + b"\0", "OGC WKT Coordinate System")


def report_format(layout: LasFile, point_format: int, progress: Progress) -> None:
    """Report what changes and what is lost."""
    if layout.point_format in _WITH_WAVEFORMS:
        progress.warning(
            f"COPC cannot hold the waveforms of point format {layout.point_format}: they are left"
            f" out, and the points become point format {point_format}."
        )
    elif point_format != layout.point_format:
        progress.info(
            f"Point format {layout.point_format} becomes {point_format}, as COPC needs it."
        )
    if len(layout.header) > fields.HEADER_SIZES[layout.minor_version]:
        progress.warning(
            "COPC cannot hold the bytes that were added to the header: they are left out."
        )
