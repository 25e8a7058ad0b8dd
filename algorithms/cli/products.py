"""The commands that work on classified files, or on an elevation raster."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Sequence

from .command import DONE, Command
from .options import add_inputs, add_json, add_parameters, chosen
from .surveys import (
    add_area,
    add_constraints,
    add_rasters,
    add_scheduler,
    area_of,
    constraints_of,
    finished_files_stay,
    rasters_of,
    tell_of_survey,
    workers_of,
)
from .terminal import Terminal, tell

if TYPE_CHECKING:
    from ..core.parameters import ParameterSet


def _add_remove_objects(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..products.off_terrain import OffTerrain

    parser.add_argument("input", metavar="INPUT", help="a raster that GDAL reads")
    parser.add_argument("output", metavar="OUTPUT", type=Path, help="a GeoTIFF (.tif) to write")
    add_json(parser)
    add_parameters(parser, OffTerrain)


def _remove_objects(options: argparse.Namespace) -> int:
    from ..products.off_terrain import OffTerrain, remove_objects_file

    how = OffTerrain.among(chosen(options))
    with Terminal(options.verbose) as progress:
        removal = remove_objects_file(options.input, options.output, how, progress)
    tell(options, removal, f"{options.output}: {removal.text}")
    return DONE


def _add_height(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..engine.heights import HeightOutput

    _add_files(parser, HeightOutput)


def _add_key_points(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..engine.key_points import KeyPointMark
    from ..grids.model_key_points import ModelKeyPoints

    _add_files(parser, ModelKeyPoints, KeyPointMark)


def _add_files(parser: argparse.ArgumentParser, *sets: type[ParameterSet]) -> None:
    """Add the options of `height` and `key-points`."""
    from ..engine.memory import Resources
    from ..engine.options import TileInput, TileOutput
    from ..survey.ground_classes import GroundClasses

    add_inputs(parser, "a classified file, or ")
    parser.add_argument(
        "output", metavar="OUTPUT", type=Path,
        help="the file to write (.las, .laz or .copc.laz), or a folder if there are many inputs",
    )  # fmt: skip
    add_scheduler(parser)
    add_json(parser)
    add_parameters(parser, *sets, GroundClasses, TileInput, TileOutput, Resources)


def _write(options: argparse.Namespace) -> int:
    """Write classified files with the heights or key points."""
    from ..engine.many_files import write_files
    from ..engine.one_file import write_points
    from ..engine.requests import HeightRequest, KeyPointRequest
    from ..survey.files import is_one_file

    kind = HeightRequest if options.command == "height" else KeyPointRequest
    request = kind.of(chosen(options))
    if is_one_file(options.input) and not options.scheduler:
        with Terminal(options.verbose) as progress:
            summary = write_points(
                options.input[0], options.output, request.step, request.resources, progress
            )
        tell(options, summary, f"{options.output.parent / summary.text}")
        return DONE
    workers = workers_of(options, request.resources)
    with finished_files_stay(), Terminal(options.verbose) as progress:
        done = write_files(
            options.input, options.output, [request.step], request, progress, workers
        )
    return tell_of_survey(options, done)


def _add_terrain(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..engine.memory import Resources
    from ..engine.options import RasterOutput, TileInput
    from ..products.surface_model import SurfaceModel
    from ..products.terrain_model import TerrainModel
    from ..survey.ground_classes import GroundClasses

    add_inputs(parser)
    add_rasters(parser)
    add_area(parser, "make the rasters only in", "; points outside still help along its border")
    add_constraints(parser)
    add_scheduler(parser)
    add_json(parser)
    add_parameters(
        parser, GroundClasses, TerrainModel, SurfaceModel, TileInput, RasterOutput, Resources
    )


def _terrain(options: argparse.Namespace) -> int:
    from ..engine.requests import TerrainRequest
    from ..engine.runs import terrain

    request = TerrainRequest.of(
        chosen(options), rasters=rasters_of(options), constraints=constraints_of(options),
        area=area_of(options),
    )  # fmt: skip
    with Terminal(options.verbose) as progress:
        workers = workers_of(options, request.resources)
        summary = terrain(options.input, request, progress, workers)
    text = f"{summary.columns:,} x {summary.rows:,} cells of {summary.ground_count:,} ground points"
    tell(options, summary, f"{options.input[0]}: {text}")
    return DONE


COMMANDS = (
    Command(
        "remove-off-terrain-objects",
        "remove buildings and trees from an elevation raster",
        "Removes buildings, trees and other steep-sided objects from an elevation raster, and"
        " fills the gaps smoothly.",
        _add_remove_objects,
        _remove_objects,
    ),
    Command(
        "height",
        "add the height above ground of every point",
        "Adds to every point its height above the TIN of the ground points, in the vertical unit"
        " of the CRS. The input is a classified file, or many as one survey.",
        _add_height,
        _write,
    ),
    Command(
        "key-points",
        "mark the ground points that a terrain model needs",
        "Marks the model key points of a classified file, or of many as one survey: the few ground"
        " points that a terrain model needs. No other ground point lies farther from their TIN"
        " than the tolerances.",
        _add_key_points,
        _write,
    ),
    Command(
        "terrain",
        "make rasters of the terrain and of what stands on it",
        "Makes rasters (GeoTIFF) of a classified file, or of many as one survey. Give at least one"
        " of --dtm, --dsm, --chm, --hillshade and --confidence.",
        _add_terrain,
        _terrain,
    ),
)
