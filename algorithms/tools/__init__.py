"""The tools: what a user can ask for, one file or folder for each.

A file declares its tool as `TOOL`. The command line, the library and the dialogs of QGIS are made
from this declaration; see `declaration.py`.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from .listing import COMPOSITIONS, FILE_TOOLS, MAP_TOOLS, POINT_TOOLS, Listed, listed

if TYPE_CHECKING:
    from .declaration import Composition, FileTool, MapTool, PointTool, Tool


def point_tool(command: str) -> PointTool:
    """Return the declaration of a tool for points, given its command."""
    return _declared(POINT_TOOLS[command])


def file_tool(command: str) -> FileTool:
    """Return the declaration of a tool for files, given its command."""
    return _declared(FILE_TOOLS[command])


def map_tool(command: str) -> MapTool:
    """Return the declaration of a tool that makes rasters of points, given its command."""
    return _declared(MAP_TOOLS[command])


def composition(command: str) -> Composition:
    """Return the declaration of tools that work one after another, given its command."""
    return _declared(COMPOSITIONS[command])


def any_tool(command: str) -> Tool:
    """Return the declaration of a tool of any kind, given its command."""
    return _declared(listed(command))


def _declared(tool: Listed) -> Any:
    return getattr(importlib.import_module(f".{tool.file}", __name__), tool.tool)
