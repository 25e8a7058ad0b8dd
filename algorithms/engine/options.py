"""What can be chosen for the classification of many files."""

from __future__ import annotations

from dataclasses import dataclass

from ..core.parameters import ParameterSet, parameter
from ..filters import DEFAULT_METHOD, METHODS


@dataclass(frozen=True)
class TileMethod(ParameterSet):
    """The ground filter in short: its name, and a preset that each of them has."""

    method: str = parameter(
        DEFAULT_METHOD,
        label="Method",
        choices={name: method.label for name, method in METHODS.items()},
        help="The ground filter. TIN densification is the most accurate.",
    )
    preset: str = parameter(
        "automatic",
        label="Preset",
        choices={
            "automatic": "Automatic",
            "flat": "Flat land, fields",
            "hilly": "Hilly land, forest",
            "steep": "Steep or rugged terrain",
            "town": "Town",
            "city": "City, large halls",
        },
        help="The values of the method, by terrain. Values of one's own can be given on the command"
        " line.",
    )

    @property
    def parameters(self) -> ParameterSet:
        """Those of the method."""
        return METHODS[self.method].parameters(preset=self.preset)


@dataclass(frozen=True)
class TileInput(ParameterSet):
    """Which files are taken."""

    recursive: bool = parameter(
        False,
        label="Take the files in folders of folders",
        help="Searches a folder with all folders in it, instead of alone.",
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
            "copc.laz": "COPC, which QGIS shows without an index of its own",
        },
        help="The names of the files stay, but for what a format needs.",
    )
    resume: bool = parameter(
        False,
        label="Go on where a run before ended",
        help="Tiles that are done stay, if they were made from the same files with the same"
        " parameters. All others are classified anew.",
    )
