"""Where the layers of a run belong: the group, and the layers that show the same files already."""

from __future__ import annotations

from pathlib import Path
from typing import Callable, Iterable, Mapping

from qgis.core import (
    QgsLayerTreeGroup,
    QgsLayerTreeLayer,
    QgsMapLayer,
    QgsProcessingContext,
    QgsProject,
    QgsSettings,
)

from ...algorithms.core.errors import BareEarthError
from ..i18n import tr
from . import loaded

_HEIGHT = "bare_earth/height"


class LayerStage:
    """The place of a run in the project, found before the run; an error says if a layer of its
    files has edits that are not saved.
    """

    # A number is added to the name of a new group if there is such a group. `places` are files and
    # folders that the run may write. If `is_in_place`, steps of other programs write into old
    # files, which layers must not have open then.

    def __init__(
        self,
        context: QgsProcessingContext,
        name: str,
        places: Iterable[Path],
        is_in_place: bool = False,
    ) -> None:
        self._project, self._places = context.project(), list(places)
        loaded.count_replaced(self._places)
        # Steps of models run in other threads, where the project cannot be read.
        is_main = loaded.in_main_thread()
        self._sources = loaded.sources_of(self._project, self._places) if is_main else []
        layers = self._project.mapLayers().values() if self._project and is_main else ()
        self._names = {layer.name() for layer in layers}
        title = loaded.edited(self._project, self._sources)
        if title:
            text = tr('The layer "{}" is being edited. Save or discard the edits first.')
            raise BareEarthError(text.format(title))
        # whether layers of an earlier run are in a group that gets new ones
        self.is_old = bool(self._sources) and self._old_group() is not None
        # for new layers, unless layers of an earlier run are in one
        self.group = name if self.is_old or not is_main else free_name(self._project, name)
        self._released = self._sources
        if loaded.MUST_RELEASE or is_in_place:
            loaded.now(self._release)

    def _release(self) -> None:
        """Let layers of the files close these, unless they are being edited; in the main thread."""
        if self._project is not None:
            sources = loaded.sources_of(self._project, self._places)
            if not loaded.edited(self._project, sources):
                self._released = sources
                loaded.release(self._project, sources)

    def free_source(self, source: str, titles: Iterable[str]) -> str:
        """Return the name of the input for those of layers with some titles, with a number if
        layers of an earlier run have these names.
        """
        titles = list(titles)
        numbered = (source, *(f"{source} ({number})" for number in range(2, 10_000)))
        free = (name for name in numbered if not {f"{name}: {t}" for t in titles} & self._names)
        return next(free, source)

    def shows(self, path: str) -> bool:
        """Return whether a layer of the project shows a file already."""
        return any(loaded.is_same(Path(path), source.path) for source in self._sources)

    def reload(self, dresses: Mapping[str, Callable[[QgsMapLayer], None]]) -> None:
        """Reload the layers that show files of the run, and dress them; any thread may."""
        project, places, released = self._project, self._places, self._released
        styles = {Path(path): dress for path, dress in dresses.items()}
        if project is None:
            return

        def reload() -> None:
            # Layers that were released have no file now; others may have come since.
            now = loaded.sources_of(project, places)
            sources = {source.layer: source for source in (*now, *released)}
            loaded.reload(project, sources.values(), styles)

        loaded.later(reload)

    def place(self, node: QgsLayerTreeLayer, height: int) -> QgsLayerTreeLayer:
        """Move a layer to its place in the group, which is made if needed; return its new node."""
        group = self._old_group() if self.is_old else None
        return _moved(node, group or _group_of(node, self.group), height)

    def _old_group(self) -> QgsLayerTreeGroup | None:
        return loaded.group_of(self._project, self._sources)


def remember_height(layer: QgsMapLayer, height: int) -> None:
    """Store the place of a layer among those of its run."""
    layer.setCustomProperty(_HEIGHT, height)


def free_name(project: QgsProject | None, name: str) -> str:
    """Return a name that no group of the project has yet; only in the main thread."""
    if project is None:
        return name
    root = project.layerTreeRoot()
    names = (name, *(f"{name} ({number})" for number in range(2, 10_000)))
    return next((free for free in names if root.findGroup(free) is None), name)


def _moved(node: QgsLayerTreeLayer, group: QgsLayerTreeGroup, height: int) -> QgsLayerTreeLayer:
    copy = node.clone()
    group.insertChildNode(_place_in(group, node, height), copy)
    node.parent().removeChildNode(node)
    return copy


def _group_of(node: QgsLayerTreeLayer, name: str) -> QgsLayerTreeGroup:
    """Return the group with this name; make it on top of the tree, or in the user's group."""
    home = node
    while home.parent() is not None:
        home = home.parent()
    chosen = QgsSettings().value("Processing/Configuration/RESULTS_GROUP_NAME", "")
    home = home.findGroup(chosen) if chosen and home.findGroup(chosen) else home
    return home.findGroup(name) or home.insertGroup(0, name)


def _place_in(group: QgsLayerTreeGroup, node: QgsLayerTreeLayer, height: int) -> int:
    """Return the index of the first layer that must be below, or -1 for the end."""
    # The node itself is skipped: QGIS may have put it into the group already, in another place.
    for place, child in enumerate(group.children()):
        layer = child.layer() if hasattr(child, "layer") else None
        if child != node and layer and int(layer.customProperty(_HEIGHT, 0)) < height:
            return place
    return -1
