"""The functions of `bare_earth.arrays`: points as arrays in, results as arrays out.

They are declared as those for files are, and have the same names and parameters.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from functools import cache, partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Callable, Iterator, Sequence, cast

import numpy as np

from ..core.errors import BareEarthError
from ..core.files import Outputs
from ..core.parameters import ParameterSet, parameter_of
from ..core.points import Frame
from ..core.progress import Progress
from ..core.threads import available_cpus, may_use
from ..engine.file_points import FilePoints, TileResult
from ..engine.memory import Resources
from ..engine.one_file import FileRun
from ..engine.step import Step
from ..las.cloud import PointCloud
from ..survey.files import Inputs
from ..survey.ground_classes import GroundClasses, GroundCounts
from ..survey.selection import Selection
from ..tools import map_tool, point_tool
from ..tools.check.accuracy import Accuracy
from ..tools.check.checking import CheckOptions, check_points
from ..tools.check.results import Check
from ..tools.check.survey_ground import SurveyGround
from ..tools.heights import HeightOutput, HeightsOfPoints
from ..tools.key_points import KeyPointMark
from ..tools.rasters.output import write_rasters
from ..tools.rasters.parameters import SurfaceModel, TerrainModel
from ..tools.rasters.rows import RASTERS
from ..tools.rasters.step import MakeRasters
from . import arguments, tool_commands
from .arguments import REQUIRED, Argument, Kind
from .functions import PACKAGE, Function
from .given import (
    area_of,
    checkpoints_of,
    constraints_of,
    corrections_of,
    is_automatic,
    progress_of,
    target_of,
)
from .points import cloud_of, with_ground
from .rasters import Collected, Raster
from .tools import arguments_of, input_of

_TABLE = (
    "x of the points in units of the CRS; or x, y and z as one array of shape (n, 3); or a"
    " laspy.LasData; or a table with the columns X, Y, Z and, where they are, Classification,"
    " ReturnNumber, NumberOfReturns, Withheld and Overlap: a structured array, such as PDAL has, a"
    " dict of arrays, or a table of pandas, polars or pyarrow"
)
_NUMBERS, _FLAGS = "array of int, shape (n,)", "array of bool, shape (n,)"


def _array(name: str, help: str, words: str = "array of float, shape (n,)") -> Argument:
    return Argument(name, Kind("ArrayLike", words), help)


_POINTS = (
    Argument("points", Kind("Any", "array, laspy.LasData or table"), _TABLE, REQUIRED),
    _array("y", "y of the points, if `points` is x"),
    _array("z", "z of the points, if `points` is x"),
)
_ATTRIBUTES = (
    _array("classification", "the classes of the points, in place of those of a table", _NUMBERS),
    _array("return_number", "the return numbers, from 1 on", _NUMBERS),
    _array("number_of_returns", "how many returns the pulse of each point has", _NUMBERS),
    _array("withheld", "which points are left out of everything", _FLAGS),
    _array("in_overlap", "which points lie in the overlap of flight strips", _FLAGS),
)
_GROUND = _array(
    "ground", "which points are ground, as ground() returns them, in place of their classes", _FLAGS
)
_CRS = Argument(
    "crs",
    Kind("Any", "str, int or pyproj.CRS"),
    "the CRS: an EPSG code, such as 25832 or EPSG:2230+6360 (with heights), or WKT; it replaces"
    " that of a laspy.LasData, and without both coordinates are metres",
)
_LAST = (_CRS, arguments.PROGRESS)
_NO_FILES = Inputs((), is_survey=False)


@dataclass(frozen=True)
class ArrayTerrain(TerrainModel):
    """The same with NaN for no data, as arrays have it."""

    raster_nodata: float | None = parameter_of(TerrainModel, "raster_nodata", default=None)


def _found(
    cloud: PointCloud, steps: Sequence[Step], resources: Resources, progress: Progress
) -> TileResult:
    """Return what steps find for points."""
    with may_use(resources.thread_count):
        run = FileRun(FilePoints(cloud, resources), steps, progress)
        run.work(progress.part(0.0, 0.95))
        return run.found(progress.part(0.95, 1.0))


def _cloud(values: SimpleNamespace, sets: list[Any], progress: Progress) -> PointCloud:
    """Return the points, with the ground that the user gives."""
    cloud = cloud_of(values, progress)
    return with_ground(cloud, values.ground, GroundClasses.among(sets).ground_classes)


def _classes(values: SimpleNamespace, sets: list[Any]) -> Any:
    """Return the class of each point."""
    progress = progress_of(values.progress)
    inputs = {"area": area_of(values), "corrections": corrections_of(values)}
    steps = map_tool("classify").steps(sets, {"input": _NO_FILES, **inputs}, {})
    cloud = cloud_of(values, progress)
    return _found(cloud, steps, Resources.among(sets).now(), progress).classification


def _ground_of(values: SimpleNamespace, sets: list[Any]) -> np.ndarray:
    ground = GroundClasses.of_selection(Selection.among(sets))
    return np.isin(_classes(values, sets), ground.ground_classes)


def _of_classes(
    name: str, about: str, gives: Kind, run: Callable[[SimpleNamespace, list[Any]], Any]
) -> Function:
    """Return a function that finds the ground."""
    return Function(
        name,
        f"{about}\nThe labels are those of classify() on a file with the same points.",
        _POINTS,
        (
            *_ATTRIBUTES, *arguments.area("classify only points in", "; points nearby help"),
            *arguments.of_group("corrections"), *_LAST,
        ),
        (Selection, Resources),
        run,
        gives=gives,
        has_method=True,
    )  # fmt: skip


def _of_tool(
    name: str, about: str, gives: Kind, value: Callable[[TileResult], Any], *fixed: ParameterSet
) -> Function:
    """Return the function of a tool for points; it does without the sets that are fixed."""
    tool = point_tool(tool_commands()[name])

    def run(values: SimpleNamespace, sets: list[Any]) -> Any:
        progress = progress_of(values.progress)
        inputs = {one.name: input_of(one, values) for one in tool.inputs}
        steps = tool.steps([*sets, *fixed], inputs, {})
        cloud = _cloud(values, sets, progress)
        return value(_found(cloud, steps, Resources.among(sets).now(), progress))

    sets = tuple(kind for kind in tool.sets if kind not in map(type, fixed))
    inputs = [argument for declared in tool.inputs for argument in arguments_of(declared)]
    return Function(
        name, about, _POINTS, (_GROUND, *_ATTRIBUTES, *inputs, *_LAST),
        (*sets, Resources), run, gives=gives,
    )  # fmt: skip


@dataclass(frozen=True)
class _RastersInMemory(MakeRasters):
    """Makes rasters without files."""

    def finish(
        self, result: Any, frame: Frame, outputs: Outputs, progress: Progress, tiles: Any = None
    ) -> Any:
        """Return the rasters by their names."""
        collected = Collected()
        write_rasters(result, frame, self, outputs, progress, write_cells=collected.add)
        return collected.rasters


def _terrain(values: SimpleNamespace, sets: list[Any]) -> dict[str, Raster]:
    """Return rasters by their names."""
    progress = progress_of(values.progress)
    names = [values.rasters] if isinstance(values.rasters, str) else [*values.rasters]
    for name in names:
        if name not in RASTERS:
            raise BareEarthError(f"There is no raster {name}, only {', '.join(RASTERS)}.")
    if not names:
        raise BareEarthError(f"Choose at least one raster to make: {', '.join(RASTERS)}.")
    if is_automatic(values.water):
        raise BareEarthError("Water is found in files only: give polygons of water.")
    sets = [TerrainModel(**vars(one)) if type(one) is ArrayTerrain else one for one in sets]
    inputs = {
        "area": area_of(values), "constraints": constraints_of(values),
        "raster_target": target_of(values),
    }  # fmt: skip
    drawing: Any = map_tool("terrain").steps(sets, inputs, {name: Path(name) for name in names})[0]
    step = _RastersInMemory(**{one.name: getattr(drawing, one.name) for one in fields(drawing)})
    cloud, resources = _cloud(values, sets, progress), Resources.among(sets).now()
    with may_use(resources.thread_count):
        run = FileRun(FilePoints(cloud, resources), [step], progress)
        run.work(progress)
    (rasters,) = run.told
    return {name: rasters[name] for name in names}


def _of_terrain() -> Function:
    choices = ", ".join(f'"{name}"' for name in RASTERS)
    kinds = " ".join(f"{name}: {row.help}" for name, row in RASTERS.items()).rstrip(".")
    kind = Kind(f"Literal[{choices}] | Sequence[Literal[{choices}]]", "str or sequence of str")
    return Function(
        "terrain",
        "Make rasters of the terrain and of what stands on it.\nThe cells are those that terrain()"
        " writes for a file with the same points; cells without data are NaN, or 0 in pictures.",
        _POINTS,
        (
            Argument("rasters", kind, f"which rasters to make. {kinds}", ("dtm",)),
            _GROUND, *_ATTRIBUTES, *arguments.of_group("target"),
            *arguments.area("make the rasters only in"), *arguments.of_group("constraints"), *_LAST,
        ),
        (GroundClasses, ArrayTerrain, SurfaceModel, Resources),
        _terrain,
        gives=Kind("dict[str, Raster]", "The rasters by their names."),
    )  # fmt: skip


class _CloudGround(SurveyGround):
    """The ground points of a cloud in memory."""

    def __init__(self, cloud: PointCloud, ground: GroundClasses) -> None:
        tile = SimpleNamespace(path=cloud.path, count=cloud.count, outer_box=cloud.box)
        survey: Any = SimpleNamespace(crs=cloud.crs, tiles=(tile,), box=cloud.box)
        super().__init__(survey, ground)
        self._cloud = cloud

    def parts(
        self, progress: Progress, near: np.ndarray | None = None, reach: float = 0.0
    ) -> Iterator[tuple[PointCloud, np.ndarray]]:
        """Yield the points in parts, and which of them are ground."""
        self.counts = GroundCounts()
        for where, part in self._cloud.parts():
            yield part, self.ground.of(part, self.counts)
            progress(where.stop / self._cloud.count)


def _check(values: SimpleNamespace, sets: list[Any]) -> Check:
    """Return the errors at checkpoints, or at points that are held out."""
    progress, ground = progress_of(values.progress), GroundClasses.among(sets)
    with may_use(available_cpus()):
        return check_points(
            _CloudGround(_cloud(values, sets, progress), ground),
            checkpoints_of(values),
            vegetated=values.vegetated,
            accuracy=Accuracy.among(sets),
            options=CheckOptions.among(sets),
            ground=ground,
            progress=progress,
        )


def _of_check() -> Function:
    vegetated = "land covers with one of these words are vegetated, and no others"
    return Function(
        "check",
        "Compare the ground with checkpoints, or with ground points that are held out.\nThe figures"
        " are those of check() for a file with the same points.",
        _POINTS,
        (
            _GROUND, *_ATTRIBUTES, *arguments.of_group("checkpoints"),
            Argument.of("vegetated", "words", vegetated), *_LAST,
        ),
        (Accuracy, CheckOptions, GroundClasses),
        _check,
        Check,
    )  # fmt: skip


_CLASSES_KIND = Kind("NDArray[uint8]", "The class of each point, shape (n,).")
_MASK_KIND = partial(Kind, "NDArray[bool_]")
FUNCTIONS: dict[str, Callable[[], Function]] = {
    "above_ground": lambda: _of_tool(
        "above_ground",
        "Classify vegetation (3, 4, 5), buildings (6), bridges (17) and high noise (18).\nOnly"
        " points of class 0 and 1 change.",
        _CLASSES_KIND,
        lambda result: result.classification,
    ),
    "check": _of_check,
    "classify": lambda: _of_classes(
        "classify",
        "Classify ground (2), low noise (7) and bridge decks (17).",
        _CLASSES_KIND,
        _classes,
    ),
    "ground": lambda: _of_classes(
        "ground", "Find the ground points.", _MASK_KIND("Which points are ground."), _ground_of
    ),
    "heights": lambda: _of_tool(
        "heights",
        "Measure the height of each point above the ground.",
        Kind(
            "NDArray[float64]", "The heights in the vertical unit of the CRS; NaN far from ground."
        ),
        lambda result: cast(HeightsOfPoints, result.results[0]).heights,
        HeightOutput("z"),
    ),
    "key_points": lambda: _of_tool(
        "key_points",
        "Find the model key points: the few ground points that a terrain model needs.",
        _MASK_KIND("Which points are model key points."),
        lambda result: np.asarray(result.edits().key_points) == 1,
        KeyPointMark("flag"),
    ),
    "terrain": _of_terrain,
}


@cache
def declared(name: str) -> Function:
    """Return what is declared of a function."""
    return FUNCTIONS[name]()


@cache
def function(name: str) -> Callable[..., Any]:
    """Return a function, given its name."""
    return declared(name).callable(f"{PACKAGE}.arrays")
