"""The commands, from the functions of the library."""

from __future__ import annotations

import argparse
import re
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Callable, NamedTuple, Sequence

from ..core.errors import BareEarthError
from ..tools import FILE_TOOLS, POINT_TOOLS, file_tool, point_tool
from .options import DONE, FAILED, Command, UsageError, add_json, add_parameters, chosen
from .terminal import Terminal, tell

if TYPE_CHECKING:
    from ..filters.method import Method
    from ..library.arguments import Argument
    from ..library.functions import Function
    from ..tools.declaration import Tool

# What values are called in the help, where not FILE.
_METAVARS = {
    "source": "INPUT", "folder": "FOLDER", "like": "RASTER", "scheduler": "ADDRESS",
    "crs": "CRS", "checkpoints_crs": "CRS",
    "columns": "x=E,y=N,z=H,cover=Class,type=Use,name=ID",
}  # fmt: skip
_KEYWORD = re.compile(r"`([a-z_]+)`")  # in texts of the library
_BOX = ("XMIN", "YMIN", "XMAX", "YMAX")
_HELP = {
    "scheduler": "with many files: the address of a Dask scheduler, such as tcp://host:8786, whose"
    " workers do the work; without it, processes of this computer do it",
}


class _Run(NamedTuple):
    """What a command has beside the function of the library."""

    name: str
    help: str
    description: str
    titles: tuple[str, ...]  # of the parameter sets
    tell: Callable[[argparse.Namespace, Any], int]  # given what was done; returns the exit code
    json: str = "what was done"
    function: str = ""  # if it is not that of the name


def tool_command(name: str) -> Command:
    """Return the command of a tool, which is imported when its options are asked for."""
    listed = FILE_TOOLS.get(name) or POINT_TOOLS[name]
    work = _do_file_tool if name in FILE_TOOLS else _do_point_tool
    return Command(name, listed.help, "", partial(_add_tool, name), partial(work, name))


def _command_of(run: _Run) -> Command:
    return Command(run.name, run.help, run.description, partial(_add, run), partial(_do, run))


def _add(run: _Run, parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    """Add the arguments of the function as options."""
    from ..library.table import declared

    function = declared(run.function or run.name)
    sets, titles = function.sets, run.titles
    if run.name == "deliver":
        _add_deliveries(parser)
    _add_arguments(parser, function)
    if function.has_method:
        method = _add_method(parser, arguments)
        sets, titles = (method.parameters, *sets), (f"{method.label} parameters", *titles)
    add_json(parser, f"{run.json} ")
    add_parameters(parser, *sets, titles=titles)


def _add_tool(name: str, parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    """Add the arguments of the function of a tool as options."""
    from ..library.tools import of_tool

    function = of_tool(name)
    tool: Tool = file_tool(name) if name in FILE_TOOLS else point_tool(name)
    parser.description = tool.command_about
    _add_arguments(parser, function)
    if tool.json is not None:
        add_json(parser, f"{tool.json} ".lstrip())
    add_parameters(parser, *function.sets, titles=tool.titles)
    for parameter, flag in function.flags.items():
        parser.add_argument(
            f"--{flag}", dest=parameter, metavar=flag.upper(), default=argparse.SUPPRESS,
            help=f"the same as {_option(parameter)}",
        )  # fmt: skip


def _add_arguments(parser: argparse.ArgumentParser, function: Function) -> None:
    for argument in (*function.positional, *function.keywords):
        if argument.name not in ("progress", "delivery"):
            _add_argument(parser, argument)


def _add_argument(parser: argparse.ArgumentParser, argument: Argument) -> None:
    from ..library.arguments import KINDS, REQUIRED

    name, text = argument.name, _HELP.get(argument.name, argument.help).replace("%", "%%")
    text = _KEYWORD.sub(lambda found: _option(found[1]), text)
    text = text.replace(", or their x, y and z in the CRS of the points", "")  # of arrays
    is_needed, metavar = argument.default is REQUIRED, _METAVARS.get(name, "FILE")
    if argument.kind == KINDS["clouds"]:
        parser.add_argument(name, metavar="INPUT", type=Path, nargs="+", help=text)
    elif is_needed and argument.kind == KINDS["path"]:
        parser.add_argument(name, metavar=_METAVARS.get(name, name.upper()), help=text)
    elif argument.kind == KINDS["extent"]:
        text = text.replace("xmin, ymin, xmax, ymax: ", "")
        parser.add_argument(_option(name), nargs=4, type=float, metavar=_BOX, help=text)
    elif argument.kind == KINDS["words"]:
        parser.add_argument(_option(name), nargs="+", metavar="WORD", help=text)
    else:
        parser.add_argument(_option(name), metavar=metavar, required=is_needed, help=text)


def _option(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _add_deliveries(parser: argparse.ArgumentParser) -> None:
    from ..delivery.deliveries import DELIVERIES

    kinds = " ".join(f"{name}: {delivery.about}" for name, delivery in DELIVERIES.items())
    parser.add_argument("delivery", choices=list(DELIVERIES), help=f"what to deliver. {kinds}")


def _add_method(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> Method:
    """Add the option for the ground filter, and return the method in the command line."""
    from ..filters import DEFAULT_METHOD, METHODS

    parser.add_argument(
        "--method", choices=list(METHODS), default=DEFAULT_METHOD,
        help="the ground filter (default: %(default)s)",
    )  # fmt: skip
    # The other options depend on the method, which is in the same command line.
    named = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    named.add_argument("--method", default=DEFAULT_METHOD)
    return METHODS.get(named.parse_known_args(arguments)[0].method, METHODS[DEFAULT_METHOD])


def _do(run: _Run, options: argparse.Namespace) -> int:
    """Call the function, and tell what was done."""
    from ..library.given import is_automatic
    from ..library.table import declared

    if run.name in (_CLASSIFY, _TILES) and is_automatic(options.water):
        raise UsageError(
            "Water is found in classified points: make the rasters with 'bare-earth terrain"
            " --water automatic'."
        )
    return run.tell(options, _called(declared(run.function or run.name), options))


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
        tell(options, found, "\n".join(found.lines()), always=True)
        return DONE
    places = [f"{getattr(options, output.name)}: " for output in tool.outputs if output.is_main]
    tell(options, found, f"{''.join(places)}{found.text}", tool.always_tells)
    return DONE


def _do_point_tool(name: str, options: argparse.Namespace) -> int:
    """Write classified files with what a tool finds, and tell what was done."""
    from ..library.tools import of_tool
    from ..runs.many_files import SurveySummary

    done = _called(of_tool(name), options)
    if isinstance(done, SurveySummary):
        return _tell_of_survey(options, done)
    tell(options, done, f"{Path(options.output).parent / done.text}")
    return DONE


def _called(function: Function, options: argparse.Namespace) -> Any:
    """Call a function with the values of the options."""
    sets = chosen(options)
    _check_boxes(options)
    is_survey = options.command == _TILES
    values = SimpleNamespace(**vars(options), in_processes=True, is_survey=is_survey)
    with Terminal(options.verbose) as values.progress:
        return function.run(values, sets)


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


def _tell_of_survey(options: argparse.Namespace, summary: Any) -> int:
    """Print the result for many files; return the exit code."""
    tell(options, summary, f"{options.output}: {summary.text}")
    return FAILED if summary.failures else DONE


def _tell_of_ground(options: argparse.Namespace, done: Any) -> int:
    from ..runs.one_file import Summary

    if not isinstance(done, Summary):
        return _tell_of_survey(options, done)
    ground, count = done.area_ground_count, done.area_count
    place = "" if options.extent is None and options.boundary is None else " in the area"
    text = f"{ground:,} of {count:,} points{place} are ground ({100 * ground / count:.1f} %)"
    tell(options, done, f"{options.output}: {text}")
    return DONE


def _tell_of_rasters(options: argparse.Namespace, done: Any) -> int:
    text = f"{done.columns:,} x {done.rows:,} cells of {done.ground_count:,} ground points"
    tell(options, done, f"{options.sources[0]}: {text}")
    return DONE


def _tell_of_delivery(options: argparse.Namespace, done: Any) -> int:
    text = "\n".join([f"{options.output}: {done.text}", *done.lines()])
    tell(options, done, text, always=True)
    return FAILED if done.failures else DONE


_CLASSIFY, _TILES = "classify", "classify-tiles"
_ABOUT = (
    " Many files, folders and virtual point clouds are one survey: each point gets the class that"
    " it would get if all were one file, so there are no seams. A file that cannot be classified"
    " is reported at the end. To see the parameters of a method, give --method before --help."
)
_TITLES = (
    "Which points, which classes", "Above the ground", "Terrain model", "Surface model and gaps",
    "Contour lines", "Output", "Files", "Output of many files", "Rasters of many files",
    "Threads and memory",
)  # fmt: skip
_DELIVERY_TITLES = (
    "Delivery", "Which points, which classes", "Terrain model", "Surface model and gaps",
    "Contour lines", "Water", "Checkpoints", "Files", "Output of many files", "Threads and memory",
)  # fmt: skip

CLASSIFY, TILES, DELIVER, TERRAIN = map(_command_of, (
    _Run(
        _CLASSIFY,
        "classify the ground points of a file, or of many as one survey",
        "Classifies the ground points of LAS, LAZ and COPC files. Only the classification changes"
        " in the output." + _ABOUT,
        _TITLES,
        _tell_of_ground,
        "the counts",
    ),
    _Run(
        _TILES,
        "the same as classify, but always writes into a folder",
        "Classifies the ground points of LAS, LAZ and COPC files, and writes each into a folder."
        + _ABOUT,
        _TITLES,
        _tell_of_ground,
        "the counts",
        function=_CLASSIFY,
    ),
    _Run(
        "deliver",
        "make everything that a job hands over, in one run",
        "Classifies raw points and makes all outputs that a job hands over, in one folder: points,"
        " rasters, lines, figures of quality and accuracy, and a page that lists them (index.html)."
        " Each delivery has settings of its own. The options replace them.",
        _DELIVERY_TITLES,
        _tell_of_delivery,
        "the figures",
    ),
    _Run(
        "terrain",
        "make rasters of the terrain and of what stands on it",
        "Makes rasters (GeoTIFF) of a classified file, or of many as one survey. Give at least one"
        " of --contours and of --dtm, --dsm and the other options with GeoTIFF files.",
        (),
        _tell_of_rasters,
    ),
))  # fmt: skip
