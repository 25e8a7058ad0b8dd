"""Bare Earth: classifies lidar points into ground and non-ground, and makes terrain models.

A function has the name of its command, and its keywords are the options of that command. It is
imported when it is first used, so that this package is imported fast and needs no other one.

>>> import bare_earth
>>> bare_earth.classify("tile.laz", "ground.laz", dtm="dtm.tif")  # doctest: +SKIP
>>> bare_earth.relief("dtm.tif", "relief.tif", kind="vat")  # doctest: +SKIP
"""

from .algorithms.core.version import __version__ as __version__
from .algorithms.library import names as _functions

_OTHERS = {"BareEarthError": "errors", "Cancelled": "errors", "Progress": "progress"}
__all__ = ["__version__", *_OTHERS, *_functions()]


def classFactory(iface):
    """Return the plugin; QGIS is imported here only, so that the classifier works without it."""
    from .plugin.plugin import BareEarthPlugin

    return BareEarthPlugin(iface)


def __getattr__(name):
    from importlib import import_module

    if name in _OTHERS:
        return getattr(import_module(f".algorithms.core.{_OTHERS[name]}", __name__), name)
    if name == "arrays":
        return import_module(".arrays", __name__)
    if name in _functions():
        return import_module(".algorithms.library.tools", __name__).function(name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    return sorted({*globals(), *_OTHERS, *_functions()})
