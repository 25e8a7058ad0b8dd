"""Words of messages: numbers in sentences, and options and tools as their reader knows them."""

from __future__ import annotations

import re
from typing import Any

_NAMED = re.compile(r"`([a-z_]+)(\(\))?`")


def counted(count: int, single: str, several: str = "") -> str:
    """Return a number of things in words, such as "1 file" and "2 files"; without `several` an "s"
    is added to `single`.
    """
    return f"{count:,} {single if count == 1 else several or single + 's'}"


class Keywords:
    """How messages name options and tools, here as the library does."""

    reproject = (
        "such as by 'pdal translate INPUT OUTPUT reprojection"
        " --filters.reprojection.out_srs=EPSG:...'"
    )

    def tool(self, command: str) -> str:
        """Return a tool, given the name of its command."""
        if command == "clear-cache":  # it is no function
            return Flags().tool(command)
        return f"bare_earth.{command.replace('-', '_')}()"

    def option(self, name: str, value: Any, command: str) -> str:
        """Return an option, with a value unless it is None; of any tool if `command` is empty."""
        text = f"{name!r}" if value is None else f"{name}={value!r}"
        return f"{text} of {self.tool(command)}" if command else text


class Flags(Keywords):
    """How messages name options and tools in a terminal."""

    def tool(self, command: str) -> str:
        """Return a command."""
        return f"'bare-earth {command}'"

    def option(self, name: str, value: Any, command: str) -> str:
        """Return a flag with its value."""
        text = f"--{name.replace('_', '-')}" + (f" {value}" if value not in (None, True) else "")
        return f"{text} of {self.tool(command)}" if command else text


# Of this process: the command and the plugin set their own.
_names = Keywords()


def use_names(names: Keywords) -> Keywords:
    """Let messages of this process name options and tools in this way; return how they did."""
    global _names
    before, _names = _names, names
    return before


def names_in_use() -> Keywords:
    """Return how messages of this process name options and tools."""
    return _names


def option(name: str, value: Any = None, of: str = "") -> str:
    """Return an option in the words of a terminal, the library or QGIS, with a value if it is not
    None; `of` names the only command that has it.
    """
    return _names.option(name, value, of)


def tool(command: str) -> str:
    """Return a tool in the words of a terminal, the library or QGIS."""
    return _names.tool(command)


def in_words(text: str) -> str:
    """Return a help text whose tools, as `water()`, and options, as `max_edge`, have the names that
    a terminal, the library or QGIS gives them.
    """
    return _NAMED.sub(
        lambda found: tool(found[1].replace("_", "-")) if found[2] else option(found[1]),
        text,
    )
