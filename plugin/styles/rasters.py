"""How rasters look: each kind of them with its own colours and legend."""

from __future__ import annotations

import math
from typing import Callable, Mapping

import numpy as np
from osgeo import gdal
from qgis.core import (
    QgsBasicNumericFormat,
    QgsColorRampLegendNodeSettings,
    QgsColorRampShader,
    QgsContrastEnhancement,
    QgsPalettedRasterRenderer,
    QgsRasterLayer,
    QgsSingleBandGrayRenderer,
    QgsSingleBandPseudoColorRenderer,
)
from qgis.PyQt.QtGui import QColor, QPainter

from .. import compat
from ..i18n import mark, tr
from . import ramps

_MULTIPLY = QPainter.CompositionMode.CompositionMode_Multiply
# Shares of the cells below and above those that the colours spread over, and how many cells of a
# row, and rows, are looked at.
_LOW, _HIGH, _SAMPLE = 0.02, 0.98, 600
# The light of a hillshade from where it is black to where it is white: level land is nearly white,
# so that colours over it stay what they are in the legend.
_DARK, _BRIGHT = 20.0, 210.0
_LEAST_RANGE = 0.5
# What bands say that they show, besides units.
SHOWN = (
    mark("Height"), mark("Height above ground"), mark("Local relief"),
    mark("Confidence"), mark("Share of wrong points"), mark("Brightness"), mark("Class"),
    mark("0 to 1"), mark("1 to 255"),
)  # fmt: skip


def shown_by(layer: QgsRasterLayer) -> str:
    """Return what a raster shows, as its file says it, in the user's language; empty if nothing."""
    raster = gdal.Open(layer.source())
    said = raster.GetRasterBand(1).GetDescription()
    return ", ".join(tr(each) if each in SHOWN else each for each in said.split(", "))


def unit_of(path: str) -> str:
    """Return the symbol of the unit that a raster of ours says its heights have."""
    raster = gdal.Open(path)
    return raster.GetRasterBand(1).GetDescription().partition(", ")[2]


def terrain(layer: QgsRasterLayer) -> None:
    """Colour heights from low to high; what lies below, the hillshade, shines through."""
    _spread(layer, ramps.TERRAIN, *_cut(layer))
    layer.setBlendMode(_MULTIPLY)
    compat.mark_as_elevation(layer)


def surface(layer: QgsRasterLayer) -> None:
    """Colour heights of a surface."""
    _spread(layer, ramps.SURFACE, *_cut(layer))
    compat.mark_as_elevation(layer)


def canopy(layer: QgsRasterLayer) -> None:
    """Colour heights above ground; bare ground is clear."""
    _spread(layer, ramps.CANOPY, 0.0, _cut(layer)[1])


def confidence(layer: QgsRasterLayer) -> None:
    """Colour what is not sure; what is stays clear."""
    _spread(layer, ramps.CONFIDENCE, 0.0, 1.0)


def errors(layer: QgsRasterLayer) -> None:
    """Colour shares of wrong points; cells without one are clear."""
    _spread(layer, ramps.ERRORS, 0.0, 1.0)


def local_relief(layer: QgsRasterLayer) -> None:
    """Colour what stands above its surroundings, and lies below, by the same steps."""
    largest = max(map(abs, _cut(layer)))
    _spread(layer, ramps.RELIEF, -largest, largest)


def hillshade(layer: QgsRasterLayer) -> None:
    """Shade in grey, bright where the land is level."""
    renderer = QgsSingleBandGrayRenderer(layer.dataProvider(), 1)
    contrast = QgsContrastEnhancement(layer.dataProvider().dataType(1))
    contrast.setMinimumValue(_DARK)
    contrast.setMaximumValue(_BRIGHT)
    stretch = QgsContrastEnhancement.ContrastEnhancementAlgorithm.StretchToMinimumMaximum
    contrast.setContrastEnhancementAlgorithm(stretch)
    renderer.setContrastEnhancement(contrast)
    layer.setRenderer(renderer)


def classes(categories: Mapping[int, tuple[str, QColor]]) -> Callable[[QgsRasterLayer], None]:
    """Return what gives each class of a raster its name and colour."""

    def dress(layer: QgsRasterLayer) -> None:
        entries = [
            QgsPalettedRasterRenderer.Class(value, colour, label)
            for value, (label, colour) in categories.items()
        ]
        layer.setRenderer(QgsPalettedRasterRenderer(layer.dataProvider(), 1, entries))
        layer.setBlendMode(_MULTIPLY)

    return dress


def _cut(layer: QgsRasterLayer) -> tuple[float, float]:
    """Return the heights between which all but the few lowest and highest cells lie.

    QGIS's own asks GDAL for a histogram, which GDAL keeps beside the file: one that takes the place
    of another would get the limits of that.
    """
    raster = gdal.Open(layer.source())
    band = raster.GetRasterBand(1)
    size = (min(each, _SAMPLE) for each in (band.XSize, band.YSize))
    values = band.ReadAsArray(0, 0, band.XSize, band.YSize, *size)
    values = values[np.isfinite(values) & (values != band.GetNoDataValue())]
    low, high = np.quantile(values, (_LOW, _HIGH)).tolist() if values.size else (0.0, 0.0)
    # Level land stays of one colour: millimetres of noise are no relief.
    return (low, high) if high - low >= _LEAST_RANGE else (low, low + _LEAST_RANGE)


def _spread(layer: QgsRasterLayer, stops: ramps.Stops, low: float, high: float) -> None:
    renderer = QgsSingleBandPseudoColorRenderer(layer.dataProvider(), 1)
    renderer.setClassificationMin(low)
    renderer.setClassificationMax(high)
    interpolated = QgsColorRampShader.Type.Interpolated
    renderer.createShader(ramps.ramp_of(stops), interpolated)
    shader = renderer.shader().rasterShaderFunction()
    shader.setLegendSettings(_legend(high - low))
    layer.setRenderer(renderer)


def _legend(extent: float) -> QgsColorRampLegendNodeSettings:
    """Return a legend whose numbers have no more digits than tell them apart."""
    numbers = QgsBasicNumericFormat()
    numbers.setNumberDecimalPlaces(max(0, 2 - math.floor(math.log10(extent))))
    numbers.setShowTrailingZeros(False)
    settings = QgsColorRampLegendNodeSettings()
    settings.setNumericFormat(numbers)
    return settings
