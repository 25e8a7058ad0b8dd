"""Input fields: point clouds, also files that QGIS cannot load, and features of layers."""

from __future__ import annotations

import functools
from contextlib import suppress
from pathlib import Path
from typing import Any, Iterator, Sequence

import numpy as np
from qgis.core import (
    Qgis,
    QgsCoordinateReferenceSystem,
    QgsCurve,
    QgsCurvePolygon,
    QgsFeature,
    QgsFeatureRequest,
    QgsMapLayer,
    QgsPointCloudLayer,
    QgsPolygon,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingFeatureSource,
    QgsProcessingParameterFile,
    QgsProcessingParameterMapLayer,
    QgsProcessingParameterMultipleLayers,
    QgsProcessingParameterPointCloudLayer,
    QgsProcessingUtils,
    QgsProviderRegistry,
    QgsRasterLayer,
)
from qgis.PyQt.QtCore import QUrl

from ...algorithms.core.errors import BareEarthError
from ...algorithms.core.files import split_name
from ...algorithms.core.points import Box
from ...algorithms.crs.system import Crs
from ...algorithms.las.crs_records import read_crs
from ...algorithms.las.opening import open_las
from ...algorithms.remote.addresses import is_address, shown
from ...algorithms.survey.area import Polygon
from ...algorithms.survey.files import find_files, open_survey
from .. import compat
from ..i18n import mark, tr
from ..styles.loaded import filter_of, has_edits
from .feedback import Refusal
from .remote import (
    ADDRESS_HELP,
    ALSO_REMOTE,
    REMOTE,
    Remote,
    remote_at,
    remote_of,
    without_provider,
)
from .stated_crs import crs_of_text

# As a name, so that the widget is imported only in dialogs, not in qgis_process.
_WIDGET = f"{__package__}.layer_widgets.PointCloudWidget"
# Help of the fields of `add_survey` and `add_clouds`.
_FILES_HELP = (
    ".las, .laz and .copc.laz files, virtual point clouds (.vpc), or text files (.txt) with one"
    " path in each line. May stay empty if a folder is given."
)
_FOLDER_HELP = (
    "All .las, .laz and .copc.laz files in this folder are used, too. All files together are one"
    " survey, without seams."
)
_SURVEY_HELP = (
    "A point cloud layer, a .las, .laz or .copc.laz file, a virtual point cloud (.vpc), or a text"
    " file (.txt) with one path in each line. May stay empty if a folder is given."
    f"{ALSO_REMOTE}"
)
# Names of the inputs of runs, by their temporary outputs.
_ORIGINS: dict[Path, str] = {}
_NOWHERE = mark("{} does not exist. Check the path.")
# Help of other fields.
CLOUD_HELP = f"A point cloud layer, or a .las, .laz or .copc.laz file.{ALSO_REMOTE}"
ANY_CLOUD_HELP = (
    "A point cloud layer, or a .las, .laz or .copc.laz file; also a virtual point cloud (.vpc) or a"
    f" folder.{ALSO_REMOTE}"
)


class PointCloudInput(QgsProcessingParameterPointCloudLayer):
    """A point cloud layer, any existing file, or an address."""

    # QGIS itself accepts only files that it can load. Without its `pdal` provider, these do not
    # include .las and .laz; with it, QGIS would index the whole file first.

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)
        self.setMetadata({**self.metadata(), "widget_wrapper": {"class": _WIDGET}})

    def clone(self) -> PointCloudInput:
        """Return a copy; dialogs and models work with copies."""
        return PointCloudInput(self)

    def checkValueIsAcceptable(
        self, value: object, context: QgsProcessingContext | None = None
    ) -> bool:
        """Return whether `value` is a file or an address, or QGIS accepts it."""
        if isinstance(value, (str, Path)) and (is_address(str(value)) or _file(str(value))):
            return True
        return super().checkValueIsAcceptable(value, context)

    # The log, the history and commands get these three. QGIS itself would ask the server for the
    # layer at an address.

    def valueAsPythonString(self, value: object, context: QgsProcessingContext) -> str:
        """Return a value as Python writes it, without secrets."""
        text = _without_secrets(value, context)
        return repr(text) if text else super().valueAsPythonString(value, context)

    def valueAsJsonObject(self, value: object, context: QgsProcessingContext) -> object:
        """Return a value for JSON, without secrets."""
        return _without_secrets(value, context) or super().valueAsJsonObject(value, context)

    def valueAsString(self, value: object, context: QgsProcessingContext) -> tuple[str, bool]:
        """Return a value for qgis_process, without secrets, and whether there is one."""
        text = _without_secrets(value, context)
        return (text, True) if text else super().valueAsString(value, context)

    def createFileFilter(self) -> str:
        """Return the file types for the button "..."; those of QGIS depend on the build."""
        return _filter("*.las *.laz *.LAS *.LAZ")


class SurveyInput(PointCloudInput):
    """A point cloud layer, or any file or folder, such as a virtual point cloud or a list."""

    def clone(self) -> SurveyInput:
        """Return a copy."""
        return SurveyInput(self)

    def createFileFilter(self) -> str:
        """Return the file types for the button "..."."""
        return _filter("*.las *.laz *.vpc *.txt *.LAS *.LAZ")


class TerrainInput(QgsProcessingParameterMapLayer):
    """A raster layer, a point cloud layer, or any existing file or folder."""

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)
        self.setDataTypes(compat.TERRAINS)

    def clone(self) -> TerrainInput:
        """Return a copy."""
        return TerrainInput(self)

    def checkValueIsAcceptable(
        self, value: object, context: QgsProcessingContext | None = None
    ) -> bool:
        """Return whether `value` is a file, or QGIS accepts it."""
        is_file = isinstance(value, (str, Path)) and _file(str(value)) is not None
        return is_file or super().checkValueIsAcceptable(value, context)


def terrain_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, object],
    name: str,
    context: QgsProcessingContext,
) -> tuple[str, str]:
    """Return the file of a raster or of points in a `TerrainInput`, and its name."""
    value = parameters.get(name)
    text = str(value) if isinstance(value, (str, Path)) else ""
    text = text or algorithm.parameterAsString(parameters, name, context)
    layer = value if isinstance(value, QgsMapLayer) else None
    layer = layer or QgsProcessingUtils.mapLayerFromString(text, context, False)
    if isinstance(layer, QgsRasterLayer):
        if layer.providerType() != "gdal":
            raise Refusal(mark("{} is not a file. Export it as GeoTIFF first."), layer.name())
        return layer.source(), layer.name()
    source = _named(text, context) if layer is None else _of_layer(layer)
    if isinstance(source, Remote):
        raise Refusal(mark("{} is not on this computer. Choose a file."), names_of([source]))
    return str(source), name_of(source)


def _without_secrets(value: object, context: QgsProcessingContext) -> str:
    """Return an address without its signature, or the id of a layer that has such an address; empty
    for other values.
    """
    if isinstance(value, str):
        value = QgsProcessingUtils.mapLayerFromString(value, context, False) or value
    if isinstance(value, QgsMapLayer):
        return value.id() if shown(value.source()) != value.source() else ""
    text = without_provider(value) if isinstance(value, str) else ""
    return shown(text) if is_address(text) else ""


def source_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, object],
    name: str,
    context: QgsProcessingContext,
) -> Path | Remote:
    """Return what is in a `PointCloudInput` that is not empty, without loading it as a layer."""
    value = parameters.get(name)
    layer = value if isinstance(value, QgsMapLayer) else None
    if layer is None:
        text = str(value) if isinstance(value, Path) else ""
        text = text or algorithm.parameterAsString(parameters, name, context)
        if not text:
            raise Refusal(mark("Choose a point cloud."))
        return _named(text, context)
    return _of_layer(layer)


def _named(text: str, context: QgsProcessingContext) -> Path | Remote:
    """Return the file, the layer of the project, or the address that a text names."""
    path = _file(text)
    if path is not None:
        return path
    text = without_provider(text)
    # Only a layer of the project: of other texts, QGIS would make one, and ask the server.
    layer = QgsProcessingUtils.mapLayerFromString(text, context, False)
    if layer is not None:
        return _of_layer(layer)
    if is_address(text):
        return remote_at(text)
    raise Refusal(_NOWHERE, text)


def add_survey(algorithm: QgsProcessingAlgorithm) -> None:
    """Add fields for a point cloud, or a folder of them, to a dialog."""
    algorithm.addParameter(SurveyInput("INPUT", "Point cloud", None, True), _SURVEY_HELP)
    _add_folder(algorithm)


def _add_folder(algorithm: QgsProcessingAlgorithm) -> None:
    folder = QgsProcessingParameterFile(
        "INPUT_FOLDER", "Folder of point clouds", compat.FOLDER, "", None, True
    )
    algorithm.addParameter(folder, _FOLDER_HELP)


def survey_of(
    algorithm: QgsProcessingAlgorithm, parameters: dict[str, object], context: QgsProcessingContext
) -> list[Path | Remote]:
    """Return the inputs in the fields of `add_survey`, at least one; files must exist."""
    paths: list[Path | Remote] = []
    if not compat.is_empty(parameters.get("INPUT")):
        paths.append(source_of(algorithm, parameters, "INPUT", context))
    folder = algorithm.parameterAsString(parameters, "INPUT_FOLDER", context)
    if folder and not Path(folder).is_dir():
        raise Refusal(mark("{} is not a folder. Check the path."), folder)
    paths += [Path(folder)] if folder else []
    if not paths:
        raise Refusal(mark("Choose a point cloud, or a folder of them."))
    return paths


def name_of(source: Path | Remote) -> str:
    """Return the name of a file or folder without the ending for its format, or of a layer; of a
    temporary output, that of the input of its run.
    """
    if isinstance(source, Remote):
        return source.name
    return _ORIGINS.get(source) or split_name(source)[0]


def remember_origin(output: str, name: str) -> None:
    """Remember the input of a run for its temporary output, which is named after its field."""
    if Path(QgsProcessingUtils.tempFolder()) in Path(output).parents:
        _ORIGINS[Path(output)] = name


def names_of(sources: Sequence[Path | Remote]) -> str:
    """Return a name for the inputs of a run."""
    return (tr("{} and others") if sources[1:] else "{}").format(name_of(sources[0]))


def words_of(source: Path | Remote) -> str:
    """Return an input for the command line, without secrets."""
    return shown(source.address) if isinstance(source, Remote) else str(source)


def add_clouds(algorithm: QgsProcessingAlgorithm) -> None:
    """Add fields for many files to a dialog: as a list, or as a folder."""
    files = QgsProcessingParameterMultipleLayers("INPUT", "Point clouds", compat.FILES, None, True)
    algorithm.addParameter(files, _FILES_HELP)
    _add_folder(algorithm)
    # The list of files of QGIS offers no layers, and nothing can be typed into it.
    remote = PointCloudInput(REMOTE, "Remote point cloud", None, True)
    remote.setFlags(remote.flags() | compat.ADVANCED)
    algorithm.addParameter(remote, ADDRESS_HELP)


def clouds_of(
    algorithm: QgsProcessingAlgorithm, parameters: dict[str, object], context: QgsProcessingContext
) -> list[Path | Remote]:
    """Return the inputs in the fields of `add_clouds`; files and folders must exist."""
    texts = algorithm.parameterAsFileList(parameters, "INPUT", context)
    texts.append(algorithm.parameterAsString(parameters, "INPUT_FOLDER", context))
    paths = [_named(text, context) for text in texts if text]
    if not compat.is_empty(parameters.get(REMOTE)):
        paths.append(source_of(algorithm, parameters, REMOTE, context))
    if not paths:
        raise Refusal(mark("Choose point clouds, or a folder of them."))
    return paths


def ignored_filter(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, object],
    name: str,
    context: QgsProcessingContext,
) -> str:
    """Return the filter of the input layer, which is ignored; empty without a filter."""
    layer = parameters.get(name)
    if not isinstance(layer, QgsMapLayer):
        text = algorithm.parameterAsString(parameters, name, context)
        layer = QgsProcessingUtils.mapLayerFromString(text, context, False)
    return filter_of(layer)


class CloudCrs:
    """The CRS of the point clouds of a run, stated by the user or read when it is first needed."""

    def __init__(self, *sources: Path, recursive: bool = False, stated: str | None = None) -> None:
        self._sources, self._recursive, self.stated = sources, recursive, stated

    @functools.cached_property
    def value(self) -> QgsCoordinateReferenceSystem:
        """The CRS, or if no file states one, an invalid one, so that nothing is transformed."""
        if self.stated:
            return crs_of_text(self.stated)
        crs = self._of_files()
        if crs.epsg:
            return QgsCoordinateReferenceSystem.fromEpsgId(crs.epsg)
        return QgsCoordinateReferenceSystem.fromWkt(crs.wkt or "")

    def _of_files(self) -> Crs:
        """Return the CRS of the first file that states one; all files must have the same."""
        paths = find_files(self._sources, self._recursive)
        for path in paths:
            with suppress(BareEarthError):  # The run reports files that cannot be read.
                crs = read_crs(open_las(path))
                if crs != Crs():
                    return crs
        return open_survey(paths).crs  # This raises an error if no file can be read.


def features_of(
    source: QgsProcessingFeatureSource | None,
    label: str,
    crs: QgsCoordinateReferenceSystem,
    context: QgsProcessingContext,
    attributes: Sequence[str] = (),
) -> Iterator[QgsFeature]:
    """Yield features of a layer, transformed to a CRS, with some attributes; errors name it."""
    if source is None:
        raise Refusal(mark('The layer "{}" cannot be read.'), label)
    request = QgsFeatureRequest().setSubsetOfAttributes(attributes, source.fields())
    request.setDestinationCrs(crs, context.transformContext())
    yield from source.getFeatures(request)


def box_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, object],
    name: str,
    context: QgsProcessingContext,
    crs: CloudCrs,
) -> Box:
    """Return the rectangle in a field, in the CRS of the points."""
    box = algorithm.parameterAsExtent(parameters, name, context, crs.value)
    return box.xMinimum(), box.yMinimum(), box.xMaximum(), box.yMaximum()


def raster_of(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, object],
    name: str,
    context: QgsProcessingContext,
    refusal: str,
) -> QgsRasterLayer:
    """Return the raster layer in a field; raise `refusal`, in `mark`, if it is not a file."""
    layer = algorithm.parameterAsRasterLayer(parameters, name, context)
    value = parameters.get(name)
    if layer is None and isinstance(value, (str, Path)) and value:
        is_there = _file(str(value)) is not None
        raise Refusal(
            mark("{} is not a raster. Choose a GeoTIFF.") if is_there else _NOWHERE, value
        )
    if layer is None or layer.providerType() != "gdal":
        raise Refusal(refusal)
    return layer


def layer_shapes(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, object],
    name: str,
    label: str,
    context: QgsProcessingContext,
    crs: CloudCrs,
    kind: Qgis.ProcessingSourceType = compat.POLYGONS,
    attributes: Sequence[str] = (),
    may_be_empty: bool = True,
) -> tuple[tuple[Any, Any], ...]:
    """Return the polygons (rings, float64 (n, 2)) or lines (x, y, and z or NaN, (n, 3)) of the
    layer in a field, in the CRS of the points, and attributes of each, by name.
    """
    # Geometries of other kinds are not used; a layer with only these is refused, and an empty one
    # unless it may be empty.
    source = algorithm.parameterAsSource(parameters, name, context)
    shape, corners_of, refusal = _KINDS[kind]
    found, others = [], 0
    for feature in features_of(source, label, crs.value, context, list(attributes)):
        values = {name: feature[name] for name in attributes}
        values = {name: None if compat.is_null(one) else one for name, one in values.items()}
        for part in feature.geometry().constParts():
            if isinstance(part, shape):
                found.append((corners_of(part.segmentize()), values))
            else:
                others += 1
    if not found and (others or not may_be_empty):
        raise Refusal(refusal, label)
    return tuple(found)


def rings_of(polygon: QgsPolygon) -> Polygon:
    """Return the rings of a polygon, float64 (n, 2) each."""
    rings = [polygon.exteriorRing(), *map(polygon.interiorRing, range(polygon.numInteriorRings()))]
    return tuple(_line_of(ring)[:, :2] for ring in rings if ring is not None)


def _line_of(line: QgsCurve) -> np.ndarray:
    rows = [(corner.x(), corner.y(), corner.z()) for corner in line.vertices()]
    return np.array(rows, dtype=float).reshape(-1, 3)


# The class of a geometry of a kind, what returns its corners, and the message if it has none.
_KINDS = {
    compat.POLYGONS: (
        QgsCurvePolygon, rings_of,
        mark('The layer "{}" holds no polygon. Choose one that does.'),
    ),
    compat.LINES: (
        QgsCurve, _line_of, mark('The layer "{}" holds no line. Choose one that does.')
    ),
}  # fmt: skip


def _of_layer(layer: QgsMapLayer) -> Path | Remote:
    if not isinstance(layer, QgsPointCloudLayer):
        text = mark("{} is not a point cloud. Choose a point cloud layer, or a .las or .laz file.")
        raise Refusal(text, layer.name())
    if has_edits(layer):
        text = mark('The layer "{}" is being edited. Save or discard the edits first.')
        raise Refusal(text, layer.name())
    provider = layer.dataProvider().name() if layer.dataProvider() else ""
    parts = QgsProviderRegistry.instance().decodeUri(provider, layer.source())
    path = parts.get("path") or layer.source()
    return remote_of(layer) if "://" in path else Path(path)


def _filter(endings: str) -> str:
    """Return the file types for a dialog, given the endings of point clouds."""
    return f"{tr('Point clouds')} ({endings});;{tr('All files')} (*.*)"


def _file(text: str) -> Path | None:
    """Return the path in `text`, if the file or folder exists."""
    path = QUrl(text).toLocalFile() if text.startswith("file:") else text
    return Path(path) if path and Path(path).exists() else None
