"""Reads and writes raster files."""
