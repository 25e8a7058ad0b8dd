"""Reads LAS, LAZ and COPC files. COPC is LAZ in another order, and is read as LAZ."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator

import numpy as np

from ..core.progress import SILENT, Progress
from ..core.threads import over_parts, parts_of
from ..crs.system import Crs
from .backends import require
from .cloud import PointCloud
from .crs_records import read_crs
from .extrabytes import REMEMBERED, remembers
from .lasfile import FIRST_EXTENDED_FORMAT, LasFile
from .opening import open_las
from .records import MOST_KEPT, named, needed, read_records
from .return_numbers import count_from_one

if TYPE_CHECKING:
    import laspy

_CHUNK = 500_000
_POINTS_A_PART = 1 << 17
_COORDINATES = {"x": "X", "y": "Y", "z": "Z"}
COLUMNS: dict[str, tuple[str, type]] = {
    **{name: (source, np.int32) for name, source in _COORDINATES.items()},
    "classification": ("classification", np.uint8),
    "return_number": ("return_number", np.uint8),
    "number_of_returns": ("number_of_returns", np.uint8),
    "withheld": ("withheld", bool),
    "scanner_channel": ("scanner_channel", np.uint8),
    "overlap": ("overlap", bool),
    "remembered": (REMEMBERED, np.uint8),
}


def read_cloud(
    path: Path | LasFile, progress: Progress = SILENT, keep_records: bool = False
) -> PointCloud:
    """Read all points of a LAS, LAZ or COPC file in file order; if the records are kept, the file
    need not be read again for writing.
    """
    layout = open_las(path)
    require_packages(layout)
    crs, start = read_crs(layout, progress), 0
    if keep_records:
        records = np.empty((layout.count, layout.record_length), dtype=np.uint8)
        # x, y and z are views of the records: copies would take half as much memory again.
        points = named(layout, records)
        coordinates = {name: points[source] for name, source in _COORDINATES.items()}
        cloud = _empty_cloud(layout, layout.count, crs, records=records, **coordinates)
        pieces = read_records(layout, MOST_KEPT, records)
    else:
        cloud = _empty_cloud(layout, layout.count, crs)
        pieces = read_records(layout, columns=needed(layout))
    for piece in pieces:
        _fill(layout, cloud, slice(start, start + len(piece)), named(layout, piece))
        start += len(piece)
        progress(start / layout.count)
    return count_from_one(cloud)


def read_parts(
    path: Path | LasFile | PointCloud,
    progress: Progress = SILENT,
    strips: bool = False,
    times: bool = False,
) -> Iterator[PointCloud]:
    """Yield the points of a file, or of a cloud in memory, in their order, in the same parts each
    time; with strips, the flag of synthetic points is read as well.
    """
    if isinstance(path, PointCloud):
        for where, part in path.parts():
            yield part
            progress(where.stop / path.count)
        return
    layout = open_las(path)
    require_packages(layout)
    crs, start = read_crs(layout, progress), 0
    for chunk in read_chunks(layout, times, strips):
        part = _empty_cloud(layout, len(chunk), crs)
        _fill(layout, part, slice(None), chunk)
        if times:
            part.gps_time = np.array(chunk["gps_time"], dtype=np.float64)
        if strips:
            strip = np.array(chunk["point_source_id"], dtype=np.uint16)
            # LAS specification: a point source id of 0 means the file source id.
            part.strip = np.where(strip, strip, np.uint16(layout.source_id))
            part.synthetic = np.array(chunk["synthetic"], dtype=bool)
        yield count_from_one(part)
        start += len(chunk)
        progress(start / layout.count)


def require_packages(layout: LasFile) -> None:
    """Raise an error if a package for reading the file is missing."""
    require(*(("laspy", "lazrs") if layout.is_compressed else ("laspy",)))


def read_chunks(
    layout: LasFile, times: bool = False, strips: bool = False
) -> Iterator[laspy.PackedPointRecord]:
    """Yield all points in the same parts each time, which use the same memory; GPS times and point
    source ids are undefined in point formats 6 to 10 unless wanted.
    """
    pieces, columns = parts_of(layout.count, _CHUNK), needed(layout, times, strips)
    for records in read_records(layout, _CHUNK, columns=columns, pieces=pieces):
        yield named(layout, records)


def columns_of(layout: LasFile) -> dict[str, tuple[str, type]]:
    """Return names and types of the columns of a `PointCloud` that a file has."""
    columns = dict(COLUMNS)
    if layout.point_format < FIRST_EXTENDED_FORMAT:
        del columns["scanner_channel"], columns["overlap"]
    if not remembers(layout):
        del columns["remembered"]
    return columns


def cloud_of(layout: LasFile, crs: Crs, **columns: Any) -> PointCloud:
    """Return some points of a file as a cloud."""
    return PointCloud(
        path=layout.path,
        scale=layout.scale,
        offset=layout.offset,
        point_format=layout.point_format,
        crs=crs,
        file=layout,
        **columns,
    )


def _empty_cloud(layout: LasFile, count: int, crs: Crs, **kept: np.ndarray) -> PointCloud:
    """Return a cloud with the given columns, while all others are still to be filled."""
    kinds = {name: kind for name, (_, kind) in columns_of(layout).items() if name not in kept}
    return cloud_of(
        layout, crs, **kept, **{name: np.empty(count, kind) for name, kind in kinds.items()}
    )


def _fill(
    layout: LasFile, cloud: PointCloud, where: slice, points: laspy.PackedPointRecord
) -> None:
    """Copy points into a part of a cloud, except for coordinates that are views of its records."""
    views = () if cloud.records is None else _COORDINATES
    columns = columns_of(layout).items()
    names = {name: source for name, (source, _) in columns if name not in views}

    def copy(part: slice) -> None:
        for name, source in names.items():
            getattr(cloud, name)[where][part] = np.asarray(points[source][part])

    over_parts(copy, len(points), _POINTS_A_PART, SILENT)
