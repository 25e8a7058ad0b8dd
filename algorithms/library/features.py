"""Points, lines and polygons in memory, as functions on arrays return them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterable

from ..core.errors import BareEarthError
from ..survey.feature_files import Feature, FeatureLayer, wkb_of


@dataclass(frozen=True, eq=False)
class Features:
    """Points, lines or polygons in memory, with their values.

    Attributes
    ----------
    kind : str
        "Point Z", "LineString", "LineString Z" or "Polygon".
    geometries : list
        Corners in units of the CRS: an array (1, 3) for each point, (n, 2) or (n, 3) for each
        line, and for each polygon a list of closed rings (n, 2), the border first.
    values : dict of list
        One value for each geometry, by the names of the fields.
    crs : str or None
        The CRS as well-known text (WKT), None if it is not known.
    name : str
        What they are, such as "contours".
    """

    kind: str
    geometries: list[Any]
    values: dict[str, list[Any]]
    crs: str | None
    name: str

    @classmethod
    def of(cls, layer: FeatureLayer, features: Iterable[Feature]) -> Features:
        """Return features that could be written as well."""
        rows = [*features]
        columns = {name: [row.values[i] for row in rows] for i, name in enumerate(layer.fields)}
        return cls(layer.kind, [row.corners for row in rows], columns, layer.wkt, layer.name)

    def to_geopandas(self) -> Any:
        """Return the features as `geopandas.GeoDataFrame`.

        Returns
        -------
        geopandas.GeoDataFrame
            With a column for each field, and the CRS.

        Raises
        ------
        BareEarthError
            If geopandas is not installed.
        """
        try:
            import geopandas
        except ImportError:
            raise BareEarthError("This needs geopandas: pip install geopandas.") from None
        shapes = [wkb_of(self.kind, corners) for corners in self.geometries]
        geometry = geopandas.GeoSeries.from_wkb(shapes, crs=self.crs)
        return geopandas.GeoDataFrame(self.values, geometry=geometry)
