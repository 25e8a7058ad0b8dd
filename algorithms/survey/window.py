"""Reads the points of a file that lie in a window."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Dict, Iterable, Iterator, Union

import numpy as np

from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud
from ..las.copc_nodes import OctreeError, find_nodes, read_hierarchy, read_nodes
from ..las.crs_records import read_crs
from ..las.lasfile import LasFile
from ..las.opening import open_las
from ..las.reading import cloud_of, columns_of, read_chunks, require_packages
from .area import Area

if TYPE_CHECKING:
    import laspy

Columns = Dict[str, np.ndarray]
Chunk = Union["laspy.PackedPointRecord", Columns]


def read_window(
    path: Path | LasFile,
    box: Box,
    progress: Progress = SILENT,
    trust_header: bool = False,
    whole: PointCloud | None = None,
    times: bool = False,
) -> PointCloud:
    """Read the points of a LAS, LAZ or COPC file that lie in a rectangle.

    Of a COPC file only the nodes of its octree that touch the rectangle are read, unless the octree
    is damaged. LAS and LAZ files are read completely, in chunks.

    Parameters
    ----------
    path : Path or LasFile
        The file, or the result of `open_las`.
    box : tuple of float
        Smallest x and y, largest x and y in units of the CRS; the border belongs to the box.
    progress : Progress
        Receives progress, and warnings about CRS, header and octree.
    trust_header : bool
        Whether to skip a LAS or LAZ file if the extent in its header does not touch the rectangle.
        If the header is wrong, points are missed.
    whole : PointCloud, optional
        All points of the file, if they were read before.
    times : bool
        Whether to read the GPS times, too.

    Returns
    -------
    PointCloud
        The points in file order; it can be empty.

    Raises
    ------
    BareEarthError
        If the file cannot be read, or the rectangle is not valid.
    Cancelled
        If the user asked to stop.
    """
    west, south, east, north = map(float, box)
    area = Area(box=(west, south, east, north))
    layout = open_las(path)
    require_packages(layout)
    if layout.is_copc and whole is None:
        try:
            return _cloud(layout, _in_nodes(layout, area, progress, times), progress, times)
        except OctreeError as error:
            progress.warning(f"{error} The whole file is read instead, which takes longer.")
    if trust_header and not may_touch(layout, box):
        return _cloud(layout, iter(()), progress, times)
    chunks = read_chunks(layout, times) if whole is None else _chunks_of(whole, layout)
    return _cloud(layout, _in_chunks(layout, area, chunks, progress, times), progress, times)


def _in_nodes(layout: LasFile, area: Area, progress: Progress, times: bool) -> Iterator[Columns]:
    hierarchy = read_hierarchy(layout)
    nodes = find_nodes(hierarchy, area.bounds)
    done, total = 0, int(nodes["count"].sum(dtype=np.int64))
    for chunk in read_nodes(hierarchy, nodes, times=times):
        yield _inside(layout, area, chunk, times)
        done += len(chunk)
        progress(done / total)


def _chunks_of(whole: PointCloud, layout: LasFile) -> Iterator[Columns]:
    """Yield the points of a cloud in parts, with the names of their dimensions in files."""
    for _, part in whole.parts():
        yield {source: getattr(part, name) for name, (source, _) in _columns(layout).items()}


def _in_chunks(
    layout: LasFile, area: Area, chunks: Iterable[Chunk], progress: Progress, times: bool
) -> Iterator[Columns]:
    done, is_outside = 0, False
    for chunk in chunks:
        yield _inside(layout, area, chunk, times)
        is_outside |= _leaves_header(layout, chunk)
        done += len(chunk["X"])
        progress(done / layout.count)
    if is_outside:
        progress.warning(
            f"The header of {layout.path.name} states a smaller extent than its points have: other"
            " programs may miss some. Write the file again with a program that corrects the"
            " header."
        )


def _inside(layout: LasFile, area: Area, chunk: Chunk, times: bool) -> Columns:
    """Return the columns of the points of a chunk that lie in the area."""
    x, y = (
        np.asarray(chunk[name]) * layout.scale[axis] + layout.offset[axis]
        for axis, name in enumerate("XY")
    )
    which = np.flatnonzero(area.contains(x, y))
    return {
        name: np.asarray(chunk[source])[which].astype(kind)
        for name, (source, kind) in _columns(layout, times).items()
    }


def _columns(layout: LasFile, times: bool = False) -> dict[str, tuple[str, type]]:
    """Return the columns to read: all except those that are needed only for writing."""
    columns = columns_of(layout)
    columns.pop("scanner_channel", None)
    return {**columns, "gps_time": ("gps_time", np.float64)} if times else columns


def _leaves_header(layout: LasFile, chunk: Chunk) -> bool:
    """Return whether a point lies outside of the extent in the header."""
    for axis, name in enumerate("XY"):
        integers = np.asarray(chunk[name])
        scale, offset = layout.scale[axis], layout.offset[axis]
        lowest, highest = (int(pick(integers)) * scale + offset for pick in (np.min, np.max))
        # Programs round the values in headers in different ways.
        if lowest < layout.minimum[axis] - scale or highest > layout.maximum[axis] + scale:
            return True
    return False


def may_touch(layout: LasFile, box: Box) -> bool:
    """Return whether the extent in the header touches a box, or is not valid."""
    west, south, east, north = layout.box
    is_one = west <= east and south <= north
    return not is_one or Area(box=box).may_touch(layout.outer_box)


def _cloud(
    layout: LasFile, parts: Iterator[Columns], progress: Progress, times: bool
) -> PointCloud:
    names = _columns(layout, times)
    kept: dict[str, list[np.ndarray]] = {
        name: [np.empty(0, dtype=kind)] for name, (_, kind) in names.items()
    }
    for part in parts:
        for name, values in part.items():
            kept[name].append(values)
    # One column after the other, so that not all columns are in memory twice at the same time.
    columns = {name: np.concatenate(kept.pop(name)) for name in names}
    return cloud_of(layout, read_crs(layout, progress), **columns)
