"""Joins tiles of EPT, each a LAS or LAZ file, into one file without compression."""

from __future__ import annotations

from dataclasses import replace
from typing import BinaryIO, Iterable

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import Progress
from ..las import header as fields
from ..las.crs_records import CRS_RECORDS, WKT_RECORD
from ..las.header_edits import with_count, with_statistics
from ..las.lasfile import LARGEST_VLR, LASZIP, LasFile, new_vlr
from ..las.records import HeaderCounts, column, read_records
from ..survey.area import Area
from ..survey.window import are_inside

# Bits of the global encoding.
_GPS_TIME_TYPE = 0x01
_WKT = 0x10
# Largest change of a coordinate, in steps, if the integers of a tile are moved to another offset.
_WHOLE = 0.01


def joined(
    tiles: Iterable[tuple[LasFile, int]],  # with the points that the hierarchy states
    file: BinaryIO,
    name: str,
    wkt: str | None,
    area: Area | None,
    shares: list[Progress],
) -> int:
    """Write the points of tiles in an area into an open file, and return their number."""
    layout, counts, total = None, None, 0
    for (tile, stated), progress in zip(tiles, shares):
        if tile.count != stated:
            progress.warning(
                f"Tile {tile.path.stem} of {name} has {tile.count:,} points, not {stated:,} as its"
                " hierarchy says. All of its points are used."
            )
        if layout is None or counts is None:
            layout = _layout(tile, wkt)
            counts = HeaderCounts(layout)
            file.write(layout.prefix(layout.vlrs, compressed=False))
        if (layout.point_format, layout.record_length) != (tile.point_format, tile.record_length):
            raise BareEarthError(
                f"The tiles of {name} have different point formats, {layout.point_format} and"
                f" {tile.point_format}, which do not fit into one file. Fetch a smaller area."
            )
        for records in read_records(tile):
            kept = _moved(layout, tile, records[_inside(area, tile, records)])
            counts.add(kept)
            file.write(kept.data)
            total += len(kept)
        progress(1.0)
    if layout is None or counts is None or not total:
        return 0
    layout = with_statistics(
        with_count(layout, total),
        counts.lowest.tolist(), counts.highest.tolist(), counts.returns.tolist(),
    )  # fmt: skip
    file.seek(0)
    file.write(layout.prefix(layout.vlrs, compressed=False))
    return total


def _layout(tile: LasFile, wkt: str | None) -> LasFile:
    """Return header and records of the output, LAS 1.4, given those of a tile."""
    header = bytearray(fields.HEADER_SIZES[4])
    header[: fields.WAVEFORM_START.start] = tile.header[: fields.HEADER_SIZES[0]]
    fields.VERSION.put(header, 1, 4)
    fields.HEADER_SIZE.put(header, len(header))
    vlrs = [vlr for vlr in tile.vlrs if vlr.key != LASZIP]
    text = (wkt or "").encode()
    if text and len(text) < LARGEST_VLR:
        vlrs = [vlr for vlr in vlrs if vlr.key not in CRS_RECORDS]
        vlrs.append(new_vlr(WKT_RECORD, text + b"\0", "OGC WKT Coordinate System"))
        encoding = tile.global_encoding & _GPS_TIME_TYPE if tile.minor_version >= 2 else 0
        fields.GLOBAL_ENCODING.put(header, encoding | _WKT)
    return replace(tile, header=bytes(header), vlrs=tuple(vlrs), padding=b"", evlrs=())


def _inside(area: Area | None, tile: LasFile, records: np.ndarray) -> np.ndarray:
    """Return which points lie in the area."""
    if area is None:
        return np.ones(len(records), dtype=bool)
    x, y = (column(records, 4 * axis, "<i4") for axis in (0, 1))
    return are_inside(tile, area, x, y)


def _moved(layout: LasFile, tile: LasFile, records: np.ndarray) -> np.ndarray:
    """Return records of a tile with coordinates as integers of the output."""
    for axis in range(3):
        scale, step = tile.scale[axis], layout.scale[axis]
        shift = tile.offset[axis] - layout.offset[axis]
        if scale == step and shift == 0:
            continue
        integers = column(records, 4 * axis, "<i4")
        steps = (integers * scale + shift) / step
        whole = np.rint(steps)
        if (np.abs(whole - steps) > _WHOLE).any() or (np.abs(whole) >= 1 << 31).any():
            raise BareEarthError(
                f"The coordinates of {tile.path.name} do not fit to those of the tiles before:"
                " their scales and offsets differ. Fetch a smaller area."
            )
        integers[:] = whole
    return records
