"""Coordinate reference systems: units, WKT and GeoTIFF keys."""
