"""Fields for point clouds and terrains, also files that QGIS cannot load, and what is in them."""

from __future__ import annotations

from pathlib import Path
from typing import Sequence

from qgis.core import (
    QgsMapLayer,
    QgsPointCloudLayer,
    QgsProcessingContext,
    QgsProcessingParameterMapLayer,
    QgsProcessingParameterPointCloudLayer,
    QgsProcessingUtils,
    QgsProviderRegistry,
    QgsRasterLayer,
)
from qgis.PyQt.QtCore import QUrl

from ...algorithms.core.files import split_name
from ...algorithms.remote.addresses import is_address, shown
from .. import compat
from ..i18n import mark, tr
from ..styles.loaded import filter_of, has_edits
from .feedback import Refusal
from .remote import REMOTE, Remote, remote_at, remote_of, without_provider
from .request import Request

# As a name, so that the widget is imported only in dialogs, not in qgis_process.
_WIDGET = f"{__package__}.layer_widgets.PointCloudWidget"
# Names of the inputs of runs, by their temporary outputs.
_ORIGINS: dict[Path, str] = {}
_NOWHERE = mark("{} does not exist. Check the path.")


class PointCloudInput(QgsProcessingParameterPointCloudLayer):
    """A point cloud layer, any existing file, or an address."""

    # QGIS itself accepts only files that it can load. Without its `pdal` provider, these do not
    # include .las and .laz; with it, QGIS would index the whole file first.

    endings = "*.las *.laz *.LAS *.LAZ"

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)
        self.setMetadata({**self.metadata(), "widget_wrapper": {"class": _WIDGET}})

    def clone(self) -> PointCloudInput:
        return type(self)(self)

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
        return f"{tr('Point clouds')} ({self.endings});;{tr('All files')} (*.*)"


class SurveyInput(PointCloudInput):
    """A point cloud layer, or any file or folder, such as a virtual point cloud or a list."""

    endings = "*.las *.laz *.vpc *.txt *.LAS *.LAZ"


class TerrainInput(QgsProcessingParameterMapLayer):
    """A raster layer, a point cloud layer, or any existing file or folder."""

    def __init__(self, *arguments: object) -> None:
        super().__init__(*arguments)
        self.setDataTypes(compat.TERRAINS)

    def clone(self) -> TerrainInput:
        return type(self)(self)

    def checkValueIsAcceptable(
        self, value: object, context: QgsProcessingContext | None = None
    ) -> bool:
        """Return whether `value` is a file, or QGIS accepts it."""
        is_file = isinstance(value, (str, Path)) and _file(str(value)) is not None
        return is_file or super().checkValueIsAcceptable(value, context)


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


def source_of(request: Request, name: str) -> Path | Remote:
    """Return what is in a `PointCloudInput` that is not empty, without loading it as a layer."""
    value = request.parameters.get(name)
    if isinstance(value, QgsMapLayer):
        return _of_layer(value, request)
    text = (str(value) if isinstance(value, Path) else "") or request.read("String", name)
    if not text:
        raise Refusal(mark("Choose a point cloud."))
    return _named(text, request)


def _named(text: str, request: Request) -> Path | Remote:
    """Return the file, the layer of the project, or the address that a text names."""
    path = _file(text)
    if path is not None:
        return path
    text = without_provider(text)
    # Only a layer of the project: of other texts, QGIS would make one, and ask the server.
    layer = request.layer_named(text)
    if layer is not None:
        return _of_layer(layer, request)
    if is_address(text):
        return remote_at(text)
    raise Refusal(_NOWHERE, text)


def _of_layer(layer: QgsMapLayer, request: Request) -> Path | Remote:
    """Return what a layer shows, and warn of its filter, which QGIS alone applies."""
    if not isinstance(layer, QgsPointCloudLayer):
        text = mark("{} is not a point cloud. Choose a point cloud layer, or a .las or .laz file.")
        raise Refusal(text, layer.name())
    if has_edits(layer):
        text = mark('The layer "{}" is being edited. Save or discard the edits first.')
        raise Refusal(text, layer.name())
    if filter_of(layer):
        request.progress.warning("The layer's filter is not applied: all points are read.")
    provider = layer.dataProvider().name() if layer.dataProvider() else ""
    parts = QgsProviderRegistry.instance().decodeUri(provider, layer.source())
    path = parts.get("path") or layer.source()
    return remote_of(layer) if "://" in path else Path(path)


def survey_of(request: Request) -> list[Path | Remote]:
    """Return the point cloud and the folder in the fields of a survey; files must exist."""
    paths: list[Path | Remote] = []
    if not request.is_empty("INPUT"):
        paths.append(source_of(request, "INPUT"))
    folder = request.read("String", "INPUT_FOLDER")
    if folder and not Path(folder).is_dir():
        raise Refusal(mark("{} is not a folder. Check the path."), folder)
    paths += [Path(folder)] if folder else []
    if not paths:
        raise Refusal(mark("Choose a point cloud, or a folder of them."))
    return paths


def clouds_of(request: Request) -> list[Path | Remote]:
    """Return what is in the fields of many files; files and folders must exist."""
    texts = [*request.read("FileList", "INPUT"), request.read("String", "INPUT_FOLDER")]
    paths = [_named(text, request) for text in texts if text]
    if not request.is_empty(REMOTE):
        paths.append(source_of(request, REMOTE))
    if not paths:
        raise Refusal(mark("Choose point clouds, or a folder of them."))
    return paths


def terrain_of(request: Request, name: str) -> tuple[str, str]:
    """Return the file of a raster or of points in a `TerrainInput`, and its name."""
    value = request.parameters.get(name)
    text = str(value) if isinstance(value, (str, Path)) else ""
    text = text or request.read("String", name)
    layer = value if isinstance(value, QgsMapLayer) else request.layer_named(text)
    if isinstance(layer, QgsRasterLayer):
        if layer.providerType() != "gdal":
            raise Refusal(mark("{} is not a file. Export it as GeoTIFF first."), layer.name())
        return layer.source(), layer.name()
    source = local(_named(text, request) if layer is None else _of_layer(layer, request))
    return str(source), name_of(source)


def local(source: Path | Remote) -> Path:
    """Return a file; refuse a remote point cloud, which only the main input can be."""
    if isinstance(source, Remote):
        raise Refusal(mark("{} is not on this computer. Choose a file."), source.name)
    return source


def raster_of(request: Request, name: str, refusal: str) -> QgsRasterLayer:
    """Return the raster layer in a field; raise `refusal`, in `mark`, if it is not a file."""
    layer, value = request.read("RasterLayer", name), request.parameters.get(name)
    if layer is None and isinstance(value, (str, Path)) and value:
        is_there = _file(str(value)) is not None
        raise Refusal(
            mark("{} is not a raster. Choose a GeoTIFF.") if is_there else _NOWHERE, value
        )
    if layer is None or layer.providerType() != "gdal":
        raise Refusal(refusal)
    return layer


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


def _file(text: str) -> Path | None:
    """Return the path in `text`, if the file or folder exists."""
    path = QUrl(text).toLocalFile() if text.startswith("file:") else text
    return Path(path) if path and Path(path).exists() else None
