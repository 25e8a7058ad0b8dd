"""The layers of a run: style, name, and place in the group of the run."""

from __future__ import annotations

from typing import Any, Callable, Iterable, Mapping, NamedTuple

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsLayerTreeGroup,
    QgsMapLayer,
    QgsMapLayerLegendUtils,
    QgsPointCloudLayer,
    QgsProcessingContext,
    QgsProcessingFeedback,
    QgsProcessingLayerPostProcessorInterface,
    QgsRasterLayer,
    QgsSettings,
)

from ...algorithms.crs.system import unit_symbol
from ...algorithms.products.contours import Interval
from ..i18n import mark, tr
from . import clouds, rasters, vectors

# QGIS calls post-processors after the algorithm was deleted. It owns only their C++ objects, so
# their Python objects are kept here.
_KEPT: list[QgsProcessingLayerPostProcessorInterface] = []


# Values of `Look.hides` for a classified cloud. The second is for runs whose result is the terrain.
CLOUD, BELOW_TERRAIN = 6, 4


class Look(NamedTuple):
    """Title, place and style of a layer.

    Attributes
    ----------
    title : str
        Its name, after the name of the input.
    height : int
        Its place in the group; the greatest is on top.
    dress : callable
        ``dress(layer)`` sets the style, in the main thread.
    hides : int
        Some layers hide each other. Of these, only the one with the greatest value is visible at
        first. 0 for a layer that hides nothing.
    shows : str
        Meaning of the colours, in the user's language; empty for rasters, whose files state it.
    """

    title: str
    height: int
    dress: Callable[[Any], None]
    hides: int = 0
    shows: str = ""


HILLSHADE = Look(mark("hillshade"), 0, rasters.hillshade)
TERRAIN = Look(mark("terrain model"), 1, rasters.terrain, 5)
# The only layer of its run, shown on top of other layers.
BARE = Look(mark("without objects"), 1, rasters.surface)
SURFACE = Look(mark("surface model"), 2, rasters.surface, 1)
CANOPY = Look(mark("canopy height"), 3, rasters.canopy, 3)
RELIEF = Look(mark("local relief"), 4, rasters.local_relief, 2)
CONFIDENCE = Look(mark("confidence"), 5, rasters.confidence, 1)
ERRORS = Look(mark("errors"), 6, rasters.errors, 1)
RASTERS = {
    "DTM": TERRAIN, "DSM": SURFACE, "CHM": CANOPY, "HILLSHADE": HILLSHADE,
    "CONFIDENCE": CONFIDENCE, "RELIEF": RELIEF, "ERROR_MAP": ERRORS,
}  # fmt: skip


def in_crs(look: Look, crs: QgsCoordinateReferenceSystem) -> Look:
    """Return the look of a point cloud whose file does not state its CRS, or a wrong one."""

    def dress(layer: Any) -> None:
        if isinstance(layer, QgsPointCloudLayer):
            layer.setCrs(crs)
        look.dress(layer)

    return look._replace(dress=dress)


CLASSES = mark("classes")


def classes(values: Iterable[int], title: str = CLASSES, hides: int = CLOUD) -> Look:
    """Return the look of a classified cloud."""
    return Look(title, 7, clouds.by_class(values), hides)


def class_raster(values: Iterable[int], hides: int = CLOUD) -> Look:
    """Return the look of a raster of classes."""
    return Look(CLASSES, 7, rasters.classes(clouds.categories_of(values)), hides)


def heights(attribute: str, highest: float, unit_size: float) -> Look:
    """Return the look of a cloud with heights above ground; see `clouds.by_height`."""
    dress = clouds.by_height(attribute, highest, unit_size)
    shows = f"{tr('Height above ground')}, {unit_symbol(unit_size)}"
    return Look(mark("height above ground"), 7, dress, CLOUD, shows)


def contours(interval: Interval) -> Look:
    """Return the look of contour lines."""
    return Look(mark("contour lines"), 8, vectors.contours(interval))


def arrange(
    context: QgsProcessingContext,
    looks: Mapping[str, Look],
    labels: Mapping[str, str],
    subject: str,
    group: str,
) -> None:
    """Give styles and names to the layers of a run, and a group if there are several.

    Parameters
    ----------
    context : QgsProcessingContext
        Holds the layers that QGIS will load.
    looks : mapping of str to Look
        The looks of the layers, by path.
    labels : mapping of str to str
        The names that QGIS gives to the layers, by path. A layer with another name got it from a
        model. It keeps this name, and is not put into the group.
    subject : str
        Name of the input.
    group : str
        Name of the group.
    """
    looks = {path: look for path, look in looks.items() if context.willLoadLayerOnCompletion(path)}
    shown = max((look.hides for look in looks.values()), default=0)
    named = {
        path
        for path in set(looks) & set(labels)
        if context.layerToLoadOnCompletionDetails(path).name not in ("", labels[path])
    }
    for path, look in looks.items():
        details = context.layerToLoadOnCompletionDetails(path)
        is_named = path in named
        place = "" if is_named or len(looks) - len(named) < 2 else group
        if not is_named:
            details.name, details.forceName = f"{subject}: {tr(look.title)}", True
        is_native = hasattr(details, "groupName")  # 3.32
        if is_native and place:
            details.groupName, details.layerSortKey = place, look.height
        processor = _Show(look, "" if is_native else place, is_named or look.hides in (0, shown))
        _KEPT.append(processor)
        details.setPostProcessor(processor)


def looks_of(context: QgsProcessingContext) -> dict[str, Look]:
    """Return the looks of layers that steps of a model have arranged, by path."""
    loaded = context.layersToLoadOnCompletion()
    shows = {path: details.postProcessor() for path, details in loaded.items()}
    return {path: each.look for path, each in shows.items() if isinstance(each, _Show)}


def free_name(context: QgsProcessingContext, name: str) -> str:
    """Return a name that no group of the project has yet; only in the main thread."""
    if context.project() is None:
        return name
    root = context.project().layerTreeRoot()
    names = (name, *(f"{name} ({number})" for number in range(2, 10_000)))
    return next((each for each in names if root.findGroup(each) is None), name)


class _Show(QgsProcessingLayerPostProcessorInterface):
    """Gives a loaded layer its style, and its place in the group before QGIS 3.32."""

    def __init__(self, look: Look, group: str, is_visible: bool) -> None:
        super().__init__()
        self.look, self._group, self._is_visible = look, group, is_visible

    def postProcessLayer(
        self, layer: QgsMapLayer, context: QgsProcessingContext, feedback: QgsProcessingFeedback
    ) -> None:
        """Set style and place; QGIS calls this in the main thread."""
        self.look.dress(layer)
        layer.triggerRepaint()
        project = context.project() or layer.project()
        node = project.layerTreeRoot().findLayer(layer.id()) if project else None
        if node is None:
            return
        if self._group:
            layer.setCustomProperty(_HEIGHT, self.look.height)
            node = _moved(node, self._group, self.look.height)
        shown = self.look.shows
        if isinstance(layer, QgsRasterLayer):
            shown = rasters.shown_by(layer)
        if shown:
            # Instead of "Band 1 (Gray)", or the name of the attribute.
            QgsMapLayerLegendUtils.setLegendNodeUserLabel(node, 0, shown)
            layer.legendChanged.emit()
        node.setItemVisibilityChecked(self._is_visible)
        node.setExpanded(self._is_visible and self.look is not HILLSHADE)


_HEIGHT = "bare_earth/height"


def _moved(node: Any, name: str, height: int) -> Any:
    """Move a layer to its place in a group, which is made if needed; return its new node."""
    group = _group_of(node, name)
    copy = node.clone()
    group.insertChildNode(_place_in(group, node, height), copy)
    node.parent().removeChildNode(node)
    return copy


def _group_of(node: Any, name: str) -> QgsLayerTreeGroup:
    """Return the group with this name; make it on top of the tree, or in the user's group."""
    home = node
    while home.parent() is not None:
        home = home.parent()
    chosen = QgsSettings().value("Processing/Configuration/RESULTS_GROUP_NAME", "")
    home = home.findGroup(chosen) if chosen and home.findGroup(chosen) else home
    return home.findGroup(name) or home.insertGroup(0, name)


def _place_in(group: QgsLayerTreeGroup, node: Any, height: int) -> int:
    """Return the index of the first layer that must be below, or -1 for the end.

    The node itself is skipped: QGIS may have put it into the group already, in another place.
    """
    for place, child in enumerate(group.children()):
        if child != node and int(child.layer().customProperty(_HEIGHT, 0)) < height:
            return place
    return -1
