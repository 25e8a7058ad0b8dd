"""The `bare-earth` command."""

from __future__ import annotations

import argparse
import dataclasses
import json
import signal
import sys
import traceback
from pathlib import Path
from typing import Any, Sequence

from .errors import BareEarthError, Cancelled
from .parameters import Declaration, ParameterSet
from .progress import Progress

_DONE, _FAILED, _USAGE = 0, 1, 2
_DEFAULT_METHOD = "tin-densification"
_NOT_USED = ("none", "automatic")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; return its exit code: 0 done, 1 failed, 2 wrong usage."""
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    _set_output_encoding()
    signal.signal(signal.SIGTERM, _stop)
    try:
        options = _parser(arguments).parse_args(arguments)
        return options.run(options)
    except SystemExit as error:  # argparse has said what is wrong
        return error.code if isinstance(error.code, int) else _USAGE
    except _UsageError as error:
        return _say(error, _USAGE, arguments)
    except BareEarthError as error:
        return _say(error, _FAILED, arguments)
    except (Cancelled, KeyboardInterrupt):
        return _say("Cancelled; nothing was written.", _FAILED, [])
    except MemoryError as error:
        return _say("There is not enough memory for this file.", _FAILED, arguments, error)
    except BrokenPipeError:
        return _FAILED
    except Exception as error:
        text = f"Unexpected {type(error).__name__}: {error}. Run with --verbose and report it."
        return _say(text, _FAILED, arguments, error)


class _UsageError(BareEarthError):
    """A value on the command line that is not allowed."""


def _stop(number: int, frame: object) -> None:
    """End as Ctrl-C does, so that temporary files are removed."""
    raise KeyboardInterrupt


def _set_output_encoding() -> None:
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")


def _say(
    what: object, code: int, arguments: Sequence[str], error: BaseException | None = None
) -> int:
    """Print one line on what went wrong; with --verbose, where it did."""
    if "--verbose" in arguments and (error is not None or isinstance(what, BaseException)):
        traceback.print_exc()
    print(f"bare-earth: {what}", file=sys.stderr)
    return code


class _Terminal(Progress):
    """Messages on standard error, and a progress bar where that is a terminal."""

    def __init__(self, verbose: bool) -> None:
        self._talks = verbose or sys.stderr.isatty()
        self._bar = _progress_bar() if sys.stderr.isatty() else None

    def report(self, fraction: float) -> None:
        if self._bar is not None:
            self._bar.update(round(100 * fraction) - self._bar.n)

    def info(self, text: str) -> None:
        if self._talks:
            self._write(text)

    def warning(self, text: str) -> None:
        self._write(f"Warning: {text}")

    def _write(self, text: str) -> None:
        if self._bar is not None:
            self._bar.clear()
        print(text, file=sys.stderr)

    def __enter__(self) -> _Terminal:
        return self

    def __exit__(self, *exception: object) -> None:
        if self._bar is not None:
            self._bar.close()


def _progress_bar() -> Any:
    try:
        from tqdm import tqdm
    except ImportError:
        return None
    layout = "{percentage:3.0f} % |{bar}| {elapsed}"
    return tqdm(total=100, bar_format=layout, leave=False, file=sys.stderr)


def _parser(arguments: Sequence[str]) -> argparse.ArgumentParser:
    from .. import __version__
    from .cli_tiles import add_classify_tiles

    parser = argparse.ArgumentParser(
        prog="bare-earth",
        description="Classifies lidar points into ground and non-ground, and makes terrain models.",
    )
    parser.add_argument("--version", action="version", version=f"%(prog)s {__version__}")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)
    common = argparse.ArgumentParser(add_help=False)
    common.add_argument(
        "--verbose", action="store_true", help="say what is done, and where an error arose"
    )
    _add_classify(commands, common, arguments)
    add_classify_tiles(commands, common, arguments)
    _add_info(commands, common)
    _add_assess(commands, common)
    _add_remove_objects(commands, common)
    _add_height(commands, common)
    _add_key_points(commands, common)
    _add_terrain(commands, common)
    return parser


def _add_classify(commands: Any, common: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from .filters import METHODS
    from .output import Output
    from .pointcloud.selection import Selection
    from .terrain.model import TerrainModel
    from .tiling.memory import Resources

    parser = commands.add_parser(
        "classify",
        parents=[common],
        help="classify the ground points of a file",
        description="Classifies the ground points of a LAS, LAZ or COPC file. The output equals the"
        " input but for the classification. Give --method before --help to see its parameters.",
    )
    parser.add_argument("input", metavar="INPUT", type=Path, help="a .las, .laz or .copc.laz file")
    parser.add_argument("output", metavar="OUTPUT", type=Path, help=".las, .laz or .copc.laz")
    parser.add_argument("--dtm", metavar="FILE", type=Path, help="write the terrain model (.tif)")
    parser.add_argument("--hillshade", metavar="FILE", type=Path, help="write its hillshade (.tif)")
    parser.add_argument(
        "--extent", nargs=4, type=float, metavar=("XMIN", "YMIN", "XMAX", "YMAX"),
        help="classify only points in this rectangle, in the CRS of the points",
    )  # fmt: skip
    parser.add_argument(
        "--boundary", metavar="FILE", type=Path,
        help="classify only points in these polygons (.geojson, .json, .wkt), in the CRS of the"
        " points",
    )  # fmt: skip
    parser.add_argument(
        "--method", choices=list(METHODS), default=_DEFAULT_METHOD,
        help="the ground filter (default: %(default)s)",
    )  # fmt: skip
    parser.add_argument("--json", action="store_true", help="print the counts as JSON")
    # The options to offer depend on the method, which is on the same command line.
    chosen = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    chosen.add_argument("--method", default=_DEFAULT_METHOD)
    method = METHODS.get(chosen.parse_known_args(arguments)[0].method, METHODS[_DEFAULT_METHOD])
    groups = {
        "parameters": (f"{method.label} parameters", method.parameters),
        "selection": ("Which points, which classes", Selection),
        "terrain": ("Terrain model", TerrainModel),
        "output": ("Output", Output),
        "resources": ("Threads and memory", Resources),
    }
    for title, declared in groups.values():
        add_options(parser.add_argument_group(title), declared)
    parser.set_defaults(
        run=_classify, groups={name: declared for name, (_, declared) in groups.items()}
    )


def _classify(options: argparse.Namespace) -> int:
    from .classification import classify_file

    parameters, selection, terrain, output, resources = _chosen(options)
    area = _area_of(options)
    with _Terminal(options.verbose) as progress:
        summary = classify_file(
            options.input,
            options.output,
            parameters,
            selection,
            terrain,
            dtm=options.dtm,
            hillshade=options.hillshade,
            progress=progress,
            area=area,
            resources=resources,
            output=output,
        )
    ground, count = summary.area_ground_count, summary.area_count
    place = "" if area is None else " in the area"
    text = f"{ground:,} of {count:,} points{place} are ground ({100 * ground / count:.1f} %)"
    return _tell(options, summary, f"{options.output}: {text}")


def _area_of(options: argparse.Namespace) -> Any:
    """Return the `Area` of the options, or None if they name none."""
    from .pointcloud.area import Area, read_boundary

    if options.extent is None and options.boundary is None:
        return None
    try:
        box = None if options.extent is None else Area(tuple(options.extent)).box
    except BareEarthError as error:
        raise _UsageError(str(error)) from error
    return Area(box, () if options.boundary is None else read_boundary(options.boundary))


def _add_info(commands: Any, common: argparse.ArgumentParser) -> None:
    parser = commands.add_parser(
        "info",
        parents=[common],
        help="describe a file",
        description="Describes a point cloud file.",
    )
    parser.add_argument("input", metavar="FILE", type=Path, help="a .las, .laz or .copc.laz file")
    parser.add_argument("--json", action="store_true", help="print as JSON")
    parser.set_defaults(run=_info)


def _info(options: argparse.Namespace) -> int:
    from .pointcloud.reading import inspect

    with _Terminal(options.verbose) as progress:
        description = inspect(options.input, progress)
    if options.json:
        print(json.dumps(description.as_dict()))
    else:
        print("\n".join(description.lines()))
    return _DONE


def _add_assess(commands: Any, common: argparse.ArgumentParser) -> None:
    from .assessment import AssessmentOptions

    parser = commands.add_parser(
        "assess",
        parents=[common],
        help="compare a classified file with a reference",
        description="Compares the ground (class 2) of a classified file with a reference that holds"
        " the same points: type I error (ground rejected), type II error (other accepted), total"
        " error and kappa, in percent.",
    )
    parser.add_argument("classified", metavar="CLASSIFIED", type=Path, help="the classified file")
    parser.add_argument("reference", metavar="REFERENCE", type=Path, help="the reference")
    parser.add_argument("--json", action="store_true", help="print as JSON")
    parser.add_argument("--report", metavar="FILE", type=Path, help="write a report (.html)")
    parser.add_argument(
        "--error-map", metavar="FILE", type=Path,
        help="write the share of wrong points in each cell, 0 to 1 (.tif)",
    )  # fmt: skip
    add_options(parser, AssessmentOptions)
    parser.set_defaults(run=_assess)


def _assess(options: argparse.Namespace) -> int:
    from .assessment import AssessmentOptions, assess_files

    chosen = from_options(AssessmentOptions, options)
    with _Terminal(options.verbose) as progress:
        assessment = assess_files(
            options.classified,
            options.reference,
            chosen,
            report=options.report,
            error_map=options.error_map,
            progress=progress,
        )
    print(json.dumps(assessment.as_dict()) if options.json else "\n".join(assessment.lines()))
    return _DONE


def _add_remove_objects(commands: Any, common: argparse.ArgumentParser) -> None:
    from .terrain.off_terrain import OffTerrain

    parser = commands.add_parser(
        "remove-off-terrain-objects",
        parents=[common],
        help="take buildings and trees out of an elevation raster",
        description="Takes what stands steeply above the terrain round it out of an elevation"
        " raster, and fills the gaps smoothly.",
    )
    parser.add_argument("input", metavar="INPUT", help="a raster that GDAL reads")
    parser.add_argument("output", metavar="OUTPUT", type=Path, help="GeoTIFF (.tif)")
    _add_groups(parser, {"parameters": OffTerrain}, _remove_objects)


def _remove_objects(options: argparse.Namespace) -> int:
    from .terrain.off_terrain import remove_objects_file

    with _Terminal(options.verbose) as progress:
        removal = remove_objects_file(options.input, options.output, *_chosen(options), progress)
    return _tell(options, removal, f"{options.output}: {removal.text}")


def _add_height(commands: Any, common: argparse.ArgumentParser) -> None:
    from .products import GroundClasses, HeightOutput

    parser = commands.add_parser(
        "height",
        parents=[common],
        help="add the height above ground of every point",
        description="Writes a classified file anew with the height of every point above the TIN of"
        " its ground points, in the vertical unit of the CRS.",
    )
    _add_cloud_arguments(parser, {"ground": GroundClasses, "output": HeightOutput}, _height)


def _height(options: argparse.Namespace) -> int:
    from .products import write_height_above_ground

    with _Terminal(options.verbose) as progress:
        summary = write_height_above_ground(
            options.input, options.output, *_chosen(options), progress
        )
    text = f"heights above ground are {summary.minimum:.2f} to {summary.maximum:.2f} {summary.unit}"
    return _tell(options, summary, f"{options.output}: {text}")


def _add_key_points(commands: Any, common: argparse.ArgumentParser) -> None:
    from .products import GroundClasses, KeyPointMark
    from .terrain.model_key_points import ModelKeyPoints

    parser = commands.add_parser(
        "key-points",
        parents=[common],
        help="mark the ground points that a terrain model needs",
        description="Writes a classified file anew with its model key points marked: the few ground"
        " points from whose TIN no other ground point lies farther than the tolerance.",
    )
    groups = {"parameters": ModelKeyPoints, "ground": GroundClasses, "mark": KeyPointMark}
    _add_cloud_arguments(parser, groups, _key_points)


def _key_points(options: argparse.Namespace) -> int:
    from .products import write_key_points

    with _Terminal(options.verbose) as progress:
        summary = write_key_points(options.input, options.output, *_chosen(options), progress)
    text = f"{summary.key_point_count:,} of {summary.ground_count:,} ground points are key points"
    return _tell(options, summary, f"{options.output}: {text}")


def _add_terrain(commands: Any, common: argparse.ArgumentParser) -> None:
    from .products import GroundClasses
    from .terrain.model import TerrainModel
    from .terrain.surface_model import SurfaceModel

    parser = commands.add_parser(
        "terrain",
        parents=[common],
        help="make rasters of the terrain and of what stands on it",
        description="Makes rasters (GeoTIFF) of a classified file. Name at least one.",
    )
    parser.add_argument("input", metavar="INPUT", type=Path, help="a .las, .laz or .copc.laz file")
    for name, what in (
        ("dtm", "terrain model"),
        ("dsm", "surface model, the top of all that stands on the terrain"),
        ("chm", "canopy height, the surface above the terrain"),
        ("hillshade", "hillshade of the terrain model"),
    ):
        parser.add_argument(f"--{name}", metavar="FILE", type=Path, help=f"the {what} (.tif)")
    _add_groups(
        parser, {"ground": GroundClasses, "model": TerrainModel, "surface": SurfaceModel}, _terrain
    )


def _terrain(options: argparse.Namespace) -> int:
    from .products import TerrainFiles, write_terrain_models

    files = TerrainFiles(options.dtm, options.dsm, options.chm, options.hillshade)
    with _Terminal(options.verbose) as progress:
        summary = write_terrain_models(options.input, files, *_chosen(options), progress)
    text = f"{summary.columns:,} x {summary.rows:,} cells of {summary.ground_count:,} ground points"
    return _tell(options, summary, f"{options.input}: {text}")


def _add_cloud_arguments(parser: Any, groups: dict[str, type[ParameterSet]], run: Any) -> None:
    parser.add_argument("input", metavar="INPUT", type=Path, help="a .las, .laz or .copc.laz file")
    parser.add_argument("output", metavar="OUTPUT", type=Path, help=".las, .laz or .copc.laz")
    _add_groups(parser, groups, run)


def _add_groups(parser: Any, groups: dict[str, type[ParameterSet]], run: Any) -> None:
    parser.add_argument("--json", action="store_true", help="print what was done as JSON")
    for declared in groups.values():
        add_options(parser, declared)
    parser.set_defaults(run=run, groups=groups)


def _chosen(options: argparse.Namespace) -> list[ParameterSet]:
    return [from_options(declared, options) for declared in options.groups.values()]


def _tell(options: argparse.Namespace, summary: Any, text: str) -> int:
    """Print what was done, as JSON if so asked; a sentence only to who looks on."""
    if options.json:
        print(json.dumps(dataclasses.asdict(summary)))
    elif options.verbose or sys.stdout.isatty():
        print(text)
    return _DONE


def add_options(parser: Any, declared: type[ParameterSet]) -> None:
    """Add an option for each declared parameter to a parser or a group of one."""
    for each in declared.declarations():
        flag = "--" + each.name.replace("_", "-")
        words = {"dest": each.name, "default": each.default, "help": _help_of(each)}
        if each.kind == "boolean":
            parser.add_argument(flag, action=argparse.BooleanOptionalAction, **words)
        elif each.kind == "choice":
            parser.add_argument(flag, choices=list(each.choices), **words)
        elif each.kind in ("numbers", "integers"):
            parser.add_argument(flag, nargs="*", metavar="N", **words)
        else:
            parser.add_argument(flag, metavar=each.unit or "N", **words)


def _help_of(each: Declaration) -> str:
    default = each.default
    if isinstance(default, tuple):
        default = " ".join(f"{value:g}" for value in default) or "none"
    unit = f" {each.unit}" if each.unit and default is not None else ""
    words = [each.help, f"(default: {each.empty if default is None else default}{unit})"]
    words[1:1] = [f"{value}: {label}." for value, label in each.choices.items()]
    return " ".join(words).replace("%", "%%")


def from_options(declared: type[ParameterSet], options: argparse.Namespace) -> ParameterSet:
    """Return the parameters that the parsed options give.

    Raises
    ------
    _UsageError
        If a value is not allowed; it says which and why.
    """
    values = {each.name: getattr(options, each.name) for each in declared.declarations()}
    for each in declared.declarations():
        if each.optional and str(values[each.name]).lower() in _NOT_USED:
            values[each.name] = None
    try:
        return declared(**values)
    except BareEarthError as error:
        raise _UsageError(str(error)) from error
