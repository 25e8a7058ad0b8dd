"""Reads the points of a file that lie in a window."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Callable, Iterator, Sequence, TypeVar

import numpy as np

from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud, joined
from ..las.copc_nodes import (
    Hierarchy,
    OctreeError,
    find_nodes,
    read_hierarchy,
    read_nodes,
    read_pages,
)
from ..las.crs_records import read_crs
from ..las.lasfile import LasFile
from ..las.opening import open_las
from ..las.reading import cloud_of, columns_of, read_parts, require_packages
from ..las.return_numbers import count_from_one
from .area import Area

_Taken = TypeVar("_Taken")
# Returns a part with other values, given its indices in the file.
Change = Callable[[slice, PointCloud], PointCloud]


def read_window(
    path: Path | LasFile,
    box: Box,  # smallest x and y, largest x and y in units of the CRS
    progress: Progress = SILENT,
    trust_header: bool = False,  # skip LAS and LAZ whose stated extent does not touch the box
    times: bool = False,
    change: Change | None = None,  # gets indices in the file and all points in file order
    numbers: bool = False,  # whether the points come with their places in the file
) -> PointCloud:
    """Read the points of a LAS, LAZ or COPC file in a rectangle with its border, in file order;
    there may be none.
    """
    # Of a COPC file, only the nodes of the octree that touch the rectangle are read, unless the
    # octree is damaged. LAS and LAZ files are read completely, part by part.
    area, layout = Area(box=box), open_las(path)
    require_packages(layout)
    if layout.is_copc and layout.unpacked is None and change is None:
        try:
            parts = _in_nodes(layout, [area.bounds], progress, times, numbers)
            return _joined(layout, _chosen(layout, area, parts), progress.quiet())
        except OctreeError as error:
            progress.warning(f"{error} The whole file is read instead, which takes longer.")
    parts = iter(())
    if not trust_header or may_touch(layout, box):
        parts = _in_file(layout, progress, times, change, numbers)
    return _joined(layout, _chosen(layout, area, parts), progress)


def parts_in_window(
    layout: LasFile, box: Box, progress: Progress = SILENT, change: Change | None = None
) -> Iterator[PointCloud]:
    """Yield the points that `read_window` returns in parts that fit into memory."""
    for part in _chosen(layout, Area(box=box), _in_file(layout, progress, False, change)):
        yield replace(part, scanner_channel=None)


def taken_near(
    layout: LasFile,
    boxes: Sequence[Box],
    take: Callable[[PointCloud], _Taken],
    progress: Progress = SILENT,
) -> list[_Taken]:
    """Return what `take` makes of each part of a file, which is read once; of a COPC file, only the
    nodes that touch a box are read.
    """
    require_packages(layout)
    if not any(may_touch(layout, box) for box in boxes):
        return []
    if layout.is_copc and layout.unpacked is None:
        try:
            return list(map(take, _in_nodes(layout, boxes, progress, False, False)))
        except OctreeError as error:
            progress.warning(f"{error} The whole file is read instead, which takes longer.")
    return list(map(take, read_parts(layout, progress)))


def _in_nodes(
    layout: LasFile, boxes: Sequence[Box], progress: Progress, times: bool, numbers: bool
) -> Iterator[PointCloud]:
    """Yield the points of the nodes of a COPC file that touch a box."""
    hierarchy, crs = read_hierarchy(layout), read_crs(layout, progress)
    nodes, names = _nodes_at(hierarchy, boxes), columns_of(layout)
    if times:
        names["gps_time"] = "gps_time", np.float64
    done, total = 0, int(nodes["count"].sum(dtype=np.int64))
    places = _places_of(hierarchy, nodes) if numbers else None
    for chunk in read_nodes(hierarchy, nodes, times=times):
        columns: dict[str, np.ndarray] = {
            name: np.asarray(chunk[source]).astype(kind) for name, (source, kind) in names.items()
        }
        if places is not None:
            columns["number"] = places[done : done + len(chunk)]
        yield count_from_one(cloud_of(layout, crs, **columns))
        done += len(chunk)
        progress(done / total)


def _nodes_at(hierarchy: Hierarchy, boxes: Sequence[Box]) -> np.ndarray:
    """Return the nodes of a COPC file that touch a box, in file order."""
    nodes = np.concatenate([find_nodes(hierarchy, box) for box in boxes])
    return nodes[np.unique(nodes["start"], return_index=True)[1]]


def _places_of(hierarchy: Hierarchy, nodes: np.ndarray) -> np.ndarray:
    """Return the places in a COPC file of the points of some nodes."""
    entries = np.concatenate([*read_pages(hierarchy).values()])
    entries = np.sort(entries[entries["count"] > 0], order="start")
    before = np.cumsum(entries["count"], dtype=np.int64) - entries["count"]
    first, counts = before[np.searchsorted(entries["start"], nodes["start"])], nodes["count"]
    ends = np.cumsum(counts, dtype=np.int64)
    return np.repeat(first - ends + counts, counts) + np.arange(ends[-1] if len(ends) else 0)


def _in_file(
    layout: LasFile,
    progress: Progress,
    times: bool,
    change: Change | None,
    numbers: bool = False,
) -> Iterator[PointCloud]:
    """Yield all points of a file part by part; warn if some lie outside the stated extent."""
    start, is_outside = 0, False
    for part in read_parts(layout, progress, times=times):
        where = slice(start, start + part.count)
        if numbers:
            part.number = np.arange(where.start, where.stop)
        yield part if change is None else change(where, part)
        start = where.stop
        is_outside |= _leaves_header(layout, part)
    if is_outside:
        progress.warning(
            f"The header of {layout.path.name} states a smaller extent than its points have: other"
            " programs may miss some. Write the file again with a program that corrects the"
            " header."
        )


def _leaves_header(layout: LasFile, part: PointCloud) -> bool:
    for axis, integers in enumerate(zip(part.lowest, part.highest)):
        scale, offset = layout.scale[axis], layout.offset[axis]
        lowest, highest = (integer * scale + offset for integer in integers)
        # Programs round the values in headers in different ways.
        if lowest < layout.minimum[axis] - scale or highest > layout.maximum[axis] + scale:
            return True
    return False


def may_touch(layout: LasFile, box: Box) -> bool:
    """Return whether the extent in the header touches a box, or is not valid."""
    west, south, east, north = layout.box
    is_one = west <= east and south <= north
    return not is_one or Area(box=box).may_touch(layout.outer_box)


def are_inside(layout: LasFile, area: Area, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return which places lie in an area, given x and y as the integers in a file."""
    (east, north, _), (x0, y0, _) = layout.scale, layout.offset
    return area.contains(x * east + x0, y * north + y0)


def _chosen(layout: LasFile, area: Area, parts: Iterator[PointCloud]) -> Iterator[PointCloud]:
    for part in parts:
        corners = np.array([part.lowest, part.highest]).T if part.count else np.zeros((2, 0))
        if not are_inside(layout, area, *corners).all():
            part = part.take(np.flatnonzero(are_inside(layout, area, part.x, part.y)))
        yield part


def _joined(layout: LasFile, parts: Iterator[PointCloud], progress: Progress) -> PointCloud:
    """Return the points of parts as one cloud, without the columns that only writing needs."""
    clouds = list(parts)
    if not clouds:
        names = columns_of(layout)
        empty: dict[str, np.ndarray] = {
            name: np.empty(0, dtype=kind) for name, (_, kind) in names.items()
        }
        clouds = [cloud_of(layout, read_crs(layout, progress), **empty)]
    return replace(joined(clouds), scanner_channel=None)
