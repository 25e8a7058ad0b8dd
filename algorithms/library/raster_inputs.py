"""Rasters that users give: files, rasters of ours, and those of xarray."""

from __future__ import annotations

from os import PathLike, fspath
from typing import Any

import numpy as np

from ..core.errors import BareEarthError
from ..crs.stated import stated_wkt
from ..rasters.content import Content, MemoryRaster
from .rasters import Raster
from .transform import geotransform_of

# Coordinates of xarray may be off from an even distance by this share of it.
_OFF = 1e-3
_NODATA = "_FillValue", "missing_value", "nodata"


def raster_of(given: object, with_cells: bool = True) -> str | MemoryRaster:
    """Return a raster as tools take it, if need be without the values of its cells."""
    if isinstance(given, (str, PathLike)):
        return str(fspath(given))
    if isinstance(given, Raster):
        place, wkt = geotransform_of(given.transform), stated_wkt(given.crs)
        return _made(given, with_cells, given.name, place, wkt, {given.nodata}, about=given.shows)
    if hasattr(given, "dims") and hasattr(given, "coords") and hasattr(given, "dtype"):
        return _of_xarray(given, with_cells)
    raise BareEarthError(
        f"A raster must be a path, a Raster or an xarray.DataArray, not {type(given).__name__}. An"
        " array becomes one by Raster(values, transform, crs)."
    )


def heights_of(given: object) -> str | MemoryRaster:
    """Return a raster of heights as `raster_of` does; refuse one in memory that is a picture."""
    raster = raster_of(given)
    if isinstance(raster, MemoryRaster) and raster.content.values.dtype == np.uint8:
        raise BareEarthError('Give a raster of heights, such as terrain(points)["dtm"].')
    return raster


def _of_xarray(given: Any, with_cells: bool) -> MemoryRaster:
    """Return a raster by its coordinates, and by the attributes that rioxarray gives it."""
    if given.ndim < 2:
        raise _no_raster()
    if {"x", "y"} <= {*given.dims}:
        given = given.transpose(..., "y", "x")
    attributes, name = given.attrs, given.encoding.get("grid_mapping", "spatial_ref")
    about = given.coords[name].attrs if name in given.coords else {}
    place = about.get("GeoTransform", "").split()
    places = []
    for axis, dimension in enumerate(given.dims[-2:]):
        # For others, xarray gives numbers from 0 on.
        centres = np.asarray(given.coords[dimension] if dimension in {*given.coords} else ())
        step = float(place[5 - 4 * axis]) if len(place) == 6 else 0.0
        start = float(place[3 - 3 * axis]) if len(place) == 6 else 0.0
        start, step = _start_and_step(centres, dimension, start, step)
        if not step:
            raise BareEarthError(
                f"The DataArray has no coordinates {dimension}. Give it x and y of the centres of"
                " its cells."
            )
        if (step > 0.0) != bool(axis):  # north comes first, and west
            given = given.isel({dimension: slice(None, None, -1)})
            start, step = start + step * given.sizes[dimension], -step
        places.append((start, step))
    (north, height), (west, width) = places
    wkt = about.get("crs_wkt") or about.get("spatial_ref")
    if not wkt and getattr(given, "rio", None) is not None and given.rio.crs is not None:
        wkt = given.rio.crs.to_wkt()
    nodata = {*map(attributes.get, _NODATA), *attributes.get("nodatavals", ())} - {None}
    scale, offset = (
        float(attributes.get(*usual)) for usual in (("scale_factor", 1), ("add_offset", 0))
    )
    words = (attributes.get(name, "") for name in ("long_name", "units"))
    return _made(
        given, with_cells, given.name, (west, width, 0.0, north, 0.0, height), wkt, nodata,
        scale, offset, *(word if isinstance(word, str) else "" for word in words),
    )  # fmt: skip


def _no_raster() -> BareEarthError:
    return BareEarthError("A raster must have rows and columns, or bands, rows and columns.")


def _start_and_step(
    centres: np.ndarray, name: object, start: float, step: float
) -> tuple[float, float]:
    """Return where the first cell begins, and the distance of cells, by their centres, or else as
    they are stated.
    """
    if centres.dtype.kind not in "iuf":
        raise BareEarthError(f"The coordinates {name} of the DataArray are no numbers.")
    if len(centres) > 1:
        steps = np.diff(centres)
        # Rounding of large coordinates shall not move cells.
        step = float(f"{(centres[-1] - centres[0]) / len(steps):.10g}")
        if not (np.abs(steps - step) <= _OFF * abs(step)).all():
            raise BareEarthError(
                f"The coordinates {name} of the DataArray are not evenly spaced. Give a regular"
                " raster."
            )
    return (round(float(centres[0]) - step / 2.0, 9) if len(centres) else start), step


def _made(
    given: Any,
    with_cells: bool,
    name: str | None,
    place: tuple[float, ...],
    wkt: str | None,
    nodata: set[float],
    scale: float = 1.0,
    offset: float = 0.0,
    about: str = "",
    unit: str = "",
) -> MemoryRaster:
    """Return a raster of an array (rows, columns) or (bands, rows, columns)."""
    shape = given.values.shape
    if len(shape) not in (2, 3):
        raise _no_raster()
    values = np.zeros((1, 0, 0))
    if with_cells:  # those of Dask are only computed where they are needed
        values = np.asarray(given.values).reshape(-1, *shape[-2:])
    kind: Any = values.dtype.type if values.dtype.kind == "f" else float
    valid = ~np.isin(values, [kind(value) for value in nodata])
    name, colour = f"The raster {name}" if name else "The raster", "red" * (len(values) == 3)
    rows, columns = map(int, shape[-2:])
    content = Content(
        values, valid, place, wkt or "", unit, scale, offset, (rows, columns), about, colour
    )
    return MemoryRaster.of(content, name)
