"""The steps of a delivery: each runs what the commands run, one after the other."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Callable

from ..core.errors import BareEarthError
from ..core.files import make_work_folder, split_name
from ..core.progress import Progress
from ..core.temporary import patiently, remove
from ..engine.manifest import folders_of
from ..engine.workers import Workers
from ..grids.dense_surface import VERTICES_A_SIDE
from ..report.units import Units
from ..runs.entry import classify, terrain, write
from ..runs.requests import TerrainRequest
from ..survey.feature_files import feature_writer
from ..survey.files import Inputs, Survey, open_survey
from ..survey.overview import overview_of
from ..survey.shapes import Place
from ..tools import file_tool, point_tool
from ..tools.check.checking import CheckOptions
from ..tools.contours import write_contours
from ..tools.rasters.constraints import NO_CONSTRAINTS, Constraints
from ..tools.rasters.fixed_terrain import parts_of
from ..tools.rasters.parameters import SurfaceModel
from ..tools.rasters.rows import RasterFiles
from ..tools.running import run
from ..tools.water.tool import SurveyWater, found_water, given_water
from .deliveries import WITH_BUILDINGS
from .folder import QUALITY, DeliveryFolder
from .request import DeliveryRequest
from .summary import DeliverySummary

_BUILDING = 6
# Contour lines in a CRS whose heights are feet: so many feet are about half a metre.
_FEET_A_METRE = 4.0
_KEY_POINTS = "key-points"


@dataclass
class DeliverySteps:
    """The steps of a delivery, and what they have written so far."""

    request: DeliveryRequest
    survey: Survey  # the raw files
    sources: Inputs  # files and folders as the user gave them
    is_one: bool  # file
    work: DeliveryFolder  # where outputs are made that get their places at the end
    folder: DeliveryFolder  # where many files are classified, as finished ones stay after a cancel
    workers: Workers | None  # for many files
    summary: DeliverySummary  # is filled by the steps
    files: list[Path] = field(default_factory=list)  # of points, at their places
    cloud: Path = Path()  # the points that further steps read
    waiting: list[Path] = field(default_factory=list)  # take the places of `files` at the end
    constraints: Constraints = NO_CONSTRAINTS  # those of the user, with the water that is found
    found: SurveyWater | None = None

    def run(self, progress: Progress) -> None:
        """Run all steps."""
        content, options = self.request.content, self.request.options
        self.constraints = self.request.constraints
        has_check = options.hold_out_share is not None or self.request.checkpoints is not None
        named: list[tuple[str, float, Callable[[Progress], None]]] = [
            ("classes", 6.0, self._classify),
            ("water", 2.0 * (content.water is not None), self._water),
            ("key points", 2.0 * options.key_points, self._mark),
            ("quality", 2.0, self._measure),
            ("rasters", 2.0 + 0.4 * len(content.rasters), self._draw),
            ("contour lines", 0.3 * content.contours, self._trace),
            ("accuracy", 1.5 * has_check, self._check),
        ]
        parts = progress.shares(*(weight for _, weight, _ in named))
        for (name, weight, step), part in zip(named, parts):
            if weight:
                begun = time.perf_counter()
                step(part)
                self.summary.seconds[name] = round(time.perf_counter() - begun, 2)
        remove(self.work.waiting)

    def _classify(self, progress: Progress) -> None:
        """Classify the points, and add their heights, as the delivery asks."""
        target, how, summary = self.folder.points, self.request.classify, self.summary
        if self.is_one:
            source, kind = self.sources[0], self.request.tiles.format
            name = source.name if kind == "same" else f"{split_name(source)[0]}.{kind}"
            target = self.work.points / name
        (target.parent if self.is_one else target).mkdir(parents=True, exist_ok=True)
        done = classify(self.sources, target, how, progress, self.workers)
        if self.is_one:
            self.cloud, self.files = target, [target]
            summary.point_count, summary.ground_count = done.area_count, done.area_ground_count
        else:
            self.cloud, self.files = Path(done.vpc), _files_of(done)
            summary.point_count, summary.ground_count = done.point_count, done.ground_count
            summary.failures = dict(done.failures)
        summary.cloud, summary.class_counts = str(self.cloud), done.class_counts

    def _measure(self, progress: Progress) -> None:
        """Measure the quality, and choose the cell size by the density of the ground."""
        request, kept, folder = self.request, self.request.content.quality, self.work.path / QUALITY
        inputs = {"sources": [self.cloud], "crs": request.crs}
        outputs = {"page": self.work.path / "quality.html", "folder": folder if kept else None}
        sets = [request.quality, request.ground]
        quality = run(file_tool("quality"), inputs, outputs, sets, progress)
        for path in folder.glob("*.tif"):
            if path.stem not in kept:
                remove(path)
        self.summary.quality = quality
        self.summary.cell_size = request.content.cell_size(
            quality.ground_density, request.specification
        )

    def _water(self, progress: Progress) -> None:
        """Find the water, unless the user has given some, and change the points in it."""
        request, wanted, summary = self.request, self.request.water_wanted, self.summary
        parts = progress.shares(1.0, *(1.0 for _ in request.content.in_water))
        if wanted is not None:
            water, summary.water = found_water(
                [self.cloud], request.ground, request.crs, parts[0], wanted
            )
            if water.bodies:
                self.found = water
                self.constraints = self.constraints.with_water(water.constraints, parts[0])
        if self.constraints.water:
            for command, part in zip(request.content.in_water, parts[1:]):
                summary.class_counts = self._change(command, part).class_counts
                ground = summary.class_counts.get(request.selection.to_class, 0)
                summary.ground_count = ground

    def _mark(self, progress: Progress) -> None:
        """Mark the key points: among the ground that water and its shore leave."""
        self._change(_KEY_POINTS, progress)

    def _change(self, command: str, progress: Progress) -> Any:
        """Change the classified points by a tool, those of many files in a folder of its own until
        all outputs are made, so that a run can be continued.
        """
        areas = {"water": self.constraints.water_outlines}
        inputs = {
            declared.name: declared.of(areas[declared.name])
            for declared in point_tool(command).inputs
            if declared.name in areas
        }
        how, source = self.request.to_change(command, inputs), self.cloud
        if self.is_one:
            target = self.work.waiting / source.name
            target.parent.mkdir(exist_ok=True)
            done = write([source], target, how, progress)
            patiently(os.replace, target, source)
            return done
        target = self.folder.waiting / command
        if not how.tiles.resume:
            remove(target)
        make_work_folder(target.parent)
        self.cloud = target / source.name
        done = write([source], target, how, progress, self.workers, True, self.cloud)
        for path, why in done.failures.items():
            raise BareEarthError(f"{path} cannot be changed. {why}")
        self.waiting = _files_of(done)
        moved = (self.folder.points / path.relative_to(target) for path in self.waiting)
        self.files = sorted({*self.files, *moved})
        return done

    def _draw(self, progress: Progress) -> None:
        """Make the rasters, and the layers of the water that they hold."""
        request, summary, content = self.request, self.summary, self.request.content
        model = request.terrain_with(summary.cell_size)
        paths = {name: self.work.path / f"{name}.tif" for name in content.rasters}
        how = TerrainRequest(
            resources=request.resources, crs=request.crs, rasters=RasterFiles(**paths),
            ground=request.ground, terrain=model, surface=request.surface_model,
            constraints=self.constraints, area=request.area,
            raster_target=request.raster_target, roads=request.selection.roads,
        )  # fmt: skip
        first, second, third = progress.shares(len(paths) + 2.0, 2.0 * content.with_buildings, 0.5)
        terrain([self.cloud], how, first, self.workers)
        if content.with_buildings:
            path = paths[WITH_BUILDINGS] = self.work.path / f"{WITH_BUILDINGS}.tif"
            classes = *request.ground.ground_classes, *request.selection.roads, _BUILDING
            surface = SurfaceModel("all", classes, request.surface.max_edge)
            how = replace(how, rasters=RasterFiles(dsm=path), surface=surface)
            terrain([self.cloud], how, second, self.workers)
        summary.layers |= {name: str(path) for name, path in paths.items()}
        units = Units(self.survey.crs.horizontal_unit, self.survey.crs.vertical_unit)
        summary.cell_size = model.dtm_cell_size
        summary.cell_text = units.length(model.cells(units.horizontal).metres)
        self._draw_water(how, third)

    def _draw_water(self, how: TerrainRequest, progress: Progress) -> None:
        """Write the water and the breaklines, found and given, with their heights in the terrain
        model, if there are any.
        """
        own = self.request.constraints
        if not (self.found or own.water or own.breaklines):
            return
        survey = open_survey([self.cloud], progress=progress.quiet(), stated=self.request.stated)
        own = own.located(Place("the files", survey.crs, survey.box), progress)
        cell = how.raster_step.placed(survey.crs, survey.box).cell / VERTICES_A_SIDE
        clouds = parts_of(survey.tiles, progress.part(0.0, 0.9))
        water = given_water(own, clouds, survey.crs, self.request.ground, cell)
        if self.found:
            water = replace(self.found, breaklines=water.breaklines)
        # Polygons without ground near them have no heights for lines.
        polygons = self._features("water") if water.bodies else None
        lines = self._features("breaklines") if any(True for _ in water.lines()) else None
        water.write(polygons, lines, progress)

    def _features(self, name: str) -> Path:
        """Return the path of a vector layer that is shown: a GeoPackage if it can be written."""
        try:
            feature_writer(Path("x.gpkg"))
        except BareEarthError:
            path = self.work.path / f"{name}.geojson"
        else:
            path = self.work.path / f"{name}.gpkg"
        self.summary.layers[name] = str(path)
        return path

    def _trace(self, progress: Progress) -> None:
        """Draw contour lines."""
        metres, how = self.request.content.contour_metres, self.request.contours
        if metres is not None:
            is_metric = self.survey.crs.vertical_unit == 1.0
            how = how.filled({"contour_interval": metres * (1.0 if is_metric else _FEET_A_METRE)})
        dtm, lines = Path(self.summary.layers["dtm"]), self._features("contours")
        self.summary.interval = write_contours(dtm, lines, how, progress)

    def _check(self, progress: Progress) -> None:
        """Compare the ground with checkpoints, and with points that are held out."""
        request, folder, points = self.request, self.work.path, self.request.checkpoints
        how = CheckOptions(hold_out=request.options.hold_out_share)
        outputs, dtm = {"report": folder / "accuracy.html"}, None
        if points is not None:
            dtm, residuals = self.summary.layers["dtm"], self._features("checkpoints")
            outputs |= {"table": folder / "checkpoints.csv", "residuals": residuals}
        self.summary.check = run(
            file_tool("check"),
            {"sources": [self.cloud], "checkpoints": points, "dtm": dtm, "crs": request.crs},
            outputs,
            [how, request.accuracy, request.ground],
            progress,
        )


def _files_of(done: Any) -> list[Path]:
    """Return the files of points, their lists, and the records of what they were made of."""
    vpc = Path(done.vpc)
    names = {vpc.name, overview_of(vpc).name, *(tile.name for tile in done.tiles)}
    records = folders_of(vpc.parent)[1]
    paths = sorted(path for path in vpc.parent.rglob("*") if path.is_file())
    return [path for path in paths if path.name in names or records in path.parents]
