"""Parameters of a run: which files it reads, and how it writes them."""

from __future__ import annotations

from dataclasses import dataclass

from ..core.parameters import ParameterSet, parameter


@dataclass(frozen=True)
class TileInput(ParameterSet):
    """Which files are used."""

    recursive: bool = parameter(
        False, label="Include subfolders", help="Searches each folder with all its subfolders."
    )


@dataclass(frozen=True)
class TileOutput(ParameterSet):
    """How the tiles are written."""

    format: str = parameter(
        "same",
        label="Format of the output",
        choices={
            "same": "As the input",
            "las": "LAS",
            "laz": "LAZ",
            "copc.laz": "COPC, which QGIS shows at once",
        },
        help="Files keep their names; only the ending follows the format.",
    )
    resume: bool = parameter(
        False,
        label="Continue an earlier run",
        help="Keeps the tiles that an earlier run finished, if they were made from the same files"
        " with the same parameters. All other tiles are classified again.",
    )
