"""The rows of deliveries, and what some of them do beside letting a tool work."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path
from typing import Any

from ..core.errors import BareEarthError
from ..core.files import make_work_folder, split_name
from ..core.progress import Progress
from ..core.temporary import patiently, remove
from ..engine.manifest import folders_of
from ..engine.options import TileOutput
from ..grids.dense_surface import VERTICES_A_SIDE
from ..report.units import Units
from ..survey.files import Inputs, open_survey
from ..survey.ground_classes import GroundClasses
from ..survey.overview import overview_of
from ..survey.selection import Selection
from ..tools.rasters.parameters import SurfaceModel, TerrainModel
from ..tools.rasters.step import MakeRasters
from ..tools.water.finding import Water
from ..tools.water.tool import found_water, given_water
from .deliveries import WITH_BUILDINGS, Delivery
from .folder import QUALITY
from .job import DeliveryJob, Row
from .parameters import DeliveryTerrain

_BUILDING = 6


def rows_of(content: Delivery) -> tuple[Row, ...]:
    """Return the rows of a delivery."""
    drawn = {name: name for name in (*content.rasters, *["contours"] * content.contours)}
    on_ground = {name: name for name in ("roads", "constraints", "area", "raster_target")}
    quality = {"page": "quality", **({"folder": QUALITY} if content.quality else {})}
    checked = {"report": "accuracy", "table": "checkpoints", "residuals": "checkpoints"}
    return (
        Row("classes", "classify", 6.0, (), {"area": "area", "corrections": "corrections"},
            work=_classify),
        Row("water", "water", 1.0, ("find water",), work=_find_water),
        Row("water", "water-classes", 1.0, ("classes of water", "outlines"), {"water": "outlines"},
            work=_change),
        Row("key points", "key-points", 2.0, ("key points",), work=_change),
        Row("quality", "quality", 2.0, (), {}, quality, work=_measure),
        Row("rasters", "terrain", 2.0 + 0.4 * len(drawn), (), on_ground, drawn, work=_draw),
        Row("rasters", "terrain", 1.0, ("buildings",), on_ground, {"dsm": WITH_BUILDINGS},
            work=_draw_buildings),
        Row("rasters", "water", 0.3, ("water lines",), work=_write_water),
        Row("accuracy", "check", 1.5, ("check",), {"checkpoints": "checkpoints", "dtm": "dtm"},
            checked, "check"),
    )  # fmt: skip


def _classify(job: DeliveryJob, row: Row, progress: Progress) -> None:
    """Classify the points, and add their heights, as the delivery asks."""
    target, summary = job.folder.points, job.summary
    if not job.is_survey:
        source, kind = job.sources[0], job.set_of(TileOutput).format
        name = source.name if kind == "same" else f"{split_name(source)[0]}.{kind}"
        target = job.working.points / name
        target.parent.mkdir()
    done = job.run(row, progress, output=target)
    if job.is_survey:
        job.sources, job.files = Inputs(done.vpc), _files_of(done)
        summary.failures = dict(done.failures)
    else:
        job.sources, job.files = Inputs(target), [target]
    summary.cloud, summary.class_counts = str(job.cloud), done.class_counts
    summary.point_count, summary.ground_count = sum(done.class_counts.values()), done.ground_count


def _find_water(job: DeliveryJob, row: Row, progress: Progress) -> None:
    """Find the water."""
    ground, how = job.set_of(GroundClasses), job.set_of(Water)
    sources, progress = job.opened(progress)
    water, job.summary.water = found_water(sources, ground, progress, how)
    if water.bodies:
        job.found = water
        job.known["constraints"] = job.own.with_water(water.constraints, progress)
    job.know_water()


def _change(job: DeliveryJob, row: Row, progress: Progress) -> None:
    """Change the classified points, those of many files in a folder of its own until all outputs
    are made, so that a run can be continued.
    """
    source, summary = job.cloud, job.summary
    if not job.is_survey:
        target = job.working.waiting / source.name
        target.parent.mkdir(exist_ok=True)
        done = job.run(row, progress, output=target)
        patiently(os.replace, target, source)
        job.sources = Inputs(source)
    else:
        target = job.folder.waiting / row.tool
        if not job.set_of(TileOutput).resume:
            remove(target)
        make_work_folder(target.parent)
        changed = target / source.name
        done = job.run(row, progress, output=target, vpc=changed)
        for path, why in done.failures.items():
            raise BareEarthError(f"{path} cannot be changed. {why}")
        job.sources, job.waiting = Inputs(changed), _files_of(done)
        moved = (job.folder.points / path.relative_to(target) for path in job.waiting)
        job.files = sorted({*job.files, *moved})
    summary.class_counts = done.class_counts
    summary.ground_count = done.class_counts.get(job.set_of(Selection).to_class, 0)


def _measure(job: DeliveryJob, row: Row, progress: Progress) -> None:
    """Measure the quality, and choose the cell size by the density of the ground."""
    summary, kept = job.summary, job.content.quality
    summary.quality = quality = job.run(row, progress)
    for path in (job.working.path / QUALITY).glob("*.tif"):
        if path.stem not in kept:
            remove(path)
    size = job.content.cell_size(quality.ground_density, job.specification)
    job.sets = [
        values.with_cells(size) if isinstance(values, DeliveryTerrain) else values
        for values in job.sets
    ]
    model = job.set_of(TerrainModel)
    units = Units(job.survey.crs.horizontal_unit, job.survey.crs.vertical_unit)
    summary.cell_size = model.dtm_cell_size
    summary.cell_text = units.length(model.cells(units.horizontal).metres)


def _draw(job: DeliveryJob, row: Row, progress: Progress) -> None:
    """Make the rasters and the contour lines."""
    job.summary.interval = job.run(row, progress).drawn.get("contours")


def _draw_buildings(job: DeliveryJob, row: Row, progress: Progress) -> None:
    """Make a surface of the terrain and the buildings."""
    ground, edge = job.set_of(GroundClasses), job.set_of(SurfaceModel).max_edge
    classes = *ground.ground_classes, *job.known["roads"], _BUILDING
    sets, job.sets = job.sets, [SurfaceModel("all", classes, edge), *job.sets]
    job.run(row, progress)
    job.sets = sets


def _write_water(job: DeliveryJob, row: Row, progress: Progress) -> None:
    """Write the water and the breaklines, found and given, with their heights in the terrain model,
    if they have any.
    """
    target, survey = job.known["raster_target"], open_survey(job.opened(progress)[0])
    own, water = job.own.located(survey.place, progress), job.found
    if own.water or own.breaklines or not water:
        rasters = MakeRasters(model=job.set_of(TerrainModel), target=target)
        cell = rasters.placed(survey.place).cell / VERTICES_A_SIDE
        clouds = survey.parts(progress.part(0.0, 0.9))
        given = given_water(own, clouds, survey.crs, job.set_of(GroundClasses), cell)
        water = replace(water, breaklines=given.breaklines) if water else given
    # Polygons without ground near them have no heights for lines.
    polygons = job.place("features", "water") if water.bodies else None
    lines = job.place("features", "breaklines") if any(True for _ in water.lines()) else None
    water.write(polygons, lines, progress)


def _files_of(done: Any) -> list[Path]:
    """Return the files of points, their lists, and the records of what they were made of."""
    vpc = Path(done.vpc)
    names = {vpc.name, overview_of(vpc).name, *(tile.name for tile in done.tiles)}
    records = folders_of(vpc.parent)[1]
    paths = sorted(path for path in vpc.parent.rglob("*") if path.is_file())
    return [path for path in paths if path.name in names or records in path.parents]
