"""The files of water and breaklines of a delivery: what was found, and what the user gave."""

from __future__ import annotations

from itertools import chain
from pathlib import Path
from typing import Iterable

from ..core.errors import BareEarthError
from ..core.progress import Progress
from ..grids.dense_surface import VERTICES_A_SIDE
from ..runs.requests import TerrainRequest
from ..survey.feature_files import Feature, feature_writer
from ..survey.files import open_survey
from ..survey.shapes import Place
from ..tools.rasters.fixed_terrain import parts_of
from ..tools.water.files import SurveyWater, write_features
from ..tools.water.given import GivenWater
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
    given = _given(cloud, request, how, progress)
    polygons: Iterable[Feature] = found.polygons() if found else given.features()
    lines = chain(found.lines() if found else (), given.lines())
    # Polygons without ground near them have no heights for lines.
    features = {"water": list(polygons), "breaklines": list(lines)}
    paths = {name: folder / f"{name}{vector_format()}" for name, some in features.items() if some}
    layers = [(paths[name], features[name]) if name in paths else None for name in features]
    write_features(given.crs, layers[0], layers[1], progress)
    return paths


def _given(
    cloud: Path, request: DeliveryRequest, how: TerrainRequest, progress: Progress
) -> GivenWater:
    """Return the water and the breaklines of the user with their heights in the terrain model."""
    survey = open_survey([cloud], progress=progress.quiet(), stated=request.stated)
    place = Place("the files", survey.crs, survey.box)
    own = request.constraints.located(place, progress)
    step = how.raster_step.placed(survey.crs, survey.box)
    clouds = parts_of(survey.tiles, progress.part(0.0, 0.9))
    return GivenWater.of(own, clouds, survey.crs, request.ground, step.cell / VERTICES_A_SIDE)


def vector_format() -> str:
    """Return the ending of vector files: GeoPackage if it can be written, else GeoJSON."""
    try:
        feature_writer(Path("x.gpkg"))
    except BareEarthError:
        return ".geojson"
    return ".gpkg"
