"""The former name of `system`."""

from .system import Crs, compound_wkt, unit_name, wkt_of_epsg

__all__ = ["Crs", "compound_wkt", "unit_name", "wkt_of_epsg"]
