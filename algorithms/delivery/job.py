"""A delivery while it is made: its parameters, the values that its tools share, and its files."""

from __future__ import annotations

import os
import time
from dataclasses import replace
from pathlib import Path
from typing import Any, Callable, Collection, Iterable, Mapping, NamedTuple, Sequence, cast

from ..classes.selection import Selection
from ..core.errors import BareEarthError
from ..core.files import make_work_folder, split_name
from ..core.parameters import ParameterSet
from ..core.progress import Progress
from ..core.temporary import patiently, remove
from ..engine.manifest import folders_of
from ..engine.options import TileOutput
from ..engine.summary import SurveySummary, TileSummary
from ..engine.unpacking import Unpacking
from ..engine.workers import Workers
from ..report.units import Units
from ..survey.feature_files import feature_writer
from ..survey.files import Inputs, open_survey
from ..tools import any_tool
from ..tools.rasters.constraints import Constraints
from ..tools.rasters.parameters import TerrainModel
from ..tools.running import run
from ..tools.water.tool import SurveyWater
from .deliveries import Delivery
from .folder import DeliveryFolder
from .parameters import AS_DELIVERY, DeliveryOptions, DeliveryTerrain, GivenSet, Settings
from .summary import DeliverySummary

# Feet between contour lines where heights are in feet, for each metre between them elsewhere. For
# 0.5 m this gives 2 feet, a round number of about the same height.
_FEET_A_METRE = 4.0
_ENDINGS = {"raster": ".tif", "page": ".html", "table": ".csv", "folder": ""}


class Row(NamedTuple):
    """A tool in the table of a delivery: what it reads, and what it writes."""

    title: str  # under which the time that it takes is added up
    tool: str  # its command
    weight: float  # its share of the progress bar
    needs: tuple[
        str, ...
    ] = ()  # keys of `DeliveryJob.known`: without a value of each, it is skipped
    inputs: Mapping[str, str] = {}  # keys of `DeliveryJob.known`, by the names of the tool's inputs
    outputs: Mapping[str, str] = {}  # names of files, by the names of the tool's outputs
    summary_field: str = ""  # of `DeliverySummary`, which gets the result of the tool
    summary_value: Callable[[Any], object] = lambda result: result  # the part of it for that field
    values: Mapping[str, object] = {}  # of parameters, by their names, in place of the user's
    kept: Sequence[str] | None = None  # names of the rasters in its folder; None for all
    work: Callable[[DeliveryJob, Row, Progress], object] = lambda job, row, part: job.run(row, part)


class DeliveryJob(Settings):
    """A delivery while it is made, in a temporary folder."""

    def __init__(
        self,
        content: Delivery,
        sources: Inputs,  # opened
        sets: Sequence[ParameterSet],
        inputs: Mapping[str, Any],  # of the user
        summary: DeliverySummary,
        working: DeliveryFolder,
        folder: DeliveryFolder,  # where many files are made, as finished ones stay after a cancel
        unpacked: Path,  # a folder for records that are decompressed
        workers: Workers | None,  # for many files
        named: Collection[str] = (),  # the parameters that the user gave
    ) -> None:
        self.content, self.summary = content, summary
        self.survey = open_survey(sources)  # of the raw files
        self.working, self.folder, self.unpacked = working, folder, unpacked
        self.files: list[Path] = []  # of points, where they are in the finished delivery
        self.changed_files: list[Path] = []  # replace some of `files` at the end
        self.found_water: SurveyWater | None = None
        # The breaklines and polygons of the user.
        self.constraints: Constraints = inputs["constraints"]
        options = DeliveryOptions.among(sets)
        self.specification = options.specification
        if self.specification == AS_DELIVERY:
            self.specification = content.specification
        values = content.values_with(self.specification)
        values.update(area_only=inputs["area"] is not None, hold_out=options.hold_out_share)
        wanted = {
            "find water": content.water and not self.constraints.water,
            "classes of water": content.water,
            "key points": options.key_points,
            "buildings": content.with_buildings,
            "check": options.hold_out_share or inputs["checkpoints"],
        }
        if content.contour_metres is not None:
            factor = 1.0 if self.survey.crs.vertical_unit == 1.0 else _FEET_A_METRE
            values["contour_interval"] = content.contour_metres * factor
        super().__init__(sets, values, named)
        self.sources = sources  # the points that the next row reads
        # By name: the inputs of the user, what is wanted, and the files and results of the rows.
        self.known: dict[str, Any] = {**inputs, **wanted, "roads": self.set_of(Selection).roads}
        self.workers = workers
        self.seconds: dict[str, float] = {}  # that rows took, by their titles
        if not wanted["find water"]:
            self.know_water()

    def work(self, rows: Iterable[Row], progress: Progress) -> None:
        """Run the tools one after another."""
        # A value that is missing now may be the result of another row.
        possible = [row for row in rows if all(self.known.get(name, True) for name in row.needs)]
        for row, part in zip(possible, progress.shares(*(row.weight for row in possible))):
            if all(self.known.get(name) for name in row.needs):
                start = time.perf_counter()
                result = row.work(self, row, part)
                if row.summary_field:
                    setattr(self.summary, row.summary_field, row.summary_value(result))
                seconds = self.seconds.get(row.title, 0.0) + time.perf_counter() - start
                self.seconds[row.title] = round(seconds, 2)
        model, crs = self.set_of(TerrainModel), self.survey.crs
        units = Units(crs.horizontal_unit, crs.vertical_unit)
        self.summary.cell_size = model.dtm_cell_size
        self.summary.cell_text = units.length(model.cells(units.horizontal).metres)

    def given(self, kind: type[GivenSet]) -> GivenSet:
        """Return parameters as the user gave them, but for an empty cell size, which follows from
        the density of the ground points as soon as it is measured.
        """
        values, quality = super().given(kind), self.summary.quality
        if quality is None or not isinstance(values, DeliveryTerrain):
            return values
        size = self.content.cell_size(quality.ground_density, self.specification)
        return cast(GivenSet, values.with_cells(size))

    def run(self, row: Row, progress: Progress) -> object:
        """Run the tool of a row, and return its result."""
        if not any_tool(row.tool).writes_points:
            result = self._run(row, progress)
        elif self.sources.output_kind == "folder":
            result = self._write_many(row, progress)
        else:
            result = self._write_one(row, progress)
        if row.kept is not None:
            for name in row.outputs.values():
                for path in (self.working.path / name).glob("*.tif"):
                    if path.stem not in row.kept:
                        remove(path)
        return result

    def _write_one(self, row: Row, progress: Progress) -> TileSummary:
        """Let a tool write the points of a single file, or change the file that was written."""
        source, is_first = self.sources[0], not self.files
        if is_first:
            kind = self.set_of(TileOutput).format
            name = source.name if kind == "same" else f"{split_name(source)[0]}.{kind}"
            target = self.working.points / name
        else:
            target = self.working.waiting / source.name
        target.parent.mkdir(exist_ok=True)
        result: TileSummary = self._run(row, progress, output=target)
        if not is_first:
            patiently(os.replace, target, source)
            target = source
        self.sources, self.files = Inputs(target), [target]
        self._count_points(result)
        return result

    def _write_many(self, row: Row, progress: Progress) -> SurveySummary:
        """Let a tool write the points of many files, or change the files that were written; changed
        files are in another folder until the end, so that a run can be continued.
        """
        result: SurveySummary
        if not self.files:
            result = self._run(row, progress, output=self.folder.points)
            self.files, self.summary.failures = _files_of(result), dict(result.failures)
        else:
            target = self.folder.waiting / row.tool
            if not self.set_of(TileOutput).resume:
                remove(target)
            make_work_folder(target.parent)
            result = self._run(row, progress, output=target, vpc=target / self.cloud.name)
            for path, why in result.failures.items():
                raise BareEarthError(f"{path} cannot be changed. {why}")
            self.changed_files = _files_of(result)
            moved = (self.folder.points / path.relative_to(target) for path in self.changed_files)
            self.files = sorted({*self.files, *moved})
        self.sources = Inputs(result.vpc)
        self._count_points(result)
        return result

    def _count_points(self, result: TileSummary | SurveySummary) -> None:
        """Put the numbers of points of each class into the summary of the delivery."""
        counts, summary = result.class_counts, self.summary
        summary.cloud = summary.cloud or str(self.cloud)
        summary.class_counts, summary.point_count = counts, sum(counts.values())
        summary.ground_count = counts.get(self.set_of(Selection).to_class, 0)

    def _run(self, row: Row, progress: Progress, **outputs: Path) -> Any:
        """Run the tool of a row; `outputs` are files of points, beside the outputs of the row."""
        tool, paths = any_tool(row.tool), dict(outputs)
        inputs = {name: self.known.get(value) for name, value in row.inputs.items()}
        for output in tool.all_outputs:
            if output.name in row.outputs and inputs.get(output.needs, True) is not None:
                paths[output.name] = self.place(output.kind, row.outputs[output.name])
        for declared in tool.inputs:
            if declared.name in inputs:
                inputs[declared.name] = declared.of(inputs[declared.name])
        for declared in tool.all_inputs:
            if declared.kind == "crs":
                inputs[declared.name] = self.known["crs"]
            elif declared.kind == "clouds" and "output" in outputs:
                inputs[declared.name] = self.sources
            elif declared.kind == "clouds":
                inputs[declared.name], progress = self.opened(progress)
        sets = [
            replace(values, **{name: row.values[name] for name in row.values.keys() & vars(values)})
            for values in self.sets_of(tool)
        ]
        return run(tool, inputs, paths, sets, progress, self.workers)

    @property
    def cloud(self) -> Path:
        """The classified file, or the virtual point cloud of many."""
        return self.sources[0]

    def opened(self, progress: Progress) -> tuple[Inputs, Progress]:
        """Return the points, which are opened and decompressed once for all rows, and the rest of
        the progress.
        """
        if self.sources.opened is None:
            part = progress.part(0.0, 0.1)
            survey = open_survey(self.sources.read_as(self.known["crs"]), part)
            unpacking = Unpacking(self.unpacked, is_whole=True)
            shares = part.shares(*(tile.count for tile in survey.tiles))
            tiles = (unpacking.of(tile, share) for tile, share in zip(survey.tiles, shares))
            self.sources = self.sources.holding(replace(survey, tiles=tuple(tiles)))
            progress = progress.part(0.1, 1.0)
        return self.sources, progress

    def know_water(self) -> None:
        """Let further rows read the water, which has been found or is that of the user."""
        self.known["outlines"] = self.known["constraints"].water_outlines
        given = self.constraints
        self.known["water lines"] = self.found_water or given.water or given.breaklines

    def place(self, kind: str, name: str) -> Path:
        """Return the temporary path of an output, and list it if maps show such files."""
        path = self.working.path / f"{name}{_ENDINGS.get(kind, _ending_of_features())}"
        if kind in ("raster", "features"):
            self.known[name] = self.summary.layers[name] = str(path)
        return path


def _files_of(result: SurveySummary) -> list[Path]:
    """Return the files of points, their virtual point cloud, and their records."""
    vpc = Path(result.vpc)
    names = {vpc.name, *(tile.name for tile in result.tiles)}
    records = folders_of(vpc.parent)[1]
    paths = sorted(path for path in vpc.parent.rglob("*") if path.is_file())
    return [path for path in paths if path.name in names or records in path.parents]


def _ending_of_features() -> str:
    """Return the ending of a GeoPackage if it can be written."""
    try:
        feature_writer(Path("x.gpkg"))
    except BareEarthError:
        return ".geojson"
    return ".gpkg"
