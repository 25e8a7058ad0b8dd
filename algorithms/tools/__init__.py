"""What a user can ask for of classified points, one file for each tool.

A file declares its tool as `TOOL`. The command line, the library and the dialogs of QGIS are made
from this declaration; see `declaration.py`.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from .declaration import Composition, FileTool, MapTool, PointTool, Tool


class Listed(NamedTuple):
    """A tool in the list of all commands, which imports no tool."""

    file: str  # here; also the name of its function in the library
    help: str  # one line
    tool: str = "TOOL"  # the name of the declaration in the file


# The tools that write classified files anew, by their commands.
POINT_TOOLS = {
    "height": Listed("heights", "add the height above ground of every point"),
    "above-ground": Listed("above_ground", "classify vegetation, buildings and bridges"),
    "key-points": Listed("key_points", "mark the ground points that a terrain model needs"),
    "water-classes": Listed(
        "water_classes", "give classes to ground points in water and beside its shore"
    ),
}
# The tools that make rasters and contour lines of points.
MAP_TOOLS = {
    "classify": Listed(
        "ground.tool", "classify the ground points of a file, or of many as one survey"
    ),
    "classify-tiles": Listed("ground.tool", "the dialog of classify for many files", "TILES_TOOL"),
    "terrain": Listed("rasters.tool", "make rasters of the terrain and of what stands on it"),
}
# The tools that read files and write others.
FILE_TOOLS = {
    "info": Listed("info", "describe a file"),
    "fetch": Listed("fetch", "download part of a remote point cloud"),
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
    "review": Listed("review", "find the places of a terrain model to look at first"),
    "relief": Listed("relief", "make pictures of the relief of a terrain model"),
    "water": Listed("water.tool", "find lakes and rivers in classified points"),
}
# Tools that work one after another, declared above this room.
COMPOSITIONS = {
    "deliver": Listed(".delivery.tool", "make everything that a job hands over, in one run")
}


def point_tool(command: str) -> PointTool:
    """Return the declaration of a tool for points, given its command."""
    tool: PointTool = _declared(POINT_TOOLS[command])
    return tool


def file_tool(command: str) -> FileTool:
    """Return the declaration of a tool for files, given its command."""
    tool: FileTool = _declared(FILE_TOOLS[command])
    return tool


def map_tool(command: str) -> MapTool:
    """Return the declaration of a tool that makes rasters of points, given its command."""
    tool: MapTool = _declared(MAP_TOOLS[command])
    return tool


def composition(command: str) -> Composition:
    """Return the declaration of tools that work one after another, given its command."""
    tool: Composition = _declared(COMPOSITIONS[command])
    return tool


def any_tool(command: str) -> Tool:
    """Return the declaration of a tool of any kind, given its command."""
    tool: Tool = _declared({**POINT_TOOLS, **FILE_TOOLS, **MAP_TOOLS, **COMPOSITIONS}[command])
    return tool


def _declared(listed: Listed) -> Any:
    return getattr(importlib.import_module(f".{listed.file}", __name__), listed.tool)
