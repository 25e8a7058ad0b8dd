"""The commands of tools, from their declarations."""

from __future__ import annotations

import argparse
import dataclasses
import json
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Sequence

from ..tools import FILE_TOOLS, POINT_TOOLS, file_tool, point_tool
from .command import DONE, Command
from .options import (
    KEPT,
    UsageError,
    add_crs,
    add_extent,
    add_inputs,
    add_json,
    add_parameters,
    chosen,
)
from .runs import tell_of_survey
from .surveys import (
    AUTOMATIC,
    add_area,
    add_checkpoints,
    add_scheduler,
    area_of,
    checkpoints_of,
    workers_of,
)
from .terminal import Terminal, is_told, tell

if TYPE_CHECKING:
    from ..core.parameters import ParameterSet
    from ..tools.declaration import Input, Output


def command_of(name: str) -> Command:
    """Return the command of a tool, which is imported when its options are asked for."""
    if name in FILE_TOOLS:
        return Command(name, FILE_TOOLS[name].help, "", partial(_add_file_tool, name), _run)
    return Command(name, POINT_TOOLS[name].help, "", partial(_add_point_tool, name), _write)


def _add_file_tool(name: str, parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    tool = file_tool(name)
    parser.description = tool.command_about
    for declared in tool.inputs:
        _add_input(parser, declared)
    for output in tool.outputs:
        _add_output(parser, output)
    if tool.json is not None:
        add_json(parser, f"{tool.json} ".lstrip())
    add_parameters(parser, *tool.sets, titles=tool.titles)
    for parameter, flag in tool.flags.items():
        parser.add_argument(
            f"--{flag}", dest=parameter, metavar=flag.upper(), default=argparse.SUPPRESS,
            help=f"the same as --{parameter.replace('_', '-')}",
        )  # fmt: skip


def _add_output(parser: argparse.ArgumentParser, output: Output) -> None:
    if output.is_main:
        parser.add_argument(output.name, metavar="OUTPUT", type=Path, help=output.help)
        return
    metavar = "FOLDER" if output.kind == "folder" else "FILE"
    parser.add_argument(
        f"--{output.option}", dest=output.name, metavar=metavar, type=Path, help=output.help
    )


def _run(options: argparse.Namespace) -> int:
    """Let a tool read and write files."""
    from ..tools.running import run

    tool, sets = file_tool(options.command), chosen(options)
    inputs = {declared.name: _input_of(options, declared) for declared in tool.inputs}
    outputs = {output.name: getattr(options, output.name) for output in tool.outputs}
    if lacking := tool.lacks(inputs, sets):
        raise UsageError(lacking)
    with Terminal(options.verbose) as progress:
        found = run(tool, inputs, outputs, sets, progress)
    if tool.json is None:
        return DONE
    if options.json:
        print(
            json.dumps(found.as_dict() if hasattr(found, "as_dict") else dataclasses.asdict(found))
        )
    elif hasattr(found, "lines"):
        print("\n".join(found.lines()))
    elif tool.always_tells or is_told(options):
        places = [f"{outputs[output.name]}: " for output in tool.outputs if output.is_main]
        print(f"{''.join(places)}{found.text}")
    return DONE


def _add_point_tool(name: str, parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..engine.memory import Resources
    from ..runs.options import TileInput, TileOutput

    tool = point_tool(name)
    parser.description = tool.command_about
    add_inputs(parser, "a classified file, or ")
    add_crs(parser, KEPT)
    parser.add_argument(
        "output", metavar="OUTPUT", type=Path,
        help="the file to write (.las, .laz or .copc.laz), or a folder if there are many inputs",
    )  # fmt: skip
    add_scheduler(parser)
    add_json(parser)
    add_parameters(parser, *tool.sets, TileInput, TileOutput, Resources)
    for declared in tool.inputs:
        _add_input(parser, declared)


def _write(options: argparse.Namespace) -> int:
    """Write classified files with what a tool finds."""
    from ..runs.entry import write
    from ..runs.many_files import SurveySummary
    from ..runs.requests import PointRequest
    from ..survey.outputs import check_outputs

    tool, sets = point_tool(options.command), chosen(options)
    if any(declared.found for declared in tool.inputs):
        # To find them can take minutes.
        check_outputs([("cloud", options.output)], options.input)
    inputs = {declared.name: _input_of(options, declared, sets) for declared in tool.inputs}
    request = PointRequest.of(tool, sets, inputs, options.crs)
    workers, as_survey = workers_of(options, request.resources), bool(options.scheduler) or None
    with Terminal(options.verbose) as progress:
        done = write(options.input, options.output, request, progress, workers, as_survey)
    if isinstance(done, SurveySummary):
        return tell_of_survey(options, done)
    tell(options, done, f"{options.output.parent / done.text}")
    return DONE


def _add_input(parser: argparse.ArgumentParser, declared: Input) -> None:
    """Add the argument or the options of an input."""
    from ..survey.vector_files import FORMATS

    name, text = declared.name, declared.help.format(formats=FORMATS)
    option = f"--{name.replace('_', '-')}"
    if declared.kind == "clouds":
        add_inputs(parser, text, name)
    elif declared.kind == "crs":
        add_crs(parser)
    elif declared.kind == "area":
        add_area(parser, text, declared.more)
    elif declared.kind == "extent":
        add_extent(parser, text, declared.more)
    elif declared.kind == "words":
        parser.add_argument(option, metavar="WORD", nargs="+", default=(), help=text)
    elif declared.kind == "checkpoints":
        add_checkpoints(parser, text)
    elif declared.optional or declared.kind == "polygons":
        is_needed = not declared.optional
        parser.add_argument(option, metavar="FILE", dest=name, required=is_needed, help=text)
    else:
        kind: Callable[[str], Any] = Path if declared.kind == "cloud" else str
        parser.add_argument(name, metavar=declared.field_name, type=kind, help=text)


def _input_of(
    options: argparse.Namespace, declared: Input, sets: Sequence[ParameterSet] = ()
) -> Any:
    """Return what the options give for an input."""
    from ..survey.ground_classes import GroundClasses
    from ..survey.vector_files import read_boundary

    if declared.kind == "area":
        return area_of(options)
    given = getattr(options, declared.name)
    if given is None:
        return None
    if declared.kind == "raster":
        return declared.of(given)
    if declared.kind == "words":
        return tuple(given)
    if declared.kind == "checkpoints":
        return checkpoints_of(options)
    if declared.kind != "polygons":
        return given
    if declared.found is None or given.lower() != AUTOMATIC:
        return declared.of(read_boundary(Path(given)))
    with Terminal(options.verbose) as progress:
        return declared.found(options.input, GroundClasses.among(sets), options.crs, progress)
