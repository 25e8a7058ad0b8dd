"""What is seen of a classified point cloud: its points, or what takes their place."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Iterable

from qgis.core import QgsProcessingContext, QgsProcessingUtils

from ...algorithms.core.errors import Cancelled
from .. import compat
from ..i18n import tr
from ..styles import clouds, layers
from .base import BareEarthAlgorithm
from .feedback import FeedbackProgress

if TYPE_CHECKING:
    from ...algorithms.engine.requests import ClassifyRequest
    from ...algorithms.engine.terrain_maps import MapRequest


def show_classified(
    algorithm: BareEarthAlgorithm,
    cloud: str,
    classes: Iterable[int],
    request: ClassifyRequest | MapRequest,
    context: QgsProcessingContext,
    progress: FeedbackProgress,
    hides: int = layers.CLOUD,
) -> None:
    """Show a classified point cloud, or a raster of its classes where QGIS cannot.

    Parameters
    ----------
    algorithm : BareEarthAlgorithm
        Whose output it is.
    cloud : str
        The file; a virtual point cloud if it is of many.
    classes : iterable of int
        Its classes; the usual ones if there are none.
    request : ClassifyRequest or MapRequest
        Says the class of the ground, and the cells of the raster.
    context : QgsProcessingContext
        What takes the place of the points is made only where other layers are loaded.
    progress : FeedbackProgress
        Receives messages.
    hides : int
        As for `layers.Look`.
    """
    ground_class = request.selection.to_class
    classes = list(classes) or clouds.usual_classes(ground_class)
    is_virtual = cloud.endswith(".vpc")
    if is_virtual and hides == layers.CLOUD:
        # Seen from afar it is outlines, through which the terrain is to be seen.
        hides = 0
    algorithm.show(cloud, layers.classes(classes, hides=hides))
    if compat.can_load(cloud):
        if is_virtual:
            compat.load_virtual_point_cloud(cloud, "", context)
        return
    progress.info(tr("This QGIS cannot show such a file as a layer. It is at {}.").format(cloud))
    if is_virtual or not context.layersToLoadOnCompletion():
        return
    # Reads files, which takes packages that QGIS may lack when it starts.
    from ...algorithms.products.class_raster import write_class_raster

    path = QgsProcessingUtils.generateTempFilename("classes.tif")
    cell_size = request.terrain.dtm_cell_size
    try:
        write_class_raster(Path(cloud), Path(path), cell_size, ground_class, progress.beyond())
    except Cancelled:
        # All that was asked for is there.
        return
    hint = QgsProcessingUtils.LayerHint.Raster
    details = QgsProcessingContext.LayerDetails("classes", context.project(), "classes", hint)
    context.addLayerToLoadOnCompletion(path, details)
    algorithm.show(path, layers.class_raster(classes, hides))
