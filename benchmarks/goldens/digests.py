"""Digests of what tools write: what a user sees, without dates, paths and how libraries pack it.

Labels, words and bytes count exactly, measured numbers as `numbers` keeps them.
"""

from __future__ import annotations

import base64
import html
import json
import re
import struct
import zlib
from pathlib import Path
from typing import Any, Dict

import numpy as np

from bare_earth import __version__

from . import numbers
from .features import of_json, of_layers

# Of each output, "tool/case/output", the digests of its parts.
Digests = Dict[str, str]

# Records of LAZ and COPC, which say where in the file something is. Old laspy names some of these
# only by their class.
_PACKING = {("laszip encoded", 22204), ("copc", 1), ("copc", 1000)}
_PACKING_CLASSES = ("CopcInfoVlr", "CopcHierarchyVlr")
# What LAS 1.4 says of the columns that a producer added, in 192 bytes each.
_COLUMNS, _COLUMN, _FLOATING = ("LASF_Spec", 4), 192, (9, 10)
_APART = ("X", "Y", "Z", "classification")
# Floating columns that are copied.
_COPIED = {"gps_time", "reflectance"}
# Rasters of small integers that are no labels.
_PICTURES = re.compile("Brightness|Red relief|Archaeological topography")

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
        parts = of_json(json.loads(plain(path.read_text(encoding="utf-8"), folder)))
    elif kind == ".gpkg":
        parts = of_layers(path)
    elif kind == ".html":
        parts = _of_page(path.read_text(encoding="utf-8"), folder)
    else:
        return of_text(path.read_text(encoding="utf-8"), folder)
    return _joined(parts)


def of_text(text: str, folder: Path) -> str:
    """Return the digest of a text, or of JSON, that may hold measured numbers."""
    if text.startswith(("{", "[")) and text.count("\n") <= 1:
        return _joined(of_json(json.loads(plain(text, folder))))
    words, found = numbers.without_decimals(plain(text, folder))
    return _joined({"": numbers.exactly([words.encode()]), "numbers": numbers.printed(found)})


def of_fixed_text(text: str, folder: Path) -> str:
    """Return the digest of a text in which nothing is measured, such as help."""
    return numbers.exactly([plain(text, folder).encode()])


def _joined(parts: dict[str, str]) -> str:
    return ", ".join(f"{name} {value}".strip() for name, value in parts.items() if value)


def plain(text: str, folder: Path) -> str:
    """Return a text without what differs from run to run: dates, paths, versions, seconds."""
    for place in {str(folder), folder.as_posix(), str(folder.resolve())}:
        text = text.replace(place, "FOLDER")
    text = _PNG.sub("PICTURE", _VERSION.sub("VERSION", text))
    for pattern, replacement in _PATTERNS:
        text = pattern.sub(replacement, text)
    return text


def _of_page(text: str, folder: Path) -> dict[str, str]:
    """Return digests of what a page says, of its pictures, and of all of it with its marks."""
    shown = plain(text, folder)
    said = " ".join(html.unescape(_MARKS.sub(" ", shown)).split())
    words, found = numbers.without_decimals(said)
    marks, drawn = numbers.without_decimals(shown)
    places = numbers.in_last_places(drawn)
    return {
        "words": numbers.exactly([words.encode()]),
        "numbers": numbers.printed(found),
        **{f"picture-{n}": _of_png(png) for n, png in enumerate(_PNG.findall(text), start=1)},
        "marks": numbers.exactly([marks.encode()]),
        "drawn": numbers.in_groups(places, numbers.COORDINATES, 1.0),
    }


def _of_png(letters: str) -> str:
    """Return the sums of the pixels of a picture, which libraries compress in different ways.

    The pages have pictures of 8 bits a channel, whose rows are not filtered.
    """
    data, cells, start = base64.b64decode(letters), b"", 8
    while start < len(data):
        (length,), name = struct.unpack_from(">I", data, start), data[start + 4 : start + 8]
        cells += data[start + 8 : start + 8 + length] if name == b"IDAT" else b""
        start += length + 12
    height = struct.unpack_from(">I", data, 20)[0]
    rows = np.frombuffer(zlib.decompress(cells), np.uint8).reshape(height, -1)
    return numbers.in_squares(rows, numbers.PIXELS * 3, numbers.SHADE)


def _of_cloud(path: Path) -> dict[str, str]:
    import laspy

    las = laspy.read(path)
    names = [name for name in las.point_format.dimension_names if name not in _APART]
    measured = [n for n in names if n not in _COPIED and np.asarray(las[n]).dtype.kind == "f"]
    header, extremes = _of_header(las.header)
    return {
        "places": _of_columns(las, ["X", "Y", "Z"]),
        "classes": _of_columns(las, ["classification"]),
        "others": _of_columns(las, [name for name in names if name not in measured]),
        **{name: numbers.in_groups(las[name], numbers.POINTS, numbers.STEP) for name in measured},
        "header": header,
        "extremes": numbers.rounded(extremes),
    }


def _of_columns(las: Any, names: list[str]) -> str:
    return numbers.exactly(
        name.encode() + np.ascontiguousarray(las[name]).tobytes() for name in names
    )


def _of_header(header: Any) -> tuple[str, list[float]]:
    """Return the digest of a header, and the extremes of floating columns in it."""
    about = [
        header.version, header.point_format, header.uuid, header.creation_date,
        header.system_identifier, header.global_encoding.value, *header.scales, *header.offsets,
        *header.mins, *header.maxs, header.point_count, *header.number_of_points_by_return,
    ]  # fmt: skip
    told, extremes = [repr([str(value) for value in about]).encode()], []
    for record in [*header.vlrs, *(header.evlrs or [])]:
        if type(record).__name__ in _PACKING_CLASSES:
            continue
        key, data = (record.user_id, record.record_id), bytearray(record.record_data_bytes())
        if key == _COLUMNS:
            for start in range(0, len(data), _COLUMN):
                extremes += _extremes(data, start)
        if key not in _PACKING:
            told += [f"{key[0]} {key[1]}".encode(), bytes(data)]
    return numbers.exactly(told), extremes


def _extremes(data: bytearray, start: int) -> list[float]:
    """Return the extremes of a floating column that is measured, and blank those of all floating
    ones in the record of columns: for copied ones, versions of laspy write others in the input.
    """
    if data[start + 2] not in _FLOATING:
        return []
    found = [struct.unpack_from("<d", data, start + place)[0] for place in (64, 88)]
    data[start + 64 : start + 112] = bytes(48)
    if data[start + 4 : start + 36].rstrip(b"\0").decode() not in _COPIED:
        return found
    data[start + 3] = 0  # says whether there are extremes
    return []


def _of_raster(path: Path) -> dict[str, str]:
    about, bands = _read_raster(path)
    side, step = numbers.CELLS, numbers.STEP
    if bands[0].dtype.kind in "iu":
        if not _PICTURES.search(repr(about)):
            cells = {"labels": numbers.exactly(band.tobytes() for band in bands)}
            return {**cells, "about": numbers.exactly([plain(repr(about), path.parent).encode()])}
        side, step = numbers.PIXELS, numbers.SHADE
    names = ["cells"] if len(bands) == 1 else [f"band-{n}" for n in range(1, len(bands) + 1)]
    return {
        **{name: numbers.in_squares(band, side, step) for name, band in zip(names, bands)},
        "about": numbers.exactly([plain(repr(about), path.parent).encode()]),
    }


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
