"""What is made of a classified cloud: heights above ground, model key points, terrain models.

File in, file out; every front end takes this path.
"""

from __future__ import annotations

import contextlib
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.files import check_output
from ..core.parameters import ParameterSet, parameter
from ..core.progress import SILENT, Progress
from ..core.threads import may_use
from ..crs.system import Crs, unit_name
from ..grids.model_key_points import ModelKeyPoints, model_key_points
from ..las.cloud import PointCloud, survey_frame
from ..las.edits import Edits
from ..las.opening import LasFile, open_las
from ..las.reading import read_cloud, read_parts
from ..las.records import check_class
from ..las.writing import check_writable, write_changed
from ..products.raster_block import BlockRasters
from ..products.surface_model import SurfaceModel
from ..products.terrain_model import TerrainModel
from ..survey.collection import is_cloud, open_collection
from ..survey.selection import ground_of
from .disk_points import DiskPoints
from .heights import DiskHeights, heights_of
from .memory import Resources
from .output import HEIGHT_DIMENSION, height_changes
from .raster_jobs import make_rasters
from .rasters import (
    RasterFiles,
    RasterPoints,
    RasterRequest,
    RasterSize,
    rasters_of_cloud,
    rasters_of_store,
    write_rasters,
)
from .streaming import fits_in_memory
from .workers import Threads, Workers


@dataclass(frozen=True)
class GroundClasses(ParameterSet):
    """Which points of a classified cloud are ground."""

    ground_classes: tuple[int, ...] = parameter(
        (2,),
        label="Ground classes",
        minimum=0,
        maximum=255,
        help="Classes of the points that are ground. Add 8 where model key points have that class,"
        " and 9 where water counts as ground. Withheld points are left out.",
    )

    def of(self, cloud: PointCloud, also: tuple[int, ...] = ()) -> np.ndarray:
        """Return which points of a cloud are ground; boolean, shape (n,).

        Parameters
        ----------
        cloud : PointCloud
            The points, with their classes.
        also : tuple of int
            Classes that are ground as well.

        Raises
        ------
        BareEarthError
            If none is, or the CRS is geographic.
        """
        cloud.require_projected()
        if not self.ground_classes:
            raise BareEarthError("Choose at least one ground class.")
        classes = (*self.ground_classes, *also)
        ground = ground_of(cloud, classes)
        if not ground.any():
            wanted = " or ".join(str(each) for each in self.ground_classes)
            present = ", ".join(str(each) for each in np.unique(cloud.classification))
            raise BareEarthError(
                f"{cloud.path} has no ground points: none is of class {wanted}, there are the"
                f" classes {present}. Classify its ground first, or choose other ground classes."
            )
        return ground


@dataclass(frozen=True)
class HeightOutput(ParameterSet):
    """Where the heights above ground go."""

    output_as: str = parameter(
        "dimension",
        label="Write the heights as",
        choices={
            "dimension": f"Extra dimension {HEIGHT_DIMENSION}",
            "z": "Z, in place of the elevation",
        },
        help="An extra dimension keeps all else as it is. In place of the elevation the heights"
        " show in programs that know no extra dimensions, and the terrain is flat.",
    )


@dataclass(frozen=True)
class KeyPointMark(ParameterSet):
    """How model key points are marked."""

    mark_as: str = parameter(
        "class",
        label="Mark key points by",
        choices={
            "class": "A class of their own",
            "flag": "The key-point flag of LAS; the class stays",
        },
        help="Up to LAS 1.3, and for most programs, key points are a class. LAS 1.4 has a flag for"
        " them, so that they stay ground.",
    )
    key_class: int = parameter(
        8,
        label="Class of key points",
        minimum=0,
        maximum=255,
        help="The class that key points get. Points that have it already are taken as ground, and"
        " get the first of the ground classes again if they are not needed. Point formats 0 to 5"
        " hold classes up to 31.",
    )


@dataclass(frozen=True)
class HeightSummary:
    """What heights above ground were written.

    Attributes
    ----------
    point_count, ground_count : int
        Points of the file, and those of the ground.
    minimum, maximum : float
        The lowest and the highest height, in the vertical unit of the CRS.
    unit : str
        Name of that unit.
    """

    point_count: int
    ground_count: int
    minimum: float
    maximum: float
    unit: str


@dataclass(frozen=True)
class KeyPointSummary:
    """How many model key points were found.

    Attributes
    ----------
    point_count, ground_count, key_point_count : int
        Points of the file, those of the ground, and those of them that are key points.
    class_counts : dict of int to int
        Points of each class in the output.
    """

    point_count: int
    ground_count: int
    key_point_count: int
    class_counts: dict[int, int] = field(default_factory=dict)


def write_height_above_ground(
    source: Path,
    target: Path,
    ground: GroundClasses = GroundClasses(),
    output: HeightOutput = HeightOutput(),
    resources: Resources = Resources(),
    progress: Progress = SILENT,
) -> HeightSummary:
    """Write a point cloud anew with the height of every point above the ground.

    Parameters
    ----------
    source, target : Path
        The input, and the output (.las, .laz or .copc.laz); equal but for the heights.
    ground : GroundClasses
        Which points are ground.
    output : HeightOutput
        Whether the heights are an extra dimension or replace z; both in the vertical unit.
    resources : Resources
        Threads and memory.
    progress : Progress
        Receives progress and messages.

    Raises
    ------
    BareEarthError
        If the input has no ground or cannot be read, or the output cannot be written.
    Cancelled
        If the user asked to stop; no output is left behind.
    """
    check_output(target, (source,))
    check_writable(target)
    las, resources = open_las(source), resources.now()
    if fits_in_memory(las.count, resources):
        cloud = read_cloud(las, progress.part(0.0, 0.15))
        is_ground = ground.of(cloud)
        heights = heights_of(cloud, is_ground, resources, progress.part(0.15, 0.8))
        ground_count = int(np.count_nonzero(is_ground))
    else:
        cloud, heights, ground_count = _heights_from_disk(las, target, ground, resources, progress)
    changes = height_changes(cloud, heights, output.output_as == "z")
    write_changed(cloud.file, target, changes, progress.part(0.8, 1.0))
    return HeightSummary(
        point_count=len(heights),
        ground_count=ground_count,
        minimum=float(np.nanmin(heights)),
        maximum=float(np.nanmax(heights)),
        unit=unit_name(cloud.crs.vertical_unit),
    )


def _heights_from_disk(
    las: LasFile,
    target: Path,
    ground: GroundClasses,
    resources: Resources,
    progress: Progress,
) -> tuple[PointCloud, np.ndarray, int]:
    """Measure the heights of a file that does not fit into memory.

    Returns
    -------
    cloud : PointCloud
        Some of its points.
    heights : numpy.ndarray of float64, shape (n,)
        In its vertical unit.
    ground_count : int
        Points of the ground.
    """
    lowest, ground_count = [], 0
    with DiskHeights(target) as heights:
        for part in read_parts(las, progress.part(0.0, 0.3)):
            part.require_projected()
            is_ground = ground_of(part, ground.ground_classes)
            ground_count += int(np.count_nonzero(is_ground))
            heights.append(part, is_ground)
            lowest.append(part.lowest)
        if not ground_count:
            ground.of(part)
        first = tuple(int(each) for each in np.min(lowest, axis=0))
        parts, rest = read_parts(las, SILENT), progress.part(0.3, 0.8)
        return part, heights.measured(first, parts, np.float64, resources, rest), ground_count


def write_key_points(
    source: Path,
    target: Path,
    parameters: ModelKeyPoints = ModelKeyPoints(),
    ground: GroundClasses = GroundClasses(),
    mark: KeyPointMark = KeyPointMark(),
    progress: Progress = SILENT,
) -> KeyPointSummary:
    """Write a point cloud anew with its model key points marked.

    Parameters
    ----------
    source, target : Path
        The input, and the output (.las, .laz or .copc.laz); equal but for class or flag.
    parameters : ModelKeyPoints
        How closely they follow the ground.
    ground : GroundClasses
        Which points are ground.
    mark : KeyPointMark
        Whether they get a class or a flag.
    progress : Progress
        Receives progress and messages.

    Raises
    ------
    BareEarthError
        If the input has no ground or cannot be read, or the output cannot be written.
    Cancelled
        If the user asked to stop; no output is left behind.
    """
    check_output(target, (source,))
    check_writable(target)
    cloud = read_cloud(source, progress.part(0.0, 0.15))
    by_class = mark.mark_as == "class"
    if by_class:
        check_class(cloud.path, cloud.point_format, mark.key_class, "the key points")
    old = cloud.classification == mark.key_class
    is_ground = ground.of(cloud, (mark.key_class,) if by_class else ())
    points = cloud.points(is_ground)
    keys = np.zeros(cloud.count, dtype=bool)
    keys[is_ground] = model_key_points(points, parameters, progress.part(0.15, 0.85))
    classes = cloud.classification.copy()
    if by_class:
        classes[is_ground & old] = ground.ground_classes[0]
        classes[keys] = mark.key_class
        changes = Edits(classification=classes)
    else:
        flags = np.where(is_ground, 0, -1).astype(np.int8)
        flags[keys] = 1
        changes = Edits(key_points=flags)
    write_changed(cloud.file, target, changes, progress.part(0.85, 1.0))
    counts = np.unique(classes, return_counts=True)
    return KeyPointSummary(
        point_count=cloud.count,
        ground_count=points.count,
        key_point_count=int(np.count_nonzero(keys)),
        class_counts={int(value): int(count) for value, count in zip(*counts)},
    )


def write_terrain_models(
    sources: Path | Sequence[Path],
    files: RasterFiles,
    ground: GroundClasses = GroundClasses(),
    model: TerrainModel = TerrainModel(),
    surface: SurfaceModel = SurfaceModel(),
    resources: Resources = Resources(),
    progress: Progress = SILENT,
    workers: Workers | None = None,
) -> RasterSize:
    """Write rasters of the terrain and of what stands on it; all of them or none.

    Parameters
    ----------
    sources : Path or sequence of Path
        Classified .las, .laz or .copc.laz files, folders of them, virtual point clouds and lists:
        all files together are one survey.
    files : RasterFiles
        What to write.
    ground : GroundClasses
        Which points are ground.
    model, surface : TerrainModel, SurfaceModel
        Cell size, light, gaps, and which points make the surface.
    resources : Resources
        Threads and memory.
    progress : Progress
        Receives progress and messages.
    workers : Workers, optional
        Who makes the rasters of many files; threads of this process if not given.

    Raises
    ------
    BareEarthError
        If no raster is wanted, the input has no ground or cannot be read, or a raster cannot be
        written.
    Cancelled
        If the user asked to stop; no output is left behind.
    """
    sources = [sources] if isinstance(sources, (str, Path)) else sources
    sources = [Path(each) for each in sources]
    request = RasterRequest(files, model, surface)
    if not files.wanted:
        raise BareEarthError("Name at least one raster to make.")
    if not ground.ground_classes:
        raise BareEarthError("Choose at least one ground class.")
    files.check(tuple(sources))
    if len(sources) > 1 or sources[0].is_dir() or not is_cloud(sources[0]):
        return _of_survey(sources, request, ground, workers or Threads(resources), progress)
    resources = resources.now()
    with may_use(resources.thread_count):
        if fits_in_memory(open_las(sources[0]).count, resources):
            cloud = read_cloud(sources[0], progress.part(0.0, 0.2))
            marks, crs = _marks(cloud, request, ground), cloud.crs
            part = progress.part(0.2, 0.8)
            made = rasters_of_cloud(cloud, marks, request, resources, part)
        else:
            made, crs = _from_disk(sources[0], request, ground, resources, progress)
    with contextlib.ExitStack() as outputs:
        return write_rasters(made, survey_frame(crs), request, outputs, progress.part(0.8, 1.0))


def _from_disk(
    source: Path,
    request: RasterRequest,
    ground: GroundClasses,
    resources: Resources,
    progress: Progress,
) -> tuple[list[BlockRasters], Crs]:
    """Return the rasters of the blocks of a file that does not fit into memory, and its CRS."""
    target = next(iter(request.files.wanted.values()))
    points, lowest = RasterPoints(ground.ground_classes), []
    with DiskPoints(target, request.blocks.leaf_side) as spill:
        for part in read_parts(source, progress.part(0.0, 0.4)):
            part.require_projected()
            spill.append(part, *points.of(part, request))
            lowest.append(part.lowest)
        spill.finish(tuple(int(each) for each in np.min(lowest, axis=0)))
        made = rasters_of_store(spill, request, resources, progress.part(0.4, 0.8))
        return made, spill.cloud.crs


def _of_survey(
    sources: Sequence[Path],
    request: RasterRequest,
    ground: GroundClasses,
    workers: Workers,
    progress: Progress,
) -> RasterSize:
    """Write the rasters of many files."""
    collection = open_collection(sources, progress=progress.part(0.0, 0.05))
    request.files.check(tuple(each.path for each in collection.tiles))
    for each in collection.broken:
        progress.warning(f"{each.path} is left out. {each.reason}")
    beside = next(iter(request.files.wanted.values())).parent
    with tempfile.TemporaryDirectory(prefix=".bare-earth-", dir=beside) as folder:
        points = RasterPoints(ground.ground_classes)
        return make_rasters(
            collection, Path(folder), request, points, workers, progress.part(0.05, 1.0)
        )


def _marks(
    cloud: PointCloud, request: RasterRequest, ground: GroundClasses
) -> tuple[np.ndarray, ...]:
    """Return what rasters are made of; refuse a cloud that has none of it."""
    if request.needs_terrain:
        ground.of(cloud)
    cloud.require_projected()
    marks = RasterPoints(ground.ground_classes).of(cloud, request)
    if request.needs_surface and not marks[2].any():
        raise BareEarthError(
            f"{cloud.path} has no first returns to make a surface of. Take all returns instead."
        )
    return marks
