"""The commands that classify: `classify` and `classify-tiles`."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Sequence

from .command import DONE, Command
from .options import KEPT, add_crs, add_inputs, add_json, add_parameters, chosen
from .surveys import (
    add_area,
    add_constraints,
    add_contours,
    add_raster_target,
    add_rasters,
    add_scheduler,
    area_of,
    constraints_of,
    contours_after,
    raster_target_of,
    tell_of_survey,
    workers_of,
)
from .terminal import Terminal, tell

if TYPE_CHECKING:
    from ..filters.method import Method
    from ..runs.requests import ClassifyRequest


def _add_classify(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..engine.memory import Resources
    from ..runs.options import RasterOutput, TileInput, TileOutput
    from ..survey.selection import Selection
    from ..tools.above_ground.classes import ThenAboveGround
    from ..tools.contours import Contours
    from ..tools.ground.output import Output
    from ..tools.rasters.parameters import SurfaceModel, TerrainModel

    add_inputs(parser)
    add_crs(parser, KEPT)
    parser.add_argument(
        "output", metavar="OUTPUT", type=Path,
        help="the file to write (.las, .laz or .copc.laz), or a folder if there are many inputs",
    )  # fmt: skip
    add_rasters(parser)
    add_contours(parser)
    add_raster_target(parser)
    add_constraints(parser, "for the rasters, ")
    add_area(
        parser, "classify only points in", "; points outside are written too, with the class that"
        " they have, unless --area-only is given; rasters end at its border",
    )  # fmt: skip
    parser.add_argument(
        "--corrections", metavar="FILE", type=Path,
        help="polygons in which you know the class; the attribute 'class' holds it, and it"
        " replaces the result of the filter (files as for --boundary, but no WKT)",
    )  # fmt: skip
    parser.add_argument(
        "--explain", metavar="FILE", type=Path,
        help="of one file: write a GeoTIFF of the rule that decided each cell; its band lists the"
        " rules",
    )  # fmt: skip
    parser.add_argument(
        "--vpc", metavar="FILE", type=Path,
        help="with many files: the virtual point cloud that lists the results (default:"
        " classified.vpc in the output folder)",
    )  # fmt: skip
    add_scheduler(parser)
    method = add_method(parser, arguments)
    add_json(parser, "the counts ")
    add_parameters(
        parser, method.parameters, Selection, ThenAboveGround, TerrainModel, SurfaceModel,
        Contours, Output, TileInput, TileOutput, RasterOutput, Resources,
        titles=(
            f"{method.label} parameters", "Which points, which classes", "Above the ground",
            "Terrain model", "Surface model and gaps", "Contour lines", "Output", "Files",
            "Output of many files", "Rasters of many files", "Threads and memory",
        ),
    )  # fmt: skip


def add_method(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> Method:
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


def _classify(options: argparse.Namespace) -> int:
    from ..runs.requests import ClassifyRequest
    from ..survey.corrections import NO_CORRECTIONS
    from ..survey.vector_files import read_corrections

    corrections, sets = NO_CORRECTIONS, chosen(options)
    if options.corrections is not None:
        corrections = read_corrections(options.corrections)
    area, known = area_of(options), constraints_of(options)
    with contours_after(options, sets) as (rasters, rest):
        request = ClassifyRequest.of(
            rest, rasters=rasters, area=area, corrections=corrections, constraints=known,
            crs=options.crs, raster_target=raster_target_of(options), explain=options.explain,
        )  # fmt: skip
        return _classified(options, request)


def _classified(options: argparse.Namespace, request: ClassifyRequest) -> int:
    """Classify, and tell what was done."""
    from ..runs.entry import classify
    from ..runs.one_file import Summary

    as_survey = options.command == _TILES or bool(options.scheduler) or None
    workers = workers_of(options, request.resources)
    with Terminal(options.verbose) as progress:
        done = classify(
            options.input, options.output, request, progress, workers, options.vpc, as_survey
        )
    if not isinstance(done, Summary):
        return tell_of_survey(options, done)
    ground, count = done.area_ground_count, done.area_count
    place = "" if request.area is None else " in the area"
    text = f"{ground:,} of {count:,} points{place} are ground ({100 * ground / count:.1f} %)"
    tell(options, done, f"{options.output}: {text}")
    return DONE


_TILES = "classify-tiles"
_ABOUT = (
    " Many files, folders and virtual point clouds are one survey: each point gets the class that"
    " it would get if all were one file, so there are no seams. A file that cannot be classified"
    " is reported at the end. To see the parameters of a method, give --method before --help."
)

COMMANDS = (
    Command(
        "classify",
        "classify the ground points of a file, or of many as one survey",
        "Classifies the ground points of LAS, LAZ and COPC files. Only the classification changes"
        " in the output." + _ABOUT,
        _add_classify,
        _classify,
    ),
    Command(
        _TILES,
        "the same as classify, but always writes into a folder",
        "Classifies the ground points of LAS, LAZ and COPC files, and writes each into a folder."
        + _ABOUT,
        _add_classify,
        _classify,
    ),
)
