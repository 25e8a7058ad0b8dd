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
from .parameters import ParameterSet
from .pointcloud.area import Area
from .pointcloud.cloud import PointCloud
from .pointcloud.reading import read_cloud
from .pointcloud.selection import Selection
from .pointcloud.writing import check_writable, write_classified
from .points import Points
from .progress import SILENT, Progress
from .terrain.below_ground import below_ground
from .terrain.model import TerrainModel, write_terrain_model
from .terrain.raster import check_raster_output

# Metres round an area from which points are taken as context: no less than these, and so many
# times the largest length among the parameters of the method.
_CONTEXT, _CONTEXT_LENGTHS = 100.0, 3.0


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
    result = _classify(cloud, parameters, selection, progress, area)
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
) -> _Result:
    cloud.require_projected()
    inside, within = _extent_of(cloud, parameters, area, progress.part(0.0, 0.05))
    selected = selection.select(cloud, progress, within)
    if not (inside & selected).any():
        raise BareEarthError(
            f"None of the {np.count_nonzero(inside):,} points in the area takes part. Choose"
            " another area, or other returns or classes."
        )
    points = cloud.points(selected)
    progress(0.1)
    known = selection.known_ground(cloud, selected)[selected]
    end = 0.9 if selection.low_noise_class else 1.0
    found = _ground_of(points, parameters, known, progress.part(0.1, end))
    ground, low = np.zeros(cloud.count, dtype=bool), None
    ground[selected] = found
    if selection.low_noise_class:
        low = np.zeros(cloud.count, dtype=bool)
        depth = selection.low_noise_depth
        low[selected] = below_ground(points, found, depth, progress.part(end, 1.0))
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
    lengths = [
        getattr(parameters, each.name) or 0.0
        for each in parameters.declarations()
        if each.unit == "m" and each.kind == "number"
    ]
    metres = max(_CONTEXT, _CONTEXT_LENGTHS * max(lengths, default=0.0))
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


def _ground_of(
    points: Points, parameters: ParameterSet, known: np.ndarray, progress: Progress
) -> np.ndarray:
    """Return which points the method takes for ground, and those that are known to be."""
    method = method_of(parameters)
    if not known.any():
        return method.classify(points, parameters, progress)
    if method.takes_known_ground:
        return method.classify(points, parameters, progress, known_ground=known) | known
    progress.info(f"{method.label} does not start from known ground: it is only kept.")
    return method.classify(points, parameters, progress) | known


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
) -> Summary:
    """Classify the ground points of a LAS, LAZ or COPC file and write the file anew.

    Parameters
    ----------
    source, target : Path
        The input, and the output (.las, .laz or .copc.laz). The output equals the input but for
        the classification.
    parameters, selection, progress, area
        As for `classify`.
    terrain : TerrainModel
        How to make the terrain model.
    dtm, hillshade : Path, optional
        GeoTIFF files of the terrain model to write as well.

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
        cloud, parameters, selection, progress.part(0.15, 0.7), area
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
        write_classified(source, target, classification, progress.part(0.85, 1.0))
    values, counts = np.unique(classification, return_counts=True)
    return Summary(
        point_count=cloud.count,
        area_count=int(np.count_nonzero(inside)),
        selected_count=int(np.count_nonzero(selected)),
        ground_count=int(np.count_nonzero(ground)),
        area_ground_count=int(np.count_nonzero(ground & inside)),
        class_counts={int(value): int(count) for value, count in zip(values, counts)},
    )
