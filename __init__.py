"""Bare Earth: classifies lidar points into ground and non-ground, and makes terrain models."""

from .algorithms.core.version import __version__ as __version__


def classFactory(iface):
    """Return the plugin; QGIS is imported here only, so that the classifier works without it."""
    from .plugin.plugin import BareEarthPlugin

    return BareEarthPlugin(iface)
