"""The functions that `bare_earth` exports, made from what tools declare."""

from __future__ import annotations

from ..tools import POINT_TOOLS

# The functions that are not of a tool for points.
FUNCTIONS = (
    "assess", "check", "classify", "compare_settings", "contours", "deliver", "info", "quality",
    "relief", "remove_off_terrain_objects", "terrain", "water",
)  # fmt: skip


def names() -> list[str]:
    """Return the names of all functions, without importing what they do."""
    return sorted([*FUNCTIONS, *(each.file for each in POINT_TOOLS.values())])
