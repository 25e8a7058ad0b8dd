"""The columns of points: arrays, tables of any library, and records of laspy."""

from __future__ import annotations

from os import PathLike
from types import SimpleNamespace
from typing import Any, Iterable

import numpy as np

from ..core.errors import BareEarthError
from ..survey.vector_files import FRAME, is_frame

COORDINATES = ("x", "y", "z")
# Fields of a cloud by the names of columns of tables, in lower case and without underscores.
_NAMES = {
    "x": "x", "y": "y", "z": "z", "classification": "classification",
    "returnnumber": "return_number", "numberofreturns": "number_of_returns",
    "withheld": "withheld", "overlap": "overlap",
}  # fmt: skip
# Bits in the columns of raw records of laspy, by field: column, first bit and number of bits.
_BITS = {
    "return_number": ("bitfields", 0, 3), "number_of_returns": ("bitfields", 3, 3),
    "classification": ("rawclassification", 0, 5), "withheld": ("rawclassification", 7, 1),
}  # fmt: skip
_BITS_FROM_6 = {
    "return_number": ("bitfields", 0, 4), "number_of_returns": ("bitfields", 4, 4),
    "withheld": ("classificationflags", 2, 1), "overlap": ("classificationflags", 3, 1),
}  # fmt: skip
_RAW = {"bitfields", "rawclassification", "classificationflags"}
# The type of coordinates in files.
_STORED = np.dtype(np.int32)


def refuse_beside(values: SimpleNamespace, owner: str, names: Iterable[str]) -> None:
    """Refuse arguments for columns that the points of `owner` already have."""
    for name in names:
        if getattr(values, name) is not None:
            raise BareEarthError(f"{owner} its own {name}: leave the argument {name} out.")


def is_record(points: object) -> bool:
    """Return whether points are a `laspy.LasData`, or its points with scales and offsets."""
    return hasattr(points, "point_format") and (
        hasattr(points, "header") or hasattr(points, "scales")
    )


def columns_of(values: SimpleNamespace) -> dict[str, object]:
    """Return the columns of arrays or of a table, by the fields of a cloud; refuse unscaled
    integers of files.
    """
    columns = _columns_of(values)
    kinds = {
        np.asarray(columns[axis]).dtype
        for axis in COORDINATES
        if not isinstance(columns[axis], (list, tuple))
    }
    are_integers = kinds and all(kind.kind in "iu" for kind in kinds)
    if _STORED in kinds or (are_integers and not _RAW.isdisjoint(columns)):
        raise BareEarthError(
            "x, y and z are integers as files store them, without scale and offset. Give the"
            " laspy.LasData, its points (las.points), or las.x, las.y and las.z; or if they are"
            " coordinates, float64."
        )
    return columns


def _columns_of(values: SimpleNamespace) -> dict[str, object]:
    """Return the columns of points of any type, by the fields of a cloud."""
    points = values.points
    if isinstance(points, (str, PathLike)) or hasattr(points, "chunk_iterator"):
        raise BareEarthError(
            "points must be arrays, not a file. Read it first, such as by laspy.read(), or take the"
            " function of this name in bare_earth."
        )
    if is_frame(points):
        return _of_frame(values)
    if hasattr(points, "point_format"):  # of laspy, but without scales
        points = points.array
    kind = getattr(points, "dtype", None)
    names = getattr(kind, "names", None)
    if kind is not None and names is None:  # an array, or a column of a table
        return _separate(values)
    for kind in ("column_names", "columns"):  # of pyarrow; of pandas and polars
        names = names or getattr(points, kind, None)
    if names is None and hasattr(points, "keys"):
        names = points.keys()
    if names is None:
        return _separate(values)
    refuse_beside(values, "The table of points has", COORDINATES[1:])
    columns = _known(points, names)
    missing = [name.upper() for name in COORDINATES if name not in columns]
    if missing:
        raise BareEarthError(
            f"The table of points has no column {' and no column '.join(missing)}, only"
            f" {', '.join(map(str, names))}."
        )
    return columns


def _known(points: Any, names: Iterable[object]) -> dict[str, object]:
    """Return the columns of a table with a known name, by the fields of a cloud."""
    # A table can have both X, Y and Z of laspy, which are integers, and x, y and z, which are
    # coordinates. Lower case is sorted last, and so replaces upper case.
    known = {str(name).lower().replace("_", ""): name for name in sorted(names, key=str)}
    columns = {name: points[known[name]] for name in sorted(_RAW & known.keys())}
    bits = _BITS_FROM_6 if "classificationflags" in known else _BITS
    for field, (name, start, count) in bits.items():
        if name in known:
            columns[field] = np.asarray(points[known[name]]) >> start & (1 << count) - 1
    columns.update((field, points[known[name]]) for name, field in _NAMES.items() if name in known)
    return columns


def _of_frame(values: SimpleNamespace) -> dict[str, object]:
    """Return the columns of a GeoDataFrame or a GeoSeries, with x, y and z of its geometry."""
    points, shapes = values.points, values.points.geometry
    refuse_beside(values, f"{FRAME} has", COORDINATES[1:])
    if not (shapes.geom_type == "Point").all():
        raise BareEarthError(f"{FRAME} must hold a point in each row, and no other geometry.")
    columns = _known(points, getattr(points, "columns", ()))
    columns.update(x=shapes.x, y=shapes.y)
    if "z" not in columns or shapes.has_z.all():
        columns["z"] = shapes.z
    return columns


def _separate(values: SimpleNamespace) -> dict[str, object]:
    """Return x, y and z from three arrays or from one."""
    if values.y is None and values.z is None:
        xyz = array_of("points", values.points, (None, 3))
        return dict(zip(COORDINATES, xyz.T))
    missing = next((name for name in ("y", "z") if getattr(values, name) is None), None)
    if missing:
        raise BareEarthError(f"{missing} is missing. Give x, y and z, or all as one array (n, 3).")
    return {"x": values.points, "y": values.y, "z": values.z}


def array_of(name: str, given: object, shape: tuple[int | None, ...]) -> np.ndarray:
    """Return an argument as an array of numbers; None in the shape allows any length."""
    if isinstance(given, np.ma.MaskedArray) and np.ma.is_masked(given):
        raise BareEarthError(f"{name} has masked values. Leave these points out.")
    array = np.asarray(given)
    if array.ndim != len(shape) or any(
        wanted not in (None, length) for wanted, length in zip(shape, array.shape)
    ):
        words = ", ".join("n" if length is None else f"{length:,}" for length in shape)
        raise BareEarthError(
            f"{name} must be an array of shape ({words}{',' * (len(shape) == 1)}), not"
            f" {array.shape}."
        )
    if array.dtype.kind not in "biuf":
        raise BareEarthError(f"{name} must be numbers, not {array.dtype}.")
    return array
