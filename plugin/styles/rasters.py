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
from ...algorithms.steps.explanation import rules_in
from ...algorithms.tools.quality.figures import LIMITS
from .. import compat
from ..i18n import mark, tr
from . import clouds, ramps
from .rules import categories_of

_MULTIPLY = QPainter.CompositionMode.CompositionMode_Multiply
# Colours spread between these quantiles of a sample with at most so many rows and columns.
_LOW, _HIGH, _SAMPLE = 0.02, 0.98, 600
# Values of a hillshade that are black and white. Level land is nearly white, so that colours above
# it look as in the legend.
_DARK, _BRIGHT = 20.0, 210.0
_LEAST_RANGE = 0.5
# The same for slopes and openness in degrees, for local dominance, and for sky-view factors.
_LEAST_DEGREES, _LEAST_DOMINANCE, _LEAST_SKY = 5.0, 0.2, 0.1
# Values of a byte, and rows of bytes that are read at a time.
_CODES, _ROWS = 256, 512
# Colours of lines in profiles, which QGIS would choose at random.
_TERRAIN_LINE, _SURFACE_LINE = "#6e4824", "#2a9d8f"
# Colours of the quality of a survey, as on its page.
_VOID, _DIFFERENCES = "#c0262d", ("#3a9d5d", "#f0c93a", "#c0262d")
# Parts of the descriptions of bands, except units.
SHOWN = (
    mark("Height"), mark("Height above ground"), mark("Local relief"),
    mark("Confidence"), mark("Share of wrong points"), mark("Brightness"), mark("Class"),
    mark("0 to 1"), mark("1 to 255"),
    mark("Multi-scale relief"), mark("Slope"), mark("degrees"), mark("Sky-view factor"),
    mark("Positive openness"), mark("Negative openness"), mark("Local dominance"),
    mark("1 is level"), mark("Archaeological topography"), mark("Red relief"),
    mark("First returns"), mark("Ground points"), mark("Points 0.2 to 2 m above the ground"),
    mark("1 where ground points are far away"), mark("Number of strips"),
    mark("Difference between strips"),
)  # fmt: skip


def shown_by(layer: QgsRasterLayer) -> str:
    """Return the description of the band in the user's language; empty if there is none."""
    raster = gdal.Open(layer.source())
    said = raster.GetRasterBand(1).GetDescription()
    if rules_in(said):
        return tr("Rule that decided each cell")
    return ", ".join(tr(each) if each in SHOWN else each for each in said.split(", "))


def is_class_raster(path: Path) -> bool:
    """Return whether a file is a raster of classes that this plugin made."""
    raster = gdal.Open(str(path)) if path.suffix == ".tif" else None
    return raster is not None and raster.GetRasterBand(1).GetDescription() == "Class"


def unit_of(path: str) -> str:
    """Return the symbol of the unit of heights, from the description of a band."""
    raster = gdal.Open(path)
    return raster.GetRasterBand(1).GetDescription().partition(", ")[2]


def terrain(layer: QgsRasterLayer) -> None:
    """Colour heights from low to high; the hillshade below stays visible."""
    _spread(layer, ramps.TERRAIN, *_cut(layer))
    layer.setBlendMode(_MULTIPLY)
    compat.mark_as_elevation(layer, _TERRAIN_LINE)


def surface(layer: QgsRasterLayer) -> None:
    """Colour heights of a surface."""
    _spread(layer, ramps.SURFACE, *_cut(layer))
    compat.mark_as_elevation(layer, _SURFACE_LINE)


def canopy(layer: QgsRasterLayer) -> None:
    """Colour heights above ground; bare ground is transparent."""
    _spread(layer, ramps.CANOPY, 0.0, _cut(layer)[1])


def confidence(layer: QgsRasterLayer) -> None:
    """Colour cells from low to high confidence, so that also a map of sure cells has a colour."""
    _spread(layer, ramps.CONFIDENCE, 0.0, 1.0)


def errors(layer: QgsRasterLayer) -> None:
    """Colour shares of wrong points; cells without errors are transparent."""
    _spread(layer, ramps.ERRORS, 0.0, 1.0)


def local_relief(layer: QgsRasterLayer) -> None:
    """Colour heights above and below the surroundings, with the same range for both."""
    largest = max(map(abs, _cut(layer)))
    _spread(layer, ramps.RELIEF, -largest, largest)


def slope(layer: QgsRasterLayer) -> None:
    """Shade steep places dark."""
    _spread(layer, ramps.GREY_UPSIDE_DOWN, 0.0, max(_cut(layer)[1], _LEAST_DEGREES))


def sky_view(layer: QgsRasterLayer) -> None:
    """Shade places dark that see little of the sky."""
    _spread(layer, ramps.GREY, min(_cut(layer)[0], 1.0 - _LEAST_SKY), 1.0)


def openness(layer: QgsRasterLayer) -> None:
    """Shade places bright that stand out."""
    _spread(layer, ramps.GREY, *_cut(layer, _LEAST_DEGREES))


def negative_openness(layer: QgsRasterLayer) -> None:
    """Shade places dark that lie deep."""
    _spread(layer, ramps.GREY_UPSIDE_DOWN, *_cut(layer, _LEAST_DEGREES))


def local_dominance(layer: QgsRasterLayer) -> None:
    """Shade places bright from which one looks down."""
    _spread(layer, ramps.GREY, *_cut(layer, _LEAST_DOMINANCE))


def grey_picture(layer: QgsRasterLayer) -> None:
    """Show a picture in greys as it is."""
    layer.setRenderer(QgsSingleBandGrayRenderer(layer.dataProvider(), 1))


def colour_picture(layer: QgsRasterLayer) -> None:
    """Show a picture of red, green and blue as it is."""
    layer.setRenderer(QgsMultiBandColorRenderer(layer.dataProvider(), 1, 2, 3))


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
    """Return a function that gives each class of a raster its name and colour."""

    def dress(layer: QgsRasterLayer) -> None:
        entries = [
            QgsPalettedRasterRenderer.Class(value, colour, label)
            for value, (label, colour) in categories.items()
        ]
        layer.setRenderer(QgsPalettedRasterRenderer(layer.dataProvider(), 1, entries))
        clouds.show_through(layer)

    return dress


def rules(layer: QgsRasterLayer) -> None:
    """Give each rule that decided cells its name and colour."""
    raster = gdal.Open(layer.source())  # it holds the band
    band = raster.GetRasterBand(1)
    counts = np.zeros(_CODES, dtype=np.int64)
    for row in range(0, band.YSize, _ROWS):
        rows = band.ReadAsArray(0, row, band.XSize, min(_ROWS, band.YSize - row))
        counts += np.bincount(rows.ravel(), minlength=_CODES)
    codes = np.flatnonzero(counts).tolist()
    classes(categories_of(codes, rules_in(band.GetDescription())))(layer)


def density(layer: QgsRasterLayer) -> None:
    """Colour numbers of points, dark where they are high."""
    _spread(layer, ramps.DENSITY, 0.0, _cut(layer)[1])


def low_vegetation(layer: QgsRasterLayer) -> None:
    """Colour numbers of low points; where there are none it is transparent."""
    _spread(layer, ramps.CANOPY, 0.0, _cut(layer)[1])


def voids(layer: QgsRasterLayer) -> None:
    """Show voids in red; all else is transparent."""
    classes({1: (tr("No ground near"), QColor(_VOID))})(layer)


def overlap(layer: QgsRasterLayer) -> None:
    """Give each number of flight strips its colour."""
    colours = (each for _, each in ramps.DENSITY)
    classes({number: (str(number), QColor(each)) for number, each in enumerate(colours)})(layer)


def strip_differences(layer: QgsRasterLayer) -> None:
    """Colour differences between strips by the limits of the Lidar Base Specification."""
    unit = unit_size(unit_of(layer.source()))
    low, high = (each / unit for each in LIMITS)
    words = f"\u2264 {low:.2g}", f"{low:.2g} \u2013 {high:.2g}", f"> {high:.2g}"
    function = QgsColorRampShader(0.0, high, None, QgsColorRampShader.Type.Discrete)
    function.setColorRampItemList(
        [
            QgsColorRampShader.ColorRampItem(most, QColor(colour), text)
            for most, colour, text in zip((low, high, math.inf), _DIFFERENCES, words)
        ]
    )
    shader = QgsRasterShader()
    shader.setRasterShaderFunction(function)
    layer.setRenderer(QgsSingleBandPseudoColorRenderer(layer.dataProvider(), 1, shader))


def _cut(layer: QgsRasterLayer, least: float = _LEAST_RANGE) -> tuple[float, float]:
    """Return the limits of the values, at least so far apart, without few lowest and highest."""
    # The method of QGIS is not used, because GDAL would store a histogram beside the file. A new
    # file with the same name would get the limits of the old one.
    raster = gdal.Open(layer.source())
    band = raster.GetRasterBand(1)
    size = (min(each, _SAMPLE) for each in (band.XSize, band.YSize))
    values = band.ReadAsArray(0, 0, band.XSize, band.YSize, *size)
    values = values[np.isfinite(values) & (values != band.GetNoDataValue())]
    low, high = np.quantile(values, (_LOW, _HIGH)).tolist() if values.size else (0.0, 0.0)
    # In level land the range is wider, so that noise of millimetres does not look like relief.
    return (low, high) if high - low >= least else (low, low + least)


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
    """Return a legend whose numbers have only as many digits as needed."""
    numbers = QgsBasicNumericFormat()
    numbers.setNumberDecimalPlaces(max(0, 2 - math.floor(math.log10(extent))))
    numbers.setShowTrailingZeros(False)
    settings = QgsColorRampLegendNodeSettings()
    settings.setNumericFormat(numbers)
    return settings
