"""From a point cloud file to a classified one: the one path that every front end takes."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..core.errors import BareEarthError
from ..core.files import check_output
from ..core.parameters import ParameterSet
from ..core.progress import SILENT, Progress
from ..core.threads import may_use
from ..filters import method_of
from ..las.cloud import PointCloud, survey_frame
from ..las.edits import Edits
from ..las.opening import open_las
from ..las.reading import read_cloud
from ..las.writing import check_writable, is_copc, layers_kept, write_changed
from ..products.terrain_model import TerrainModel
from ..survey.area import Area
from ..survey.scope import Scope
from ..survey.selection import Selection
from .ground import blocks_of, label_ground
from .heights import heights_of
from .memory import Resources
from .memory_points import MemoryPoints, SurveyFile
from .output import Output
from .rasters import RasterFiles, RasterRequest, rasters_of_cloud, write_rasters
from .streaming import ClassifiedPoints, classify_parts, fits_in_memory

# Bytes of a point, as the file has it, up to which all of it is kept: reading it again for what
# does not change would take as long as the filter.
_LONGEST_KEPT = 48


@dataclass(frozen=True)
class Summary:
    """What a classification did.

    Attributes
    ----------
    point_count : int
        Points in the file.
    area_count : int
        Points in the area that was to be classified: all, if none was given.
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


def classify(
    cloud: PointCloud,
    parameters: ParameterSet,
    selection: Selection = Selection(),
    progress: Progress = SILENT,
    area: Area | None = None,
    resources: Resources = Resources(),
) -> tuple[np.ndarray, np.ndarray]:
    """Classify the points of a cloud in memory.

    Parameters
    ----------
    cloud : PointCloud
        The points, with their present classes.
    parameters : ParameterSet
        The parameters of one method; their type chooses the method.
    selection : Selection
        Which points take part, and what their classes become.
    progress : Progress
        Receives progress and messages.
    area : Area, optional
        Points outside keep their class; those near it are still context for the method.
    resources : Resources
        How many threads to use, and how much memory.

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
    scope = Scope(selection, area, method_of(parameters).reach(parameters))
    with may_use(resources.thread_count):
        outcome, inside, selected = _in_memory(cloud, parameters, scope, resources, progress)
    return outcome.classification, selected & inside


def _in_memory(
    cloud: PointCloud,
    parameters: ParameterSet,
    scope: Scope,
    resources: Resources,
    progress: Progress,
) -> tuple[ClassifiedPoints, np.ndarray, np.ndarray]:
    """Classify points in memory; return which lie in the area, and which take part, as well."""
    selection = scope.selection
    inside, selected = scope.choose_all(cloud, progress.part(0.0, 0.1))
    scope.tell(progress)
    blocks = blocks_of(parameters)
    known = selection.known_ground(cloud, selected) if selection.seed_classes else None
    part = SurveyFile(cloud, selected, known, inside)
    store = MemoryPoints([part], survey_frame(cloud.crs), blocks, progress.part(0.1, 0.2))
    part = progress.part(0.2, 0.95)
    label_ground(store, parameters, blocks, selection.special, resources, part)
    outcome = ClassifiedPoints(cloud, np.empty(cloud.count, dtype=np.uint8))
    for where, some in cloud.parts():
        outcome.add(where.start, some, store.labels[0][where], inside[where], selection)
        progress(0.95 + 0.05 * where.stop / cloud.count)
    scope.tell_of_special(outcome.area_low_count, outcome.area_deck_count, progress)
    return outcome, inside, selected


def classify_file(
    source: Path,
    target: Path,
    parameters: ParameterSet,
    selection: Selection = Selection(),
    terrain: TerrainModel = TerrainModel(),
    dtm: Path | None = None,
    hillshade: Path | None = None,
    progress: Progress = SILENT,
    area: Area | None = None,
    resources: Resources = Resources(),
    output: Output = Output(),
) -> Summary:
    """Classify the ground points of a LAS, LAZ or COPC file and write the file anew.

    Parameters
    ----------
    source, target : Path
        The input, and the output (.las, .laz or .copc.laz). The output equals the input but for
        the classification, and what `output` asks for.
    parameters, selection, progress, area, resources
        As for `classify`.
    terrain : TerrainModel
        How to make the terrain model.
    dtm, hillshade : Path, optional
        GeoTIFF files of the terrain model to write as well.
    output : Output
        Which points are written, and whether with their heights above ground.

    Raises
    ------
    BareEarthError
        If the input cannot be read or an output cannot be written.
    Cancelled
        If the user asked to stop; no output is left behind.
    """
    check_output(target, (source,))
    check_writable(target)
    request = RasterRequest(RasterFiles(dtm=dtm, hillshade=hillshade), terrain)
    request.files.check((source, target))
    resources = resources.now()
    scope = Scope(selection, area, method_of(parameters).reach(parameters))
    opened = open_las(source)
    with may_use(resources.thread_count):
        outcome = _outcome(source, target, parameters, scope, resources, request, output, progress)
    with contextlib.ExitStack() as outputs:
        # All outputs or none: the rasters get their names after the cloud is written.
        if outcome.rasters is not None:
            frame = survey_frame(outcome.cloud.crs)
            write_rasters(outcome.rasters, frame, request, outputs, progress.part(0.75, 0.85))
        classes = outcome.classification
        changes = Edits(classification=classes)
        if output.changes_points:
            ground, heights = classes == selection.to_class, outcome.heights
            if output.height_above_ground and heights is None:
                # Withheld points are no ground for heights, as in those of a classified file.
                known, part = ground & ~outcome.cloud.withheld, progress.part(0.85, 0.9)
                heights = heights_of(outcome.cloud, known, resources, part)
            changes = output.changes(outcome.cloud, classes, ground, heights, progress)
        write_changed(opened, target, changes, progress.part(0.9, 1.0), outcome.cloud)
    counts = outcome.class_counts
    written = [selection.to_class] if output.ground_only else np.flatnonzero(counts)
    return Summary(
        point_count=scope.tally.points,
        area_count=scope.inside_count,
        selected_count=scope.wanted_count,
        ground_count=int(counts[selection.to_class]),
        area_ground_count=outcome.area_ground_count,
        class_counts={int(value): int(counts[value]) for value in written},
    )


def _outcome(
    source: Path,
    target: Path,
    parameters: ParameterSet,
    scope: Scope,
    resources: Resources,
    request: RasterRequest,
    output: Output,
    progress: Progress,
) -> ClassifiedPoints:
    """Classify the points of a file, in memory if they fit."""
    layout = open_las(Path(source))
    count, length = layout.count, layout.record_length
    is_copied = not output.changes_points and layers_kept(layout, Path(target)) is not None
    if fits_in_memory(count, resources):
        keep = length <= _LONGEST_KEPT and fits_in_memory(count, resources, length)
        keep = keep and not is_copied
        cloud = read_cloud(source, progress.part(0.0, 0.2), keep_records=keep)
        part = progress.part(0.2, 0.65)
        outcome, *_ = _in_memory(cloud, parameters, scope, resources, part)
        if request.files.wanted:
            ground = (outcome.classification == scope.selection.to_class) & ~cloud.withheld
            marks, part = (ground, ground, np.zeros_like(ground)), progress.part(0.65, 0.75)
            outcome.rasters = rasters_of_cloud(cloud, marks, request, resources, part)
        return outcome
    _check_parts_do(target, is_copied, count, progress)
    part = progress.part(0.0, 0.75)
    heights = output.height_above_ground
    return classify_parts(source, target, parameters, scope, resources, request, heights, part)


def _check_parts_do(target: Path, is_copied: bool, count: int, progress: Progress) -> None:
    """Refuse an output that needs all points in memory where they do not fit; tell of the way."""
    if is_copc(target) and not is_copied:
        raise BareEarthError(
            f"The {count:,} points do not fit into the memory that may be used, which making a COPC"
            " file needs. Name the output .laz, or give more memory."
        )
    progress.info(
        f"The {count:,} points do not fit into the memory that may be used: they are read twice,"
        " and wait in a temporary file in the folder of the output meanwhile."
    )
