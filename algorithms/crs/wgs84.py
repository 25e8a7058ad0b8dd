"""Longitudes and latitudes of places in a CRS, by whichever library is there."""

from __future__ import annotations

import importlib.util

import numpy as np

# In units of the CRS: farther off is no place on earth, and PROJ may not bear the number.
_FARTHEST = 1e9


def to_wgs84(wkt: str, places: np.ndarray) -> np.ndarray | None:
    """Transform places to WGS 84, by GDAL, pyproj or rasterio.

    Parameters
    ----------
    wkt : str
        The CRS of the places as well-known text.
    places : numpy.ndarray of float64, shape (n, 2)
        Their x and y.

    Returns
    -------
    numpy.ndarray of float64, shape (n, 2), or None
        Longitudes and latitudes in degrees; None if there is none of these libraries, the CRS is
        not known to it, or a place is outside of where the CRS holds.
    """
    if not (np.isfinite(places).all() and (np.abs(places) <= _FARTHEST).all()):
        return None
    for package, transform in (
        ("osgeo", _by_gdal),
        ("pyproj", _by_pyproj),
        ("rasterio", _by_rasterio),
    ):
        if importlib.util.find_spec(package) is not None:
            found = transform(wkt, places)
            if found is None or not _are_on_earth(found):
                return None
            return found
    return None


def _are_on_earth(degrees: np.ndarray) -> bool:
    return bool(np.isfinite(degrees).all() and (np.abs(degrees) <= (180, 90)).all())


def _by_gdal(wkt: str, places: np.ndarray) -> np.ndarray | None:
    from osgeo import osr

    source, target = osr.SpatialReference(), osr.SpatialReference()
    try:
        if source.ImportFromWkt(wkt) or target.ImportFromEPSG(4326):
            return None
        for each in (source, target):
            each.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
        transformation = osr.CoordinateTransformation(source, target)
        return np.array(transformation.TransformPoints(places.tolist()))[:, :2]
    except (RuntimeError, TypeError, IndexError):
        # Where GDAL raises its errors, or makes a transformation that is none.
        return None


def _by_pyproj(wkt: str, places: np.ndarray) -> np.ndarray | None:
    from pyproj import Transformer
    from pyproj.exceptions import CRSError, ProjError

    try:
        transformer = Transformer.from_crs(wkt, "EPSG:4326", always_xy=True)
        return np.column_stack(transformer.transform(*places.T))
    except (CRSError, ProjError):
        return None


def _by_rasterio(wkt: str, places: np.ndarray) -> np.ndarray | None:
    from rasterio.crs import CRS
    from rasterio.errors import CRSError, RasterioError
    from rasterio.warp import transform

    try:
        found = transform(CRS.from_wkt(wkt), CRS.from_epsg(4326), *places.T.tolist())
        return np.column_stack(found[:2])
    except (CRSError, RasterioError):
        return None
