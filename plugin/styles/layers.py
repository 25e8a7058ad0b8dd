"""The layers of a run: style, name, and place in the group of the run."""

from __future__ import annotations

from functools import partial
from typing import Any, Callable, Iterable, Mapping, NamedTuple

from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsMapLayer,
    QgsMapLayerLegendUtils,
    QgsPointCloudLayer,
    QgsProcessingContext,
    QgsProcessingFeedback,
    QgsProcessingLayerPostProcessorInterface,
    QgsProject,
    QgsRasterLayer,
)

from ...algorithms.crs.system import unit_symbol
from ...algorithms.rasters import looks
from ...algorithms.tools.contours import Interval
from ...algorithms.tools.quality.rasters import QUALITY_RASTERS
from ...algorithms.tools.rasters.rows import RASTERS
from ..i18n import mark, tr
from . import clouds, rasters, vectors
from .loaded import fresh_path, show_fresh_points
from .metadata import Origin, describe
from .stage import LayerStage, remember_height

# QGIS calls post-processors after the algorithm was deleted. It owns only their C++ objects, so
# their Python objects are kept here.
_KEPT: list[QgsProcessingLayerPostProcessorInterface] = []


# Values of `Look.hides` for a classified cloud.
CLOUD = 6
BELOW_TERRAIN = 4  # in runs whose result is the terrain
_FIRST = 9


# Coordinates in metres at an unknown place. QGIS transforms those of a project to
# longitude and latitude, and shows an error if it cannot, as with a local CRS (LOCAL_CS).
_LOCAL = (
    'PROJCS["Local coordinates in metres",GEOGCS["unknown",DATUM["unknown",'
    'SPHEROID["sphere",6371000,0]],PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],'
    'PROJECTION["Equirectangular"],UNIT["metre",1]]'
)


class LayerLook(NamedTuple):
    """Title, place and style of a layer."""

    title: str  # in the group of the run, which has the name of the input
    height: int  # in the group; the greatest is on top
    dress: Callable[[QgsMapLayer], None]  # sets the style of a layer, in the main thread
    # of the layers that hide each other, only that with the greatest is visible; 0: none
    hides: int = 0
    # what colours mean, in the user's language; empty for rasters, whose files state it
    shows: str = ""
    origin: Origin | None = None  # the run that made it; set by `arrange`
    has_legend: bool = True


def _drawn(title: str, look: looks.Look) -> LayerLook:
    """Return the look of a raster that is drawn as its row says."""
    dress, has_legend = (
        partial(rasters.draw, look.style),
        not isinstance(look.style, looks.PictureStyle),
    )
    return LayerLook(title, look.height, dress, look.hides, has_legend=has_legend)


_SURFACE = RASTERS["dsm"].look
# The only layer of its run, shown on top of other layers.
BARE = _drawn(mark("Without objects"), _SURFACE._replace(height=1, hides=0))
WATER = LayerLook(mark("Water"), 9, vectors.water)
BREAKLINES = LayerLook(mark("Breaklines"), 10, vectors.breaklines)
LOW_CONFIDENCE = LayerLook(mark("Low confidence areas"), 8, vectors.low_confidence)
PLACES = LayerLook(mark("Places to review"), 10, vectors.places)
_EVEN = looks.Ramp(looks.CHANGES, is_even=True, least=2.0)
CHANGE = _drawn(mark("Change of the ground"), looks.Look(_EVEN, 5, 1))
CANOPY_CHANGE = _drawn(mark("Change of the canopy"), looks.Look(_EVEN, 5, 1))
LIMIT = _drawn(mark("Detection limit"), looks.Look(looks.Ramp(looks.ERRORS, low=0.0), 4, 1))
CHANGED = LayerLook(mark("Places of change"), 10, vectors.changes)
# Beside those of `RASTERS`.
_OTHERS = {
    "ERROR_MAP": _drawn(mark("Errors"), looks.Look(looks.Ramp(looks.ERRORS, 0.0, 1.0), 6, 1)),
    "TERRAIN_WITH_BUILDINGS": _drawn(mark("Terrain with buildings"), _SURFACE),
}
# Of outputs of tools that are not rasters with a row, by the names in their declarations.
_LOOKS: dict[str, LayerLook | Callable[[Any], LayerLook]] = {
    "without objects": BARE,
    "water": WATER,
    "breaklines": BREAKLINES,
    "places": PLACES,
    "low confidence": LOW_CONFIDENCE,
    "change": CHANGE,
    "canopy change": CANOPY_CHANGE,
    "detection limit": LIMIT,
    "places of change": CHANGED,
    "contours": lambda found: contours(found),
    "residuals": lambda found: residuals(found.scale),
}


def raster_looks() -> dict[str, LayerLook]:
    """Return the looks of all rasters, by the names of their fields."""
    rows = {name.upper(): _drawn(row.title, row.look) for name, row in RASTERS.items()}
    return {**rows, **_OTHERS}


def look_of(name: str, found: Any = None) -> LayerLook:
    """Return the look with the name of a raster, or of `_LOOKS`, which may depend on the result of
    a tool.
    """
    if name in _LOOKS:
        look = _LOOKS[name]
        return look if isinstance(look, LayerLook) else look(found)
    row = RASTERS.get(name) or QUALITY_RASTERS[name]
    return _drawn(row.title, row.look)


def in_crs(look: LayerLook, crs: QgsCoordinateReferenceSystem) -> LayerLook:
    """Return the look of a point cloud whose file does not state its CRS, or a wrong one."""

    def dress(layer: QgsMapLayer) -> None:
        if isinstance(layer, QgsPointCloudLayer):
            layer.setCrs(crs)
        look.dress(layer)

    return look._replace(dress=dress)


def first(look: LayerLook) -> LayerLook:
    """Return the look of a layer that is visible at first, before all others that hide it."""
    return look._replace(hides=_FIRST) if look.hides else look


CLASSES = mark("Classes")


def classes(values: Iterable[int], title: str = CLASSES, hides: int = CLOUD) -> LayerLook:
    """Return the look of a classified cloud."""
    return LayerLook(title, 7, clouds.by_class(values), hides)


def class_raster(values: Iterable[int], hides: int = CLOUD) -> LayerLook:
    """Return the look of a raster of classes."""
    return LayerLook(CLASSES, 7, rasters.classes(clouds.categories_of(values)), hides)


def heights(attribute: str, highest: float, unit_size: float) -> LayerLook:
    """Return the look of a cloud with heights above ground; see `clouds.by_height`."""
    dress = clouds.by_height(attribute, highest, unit_size)
    shows = f"{tr('Height above ground')}, {unit_symbol(unit_size)}"
    return LayerLook(mark("Height above ground"), 7, dress, CLOUD, shows)


def contours(interval: Interval) -> LayerLook:
    """Return the look of contour lines."""
    return LayerLook(mark("Contour lines"), 9, vectors.contours(interval))


def residuals(scale: float) -> LayerLook:
    """Return the look of errors at checkpoints; see `vectors.residuals`."""
    return LayerLook(mark("Errors at checkpoints"), 10, vectors.residuals(scale))


def arrange(
    context: QgsProcessingContext,
    looks: Mapping[str, LayerLook],
    labels: Mapping[str, str],
    subject: str,
    stage: LayerStage,
    origin: Origin,
) -> None:
    """Give names, and looks by path, to the layers of a run, and a group if there are several."""
    # Layers that show the same files already are reloaded. They keep their names and places. A
    # layer with another name than QGIS gives it (`labels`) got it from a model. It keeps this name,
    # and is not put into the group. Steps of models set the origin of their layers before.
    project = context.project()
    titles = {path: label for path, label in labels.items() if path not in looks}
    looks = {path: look._replace(origin=look.origin or origin) for path, look in looks.items()}
    dresses = {path: partial(_dress, look, subject) for path, look in looks.items()}
    stage.reload({path: partial(dress, project) for path, dress in dresses.items()})
    looks = {path: look for path, look in looks.items() if context.willLoadLayerOnCompletion(path)}
    shown = max((look.hides for look in looks.values()), default=0)
    new = _new(context, looks, stage)
    titles.update((path, tr(look.title)) for path, look in new.items())
    named = _name(context, titles, labels, subject, stage)
    is_grouped = stage.is_old or len(new) - len(named & set(new)) > 1
    for path, look in new.items():
        details, is_named = context.layerToLoadOnCompletionDetails(path), path in named
        is_native = hasattr(details, "groupName") and not stage.is_old  # 3.32
        place = None if is_named or not is_grouped else stage
        if is_native and place:
            details.groupName, details.layerSortKey, place = stage.group, look.height, None
        processor = _Show(look, subject, place, is_named or look.hides in (0, shown))
        _KEPT.append(processor)
        details.setPostProcessor(processor)


def _name(
    context: QgsProcessingContext,
    titles: Mapping[str, str],
    labels: Mapping[str, str],
    subject: str,
    stage: LayerStage,
) -> set[str]:
    """Name layers by their titles, unless a model has named them, and return the renamed ones."""
    # Boxes in which layers are chosen show no groups: names say which input and run they belong to.
    loaded = [path for path in titles if context.willLoadLayerOnCompletion(path)]
    details = {path: context.layerToLoadOnCompletionDetails(path) for path in loaded}
    named = {path for path in loaded if details[path].name not in ("", labels.get(path, ""))}
    named &= set(labels)
    ours = [path for path in loaded if path not in named]
    source = stage.free_source(subject, [titles[path] for path in ours])
    for path in ours:
        details[path].name, details[path].forceName = f"{source}: {titles[path]}", True
    return named


def _new(
    context: QgsProcessingContext, looks: Mapping[str, LayerLook], stage: LayerStage
) -> dict[str, LayerLook]:
    """Return the layers that the project does not have yet; QGIS will load only these."""
    layers, new = context.layersToLoadOnCompletion(), {}
    for path, look in looks.items():
        details = layers.pop(path)
        if not stage.shows(path):
            new[fresh_path(path)] = look
            layers[fresh_path(path)] = details
    context.setLayersToLoadOnCompletion(layers)
    return new


def looks_of(context: QgsProcessingContext) -> dict[str, LayerLook]:
    """Return the looks of layers that steps of a model have arranged, by path."""
    loaded = context.layersToLoadOnCompletion()
    shows = {path: details.postProcessor() for path, details in loaded.items()}
    return {path: show.look for path, show in shows.items() if isinstance(show, _Show)}


class _Show(QgsProcessingLayerPostProcessorInterface):
    """Gives a new layer its style, and its place unless QGIS itself has put it there."""

    def __init__(
        self, look: LayerLook, subject: str, stage: LayerStage | None, is_visible: bool
    ) -> None:
        super().__init__()
        self.look, self._subject = look, subject
        self._stage, self._is_visible = stage, is_visible

    def postProcessLayer(
        self, layer: QgsMapLayer, context: QgsProcessingContext, feedback: QgsProcessingFeedback
    ) -> None:
        """Set style and place; QGIS calls this in the main thread."""
        project = context.project() or layer.project()
        remember_height(layer, self.look.height)
        node = project.layerTreeRoot().findLayer(layer.id()) if project else None
        if node is not None and self._stage is not None:
            node = self._stage.place(node, self.look.height)
        show_fresh_points(layer)
        _dress(self.look, self._subject, project, layer)
        if project is not None:
            _leave_degrees(project)
        if node is not None:
            node.setItemVisibilityChecked(self._is_visible)
            node.setExpanded(self._is_visible and self.look.has_legend)


def _leave_degrees(project: QgsProject) -> None:
    """Let a project in degrees count in metres, as the runs did, if no layer has a CRS."""
    # That of a new project is in degrees. Metres taken for these make scales of 1:500,000,000, and
    # points of a size in metres that take minutes to draw. Without any CRS, QGIS also takes
    # degrees.
    has_none = not any(layer.crs().isValid() for layer in project.mapLayers().values())
    if has_none and project.crs().isGeographic():
        project.setCrs(QgsCoordinateReferenceSystem.fromWkt(_LOCAL))
        project.setEllipsoid("NONE")  # lengths are those of the coordinates


def _dress(look: LayerLook, subject: str, project: QgsProject | None, layer: QgsMapLayer) -> None:
    """Set style and metadata of a layer, and the text of its legend."""
    look.dress(layer)
    if look.origin is not None:
        describe(layer, f"{subject}: {tr(look.title)}", look.origin)
    layer.triggerRepaint()
    node = project.layerTreeRoot().findLayer(layer.id()) if project else None
    shown = rasters.shown_by(layer) if isinstance(layer, QgsRasterLayer) else look.shows
    if node is not None and not look.has_legend:
        # Its grey values mean nothing by themselves.
        QgsMapLayerLegendUtils.setLegendNodeOrder(node, [])
        layer.legendChanged.emit()
    elif node is not None and shown:
        # Instead of "Band 1 (Gray)", or the name of the attribute.
        QgsMapLayerLegendUtils.setLegendNodeUserLabel(node, 0, shown)
        layer.legendChanged.emit()
