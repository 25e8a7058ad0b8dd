"""The functions that `bare_earth` exports, made from what tools declare."""

from __future__ import annotations

from ..tools.listing import COMPOSITIONS, FILE_TOOLS, MAP_TOOLS, POINT_TOOLS

# What functions on arrays return, and the modules of this folder that have it.
ARRAY_CLASSES = {"Block": "blocks", "Features": "features", "Raster": "rasters"}


def tool_commands() -> dict[str, str]:
    """Return the commands of tools, by the names of their functions."""
    commands = {command.replace("-", "_"): command for command in FILE_TOOLS}
    commands.update((listed.file, command) for command, listed in POINT_TOOLS.items())
    # "classify-tiles" is a dialog alone.
    commands.update((name, name) for name in (*MAP_TOOLS, *COMPOSITIONS) if name.isidentifier())
    return commands


def names() -> list[str]:
    """Return the names of all functions, without importing what they do."""
    return sorted(tool_commands())


def array_names() -> list[str]:
    """Return the names of all functions on arrays."""
    return [
        "above_ground", "blocks", "change", "check", "classify", "contours", "expected_error",
        "ground", "heights", "key_points", "relief", "remove_off_terrain_objects", "residuals",
        "terrain", "water",
    ]  # fmt: skip
