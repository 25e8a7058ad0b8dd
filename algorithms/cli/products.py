"""The commands that make something of a classified file, or of an elevation raster."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Sequence

from .command import DONE, FAILED, Command
from .options import add_input, add_json, add_output, add_parameters, chosen
from .terminal import Terminal, tell


def _add_remove_objects(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..products.off_terrain import OffTerrain

    parser.add_argument("input", metavar="INPUT", help="a raster that GDAL reads")
    parser.add_argument("output", metavar="OUTPUT", type=Path, help="GeoTIFF (.tif)")
    add_json(parser)
    add_parameters(parser, OffTerrain)


def _remove_objects(options: argparse.Namespace) -> int:
    from ..products.off_terrain import remove_objects_file

    with Terminal(options.verbose) as progress:
        removal = remove_objects_file(options.input, options.output, *chosen(options), progress)
    tell(options, removal, f"{options.output}: {removal.text}")
    return DONE


def _add_height(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..engine.memory import Resources
    from ..engine.products import GroundClasses, HeightOutput

    parser.add_argument(
        "input", metavar="INPUT", type=Path, nargs="+",
        help="a classified file, or files, folders, virtual point clouds (.vpc), or lists of files"
        " (.txt)",
    )  # fmt: skip
    parser.add_argument(
        "output", metavar="OUTPUT", type=Path, help="a file; of many inputs a folder"
    )
    add_json(parser)
    add_parameters(parser, GroundClasses, HeightOutput, Resources)


def _height(options: argparse.Namespace) -> int:
    from ..engine.height_jobs import write_heights_of_survey
    from ..engine.products import write_height_above_ground
    from ..engine.workers import Processes
    from ..survey.collection import is_cloud

    ground, output, resources = chosen(options)
    with Terminal(options.verbose) as progress:
        first, *others = options.input
        if others or first.is_dir() or not is_cloud(first):
            summary = write_heights_of_survey(
                options.input, options.output, ground.ground_classes, output.output_as == "z",
                progress, Processes(resources),
            )  # fmt: skip
            text = f"heights of {summary.done_count:,} of {summary.tile_count:,} files are written"
        else:
            summary = write_height_above_ground(
                first, options.output, ground, output, resources, progress
            )
            extremes = f"{summary.minimum:.2f} to {summary.maximum:.2f} {summary.unit}"
            text = f"heights above ground are {extremes}"
    tell(options, summary, f"{options.output}: {text}")
    return FAILED if getattr(summary, "failures", None) else DONE


def _add_key_points(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..engine.products import GroundClasses, KeyPointMark
    from ..grids.model_key_points import ModelKeyPoints

    add_input(parser)
    add_output(parser)
    add_json(parser)
    add_parameters(parser, ModelKeyPoints, GroundClasses, KeyPointMark)


def _key_points(options: argparse.Namespace) -> int:
    from ..engine.products import write_key_points

    with Terminal(options.verbose) as progress:
        summary = write_key_points(options.input, options.output, *chosen(options), progress)
    text = f"{summary.key_point_count:,} of {summary.ground_count:,} ground points are key points"
    tell(options, summary, f"{options.output}: {text}")
    return DONE


def _add_terrain(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..engine.memory import Resources
    from ..engine.products import GroundClasses
    from ..products.surface_model import SurfaceModel
    from ..products.terrain_model import TerrainModel

    parser.add_argument(
        "input", metavar="INPUT", type=Path, nargs="+",
        help="files, folders, virtual point clouds (.vpc), or lists of files (.txt): all are one"
        " survey",
    )  # fmt: skip
    for name, what in (
        ("dtm", "terrain model"),
        ("dsm", "surface model, the top of all that stands on the terrain"),
        ("chm", "canopy height, the surface above the terrain"),
        ("hillshade", "hillshade of the terrain model"),
        ("confidence", "probability, 0 to 1, that the terrain model is right"),
    ):
        parser.add_argument(f"--{name}", metavar="FILE", type=Path, help=f"the {what} (.tif)")
    add_json(parser)
    add_parameters(parser, GroundClasses, TerrainModel, SurfaceModel, Resources)


def _terrain(options: argparse.Namespace) -> int:
    from ..engine.products import write_terrain_models
    from ..engine.rasters import RasterFiles
    from ..engine.workers import Processes

    files = RasterFiles(
        options.dtm, options.dsm, options.chm, options.hillshade, options.confidence
    )
    *policy, resources = chosen(options)
    with Terminal(options.verbose) as progress:
        summary = write_terrain_models(
            options.input, files, *policy, resources, progress, Processes(resources)
        )
    text = f"{summary.columns:,} x {summary.rows:,} cells of {summary.ground_count:,} ground points"
    tell(options, summary, f"{options.input[0]}: {text}")
    return DONE


COMMANDS = (
    Command(
        "remove-off-terrain-objects",
        "take buildings and trees out of an elevation raster",
        "Takes what stands steeply above the terrain round it out of an elevation"
        " raster, and fills the gaps smoothly.",
        _add_remove_objects,
        _remove_objects,
    ),
    Command(
        "height",
        "add the height above ground of every point",
        "Writes a classified file, or many as one survey, anew with the height of every point"
        " above the TIN of the ground points, in the vertical unit of the CRS.",
        _add_height,
        _height,
    ),
    Command(
        "key-points",
        "mark the ground points that a terrain model needs",
        "Writes a classified file anew with its model key points marked: the few ground"
        " points from whose TIN no other ground point lies farther than the tolerance.",
        _add_key_points,
        _key_points,
    ),
    Command(
        "terrain",
        "make rasters of the terrain and of what stands on it",
        "Makes rasters (GeoTIFF) of a classified file, or of many as one survey. Name at least"
        " one.",
        _add_terrain,
        _terrain,
    ),
)
