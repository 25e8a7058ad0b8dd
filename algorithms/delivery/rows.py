"""The tables of deliveries, and the work of the two rows on water, which run no tool as it is."""

from __future__ import annotations

from dataclasses import replace

from ..classes.ground_classes import GroundClasses
from ..core.progress import Progress
from ..survey.files import open_survey
from ..tin.dense_surface import VERTICES_A_SIDE
from ..tools.rasters.parameters import TerrainModel
from ..tools.rasters.step import MakeRasters
from ..tools.water.finding import Water
from ..tools.water.tool import found_water, given_water
from .deliveries import WITH_BUILDINGS
from .folder import QUALITY
from .job import DeliveryJob, Row

_BUILDING = 6


def rows_of(job: DeliveryJob) -> tuple[Row, ...]:
    """Return the rows of a delivery."""
    content = job.content
    maps = {name: name for name in (*content.rasters, *["contours"] * content.contours)}
    terrain = {name: name for name in ("roads", "constraints", "area", "raster_target")}
    quality = {"page": "quality"}
    quality |= {"folder": QUALITY} if content.quality else {}
    quality |= {"low_confidence": "low_confidence"} if content.low_confidence else {}
    accuracy = {"report": "accuracy", "table": "checkpoints", "residuals": "checkpoints"}
    ground = *job.set_of(GroundClasses).ground_classes, *job.known["roads"]
    buildings = {"surface_returns": "all", "surface_classes": (*ground, _BUILDING)}
    return (
        Row("classes", "classify", 6.0, (), {"area": "area", "corrections": "corrections"}),
        Row("water", "water", 1.0, ("find water",), work=_find_water),
        Row("water", "water-classes", 1.0, ("classes of water", "outlines"), {"water": "outlines"}),
        Row("key points", "key-points", 2.0, ("key points",)),
        Row("quality", "quality", 2.0, (), {}, quality, "quality", kept=content.quality),
        Row("rasters", "terrain", 2.0 + 0.4 * len(maps), (), terrain, maps, "interval",
            summary_value=lambda result: result.drawn.get("contours")),
        Row("rasters", "terrain", 1.0, ("buildings",), terrain, {"dsm": WITH_BUILDINGS},
            values=buildings),
        Row("rasters", "water", 0.3, ("water lines",), work=_write_water),
        Row("review", "review", 0.3, ("expected_error", "error_cause"),
            {"source": "expected_error", "dtm": "dtm", "cause": "error_cause",
             "corrections": "corrections"},
            {"places": "places", "page": "review"}, "review"),
        Row("accuracy", "check", 1.5, ("check",),
            {name: name for name in ("checkpoints", "dtm", "expected_error", "low_confidence")},
            accuracy, "check"),
    )  # fmt: skip


def _find_water(job: DeliveryJob, row: Row, progress: Progress) -> None:
    """Find the water, which flattens the terrain model as that of the user would."""
    ground, how = job.set_of(GroundClasses), job.set_of(Water)
    sources, progress = job.opened(progress)
    water, job.summary.water = found_water(sources, ground, progress, how)
    if water.bodies:
        job.found_water = water
        job.known["constraints"] = job.constraints.with_water(water.constraints, progress)
    job.know_water()


def _write_water(job: DeliveryJob, row: Row, progress: Progress) -> None:
    """Write the water and the breaklines, found ones and those of the user, with the
    heights that they have in the terrain model.
    """
    target, survey = job.known["raster_target"], open_survey(job.opened(progress)[0])
    given, water = job.constraints.located(survey.place, progress), job.found_water
    if given.water or given.breaklines or not water:
        rasters = MakeRasters(model=job.set_of(TerrainModel), target=target)
        cell = rasters.in_crs(survey.place).cell / VERTICES_A_SIDE
        clouds = survey.parts(progress.part(0.0, 0.9))
        of_user = given_water(given, clouds, survey.crs, job.set_of(GroundClasses), cell)
        water = replace(water, breaklines=of_user.breaklines) if water else of_user
    # Without ground points near it, water has no heights, and so no lines.
    polygons = job.place("features", "water") if water.bodies else None
    lines = job.place("features", "breaklines") if any(True for _ in water.lines()) else None
    water.write(polygons, lines, progress)
