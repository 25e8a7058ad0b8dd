"""Classification, heights, key points and rasters of one file."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterable

import numpy as np

from ..core.files import check_distinct
from ..core.parameters import ParameterSet
from ..core.progress import SILENT, Progress
from ..core.threads import import_early, may_use
from ..crs.measurable import require_measurable
from ..las.cloud import PointCloud, survey_frame
from ..las.crs_records import read_crs
from ..las.extrabytes import remembers
from ..las.lasfile import LasFile
from ..las.opening import open_las
from ..las.writing import check_cloud, layers_kept, write_changed
from ..rasters.writing import check_raster_output, replacing_raster
from ..survey.area import Area
from ..survey.corrections import NO_CORRECTIONS, Corrections
from ..survey.selection import Selection
from .file_points import FilePoints
from .labelling import ClassifiedPoints, LabelGround
from .memory import Resources
from .rasters import MakeRasters, RasterSize, write_rasters
from .requests import (
    AboveGroundRequest,
    ClassifyRequest,
    HeightRequest,
    KeyPointRequest,
    TerrainRequest,
    WaterClassRequest,
)
from .steps import PointStep, Step, located


@dataclass(frozen=True)
class Summary:
    """The result of a classification.

    Attributes
    ----------
    point_count : int
        Points in the file.
    area_count : int
        Points in the area; all points, if there is no area.
    selected_count : int
        Points in the area that took part in the filter.
    ground_count : int
        Points of the target class in the output, in the area and outside.
    area_ground_count : int
        Points of the target class in the area.
    class_counts : dict of int to int
        Points of each class in the output, in the area and outside.
    """

    point_count: int
    area_count: int
    selected_count: int
    ground_count: int
    area_ground_count: int
    class_counts: dict[int, int] = field(default_factory=dict)


def classify_cloud(
    cloud: PointCloud,
    parameters: ParameterSet,
    selection: Selection = Selection(),
    progress: Progress = SILENT,
    area: Area | None = None,
    resources: Resources = Resources(),
    corrections: Corrections = NO_CORRECTIONS,
) -> tuple[np.ndarray, np.ndarray]:
    """Classify the points of a cloud in memory.

    Parameters
    ----------
    cloud : PointCloud
        The points, with their present classes.
    parameters : ParameterSet
        The parameters of one method. Their type chooses the method.
    selection : Selection
        Which points take part, and what their classes become.
    progress : Progress
        Receives progress and messages.
    area : Area, optional
        Points outside keep their class; those near it are still context for the method.
    resources : Resources
        How many threads to use, and how much memory.
    corrections : Corrections
        Polygons in which the class is known.

    Returns
    -------
    classification : numpy.ndarray of uint8, shape (n,)
        The new class of every point, in file order.
    selected : numpy.ndarray of bool, shape (n,)
        Which points in the area took part.

    Raises
    ------
    BareEarthError
        If no point is left to classify, or the CRS is geographic.
    Cancelled
        If the user asked to stop.
    """
    step = LabelGround(parameters, selection, area, corrections=corrections)
    with may_use(resources.thread_count):
        points = FilePoints(cloud, resources)
        (step,) = located([step], points.place, progress)
        result, _ = points.find(step, step.counts(), progress)
        result.tell(progress)
        inside, selected, _ = step.chooser.choose(cloud, step.counts())
    return result.classification, selected & inside


def classify_file(
    source: Path,
    target: Path,
    request: ClassifyRequest = ClassifyRequest(),
    progress: Progress = SILENT,
) -> Summary:
    """Classify the ground points of a LAS, LAZ or COPC file, and write it with the new classes.

    Parameters
    ----------
    source, target : Path
        The input, and the output (.las, .laz or .copc.laz). Only the classes change, and what
        else the request asks for.
    request : ClassifyRequest
        What to do.
    progress : Progress
        Receives progress and messages.

    Raises
    ------
    BareEarthError
        If the input cannot be read or an output cannot be written.
    Cancelled
        If the user asked to stop; no output is left behind.
    """
    las, resources = _checked(source, target, request.resources, request.stated)
    request.rasters.check((source, target))
    if request.explain is not None:
        check_raster_output(request.explain, (source, target))
        check_distinct([*request.rasters.wanted.values(), request.explain])
    step, products = request.step, _products(request, las, progress)
    counts = step.counts()
    # Shares of the progress bar.
    raster_count = len(request.rasters.wanted)
    made_too = 3.0 * bool(raster_count) + raster_count, 3.0 * ("heights" in products)
    made_too = *made_too, 3.0 * ("above" in products)
    first, finding, drawing, measuring, looking, last = progress.shares(1.5, 5.0, *made_too, 0.8)
    changes_more = request.output.changes_points or request.selection.remember_classes
    is_copied = not (changes_more or remembers(las)) and layers_kept(las, target) is not None
    import_early("scipy.ndimage", "scipy.spatial", "scipy.sparse.csgraph")
    with contextlib.ExitStack() as outputs:
        outputs.enter_context(may_use(resources.thread_count))
        points = FilePoints.opened(las, target, resources, not is_copied, first)
        outputs.enter_context(points)
        step, *more = located([step, *products.values()], points.place, progress)
        products = dict(zip(products, more))
        result, stores = points.find(step, counts, finding, list(products.values()))
        result.tell(progress)
        if request.explain is not None and step.explanation is not None:
            explained = outputs.enter_context(replacing_raster(request.explain))
            frame = survey_frame(points.cloud.crs)
            step.explanation.write(explained, frame, progress)
        waiting, heights = dict(zip(products, stores)), None
        # All outputs or none: the rasters get their names after the cloud is written.
        if "rasters" in products:
            parts = (result.part(*each) for each in points.parts())
            _draw(products["rasters"], points, parts, waiting["rasters"], outputs, drawing)
        if "heights" in products:
            heights = _worked(points, products["heights"], waiting["heights"], measuring).heights
        if "above" in products:
            products["above"].work(waiting["above"], points.resources, looking)
            for each in points.values(waiting["above"]):
                result.refine(*each)
        edits = result.edits(points.cloud, progress, heights)
        last = points.sparing(last)
        write_changed(las, target, edits, last, points.cloud, points.memory_left)
    return _summary(result, counts, request)


def _products(request: ClassifyRequest, las: LasFile, progress: Progress) -> dict[str, Step]:
    """Return the steps that use the classified points of a file."""
    products: dict[str, Step] = {}
    if request.rasters.wanted:
        products["rasters"] = _placed(request.raster_step, las, progress)
    if request.output.height_above_ground:
        products["heights"] = request.height_step
    if request.above_ground.wanted:
        products["above"] = request.above_ground_step
    return products


def _placed(step: MakeRasters, las: LasFile, progress: Progress) -> MakeRasters:
    """Return a step that knows where its cells lie, given the file of the points."""
    crs, box = read_crs(las), las.outer_box if las.states_extent else None
    require_measurable(las.path, crs, box)
    return step.placed(crs, box, progress)


def _draw(
    step: MakeRasters,
    points: FilePoints,
    parts: Iterable[PointCloud],
    store: Any,
    outputs: contextlib.ExitStack,
    progress: Progress,
) -> RasterSize:
    """Make the rasters of the points of a store; `parts` are all points, with their classes."""
    drawing, writing = progress.shares(4.0, 1.0)
    frame = survey_frame(points.cloud.crs, step.origin)
    step = step.seeing(parts, frame, progress)
    made = step.work(store, points.resources, drawing)
    return write_rasters(made, frame, step, outputs, writing)


def _worked(points: FilePoints, step: PointStep, store: Any, progress: Progress) -> Any:
    """Run a further step on the points of a store, and return its result."""
    step.work(store, points.resources, progress.part(0.0, 0.9))
    result = step.result(points.path, points.allocate)
    for where, part, values in points.values(store, progress.part(0.9, 1.0)):
        result.add(where, part, values)
    return result


def _summary(result: ClassifiedPoints, counts: Any, request: ClassifyRequest) -> Summary:
    by_class, to_class = result.class_counts, request.selection.to_class
    written = [to_class] if request.output.ground_only else np.flatnonzero(by_class)
    return Summary(
        point_count=counts.points,
        area_count=counts.inside,
        selected_count=counts.wanted,
        ground_count=int(by_class[to_class]),
        area_ground_count=result.area_ground_count,
        class_counts={int(value): int(by_class[value]) for value in written},
    )


def write_points(
    source: Path,
    target: Path,
    request: HeightRequest | KeyPointRequest | AboveGroundRequest | WaterClassRequest,
    progress: Progress = SILENT,
) -> Any:
    """Write a file with the values that a step finds for its points, such as heights.

    Parameters
    ----------
    source, target : Path
        The input, and the output (.las, .laz or .copc.laz).
    request : HeightRequest, KeyPointRequest, AboveGroundRequest or WaterClassRequest
        What to find.
    progress : Progress
        Receives progress and messages.

    Returns
    -------
    object
        The summary of the step.

    Raises
    ------
    BareEarthError
        If the input is unsuitable or cannot be read, or the output cannot be written.
    Cancelled
        If the user asked to stop; no output is left behind.
    """
    las, resources = _checked(source, target, request.resources, request.stated)
    with may_use(resources.thread_count):
        first = progress.part(0.0, 0.1)
        with FilePoints.opened(las, target, resources, progress=first) as points:
            (step,) = located([request.step], points.place, progress)
            result, _ = points.find(step, step.counts(), progress.part(0.1, 0.9))
            edits = result.edits(points.cloud, progress)
            last = points.sparing(progress.part(0.9, 1.0))
            write_changed(las, target, edits, last, points.cloud, points.memory_left)
    return result.summary(target.name)


def rasters_of_file(
    source: Path, request: TerrainRequest, progress: Progress = SILENT
) -> RasterSize:
    """Write rasters of a classified file; all of them or none.

    Parameters
    ----------
    source : Path
        The file.
    request : TerrainRequest
        The rasters to make.
    progress : Progress
        Receives progress and messages.

    Raises
    ------
    BareEarthError
        If the input has no ground or cannot be read, or a raster cannot be written.
    Cancelled
        If the user asked to stop; no output is left behind.
    """
    resources = request.resources.now()
    beside = next(iter(request.rasters.wanted.values()))
    with may_use(resources.thread_count), contextlib.ExitStack() as outputs:
        las, first = open_las(source, request.stated), progress.part(0.0, 0.1)
        step = _placed(request.raster_step, las, progress)
        points = FilePoints.opened(las, beside, resources, False, first)
        outputs.enter_context(points)
        (step,) = located([step], points.place, progress)
        # Only constraints need the points once more.
        parts = points.parts(progress.part(0.1, 0.13), is_last=not step.constraints.any)
        (store,) = points.gathered([(step, step.counts())], parts, progress.part(0.13, 0.15))
        parts = (part for _, part in points.parts())
        return _draw(step, points, parts, store, outputs, progress.part(0.15, 1.0))


def _checked(
    source: Path, target: Path, resources: Resources, stated: str | None
) -> tuple[LasFile, Resources]:
    """Refuse an output that cannot be written. Return the opened input and the resources."""
    check_cloud(source, target)
    return open_las(source, stated), resources.now()
