"""The functions of `bare_earth.arrays`: points as arrays in, results as arrays out.

They are declared as those for files are, and have the same names and parameters.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from functools import cache, partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Callable, Mapping, Sequence, cast

import numpy as np

from ..classes.ground_classes import GroundClasses
from ..classes.selection import Selection
from ..core.errors import BareEarthError
from ..core.files import Outputs
from ..core.parameters import ParameterSet, parameter_of
from ..core.points import Frame
from ..core.progress import Progress
from ..core.threads import may_use
from ..engine.file_points import TileResult
from ..engine.file_run import OneFile
from ..engine.memory import Resources
from ..engine.options import TileInput
from ..engine.step import Step
from ..las.cloud import PointCloud
from ..las.lasfile import LasFile
from ..tools import map_tool, point_tool
from ..tools.heights import HeightOutput, HeightsOfPoints
from ..tools.key_points import KeyPointMark
from ..tools.rasters.block import BlockRasters
from ..tools.rasters.output import write_rasters
from ..tools.rasters.parameters import SurfaceModel, TerrainModel
from ..tools.rasters.rows import RASTERS
from ..tools.rasters.step import MakeRasters
from . import arguments, tool_commands
from .arguments import Argument, Kind
from .array_arguments import ATTRIBUTES, GROUND, LAST, POINTS
from .array_figures import of_check, of_residuals, of_water
from .array_rasters import of_change, of_contours, of_relief, of_removal
from .blocks import are_blocks, blocks_of
from .functions import PACKAGE, Function, Run
from .given import (
    area_of,
    constraints_of,
    corrections_of,
    is_automatic,
    progress_of,
    target_of,
)
from .points import cloud_of, cloud_with_ground
from .rasters import Collected, Raster
from .tools import arguments_of, input_of

_NO_CONSTRAINTS = dict.fromkeys(
    (argument.name for argument in arguments.of_group("constraints")), None
)


@dataclass(frozen=True)
class ErrorCells(ParameterSet):
    """The cells of the expected error."""

    dtm_cell_size: float = parameter_of(TerrainModel, "dtm_cell_size")


@dataclass(frozen=True)
class ArrayTerrain(TerrainModel):
    """A terrain model with NaN for no data, as arrays have it."""

    raster_nodata: float | None = parameter_of(TerrainModel, "raster_nodata", default=None)


def _found(
    cloud: PointCloud, steps: Sequence[Step], resources: Resources, progress: Progress
) -> TileResult:
    """Return what steps find for points."""
    run = OneFile.on_cloud(steps, cloud, resources, progress.part(0.0, 0.95))
    with may_use(resources.thread_count):
        return run.result(progress.part(0.95, 1.0))


def _classes(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> np.ndarray | None:
    progress = progress_of(values.progress)
    inputs = {"area": area_of(values), "corrections": corrections_of(values)}
    steps = map_tool("classify").steps(sets, inputs, {})
    cloud = cloud_of(values, progress)
    return _found(cloud, steps, Resources.among(sets).now(), progress).classification


def _ground_of(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> np.ndarray:
    ground = GroundClasses.of_selection(Selection.among(sets))
    return np.isin(np.asarray(_classes(values, sets)), ground.ground_classes)


def _area_of(command: str) -> tuple[Argument, ...]:
    (area,) = (declared for declared in map_tool(command).inputs if declared.kind == "area")
    return arguments_of(area)


def _of_classes(name: str, about: str, gives: Kind, run: Run) -> Function:
    return Function(
        name,
        f"{about}\nThe labels are those of classify() on a file with the same points.",
        POINTS,
        (
            *ATTRIBUTES, *_area_of("classify"),
            *arguments.of_group("corrections"), *LAST,
        ),
        (Selection, Resources),
        run,
        gives=gives,
        has_method=True,
    )  # fmt: skip


def _of_tool(
    name: str, gives: Kind, value: Callable[[TileResult], np.ndarray | None], *fixed: ParameterSet
) -> Function:
    """Return the function of a tool for points; it does without the sets that are fixed."""
    tool = point_tool(tool_commands()[name])

    def run(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> np.ndarray | None:
        progress = progress_of(values.progress)
        inputs = {declared.name: input_of(declared, values) for declared in tool.inputs}
        steps = tool.steps([*sets, *fixed], inputs, {})
        cloud = cloud_with_ground(values, GroundClasses.among(sets), progress)
        return value(_found(cloud, steps, Resources.among(sets).now(), progress))

    sets = tuple(kind for kind in tool.sets if kind not in map(type, fixed))
    inputs = [argument for declared in tool.inputs for argument in arguments_of(declared)]
    return Function(
        name, tool.line, POINTS, (GROUND, *ATTRIBUTES, *inputs, *LAST),
        (*sets, Resources), run, gives=gives,
    )  # fmt: skip


@dataclass(frozen=True)
class _RastersInMemory(MakeRasters):
    """Makes rasters without files."""

    def finish(
        self,
        results: Sequence[Mapping[str, Any]],
        frame: Frame,
        outputs: Outputs,
        progress: Progress,
        tiles: Sequence[LasFile] | None = None,
    ) -> Any:
        collected = Collected()
        blocks = [BlockRasters.of(arrays) for arrays in results]
        write_rasters(blocks, frame, self, outputs, progress, write_cells=collected.add)
        return collected.rasters


def _terrain(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> dict[str, Raster]:
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
    sets = [TerrainModel(**vars(own)) if type(own) is ArrayTerrain else own for own in sets]
    inputs = {
        "area": area_of(values), "constraints": constraints_of(values),
        "raster_target": target_of(values),
    }  # fmt: skip
    made: Any = map_tool("terrain").steps(sets, inputs, {name: Path(name) for name in names})[0]
    if are_blocks(values.points):
        return _terrain_of_blocks(values, made)
    step = _RastersInMemory(**{item.name: getattr(made, item.name) for item in fields(made)})
    cloud = cloud_with_ground(values, GroundClasses.among(sets), progress)
    run = OneFile.on_cloud([step], cloud, Resources.among(sets).now(), progress)
    (rasters,) = run.step_summaries
    return {name: rasters[name] for name in names}


def _terrain_of_blocks(values: SimpleNamespace, step: MakeRasters) -> dict[str, Raster]:
    """Return rasters of blocks, which are made when they are needed."""
    from .lazy_rasters import lazy_rasters

    for name in ("y", "z", "ground", "crs", *(argument.name for argument in ATTRIBUTES)):
        if getattr(values, name) is not None:
            raise BareEarthError(f"Blocks have their own {name}: leave the argument {name} out.")
    if step.constraints.any:
        raise BareEarthError(
            "Breaklines, water and areas without ground need the heights of all points: make the"
            " rasters of the files by bare_earth.terrain()."
        )
    return lazy_rasters(values.points, step)


def _of_terrain() -> Function:
    choices = ", ".join(f'"{name}"' for name in RASTERS)
    kinds = " ".join(f"{name}: {row.help}" for name, row in RASTERS.items())
    kind = Kind(f"Literal[{choices}] | Sequence[Literal[{choices}]]", "str or sequence of str")
    return Function(
        "terrain",
        f"{map_tool('terrain').line}\nThe cells are as terrain() writes them for a file with the"
        " same points; cells without data are NaN, or 0 in pictures.",
        POINTS,
        (
            Argument("rasters", kind, f"The rasters to make. {kinds}", ("dtm",)),
            GROUND, *ATTRIBUTES, *arguments.of_group("target"),
            *_area_of("terrain"), *arguments.of_group("constraints"), *LAST,
        ),
        (GroundClasses, ArrayTerrain, SurfaceModel, Resources),
        _terrain,
        gives=Kind("dict[str, Raster]", "The rasters by their names."),
    )  # fmt: skip


def _of_raster(name: str, about: str, gives: str) -> Function:
    """Return the function for one of the rasters, which needs few of the parameters."""

    def run(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> Raster:
        values = SimpleNamespace(**{**_NO_CONSTRAINTS, **vars(values)}, rasters=name)
        cells = TerrainModel(dtm_cell_size=ErrorCells.among(sets).dtm_cell_size, raster_nodata=None)
        return _terrain(values, [*sets, cells])[name]

    return Function(
        name,
        f"{about}\nThe cells are those of the raster that terrain() makes.",
        POINTS,
        (
            GROUND, *ATTRIBUTES, *arguments.of_group("target"), *_area_of("terrain"), *LAST,
        ),
        (GroundClasses, ErrorCells, Resources),
        run,
        gives=Kind("Raster", f"{gives}; NaN where it is not known."),
    )  # fmt: skip


def _of_blocks() -> Function:
    classified = "The points are classified already: nothing is found in them anew."
    extent = "Only blocks that touch this rectangle."
    return Function(
        "blocks",
        "Cut a survey of files into blocks, each of them a task for a cluster.\nOnly headers are"
        " read. A block is called with no arguments, wherever its files are there under the same"
        " names, and returns its points with the classes that classify() gives them. Functions on"
        " arrays take what it returns. terrain() takes all blocks, and gives rasters whose values"
        " are dask arrays. A task works in one thread, and has its points in memory.",
        (replace(arguments.SOURCES, kind=Kind(arguments.SOURCES.kind.type, "paths or addresses")),),
        (
            Argument("classified", Kind("bool", "bool"), classified, False),
            Argument.of("extent", "extent", extent), *arguments.of_group("corrections"),
            arguments.CRS, *arguments.REMOTE, arguments.PROGRESS,
        ),
        (Selection, TileInput),
        blocks_of,
        gives=Kind("list[Block]", "The blocks from south to north, as :class:`Block`."),
        has_method=True,
    )  # fmt: skip


# Parameters that mean nothing for points in memory.
_OF_FILES = ("memory", "remember_classes")
_CLASSES_KIND = Kind("NDArray[uint8]", "The class of each point, shape (n,).")
_MASK_KIND = partial(Kind, "NDArray[bool_]")
FUNCTIONS: dict[str, Callable[[], Function]] = {
    "above_ground": lambda: _of_tool(
        "above_ground", _CLASSES_KIND, lambda result: result.classification
    ),
    "blocks": _of_blocks,
    "check": of_check,
    "classify": lambda: _of_classes(
        "classify",
        "Classify ground (2), low noise (7) and bridge decks (17).",
        _CLASSES_KIND,
        _classes,
    ),
    "change": of_change,
    "contours": of_contours,
    "expected_error": lambda: _of_raster(
        "expected_error",
        "Tell how far the terrain may be off in each cell: 95 of 100 errors are smaller.",
        "The expected error in the unit of the heights",
    ),
    "ground": lambda: _of_classes(
        "ground", "Find the ground points.", _MASK_KIND("Which points are ground."), _ground_of
    ),
    "heights": lambda: _of_tool(
        "heights",
        Kind(
            "NDArray[float64]", "The heights in the vertical unit of the CRS; NaN far from ground."
        ),
        lambda result: cast(HeightsOfPoints, result.results[0]).heights,
        HeightOutput("z"),
    ),
    "key_points": lambda: _of_tool(
        "key_points",
        _MASK_KIND("Which points are model key points."),
        lambda result: np.asarray(result.edits().key_points) == 1,
        KeyPointMark("flag"),
    ),
    "relief": of_relief,
    "remove_off_terrain_objects": of_removal,
    "residuals": of_residuals,
    "terrain": _of_terrain,
    "water": of_water,
}


@cache
def declared(name: str) -> Function:
    """Return what is declared of a function."""
    made = FUNCTIONS[name]()
    return replace(made, without=(*made.without, *_OF_FILES))


@cache
def function(name: str) -> Callable[..., Any]:
    """Return a function, given its name."""
    return declared(name).callable(f"{PACKAGE}.arrays")
