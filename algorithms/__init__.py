"""The standalone classifier: numpy, scipy and laspy; never QGIS."""
