"""How messages name options and tools in QGIS: by their labels in dialogs and in the toolbox."""

from __future__ import annotations

from typing import Any, Iterable

from ...algorithms.core.words import Keywords
from ..i18n import tr


class Fields(Keywords):
    """The labels of fields and the titles of tools in the user's language."""

    reproject = "with 'Reproject' of the group Point cloud data management"

    def __init__(self, algorithms: Iterable[Any]) -> None:
        # By the command and the option; without a command, the first tool that has the option.
        self._labels: dict[tuple[str, str], str] = {}
        self._titles = {"clear-cache": tr("Remove downloaded point clouds")}  # in the menu
        for algorithm in algorithms:
            self._titles.setdefault(algorithm.command, algorithm.displayName())

    def add_labels(self, algorithms: Iterable[Any]) -> None:
        """Add the labels of algorithms, which have fields only when they are registered."""
        for algorithm in algorithms:
            for field in algorithm.parameterDefinitions():
                for command in (algorithm.command, ""):
                    key = command, field.name().lower()
                    self._labels.setdefault(key, field.description())

    def tool(self, command: str) -> str:
        """Return the title of a tool."""
        return f"'{self._titles.get(command, command)}'"

    def option(self, name: str, value: Any, command: str) -> str:
        """Return the label of a field, with its value unless it is a box to tick."""
        text = f"'{self._labels.get((command, name), name)}'"
        text += f" ({value})" if value not in (None, True) else ""
        return f"{text} of {self.tool(command)}" if command else text
