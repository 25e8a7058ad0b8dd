"""The commands of the tools that write classified files anew, from their declarations."""

from __future__ import annotations

import argparse
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Sequence

from ..tools import POINT_TOOLS, point_tool
from .command import DONE, Command
from .options import KEPT, add_crs, add_inputs, add_json, add_parameters, chosen
from .surveys import AUTOMATIC, add_area, add_scheduler, area_of, tell_of_survey, workers_of
from .terminal import Terminal, tell

if TYPE_CHECKING:
    from ..core.parameters import ParameterSet
    from ..tools.declaration import Input


def command_of(name: str) -> Command:
    """Return the command of a tool, which is imported when its options are asked for."""
    return Command(name, POINT_TOOLS[name].help, "", partial(_add, name), _run)


def _add(name: str, parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
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
    for each in tool.inputs:
        _add_input(parser, each)


def _add_input(parser: argparse.ArgumentParser, declared: Input) -> None:
    from ..survey.vector_files import FORMATS

    if declared.kind == "area":
        add_area(parser, declared.help, declared.more)
        return
    flag, text = f"--{declared.name.replace('_', '-')}", declared.help.format(formats=FORMATS)
    is_required = declared.kind == "polygons"
    parser.add_argument(flag, metavar="FILE", required=is_required, help=text)


def _input_of(options: argparse.Namespace, declared: Input, sets: Sequence[ParameterSet]) -> Any:
    """Return what the options give for a further input."""
    from ..las.writing import check_cloud
    from ..survey.files import is_one_file
    from ..survey.ground_classes import GroundClasses
    from ..survey.vector_files import read_boundary

    if declared.kind == "area":
        return area_of(options)
    given = getattr(options, declared.name)
    if declared.kind == "raster":
        return None if given is None else declared.of(given)
    if declared.found is None or given.lower() != AUTOMATIC:
        return declared.of(read_boundary(Path(given)))
    # To find them can take minutes.
    if is_one_file(options.input):
        check_cloud(options.input[0], options.output)
    with Terminal(options.verbose) as progress:
        return declared.found(options.input, GroundClasses.among(sets), options.crs, progress)


def _run(options: argparse.Namespace) -> int:
    """Write classified files with what the tool finds."""
    from ..runs.entry import write
    from ..runs.many_files import SurveySummary
    from ..runs.requests import PointRequest

    tool, sets = point_tool(options.command), chosen(options)
    inputs = {each.name: _input_of(options, each, sets) for each in tool.inputs}
    request = PointRequest.of(tool, sets, inputs, options.crs)
    workers, as_survey = workers_of(options, request.resources), bool(options.scheduler) or None
    with Terminal(options.verbose) as progress:
        done = write(options.input, options.output, request, progress, workers, as_survey)
    if isinstance(done, SurveySummary):
        return tell_of_survey(options, done)
    tell(options, done, f"{options.output.parent / done.text}")
    return DONE
