"""The functions that `bare_earth` exports, made from what tools declare."""

from __future__ import annotations

from ..tools import FILE_TOOLS, POINT_TOOLS

# The functions that are not those of a tool.
_OTHERS = ("classify", "deliver", "terrain")


def tool_commands() -> dict[str, str]:
    """Return the commands of tools, by the names of their functions."""
    commands = {command.replace("-", "_"): command for command in FILE_TOOLS}
    return {**commands, **{listed.file: command for command, listed in POINT_TOOLS.items()}}


def names() -> list[str]:
    """Return the names of all functions, without importing what they do."""
    return sorted({*_OTHERS, *tool_commands()})
