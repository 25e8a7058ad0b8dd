"""Functions on arrays: points in memory in, classes, heights and rasters in memory out.

They have the names and parameters of the functions for files, and give the same results.

>>> from bare_earth import arrays
>>> import laspy
>>> las = laspy.read("tile.laz")  # doctest: +SKIP
>>> ground = arrays.ground(las)  # doctest: +SKIP
>>> arrays.terrain(las, ground=ground)["dtm"].to_xarray()  # doctest: +SKIP
"""

from .algorithms.library import array_names as _functions

_RASTER = "Raster"
__all__ = [_RASTER, *_functions()]


def __getattr__(name):
    from importlib import import_module

    if name in __all__:
        module = import_module(".algorithms.library.arrays", __package__)
        return module.Raster if name == _RASTER else module.function(name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__():
    return sorted({*globals(), *__all__})
