"""Virtual point clouds (.vpc): small files that list many point clouds.

They are feature collections of STAC items, as `pdal_wrench build_vpc` and QGIS use them.

References
----------
https://github.com/PDAL/wrench/blob/main/vpc-spec.md
STAC item 1.0.0 with the extensions "pointcloud" 1.0.0 and "projection" 1.1.0
"""

from __future__ import annotations

import datetime
import json
import os
import re
from pathlib import Path
from typing import Any, Iterable, NamedTuple
from urllib.parse import unquote, urlsplit

import numpy as np

from ..core.errors import BareEarthError, printable
from ..core.files import check_output, replacing
from ..core.progress import SILENT, Progress
from ..crs.provider import to_wgs84
from ..crs.system import compound_wkt
from ..las.crs_records import read_crs
from ..las.extrabytes import extra_dimensions
from ..las.header import CREATION
from ..las.lasfile import LasFile
from ..las.opening import open_las
from ..las.sources import read_text

SUFFIX = ".vpc"
# Ending of the file with a few points of all files that `pdal_wrench build_vpc --overview` writes.
_OVERVIEW = "-overview.copc.laz"
_EXTENSIONS = [
    "https://stac-extensions.github.io/pointcloud/v1.0.0/schema.json",
    "https://stac-extensions.github.io/projection/v1.1.0/schema.json",
]
# Such as "s3://" or "https://", but not a single letter, which is a drive of Windows.
_REMOTE = re.compile(r"[a-z][a-z0-9+.-]+://|/vsi", re.IGNORECASE)


class Dimension(NamedTuple):
    """A dimension of points, in the terms of PDAL, which QGIS offers for styles."""

    name: str
    type: str
    size: int


_LOCATION = [Dimension(name, "floating", 8) for name in "XYZ"]
_ALWAYS = [
    Dimension(name, "unsigned", size)
    for name, size in (
        ("Intensity", 2),
        ("ReturnNumber", 1),
        ("NumberOfReturns", 1),
        ("ScanDirectionFlag", 1),
        ("EdgeOfFlightLine", 1),
        ("Classification", 1),
        ("Synthetic", 1),
        ("KeyPoint", 1),
        ("Withheld", 1),
        ("Overlap", 1),
        ("UserData", 1),
        ("PointSourceId", 2),
    )
]
_ANGLE = Dimension("ScanAngleRank", "floating", 4)
_TIME = Dimension("GpsTime", "floating", 8)
_CHANNEL = Dimension("ScanChannel", "unsigned", 1)
_INFRARED = Dimension("Infrared", "unsigned", 2)
_COLOURS = [Dimension(name, "unsigned", 2) for name in ("Red", "Green", "Blue")]


def read_vpc(path: Path) -> list[Path]:
    """Return the files that a virtual point cloud lists, without opening them; refuse it if it
    lists no files, or files that are not on this computer.
    """
    # Relative paths start from the folder of the virtual point cloud.
    path = Path(path)
    try:
        content = json.loads(read_text(path))
    except (ValueError, RecursionError) as error:
        raise _not_one(path, "it is not JSON") from error
    if not isinstance(content, dict) or content.get("type") != "FeatureCollection":
        raise _not_one(path, "it is not a feature collection")
    files = []
    try:
        for number, feature in enumerate(content["features"], start=1):
            href = _href(feature["assets"])
            files.append(_path_of(href, path.parent))
            if files[-1].is_dir():
                name = feature.get("id") or f"number {number}"
                raise BareEarthError(
                    f'The entry {name} of {path} names no file, but "{printable(href)}". QGIS'
                    " writes this for files on another drive of Windows. Build it again in a folder"
                    " on the drive of the files, or give the files themselves."
                )
    except (
        KeyError, TypeError, ValueError, AttributeError, IndexError, OverflowError, OSError,
        StopIteration,
    ) as error:  # fmt: skip
        raise _not_one(path, "one of its features names no file") from error
    if not files:
        raise BareEarthError(f"{path} lists no files. Build it again.")
    return files


def is_overview(path: Path) -> bool:
    """Return whether a file holds a few points of the files that the list beside it names."""
    stem = path.name[: -len(_OVERVIEW)]
    return path.name.endswith(_OVERVIEW) and path.with_name(f"{stem}{SUFFIX}").is_file()


def check_vpc(path: Path) -> None:
    """Refuse a name that is not one of a virtual point cloud; raise BareEarthError."""
    if path.suffix.lower() != SUFFIX:
        raise BareEarthError(f"Cannot write {path}: name it {SUFFIX}.")


def write_vpc(
    path: Path,
    files: Iterable[Path],
    progress: Progress = SILENT,
    stated: str | None = None,
) -> None:
    """Write a virtual point cloud with paths relative to its folder, so that it can be moved
    together with the files.
    """
    # QGIS shows the points of COPC files, and only outlines of other files. Only the headers of the
    # files are read.
    path, files = Path(path), [*map(Path, files)]
    check_vpc(path)
    if not files:
        raise BareEarthError(f"Cannot write {path}: there are no files to list. Give at least one.")
    check_output(path, tuple(files))
    layouts, features, unplaced = [open_las(file, stated) for file in files], [], 0
    for number, layout in enumerate(layouts, start=1):
        feature = _feature(path, layout)
        unplaced += not feature["properties"]["proj:wkt2"]
        features.append(feature)
        progress(number / len(files))
    _make_ids_unique(features)
    if unplaced:
        progress.warning(
            f"{path.name} does not state the CRS of {unplaced} of its {len(files)} files: it is not"
            " known, or neither GDAL nor pyproj is installed. Set the CRS of the layer in QGIS."
        )
    text = json.dumps(
        {"type": "FeatureCollection", "features": features}, indent=1, allow_nan=False
    )
    with replacing(path) as temporary:
        temporary.write_text(text + "\n", encoding="utf-8")


def _not_one(path: Path, why: str) -> BareEarthError:
    return BareEarthError(
        f"{path} is not a virtual point cloud: {why}. Give one that QGIS or 'pdal_wrench build_vpc'"
        " made."
    )


def _href(assets: dict[str, dict[str, Any]]) -> str:
    """Return the reference to the points, not to an overview of them."""
    asset = assets.get("data")
    if asset is None:
        asset = next(asset for asset in assets.values() if "overview" not in asset.get("roles", ()))
    if not isinstance(asset["href"], str) or "\0" in asset["href"]:
        raise TypeError
    os.fsencode(asset["href"])  # fails for texts that cannot be the name of a file
    return asset["href"]


def _path_of(href: str, folder: Path) -> Path:
    if href.lower().startswith("file:"):
        from urllib.request import url2pathname  # it loads all of HTTP, for few who need it

        parts = urlsplit(href)
        host = f"//{parts.netloc}" if parts.netloc not in ("", "localhost") else ""
        return Path(url2pathname(host + parts.path))
    if _REMOTE.match(href):
        raise BareEarthError(
            f"{href} is not on this computer. Download it, and build the virtual point cloud again."
        )
    path = folder / href
    # Some programs write plain paths, and some write paths as in a URL.
    if "%" in href and not path.exists() and (folder / unquote(href)).exists():
        return folder / unquote(href)
    return path


def _feature(target: Path, layout: LasFile) -> dict[str, Any]:
    """Return the STAC item of a file."""
    extent = [*layout.minimum, *layout.maximum]
    if not layout.states_extent:
        raise no_extent(layout)
    west, south, low, east, north, high = extent
    ring = np.array(
        [(west, south), (east, south), (east, north), (west, north), (west, south)], dtype=float
    )
    wkt = compound_wkt(read_crs(layout)) or ""
    globe = to_wgs84(wkt, ring) if wkt else None
    if globe is None:
        # pdal_wrench does the same without a CRS. If a CRS was stated, QGIS would take these
        # coordinates as degrees and leave the file out.
        wkt, globe = "", ring
    return {
        "type": "Feature",
        "stac_version": "1.0.0",
        "stac_extensions": _EXTENSIONS,
        "id": layout.path.stem,
        "geometry": _polygon(globe),
        "bbox": [*globe.min(axis=0).tolist(), low, *globe.max(axis=0).tolist(), high],
        "properties": {
            "datetime": _creation(layout),
            "pc:count": layout.count,
            "pc:type": "lidar",
            "pc:encoding": "LASzip" if layout.is_compressed else "LAS",
            "pc:schemas": [dimension._asdict() for dimension in _dimensions(layout)],
            "proj:wkt2": wkt,
            "proj:geometry": _polygon(ring),
            "proj:bbox": extent,
        },
        "links": [],
        "assets": {"data": {"href": _reference(layout.path, target), "roles": ["data"]}},
    }


def no_extent(layout: LasFile) -> BareEarthError:
    """Return the error for a header without the extent of the points."""
    return BareEarthError(
        f"The header of {layout.path} does not state the extent of its points. Write the file"
        " again with a program that corrects the header."
    )


def _polygon(ring: np.ndarray) -> dict[str, object]:
    return {"type": "Polygon", "coordinates": [ring.tolist()]}


def _creation(layout: LasFile) -> str:
    """Return the day of the header; in 1970 if the year is not valid, as pdal_wrench does."""
    day, year = CREATION.get(layout.header)
    year = year if 1 <= year <= 9999 else 1970
    date = datetime.date(year, 1, 1)
    if 1 <= day <= datetime.date(year, 12, 31).timetuple().tm_yday:
        date += datetime.timedelta(days=day - 1)
    return f"{date.isoformat()}T00:00:00Z"


def _dimensions(layout: LasFile) -> list[Dimension]:
    number = layout.point_format
    dimensions = [*_LOCATION, *_ALWAYS, _ANGLE]
    if number not in (0, 2):
        dimensions.append(_TIME)
    if number >= 6:
        dimensions.append(_CHANNEL)
    if number in (2, 3, 5, 7, 8, 10):
        dimensions += _COLOURS
    if number in (8, 10):
        dimensions.append(_INFRARED)
    return dimensions + [Dimension(*extra) for extra in extra_dimensions(layout)]


def _reference(file: Path, target: Path) -> str:
    """Return the path of a file for the virtual point cloud, relative if possible."""
    # Folders are resolved, because ".." behind a symbolic link means another folder.
    place = file.parent.resolve() / file.name
    try:
        return "./" + Path(os.path.relpath(place, target.parent.resolve())).as_posix()
    except ValueError:  # another drive of Windows
        return place.as_posix()


def _make_ids_unique(features: list[dict[str, Any]]) -> None:
    seen: dict[str, int] = {}
    for feature in features:
        name = feature["id"]
        seen[name] = seen.get(name, 0) + 1
        if seen[name] > 1:
            feature["id"] = f"{name}-{seen[name]}"
