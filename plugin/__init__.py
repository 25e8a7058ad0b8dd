"""Bare Earth inside QGIS: everything that imports qgis."""
