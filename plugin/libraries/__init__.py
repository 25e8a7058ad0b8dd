"""Stores and installs Python packages that QGIS may lack. Does not import qgis."""
