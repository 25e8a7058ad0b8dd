"""The part of an EPT data set that an area and a resolution need, as one file.

Entwine Point Tiles are a folder of files: a description, the octree as JSON, and a small point
cloud for each node. Nothing can be joined there: each tile is one request. A tile is a whole LAZ
file, and its own header counts: some have other offsets than the description says.

References
----------
Entwine Point Tile specification 1.1, https://entwine.io/entwine-point-tile.html
"""

from __future__ import annotations

import hashlib
import json
import re
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np

from ..core.errors import BareEarthError
from ..core.files import temporary_folder
from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..core.temporary import remove
from ..crs.provider import library
from ..crs.stated import stated_wkt
from ..crs.system import Crs, crs_of_wkt
from ..las import header as fields
from ..las.crs_records import GEOKEY_RECORDS, WKT_RECORD
from ..las.edits import Edits
from ..las.header_edits import with_count, with_statistics
from ..las.lasfile import LARGEST_VLR, LASZIP, LasFile, new_vlr
from ..las.opening import open_las
from ..las.records import HeaderCounts, column, read_records
from ..las.sources import open_source
from ..las.writing import write_changed
from ..survey.area import Area
from ..survey.shapes import Place
from ..survey.window import are_inside
from .addresses import beside, is_address, name_of, shown
from .answers import Missing
from .copc import EVERYWHERE, area_of, levels_of
from .ept_records import Schema
from .parts import Parts
from .transfers import Transfers

DESCRIPTION = "ept.json"
_ENDINGS = {"laszip": "laz", "binary": "bin", "zstandard": "zst"}
Key = tuple[int, int, int, int]  # depth, x, y and z of a node
_KEY = re.compile(r"(\d{1,2})-(\d{1,10})-(\d{1,10})-(\d{1,10})")
_DEEPEST, _GPS_TIME_TYPE, _WKT = 30, 0x01, 0x10
# Most bytes of the description and of a file of the hierarchy, and of a point in a tile.
_MOST_JSON, _MOST_A_POINT = 1 << 28, 200
# Bytes that a compressed point usually has.
_USUAL = 7
# Places may differ by this share of a step when the integers of a tile are moved to another offset.
_WHOLE = 0.01


class EptPart:
    """What an area and a resolution need of an EPT data set: tiles."""

    is_exact = is_whole = False

    def __init__(
        self,
        transfers: Transfers,
        address: str,
        waiting: Path,
        area: Area | None = None,
        resolution: float | None = None,
        skips_missing: bool = False,
        progress: Progress = SILENT,
    ) -> None:
        self._transfers, self._address, self._skips = transfers, address, skips_missing
        self.name = name_of(beside(address, "")) or name_of(address)
        text = self._whole(DESCRIPTION, _MOST_JSON)
        about = self._description(text)
        self.box: Box = self._numbers(about.get("boundsConforming") or self._cube)
        self._wkt = _wkt_of(about.get("srs") or {})
        self.crs = (crs_of_wkt(self._wkt) if self._wkt else None) or Crs()
        self.area = area_of(area, Place(self.name, self.crs, self.box), progress)
        self._parts = Parts(waiting, address)
        if is_address(address):
            self._parts.begin({"digest": hashlib.sha256(text).hexdigest()}, True)
        spacing = (self._cube[3] - self._cube[0]) / self._span
        self._levels = levels_of(spacing, resolution, self.crs, self.box)
        self._near = EVERYWHERE if self.area is None else self.area.bounds
        self.tiles = self._find_tiles(progress)
        self.point_count, self.missing_count = sum(self.tiles.values()), 0
        missing = [key for key in self.tiles if not self._path(key).is_file()]
        self._waiting = missing if is_address(address) else []
        self.request_count = len(self._waiting)
        self.size = _USUAL * sum(self.tiles[key] for key in self._waiting)

    def _description(self, text: bytes) -> dict[str, Any]:
        """Return the description, after checks of what is used of it."""
        try:
            about: dict[str, Any] = json.loads(text)
            self._cube = tuple(map(float, about["bounds"]))
            self._span, self.kind = int(about["span"]), str(about["dataType"])
            is_sound = len(self._cube) == 6 and bool(np.isfinite(self._cube).all())
            is_sound = is_sound and self._span > 0 and self._cube[3] > self._cube[0]
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
            raise self._no_ept("its description cannot be read") from error
        if not is_sound:
            raise self._no_ept("its cube has no size")
        is_read_here = self.kind == "laszip" or is_address(self._address)
        if self.kind not in _ENDINGS or not is_read_here:
            raise BareEarthError(
                f"The tiles of {shown(self._address)} are {self.kind}, which cannot be read here."
                " Use 'pdal translate'."
            )
        if self.kind != "laszip":
            try:
                self._schema = Schema(about["schema"])
            except (ValueError, TypeError, KeyError, AttributeError) as error:
                raise self._no_ept("its schema cannot be read") from error
        return about

    def _numbers(self, bounds: Any) -> Box:
        """Return smallest x and y, largest x and y of bounds in the description."""
        try:
            west, south, _, east, north, _ = map(float, bounds)
        except (TypeError, ValueError) as error:
            raise self._no_ept("its extent cannot be read") from error
        return west, south, east, north

    def _find_tiles(self, progress: Progress) -> dict[Key, int]:
        """Return the points of the tiles that are needed, by their keys in order."""
        found: dict[Key, int] = {}
        files: list[Key] = [(0, 0, 0, 0)]
        seen: set[Key] = set()
        while files:
            seen |= {*files}
            tasks = [partial(self._read_hierarchy, key) for key in files]
            pages = self._transfers.run(tasks, progress.quiet())
            entries = {key: count for page in pages for key, count in page.items()}
            files = [key for key, count in entries.items() if count < 0 and key not in seen]
            found.update((key, count) for key, count in entries.items() if count > 0)
        return dict(sorted(found.items()))

    def _read_hierarchy(self, key: Key) -> dict[Key, int]:
        """Return the needed nodes of a file of the hierarchy, -1 for those with a file of their
        own.
        """
        name = f"ept-hierarchy/{_name(key)}.json"
        try:
            entries = json.loads(self._whole(name, _MOST_JSON))
            matches = [_KEY.fullmatch(text) for text in entries]
            keys = np.array([match.groups() for match in matches], dtype=np.int64)  # type: ignore[union-attr]
            counts = np.array([*entries.values()], dtype=np.int64)
        except (ValueError, TypeError, AttributeError, RecursionError, OverflowError) as error:
            raise self._no_ept(f"{name} cannot be read") from error
        keys = keys.reshape(-1, 4)
        side = np.exp2(np.clip(keys[:, 0], 0, _DEEPEST))
        if (keys[:, 0] > _DEEPEST).any() or (keys[:, 1:] >= side[:, None]).any():
            raise self._no_ept(f"{name} names tiles outside of the cube")
        width = (self._cube[3] - self._cube[0]) / side
        # As wide as a tile may be by rounding.
        more = width * 1e-6 + 0.01
        west, south = (self._cube[axis] + keys[:, 1 + axis] * width for axis in (0, 1))
        needed = (west - more <= self._near[2]) & (west + width + more >= self._near[0])
        needed &= (south - more <= self._near[3]) & (south + width + more >= self._near[1])
        needed &= keys[:, 0] < self._levels
        return {
            (depth, x, y, z): count
            for (depth, x, y, z), count in zip(keys[needed].tolist(), counts[needed].tolist())
        }

    def fetch(self, progress: Progress) -> None:
        """Get the tiles, each by one request; refuse missing ones, or count them if they may be
        skipped.
        """

        def get(key: Key) -> bool:
            most = self.tiles[key] * _MOST_A_POINT + (1 << 20)
            try:
                data = self._whole(f"ept-data/{_name(key)}.{_ENDINGS[self.kind]}", most)
            except Missing as error:
                if self._skips:
                    return False
                raise BareEarthError(
                    f"{error} If it is a tile that is missing in this data set, go on without it:"
                    " --skip-missing."
                ) from error
            if self.kind != "laszip":
                try:
                    data = self._schema.las(data, self.kind == "zstandard", self.tiles[key])
                except (ValueError, OverflowError) as error:
                    raise self._no_ept(f"tile {_name(key)} is damaged") from error
            self._parts.add_file(self._path(key).name, data)
            self._open(key)
            return True

        tasks = [partial(get, key) for key in self._waiting]
        there = self._transfers.run(tasks, progress, self.size)
        gone = [key for key, is_there in zip(self._waiting, there) if not is_there]
        self.missing_count = len(gone)
        if gone:
            points = sum(self.tiles.pop(key) for key in gone)
            self._transfers.progress.warning(
                f"{len(gone)} tiles of {self.name} with {points:,} points are missing on the"
                " server: the points have gaps."
            )

    def write(self, target: Path, progress: Progress = SILENT) -> int:
        """Write the points as LAZ, or as COPC if the name says so, after they have been fetched;
        return their number, 0 if none lies in the area.
        """
        with temporary_folder(target.parent) as folder:
            plain = folder / "points.las"
            with open(plain, "w+b") as file:
                count = self._write_plain(file, progress.part(0.0, 0.4))
            if count:
                write_changed(plain, target, Edits(), progress.part(0.4, 1.0))
        return count

    def _write_plain(self, file: BinaryIO, progress: Progress) -> int:
        """Write the points without compression."""
        layout, counts, total = None, None, 0
        for number, (key, stated) in enumerate(self.tiles.items()):
            tile = self._open(key)
            if tile.count != stated:
                self._transfers.progress.warning(
                    f"Tile {_name(key)} of {self.name} has {tile.count:,} points, not"
                    f" {stated:,} as its hierarchy says. All that it has are used."
                )
            if layout is None or counts is None:
                layout = self._layout(tile)
                counts = HeaderCounts(layout)
                file.write(layout.prefix(layout.vlrs, compressed=False))
            self._check_same(layout, tile)
            for records in read_records(tile):
                kept = _moved(layout, tile, records[self._inside(tile, records)])
                counts.add(kept)
                file.write(kept.data)
                total += len(kept)
            progress((number + 1) / len(self.tiles))
        if layout is None or counts is None or not total:
            return 0
        layout = with_statistics(
            with_count(layout, total),
            counts.lowest.tolist(), counts.highest.tolist(), counts.returns.tolist(),
        )  # fmt: skip
        file.seek(0)
        file.write(layout.prefix(layout.vlrs, compressed=False))
        return total

    def _open(self, key: Key) -> LasFile:
        """Open a tile; one that is damaged does not stay, so that a next run asks for it again."""
        try:
            return open_las(self._path(key))
        except BareEarthError:
            if is_address(self._address):
                remove(self._path(key))
            raise

    def _layout(self, tile: LasFile) -> LasFile:
        """Return header and records of the output, LAS 1.4, given those of a tile."""
        header = bytearray(fields.HEADER_SIZES[4])
        header[: fields.WAVEFORM_START.start] = tile.header[: fields.HEADER_SIZES[0]]
        fields.VERSION.put(header, 1, 4)
        fields.HEADER_SIZE.put(header, len(header))
        vlrs = [vlr for vlr in tile.vlrs if vlr.key != LASZIP]
        text = (self._wkt or "").encode()
        if text and len(text) < LARGEST_VLR:
            vlrs = [vlr for vlr in vlrs if vlr.key not in (*GEOKEY_RECORDS, WKT_RECORD)]
            vlrs.append(new_vlr(WKT_RECORD, text + b"\0", "OGC WKT Coordinate System"))
            encoding = tile.global_encoding & _GPS_TIME_TYPE if tile.minor_version >= 2 else 0
            fields.GLOBAL_ENCODING.put(header, encoding | _WKT)
        return replace(tile, header=bytes(header), vlrs=tuple(vlrs), padding=b"", evlrs=())

    def _check_same(self, layout: LasFile, tile: LasFile) -> None:
        """Refuse tiles of different formats, whose points do not fit into one file."""
        if (layout.point_format, layout.record_length) != (tile.point_format, tile.record_length):
            raise BareEarthError(
                f"The tiles of {self.name} have different point formats, {layout.point_format} and"
                f" {tile.point_format}, which do not fit into one file. Fetch a smaller area."
            )

    def _inside(self, tile: LasFile, records: np.ndarray) -> np.ndarray:
        """Return which points lie in the area."""
        if self.area is None:
            return np.ones(len(records), dtype=bool)
        x, y = (column(records, 4 * axis, "<i4") for axis in (0, 1))
        return are_inside(tile, self.area, x, y)

    def _whole(self, name: str, most: int) -> bytes:
        """Return a file of the data set."""
        place = beside(self._address, name)
        if is_address(place):
            return self._transfers.read_whole(place, most)
        with open_source(Path(place)) as file:
            return file.read()

    def _path(self, key: Key) -> Path:
        """Return where a tile is on this computer, once it was fetched."""
        if is_address(self._address):
            return self._parts.path_of(f"{_name(key)}.{'laz' if self.kind == 'laszip' else 'las'}")
        return Path(beside(self._address, f"ept-data/{_name(key)}.laz"))

    def _no_ept(self, why: str) -> BareEarthError:
        return BareEarthError(
            f"{shown(self._address)} is no EPT data set that can be read: {why}. Check the address."
        )


def _name(key: Key) -> str:
    return "-".join(map(str, key))


def _wkt_of(srs: dict[str, Any]) -> str | None:
    """Return the CRS of a description as well-known text, if it says one."""
    if isinstance(srs.get("wkt"), str) and srs["wkt"].strip():
        return srs["wkt"].strip()
    code = str(srs.get("horizontal") or "")
    if str(srs.get("authority", "")).upper() == "EPSG" and code.isdigit() and library() is not None:
        return stated_wkt(f"EPSG:{code}")
    return None


def _moved(layout: LasFile, tile: LasFile, records: np.ndarray) -> np.ndarray:
    """Return records of a tile with the integers that their places have in the output."""
    for axis in range(3):
        scale, step = tile.scale[axis], layout.scale[axis]
        shift = tile.offset[axis] - layout.offset[axis]
        if scale == step and shift == 0:
            continue
        integers = column(records, 4 * axis, "<i4")
        steps = (integers * scale + shift) / step
        whole = np.rint(steps)
        if (np.abs(whole - steps) > _WHOLE).any() or (np.abs(whole) >= 1 << 31).any():
            raise BareEarthError(
                f"The coordinates of {tile.path.name} do not fit to those of the tiles before:"
                " their scales and offsets differ. Fetch a smaller area."
            )
        integers[:] = whole
    return records
