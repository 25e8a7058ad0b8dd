"""What a user can ask for of classified points, one file for each tool.

A file declares its tool as `TOOL`. The command line, the library and the dialogs of QGIS are made
from this declaration; see `declaration.py`.
"""

from __future__ import annotations

import importlib
from types import ModuleType
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from .declaration import FileTool, PointTool


class Listed(NamedTuple):
    """A tool in the list of all commands, which imports no tool."""

    file: str  # here; also the name of its function in the library
    help: str  # one line


# The tools that write classified files anew, by their commands.
POINT_TOOLS = {
    "height": Listed("heights", "add the height above ground of every point"),
    "above-ground": Listed("above_ground", "classify vegetation, buildings and bridges"),
    "key-points": Listed("key_points", "mark the ground points that a terrain model needs"),
    "water-classes": Listed(
        "water_classes", "give classes to ground points in water and beside its shore"
    ),
}
# The tools that read files and write others.
FILE_TOOLS = {
    "info": Listed("info", "describe a file"),
    "remove-off-terrain-objects": Listed(
        "off_terrain", "remove buildings and trees from an elevation raster"
    ),
    "contours": Listed("contours", "draw contour lines of a terrain model"),
    "check": Listed(
        "check.checking", "compare the ground with checkpoints, or with points that are held out"
    ),
    "compare-settings": Listed(
        "compare_settings", "try methods and presets on a window, and show them side by side"
    ),
    "quality": Listed(
        "quality",
        "measure density, voids and overlap of a survey, and compare it with a specification",
    ),
    "assess": Listed("assess", "compare a classified file with a reference"),
    "relief": Listed("relief", "make pictures of the relief of a terrain model"),
    "water": Listed("water.tool", "find lakes and rivers in classified points"),
}


def point_tool(command: str) -> PointTool:
    """Return the declaration of a tool for points, given its command."""
    tool: PointTool = _module(POINT_TOOLS[command]).TOOL
    return tool


def file_tool(command: str) -> FileTool:
    """Return the declaration of a tool for files, given its command."""
    tool: FileTool = _module(FILE_TOOLS[command]).TOOL
    return tool


def _module(listed: Listed) -> ModuleType:
    return importlib.import_module(f".{listed.file}", __name__)
