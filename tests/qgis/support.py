"""What the tests in QGIS share."""

from pathlib import Path

import laspy
import numpy as np
from laspy.vlrs.known import WktCoordinateSystemVlr
from osgeo import gdal, osr
from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsFeature,
    QgsGeometry,
    QgsLayerTreeGroup,
    QgsMapRendererParallelJob,
    QgsMapSettings,
    QgsPointXY,
    QgsProcessingFeedback,
    QgsProject,
    QgsRectangle,
    QgsVectorLayer,
)
from qgis.PyQt import sip
from qgis.PyQt.QtCore import QSize

ROOT = Path(__file__).parents[2]
ALGORITHM = "bareearth:tindensification"
NODATA = -32768.0


def remove(dialog):
    """Close a dialog and delete all of it at once, as a window's event loop would do later.

    Else its Python half may go first, and Qt falls over the rest when it next looks at it.
    """
    dialog.close()
    if not sip.isdeleted(dialog):
        sip.delete(dialog)


class Log(QgsProcessingFeedback):
    """Keeps what is said, and cancels when so much percent are done."""

    def __init__(self, cancel_at=None):
        super().__init__(False)
        self.said, self.moments = [], []
        self._cancel_at = cancel_at

    def setProgress(self, progress):
        super().setProgress(progress)
        self.moments.append(progress)
        if self._cancel_at is not None and progress >= self._cancel_at:
            self.cancel()

    def _say(self, text):
        self.said.append(text)

    pushInfo = pushWarning = pushCommandInfo = _say

    def reportError(self, error, fatalError=False):
        self.said.append(error)

    @property
    def text(self):
        return "\n".join(self.said)


def write_raster(path, heights, epsg=25832, cell=1.0):
    """Write heights, NaN for none, as a GeoTIFF, and return its path as text."""
    rows, columns = heights.shape
    raster = gdal.GetDriverByName("GTiff").Create(str(path), columns, rows, 1, gdal.GDT_Float32)
    raster.SetGeoTransform((500_000.0, cell, 0.0, 5_700_000.0, 0.0, -cell))
    reference = osr.SpatialReference()
    reference.ImportFromEPSG(epsg)
    raster.SetProjection(reference.ExportToWkt())
    raster.GetRasterBand(1).SetNoDataValue(NODATA)
    raster.GetRasterBand(1).WriteArray(np.where(np.isnan(heights), NODATA, heights))
    raster.FlushCache()
    return str(path)


def write_scene(path, epsg=25832, origin=(500_000.0, 5_700_000.0)):
    """Write a tilted plane of 80 x 80 m with a flat-roofed building; return the true ground."""
    side = np.arange(0.25, 80.0, 0.5)
    x, y = (axis.ravel() for axis in np.meshgrid(side, side))
    ground = ~((x > 30) & (x < 48) & (y > 20) & (y < 46))
    z = np.where(ground, 100 + 0.05 * x + 0.02 * y, 112.0)
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = (0.001, 0.001, 0.001), (*origin, 0.0)
    if epsg:
        wkt = QgsCoordinateReferenceSystem.fromEpsgId(epsg).toWkt()
        header.vlrs.append(WktCoordinateSystemVlr(wkt))
        header.global_encoding.wkt = True
    las = laspy.LasData(header)
    las.x, las.y, las.z = x + origin[0], y + origin[1], z
    las.classification[:] = 1
    las.return_number[:] = las.number_of_returns[:] = 1
    las.write(str(path))
    return ground


def layer_of(kind, wkt, crs="EPSG:25832"):
    """Return a layer in memory with one feature."""
    layer = QgsVectorLayer(f"{kind}?crs={crs}", "layer", "memory")
    feature = QgsFeature()
    feature.setGeometry(QgsGeometry.fromWkt(wkt))
    assert layer.dataProvider().addFeatures([feature])[0]
    return layer


def colour_at(layers, x, y):
    """Return the colour of a map of some layers at a place."""
    settings = QgsMapSettings()
    settings.setLayers(layers)
    settings.setDestinationCrs(layers[0].crs())
    settings.setOutputSize(QSize(101, 101))
    settings.setExtent(QgsRectangle.fromCenterAndSize(QgsPointXY(x, y), 10.1, 10.1))
    job = QgsMapRendererParallelJob(settings)
    job.start()
    job.waitForFinished()
    return job.renderedImage().pixelColor(50, 50)


def groups():
    """Return the nodes of the layers in each group of the project, from above."""
    return {
        group.name(): group.children()
        for group in QgsProject.instance().layerTreeRoot().children()
        if isinstance(group, QgsLayerTreeGroup)
    }


def title_of(layer):
    """Return the name of a layer, or of its node, without that of the input."""
    return layer.name().partition(": ")[2] or layer.name()


class Scene:
    def __init__(self, folder, suffix):
        self.path = folder / f"scene{suffix}"
        self.ground = write_scene(self.path)
        self.count, self.ground_count = len(self.ground), int(self.ground.sum())

    def with_classes(self, path, other=6):
        """Write it with its true classes: the ground, and another one."""
        las = laspy.read(self.path)
        las.classification[:] = np.where(self.ground, 2, other)
        las.write(str(path))
        return path
