"""Layers of the project that show files of a run: they are reloaded, and keep their place.

Functions that take a project belong to the main thread.
"""

from __future__ import annotations

import os
import sys
import threading
from pathlib import Path
from typing import Callable, Iterable, Iterator, Mapping, NamedTuple, Sequence

from qgis.core import (
    QgsLayerTreeGroup,
    QgsMapLayer,
    QgsProject,
    QgsProviderRegistry,
    QgsVectorLayer,
)
from qgis.PyQt.QtCore import QCoreApplication, QObject, Qt, QThread, pyqtSignal, pyqtSlot

# Windows does not replace a file that a layer has open.
MUST_RELEASE = sys.platform == "win32"
# How often each file was replaced since QGIS was started.
_REPLACED: dict[Path, int] = {}
# A filter that all points pass, followed by a number.
_PASSED = "Classification >= -"
# How long the main thread may be busy, in seconds, when another thread asks it for something.
_PATIENCE = 5.0
# Files of whose points QGIS keeps a copy.
_KEPT_BY_QGIS = (".laz", ".vpc")


class Source(NamedTuple):
    """Where a layer gets its data: its id, source, provider, and the file."""

    layer: str
    uri: str
    provider: str
    path: Path


def file_of(layer: QgsMapLayer) -> Path | None:
    """Return the file that a layer shows; None if it shows none."""
    provider = layer.providerType() if hasattr(layer, "providerType") else ""
    path = QgsProviderRegistry.instance().decodeUri(provider, layer.source()).get("path")
    return Path(path) if path and "://" not in path else None


def sources_of(project: QgsProject | None, files: Iterable[Path]) -> list[Source]:
    """Return the layers of the project (None in qgis_process) that show some files, or files in
    folders, which need not exist, from the top of the tree.
    """
    wanted = {_normal(file) for file in files}
    found = []
    for layer in _layers(project):
        path = file_of(layer)
        if path is None:
            continue
        normal = _normal(path)
        if normal in wanted or not wanted.isdisjoint(normal.parents):
            found.append(Source(layer.id(), layer.source(), layer.providerType(), path))
    return found


def _layers(project: QgsProject | None) -> Iterator[QgsMapLayer]:
    """Yield the layers of a project, those of the layer tree first and in its order."""
    if project is None:
        return
    ids = project.layerTreeRoot().findLayerIds()
    layers = project.mapLayers()
    for name in dict.fromkeys((*ids, *layers)):
        if name in layers:
            yield layers[name]


def is_same(first: Path, second: Path) -> bool:
    """Return whether two paths name the same file, which need not exist."""
    return _normal(first) == _normal(second)


def _normal(path: Path) -> Path:
    return Path(os.path.normcase(os.path.realpath(path)))


def count_replaced(places: Iterable[Path]) -> None:
    """Count that a run may replace some point clouds, or those in some folders."""
    paths = [
        path for place in places for path in ([*place.iterdir()] if place.is_dir() else [place])
    ]
    for file in {_normal(path) for path in paths if path.suffix.lower() in _KEPT_BY_QGIS}:
        if file.is_file():
            _REPLACED[file] = _REPLACED.get(file, 0) + 1


def times_replaced(file: Path) -> int:
    """Return how often a file was replaced since QGIS was started."""
    return _REPLACED.get(_normal(file), 0)


def fresh_path(path: str) -> str:
    """Return a COPC file under a path that QGIS has not used for its earlier contents."""
    # QGIS keeps points that it has shown, by the path of their file and the filter of the layer. It
    # does not notice that the file was replaced: also a new layer would show the old points. So "."
    # is put before some names in the path, as a binary number.
    if not path.lower().endswith(".copc.laz"):
        return path
    parts, number = Path(path).as_posix().split("/"), times_replaced(Path(path))
    for place in range(len(parts) - 1, 0, -1):
        if number & 1:
            parts.insert(place, ".")
        number >>= 1
    return "/".join(parts)


def show_fresh_points(layer: QgsMapLayer) -> None:
    """Give a virtual point cloud that was replaced, whose files have the same paths as before, a
    new filter, which all points pass; see `fresh_path`.
    """
    if layer.providerType() != "vpc":
        return
    number, own = times_replaced(Path(layer.source())), filter_of(layer)
    if number:
        fresh = f"{_PASSED}{number}"
        layer.setSubsetString(f"({own}) AND {fresh}" if own else fresh)


def filter_of(layer: QgsMapLayer | None) -> str:
    """Return the filter that the user gave to a layer; empty without a filter."""
    # Point cloud layers have filters since QGIS 3.26.
    found = ""
    if layer is not None and hasattr(layer, "subsetString"):
        found = layer.subsetString()
    own, passed, _ = found.rpartition(_PASSED)
    return own.removesuffix(" AND ").removeprefix("(").removesuffix(")") if passed else found


def group_of(project: QgsProject, sources: Sequence[Source]) -> QgsLayerTreeGroup | None:
    """Return the group of the first of these layers that is in one."""
    root = project.layerTreeRoot()
    for source in sources:
        node = root.findLayer(source.layer)
        if node is not None and node.parent() not in (None, root):
            return node.parent()
    return None


def edited(project: QgsProject | None, sources: Iterable[Source]) -> str:
    """Return the name of a layer with edits that are not saved, or an empty text."""
    for source in sources:
        layer = project.mapLayer(source.layer) if project else None
        if layer is not None and has_edits(layer):
            return layer.name()
    return ""


def has_edits(layer: QgsMapLayer) -> bool:
    """Return whether a layer has edits that are not saved."""
    # Point clouds can be edited since QGIS 3.42.
    return hasattr(layer, "isModified") and layer.isEditable() and layer.isModified()


def release(project: QgsProject, sources: Iterable[Source]) -> None:
    """Let layers close their files, so that they can be replaced; `reload` opens them again."""
    for source in sources:
        layer = project.mapLayer(source.layer)
        if layer is not None:
            _close(layer)
            layer.setDataSource("", layer.name(), source.provider)


def reload(
    project: QgsProject,
    sources: Iterable[Source],
    dresses: Mapping[Path, Callable[[QgsMapLayer], None]],
) -> None:
    """Open the files of layers again, with the extent, statistics and styles of the new contents;
    layers without a dress keep their style.
    """
    known = {_normal(path): dress for path, dress in dresses.items()}
    for source in sources:
        layer = project.mapLayer(source.layer)
        if layer is None or has_edits(layer):
            continue
        _close(layer)
        uri = fresh_path(str(source.path)) if source.provider == "copc" else source.uri
        # QGIS forgets both.
        metadata, own = layer.metadata(), filter_of(layer)
        layer.setDataSource(uri, layer.name(), source.provider)
        layer.setMetadata(metadata)
        if own:
            layer.setSubsetString(own)
        show_fresh_points(layer)
        dress = known.get(_normal(source.path))
        if dress is not None and layer.isValid():
            dress(layer)
        layer.triggerRepaint()


def _close(layer: QgsMapLayer) -> None:
    """Close what the provider of a layer keeps open for later, such as connections."""
    provider = layer.dataProvider()
    if provider is not None and isinstance(layer, QgsVectorLayer):
        provider.reloadData()


def in_main_thread() -> bool:
    """Return whether this is the thread of the window; models run their steps in others."""
    application = QCoreApplication.instance()
    return application is None or QThread.currentThread() == application.thread()


def later(work: Callable[[], None]) -> None:
    """Call a function in the main thread: at once if this is it, or when it is free."""
    if in_main_thread():
        work()
        return
    caller = _Caller(work)
    _WAITING.append(caller)
    caller.moveToThread(QCoreApplication.instance().thread())
    caller.asked.emit()


def now(work: Callable[[], None]) -> None:
    """Call a function in the main thread and wait for it, unless that thread is busy for long."""
    # It may wait for the caller itself, as scripts do that run a task: then nothing is called.
    if in_main_thread():
        work()
        return
    lock, called, waits = threading.Lock(), threading.Event(), [True]

    def call() -> None:
        with lock:
            if waits:
                work()
            called.set()

    later(call)
    if not called.wait(_PATIENCE):
        with lock:
            waits.clear()


class _Caller(QObject):
    """Calls a function in the thread that this object was moved to."""

    asked = pyqtSignal()

    def __init__(self, work: Callable[[], None]) -> None:
        super().__init__()
        self._work = work
        self.asked.connect(self._call, Qt.ConnectionType.QueuedConnection)

    # As a slot: otherwise PyQt would call it in the thread of the connection.
    @pyqtSlot()  # type: ignore[untyped-decorator]
    def _call(self) -> None:
        _WAITING.remove(self)
        self._work()


# Python would delete them before they are called.
_WAITING: list[_Caller] = []
