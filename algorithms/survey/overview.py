"""Overviews of virtual point clouds: one COPC file with a few points of all files.

Viewers show it at small scales, where they would have to open many files. It has the name that
`pdal_wrench build_vpc --overview` gives it.

References
----------
https://github.com/PDAL/wrench/blob/main/vpc-spec.md
"""

from __future__ import annotations

from pathlib import Path
from typing import Sequence

import numpy as np

from ..core.files import replacing
from ..core.progress import SILENT, Progress
from ..las.copc import write_copc
from ..las.copc_nodes import find_nodes, read_hierarchy, read_nodes
from ..las.edits import EditedFile, Edits
from ..las.extrabytes import extra_dimensions, runs_of_bytes
from ..las.header_edits import with_count
from ..las.lasfile import LasFile
from ..las.records import as_points, column, named

_ENDING = "-overview.copc.laz"
# Most points of an overview, which also has at most one of ten points.
_MOST_POINTS = 1_000_000
_STEP = 10
_LIMITS = -(2**31), 2**31 - 1


def overview_of(vpc: Path) -> Path:
    """Return the path of the overview of a virtual point cloud."""
    return vpc.with_name(vpc.stem + _ENDING)


def is_overview(path: Path) -> bool:
    """Return whether a file is the overview of a virtual point cloud beside it."""
    stem = path.name[: -len(_ENDING)]
    return path.name.endswith(_ENDING) and path.with_name(f"{stem}.vpc").is_file()


def write_overview(vpc: Path, files: Sequence[LasFile], progress: Progress = SILENT) -> Path | None:
    """Write the overview of a virtual point cloud, which need not exist yet, from the uppermost
    nodes of its COPC files; return None if a file is not COPC, or has the path of the overview.
    """
    # Viewers do not show the points of other files than COPC at any scale.
    target, filled = overview_of(vpc), [file for file in files if file.count]
    is_one_of_them = any(file.path.resolve() == target.resolve() for file in files)
    if not filled or is_one_of_them or not all(file.is_copc for file in files):
        return None
    total = sum(file.count for file in filled)
    most = min(_MOST_POINTS, -(-total // _STEP))
    like, samples = filled[0], []
    for number, file in enumerate(filled, start=1):
        samples.append(_sample(file, like, max(most * file.count // total, 1)))
        progress(0.8 * number / len(filled))
    records = np.concatenate(samples)
    layout = with_count(like, len(records))
    with replacing(target) as temporary:
        edited = EditedFile(layout, Edits(), records)
        write_copc(edited, temporary, progress.part(0.8, 1.0))
    return target


def _sample(layout: LasFile, like: LasFile, count: int) -> np.ndarray:
    """Return about `count` points from all parts of a file, as records of the file `like`."""
    hierarchy = read_hierarchy(layout)
    nodes = find_nodes(hierarchy, layout.outer_box)
    nodes = nodes[np.argsort(nodes["key"][:, 0], kind="stable")]
    before = np.cumsum(nodes["count"], dtype=np.int64) - nodes["count"]
    nodes = nodes[before < count]
    nodes = nodes[np.argsort(nodes["start"], kind="stable")]
    step = -(-int(nodes["count"].sum(dtype=np.int64)) // count)
    parts = []
    for points in read_nodes(hierarchy, nodes, is_whole=True):
        records = points.array.view(np.uint8).reshape(len(points), -1)
        parts.append(_as_records(layout, like, records[::step].copy()))
    return np.concatenate(parts)


def _as_records(layout: LasFile, like: LasFile, records: np.ndarray) -> np.ndarray:
    """Return points as records of the file `like`, with its scale and offset."""
    old = named(layout, records)
    extra = [extra_dimensions(file) for file in (layout, like)]
    if layout.point_format == like.point_format and extra[0] == extra[1]:
        new = records.copy()
    else:
        new = np.zeros((len(records), like.record_length), dtype=np.uint8)
        as_points(like.point_format, runs_of_bytes(like), new).copy_fields_from(old)
    fits = np.ones(len(records), dtype=bool)
    for axis, name in enumerate("XYZ"):
        values = np.asarray(old[name]) * layout.scale[axis] + layout.offset[axis]
        integers = np.rint((values - like.offset[axis]) / like.scale[axis])
        fits &= (integers >= _LIMITS[0]) & (integers <= _LIMITS[1])
        column(new, 4 * axis, "<i4")[:] = np.clip(integers, *_LIMITS)
    # Without points that are too far away for the scale of `like`.
    return new[fits]
