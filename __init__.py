"""Bare Earth: classifies lidar points into ground and non-ground, and makes terrain models."""

__version__ = "0.1.0"


def classFactory(iface):
    """Return the plugin; QGIS is imported here only, so that the classifier works without it."""
    from .plugin.plugin import BareEarthPlugin

    return BareEarthPlugin(iface)
