"""What libraries know of coordinate reference systems: GDAL, which QGIS has, or pyproj outside."""

from __future__ import annotations

import contextlib
import importlib.util
from typing import Any, Iterator

import numpy as np

# In units of the CRS: farther off is no place on earth, and PROJ may not bear the number.
_FARTHEST = 1e9


def wkt_of_epsg(code: int) -> str | None:
    """Return the well-known text (WKT 1) of an EPSG code.

    None if there is none of the libraries, or the code is unknown to it.
    """
    known = library()
    return None if known is None else known.wkt_of_epsg(code)


def to_wgs84(wkt: str, places: np.ndarray) -> np.ndarray | None:
    """Transform places to WGS 84.

    Parameters
    ----------
    wkt : str
        The CRS of the places as well-known text.
    places : numpy.ndarray of float64, shape (n, 2)
        Their x and y.

    Returns
    -------
    numpy.ndarray of float64, shape (n, 2), or None
        Longitudes and latitudes in degrees; None if there is none of the libraries, the CRS is
        not known to it, or a place is outside of where the CRS holds.
    """
    known = library()
    if known is None or not _are_within(places, (_FARTHEST, _FARTHEST)):
        return None
    degrees = known.to_wgs84(wkt, places)
    return None if degrees is None or not _are_within(degrees, (180, 90)) else degrees


def _are_within(places: np.ndarray, limits: tuple[float, float]) -> bool:
    """Return whether all places are numbers, and none is beyond the limits of x and y."""
    return bool(np.isfinite(places).all() and (np.abs(places) <= limits).all())


def library() -> Any:
    """Return what asks the library that is there; GDAL first, for QGIS. None if there is none."""
    for package, asking in (("osgeo", _Gdal), ("pyproj", _Pyproj)):
        if importlib.util.find_spec(package) is not None:
            return asking
    return None


class _Gdal:
    """By osr of GDAL."""

    @staticmethod
    def wkt_of_epsg(code: int) -> str | None:
        from osgeo import osr

        reference = osr.SpatialReference()
        try:
            with _quiet():
                failed = reference.ImportFromEPSG(code)
        except RuntimeError:  # where the application made GDAL raise its errors
            return None
        return None if failed else reference.ExportToWkt()

    @staticmethod
    def to_wgs84(wkt: str, places: np.ndarray) -> np.ndarray | None:
        from osgeo import osr

        source, target = osr.SpatialReference(), osr.SpatialReference()
        try:
            with _quiet():
                if source.ImportFromWkt(wkt) or target.ImportFromEPSG(4326):
                    return None
                for each in (source, target):
                    each.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
                transformation = osr.CoordinateTransformation(source, target)
                return np.array(transformation.TransformPoints(places.tolist()))[:, :2]
        except (RuntimeError, TypeError, IndexError):
            # Where GDAL raises its errors, or makes a transformation that is none.
            return None


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """Keep GDAL from printing its errors, which are told in another way."""
    from osgeo import gdal

    gdal.PushErrorHandler("CPLQuietErrorHandler")
    try:
        yield
    finally:
        gdal.PopErrorHandler()


class _Pyproj:
    """By pyproj."""

    @staticmethod
    def wkt_of_epsg(code: int) -> str | None:
        from pyproj import CRS
        from pyproj.exceptions import CRSError

        try:
            return CRS.from_epsg(code).to_wkt("WKT1_GDAL")
        except CRSError:
            return None

    @staticmethod
    def to_wgs84(wkt: str, places: np.ndarray) -> np.ndarray | None:
        from pyproj import Transformer
        from pyproj.exceptions import CRSError, ProjError

        try:
            transformer = Transformer.from_crs(wkt, "EPSG:4326", always_xy=True)
            return np.column_stack(transformer.transform(*places.T))
        except (CRSError, ProjError):
            return None
