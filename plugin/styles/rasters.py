"""Styles of rasters: colours and legend for each kind."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Callable, Mapping

import numpy as np
from osgeo import gdal
from qgis.core import (
    QgsBasicNumericFormat,
    QgsColorRampLegendNodeSettings,
    QgsColorRampShader,
    QgsContrastEnhancement,
    QgsMultiBandColorRenderer,
    QgsPalettedRasterRenderer,
    QgsRasterLayer,
    QgsRasterShader,
    QgsSingleBandGrayRenderer,
    QgsSingleBandPseudoColorRenderer,
)
from qgis.PyQt.QtGui import QColor, QPainter

from ...algorithms.crs.system import unit_size
from ...algorithms.rasters.looks import Categories, ColourSteps, PictureStyle, Ramp, Stops, Style
from .. import compat
from ..i18n import tr
from . import clouds

_MULTIPLY = QPainter.CompositionMode.CompositionMode_Multiply
# Colours spread between these quantiles of a sample.
_LOW = 0.02
_HIGH = 0.98
_SAMPLE = 600  # most rows, and most columns, of it


def shown_by(layer: QgsRasterLayer) -> str:
    """Return the description of the band in the user's language; empty if it has no description."""
    said = _description(layer.source())
    return ", ".join(tr(part) or part for part in said.split(", "))


def is_class_raster(path: Path) -> bool:
    """Return whether a file is a raster of classes that this plugin made."""
    return path.suffix == ".tif" and _description(str(path)) == "Class"


def unit_of(path: str) -> str:
    """Return the symbol of the unit of heights, from the description of a band."""
    return _description(path).partition(", ")[2]


def _description(path: str) -> str:
    """Return the description of the first band of a file; empty if it is no raster."""
    raster = gdal.Open(path)
    return raster.GetRasterBand(1).GetDescription() if raster is not None else ""


def draw(style: Style, layer: QgsRasterLayer) -> None:
    """Draw a raster in a style."""
    if isinstance(style, Ramp):
        _spread(layer, style.stops, *_limits(layer, style))
        if style.multiplies:
            layer.setBlendMode(_MULTIPLY)
        if style.line:
            compat.mark_as_elevation(layer, style.line)
    elif isinstance(style, PictureStyle):
        _show_bands(layer, style)
    elif isinstance(style, Categories):
        entries = {value: (tr(label), QColor(colour)) for value, label, colour in style.entries}
        classes(entries)(layer)
    else:
        _step(layer, style)


def _show_bands(layer: QgsRasterLayer, style: PictureStyle) -> None:
    """Show the bands as they are, or grey between limits."""
    provider = layer.dataProvider()
    if layer.bandCount() > 1:
        layer.setRenderer(QgsMultiBandColorRenderer(provider, 1, 2, 3))
        return
    renderer = QgsSingleBandGrayRenderer(provider, 1)
    if style.limits is not None:
        contrast = QgsContrastEnhancement(provider.dataType(1))
        contrast.setMinimumValue(style.limits[0])
        contrast.setMaximumValue(style.limits[1])
        stretch = QgsContrastEnhancement.ContrastEnhancementAlgorithm.StretchToMinimumMaximum
        contrast.setContrastEnhancementAlgorithm(stretch)
        renderer.setContrastEnhancement(contrast)
    layer.setRenderer(renderer)


def _step(layer: QgsRasterLayer, style: ColourSteps) -> None:
    """Give all values between two limits one colour."""
    unit = unit_size(unit_of(layer.source()))
    ends = [limit / unit for limit in style.limits]
    words = [
        f"\u2264 {ends[0]:.2g}",
        *(f"{low:.2g} \u2013 {high:.2g}" for low, high in zip(ends, ends[1:])),
        f"> {ends[-1]:.2g}",
    ]
    function = QgsColorRampShader(0.0, ends[-1], None, QgsColorRampShader.Type.Discrete)
    function.setColorRampItemList(
        [
            QgsColorRampShader.ColorRampItem(most, QColor(colour), text)
            for most, colour, text in zip((*ends, math.inf), style.colours, words)
        ]
    )
    shader = QgsRasterShader()
    shader.setRasterShaderFunction(function)
    layer.setRenderer(QgsSingleBandPseudoColorRenderer(layer.dataProvider(), 1, shader))


def classes(categories: Mapping[int, tuple[str, QColor]]) -> Callable[[QgsRasterLayer], None]:
    """Return a function that gives each class of a raster its name and colour."""

    def dress(layer: QgsRasterLayer) -> None:
        entries = [
            QgsPalettedRasterRenderer.Class(value, colour, label)
            for value, (label, colour) in categories.items()
        ]
        layer.setRenderer(QgsPalettedRasterRenderer(layer.dataProvider(), 1, entries))
        clouds.show_through(layer)

    return dress


def _limits(layer: QgsRasterLayer, style: Ramp) -> tuple[float, float]:
    """Return the values of the first and of the last colour."""
    if style.low is not None and style.high is not None:
        return style.low, style.high
    # The method of QGIS is not used, because GDAL would store a histogram beside the file. A new
    # file with the same name would get the limits of the old one.
    raster = gdal.Open(layer.source())
    band = raster.GetRasterBand(1)
    size = (min(count, _SAMPLE) for count in (band.XSize, band.YSize))
    values = band.ReadAsArray(0, 0, band.XSize, band.YSize, *size)
    values = values[np.isfinite(values) & (values != band.GetNoDataValue())]
    low, high = np.quantile(values, (_LOW, _HIGH)).tolist() if values.size else (0.0, 0.0)
    if style.is_even:
        largest = max(-low, high, low + style.least)
        return -largest, largest
    low = low if style.low is None else style.low
    high = high if style.high is None else style.high
    if high - low >= style.least:
        return low, high
    return (low, low + style.least) if style.high is None else (high - style.least, high)


def _spread(layer: QgsRasterLayer, stops: Stops, low: float, high: float) -> None:
    renderer = QgsSingleBandPseudoColorRenderer(layer.dataProvider(), 1)
    renderer.setClassificationMin(low)
    renderer.setClassificationMax(high)
    interpolated = QgsColorRampShader.Type.Interpolated
    renderer.createShader(clouds.ramp_of(stops), interpolated)
    shader = renderer.shader().rasterShaderFunction()
    shader.setLegendSettings(_legend(high - low))
    layer.setRenderer(renderer)


def _legend(extent: float) -> QgsColorRampLegendNodeSettings:
    """Return a legend whose numbers have only as many digits as needed."""
    numbers = QgsBasicNumericFormat()
    numbers.setNumberDecimalPlaces(max(0, 2 - math.floor(math.log10(extent))))
    numbers.setShowTrailingZeros(False)
    settings = QgsColorRampLegendNodeSettings()
    settings.setNumericFormat(numbers)
    return settings
