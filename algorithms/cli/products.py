"""The commands that work on classified files, or on an elevation raster."""

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
    water_polygons_of,
    with_found_water,
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


def _add_contours(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..products.contours import Contours
    from ..products.line_files import FORMATS

    parser.add_argument("input", metavar="INPUT", help="a raster that GDAL reads")
    parser.add_argument(
        "output", metavar="OUTPUT", type=Path,
        help=f"the lines to write ({', '.join(FORMATS)}); all but .geojson need pyogrio",
    )  # fmt: skip
    add_json(parser)
    add_parameters(parser, Contours)
    parser.add_argument(
        "--interval", dest="contour_interval", metavar="N", default=argparse.SUPPRESS,
        help="the same as --contour-interval",
    )  # fmt: skip


def _contours(options: argparse.Namespace) -> int:
    from ..products.contours import Contours, write_contours

    how = Contours.among(chosen(options))
    with Terminal(options.verbose) as progress:
        interval = write_contours(options.input, options.output, how, progress)
    tell(options, interval, f"{options.output}: one contour line every {interval.text()}")
    return DONE


def _add_relief(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..products.relief import KINDS, LOCAL_RELIEF, ReliefPictures

    parser.add_argument("input", metavar="INPUT", help="a raster that GDAL reads")
    parser.add_argument("output", metavar="OUTPUT", type=Path, help="a GeoTIFF (.tif) to write")
    parser.add_argument(
        "--kind", choices=list(KINDS), default=LOCAL_RELIEF,
        help=f"what to make (default: {LOCAL_RELIEF})",
    )  # fmt: skip
    add_parameters(parser, ReliefPictures)


def _relief(options: argparse.Namespace) -> int:
    from ..products.relief import ReliefPictures, write_relief

    how = ReliefPictures.among(chosen(options))
    with Terminal(options.verbose) as progress:
        write_relief(options.input, options.output, options.kind, how, progress)
    return DONE


def _add_height(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..steps.heights import HeightOutput

    _add_files(parser, HeightOutput)
    parser.add_argument(
        "--dtm", metavar="FILE",
        help="measure the heights above this raster, in the CRS of the points, and not above the"
        " ground points; the points need no classes",
    )  # fmt: skip


def _add_key_points(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..grids.model_key_points import ModelKeyPoints
    from ..steps.key_points import KeyPointMark

    _add_files(parser, ModelKeyPoints, KeyPointMark)


def _add_above_ground(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..products.above_ground import AboveGround

    _add_files(parser, AboveGround)
    add_area(parser, "change only points in", "; points outside keep their class")


def _add_water_classes(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..products.water_classes import WaterClasses
    from ..survey.vector_files import FORMATS

    _add_files(parser, WaterClasses)
    parser.add_argument(
        "--water", metavar="FILE", required=True,
        help=f"polygons of water ({FORMATS}); with the word automatic, the water is found first, as"
        " the command 'water' does",
    )  # fmt: skip


def _add_files(parser: argparse.ArgumentParser, *sets: type[ParameterSet]) -> None:
    """Add the options of the commands that write classified files anew."""
    from ..engine.memory import Resources
    from ..runs.options import TileInput, TileOutput
    from ..survey.ground_classes import GroundClasses

    add_inputs(parser, "a classified file, or ")
    add_crs(parser, KEPT)
    parser.add_argument(
        "output", metavar="OUTPUT", type=Path,
        help="the file to write (.las, .laz or .copc.laz), or a folder if there are many inputs",
    )  # fmt: skip
    add_scheduler(parser)
    add_json(parser)
    add_parameters(parser, *sets, GroundClasses, TileInput, TileOutput, Resources)


def _write(options: argparse.Namespace) -> int:
    """Write classified files with the heights, key points or further classes."""
    from ..rasters.sampling import HeightRaster
    from ..runs.entry import write
    from ..runs.many_files import SurveySummary
    from ..runs.requests import (
        AboveGroundRequest,
        HeightRequest,
        KeyPointRequest,
        WaterClassRequest,
    )

    request: HeightRequest | KeyPointRequest | AboveGroundRequest | WaterClassRequest
    if options.command == "height":
        dtm = None if options.dtm is None else HeightRaster.of(options.dtm)
        request = HeightRequest.of(chosen(options), dtm=dtm, crs=options.crs)
    elif options.command == "above-ground":
        request = AboveGroundRequest.of(chosen(options), area=area_of(options), crs=options.crs)
    elif options.command == "water-classes":
        sets = chosen(options)
        water = water_polygons_of(options, sets)
        request = WaterClassRequest.of(sets, water=water, crs=options.crs)
    else:
        request = KeyPointRequest.of(chosen(options), crs=options.crs)
    workers, as_survey = workers_of(options, request.resources), bool(options.scheduler) or None
    with Terminal(options.verbose) as progress:
        done = write(options.input, options.output, request, progress, workers, as_survey)
    if isinstance(done, SurveySummary):
        return tell_of_survey(options, done)
    tell(options, done, f"{options.output.parent / done.text}")
    return DONE


def _add_terrain(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..engine.memory import Resources
    from ..products.contours import Contours
    from ..products.surface_model import SurfaceModel
    from ..products.terrain_model import TerrainModel
    from ..runs.options import RasterOutput, TileInput
    from ..survey.ground_classes import GroundClasses

    add_inputs(parser)
    add_crs(parser)
    add_rasters(parser)
    add_contours(parser)
    add_raster_target(parser)
    add_area(parser, "make the rasters only in", "; points outside still help along its border")
    add_constraints(parser)
    add_scheduler(parser)
    add_json(parser)
    add_parameters(
        parser, GroundClasses, TerrainModel, SurfaceModel, Contours, TileInput, RasterOutput,
        Resources,
    )  # fmt: skip


def _terrain(options: argparse.Namespace) -> int:
    from ..runs.entry import terrain
    from ..runs.requests import TerrainRequest

    known, sets = constraints_of(options, finds_water=True), chosen(options)
    known = with_found_water(options, known, sets)
    with contours_after(options, sets) as (rasters, rest):
        request = TerrainRequest.of(
            rest, rasters=rasters, constraints=known, crs=options.crs, area=area_of(options),
            raster_target=raster_target_of(options),
        )  # fmt: skip
        with Terminal(options.verbose) as progress:
            workers = workers_of(options, request.resources)
            summary = terrain(options.input, request, progress, workers)
    text = f"{summary.columns:,} x {summary.rows:,} cells of {summary.ground_count:,} ground points"
    tell(options, summary, f"{options.input[0]}: {text}")
    return DONE


def _add_water(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..products.line_files import FORMATS
    from ..products.water import Water
    from ..survey.ground_classes import GroundClasses

    add_inputs(parser, "a classified file, or ")
    add_crs(parser)
    kinds = f"({', '.join(FORMATS)}); all but .geojson need pyogrio"
    parser.add_argument(
        "output", metavar="OUTPUT", type=Path, help=f"the polygons of water to write {kinds}"
    )
    parser.add_argument(
        "--breaklines-out", metavar="FILE", type=Path,
        help=f"write shores, islands and the middles of rivers as lines with heights {kinds}",
    )  # fmt: skip
    add_json(parser)
    add_parameters(parser, Water, GroundClasses)


def _water(options: argparse.Namespace) -> int:
    from ..products.water_files import WaterRequest, write_water

    request = WaterRequest.of(chosen(options), crs=options.crs, breaklines=options.breaklines_out)
    with Terminal(options.verbose) as progress:
        summary = write_water(options.input, options.output, request, progress)
    tell(options, summary, f"{options.output}: {summary.text}", always=True)
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
        " of the CRS. The input is a classified file, or many as one survey. With --dtm, heights"
        " are above a raster.",
        _add_height,
        _write,
    ),
    Command(
        "above-ground",
        "classify vegetation, buildings and bridges",
        "Classifies the points above the ground of a classified file, or of many as one survey:"
        " low, medium and high vegetation (3, 4, 5) by height above ground, buildings (6), bridges"
        " (17) and high noise (18). Only points of class 0 and 1 change.",
        _add_above_ground,
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
        " of --contours and of --dtm, --dsm and the other options with GeoTIFF files.",
        _add_terrain,
        _terrain,
    ),
    Command(
        "contours",
        "draw contour lines of a terrain model",
        "Draws contour lines of an elevation raster, of its heights smoothed for the lines only.",
        _add_contours,
        _contours,
    ),
    Command(
        "relief",
        "make pictures of the relief of a terrain model",
        "Makes a raster (GeoTIFF) that shows the relief of an elevation raster: local relief,"
        " sky-view factor, openness, local dominance, slope, hillshade, or a picture of several of"
        " them (vat, red-relief). They show mounds, walls, ditches and old paths.",
        _add_relief,
        _relief,
    ),
    Command(
        "water",
        "find lakes and rivers in classified points",
        "Finds water where hardly any last return is, and the ground along its shore is level or"
        " falls steadily: polygons with level, spread of the shore and a grade of certainty, and"
        " breaklines with heights.",
        _add_water,
        _water,
    ),
    Command(
        "water-classes",
        "give classes to ground points in water and beside its shore",
        "Gives class 9 (water) to the ground points of a classified file, or of many as one survey,"
        " that lie in polygons of water, and class 20 (ignored ground) to those beside the shore,"
        " as the Lidar Base Specification asks for. Nothing else changes.",
        _add_water_classes,
        _write,
    ),
)
