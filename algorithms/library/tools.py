"""The functions of tools, from their declarations."""

from __future__ import annotations

import inspect
import sys
from dataclasses import replace
from functools import cache, partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Callable, Sequence

from ..core.errors import UsageError
from ..core.parameters import ParameterSet
from ..core.words import option
from ..engine.memory import Resources
from ..engine.options import TileInput, TileOutput
from ..survey.files import Inputs
from ..tools import composition, file_tool, map_tool, point_tool
from ..tools.declaration import POINTS, Automatic, Input, Tool
from ..tools.input_groups import GROUPS
from ..tools.listing import COMPOSITIONS, FILE_TOOLS, MAP_TOOLS, POINT_TOOLS
from . import arguments, tool_commands
from .arguments import KINDS, REQUIRED, Argument
from .functions import Function
from .given import (
    area_of,
    checkpoints_of,
    constraints_of,
    corrections_of,
    inputs_of,
    is_automatic,
    path_of,
    polygons_of,
    progress_of,
    target_of,
    workers_of,
)
from .raster_inputs import heights_of

CLASSIFIED = replace(arguments.SOURCES, help=f"{POINTS.help} {arguments.SOURCES.help}")
_REACHES = (*arguments.REMOTE, arguments.SCHEDULER, arguments.PROGRESS)
# Functions that read the inputs with several arguments.
_READERS: dict[str, Callable[[SimpleNamespace], object]] = {
    "area": area_of,
    "checkpoints": checkpoints_of,
    "constraints": constraints_of,
    "corrections": corrections_of,
    "target": target_of,
}


def of_tool(command: str) -> Function:
    """Return the function of a tool."""
    if command in COMPOSITIONS:
        return _of_composition(command)
    if command in MAP_TOOLS:
        return _of_map_tool(command)
    return _of_file_tool(command) if command in FILE_TOOLS else _of_point_tool(command)


@cache
def declared(name: str) -> Function:
    """Return the declaration of a function, given its name."""
    return of_tool(tool_commands()[name])


@cache
def function(name: str) -> Callable[..., Any]:
    """Return a function, given its name."""
    return declared(name).callable()


def _of_file_tool(command: str) -> Function:
    from ..tools.running import run as run_tool

    tool = file_tool(command)
    given = [argument for declared in tool.inputs for argument in arguments_of(declared)]
    given += map(arguments.of_output, tool.outputs)
    needed = (declared.kind for declared in tool.inputs if not declared.optional)
    if any(kind in ("cloud", "clouds") for kind in needed):
        given += arguments.REMOTE

    def run(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> object:
        inputs = {declared.name: input_of(declared, values) for declared in tool.inputs}
        outputs = _outputs_of(tool, values)
        return run_tool(tool, inputs, outputs, sets, progress_of(values.progress))

    # The class of the summary, and that of many files if it has another: the work of the tool is
    # annotated with both.
    names = str(inspect.signature(tool.work).return_annotation).split(" | ")
    result, *many = (getattr(sys.modules[tool.work.__module__], name, None) for name in names)
    return Function(
        command.replace("-", "_"),
        tool.help,
        tuple(argument for argument in given if argument.default is REQUIRED),
        (*(argument for argument in given if argument.default is not REQUIRED), arguments.PROGRESS),
        tool.sets,
        run,
        result,
        flags=tool.flags,
        result_of_many=many[0] if many else None,
    )


def arguments_of(declared: Input) -> tuple[Argument, ...]:
    """Return the arguments for an input of a tool."""
    if declared.kind == "area":
        return arguments.area(declared.help)
    if declared.kind in GROUPS:
        with_water = arguments.WITH_AUTOMATIC_WATER
        return with_water if declared.found else arguments.of_group(declared.kind)
    if declared.kind == "crs":
        return (arguments.CRS,)
    if declared.kind == "clouds":
        if declared.name == "source":  # as the function had it when it took one file
            return (replace(arguments.SOURCES, name=declared.name),)
        return (CLASSIFIED if declared.help else arguments.SOURCES,)
    kind = "text" if declared.kind == "address" else declared.kind
    is_local = kind not in KINDS or (kind == "cloud" and declared.optional)  # never downloaded
    kind = "path" if is_local else kind
    is_required = not declared.optional and kind not in ("extent", "words")
    default = REQUIRED if is_required else None
    return (Argument.of(declared.name, kind, declared.help, default),)


def input_of(declared: Input, values: SimpleNamespace) -> object:
    """Return the value of an input of a tool from the arguments of its function."""
    can_be_found = declared.found is not None or declared.kind == "constraints"
    is_found = can_be_found and is_automatic(values.water)
    if is_found and declared.found is None:
        how = option("water", "automatic", of="terrain")
        raise UsageError(f"Water is found in classified points: make the rasters with {how}.")
    if declared.kind in _READERS:
        given = _READERS[declared.kind](values)
        return Automatic(given) if is_found else given
    value = getattr(values, declared.name)
    if declared.kind == "polygons":
        if is_found:
            return Automatic()
        return declared.of(polygons_of(value, declared.may_be_empty))
    if declared.kind == "clouds":
        return Inputs(value)
    if declared.kind == "words":
        return tuple(value or ())
    if value is None or declared.kind == "crs":
        return value
    if declared.kind == "extent":
        return tuple(map(float, value))
    if declared.kind in ("raster", "terrain"):
        return declared.of(heights_of(value))
    return Path(value) if declared.kind == "cloud" else declared.of(str(value))


def _of_point_tool(command: str) -> Function:
    tool = point_tool(command)
    return Function(
        POINT_TOOLS[command].file,
        tool.help,
        (*arguments_of(tool.points), *map(arguments.of_output, tool.all_outputs)),
        (
            *(argument for declared in tool.inputs for argument in arguments_of(declared)),
            arguments.CRS, *_REACHES,
        ),
        (*tool.sets, TileInput, TileOutput, Resources),
        partial(_run_on_points, tool),
        tool.step.summary_type,
        looks_around=tool.looks_around,
    )  # fmt: skip


def _run_on_points(tool: Tool, values: SimpleNamespace, sets: Sequence[ParameterSet]) -> object:
    from ..tools.running import run

    outputs = _outputs_of(tool, values)
    target = getattr(values, "output", None)
    # One file, too, is written under its name into a folder.
    is_folder = target is not None and (Path(target).is_dir() or not Path(target).suffix)
    points = inputs_of(values, is_folder)
    inputs: dict[str, object] = {"input": points, "crs": values.crs}
    inputs.update((declared.name, input_of(declared, values)) for declared in tool.inputs)
    workers = workers_of(values, Resources.among(sets))
    return run(tool, inputs, outputs, sets, progress_of(values.progress), workers)


def _of_map_tool(command: str) -> Function:
    """Return the function of a tool that makes rasters of points."""
    from ..tools.ground.summary import Summary
    from ..tools.rasters.output import RasterSize

    tool = map_tool(command)
    first = [arguments.of_output(output) for output in tool.all_outputs if not output.advanced]
    inputs = [argument for declared in tool.inputs for argument in arguments_of(declared)]
    last = [arguments.of_output(output) for output in tool.all_outputs if output.advanced]
    last += [arguments.VPC] if tool.classifies else []
    return Function(
        command,
        tool.help,
        (arguments.SOURCES, arguments.OUTPUT) if tool.classifies else (CLASSIFIED,),
        (
            arguments.CRS,
            *first,
            *inputs,
            *last,
            *_REACHES,
        ),
        tool.sets,
        partial(_run_on_points, tool),
        Summary if tool.classifies else RasterSize,
        has_method=tool.classifies,
        classifies=tool.classifies,
    )


def _of_composition(command: str) -> Function:
    from ..delivery.summary import DeliverySummary

    tool = composition(command)

    def run(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> object:
        inputs = {declared.name: _READERS[declared.kind](values) for declared in tool.inputs}
        inputs["crs"] = values.crs
        workers = workers_of(values, Resources.among(sets))
        places, table = (values.sources, values.output), getattr(values, tool.chosen)
        progress = progress_of(values.progress)
        return tool.work(*places, table, sets, inputs, progress, workers, values.named)

    tables = (f"{name}: {table.about}" for name, table in tool.tables.items())
    help = " ".join((tool.chosen_help, *tables))
    return Function(
        command,
        tool.help,
        (arguments.SOURCES, *map(arguments.of_output, tool.outputs)),
        (
            Argument.choice(tool.chosen, tool.tables, tool.default, help),
            *(argument for declared in tool.inputs for argument in arguments_of(declared)),
            arguments.CRS,
            *_REACHES,
        ),
        tool.sets,
        run,
        DeliverySummary,
        has_method=True,
    )


def _outputs_of(tool: Tool, values: SimpleNamespace) -> dict[str, Path | None]:
    """Return the paths of the outputs of a tool, by their names, and of the points."""
    names = {output.name: output.option.replace("-", "_") for output in tool.all_outputs}
    names = {"output": "output", "vpc": "vpc", **names}
    return {name: path_of(getattr(values, option, None)) for name, option in names.items()}
