"""Rasters in memory, as functions on arrays return them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import Progress
from ..crs.stated import crs_text
from ..rasters.geotiff import HeightBand as FileRaster
from ..rasters.geotiff import RasterGrid
from ..rasters.writing import Band, RasterCells
from .transform import transform_of

if TYPE_CHECKING:
    from numpy.typing import DTypeLike


@dataclass(frozen=True, eq=False)
class Raster:
    """A raster in memory, with north up.

    Attributes
    ----------
    values : numpy.ndarray
        The cells, float32 or uint8, of shape (rows, columns) from north to south, or of shape
        (3, rows, columns) for red, green and blue.
    transform : affine.Affine
        Place of the cells, as rasterio has it: the size of a cell, 0, x of the western edge, 0,
        minus the size of a cell, y of the northern edge, in units of the CRS. Six numbers are taken
        as well. Without affine, which comes with rasterio, a tuple like it with a to f, `~`, `*`.
    crs : str or None
        The CRS as well-known text (WKT), None if it is not known.
    nodata : float
        The value of cells without data; it can be NaN.
    name : str
        The name of the raster, such as "dtm".
    shows : str
        What the cells mean, such as "Height, m".
    """

    values: np.ndarray
    transform: Any
    crs: str | None = None
    nodata: float = math.nan
    name: str = "raster"
    shows: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "transform", transform_of(self.transform))
        object.__setattr__(self, "crs", crs_text(self.crs))

    def __array__(self, dtype: DTypeLike | None = None, copy: bool | None = None) -> np.ndarray:
        """Return the values; those of Dask are computed."""
        values = np.asarray(self.values, dtype)
        if copy is False and values is not self.values:
            raise ValueError("The values cannot be had in this way without a copy of them.")
        return values.copy() if copy and values is self.values else values

    def plot(self, ax: Any = None, **options: Any) -> Any:
        """Draw the raster as a map.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; without it, on new axes.
        **options
            Options of `imshow` of matplotlib, such as cmap="terrain".

        Returns
        -------
        matplotlib.axes.Axes
            The axes, in units of the CRS.

        Raises
        ------
        BareEarthError
            If matplotlib is not installed.
        """
        try:
            from matplotlib import pyplot
        except ImportError:
            raise BareEarthError("This needs matplotlib: pip install matplotlib.") from None
        if ax is None:
            ax = pyplot.subplots()[1]
        values = np.asarray(self)
        rows, columns = values.shape[-2:]
        west, north = self.transform[2], self.transform[5]
        east, south = west + self.transform[0] * columns, north + self.transform[4] * rows
        is_picture = values.ndim == 3
        empty = np.isnan(values) if math.isnan(self.nodata) else values == self.nodata
        cells = np.moveaxis(values, 0, -1) if is_picture else np.ma.masked_where(empty, values)
        if values.dtype == np.uint8:
            options = {"cmap": "gray", "vmin": 0, "vmax": 255, **options}
        image = ax.imshow(cells, **{"extent": (west, east, south, north), **options})
        if values.dtype != np.uint8:
            ax.figure.colorbar(image, ax=ax, label=self.shows)
        ax.set_title(self.name)
        return ax

    def to_xarray(self) -> Any:
        """Return the raster as `xarray.DataArray` by the conventions of rioxarray.

        Returns
        -------
        xarray.DataArray
            With coordinates x and y of the centres of cells, the CRS in the coordinate
            `spatial_ref`, and the value of cells without data in the attribute `_FillValue`.

        Raises
        ------
        BareEarthError
            If xarray is not installed.
        """
        try:
            import xarray
        except ImportError:
            raise BareEarthError("This needs xarray: pip install xarray.") from None
        size, _, west, _, height, north = self.transform[:6]
        rows, columns = self.values.shape[-2:]
        reference = {"GeoTransform": f"{west!r} {size!r} 0.0 {north!r} 0.0 {height!r}"}
        if self.crs is not None:
            reference.update(crs_wkt=self.crs, spatial_ref=self.crs)
        coordinates: dict[str, object] = {
            "y": ("y", north + height * (np.arange(rows) + 0.5), {"axis": "Y"}),
            "x": ("x", west + size * (np.arange(columns) + 0.5), {"axis": "X"}),
            "spatial_ref": ((), 0, reference),
        }
        if self.values.ndim == 3:
            coordinates["band"] = np.arange(1, len(self.values) + 1)
        array = xarray.DataArray(
            self.values,
            coordinates,
            ("band", "y", "x")[-self.values.ndim :],
            name=self.name,
            attrs={"long_name": self.shows, "_FillValue": self.values.dtype.type(self.nodata)},
        )
        array.encoding["grid_mapping"] = "spatial_ref"
        return array


class Collected:
    """Collects rasters that are made, in place of writing them."""

    def __init__(self) -> None:
        self.rasters: dict[str, Raster] = {}

    def add(
        self,
        path: Path,
        values: np.ndarray | RasterCells,
        grid: RasterGrid | FileRaster,
        nodata: float,
        progress: Progress,
        shows: str,
    ) -> None:
        """Add a raster; its name is that of the path."""
        given = values if isinstance(values, RasterCells) else RasterCells.of(values)
        shape = given.shape if given.bands == 1 else (given.bands, *given.shape)
        cells = np.full(shape, nodata, given.kind)
        for row, column, part in given.parts:
            rows, columns = part.shape[-2:]
            cells[..., row : row + rows, column : column + columns] = part
        about = Band.of(grid, nodata, shows, given.bands)
        west, a, b, north, d, e = grid.geotransform
        transform, name = (a, b, west, d, e, north), path.name
        self.rasters[name] = Raster(cells, transform, about.wkt, nodata, name, about.description)
