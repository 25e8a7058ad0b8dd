"""The commands that make something of a classified file, or of an elevation raster."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Sequence

from .command import DONE, Command
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
    from ..engine.products import GroundClasses, HeightOutput

    add_input(parser)
    add_output(parser)
    add_json(parser)
    add_parameters(parser, GroundClasses, HeightOutput)


def _height(options: argparse.Namespace) -> int:
    from ..engine.products import write_height_above_ground

    with Terminal(options.verbose) as progress:
        summary = write_height_above_ground(
            options.input, options.output, *chosen(options), progress
        )
    text = f"heights above ground are {summary.minimum:.2f} to {summary.maximum:.2f} {summary.unit}"
    tell(options, summary, f"{options.output}: {text}")
    return DONE


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
    from ..engine.products import GroundClasses
    from ..products.surface_model import SurfaceModel
    from ..products.terrain_model import TerrainModel

    add_input(parser)
    for name, what in (
        ("dtm", "terrain model"),
        ("dsm", "surface model, the top of all that stands on the terrain"),
        ("chm", "canopy height, the surface above the terrain"),
        ("hillshade", "hillshade of the terrain model"),
    ):
        parser.add_argument(f"--{name}", metavar="FILE", type=Path, help=f"the {what} (.tif)")
    add_json(parser)
    add_parameters(parser, GroundClasses, TerrainModel, SurfaceModel)


def _terrain(options: argparse.Namespace) -> int:
    from ..engine.products import write_terrain_models
    from ..engine.rasters import RasterFiles

    files = RasterFiles(options.dtm, options.dsm, options.chm, options.hillshade)
    with Terminal(options.verbose) as progress:
        summary = write_terrain_models(options.input, files, *chosen(options), progress)
    text = f"{summary.columns:,} x {summary.rows:,} cells of {summary.ground_count:,} ground points"
    tell(options, summary, f"{options.input}: {text}")
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
        "Writes a classified file anew with the height of every point above the TIN of"
        " its ground points, in the vertical unit of the CRS.",
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
        "Makes rasters (GeoTIFF) of a classified file. Name at least one.",
        _add_terrain,
        _terrain,
    ),
)
