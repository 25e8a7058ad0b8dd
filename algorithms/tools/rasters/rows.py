"""Declarations of all rasters, for the command line, the dialogs and writing."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Callable, NamedTuple

import numpy as np

from ...core.errors import BareEarthError
from ...core.files import check_distinct, check_output
from ...rasters.geotiff import RasterGrid
from ...rasters.writing import check_raster_output
from .relief_rasters import RELIEF, ReliefRaster
from .surface_model import PIT_PASSES, canopy_height, without_pits
from .terrain_model import TerrainModel


def _none(grid: RasterGrid, model: TerrainModel) -> int:
    """Return that cells depend on no others."""
    return 0


class Raster(NamedTuple):
    """The declaration of a raster."""

    label: str  # title of its field in the dialog
    help: str  # a sentence
    shows: str  # what its cells mean, for legends; ``{unit}`` is the vertical unit
    layers: tuple[str, ...]  # that it is made from, of `LAYERS`
    # ``make(*rows, grid, model)`` returns rows of the raster, given as many rows of each layer,
    # from north to south; NaN is no value
    make: Callable[..., np.ndarray]
    # rows and columns round a part of the raster that affect it
    margin: Callable[[RasterGrid, TerrainModel], int] = _none
    kind: str = "float32"  # of its values
    nodata: float | None = None  # None for the one that the user chooses
    # with values only where surface and terrain were measured nearby; `make` takes ``pit_free``
    is_canopy: bool = False
    bands: int = 1  # if several, `make` returns shape (bands, rows, columns)

    def empty(self, model: TerrainModel) -> float:
        """Return the value of cells without data."""
        return model.nodata if self.nodata is None else self.nodata


def plain(values: np.ndarray, grid: RasterGrid, model: TerrainModel) -> np.ndarray:
    """Return values with the no-data value for NaN."""
    return np.where(np.isnan(values), model.nodata, values).astype(np.float32)


def _heights(heights: np.ndarray, grid: RasterGrid, model: TerrainModel) -> np.ndarray:
    """Return heights in metres as heights in the vertical unit of the CRS."""
    return plain(heights.astype(np.float64) / grid.frame.vertical_unit, grid, model)


def _canopy(
    surface: np.ndarray,
    terrain: np.ndarray,
    grid: RasterGrid,
    model: TerrainModel,
    pit_free: bool = False,
) -> np.ndarray:
    canopy = canopy_height(surface, terrain)
    return _heights(without_pits(canopy) if pit_free else canopy, grid, model)


def _pit_margin(grid: RasterGrid, model: TerrainModel) -> int:
    return PIT_PASSES


def _sure(
    sure: np.ndarray, terrain: np.ndarray, grid: RasterGrid, model: TerrainModel
) -> np.ndarray:
    """Return the confidence where there is a terrain to be sure of."""
    return plain(np.where(np.isnan(terrain), np.nan, sure), grid, model)


def _of_terrain(relief: ReliefRaster) -> Raster:
    """Return the declaration of a raster that shows the relief of the terrain."""

    def make(heights: np.ndarray, grid: RasterGrid, model: TerrainModel) -> np.ndarray:
        made = relief.make(heights, (grid.cell_metres, grid.cell_metres), model)
        if relief.kind == "uint8":
            return made
        return (_heights if relief.is_height else plain)(made, grid, model)

    def margin(grid: RasterGrid, model: TerrainModel) -> int:
        return relief.reach((grid.cell_metres, grid.cell_metres), model)

    nodata = 0 if relief.kind == "uint8" else None
    about = relief.label, relief.help, relief.shows
    return Raster(*about, ("terrain",), make, margin, relief.kind, nodata, bands=relief.bands)


RASTERS = {
    "dtm": Raster(
        "Terrain model (DTM)",
        "Heights of the bare ground.",
        "Height, {unit}",
        ("terrain",),
        _heights,
    ),
    "dsm": Raster(
        "Surface model (DSM)",
        "The highest point of each cell, noise left out.",
        "Height, {unit}",
        ("surface",),
        _heights,
    ),
    "chm": Raster(
        "Canopy height (CHM)",
        "Surface minus terrain: the height of trees, and of buildings too. Empty where no ground"
        " point lies within 50 m (or 20 cells), and in gaps of the surface.",
        "Height above ground, {unit}",
        ("surface", "terrain"),
        _canopy,
        margin=_pit_margin,
        is_canopy=True,
    ),
    "hillshade": _of_terrain(RELIEF["hillshade"]),
    "confidence": Raster(
        "Confidence of the terrain model",
        "The probability, 0 to 1, that the terrain model is right: low under dense trees, across"
        " gaps and at breaks.",
        "Confidence, 0 to 1",
        ("confidence", "terrain"),
        _sure,
    ),
    **{name: _of_terrain(each) for name, each in RELIEF.items() if name != "hillshade"},
}


@dataclass(frozen=True)
class RasterFiles:
    """The rasters to make, GeoTIFF; None for those that are not wanted.

    Attributes
    ----------
    dtm, dsm, chm, hillshade, confidence, relief : Path or None
        Terrain, surface (with everything that stands on the terrain), canopy height (the
        difference of the two), hillshade of the terrain, confidence of the terrain, and its local
        relief.
    multi_scale_relief, slope, sky_view, openness : Path or None
    negative_openness, local_dominance, vat, red_relief : Path or None
        More pictures of the terrain; see `RELIEF` of `products/relief_rasters.py`.
    """

    dtm: Path | None = None
    dsm: Path | None = None
    chm: Path | None = None
    hillshade: Path | None = None
    confidence: Path | None = None
    relief: Path | None = None
    multi_scale_relief: Path | None = None
    slope: Path | None = None
    sky_view: Path | None = None
    openness: Path | None = None
    negative_openness: Path | None = None
    local_dominance: Path | None = None
    vat: Path | None = None
    red_relief: Path | None = None

    @property
    def wanted(self) -> dict[str, Path]:
        """The paths of the wanted rasters, by their names."""
        return {name: Path(path) for name, path in vars(self).items() if path}

    @property
    def layers(self) -> tuple[str, ...]:
        """The layers from which the wanted rasters are made."""
        return tuple(dict.fromkeys(each for name in self.wanted for each in RASTERS[name].layers))

    def check(self, others: tuple[Path, ...], per_file: bool = False) -> None:
        """Refuse rasters that could not be written, or would replace another file of the run.

        Parameters
        ----------
        others : tuple of Path
            The other files of the run.
        per_file : bool
            Whether each of many files gets rasters of its own.

        Raises
        ------
        BareEarthError
            If a path is unsuitable.
        """
        paths = list(self.wanted.values())
        check_distinct(paths)
        for each in paths:
            check_raster_output(each, others)
            if per_file:
                check_output(virtual_of(each), others)
                folder = folder_of(each)
                if folder.exists() and not folder.is_dir():
                    raise BareEarthError(f"Cannot write into {folder}: it is a file. Rename it.")


def folder_of(raster: Path) -> Path:
    """Return the folder of the rasters of single files, which has the name of the raster."""
    return raster.with_suffix("")


def virtual_of(raster: Path) -> Path:
    """Return the virtual raster that joins the rasters of single files."""
    return raster.with_suffix(".vrt")
