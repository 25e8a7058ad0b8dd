"""The commands that classify: `classify` and `classify-tiles`."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Sequence

from ..core.errors import BareEarthError, Cancelled
from .command import DONE, FAILED, Command
from .options import UsageError, add_input, add_json, add_output, add_parameters, chosen
from .terminal import Terminal, tell

if TYPE_CHECKING:
    from ..filters import Method
    from ..survey.area import Area


def _add_classify(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..engine.memory import Resources
    from ..engine.output import Output
    from ..products.terrain_model import TerrainModel
    from ..survey.selection import Selection

    add_input(parser)
    add_output(parser)
    _add_rasters(parser)
    parser.add_argument(
        "--extent", nargs=4, type=float, metavar=("XMIN", "YMIN", "XMAX", "YMAX"),
        help="classify only points in this rectangle, in the CRS of the points",
    )  # fmt: skip
    parser.add_argument(
        "--boundary", metavar="FILE", type=Path,
        help="classify only points in these polygons (.geojson, .json, .wkt), in the CRS of the"
        " points",
    )  # fmt: skip
    method = _add_method(parser, arguments)
    add_json(parser, "the counts ")
    add_parameters(
        parser, method.parameters, Selection, TerrainModel, Output, Resources,
        titles=(
            f"{method.label} parameters", "Which points, which classes", "Terrain model", "Output",
            "Threads and memory",
        ),
    )  # fmt: skip


def _add_rasters(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--dtm", metavar="FILE", type=Path, help="write the terrain model (.tif)")
    parser.add_argument("--hillshade", metavar="FILE", type=Path, help="write its hillshade (.tif)")


def _add_method(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> Method:
    """Add the option for the ground filter, and return the one that the command line names."""
    from ..filters import DEFAULT_METHOD, METHODS

    parser.add_argument(
        "--method", choices=list(METHODS), default=DEFAULT_METHOD,
        help="the ground filter (default: %(default)s)",
    )  # fmt: skip
    # The options to offer depend on the method, which is on the same command line.
    named = argparse.ArgumentParser(add_help=False, allow_abbrev=False)
    named.add_argument("--method", default=DEFAULT_METHOD)
    return METHODS.get(named.parse_known_args(arguments)[0].method, METHODS[DEFAULT_METHOD])


def _classify(options: argparse.Namespace) -> int:
    from ..engine.classification import classify_file

    parameters, selection, terrain, output, resources = chosen(options)
    area = _area_of(options)
    with Terminal(options.verbose) as progress:
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
    tell(options, summary, f"{options.output}: {text}")
    return DONE


def _area_of(options: argparse.Namespace) -> Area | None:
    """Return the area of the options, or None if they name none."""
    from ..survey.area import Area, read_boundary

    if options.extent is None and options.boundary is None:
        return None
    try:
        box = None if options.extent is None else Area(tuple(options.extent)).box
    except BareEarthError as error:
        raise UsageError(str(error)) from error
    return Area(box, () if options.boundary is None else read_boundary(options.boundary))


def _add_classify_tiles(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..engine.memory import Resources
    from ..engine.options import TileInput, TileOutput
    from ..products.terrain_model import TerrainModel
    from ..survey.selection import Selection

    parser.add_argument(
        "input", metavar="INPUT", type=Path, nargs="+",
        help="files, folders, virtual point clouds (.vpc), or lists of files (.txt)",
    )  # fmt: skip
    parser.add_argument("output", metavar="FOLDER", type=Path, help="where the results go")
    parser.add_argument(
        "--vpc", metavar="FILE", type=Path,
        help="the virtual point cloud of the results (default: classified.vpc in FOLDER)",
    )  # fmt: skip
    _add_rasters(parser)
    parser.add_argument(
        "--scheduler", metavar="ADDRESS",
        help="let the workers of this Dask scheduler do it, such as tcp://host:8786; without it,"
        " processes of this computer do",
    )  # fmt: skip
    method = _add_method(parser, arguments)
    add_json(parser)
    add_parameters(
        parser, method.parameters, Selection, TileInput, TileOutput, TerrainModel, Resources,
        titles=(
            f"{method.label} parameters", "Which points, which classes", "Files", "Output",
            "Terrain model", "Threads and memory",
        ),
    )  # fmt: skip


def _classify_tiles(options: argparse.Namespace) -> int:
    from ..engine.cluster import Cluster
    from ..engine.rasters import RasterFiles, RasterRequest
    from ..engine.tiles import classify_tiles
    from ..engine.workers import Processes

    *policy, terrain, resources = chosen(options)
    rasters = RasterRequest(RasterFiles(dtm=options.dtm, hillshade=options.hillshade), terrain)
    workers = Processes(resources)
    if options.scheduler:
        workers = Cluster(options.scheduler, resources)
    try:
        with Terminal(options.verbose) as progress:
            summary = classify_tiles(
                options.input, options.output, *policy, options.vpc, progress, workers,
                rasters=rasters,
            )  # fmt: skip
    except (Cancelled, KeyboardInterrupt):
        text = "Cancelled; the tiles that are finished stay. Go on with --resume."
        print(f"bare-earth: {text}", file=sys.stderr)
        return FAILED
    tell(options, summary, f"{options.output}: {summary.text}")
    return FAILED if summary.failures else DONE


COMMANDS = (
    Command(
        "classify",
        "classify the ground points of a file",
        "Classifies the ground points of a LAS, LAZ or COPC file. The output equals the"
        " input but for the classification. Give --method before --help to see its parameters.",
        _add_classify,
        _classify,
    ),
    Command(
        "classify-tiles",
        "classify the ground points of many files as one survey",
        "Classifies the ground points of many LAS, LAZ or COPC files. Each point gets"
        " the class that it would get if all files were one: there is no seam. A file that cannot"
        " be classified is reported at the end. Give --method before --help to see its parameters.",
        _add_classify_tiles,
        _classify_tiles,
    ),
)
