"""From a point cloud file to a classified one: the one path that every front end takes."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import NamedTuple

import numpy as np

from .errors import BareEarthError
from .files import check_output, replacing
from .filters import method_of
from .output import Output
from .parameters import ParameterSet
from .pointcloud.area import Area
from .pointcloud.cloud import PointCloud
from .pointcloud.reading import read_cloud
from .pointcloud.selection import Selection
from .pointcloud.writing import check_writable, write_changed
from .progress import SILENT, Progress
from .terrain.model import TerrainModel, write_terrain_model
from .terrain.raster import check_raster_output
from .tiling.blocks import GROUND, LOW
from .tiling.cloudstore import CloudStore, Part
from .tiling.ground import blocks_of, label_ground
from .tiling.memory import Resources


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
    result = _classify(cloud, parameters, selection, progress, area, resources)
    return result.classification, result.selected


class _Result(NamedTuple):
    """What `_classify` returns: as `classify`, and which points lie in the area."""

    classification: np.ndarray
    selected: np.ndarray
    inside: np.ndarray


def _classify(
    cloud: PointCloud,
    parameters: ParameterSet,
    selection: Selection,
    progress: Progress,
    area: Area | None,
    resources: Resources,
) -> _Result:
    cloud.require_projected()
    inside, within = _extent_of(cloud, parameters, area, progress.part(0.0, 0.05))
    selected = selection.select(cloud, progress, within)
    if not (inside & selected).any():
        raise BareEarthError(
            f"None of the {np.count_nonzero(inside):,} points in the area takes part. Choose"
            " another area, or other returns or classes."
        )
    known = selection.known_ground(cloud, selected)
    blocks = blocks_of(parameters)
    wanted = None if area is None else inside
    store = CloudStore([Part(cloud, selected, known, wanted)], cloud.frame, blocks)
    progress(0.1)
    depth = selection.low_noise_depth if selection.low_noise_class else None
    label_ground(store, parameters, blocks, depth, resources, progress.part(0.1, 1.0))
    ground, low = store.labels[0] == GROUND, None
    if depth is not None:
        low = store.labels[0] == LOW
        count = np.count_nonzero(low & inside)
        progress.info(f"{count:,} points lie more than {depth:g} m below the ground.")
    classification = selection.classes(cloud, ground, low, inside)
    return _Result(classification, selected & inside, inside)


def _extent_of(
    cloud: PointCloud, parameters: ParameterSet, area: Area | None, progress: Progress
) -> tuple[np.ndarray, np.ndarray | None]:
    """Return which points lie in an area, and which in it or near enough to be context."""
    if area is None:
        return np.ones(cloud.count, dtype=bool), None
    inside = area.of(cloud, progress.part(0.0, 0.8))
    count = int(np.count_nonzero(inside))
    if not count:
        wanted, there = _in_words(area.bounds), _in_words(_bounds(cloud))
        raise BareEarthError(
            f"No point of {cloud.path} lies in the area ({wanted}): the points have {there}. Give"
            " the area in the CRS of the points."
        )
    progress.info(f"{count:,} of {cloud.count:,} points lie in the area.")
    metres = method_of(parameters).reach(parameters)
    near = Area(area.buffered_box(metres / cloud.crs.horizontal_unit))
    return inside, near.of(cloud, progress.part(0.8, 1.0))


def _bounds(cloud: PointCloud) -> tuple[float, ...]:
    return tuple(
        float(pick(each) * scale + offset)
        for pick in (np.min, np.max)
        for each, scale, offset in zip((cloud.x, cloud.y), cloud.scale, cloud.offset)
    )


def _in_words(bounds: tuple[float, ...]) -> str:
    west, south, east, north = bounds
    return f"x {west:.10g} to {east:.10g}, y {south:.10g} to {north:.10g}"


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
    for raster in filter(None, (dtm, hillshade)):
        check_raster_output(raster, (source, target))
    cloud = read_cloud(source, progress.part(0.0, 0.15))
    classification, selected, inside = _classify(
        cloud, parameters, selection, progress.part(0.15, 0.7), area, resources
    )
    ground = classification == selection.to_class
    with contextlib.ExitStack() as outputs:
        # All outputs or none: the rasters get their names after the cloud is written.
        rasters = [
            raster and outputs.enter_context(replacing(raster)) for raster in (dtm, hillshade)
        ]
        if any(rasters):
            write_terrain_model(
                cloud.points(ground), cloud.frame, terrain, *rasters, progress.part(0.7, 0.85)
            )
        changes = output.changes(cloud, classification, ground, progress.part(0.85, 0.9))
        write_changed(source, target, changes, progress.part(0.9, 1.0))
    written = classification[ground] if output.ground_only else classification
    values, counts = np.unique(written, return_counts=True)
    return Summary(
        point_count=cloud.count,
        area_count=int(np.count_nonzero(inside)),
        selected_count=int(np.count_nonzero(selected)),
        ground_count=int(np.count_nonzero(ground)),
        area_ground_count=int(np.count_nonzero(ground & inside)),
        class_counts={int(value): int(count) for value, count in zip(values, counts)},
    )
