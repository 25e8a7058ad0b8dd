"""Options for comparing settings on a window."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet, parameter
from ..filters import METHODS
from ..filters.method import Method

# By default at most so many metres are read round the window.
USUAL_CONTEXT = 50.0


class Setting(NamedTuple):
    """A ground filter with one of its presets."""

    name: str  # method and preset, such as slope:town
    label: str  # the text that is shown
    method: Method
    preset: str

    @property
    def parameters(self) -> ParameterSet:
        """The parameters of the method."""
        return self.method.parameters(preset=self.preset)

    @property
    def reach(self) -> float:
        """Metres up to which points affect each other."""
        return self.method.reach(self.parameters)


def _settings() -> dict[str, Setting]:
    found = {}
    for method in METHODS.values():
        declared = {each.name: each for each in method.parameters.declarations()}
        for preset, label in declared["preset"].choices.items():
            name = f"{method.name}:{preset}"
            found[name] = Setting(name, f"{method.label}, {label}", method, preset)
    return found


# Every method with each of its presets, by name.
SETTINGS = _settings()


@dataclass(frozen=True)
class TrialOptions(ParameterSet):
    """Which settings are compared, and how much is read round the window."""

    settings: tuple[str, ...] = parameter(
        ("tin-densification:automatic", "grid-minimum:automatic", "slope:automatic"),
        kind="choices",
        label="Settings",
        choices={name: setting.label for name, setting in SETTINGS.items()},
        help="Methods, each with a preset. All others are compared with the first one.",
    )
    context: float | None = parameter(
        None,
        kind="number",
        label="Context round the window",
        unit="m",
        minimum=0.0,
        maximum=1000.0,
        advanced=True,
        empty=f"as far as the methods look, at most {USUAL_CONTEXT:g} m",
        help="Points up to this distance outside the window are read too, but not shown. A larger"
        " value is slower, and gives classes closer to those of the whole file near the edges of"
        " the window and beside large buildings. Empty: as far as the methods look, at most"
        f" {USUAL_CONTEXT:g} m.",
    )
    profile: tuple[float, ...] | None = parameter(
        None,
        kind="numbers",
        label="Line of the profile",
        advanced=True,
        empty="across the window where the terrains differ most",
        help="X and Y of both ends, in the CRS of the points: X1 Y1 X2 Y2. Empty: straight across"
        " the window where the terrains differ most, from west to east or from south to north.",
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.profile is not None and (
            len(self.profile) != 4 or self.profile[:2] == self.profile[2:]
        ):
            raise BareEarthError(
                "Line of the profile: give X1 Y1 X2 Y2, two places that are not the same."
            )

    @property
    def chosen(self) -> list[Setting]:
        """The settings, in the order in which they were given."""
        return [SETTINGS[name] for name in self.settings]
