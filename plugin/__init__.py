"""The QGIS plugin: all code that imports qgis."""
