"""Rasters in memory, as functions on arrays return them."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import Progress
from ..rasters.geotiff import RasterGrid
from ..rasters.writing import Band, Rows


@dataclass(frozen=True, eq=False)
class Raster:
    """A raster in memory, with north up.

    Attributes
    ----------
    values : numpy.ndarray
        The cells, float32 or uint8, of shape (rows, columns) from north to south, or of shape
        (3, rows, columns) for red, green and blue.
    transform : tuple of float
        Place of the cells, as `affine.Affine` and rasterio have it: the size of a cell, 0, x of the
        western edge, 0, minus the size of a cell, y of the northern edge, in units of the CRS.
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
    transform: tuple[float, float, float, float, float, float]
    crs: str | None
    nodata: float
    name: str
    shows: str

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
        size, _, west, _, height, north = self.transform
        rows, columns = self.values.shape[-2:]
        reference = {"GeoTransform": f"{west!r} {size!r} 0.0 {north!r} 0.0 {height!r}"}
        if self.crs is not None:
            reference.update(crs_wkt=self.crs, spatial_ref=self.crs)
        coordinates: dict[str, Any] = {
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
        rows: Rows,
        grid: RasterGrid,
        nodata: float,
        progress: Progress,
        shows: str,
    ) -> None:
        """Add a raster; its name is that of the path."""
        values = np.concatenate([*rows.strips], axis=-2)
        size, about = grid.cell_size, Band.of(grid, nodata, shows, rows.bands).description
        transform = (size, 0.0, grid.west, 0.0, -size, grid.north)
        name = path.name
        self.rasters[name] = Raster(values, transform, grid.frame.wkt, nodata, name, about)
