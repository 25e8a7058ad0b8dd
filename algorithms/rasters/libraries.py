"""The libraries that read and write rasters: GDAL (in QGIS) or rasterio (outside)."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType
from typing import Callable, TypeVar

from ..core.errors import BareEarthError
from ..core.temporary import shown

_Function = TypeVar("_Function", bound=Callable[..., object])


def library(by_gdal: _Function, by_rasterio: _Function, task: str) -> _Function:
    """Return the function for the installed library: that for GDAL if both are, as in QGIS."""
    for name in library_name():
        return by_gdal if name == "osgeo" else by_rasterio
    raise BareEarthError(f"{task} a raster needs rasterio: pip install rasterio.")


def library_name() -> list[str]:
    """Return the name of the installed library, if there is one."""
    installed = filter(importlib.util.find_spec, ("osgeo", "rasterio"))
    return list(installed)[:1]


class GdalErrors:
    """Collects the error messages of GDAL, whether or not it is set to raise exceptions; the task,
    "read" or "write", is a word of the errors.
    """

    def __init__(self, gdal: ModuleType, task: str) -> None:
        self._gdal, self._task = gdal, task
        self._texts: list[str] = []

    def __enter__(self) -> GdalErrors:
        self._gdal.PushErrorHandler(self._receive)
        return self

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        self._gdal.PopErrorHandler()
        if isinstance(error, RuntimeError):  # the application made GDAL raise its errors
            raise BareEarthError(f"Cannot {self._task} the raster: {shown(error)}") from error

    def _receive(self, severity: int, number: int, text: str) -> None:
        if severity >= self._gdal.CE_Failure:
            self._texts.append(text)

    def clear(self) -> None:
        """Forget the errors so far."""
        self._texts.clear()

    def check(self, path: str | Path) -> None:
        """Raise the first error, if there was one."""
        if self._texts:
            reason = shown(self._texts[0]).rstrip(".")
            raise BareEarthError(f"Cannot {self._task} {shown(path)}: {reason}.")
