"""The ground filter, for runs on many files, which have no parameters of their own for it."""

from __future__ import annotations

from dataclasses import dataclass

from ...core.parameters import ParameterSet, parameter
from ...filters import DEFAULT_METHOD, METHODS
from ...filters.method import TERRAINS


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
