"""The settings that can be compared, and the commands that run them on all points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from ...core.commands import shell_line
from ...core.files import split_name
from ...core.parameters import ParameterSet, parameter
from ...filters import METHODS
from ...filters.method import Method
from ...survey.files import Inputs
from ..ground.dialogs import METHOD_TOOLS
from ..ground.method import TileMethod

# Metres round the window that are read by default, at most.
USUAL_CONTEXT = 50.0


class Setting(NamedTuple):
    """A ground filter with one of its presets."""

    label: str  # the text that is shown
    method: Method
    preset: str

    @property
    def name(self) -> str:
        """Method and preset, such as slope:town."""
        return f"{self.method.name}:{self.preset}"

    @property
    def parameters(self) -> ParameterSet:
        """The parameters of the method."""
        return self.method.parameters(preset=self.preset)  # type: ignore[call-arg]

    def commands(self, paths: Inputs) -> tuple[str, str]:
        """Return the command that runs the setting on all points, and the call in the console of
        QGIS, or empty.
        """
        is_one, (stem, suffix) = paths.output_kind == "cloud", split_name(paths[0])
        output = f"{stem}_{self.name.replace(':', '_')}{suffix if is_one else ''}"
        target = paths[0].with_name(output)
        words = ["bare-earth", "classify", *map(str, paths), str(target)]
        words += ["--method", self.method.name, "--preset", self.preset]
        shell = shell_line(words + (["--crs", paths.stated] if paths.stated else []))
        # QGIS has another current folder.
        sources, output = [str(path.absolute()) for path in paths], str(target.absolute())
        values: dict[str, object]
        if is_one:
            dialog = next(tool for tool in METHOD_TOOLS if tool.method == self.method.name)
            algorithm = f"bareearth:{dialog.identifier}"
            values = {"INPUT": sources[0], "PRESET": self.preset, "OUTPUT": output}
        elif self.preset in _presets(TileMethod):
            algorithm, values = "bareearth:classifytiles", {
                "INPUT": sources, "METHOD": self.method.name, "PRESET": self.preset,
                "OUTPUT_FOLDER": output,
            }  # fmt: skip
        else:
            return shell, ""
        if paths.stated:
            values["CRS"] = paths.stated
        return shell, f"processing.run({algorithm!r}, {values!r})"


def _presets(declared: type[ParameterSet]) -> dict[str, str]:
    """Return the labels of the presets that a set of parameters has."""
    return next(dict(own.choices) for own in declared.declarations() if own.name == "preset")


# Every method with each of its presets, by name.
SETTINGS = {
    f"{method.name}:{preset}": Setting(f"{method.label}, {label}", method, preset)
    for method in METHODS.values()
    for preset, label in _presets(method.parameters).items()
}


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
