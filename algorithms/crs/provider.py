"""Access to a library for coordinate reference systems: GDAL in QGIS, pyproj elsewhere."""

from __future__ import annotations

import contextlib
import importlib.util
import re
from typing import Any, Iterator

import numpy as np

# Units of the CRS: no place on earth has larger coordinates, with which PROJ may fail.
_FARTHEST = 1e9
LONGITUDE_LATITUDE = "EPSG:4326"
_CODE = re.compile(r"[A-Za-z]+:[A-Za-z0-9_]+$")


def wkt_of_epsg(code: int) -> str | None:
    """Return the WKT 1 of an EPSG code, None if there is no library, or the code is not known."""
    return _answer("wkt_of_epsg", code)


def wkt_of_text(text: str) -> str | None:
    """Return the WKT 1 of a CRS in any form that the library understands, None if there is no
    library, or it does not understand the text.
    """
    # GDAL would read from an address.
    return None if "://" in text else _answer("wkt_of_text", text)


def are_same(first: str, second: str) -> bool | None:
    """Return whether two well-known texts have the same horizontal CRS, None if there is no
    library, or it does not understand a text.
    """
    return _answer("are_same", first, second)


def to_wgs84(wkt: str, places: np.ndarray) -> np.ndarray | None:
    """Return longitudes and latitudes in degrees, float64 (n, 2), of places in a CRS, None without
    a library that knows it, or if a place is outside its area.
    """
    degrees = transformed(wkt, LONGITUDE_LATITUDE, places)
    return None if degrees is None or not _are_within(degrees, (180, 90)) else degrees


def transformed(source: str, target: str, places: np.ndarray) -> np.ndarray | None:
    """Return x and y, float64 (n, 2), in another CRS, each given as well-known text or code, None
    without a library that knows both, or if a place is outside their areas.
    """
    # Longitude comes first, whatever the definition of the CRS says. Heights do not matter.
    if library() is None or not _are_within(places, (_FARTHEST, _FARTHEST)):
        return None
    if not len(places):
        return places
    moved = _answer("transformed", source, target, places)
    return None if moved is None or not np.isfinite(moved).all() else moved


def _are_within(places: np.ndarray, limits: tuple[float, float]) -> bool:
    """Return whether all places are finite and within the limits of x and y."""
    return bool(np.isfinite(places).all() and (np.abs(places) <= limits).all())


def library() -> Any:
    """Return the class for the installed library, GDAL first, for QGIS; None without a library."""
    for package, asking in (("osgeo", _Gdal), ("pyproj", _Pyproj)):
        if importlib.util.find_spec(package) is not None:
            return asking
    return None


def _answer(question: str, *arguments: Any) -> Any:
    """Return the answer of the library; None if there is no library, or it cannot answer."""
    installed = library()
    try:
        return None if installed is None else getattr(installed, question)(*arguments)
    except RuntimeError:  # of pyproj, and of GDAL if the application lets it raise errors
        return None


class _Gdal:
    @staticmethod
    def wkt_of_epsg(code: int) -> str | None:
        from osgeo import osr

        reference = osr.SpatialReference()
        with _quiet():
            failed = reference.ImportFromEPSG(code)
        return None if failed else reference.ExportToWkt()

    @staticmethod
    def wkt_of_text(text: str) -> str | None:
        from osgeo import osr

        reference = osr.SpatialReference()
        with _quiet():
            failed = reference.SetFromUserInput(text)
        return None if failed else reference.ExportToWkt()

    @staticmethod
    def are_same(first: str, second: str) -> bool | None:
        from osgeo import osr

        references = osr.SpatialReference(), osr.SpatialReference()
        with _quiet():
            for reference, text in zip(references, (first, second)):
                if reference.ImportFromWkt(text):
                    return None
                if reference.IsCompound():
                    reference.DemoteTo2D()
            return bool(references[0].IsSame(references[1]))

    @staticmethod
    def transformed(source: str, target: str, places: np.ndarray) -> np.ndarray | None:
        from osgeo import osr

        references = []
        with _quiet():
            for text in (source, target):
                reference = osr.SpatialReference()
                # Only for codes, since this function also reads files and addresses.
                read = reference.SetFromUserInput if _CODE.match(text) else None
                if (read or reference.ImportFromWkt)(text):
                    return None
                reference.StripVertical()
                reference.SetAxisMappingStrategy(osr.OAMS_TRADITIONAL_GIS_ORDER)
                references.append(reference)
            transformation = osr.CoordinateTransformation(*references)
            try:
                return np.array(transformation.TransformPoints(places.tolist()))[:, :2]
            except (TypeError, IndexError):  # GDAL made an invalid transformation
                return None


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """Prevent GDAL from printing its errors; the caller handles them."""
    from osgeo import gdal

    gdal.PushErrorHandler("CPLQuietErrorHandler")
    try:
        yield
    finally:
        gdal.PopErrorHandler()


class _Pyproj:
    @staticmethod
    def wkt_of_epsg(code: int) -> str | None:
        from pyproj import CRS

        return CRS.from_epsg(code).to_wkt("WKT1_GDAL")

    @staticmethod
    def wkt_of_text(text: str) -> str | None:
        from pyproj import CRS

        crs = CRS.from_user_input(text)
        return crs.to_wkt("WKT1_GDAL") or crs.to_wkt()

    @staticmethod
    def are_same(first: str, second: str) -> bool:
        from pyproj import CRS

        pair = [CRS.from_wkt(text) for text in (first, second)]
        flat = [crs.sub_crs_list[0] if crs.is_compound else crs for crs in pair]
        return bool(flat[0].equals(flat[1], ignore_axis_order=True))

    @staticmethod
    def transformed(source: str, target: str, places: np.ndarray) -> np.ndarray:
        from pyproj import CRS, Transformer

        references = [CRS.from_user_input(text) for text in (source, target)]
        start, end = (crs.sub_crs_list[0] if crs.is_compound else crs for crs in references)
        transformer = Transformer.from_crs(start, end, always_xy=True)
        return np.column_stack(transformer.transform(*places.T))
