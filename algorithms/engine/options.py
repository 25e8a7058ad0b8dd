"""Options of a run: which files it reads, how it writes them, and what it may use."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Iterable

from ..core.parameters import ParameterSet, parameter
from ..crs.stated import stated_wkt
from .memory import Resources


@dataclass(frozen=True)
class TileInput(ParameterSet):
    """Which files are used."""

    recursive: bool = parameter(
        False,
        label="Include subfolders",
        help="Searches each folder with all its subfolders.",
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
    overview: bool = parameter(
        False,
        label="Overview of the virtual point cloud",
        advanced=True,
        help="Writes a few points of all tiles into a further COPC file beside the virtual point"
        " cloud, if the tiles are COPC. QGIS 3.42 and newer shows them at small scales.",
    )


@dataclass(frozen=True)
class RunOptions:
    """Which files a run reads, how it writes them, and what it may use."""

    files: TileInput = field(default_factory=TileInput)  # of folders
    # of many files: their format, and whether finished ones are kept
    tiles: TileOutput = field(default_factory=TileOutput)
    resources: Resources = field(default_factory=Resources)
    # The CRS of the points in place of that of files: an EPSG code such as "EPSG:2230", or WKT.
    # Written point clouds keep their records.
    crs: str | None = None

    @classmethod
    def of(cls, sets: Iterable[ParameterSet], crs: str | None = None) -> RunOptions:
        """Return the options among parameter sets of a tool."""
        files, tiles = TileInput.among(sets), TileOutput.among(sets)
        return cls(files, tiles, Resources.among(sets), crs)

    @property
    def stated(self) -> str | None:
        """The well-known text of `crs`, or an error if it is not known."""
        return stated_wkt(self.crs)
