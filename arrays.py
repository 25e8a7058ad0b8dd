"""Functions on arrays: points in memory in, classes, heights and rasters in memory out.

They have the names and parameters of the functions for files, and give the same results.

>>> from bare_earth import arrays
>>> import laspy
>>> las = laspy.read("tile.laz")  # doctest: +SKIP
>>> ground = arrays.ground(las)  # doctest: +SKIP
>>> arrays.terrain(las, ground=ground)["dtm"].to_xarray()  # doctest: +SKIP
"""

from .algorithms.library import ARRAY_CLASSES as _CLASSES
from .algorithms.library import array_names as _functions

__all__ = [*_CLASSES, *_functions()]


def __getattr__(name):
    from importlib import import_module

    if name in __all__:
        place = _CLASSES.get(name, "arrays")
        module = import_module(f".algorithms.library.{place}", __package__)
        return getattr(module, name) if name in _CLASSES else module.function(name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    return sorted({*globals(), *__all__})
