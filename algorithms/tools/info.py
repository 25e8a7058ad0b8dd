"""Describes a point cloud file."""

from __future__ import annotations

from pathlib import Path

from ..core.progress import SILENT, Progress
from ..las.opening import NoPoints, open_las
from ..las.reading import Description, inspect
from .declaration import CRS, FileTool, Input


def describe(source: Path, crs: str | None = None, progress: Progress = SILENT) -> Description:
    """Return what a file says of its points."""
    try:
        layout = open_las(source, crs)
    except NoPoints as empty:
        (layout,) = empty.layouts
    return inspect(layout, progress)


TOOL = FileTool(
    work=describe,
    sets=(),
    inputs=(Input("source", "cloud", help="A .las, .laz or .copc.laz file.", named="FILE"), CRS),
    json="",
    command="info",
)
