"""Declarations of the rasters that show the relief of a terrain model."""

from __future__ import annotations

from typing import Callable, NamedTuple

import numpy as np

from ...grids.hillshade import hillshade, multidirectional_hillshade, slope
from ...grids.horizons import Cells, horizon_reach, openness, sky_view
from ...grids.local_dominance import dominance_reach, local_dominance
from ...grids.local_relief import local_relief, multi_scale_reach, multi_scale_relief, relief_reach
from ...grids.relief_pictures import VAT_RADII, archaeological_topography, red_relief
from ...grids.relief_smoothing import smoothing_reach, without_noise
from .terrain_model import TerrainModel


class ReliefRaster(NamedTuple):
    """The declaration of a raster that shows relief; the names are those of `Raster`."""

    label: str
    help: str
    shows: str
    # returns the raster, given heights in metres from north to south, NaN for none, and the two
    # sides of a cell in metres; it is NaN, or 0 for bytes, where there is no value
    of: Callable[[np.ndarray, Cells, TerrainModel], np.ndarray]
    near: Callable[[Cells, TerrainModel], int]  # returns how many cells away cells matter
    kind: str = "float32"
    bands: int = 1
    is_height: bool = False  # made in metres, written in the vertical unit
    is_measure: bool = False  # on the terrain itself, not on heights smoothed for pictures

    def make(self, heights: np.ndarray, cells: Cells, model: TerrainModel) -> np.ndarray:
        """Return the raster of heights; see `of`."""
        if self._smooths(model):
            heights = without_noise(heights, min(cells))
        return self.of(heights, cells, model)

    def reach(self, cells: Cells, model: TerrainModel) -> int:
        """Return how many cells away cells matter, smoothing included."""
        return self.near(cells, model) + (
            smoothing_reach(min(cells)) if self._smooths(model) else 0
        )

    def _smooths(self, model: TerrainModel) -> bool:
        return model.relief.smooths and not self.is_measure


def _shade(heights: np.ndarray, cells: Cells, model: TerrainModel) -> np.ndarray:
    if model.hillshade_light == "multidirectional":
        return multidirectional_hillshade(heights, cells, model.hillshade_altitude)
    return hillshade(heights, cells, model.hillshade_azimuth, model.hillshade_altitude)


def _beside(cells: Cells, model: TerrainModel) -> int:
    """Return that cells depend on their neighbours only."""
    return 1


def _horizon(cells: Cells, model: TerrainModel) -> int:
    """Return that cells depend on those up to the radius, at least on their neighbours."""
    return max(horizon_reach(model.relief_radius, cells))


RELIEF = {
    "hillshade": ReliefRaster(
        "Hillshade",
        "The terrain model, lit by one light or by four.",
        "Brightness, 1 to 255",
        _shade,
        _beside,
        kind="uint8",
    ),
    "relief": ReliefRaster(
        "Local relief",
        "The terrain model minus a smoothed one. Mounds, ditches and old paths stand out.",
        "Local relief, {unit}",
        lambda heights, cells, model: local_relief(heights, cells, model.relief_radius),
        lambda cells, model: relief_reach(cells, model.relief_radius),
        is_height=True,
    ),
    "multi_scale_relief": ReliefRaster(
        "Multi-scale relief",
        "The mean of local reliefs of four sizes, from half of the radius to four times it, so that"
        " narrow and wide features are in one picture.",
        "Multi-scale relief, {unit}",
        lambda heights, cells, model: multi_scale_relief(heights, cells, model.relief_radius),
        lambda cells, model: multi_scale_reach(cells, model.relief_radius),
        is_height=True,
    ),
    "slope": ReliefRaster(
        "Slope",
        "How steep the terrain model is, in degrees.",
        "Slope, degrees",
        lambda heights, cells, model: slope(heights, cells),
        _beside,
        is_measure=True,
    ),
    "sky_view": ReliefRaster(
        "Sky-view factor",
        "The share of the sky that can be seen: dark in ditches, pits and sunken paths, whatever"
        " their direction.",
        "Sky-view factor, 0 to 1",
        lambda heights, cells, model: sky_view(heights, cells, model.relief_radius),
        _horizon,
    ),
    "openness": ReliefRaster(
        "Positive openness",
        "The mean angle between zenith and horizon in degrees: bright banks and edges. Even slopes"
        " look like level land.",
        "Positive openness, degrees",
        lambda heights, cells, model: openness(heights, cells, model.relief_radius),
        _horizon,
    ),
    "negative_openness": ReliefRaster(
        "Negative openness",
        "The same upside down: large in ditches, pits and at the foot of banks.",
        "Negative openness, degrees",
        lambda heights, cells, model: openness(-heights, cells, model.relief_radius),
        _horizon,
    ),
    "local_dominance": ReliefRaster(
        "Local dominance",
        "How steeply one looks down from a place, 1 on level land: low mounds and banks on level"
        " land stand out.",
        "Local dominance, 1 is level",
        lambda heights, cells, model: local_dominance(heights, cells, model.relief_radius),
        lambda cells, model: max(dominance_reach(model.relief_radius, cells)),
    ),
    "vat": ReliefRaster(
        "Archaeological topography (VAT)",
        "A hillshade blended with slope, openness and sky-view factor: one picture for features of"
        " any kind.",
        "Archaeological topography, 1 to 255",
        lambda heights, cells, model: archaeological_topography(
            heights, cells, model.relief_radius
        ),
        lambda cells, model: max(horizon_reach(VAT_RADII * model.relief_radius, cells)),
        kind="uint8",
    ),
    "red_relief": ReliefRaster(
        "Red relief image map",
        "Slopes in red, ridges bright, hollows dark: a picture without light and shadow.",
        "Red relief",
        lambda heights, cells, model: red_relief(heights, cells, model.relief_radius),
        _horizon,
        kind="uint8",
        bands=3,
    ),
}
