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
from ..runs.entry import classify, terrain, write
from ..runs.one_file import Summary
from ..runs.options import TileInput
from ..runs.requests import PointRequest, TerrainRequest
from ..survey.files import Survey
from ..survey.overview import overview_of
from ..tools.check.checking import TOOL as CHECK
from ..tools.check.checking import CheckOptions
from ..tools.check.results import Check
from ..tools.contours import Interval, write_contours
from ..tools.key_points import FindKeyPoints, KeyPointMark
from ..tools.quality import QualityRequest, survey_quality
from ..tools.quality.figures import Quality
from ..tools.rasters.constraints import Constraints
from ..tools.rasters.parameters import SurfaceModel
from ..tools.rasters.rows import RasterFiles
from ..tools.running import run
from ..tools.water.tool import SurveyWater, WaterSummary, found_water
from ..tools.water_classes import ClassifyWater, WaterPolygons
from .deliveries import WITH_BUILDINGS
from .folder import KEY_POINTS, QUALITY, WATER, DeliveryFolder
from .request import DeliveryRequest
from .water import vector_format, write_water

_BUILDING = 6
# Contour lines in a CRS whose heights are feet: so many feet are about half a metre.
_FEET_A_METRE = 4.0


@dataclass
class Made:
    """What the steps have made so far."""

    cloud: Path | None = None  # None before the points are classified
    point_count: int = 0
    ground_count: int = 0
    class_counts: dict[int, int] = field(default_factory=dict)
    failures: dict[str, str] = field(default_factory=dict)
    files: list[Path] = field(default_factory=list)
    changed: Path | None = None  # list of many files that take the places of `files` at the end
    waiting: list[Path] = field(default_factory=list)  # the files of `changed`
    layers: dict[str, Path] = field(default_factory=dict)
    cell_size: float = 1.0
    constraints: Constraints | None = None
    found: SurveyWater | None = None
    quality: Quality | None = None
    check: Check | None = None
    water: WaterSummary | None = None
    interval: Interval | None = None
    seconds: dict[str, float] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)


@dataclass
class DeliverySteps:
    """The steps of a delivery."""

    request: DeliveryRequest
    survey: Survey  # the raw files
    sources: list[Path]  # files and folders as the user gave them
    is_one: bool  # file
    work: DeliveryFolder  # where outputs are made that get their places at the end
    folder: DeliveryFolder  # where many files are classified, as finished ones stay after a cancel
    workers: Workers | None  # for many files
    made: Made = field(default_factory=Made)

    def run(self, progress: Progress) -> Made:
        """Run all steps."""
        content, options = self.request.content, self.request.options
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
                self.made.seconds[name] = time.perf_counter() - begun
        remove(self.work.waiting)
        return self.made

    @property
    def _cloud(self) -> Path:
        """The points that further steps read."""
        if self.made.cloud is None:
            raise BareEarthError("The points are not classified yet.")
        return self.made.changed or self.made.cloud

    def _classify(self, progress: Progress) -> None:
        """Classify the points, and add their heights, as the delivery asks."""
        made, target = self.made, self._target
        (target.parent if self.is_one else target).mkdir(parents=True, exist_ok=True)
        how = self.request.classify
        as_survey = not self.is_one
        done = classify(self.sources, target, how, progress, self.workers, as_survey=as_survey)
        made.cloud = target if self.is_one else Path(done.vpc)
        made.files = [target] if self.is_one else _files_of(done)
        if not self.is_one:
            made.failures |= done.failures
        made.point_count, made.ground_count = _counts_of(done)
        made.class_counts = done.class_counts

    @property
    def _points(self) -> Path:
        """The folder of the classified points."""
        return (self.work if self.is_one else self.folder).points

    @property
    def _target(self) -> Path:
        """The classified points: a file, or the folder of many."""
        if not self.is_one:
            return self._points
        source, kind = self.sources[0], self.request.tiles.format
        name = source.name if kind == "same" else f"{split_name(source)[0]}.{kind}"
        return self._points / name

    @property
    def _further(self) -> dict[str, Any]:
        """The options of a step that reads the classified points."""
        request = self.request
        return {
            "files": TileInput(), "tiles": request.tiles, "resources": request.resources,
            "crs": request.crs,
        }  # fmt: skip

    def _measure(self, progress: Progress) -> None:
        """Measure the quality, and choose the cell size by the density of the ground."""
        request, made, kept = self.request, self.made, self.request.content.quality
        folder = self.work.path / QUALITY
        made.quality = survey_quality(
            [self._cloud],
            QualityRequest(
                request.quality,
                request.ground,
                self.work.path / "quality.html",
                folder if kept else None,
                request.crs,
            ),
            progress,
        )
        for each in folder.glob("*.tif"):
            if each.stem not in kept:
                remove(each)
        made.cell_size = request.content.cell_size(
            made.quality.ground_density, request.specification
        )

    def _water(self, progress: Progress) -> None:
        """Find the water, and give classes to the ground in it and beside its shore."""
        first, second = progress.shares(1.0, 1.0)
        self._find_water(first)
        how, known = self.request.water_classes, self.made.constraints or self.request.constraints
        if how is None or not known.water:
            return
        step = ClassifyWater(how, self.request.ground, WaterPolygons(known.water_outlines))
        done = self._change(PointRequest(step, **self._further), WATER, second)
        self.made.class_counts = done.class_counts
        self.made.ground_count = done.class_counts.get(self.request.selection.to_class, 0)

    def _mark(self, progress: Progress) -> None:
        """Mark the key points: among the ground that water and its shore leave."""
        step = FindKeyPoints(ground=self.request.ground, mark=KeyPointMark(mark_as="flag"))
        self._change(PointRequest(step, **self._further), KEY_POINTS, progress)

    def _change(self, how: PointRequest, name: str, progress: Progress) -> Any:
        """Change the classified points, of many files in a folder `name` until all outputs are
        made, so that a run can be continued.
        """
        source = self._cloud
        if self.is_one:
            target = self.work.waiting / source.name
            target.parent.mkdir(exist_ok=True)
            done = write([source], target, how, progress)
            patiently(os.replace, target, source)
            return done
        target = self.folder.waiting / name
        if not how.tiles.resume:
            remove(target)
        make_work_folder(target.parent)
        vpc = target / source.name
        done = write([source], target, how, progress, self.workers, True, vpc)
        for path, why in done.failures.items():
            raise BareEarthError(f"{path} cannot be changed. {why}")
        self.made.changed, self.made.waiting = vpc, _files_of(done)
        moved = (self._points / each.relative_to(target) for each in self.made.waiting)
        self.made.files = sorted({*self.made.files, *moved})
        return done

    def _find_water(self, progress: Progress) -> None:
        """Find the water, unless the user has given some."""
        request, wanted = self.request, self.request.water_wanted
        if wanted is None:
            return
        found, self.made.water = found_water(
            [self._cloud], request.ground, request.crs, progress, wanted
        )
        if found.bodies:
            self.made.found = found
            self.made.constraints = request.constraints.with_water(found.constraints, progress)

    def _draw(self, progress: Progress) -> None:
        """Make the rasters."""
        request, made, content = self.request, self.made, self.request.content
        model = request.terrain_with(made.cell_size)
        made.cell_size = model.dtm_cell_size
        paths = {name: self.work.path / f"{name}.tif" for name in content.rasters}
        how = TerrainRequest(
            resources=request.resources, crs=request.crs, rasters=RasterFiles(**paths),
            ground=request.ground, terrain=model, surface=request.surface_model,
            constraints=made.constraints or request.constraints, area=request.area,
            raster_target=request.raster_target, roads=request.selection.roads,
        )  # fmt: skip
        first, second, third = progress.shares(len(paths) + 2.0, 2.0 * content.with_buildings, 0.5)
        terrain([self._cloud], how, first, self.workers)
        made.layers |= paths
        if content.with_buildings:
            path = self.work.path / f"{WITH_BUILDINGS}.tif"
            classes = *request.ground.ground_classes, *request.selection.roads, _BUILDING
            surface = SurfaceModel("all", classes, request.surface.max_edge)
            how = replace(how, rasters=RasterFiles(dsm=path), surface=surface)
            terrain([self._cloud], how, second, self.workers)
            made.layers[WITH_BUILDINGS] = path
        made.layers |= write_water(self._cloud, request, made.found, how, self.work.path, third)

    def _trace(self, progress: Progress) -> None:
        """Draw contour lines."""
        metres, how = self.request.content.contour_metres, self.request.contours
        if metres is not None:
            is_metric = self.survey.crs.vertical_unit == 1.0
            how = how.filled({"contour_interval": metres * (1.0 if is_metric else _FEET_A_METRE)})
        target = self.work.path / f"contours{vector_format()}"
        self.made.interval = write_contours(self.made.layers["dtm"], target, how, progress)
        self.made.layers["contours"] = target

    def _check(self, progress: Progress) -> None:
        """Compare the ground with checkpoints, and with points that are held out."""
        request, folder, points = self.request, self.work.path, self.request.checkpoints
        how = CheckOptions(hold_out=request.options.hold_out_share)
        outputs, dtm = {"report": folder / "accuracy.html"}, None
        if points is not None:
            residuals = folder / f"checkpoints{vector_format()}"
            outputs |= {"table": folder / "checkpoints.csv", "residuals": residuals}
            self.made.layers["checkpoints"], dtm = residuals, str(self.made.layers["dtm"])
        self.made.check = run(
            CHECK,
            {"sources": [self._cloud], "checkpoints": points, "dtm": dtm, "crs": request.crs},
            outputs,
            [how, request.accuracy, request.ground],
            progress,
        )


def _files_of(done: Any) -> list[Path]:
    """Return the files of points, their lists, and the records of what they were made of."""
    vpc = Path(done.vpc)
    names = {vpc.name, overview_of(vpc).name, *(each.name for each in done.tiles)}
    records = folders_of(vpc.parent)[1]
    found = sorted(each for each in vpc.parent.rglob("*") if each.is_file())
    return [each for each in found if each.name in names or records in each.parents]


def _counts_of(done: Any) -> tuple[int, int]:
    """Return the numbers of points and of ground points of a summary; those of the area."""
    if isinstance(done, Summary):
        return done.area_count, done.area_ground_count
    return done.point_count, done.ground_count
