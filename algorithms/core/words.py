"""Words of messages: numbers of things, and the names of options and tools."""

from __future__ import annotations

import re
from typing import Sequence

_NAMED = re.compile(r"`([a-z_]+)(\(\))?`")


def counted(count: int, single: str, several: str = "") -> str:
    """Return a number of things in words, such as "1 file" and "2 files"; without `several` an "s"
    is added to `single`.
    """
    return f"{count:,} {single if count == 1 else several or single + 's'}"


def first_of(names: Sequence[str], most: int = 3) -> str:
    """Return the first names of many in words, and how many more there are."""
    more = len(names) - most
    return ", ".join(names[:most]) + (f" and {more:,} more" if more > 0 else "")


class Keywords:
    """How messages name options and tools: in this class as in the library."""

    reproject = (
        "such as by 'pdal translate INPUT OUTPUT reprojection"
        " --filters.reprojection.out_srs=EPSG:...'"
    )

    def tool(self, command: str) -> str:
        """Return a tool, given the name of its command."""
        if command == "clear-cache":  # the library has no such function
            return Flags().tool(command)
        return f"bare_earth.{command.replace('-', '_')}()"

    def option(self, name: str, value: object, command: str) -> str:
        """Return an option, with its value if that is not None, and with its tool if `command` is
        not empty.
        """
        text = f"{name!r}" if value is None else f"{name}={value!r}"
        return f"{text} of {self.tool(command)}" if command else text


class Flags(Keywords):
    """How messages name options and tools in a terminal."""

    def tool(self, command: str) -> str:
        """Return a command."""
        return f"'bare-earth {command}'"

    def option(self, name: str, value: object, command: str) -> str:
        """Return a flag with its value."""
        text = f"--{name.replace('_', '-')}" + (f" {value}" if value not in (None, True) else "")
        return f"{text} of {self.tool(command)}" if command else text


# Of this process: the command and the plugin set their own.
_names = Keywords()


def use_names(names: Keywords) -> Keywords:
    """Set how messages of this process name options and tools; return the previous setting."""
    global _names
    previous, _names = _names, names
    return previous


def names_in_use() -> Keywords:
    """Return how messages of this process name options and tools."""
    return _names


def option(name: str, value: object = None, of: str = "") -> str:
    """Return an option in the words of a terminal, the library or QGIS, with its value if that is
    not None; `of` is the command if only one has the option.
    """
    return _names.option(name, value, of)


def tool(command: str) -> str:
    """Return a tool in the words of a terminal, the library or QGIS."""
    return _names.tool(command)


def in_words(text: str) -> str:
    """Replace tools (written `water()`) and options (written `max_edge`) in a help text by their
    names in a terminal, the library or QGIS.
    """
    return _NAMED.sub(
        lambda match: tool(match[1].replace("_", "-")) if match[2] else option(match[1]),
        text,
    )
