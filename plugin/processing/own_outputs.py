"""Makes the outputs that the user chose for the step from a point cloud to maps."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Mapping

from qgis.core import QgsProcessingContext

from ..styles.layers import BELOW_TERRAIN, contours
from . import outputs
from .area import area_options, given_options
from .base import BareEarthAlgorithm
from .classified import show_classified
from .commands import terrain_commands
from .delivery import without_delivery
from .feedback import FeedbackProgress


def make_own(
    algorithm: BareEarthAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    limits: Mapping[str, Any],
    progress: FeedbackProgress,
) -> dict[str, Any]:
    """Make the outputs, set the looks of their layers, and return what the algorithm returns."""
    from ...algorithms.runs.terrain_maps import MapFiles, MapRequest, make_maps

    chosen = without_delivery(algorithm.chosen(parameters, context))
    request = MapRequest.of(chosen, **limits)
    cloud = algorithm.point_cloud_destination(parameters, "OUTPUT", context)
    results: dict[str, Any] = dict(outputs.raster_paths(algorithm, parameters, context))
    lines, rasters = results.get("CONTOURS"), outputs.raster_files(results)
    files = MapFiles(Path(cloud) if cloud else None, rasters, Path(lines) if lines else None)
    summary = make_maps(algorithm.inputs, files, request, progress)
    made = str(cloud and summary.cloud)
    words = area_options(request.area, progress, is_all=True), given_options(**limits)
    for each in terrain_commands(algorithm.inputs, made, results, chosen, *words):
        progress.command(each)
    progress.share(summary.ground_count, summary.point_count, bool(request.area))
    if lines and summary.contour_interval is not None:
        algorithm.show(lines, contours(summary.contour_interval))
    if cloud:
        results["OUTPUT"], algorithm.class_counts = made, summary.class_counts
        outputs.do_not_load(context, {cloud} - {made})
        look = request, context, progress, BELOW_TERRAIN
        show_classified(algorithm, made, summary.class_counts, *look)
    return {**results, "POINT_COUNT": summary.point_count, "GROUND_COUNT": summary.ground_count}
