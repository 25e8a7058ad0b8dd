"""The commands that work on classified files, or on an elevation raster."""

from __future__ import annotations

import argparse
from typing import Sequence

from .command import DONE, Command
from .options import add_crs, add_inputs, add_json, add_parameters, chosen
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
    with_found_water,
    workers_of,
)
from .terminal import Terminal, tell
from .tools import command_of


def _add_terrain(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..engine.memory import Resources
    from ..runs.options import RasterOutput, TileInput
    from ..survey.ground_classes import GroundClasses
    from ..tools.contours import Contours
    from ..tools.rasters.parameters import SurfaceModel, TerrainModel

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


# Tools that are not named here follow at the end of the list of all commands.
COMMANDS = (
    command_of("remove-off-terrain-objects"),
    command_of("height"),
    command_of("above-ground"),
    command_of("key-points"),
    Command(
        "terrain",
        "make rasters of the terrain and of what stands on it",
        "Makes rasters (GeoTIFF) of a classified file, or of many as one survey. Give at least one"
        " of --contours and of --dtm, --dsm and the other options with GeoTIFF files.",
        _add_terrain,
        _terrain,
    ),
    command_of("contours"),
    command_of("relief"),
    command_of("water"),
    command_of("water-classes"),
)
