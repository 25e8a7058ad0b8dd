"""Shows a classified point cloud: its points, or a raster of their classes."""

from __future__ import annotations

from pathlib import Path
from typing import Iterable

from qgis.core import QgsProcessingContext, QgsProcessingUtils

from ...algorithms.core.errors import BareEarthError, Cancelled
from .. import compat
from ..styles import clouds, layers
from ..styles.rasters import is_class_raster
from .base import BareEarthAlgorithm
from .feedback import FeedbackProgress
from .outputs import cannot_show, class_raster_of

# Side of a cell of a raster in metres, unless the run has rasters of its own.
_USUAL_CELL = 1.0


def show_classified(
    algorithm: BareEarthAlgorithm,
    cloud: str,
    classes: Iterable[int],
    ground_class: int,
    cells: tuple[float, bool],
    context: QgsProcessingContext,
    progress: FeedbackProgress,
    hides: int = layers.CLOUD,
) -> None:
    """Show a classified point cloud, which may be virtual, with its classes, or the usual ones if
    none are given, or a raster of them where QGIS cannot, with cells as in `show_class_raster`.
    """
    classes = list(classes) or clouds.usual_classes(ground_class)
    is_virtual = cloud.endswith(".vpc")
    # At small scales QGIS shows outlines, and the terrain must be visible through these.
    is_hiding = not (is_virtual and hides == layers.CLOUD)
    algorithm.show(cloud, layers.classes(classes, hides=hides if is_hiding else 0))
    if compat.can_load(cloud):
        if is_virtual:
            compat.load_point_cloud(cloud, context)
        return
    progress.info(cannot_show(cloud))
    shown = [] if is_virtual else classes
    show_class_raster(algorithm, cloud, shown, ground_class, context, progress, hides, cells)


def show_class_raster(
    algorithm: BareEarthAlgorithm,
    cloud: str,
    classes: Iterable[int],
    ground_class: int,
    context: QgsProcessingContext,
    progress: FeedbackProgress,
    hides: int = layers.CLOUD,
    cells: tuple[float, bool] = (_USUAL_CELL, False),
) -> None:
    """Show a raster of the classes of a cloud that QGIS cannot show, with cells of a size in
    metres, or in units of the CRS.
    """
    # It is made only if QGIS will load other layers, or a dialog shows the run: else nobody sees
    # it.
    if not (context.layersToLoadOnCompletion() or progress.is_of_dialog):
        return
    # Imported here, since it needs packages that QGIS may lack when it starts.
    from ...algorithms.tools.rasters.class_raster import write_class_raster

    path, (cell_size, in_units) = _place_of_raster(cloud), cells
    try:
        files = Path(cloud), Path(path)
        found = write_class_raster(
            *files, cell_size, ground_class, progress.beyond(), algorithm.stated, in_units
        )
    except Cancelled:
        # All outputs of the run are complete.
        return
    except BareEarthError as error:
        progress.warning(str(error))
        return
    compat.load_raster(path, context)
    algorithm.show(path, layers.class_raster(list(classes) or found, hides))


def _place_of_raster(cloud: str) -> str:
    """Return the file beside a cloud for its classes; a temporary one if it belongs to the user."""
    path = class_raster_of(Path(cloud))
    if path.exists() and not is_class_raster(path):
        return QgsProcessingUtils.generateTempFilename("classes.tif")
    return str(path)
