"""The command that does the same as a run without QGIS."""

from __future__ import annotations

from typing import Any, Collection, Mapping, Sequence

from ...algorithms.core.commands import shell_line
from ...algorithms.core.parameters import ParameterSet, shown_value
from ...algorithms.tools.declaration import MapTool, Output
from ..i18n import mark
from .feedback import Refusal
from .request import Options, Resolved


def command_of(
    tool: Any, outputs: Sequence[Output], paths: Mapping[str, str], resolved: Resolved
) -> str:
    """Return the command line that does the same as a run of a tool, given its paths by name."""
    words = [*resolved.arguments, *(paths[one.name] for one in outputs if one.is_main)]
    own = {one.option: paths[one.name] for one in outputs if not one.is_main}
    options = {**resolved.options, **own}
    if not isinstance(tool, MapTool):
        # The command can have other defaults.
        sets = [
            of_command(**vars(values))
            for of_command in tool.sets
            for values in resolved.sets
            if isinstance(values, of_command)
        ]
        return command_line(tool.command, words, sets, options)
    if not any(paths.values()):
        raise Refusal(mark("Choose at least one raster to make."))
    extent = options.pop("extent", None)
    line = command_line(tool.command, words, resolved.sets, {"method": tool.method, **options})
    return " ".join([line, "--extent", *extent] if extent else [line])


def command_line(
    command: str,
    files: Sequence[str],
    chosen: Sequence[ParameterSet],
    options: Options,
    named: Collection[str] = (),
) -> str:
    """Return the command line, of a subcommand of `bare-earth` and its files, that does the same
    without QGIS; default values that are not `named` and empty options are left out.
    """
    words = ["bare-earth", command, *files]
    for option, value in options.items():
        if value:
            values = value if isinstance(value, tuple) else (value,)
            words += [f"--{option.lower().replace('_', '-')}", *values]
    for parameters in chosen:
        for declared in parameters.declarations():
            value = getattr(parameters, declared.name)
            if value != declared.default or declared.name in named:
                words += _option(declared.name.replace("_", "-"), value)
    return shell_line(words)


def _option(name: str, value: object) -> list[str]:
    if isinstance(value, bool):
        return [f"--{name}" if value else f"--no-{name}"]
    if isinstance(value, tuple):
        return [f"--{name}", *map(shown_value, value)]
    return [f"--{name}", "none" if value is None else str(value)]
