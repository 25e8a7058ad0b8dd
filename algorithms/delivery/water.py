"""The files of water and breaklines of a delivery: what was found, and what the user gave."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from ..core.errors import BareEarthError
from ..core.progress import Progress
from ..grids.dense_surface import VERTICES_A_SIDE
from ..runs.requests import TerrainRequest
from ..survey.feature_files import feature_writer
from ..survey.files import open_survey
from ..survey.shapes import Place
from ..tools.rasters.fixed_terrain import parts_of
from ..tools.water.tool import SurveyWater, given_water
from .request import DeliveryRequest


def write_water(
    cloud: Path,
    request: DeliveryRequest,
    found: SurveyWater | None,
    how: TerrainRequest,
    folder: Path,
    progress: Progress,
) -> dict[str, Path]:
    """Write the water and the breaklines of the terrain model, those found and those of the user,
    with their heights in it, and return the files by the names of their layers, if any.
    """
    own = request.constraints
    if found is None and not (own.water or own.breaklines):
        return {}
    survey = open_survey([cloud], progress=progress.quiet(), stated=request.stated)
    own = own.located(Place("the files", survey.crs, survey.box), progress)
    cell = how.raster_step.placed(survey.crs, survey.box).cell / VERTICES_A_SIDE
    clouds = parts_of(survey.tiles, progress.part(0.0, 0.9))
    water = given_water(own, clouds, survey.crs, request.ground, cell)
    if found:
        water = replace(found, breaklines=water.breaklines)
    # Polygons without ground near them have no heights for lines.
    is_there = {"water": bool(water.bodies), "breaklines": any(True for _ in water.lines())}
    paths = {name: folder / f"{name}{vector_format()}" for name in is_there if is_there[name]}
    water.write(paths.get("water"), paths.get("breaklines"), progress)
    return paths


def vector_format() -> str:
    """Return the ending of vector files: GeoPackage if it can be written, else GeoJSON."""
    try:
        feature_writer(Path("x.gpkg"))
    except BareEarthError:
        return ".geojson"
    return ".gpkg"
