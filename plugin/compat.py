"""All differences between QGIS 3.22 to 4.x, and between builds of QGIS."""

from __future__ import annotations

from qgis import core
from qgis.core import (
    NULL,
    Qgis,
    QgsLineSymbol,
    QgsMapLayerProxyModel,
    QgsProcessing,
    QgsProcessingContext,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterFile,
    QgsProcessingParameterFileDestination,
    QgsProcessingParameterNumber,
    QgsProcessingUtils,
    QgsProviderRegistry,
    QgsRasterLayer,
    QgsVectorLayer,
)

from .i18n import tr

try:  # Qt 6
    from qgis.PyQt.QtGui import QAction as QAction
except ImportError:
    from qgis.PyQt.QtWidgets import QAction as QAction

# QGIS 3.36 moved these enumerations to `Qgis`; the old names are deprecated.
if hasattr(Qgis, "ProcessingParameterFlag"):
    ADVANCED = Qgis.ProcessingParameterFlag.Advanced
    OPTIONAL = Qgis.ProcessingParameterFlag.Optional
    NUMBER = Qgis.ProcessingNumberParameterType.Double
    INTEGER = Qgis.ProcessingNumberParameterType.Integer
    POLYGONS = Qgis.ProcessingSourceType.VectorPolygon
    LINES = Qgis.ProcessingSourceType.VectorLine
    TABLES = Qgis.ProcessingSourceType.Vector  # with or without geometry
    FILES = Qgis.ProcessingSourceType.File
    TERRAINS = [Qgis.ProcessingSourceType.Raster, Qgis.ProcessingSourceType.PointCloud]
    FOLDER = Qgis.ProcessingFileParameterBehavior.Folder
else:
    ADVANCED = QgsProcessingParameterDefinition.Flag.FlagAdvanced
    OPTIONAL = QgsProcessingParameterDefinition.Flag.FlagOptional
    NUMBER = QgsProcessingParameterNumber.Type.Double
    INTEGER = QgsProcessingParameterNumber.Type.Integer
    POLYGONS = QgsProcessing.SourceType.TypeVectorPolygon
    LINES = QgsProcessing.SourceType.TypeVectorLine
    TABLES = QgsProcessing.SourceType.TypeVector
    FILES = QgsProcessing.SourceType.TypeFile
    TERRAINS = [QgsProcessing.SourceType.TypeRaster, QgsProcessing.SourceType.TypePointCloud]
    FOLDER = QgsProcessingParameterFile.Behavior.Folder

# QGIS 3.36 moved this one, too.
if hasattr(Qgis, "CrsWktVariant"):
    WKT = Qgis.CrsWktVariant.Preferred
else:
    WKT = core.QgsCoordinateReferenceSystem.WktVariant.WKT_PREFERRED
if hasattr(Qgis, "WkbType"):  # since QGIS 3.30
    NO_GEOMETRY = Qgis.WkbType.NoGeometry
else:
    NO_GEOMETRY = core.QgsWkbTypes.Type.NoGeometry
# Units of CRS that are not lengths; moved in QGIS 3.30.
_UNITS = Qgis.DistanceUnit if hasattr(Qgis, "DistanceUnit") else core.QgsUnitTypes.DistanceUnit
NO_LENGTHS = (
    (_UNITS.Degrees, _UNITS.Unknown)
    if hasattr(_UNITS, "Degrees")
    else (_UNITS.DistanceDegrees, _UNITS.DistanceUnknownUnit)
)
# QGIS 3.34 moved the filters of boxes for layers, too.
if hasattr(Qgis, "LayerFilter"):
    POINT_CLOUDS = Qgis.LayerFilter.PointCloudLayer
else:
    POINT_CLOUDS = QgsMapLayerProxyModel.Filter.PointCloudLayer

# Since QGIS 3.26.
HAS_POINT_CLOUD_OUTPUTS = hasattr(core, "QgsProcessingParameterPointCloudDestination")
# What reads the value of a field of `point_cloud_output`: parameterAsOutputLayer, or ...FileOutput.
POINT_CLOUD_OUTPUT = "OutputLayer" if HAS_POINT_CLOUD_OUTPUTS else "FileOutput"


def is_null(value: object) -> bool:
    """Return whether a Processing value is not set; the null of PyQt depends on the Qt version."""
    return value is None or value == NULL


def is_empty(value: object) -> bool:
    """Return whether a field is empty."""
    return is_null(value) or value == ""


def can_load(path: str) -> bool:
    """Return whether this build of QGIS can show a point cloud file, or a .vpc, as a layer."""
    providers = QgsProviderRegistry.instance().providerList()
    if path.lower().endswith(".vpc"):  # since QGIS 3.32
        return "vpc" in providers
    return "pdal" in providers or (path.lower().endswith(".copc.laz") and "copc" in providers)


def load_point_cloud(path: str, context: QgsProcessingContext) -> None:
    """Let QGIS load a point cloud as a layer after the run, also a .vpc file."""
    _load(path, context, QgsProcessingUtils.LayerHint.PointCloud)


def load_raster(path: str, context: QgsProcessingContext) -> None:
    """Let QGIS load a raster as a layer after the run."""
    _load(path, context, QgsProcessingUtils.LayerHint.Raster)


def load_vector(path: str, context: QgsProcessingContext) -> None:
    """Let QGIS load a vector file as a layer after the run."""
    _load(path, context, QgsProcessingUtils.LayerHint.Vector)


def _load(path: str, context: QgsProcessingContext, hint: QgsProcessingUtils.LayerHint) -> None:
    if context.project() is None:
        return
    details = QgsProcessingContext.LayerDetails("", context.project(), "", hint)
    context.addLayerToLoadOnCompletion(path, details)


def point_cloud_output(
    name: str, label: str, extensions: list[str]
) -> QgsProcessingParameterDefinition:
    """Return the parameter of an output point cloud: a layer, or a file before QGIS 3.26."""
    if HAS_POINT_CLOUD_OUTPUTS:
        return core.QgsProcessingParameterPointCloudDestination(name, label)
    # The first filter gives the extension of files without a name.
    filters = ";;".join(
        tr("{} files (*.{})").format(ending.upper(), ending) for ending in extensions
    )
    return QgsProcessingParameterFileDestination(name, label, filters)


def place_on_line(settings: core.QgsPalLayerSettings) -> None:
    """Place labels on their lines."""
    if hasattr(Qgis, "LabelPlacement"):  # since QGIS 3.26
        settings.placement = Qgis.LabelPlacement.Line
    else:
        settings.placement = core.QgsPalLayerSettings.Placement.Line
    if hasattr(Qgis, "LabelLinePlacementFlag"):  # since QGIS 3.32
        flag = Qgis.LabelLinePlacementFlag.OnLine
        flags = Qgis.LabelLinePlacementFlags(flag)
    else:
        flags = core.QgsLabeling.LinePlacementFlags(core.QgsLabeling.LinePlacementFlag.OnLine)
    lines = settings.lineSettings()
    lines.setPlacementFlags(flags)
    settings.setLineSettings(lines)


def place_over_points(settings: core.QgsPalLayerSettings) -> None:
    """Place labels on their points, all of them, also where they overlap."""
    if hasattr(Qgis, "LabelPlacement"):  # since QGIS 3.26
        settings.placement = Qgis.LabelPlacement.OverPoint
        places = settings.placementSettings()
        places.setOverlapHandling(Qgis.LabelOverlapHandling.AllowOverlapIfRequired)
        settings.setPlacementSettings(places)
    else:
        settings.placement = core.QgsPalLayerSettings.Placement.OverPoint
        settings.displayAll = True


def colour_profile(layer: QgsVectorLayer, colour: str) -> None:
    """Set the colour of lines in elevation profiles, which QGIS would choose at random."""
    properties = layer.elevationProperties()
    if properties is not None:  # since QGIS 3.26
        line = {"line_color": colour, "line_width": "0.6"}
        properties.setProfileLineSymbol(QgsLineSymbol.createSimple(line))


def mark_as_elevation(layer: QgsRasterLayer, colour: str) -> None:
    """Tell 3D views and elevation profiles that the raster is a surface, and its colour there."""
    properties = layer.elevationProperties()
    if properties is None:  # before QGIS 3.26
        return
    properties.setEnabled(True)
    line = {"line_color": colour, "line_width": "0.6"}
    properties.setProfileLineSymbol(QgsLineSymbol.createSimple(line))
    if hasattr(properties, "setMode"):  # since QGIS 3.38; before, enabling is enough
        properties.setMode(Qgis.RasterElevationMode.RepresentsElevationSurface)
