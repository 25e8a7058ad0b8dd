"""What a coordinate reference system says: units, WKT and GeoTIFF keys."""
