"""Styles of point clouds, by class or by height, as they are seen from above."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Callable, Iterable

import numpy as np
from qgis.core import (
    Qgis,
    QgsColorRampShader,
    QgsGradientColorRamp,
    QgsGradientStop,
    QgsMapLayer,
    QgsMapUnitScale,
    QgsPointCloudAttributeByRampRenderer,
    QgsPointCloudCategory,
    QgsPointCloudClassifiedRenderer,
    QgsPointCloudLayer,
    QgsPointCloudRenderer,
    QgsUnitTypes,
)
from qgis.PyQt.QtGui import QColor, QPainter

from ...algorithms.las.copc_sample import sample_of
from ...algorithms.rasters.looks import HEIGHTS, Stops
from ..i18n import mark, tr

_GROUND = 2
# The brown of ground is lighter than that of QGIS, so that shades show. Classes that only mean "not
# ground" are faint, but opaque: the map has the colours of the legend whatever lies below. Only
# water is blue.
_COLOURS = {
    0: "#c8ced4", 1: "#c8ced4", _GROUND: "#d2a368", 3: "#c6d98c", 4: "#74b84a", 5: "#23803c",
    6: "#d9736a", 8: "#8f5a1e", 9: "#5fb4e5", 17: "#8a63b8", 19: "#e0c341", 20: "#a56f8d",
    21: "#e8eef2", 22: "#7d8794", 40: "#b0a06a", 41: "#2f7fc4", 42: "#0f5a6b", 43: "#4d5f8f",
    45: "#9ad0ee",
}  # fmt: skip
# QGIS calls these reserved, or knows none: they are of LAS 1.4 and its profile for bathymetry.
_NAMES = {
    8: mark("Model key point"), 12: mark("Overlap"), 19: mark("Overhead structure"),
    20: mark("Ignored ground"), 21: mark("Snow"), 22: mark("Temporal exclusion"),
    40: mark("Bathymetric bottom"), 41: mark("Water surface"), 42: mark("Derived water surface"),
    43: mark("Submerged object"), 45: mark("Water column"),
}  # fmt: skip
_OPACITY = 0.8
# Size of a point in metres on the map, and limits of it in millimetres on the screen.
_METRES = 0.6
_LEAST_MM = 0.8
_MOST_MM = 2.0
# QGIS draws no further points at this distance in millimetres. Its default of 0.3 leaves holes.
_SCREEN_ERROR = 0.15
# Classes that are reserved in the LAS specification, or rare.
_RESERVED = (0, 8, 12, 16)
# Heights are coloured up to this, in metres, if the usual height of the points is not known.
_MOST_HEIGHT = 40.0
# Share of the points below the largest height that has a colour of its own.
_NEARLY_ALL = 0.998
# This height is a multiple of it, in units of the CRS.
_STEP = 0.5


def categories_of(classes: Iterable[int]) -> dict[int, tuple[str, QColor]]:
    """Return the name and colour of each class, ground first."""
    known = {usual.value(): usual for usual in QgsPointCloudClassifiedRenderer.defaultCategories()}
    found = {}
    for value in sorted(classes, key=lambda number: (number != _GROUND, number)):
        # A class without usual colour gets a colour that depends on its number.
        label, colour = f"{value}", QColor.fromHsv(47 * value % 360, 140, 200)
        if value in known:
            label, colour = known[value].label(), known[value].color()
        label = tr(_NAMES[value]) if value in _NAMES else label
        found[value] = label, QColor(_COLOURS.get(value, colour))
    return found


def usual_classes(ground_class: int = _GROUND) -> list[int]:
    """Return the usual classes of lidar, for clouds whose classes are not known."""
    known = QgsPointCloudClassifiedRenderer.defaultCategories()
    classes = {category.value() for category in known} - {*_RESERVED}
    return sorted(classes | {ground_class})


def by_class(classes: Iterable[int]) -> Callable[[QgsPointCloudLayer], None]:
    """Return a function that colours a cloud by the classes given, as QGIS itself would list all
    usual classes, and hide those above 18.
    """
    wanted = categories_of(classes)

    def dress(layer: QgsPointCloudLayer) -> None:
        renderer = QgsPointCloudClassifiedRenderer()
        renderer.setAttribute("Classification")
        categories = [
            QgsPointCloudCategory(value, colour, label) for value, (label, colour) in wanted.items()
        ]
        renderer.setCategories(categories)
        _draw_from_above(renderer, layer)
        layer.setRenderer(renderer)
        show_through(layer)

    return dress


def ramp_of(stops: Stops) -> QgsGradientColorRamp:
    """Return a colour ramp that QGIS can show and users can change."""
    inner = [QgsGradientStop(place, QColor(colour)) for place, colour in stops[1:-1]]
    return QgsGradientColorRamp(QColor(stops[0][1]), QColor(stops[-1][1]), False, inner)


def show_through(layer: QgsMapLayer) -> None:
    """Let a hillshade below be just visible, as more, or a blend mode, would change the colours."""
    layer.setBlendMode(QPainter.CompositionMode.CompositionMode_SourceOver)
    layer.setOpacity(_OPACITY)


def by_height(
    attribute: str, highest: float, unit_size: float = 1.0
) -> Callable[[QgsPointCloudLayer], None]:
    """Return a function that colours a cloud by an attribute, heights above ground up to `highest`
    in the unit of the CRS, of `unit_size` metres.
    """
    # For COPC files a usual height is used instead of the greatest, so that birds do not stretch
    # the colours. It is found in the uppermost node, which has points from everywhere.
    most = min(highest, _MOST_HEIGHT / unit_size)

    def dress(layer: QgsPointCloudLayer) -> None:
        renderer = QgsPointCloudAttributeByRampRenderer()
        renderer.setAttribute(attribute)
        is_copc = layer.dataProvider() is not None and layer.dataProvider().name() == "copc"
        high = _usual_height(layer.source(), attribute) if is_copc else most
        # Rounded up, for the legend.
        high = max(math.ceil(high / _STEP) * _STEP, _STEP)
        renderer.setMinimum(0.0)
        renderer.setMaximum(high)
        shader = QgsColorRampShader(0.0, high, ramp_of(HEIGHTS))
        shader.classifyColorRamp()
        renderer.setColorRampShader(shader)
        _draw_from_above(renderer, layer)
        layer.setRenderer(renderer)

    return dress


def _usual_height(path: str, attribute: str) -> float:
    """Return a height above nearly all points in the uppermost node of a COPC file."""
    values = sample_of(Path(path), "z" if attribute == "Z" else attribute)
    values = values[np.isfinite(values)]
    return float(np.quantile(values, _NEARLY_ALL)) if values.size else 0.0


def _draw_from_above(renderer: QgsPointCloudRenderer, layer: QgsPointCloudLayer) -> None:
    """Draw the highest points last, and let points grow with the scale, between two sizes."""
    if hasattr(renderer, "setDrawOrder2d"):  # 3.26
        renderer.setDrawOrder2d(Qgis.PointCloudDrawOrder.BottomToTop)
    units = Qgis.RenderUnit if hasattr(Qgis, "RenderUnit") else QgsUnitTypes.RenderUnit
    size = QgsMapUnitScale()
    size.minSizeMMEnabled = size.maxSizeMMEnabled = True
    size.minSizeMM, size.maxSizeMM = _LEAST_MM, _MOST_MM
    # QGIS draws a layer without CRS in the units of the map, whatever they are. In a map in degrees
    # it would take a minute to find the size of a metre there.
    unit = "MetersInMapUnits" if layer.crs().isValid() else "MapUnits"
    renderer.setPointSizeUnit(getattr(units, unit if hasattr(units, unit) else f"Render{unit}"))
    renderer.setPointSize(_METRES)
    renderer.setPointSizeMapUnitScale(size)
    renderer.setMaximumScreenError(_SCREEN_ERROR)
