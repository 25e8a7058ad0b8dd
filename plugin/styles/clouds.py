"""How point clouds look: by class, ground in front of all, or by height."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Callable, Iterable

import numpy as np
from qgis.core import (
    Qgis,
    QgsColorRampShader,
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
from . import ramps

_GROUND = 2
# Brown of the ground, light enough for a hillshade below; QGIS's is dark. What says no more than
# "not ground" is faint.
_COLOURS = {
    0: "#8c9aa5b1", 1: "#8c9aa5b1", _GROUND: "#d2a368", 6: "#d9736a", 8: "#8f5a1e", 9: "#5fb4e5",
}  # fmt: skip
_METRES, _LEAST_MM, _MOST_MM = 0.6, 0.8, 2.0
# Millimetres between points below which no more are drawn: more than QGIS's 0.3 show as holes.
_SCREEN_ERROR = 0.15
# By the LAS specification, with no meaning yet; and of those a rare one.
_RESERVED = (0, 8, 12, 16)
# Metres up to which heights are coloured, where it is not known up to which nearly all points are.
_MOST_HEIGHT = 40.0
_NEARLY_ALL, _STEP = 0.998, 0.5


def categories_of(classes: Iterable[int]) -> dict[int, tuple[str, QColor]]:
    """Return name and colour of each class, ground first."""
    known = {each.value(): each for each in QgsPointCloudClassifiedRenderer.defaultCategories()}
    found = {}
    for value in sorted(classes, key=lambda each: (each != _GROUND, each)):
        # One without a usual colour gets one that differs with its number.
        label, colour = f"{value}", QColor.fromHsv(47 * value % 360, 140, 200)
        if value in known:
            label, colour = known[value].label(), known[value].color()
        found[value] = label, QColor(_COLOURS.get(value, colour))
    return found


def usual_classes(ground_class: int = _GROUND) -> list[int]:
    """Return the classes of lidar, for clouds whose own are not known."""
    known = (each.value() for each in QgsPointCloudClassifiedRenderer.defaultCategories())
    return sorted({each for each in known if each not in _RESERVED} | {ground_class})


def by_class(classes: Iterable[int]) -> Callable[[QgsPointCloudLayer], None]:
    """Return what colours a cloud by class.

    Parameters
    ----------
    classes : iterable of int
        The classes to show: QGIS would list all that there could be, and hide those above 18.
    """
    wanted = categories_of(classes)

    def dress(layer: QgsPointCloudLayer) -> None:
        renderer = QgsPointCloudClassifiedRenderer()
        renderer.setAttribute("Classification")
        categories = [
            QgsPointCloudCategory(value, colour, label) for value, (label, colour) in wanted.items()
        ]
        renderer.setCategories(categories)
        _scale(renderer)
        if hasattr(renderer, "setDrawOrder2d"):  # 3.26
            # The lowest last, so that ground is seen below trees, not trees above ground.
            renderer.setDrawOrder2d(Qgis.PointCloudDrawOrder.TopToBottom)
        layer.setRenderer(renderer)
        # Relief shows through, where there is a hillshade below.
        layer.setBlendMode(QPainter.CompositionMode.CompositionMode_Multiply)

    return dress


def by_height(
    attribute: str, highest: float, unit_size: float = 1.0
) -> Callable[[QgsPointCloudLayer], None]:
    """Return what colours a cloud by heights above ground, in the unit of the CRS.

    Parameters
    ----------
    attribute : str
        What holds them.
    highest : float
        The highest of them. Birds are left out of the colours: in a COPC file, for its uppermost
        node holds some points from everywhere.
    unit_size : float
        Metres in that unit.
    """
    most = min(highest, _MOST_HEIGHT / unit_size)

    def dress(layer: QgsPointCloudLayer) -> None:
        renderer = QgsPointCloudAttributeByRampRenderer()
        renderer.setAttribute(attribute)
        is_copc = layer.dataProvider() is not None and layer.dataProvider().name() == "copc"
        high = _usual_height(layer.source(), attribute) if is_copc else most
        # In steps, for the legend.
        high = max(math.ceil(high / _STEP) * _STEP, _STEP)
        renderer.setMinimum(0.0)
        renderer.setMaximum(high)
        shader = QgsColorRampShader(0.0, high, ramps.ramp_of(ramps.HEIGHTS))
        shader.classifyColorRamp()
        renderer.setColorRampShader(shader)
        _scale(renderer)
        if hasattr(renderer, "setDrawOrder2d"):
            renderer.setDrawOrder2d(Qgis.PointCloudDrawOrder.BottomToTop)
        layer.setRenderer(renderer)

    return dress


def _usual_height(path: str, attribute: str) -> float:
    """Return the height below which nearly all points of the uppermost node of a COPC file lie."""
    values = sample_of(Path(path), "z" if attribute == "Z" else attribute)
    values = values[np.isfinite(values)]
    return float(np.quantile(values, _NEARLY_ALL)) if values.size else 0.0


def _scale(renderer: QgsPointCloudRenderer) -> None:
    """Let points grow with the scale of the map, as far as they neither vanish nor bulge."""
    units = Qgis.RenderUnit if hasattr(Qgis, "RenderUnit") else QgsUnitTypes.RenderUnit
    size = QgsMapUnitScale()
    size.minSizeMMEnabled = size.maxSizeMMEnabled = True
    size.minSizeMM, size.maxSizeMM = _LEAST_MM, _MOST_MM
    metres = "MetersInMapUnits" if hasattr(units, "MetersInMapUnits") else "RenderMetersInMapUnits"
    renderer.setPointSizeUnit(getattr(units, metres))
    renderer.setPointSize(_METRES)
    renderer.setPointSizeMapUnitScale(size)
    renderer.setMaximumScreenError(_SCREEN_ERROR)
