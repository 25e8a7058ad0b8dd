"""Makes the outputs that the user chose for the step from a point cloud to maps."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Iterator, Mapping, Sequence

from qgis.core import QgsProcessingContext

from ...algorithms.core.parameters import ParameterSet
from ...algorithms.engine.memory import Resources
from ...algorithms.survey.kept_classes import GROUND
from ...algorithms.survey.selection import Selection
from ...algorithms.tools.contours import Contours
from ...algorithms.tools.ground.method import TileMethod
from ...algorithms.tools.rasters.parameters import MapTerrain, SurfaceModel, TerrainModel
from ..styles.layers import BELOW_TERRAIN, contours
from . import outputs
from .area import area_options, given_options
from .base import BareEarthAlgorithm, command_line
from .classified import show_classified
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
    from ...algorithms.delivery.maps import MapFiles, make_maps

    chosen = without_delivery(algorithm.chosen(parameters, context))
    cloud = algorithm.point_cloud_destination(parameters, "OUTPUT", context)
    results: dict[str, Any] = dict(outputs.raster_paths(algorithm, parameters, context))
    lines, rasters = results.get("CONTOURS"), outputs.raster_files(results)
    files = MapFiles(Path(cloud) if cloud else None, rasters, Path(lines) if lines else None)
    summary = make_maps(algorithm.inputs, files, chosen, limits, progress)
    written = str(cloud and summary.cloud)
    area = area_options(limits["area"], progress, is_all=True)
    for command in _commands(algorithm.inputs, written, results, chosen, area, limits):
        progress.command(command)
    progress.share(summary.ground_count, summary.point_count, bool(limits["area"]))
    if lines and summary.contour_interval is not None:
        algorithm.show(lines, contours(summary.contour_interval))
    if cloud:
        results["OUTPUT"], algorithm.class_counts = written, summary.class_counts
        outputs.do_not_load(context, {cloud} - {written})
        model, ground = MapTerrain.among(chosen), Selection.among(chosen).to_class
        cells = model.dtm_cell_size, model.dtm_cell_unit == "crs"
        look = ground, cells, context, progress, BELOW_TERRAIN
        show_classified(algorithm, written, summary.class_counts, *look)
    return {**results, "POINT_COUNT": summary.point_count, "GROUND_COUNT": summary.ground_count}


def _commands(
    sources: Sequence[Path],
    cloud: str,
    rasters: Mapping[str, str],
    chosen: Sequence[ParameterSet],
    area: Sequence[str],
    limits: Mapping[str, Any],
) -> Iterator[str]:
    """Yield the commands for a classified cloud, empty if none is kept, and for its rasters and
    contour lines, by the names of their fields.
    """
    of_type: dict[type, Any] = {type(values): values for values in chosen}
    cloud = cloud or "classified.laz"
    # For many files, the folder of their virtual point cloud.
    target = str(Path(cloud).parent) if cloud.endswith(".vpc") else cloud
    finding = [of_type[kind] for kind in (TileMethod, Selection, Resources)]
    words = [*map(str, sources), target, *area]
    yield command_line("classify", words, finding, {"crs": limits["crs"]})
    if rasters:
        ground = of_type[Selection].to_class
        classes = {"ground-classes": "" if ground == GROUND else str(ground)}
        # The command has other defaults.
        model = TerrainModel(**vars(of_type[MapTerrain]))
        drawing = [model, *(of_type[kind] for kind in (SurfaceModel, Contours, Resources))]
        words = [cloud, *(word for word in area if word != "--area-only")]
        options = {**classes, **given_options(**limits), **rasters}
        yield command_line("terrain", words, drawing, options)
