"""Points that users give as arrays, as the cloud that a run works on."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Callable, Iterable, Mapping, NamedTuple, TypeVar

import numpy as np

from ..classes.ground_classes import GroundClasses
from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..core.threads import in_threads, parts_of
from ..crs.measurable import require_measurable
from ..crs.stated import crs_text, stated_wkt
from ..crs.system import Crs, crs_of_wkt
from ..las.cloud import PointCloud
from ..las.crs_records import crs_among
from ..las.lasfile import FIRST_EXTENDED_FORMAT
from ..las.reading import COLUMNS
from ..las.return_numbers import count_from_one
from ..survey.vector_files import is_frame
from .blocks import are_blocks
from .columns import COORDINATES, array_of, columns_of, is_record, refuse_beside

# How errors name the points.
_CLOUD = Path("the cloud")
_NUMBERS = ("classification", "return_number", "number_of_returns")
# Arguments for further columns, and the fields that they are.
_ATTRIBUTES = {**{name: name for name in (*_NUMBERS, "withheld")}, "in_overlap": "overlap"}
# Point format 6 holds all classes.
_POINT_FORMAT = FIRST_EXTENDED_FORMAT
# Decimals of coordinates that are looked for: 0.1 micrometres, or 1 cm if they were degrees.
_MOST_DECIMALS = 7
# Decimals to which all other coordinates are rounded.
_ROUNDED = 6
# Coordinates may differ from a multiple of the scale by this many units of their last digit, and at
# most by this share of the scale.
_LAST_DIGITS = 8
_WHOLE = 1e-2
_LARGEST = 2**31 - 1
# Steps of coordinates of 32 bits may be this long.
_LONGEST_STEP = 1e-3
_FIRST = 1000  # points that are looked at first, since most numbers of decimals fail there
_POINTS_A_PART = 1 << 17  # that are worked on at a time

_Found = TypeVar("_Found")


def cloud_of(values: SimpleNamespace, progress: Progress = SILENT) -> PointCloud:
    """Return the points that arguments of a function give; none of their arrays is changed, and
    coordinates of a `laspy.LasData` are not copied.
    """
    points = values.points
    if are_blocks(points):
        raise BareEarthError(
            "Of the functions on arrays only terrain() takes blocks. Call each block, and give what"
            " it returns."
        )
    if is_record(points):
        refuse_beside(values, "The points of laspy have", COORDINATES[1:])
        cloud = _of_las(points, stated_wkt(values.crs), progress)
    else:
        columns = columns_of(values)
        x, y, z = (_coordinates(name, columns.get(name)) for name in COORDINATES)
        if not len(x) == len(y) == len(z):
            raise BareEarthError(
                f"x, y and z have {len(x):,}, {len(y):,} and {len(z):,} values. Give as many of"
                " each."
            )
        axes = [_axis(name, axis) for name, axis in zip(COORDINATES, (x, y, z))]
        integers, scales, offsets = zip(*axes)
        arrays = dict(zip(COORDINATES, integers))
        arrays.update((name, np.zeros(len(x), dtype=np.uint8)) for name in _NUMBERS)
        arrays["withheld"] = np.zeros(len(x), dtype=bool)
        stated = stated_wkt(values.crs or (crs_text(points.crs) if is_frame(points) else None))
        crs = (crs_of_wkt(stated, progress) if stated else None) or Crs()
        cloud = _made(arrays, scales, offsets, _POINT_FORMAT, crs)
        for name in _ATTRIBUTES.values():
            if name in columns:
                setattr(cloud, name, _attribute(name, columns[name], cloud.count))
    for name, field in _ATTRIBUTES.items():
        if getattr(values, name) is not None:
            setattr(cloud, field, _attribute(name, getattr(values, name), cloud.count))
    if not cloud.count:
        raise BareEarthError("There are no points: x, y and z are empty.")
    require_measurable("The cloud", cloud.crs, cloud.box)
    return count_from_one(cloud)


def cloud_with_ground(
    values: SimpleNamespace, ground: GroundClasses, progress: Progress
) -> PointCloud:
    """Return the points as `cloud_of`; the points of the mask `ground`, if it is given, and no
    others have the first of the ground classes.
    """
    cloud, classes = cloud_of(values, progress), [*ground.ground_classes]
    if values.ground is None:
        return cloud
    mask = _attribute("ground", values.ground, cloud.count)
    others = np.where(np.isin(cloud.classification, classes), 1, cloud.classification)
    return replace(cloud, classification=np.where(mask, classes[0], others).astype(np.uint8))


def _coordinates(name: str, given: object) -> np.ndarray:
    """Return one coordinate of all points, with finite numbers."""
    array = array_of(name, given, (None,))
    if not len(array):
        return array
    if array.dtype.kind != "f":
        return array
    # NaN stays in the sum.
    if not all(math.isfinite(float(part)) for part in _of_parts(array, np.sum)):
        count = int(np.count_nonzero(~np.isfinite(array)))
        if count:
            raise BareEarthError(
                f"{name} has {count:,} values that are no finite numbers. Leave these points out."
            )
    if array.dtype.itemsize < 8:
        step = float(np.spacing(np.abs(array).max()))
        if step > _LONGEST_STEP:
            raise BareEarthError(
                f"{name} is {array.dtype}, which has steps of {step:g} here. Give float64."
            )
    return array.astype(np.float64, copy=False)


class _CoordinateAxis(NamedTuple):
    """One coordinate of all points as integers, as in files."""

    integers: np.ndarray  # int32, (n,)
    scale: float
    offset: float  # a multiple of the scale


def _axis(name: str, array: np.ndarray) -> _CoordinateAxis:
    """Return coordinates as multiples of the coarsest power of ten that holds them exactly, or
    rounded to the finest that holds them.
    """
    # Numbers of a file become the integers of the file. Files with equal scales give equal numbers
    # for equal places, and so do arrays.
    if not len(array):
        return _CoordinateAxis(np.zeros(0, dtype=np.int32), 1.0, 0.0)
    low, high = (float(extreme(_of_parts(array, extreme))) for extreme in (np.min, np.max))
    fitting = [
        decimals
        for decimals in range(_MOST_DECIMALS + 1)
        if (high - low) * 10.0**decimals < _LARGEST
    ]
    if not fitting:
        raise BareEarthError(
            f"{name} runs from {low:.10g} to {high:.10g}, which is too far for one survey. Leave"
            " stray points out."
        )
    digit = _LAST_DIGITS * float(np.spacing(max(abs(low), abs(high))))
    exact = (decimals for decimals in fitting if _are_whole(array, decimals, digit))
    decimals = next(exact, min(fitting[-1], _ROUNDED))
    steps = 10.0**decimals
    whole, integers = math.floor(low * steps), np.empty(len(array), dtype=np.int32)

    def convert(part: slice) -> None:
        integers[part] = np.rint(array[part] * steps) - whole

    in_threads(convert, parts_of(len(array), _POINTS_A_PART))
    scale = float(f"1e-{decimals}")
    return _CoordinateAxis(integers, scale, whole * scale)


def _are_whole(array: np.ndarray, decimals: int, error: float) -> bool:
    """Return whether all numbers are multiples of 10^-decimals within a tolerance."""
    steps = 10.0**decimals

    def is_whole(part: slice) -> bool:
        numbers = array[part] * steps
        return bool((np.abs(numbers - np.rint(numbers)) <= error * steps).all())

    if array.dtype.kind != "f":
        return True
    return error * steps < _WHOLE and all(
        is_whole(part) for part in (slice(_FIRST), *parts_of(len(array), _POINTS_A_PART))
    )


def _of_parts(array: np.ndarray, function: Callable[[np.ndarray], _Found]) -> list[_Found]:
    """Return what a function finds for parts of an array."""
    return in_threads(lambda part: function(array[part]), parts_of(len(array), _POINTS_A_PART))


def _attribute(name: str, given: object, count: int) -> np.ndarray:
    """Return a further column of the points, or a mask, as a new array."""
    array = array_of(name, given, (count,))
    if name not in _NUMBERS:
        if array.dtype.kind == "f" or (
            array.dtype.kind != "b" and not np.isin(array, (0, 1)).all()
        ):
            raise BareEarthError(f"{name} must be True or False for each point.")
        return array.astype(bool)
    with np.errstate(invalid="ignore"):
        numbers = array.astype(np.uint8)
    if not np.array_equal(numbers, array):
        raise BareEarthError(f"{name} must be whole numbers from 0 to 255.")
    return numbers


def _of_las(las: Any, stated: str | None, progress: Progress) -> PointCloud:
    """Return the points of a `laspy.LasData`, or of a record, which has no CRS."""
    header, columns = getattr(las, "header", None), dict(COLUMNS)
    point_format = int(las.point_format.id)
    if point_format < FIRST_EXTENDED_FORMAT:
        del columns["scanner_channel"], columns["overlap"]
    names = {*las.point_format.dimension_names}
    arrays = {
        field: np.asarray(las[name]) if field in COORDINATES else np.array(las[name], dtype=kind)
        for field, (name, kind) in columns.items()
        if name in names
    }
    records = [
        _Record((record.user_id, record.record_id), record.record_data_bytes())
        for record in ((*header.vlrs, *(header.evlrs or ())) if header else ())
    ]
    prefers_text = point_format >= FIRST_EXTENDED_FORMAT or bool(
        header and header.global_encoding.wkt
    )
    crs = crs_among(records, prefers_text, stated, "The cloud", progress)
    scaled = header or las
    return _made(arrays, scaled.scales, scaled.offsets, point_format, crs)


def _made(
    arrays: Mapping[str, Any],
    scales: Iterable[float],
    offsets: Iterable[float],
    point_format: int,
    crs: Crs,
) -> PointCloud:
    """Return a cloud, given its columns by their names, and three scales and offsets."""
    scale, offset = ((float(x), float(y), float(z)) for x, y, z in (scales, offsets))
    return PointCloud(
        path=_CLOUD, scale=scale, offset=offset, point_format=point_format, crs=crs, **arrays
    )


class _Record(NamedTuple):
    """A record of a `laspy.LasData`."""

    key: tuple[str, int]
    data: bytes
