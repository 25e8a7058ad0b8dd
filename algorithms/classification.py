"""From a point cloud file to a classified one: the one path that every front end takes."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .files import check_output, replacing
from .filters import method_of
from .parameters import ParameterSet
from .pointcloud.cloud import PointCloud
from .pointcloud.reading import read_cloud
from .pointcloud.selection import Selection
from .pointcloud.writing import check_writable, write_classified
from .progress import SILENT, Progress
from .terrain.model import TerrainModel, write_terrain_model
from .terrain.raster import check_raster_output


@dataclass(frozen=True)
class Summary:
    """What a classification did.

    Attributes
    ----------
    point_count : int
        Points in the file.
    selected_count : int
        Points that took part in the filter.
    ground_count : int
        Points of the target class in the output.
    class_counts : dict of int to int
        Points of each class in the output.
    """

    point_count: int
    selected_count: int
    ground_count: int
    class_counts: dict[int, int] = field(default_factory=dict)


def classify(
    cloud: PointCloud,
    parameters: ParameterSet,
    selection: Selection = Selection(),
    progress: Progress = SILENT,
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

    Returns
    -------
    classification : numpy.ndarray of uint8, shape (n,)
        The new class of every point, in file order.
    selected : numpy.ndarray of bool, shape (n,)
        Which points took part.

    Raises
    ------
    BareEarthError
        If no point is left to classify, or the CRS is geographic.
    Cancelled
        If the user asked to stop.
    """
    selected = selection.select(cloud, progress)
    points = cloud.points(selected)
    progress(0.05)
    ground = np.zeros(cloud.count, dtype=bool)
    ground[selected] = method_of(parameters).classify(points, parameters, progress.part(0.05, 1.0))
    return selection.classes(cloud, selected, ground), selected


def classify_file(
    source: Path,
    target: Path,
    parameters: ParameterSet,
    selection: Selection = Selection(),
    terrain: TerrainModel = TerrainModel(),
    dtm: Path | None = None,
    hillshade: Path | None = None,
    progress: Progress = SILENT,
) -> Summary:
    """Classify the ground points of a LAS, LAZ or COPC file and write the file anew.

    Parameters
    ----------
    source, target : Path
        The input, and the output (.las, .laz or .copc.laz). The output equals the input but for
        the classification.
    parameters, selection, progress
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
    classification, selected = classify(cloud, parameters, selection, progress.part(0.15, 0.7))
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
        selected_count=int(np.count_nonzero(selected)),
        ground_count=int(np.count_nonzero(ground)),
        class_counts={int(value): int(count) for value, count in zip(values, counts)},
    )
