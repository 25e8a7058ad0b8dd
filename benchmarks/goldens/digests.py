"""Digests of what tools write: what a user sees, without dates, paths and how libraries pack it."""

from __future__ import annotations

import base64
import contextlib
import hashlib
import html
import json
import re
import sqlite3
import struct
import zlib
from pathlib import Path
from typing import Dict, Iterable, Iterator

import numpy as np

from bare_earth import __version__

# Of each output, "tool/case/output", the digests of its parts.
Digests = Dict[str, str]

# Heights and shares are compared to a thousandth. Sums that are rounded otherwise by another
# processor must not matter, and halves are frequent in means of few numbers, so that the borders
# between two steps lie at no simple fraction.
_STEP, _SHIFT = 1e-3, 0.3183
# Records of LAZ and COPC, which say where in the file something is.
_PACKING = {("laszip encoded", 22204), ("copc", 1), ("copc", 1000)}
_APART = ("X", "Y", "Z", "classification")
_LETTERS = 8

_PATTERNS = tuple(
    (re.compile(pattern), replacement)
    for pattern, replacement in (
        (r"\d{4}-\d\d-\d\d([T ]\d\d:\d\d(:\d\d(\.\d+)?)?Z?)?", "DATE"),
        (r"\b\d[\d,.]* ?(s|seconds?|minutes?|MB|GB|MiB|GiB)\b", r"SOME \1"),
        (r"Seconds by stage:.*", "SECONDS"),
        (r"(?m)^.* jobs? (is|are) done\. The largest took .*\n?", ""),  # only with one processor
        (r"(--memory|--threads) \S+", r"\1 N"),
        (r"[-\u2212](0(\.0+)?)(?![\d.])", r"\1"),
        (r"\r\n", "\n"),
    )
)
_VERSION = re.compile(rf"(?<![\d.]){re.escape(__version__)}(?![\d.])")
_PNG = re.compile(r"data:image/png;base64,([A-Za-z0-9+/=]+)")
_MARKS = re.compile(r"<(style|script).*?</\1>|<[^>]*>", re.DOTALL)
# What JSON says of this run, and not of its result.
_OF_THE_RUN = {"jobs", "seconds", "memory"}


def digest(path: Path, folder: Path) -> str:
    """Return digests of the parts of a file, in one line.

    Parameters
    ----------
    path : Path
        The file.
    folder : Path
        The folder that was worked in: where it is does not matter.
    """
    kind = path.suffix.lower()
    if kind in (".las", ".laz"):
        parts = _of_cloud(path)
    elif kind in (".tif", ".tiff"):
        parts = _of_raster(path)
    elif kind in (".json", ".geojson", ".vpc"):
        parts = {"": _of_json(path.read_text(encoding="utf-8"), folder)}
    elif kind == ".gpkg":
        parts = _of_layers(path)
    elif kind == ".html":
        parts = _of_page(path.read_text(encoding="utf-8"), folder)
    else:
        parts = {"": of_text(path.read_text(encoding="utf-8"), folder)}
    return ", ".join(f"{name} {value}".strip() for name, value in parts.items())


def of_text(text: str, folder: Path) -> str:
    """Return the digest of a text, or of JSON."""
    if text.startswith(("{", "[")) and text.count("\n") <= 1:
        return _of_json(text, folder)
    return _short([plain(text, folder).encode()])


def plain(text: str, folder: Path) -> str:
    """Return a text without what differs from run to run: dates, paths, versions, seconds."""
    for place in {str(folder), folder.as_posix(), str(folder.resolve())}:
        text = text.replace(place, "FOLDER")
    text = _PNG.sub(lambda found: _of_png(found[1]), _VERSION.sub("VERSION", text))
    for pattern, replacement in _PATTERNS:
        text = pattern.sub(replacement, text)
    return text


def _short(parts: Iterable[bytes]) -> str:
    found = hashlib.sha256()
    for part in parts:
        found.update(part)
    return found.hexdigest()[:_LETTERS]


def _of_page(text: str, folder: Path) -> dict[str, str]:
    """Return digests of what a page says, of its pictures, and of all of it with its marks."""
    pictures = [_of_png(letters) for letters in _PNG.findall(text)]
    words = html.unescape(_MARKS.sub(" ", plain(text, folder)))
    return {
        "words": _short([" ".join(words.split()).encode()]),
        "pictures": _short(picture.encode() for picture in pictures),
        "marks": of_text(text, folder),
    }


def _of_png(letters: str) -> str:
    """Return the digest of the pixels of a picture, which libraries compress in different ways."""
    data, cells, start = base64.b64decode(letters), b"", 8
    while start < len(data):
        (length,), name = struct.unpack_from(">I", data, start), data[start + 4 : start + 8]
        cells += data[start + 8 : start + 8 + length] if name == b"IDAT" else b""
        start += length + 12
    return _short([data[16:29], zlib.decompress(cells)])


def _of_cloud(path: Path) -> dict[str, str]:
    import laspy

    las = laspy.read(path)
    header = las.header
    records = [*header.vlrs, *(header.evlrs or [])]
    about = [
        header.version, header.point_format, header.uuid, header.creation_date,
        header.system_identifier, header.global_encoding.value, *header.scales, *header.offsets,
        *header.mins, *header.maxs, header.point_count, *header.number_of_points_by_return,
    ]  # fmt: skip
    told = [repr([str(value) for value in about]).encode()]
    for record in records:
        if (record.user_id, record.record_id) not in _PACKING:
            told += [f"{record.user_id} {record.record_id}".encode(), record.record_data_bytes()]
    names = [name for name in las.point_format.dimension_names if name not in _APART]
    return {
        "places": _short(np.ascontiguousarray(las[name]).tobytes() for name in "XYZ"),
        "classes": _short([np.ascontiguousarray(las.classification).tobytes()]),
        "others": _short(part for name in names for part in _of_column(name, las[name])),
        "header": _short(told),
    }


def _of_column(name: str, values: object) -> Iterator[bytes]:
    column = np.ascontiguousarray(values)
    yield name.encode()
    yield (column if column.dtype.kind in "iu" else _steps(column)).tobytes()


def _of_raster(path: Path) -> dict[str, str]:
    about, bands = _read_raster(path)
    kept = [band if band.dtype == np.uint8 else _steps(band) for band in bands]
    return {
        "cells": _short(band.tobytes() for band in kept),
        "about": _short([plain(repr(about), path.parent).encode()]),
    }


def _steps(values: np.ndarray) -> np.ndarray:
    """Return numbers rounded to steps, as integers; NaN and no data have one of their own."""
    far = ~(np.abs(values) < 1e9)
    return np.where(far, -(2**62), np.floor(np.where(far, 0.0, values) / _STEP + _SHIFT)).astype(
        "<i8"
    )


def _read_raster(path: Path) -> tuple[list[object], list[np.ndarray]]:
    """Return what a raster says of itself, and its bands, by rasterio or by GDAL."""
    try:
        import rasterio
    except ImportError:
        return _read_by_gdal(path)
    with rasterio.open(path) as raster:
        tags, crs, numbers = raster.tags(), raster.crs, range(raster.count)
        about = [
            [*raster.transform.to_gdal()], raster.nodata, [*raster.dtypes],
            [raster.descriptions[number] or "" for number in numbers],
            [raster.units[number] or "" for number in numbers],
            [raster.colorinterp[number].name for number in numbers],
            _name_of_crs(crs.to_wkt() if crs else ""), tags.get("TIFFTAG_SOFTWARE"),
        ]  # fmt: skip
        return about, [*raster.read()]


def _read_by_gdal(path: Path) -> tuple[list[object], list[np.ndarray]]:
    from osgeo import gdal

    raster = gdal.Open(str(path))
    bands = [raster.GetRasterBand(number + 1) for number in range(raster.RasterCount)]
    cells = [band.ReadAsArray() for band in bands]
    colours = [gdal.GetColorInterpretationName(band.GetColorInterpretation()) for band in bands]
    about = [
        [*raster.GetGeoTransform()], bands[0].GetNoDataValue(), [part.dtype.name for part in cells],
        [band.GetDescription() for band in bands], [band.GetUnitType() for band in bands],
        [name.lower() for name in colours], _name_of_crs(raster.GetProjection()),
        raster.GetMetadataItem("TIFFTAG_SOFTWARE"),
    ]  # fmt: skip
    return about, cells


def _name_of_crs(wkt: str) -> str:
    """Return the first name in a WKT, which all versions of PROJ write alike."""
    return next(iter(re.findall(r'"([^"]*)"', wkt)), "")


def _of_json(text: str, folder: Path) -> str:
    found = json.loads(plain(text, folder))
    return _short([json.dumps(_rounded(found), sort_keys=True).encode()])


def _rounded(value: object) -> object:
    """Return JSON with rounded numbers, without what is of the run, and features in one order."""
    if isinstance(value, dict):
        found = {name: _rounded(item) for name, item in value.items() if name not in _OF_THE_RUN}
        if isinstance(found.get("features"), list):
            found["features"] = sorted(found["features"], key=json.dumps)
        return found
    if isinstance(value, list):
        return [_rounded(item) for item in value]
    return _rounded_number(value) if isinstance(value, float) else value


def _rounded_number(value: float) -> object:
    """Return in which step a number lies: of a thousandth, or of small ones so much finer."""
    if not abs(value) < 1e15:
        return str(value)
    step = _STEP if abs(value) >= 1.0 else 10.0 ** (np.floor(np.log10(max(abs(value), 1e-9))) - 4)
    return int(np.floor(value / step + _SHIFT))


def _of_layers(path: Path) -> dict[str, str]:
    """Return the digest of each layer of a GeoPackage, its features in one order."""
    found = {}
    with contextlib.closing(sqlite3.connect(path)) as base:
        layers = base.execute(
            "SELECT table_name, column_name, srs_id, geometry_type_name FROM gpkg_geometry_columns"
        )
        for layer, column, *about in layers.fetchall():
            rows = base.execute(f'SELECT * FROM "{layer}"')
            names = [name for name, *_ in rows.description]
            features = [dict(zip(names, row)) for row in rows]
            for feature in features:
                feature.pop("fid", None)
                feature[column] = _places(feature[column])
            words = sorted(json.dumps(_rounded(feature), sort_keys=True) for feature in features)
            found[layer] = _short(word.encode() for word in (repr(about), *words))
    return found


def _places(blob: bytes) -> list[object]:
    """Return the types and coordinates of a geometry of a GeoPackage, as one list."""
    envelope = (0, 32, 48, 48, 64)[blob[3] >> 1 & 7]
    data, found, start = blob[8 + envelope :], [], 0

    def geometry(start: int) -> int:
        (kind,) = struct.unpack_from("<I", data, start + 1)
        kind, depth = kind % 1000 & 0xFF, 3 if kind >= 1000 or kind & 0x80000000 else 2
        found.append(kind)
        start += 5
        if kind == 1:
            return points(start, 1, depth)
        (count,) = struct.unpack_from("<I", data, start)
        start += 4
        if kind == 2:
            return points(start, count, depth)
        for _ in range(count):
            if kind == 3:
                (length,) = struct.unpack_from("<I", data, start)
                start = points(start + 4, length, depth)
            else:
                start = geometry(start)
        return start

    def points(start: int, count: int, depth: int) -> int:
        found.extend(struct.unpack_from(f"<{count * depth}d", data, start))
        return start + 8 * count * depth

    geometry(start)
    return found
