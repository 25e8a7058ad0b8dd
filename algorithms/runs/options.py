"""Options for runs on many files."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Iterable

from ..core.parameters import ParameterSet, parameter, parameter_of
from ..filters import DEFAULT_METHOD, METHODS
from ..filters.method import TERRAINS


@dataclass(frozen=True)
class TileMethod(ParameterSet):
    """The ground filter, by its name and a preset."""

    method: str = parameter(
        DEFAULT_METHOD,
        label="Method",
        choices={name: method.label for name, method in METHODS.items()},
        help="The ground filter. TIN densification is the most accurate.",
    )
    preset: str = parameter(
        "automatic",
        label="Preset",
        choices=TERRAINS,
        help="The values of the method for a kind of terrain. For other values, use the command"
        " line or the algorithm of the method.",
    )

    @property
    def parameters(self) -> ParameterSet:
        """The parameters of the method."""
        return METHODS[self.method].parameters(preset=self.preset)


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
class ShownTiles(TileOutput):
    """The same with an overview by default, since QGIS shows the tiles at once."""

    overview: bool = parameter_of(TileOutput, "overview", default=True)


def as_command(sets: Iterable[ParameterSet]) -> list[ParameterSet]:
    """Return parameter sets of a dialog as those of the command, whose defaults differ."""
    return [TileOutput(**vars(each)) if isinstance(each, ShownTiles) else each for each in sets]


@dataclass(frozen=True)
class RasterOutput(ParameterSet):
    """How the rasters of many files are cut."""

    raster_per_file: bool = parameter(
        False,
        label="One raster for each file",
        advanced=True,
        help="Cuts each raster of many files into one GeoTIFF for each file. They get the names of"
        " the files, in a folder with the name of the raster. A virtual raster (.vrt) beside this"
        " folder shows them as one.",
    )
