"""The rasters of the terrain and of what stands on it: each is a row of `RASTERS`.

From its row follow the option of the commands, the keyword of `RasterFiles`, the field of dialogs
or the kind of *Relief of a terrain model*, the band of the file, and the layer on a map.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Callable, NamedTuple

import numpy as np

from ...grids.canopy import PIT_PASSES, canopy_height, without_pits
from ...rasters import looks
from ...rasters.looks import Look, PictureStyle, Ramp
from ...relief.hillshade import hillshade, multidirectional_hillshade, slope
from ...relief.horizons import (
    Cells,
    dominance_reach,
    horizon_reach,
    local_dominance,
    openness,
    sky_view,
)
from ...relief.local_relief import (
    local_relief,
    multi_scale_reach,
    multi_scale_relief,
    relief_reach,
)
from ...relief.pictures import VAT_RADII, archaeological_topography, red_relief
from ...relief.smoothing import smoothing_reach, without_noise
from .parameters import SurfaceModel, TerrainModel


class How(NamedTuple):
    """How rasters are made."""

    cells: Cells  # the two sides of a cell in metres
    terrain: TerrainModel
    surface: SurfaceModel = SurfaceModel()

    @property
    def radius(self) -> float:
        """The size of the features that pictures of the relief show, in metres."""
        return self.terrain.relief_radius


@dataclass(frozen=True)
class RasterRow:
    """A raster: what it shows, from which layers of a block it is made, and how it looks."""

    title: str  # of its layer
    help: str  # a sentence
    shows: str  # what its cells mean, for legends; ``{unit}`` is the vertical unit
    # Returns rows, or (bands, rows, columns), given as many rows of each layer, from north to south
    # and in metres, and `How`; NaN is no value, for bytes 0.
    make: Callable[..., np.ndarray]
    look: Look
    layers: tuple[str, ...] = ("terrain",)  # of `LAYERS`
    reach: Callable[[How], int] = lambda how: 0  # how many cells away cells matter
    label: str = ""  # of its field; by default the title
    kind: str = "float32"  # of its values
    bands: int = 1
    is_height: bool = False  # in metres, and written in the vertical unit
    needs_both: bool = False  # no value where surface or terrain were not measured nearby
    is_relief: bool = False  # a kind of relief, which any terrain model can be made into
    is_smoothed: bool = False  # made of heights without noise, unless the user wants the noise
    relief_name: str = ""  # of the kind of relief, where that is not its name

    def __post_init__(self) -> None:
        object.__setattr__(self, "label", self.label or self.title)

    def smooths(self, how: How) -> bool:
        """Return whether heights are smoothed first."""
        return self.is_smoothed and how.terrain.relief_smoothing == "automatic"

    def margin(self, how: How) -> int:
        """Return how many cells away cells matter, smoothing included."""
        return self.reach(how) + (smoothing_reach(min(how.cells)) if self.smooths(how) else 0)

    def nodata(self, value: float) -> float:
        """Return the value of cells without data, given that of heights."""
        return 0 if self.kind == "uint8" else value

    def rows(self, *layers: np.ndarray, how: How, unit: float, nodata: float) -> np.ndarray:
        """Return rows as they are written, given as many of each layer in metres and the metres in
        the vertical unit.
        """
        if self.smooths(how):
            layers = tuple(without_noise(heights, min(how.cells)) for heights in layers)
        values = self.make(*layers, how)
        if self.kind == "uint8":
            return values
        values = values.astype(np.float64) / unit if self.is_height else values
        return np.where(np.isnan(values), nodata, values).astype(np.float32)


def _canopy(canopy: np.ndarray, terrain: np.ndarray, how: How) -> np.ndarray:
    canopy = canopy_height(canopy, terrain)
    return without_pits(canopy) if how.surface.pit_free else canopy


def _hillshade(heights: np.ndarray, how: How) -> np.ndarray:
    model = how.terrain
    if model.hillshade_light == "multidirectional":
        return multidirectional_hillshade(heights, how.cells, model.hillshade_altitude)
    return hillshade(heights, how.cells, model.hillshade_azimuth, model.hillshade_altitude)


def _horizon(how: How) -> int:
    return max(horizon_reach(how.radius, how.cells))


def _scaled(error: np.ndarray, terrain: np.ndarray, how: How) -> np.ndarray:
    return np.where(np.isnan(terrain), np.nan, error * how.terrain.error_factor)


_relief = partial(RasterRow, is_relief=True, is_smoothed=True)

RASTERS = {
    "dtm": RasterRow(
        "Terrain model",
        "Heights of the bare ground.",
        "Height, {unit}",
        lambda terrain, how: terrain,
        Look(Ramp(looks.TERRAIN, multiplies=True, line="#6e4824"), 1, hides=5),
        label="Terrain model (DTM)",
        is_height=True,
    ),
    "dsm": RasterRow(
        "Surface model",
        "The highest point of each cell, noise left out.",
        "Height, {unit}",
        lambda surface, how: surface,
        Look(Ramp(looks.SURFACE, line="#2a9d8f"), 2, hides=1),
        layers=("surface",),
        label="Surface model (DSM)",
        is_height=True,
    ),
    "chm": RasterRow(
        "Canopy height",
        "The greatest height above the ground in each cell: of trees, and of buildings too. Each"
        " point is measured above the ground under it, so that bare slopes have 0. Empty where no"
        " ground point lies within 50 m (or 20 cells), and in gaps of the surface.",
        "Height above ground, {unit}",
        _canopy,
        Look(Ramp(looks.CANOPY, low=0.0), 3, hides=3),
        layers=("canopy", "terrain"),
        reach=lambda how: PIT_PASSES,
        label="Canopy height (CHM)",
        is_height=True,
        needs_both=True,
    ),
    "hillshade": _relief(
        "Hillshade",
        "The terrain model, lit by one light or by four.",
        "Brightness, 1 to 255",
        _hillshade,
        # Level land is nearly white, so that colours above it look as in the legend.
        Look(PictureStyle((20.0, 210.0)), 0),
        reach=lambda how: 1,
        kind="uint8",
    ),
    "expected_error": RasterRow(
        "Expected error",
        "How far the terrain model may be off: 95 of 100 errors are expected to be smaller. It is"
        " large under dense trees, across gaps, at breaks and in low plants.",
        "Expected error (95 %), {unit}",
        _scaled,
        Look(Ramp(looks.ERRORS, low=0.0), 5, hides=1),
        layers=("expected_error", "terrain"),
        is_height=True,
    ),
    "error_cause": RasterRow(
        "Cause of the expected error",
        "What makes the expected error large: 1 cells without ground, as under plants, 2 rough"
        " ground, 3 a slope, 4 a gap, 5 a gap beside a step, 6 low points that are not ground,"
        " 7 low plants; 0 nothing.",
        "Cause, 1 to 7",
        lambda cause, terrain, how: np.nan_to_num(cause + 0 * terrain).astype(np.uint8),
        Look(Ramp(looks.CAUSES, 0.0, 7.0), 4, hides=1),
        layers=("error_cause", "terrain"),
        kind="uint8",
    ),
    "relief": _relief(
        "Local relief",
        "The terrain model minus a smoothed one. Mounds, ditches and old paths stand out.",
        "Local relief, {unit}",
        lambda heights, how: local_relief(heights, how.cells, how.radius),
        Look(Ramp(looks.RISES, is_even=True), 4, hides=2),
        reach=lambda how: relief_reach(how.cells, how.radius),
        is_height=True,
        relief_name="local-relief",
    ),
    "multi_scale_relief": _relief(
        "Multi-scale relief",
        "The mean of local reliefs of four sizes, from half of the radius to four times it, so that"
        " narrow and wide features are in one picture.",
        "Multi-scale relief, {unit}",
        lambda heights, how: multi_scale_relief(heights, how.cells, how.radius),
        Look(Ramp(looks.RISES, is_even=True), 4, hides=1),
        reach=lambda how: multi_scale_reach(how.cells, how.radius),
        is_height=True,
    ),
    "slope": _relief(
        "Slope",
        "How steep the terrain model is, in degrees.",
        "Slope, degrees",
        lambda heights, how: slope(heights, how.cells),
        Look(Ramp(looks.GREY_UPSIDE_DOWN, low=0.0, least=5.0), 4, hides=1),
        reach=lambda how: 1,
        is_smoothed=False,
    ),
    "sky_view": _relief(
        "Sky-view factor",
        "The share of the sky that can be seen: dark in ditches, pits and sunken paths, whatever"
        " their direction.",
        "Sky-view factor, 0 to 1",
        lambda heights, how: sky_view(heights, how.cells, how.radius),
        Look(Ramp(looks.GREY, high=1.0, least=0.1), 4, hides=2),
        reach=_horizon,
    ),
    "openness": _relief(
        "Positive openness",
        "The mean angle between zenith and horizon in degrees: bright banks and edges. Even slopes"
        " look like level land.",
        "Positive openness, degrees",
        lambda heights, how: openness(heights, how.cells, how.radius),
        Look(Ramp(looks.GREY, least=5.0), 4, hides=1),
        reach=_horizon,
    ),
    "negative_openness": _relief(
        "Negative openness",
        "The same upside down: large in ditches, pits and at the foot of banks.",
        "Negative openness, degrees",
        lambda heights, how: openness(-heights, how.cells, how.radius),
        Look(Ramp(looks.GREY_UPSIDE_DOWN, least=5.0), 4, hides=1),
        reach=_horizon,
    ),
    "local_dominance": _relief(
        "Local dominance",
        "How steeply one looks down from a place, 1 on level land: low mounds and banks on level"
        " land stand out.",
        "Local dominance, 1 is level",
        lambda heights, how: local_dominance(heights, how.cells, how.radius),
        Look(Ramp(looks.GREY, least=0.2), 4, hides=1),
        reach=lambda how: max(dominance_reach(how.radius, how.cells)),
    ),
    "vat": _relief(
        "Archaeological topography (VAT)",
        "A hillshade blended with slope, openness and sky-view factor: one picture for features of"
        " any kind.",
        "Archaeological topography, 1 to 255",
        lambda heights, how: archaeological_topography(heights, how.cells, how.radius),
        Look(PictureStyle(), 5, hides=4),
        reach=lambda how: max(horizon_reach(VAT_RADII * how.radius, how.cells)),
        kind="uint8",
    ),
    "red_relief": _relief(
        "Red relief image map",
        "Slopes in red, ridges bright, hollows dark: a picture without light and shadow.",
        "Red relief",
        lambda heights, how: red_relief(heights, how.cells, how.radius),
        Look(PictureStyle(), 5, hides=3),
        reach=_horizon,
        kind="uint8",
        bands=3,
    ),
}
# What other tools make for themselves.
_INTERNAL = {
    "ground_distance": RasterRow(
        "Distance to the ground",
        "How far the nearest ground point is.",
        "Distance, {unit}",
        lambda distance, how: distance,
        Look(Ramp(looks.ERRORS, low=0.0), 5),
        layers=("ground_distance",),
        is_height=True,
    ),
}


def row_of(name: str) -> RasterRow:
    """Return the row of a raster."""
    return RASTERS.get(name) or _INTERNAL[name]


@dataclass(frozen=True, init=False)
class RasterFiles:
    """The rasters to make, GeoTIFF, by their names: ``RasterFiles(dtm="dtm.tif")``."""

    files: tuple[tuple[str, Path], ...]

    def __init__(self, **files: Path | str | None) -> None:
        names = (*RASTERS, *_INTERNAL)
        unknown = ", ".join(files.keys() - set(names))
        if unknown:
            raise TypeError(f"There is no raster {unknown}, only {', '.join(RASTERS)}.")
        wanted = tuple((name, Path(files[name] or "")) for name in names if files.get(name))
        object.__setattr__(self, "files", wanted)

    @property
    def wanted(self) -> dict[str, Path]:
        """The paths of the wanted rasters, by their names."""
        return dict(self.files)

    @property
    def layers(self) -> tuple[str, ...]:
        """The layers from which the wanted rasters are made."""
        names = (layer for raster in self.wanted for layer in row_of(raster).layers)
        return tuple(dict.fromkeys(names))

    def outputs(self, per_file: bool = False) -> list[tuple[str, Path]]:
        """Return the kinds and paths for `check_outputs`; with `per_file`, each of many files gets
        rasters of its own.
        """
        return [("raster set" if per_file else "raster", path) for _, path in self.files]
