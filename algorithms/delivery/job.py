"""A delivery while it is made: its parameters, what is known by now, and where outputs wait."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from typing import Any, Callable, Iterable, Mapping, NamedTuple, Sequence, TypeVar

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet
from ..core.progress import Progress
from ..engine.memory import Resources
from ..engine.options import TileInput, TileOutput
from ..engine.unpacking import Unpacking
from ..engine.workers import Workers
from ..filters import DEFAULT_METHOD, METHODS
from ..survey.feature_files import feature_writer
from ..survey.files import Inputs, open_survey
from ..survey.ground_classes import GroundClasses
from ..survey.selection import Selection
from ..tools import any_tool
from ..tools.declaration import FileTool, MapTool, Tool
from ..tools.ground.method import TileMethod
from ..tools.running import run
from ..tools.water.tool import SurveyWater
from .deliveries import Delivery
from .folder import DeliveryFolder
from .parameters import AS_DELIVERY, DeliveryOptions
from .summary import DeliverySummary

_Set = TypeVar("_Set", bound=ParameterSet)
_METHODS = tuple(method.parameters for method in METHODS.values())
# Contour lines in a CRS whose heights are feet: so many feet are about half a metre.
_FEET_A_METRE = 4.0
_ENDINGS = {"raster": ".tif", "page": ".html", "table": ".csv", "folder": ""}


class Row(NamedTuple):
    """A tool in a table: what it gets, and what it writes."""

    title: str  # of the time that it takes
    tool: str  # its command
    weight: float  # its share of the progress bar
    needs: tuple[str, ...] = ()  # it is left out unless all of these are known, and not empty
    inputs: Mapping[str, str] = {}  # what is known, by the names of the tool's inputs
    outputs: Mapping[str, str] = {}  # names of files, by the names of the tool's outputs
    tells: str = ""  # the field of the summary for what the tool returns
    work: Callable[..., Any] = lambda job, row, progress: job.run(row, progress)


class Settings:
    """The parameters of a delivery: what the user gave, and values of the table for the rest."""

    def __init__(self, sets: Iterable[ParameterSet], values: Mapping[str, Any]) -> None:
        self.values = dict(values)  # of parameters that the user left at their defaults, by name
        named = (one.parameters if isinstance(one, TileMethod) else one for one in sets)
        self.sets: list[ParameterSet] = [*named, METHODS[DEFAULT_METHOD].parameters()]
        self.sets.append(GroundClasses.of_selection(self.set_of(Selection)))

    def sets_of(self, tool: Tool) -> list[ParameterSet]:
        """Return the parameters of a tool."""
        kinds = tool.sets
        if isinstance(tool, MapTool) and tool.classifies:
            kinds = type(self.method), *kinds
        if not isinstance(tool, (FileTool, MapTool)):
            kinds = *kinds, TileInput, TileOutput, Resources
        return [self.set_of(kind) for kind in kinds]

    def set_of(self, kind: type[_Set]) -> _Set:
        """Return parameters with the values of the table where the user left the defaults."""
        values: dict[str, Any] = {}
        given = next((known for known in self.sets if isinstance(known, kind)), kind())
        for declared in given.declarations():
            value, name = getattr(given, declared.name), declared.name
            if value == declared.default:
                value = self.values.get(name, value)
                if declared.choices and value not in declared.choices:
                    value = declared.default
            # What was left open, and only in the table, has the default of the tool.
            if value is not None or declared.default is not None:
                values[name] = value
        return kind(**values)

    @property
    def method(self) -> ParameterSet:
        """The parameters of the ground filter, without values of the table."""
        return next(values for values in self.sets if isinstance(values, _METHODS))


class DeliveryJob(Settings):
    """A delivery while it is made, in a folder where its outputs wait for their places."""

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
    ) -> None:
        self.content, self.is_survey = content, sources.is_survey
        self.survey = open_survey(sources)  # of the raw files
        self.working, self.folder, self.unpacked = working, folder, unpacked
        self.files: list[Path] = []  # of points, at their places
        self.waiting: list[Path] = []  # take the places of `files` at the end
        self.found: SurveyWater | None = None
        self.own, options = inputs["constraints"], DeliveryOptions.among(sets)
        self.specification = options.specification
        if self.specification == AS_DELIVERY:
            self.specification = content.specification
        values = content.values_with(self.specification)
        values.update(area_only=inputs["area"] is not None, hold_out=options.hold_out_share)
        wanted = {
            "find water": content.water and not self.own.water,
            "classes of water": content.water,
            "key points": options.key_points,
            "buildings": content.with_buildings,
            "check": options.hold_out_share or inputs["checkpoints"],
        }
        if content.contour_metres is not None:
            factor = 1.0 if self.survey.crs.vertical_unit == 1.0 else _FEET_A_METRE
            values["contour_interval"] = content.contour_metres * factor
        super().__init__(sets, values)
        self.sources = sources  # the points that the next row reads
        # By name: inputs of the user, what is wanted, and what rows have written and found.
        self.known = {**inputs, **wanted, "roads": self.set_of(Selection).roads}
        self.summary, self.workers = summary, workers
        self.seconds: dict[str, float] = {}  # that rows took, by their titles
        if not wanted["find water"]:
            self.know_water()

    def work(self, rows: Iterable[Row], progress: Progress) -> None:
        """Let the tools work one after another."""
        # What is not known yet may become known.
        left = [row for row in rows if all(self.known.get(name, True) for name in row.needs)]
        for row, part in zip(left, progress.shares(*(row.weight for row in left))):
            if all(self.known.get(name) for name in row.needs):
                begun = time.perf_counter()
                done = row.work(self, row, part)
                if row.tells:
                    setattr(self.summary, row.tells, done)
                took = self.seconds.get(row.title, 0.0) + time.perf_counter() - begun
                self.seconds[row.title] = round(took, 2)

    def run(self, row: Row, progress: Progress, **outputs: Path) -> Any:
        """Let the tool of a row work, with further outputs that are given here."""
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
        return run(tool, inputs, paths, self.sets_of(tool), progress, self.workers)

    @property
    def cloud(self) -> Path:
        """The classified file, or the virtual point cloud of many."""
        return self.sources[0]

    def opened(self, progress: Progress) -> tuple[Inputs, Progress]:
        """Return the points, opened and decompressed once for all rows, and what is left of the
        progress.
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
        """Let further rows know the water, found or given, after which nothing more is found."""
        constraints, own = self.known["constraints"], self.own
        self.known["outlines"] = constraints.water_outlines
        self.known["water lines"] = self.found or own.water or own.breaklines

    def place(self, kind: str, name: str) -> Path:
        """Return where an output waits, and list it if a map shows it."""
        path = self.working.path / f"{name}{_ENDINGS.get(kind, _ending_of_features())}"
        if kind in ("raster", "features"):
            self.known[name] = self.summary.layers[name] = str(path)
        return path


def _ending_of_features() -> str:
    """Return the ending of a GeoPackage if it can be written."""
    try:
        feature_writer(Path("x.gpkg"))
    except BareEarthError:
        return ".geojson"
    return ".gpkg"
