"""The commands, from the functions of the library."""

from __future__ import annotations

import argparse
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Sequence

from ..core.errors import BareEarthError, UsageError
from ..core.imports import import_only_what_runs_need
from ..core.words import in_words
from ..remote.addresses import is_address, name_of
from ..tools import any_tool, file_tool
from ..tools.listing import COMPOSITIONS, FILE_TOOLS, MAP_TOOLS, POINT_TOOLS, listed
from .options import DONE, FAILED, Command, add_json, add_parameters, chosen
from .terminal import Terminal, report

if TYPE_CHECKING:
    from ..filters.method import Method
    from ..library.arguments import Argument
    from ..library.functions import Function

# What values are called in the help, where not FILE.
_METAVARS = {
    "source": "INPUT", "folder": "FOLDER", "cache": "FOLDER", "like": "RASTER",
    "scheduler": "ADDRESS",
    "crs": "CRS", "checkpoints_crs": "CRS",
    "columns": "x=E,y=N,z=H,cover=Class,type=Use,name=ID",
}  # fmt: skip
# Kinds of values that are arguments without a flag if the command needs them.
_NEEDED = ("path", "text", "cloud", "raster", "terrain")
_BOX = ("XMIN", "YMIN", "XMAX", "YMAX")


def tool_command(name: str) -> Command:
    """Return the command of a tool, which is imported when its options are asked for."""
    kinds = (
        (FILE_TOOLS, _do_file_tool), (POINT_TOOLS, _do_on_points), (MAP_TOOLS, _do_on_points),
        (COMPOSITIONS, _do_composition),
    )  # fmt: skip
    work = next(work for tools, work in kinds if name in tools)
    return Command(name, listed(name).line, "", partial(_add_tool, name), partial(work, name))


def _add_tool(name: str, parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    """Add the arguments of the function of a tool as options."""
    from ..library.tools import of_tool

    function, tool = of_tool(name), any_tool(name)
    parser.description = in_words(tool.help)
    _add_arguments(parser, function)
    sets, titles = function.sets, tool.titles
    if function.has_method:
        method = _add_method(parser, arguments)
        sets, titles = (method.parameters, *sets), (f"{method.label} parameters", *titles)
    if tool.json is not None:
        add_json(parser, f"{tool.json} ".lstrip())
    add_parameters(parser, *sets, titles=titles)
    for parameter, flag in function.flags.items():
        parser.add_argument(
            f"--{flag}", dest=parameter, metavar=flag.upper(), default=argparse.SUPPRESS,
            help=f"the same as {_option(parameter)}",
        )  # fmt: skip


def _add_arguments(parser: argparse.ArgumentParser, function: Function) -> None:
    given = (*function.positional, *function.keywords)
    for argument in (argument for argument in given if argument.choices):
        parser.add_argument(argument.name, choices=argument.choices, help=argument.help)
    for argument in given:
        if argument.name != "progress" and not argument.choices:
            _add_argument(parser, argument)


def _add_argument(parser: argparse.ArgumentParser, argument: Argument) -> None:
    from ..library.arguments import KINDS, REQUIRED

    name, text = argument.name, in_words(argument.help).replace("%", "%%")
    text = text.replace("Empty:", "Without it:")
    is_needed, metavar = argument.default is REQUIRED, _METAVARS.get(name, "FILE")
    if argument.kind == KINDS["clouds"]:
        parser.add_argument(name, metavar="INPUT", nargs="+", help=text)
    elif argument.kind == KINDS["number"]:  # that of remote inputs; `change` has a raster `limit`
        parser.add_argument(_option(name), type=float, metavar="GB", help=text)
    elif is_needed and argument.kind in map(KINDS.get, _NEEDED):
        parser.add_argument(name, metavar=_METAVARS.get(name, name.upper()), help=text)
    elif argument.kind == KINDS["extent"]:
        parser.add_argument(_option(name), nargs=4, type=float, metavar=_BOX, help=text)
    elif argument.kind == KINDS["words"]:
        parser.add_argument(_option(name), nargs="+", metavar="WORD", help=text)
    else:
        parser.add_argument(_option(name), metavar=metavar, required=is_needed, help=text)


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _add_method(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> Method:
    """Add the option for the ground filter, and return the method in the command line."""
    from ..filters import DEFAULT_METHOD, METHODS

    parser.add_argument(
        "--method", choices=list(METHODS), default=DEFAULT_METHOD,
        help="The ground filter. The help tells the parameters of the one that is named before"
        " --help. (default: %(default)s)",
    )  # fmt: skip
    # The other options depend on the method, which is in the same command line.
    named = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    named.add_argument("--method", default=DEFAULT_METHOD)
    return METHODS.get(named.parse_known_args(arguments)[0].method, METHODS[DEFAULT_METHOD])


def _do_file_tool(name: str, options: argparse.Namespace) -> int:
    """Let a tool read and write files, and tell what it found."""
    from ..library.tools import of_tool

    tool = file_tool(name)
    if lacking := tool.lacks(vars(options), chosen(options)):
        raise UsageError(lacking)
    found = _called(of_tool(name), options)
    if tool.json is None:
        return DONE
    if hasattr(found, "lines"):
        report(options, found, "\n".join(found.lines()), always=True)
        return DONE
    places = [f"{getattr(options, output.name)}: " for output in tool.outputs if output.is_main]
    report(options, found, f"{''.join(places)}{found.text}", tool.always_reports)
    return DONE


def _do_on_points(name: str, options: argparse.Namespace) -> int:
    """Write what a tool finds for points, or makes of them, and tell what was done."""
    from ..library.tools import of_tool

    done, source = _called(of_tool(name), options), options.sources[0]
    source = name_of(source) if is_address(source) else source
    report(options, done, done.line(Path(getattr(options, "output", source))))
    return FAILED if done.failures else DONE


def _do_composition(name: str, options: argparse.Namespace) -> int:
    """Let tools work one after another, and tell the figures of what they made."""
    from ..library.tools import of_tool

    done = _called(of_tool(name), options)
    text = "\n".join([f"{options.output}: {done.text}", *done.lines()])
    report(options, done, text, always=True)
    return FAILED if done.failures else DONE


def _called(function: Function, options: argparse.Namespace) -> Any:
    """Call a function with the values of the options."""
    import_only_what_runs_need()
    sets = chosen(options)
    _check_boxes(options)
    values = SimpleNamespace(**vars(options), in_processes=True)
    with Terminal(options.verbose) as values.progress:
        return function.work(values, sets)


def _check_boxes(options: argparse.Namespace) -> None:
    """Refuse rectangles that are none as wrong usage."""
    from ..rasters.cell_grid import RasterTarget
    from ..survey.area import Area

    try:
        if getattr(options, "extent", None) is not None:
            Area(tuple(options.extent))
        if getattr(options, "raster_extent", None) is not None:
            RasterTarget(options.like, tuple(options.raster_extent))
    except BareEarthError as error:
        raise UsageError(str(error)) from error
