"""The part of an EPT data set that an area and a resolution need, as one file.

Entwine Point Tiles are a folder of files: a description, the octree as JSON, and a small point
cloud for each node. Each tile needs a request. A tile is a whole LAZ file, and its own header is
used, because some offsets differ from those in the description.

References
----------
Entwine Point Tile specification 1.1, https://entwine.io/entwine-point-tile.html
"""

from __future__ import annotations

import contextlib
import hashlib
import re
import threading
from functools import partial
from pathlib import Path
from typing import Iterable

import numpy as np

from ..core.errors import BareEarthError
from ..core.files import temporary_folder
from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..core.temporary import remove
from ..core.words import counted, option
from ..crs.system import Crs, crs_of_wkt
from ..las.edits import Edits
from ..las.opening import open_las
from ..las.records import read_records
from ..las.writing import write_changed
from ..survey.area import Area
from ..survey.shapes import Place
from .addresses import beside, is_address, name_of, shown
from .answers import Document, Missing, parsed
from .copc import EVERYWHERE, area_of, levels_of
from .ept_joining import joined
from .ept_records import Schema, wkt_of
from .files import read_local
from .parts import Parts
from .transfers import Transfers

DESCRIPTION = "ept.json"
_ENDINGS = {"laszip": "laz", "binary": "bin"}
Key = tuple[int, int, int, int]  # depth, x, y and z of a node
_KEY = re.compile(r"(\d{1,2})-(\d{1,10})-(\d{1,10})-(\d{1,10})")
_DEEPEST = 30
# Most bytes of the description, of a file of the hierarchy and of a tile; six are in
# memory at a time.
MOST_DESCRIPTION = 1 << 22
_MOST_HIERARCHY = 1 << 24
_MOST_TILE = 1 << 25
# Most points of a tile, bytes of one of them, and tiles that are needed.
_MOST_POINTS = 1 << 23
_MOST_A_POINT = 200
_MOST_TILES = 1_000_000
_PIECE = 100_000  # points that are read at a time to check a tile
_USUAL = 7  # usual number of bytes of a compressed point


class EptPart:
    """The part of an EPT data set that an area and a resolution need: tiles."""

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
        self._parsing = threading.Lock()  # so that a single document fills the memory
        text, about = transfers.one(lambda: self._document(DESCRIPTION, MOST_DESCRIPTION))
        self._read(about)
        self.box: Box = self._numbers(about.get("boundsConforming") or self._cube)
        self._wkt = wkt_of(about.get("srs"))
        self.crs = (crs_of_wkt(self._wkt) if self._wkt else None) or Crs()
        if self.kind != "laszip":
            try:
                self._schema = Schema(about["schema"], self._cube, self.crs.is_geographic)
            except (ValueError, TypeError, KeyError, AttributeError, OverflowError) as error:
                raise self._no_ept("its schema cannot be read") from error
        self.area = area_of(area, Place(self.name, self.crs, self.box), progress)
        self._parts = Parts(waiting, address)
        if is_address(address):
            self._parts.begin({"digest": hashlib.sha256(text).hexdigest()}, True)
        spacing = (self._cube[3] - self._cube[0]) / self._span
        self._levels = levels_of(spacing, resolution, self.crs, self.box)
        self._near = EVERYWHERE if self.area is None else self.area.bounds
        self.tiles = self._find_tiles(progress)
        self.point_count, self.missing_count = sum(self.tiles.values()), 0
        stated = about.get("points")
        is_all = self.area is None and resolution is None
        if is_all and isinstance(stated, int) and stated != self.point_count:
            transfers.progress.warning(
                f"The tiles of {self.name} have {counted(self.point_count, 'point')}, not"
                f" {stated:,} as its description says."
            )
        missing = [key for key in self.tiles if not self._path(key).is_file()]
        self._waiting = missing if is_address(address) else []
        self.request_count = len(self._waiting)
        self.size = _USUAL * sum(self.tiles[key] for key in self._waiting)

    def _document(self, name: str, most: int) -> tuple[bytes, Document]:
        """Return the text and the content of a document; one that cannot be parsed is requested
        once more.
        """
        with contextlib.suppress(ValueError):
            return self._parsed(name, most)
        try:
            return self._parsed(name, most)
        except ValueError as error:
            raise self._no_ept(f"{name} cannot be read") from error

    def _parsed(self, name: str, most: int) -> tuple[bytes, Document]:
        text = self._whole(name, most)
        with self._parsing:
            return text, parsed(text)

    def _read(self, about: Document) -> None:
        """Read and check the values of the description that are used."""
        try:
            self._cube = tuple(map(float, about["bounds"]))
            self._span, self.kind = int(about["span"]), str(about["dataType"])
            is_sound = len(self._cube) == 6 and bool(np.isfinite(self._cube).all())
            is_sound = is_sound and self._span > 0 and self._cube[3] > self._cube[0]
        except (ValueError, TypeError, KeyError, AttributeError, OverflowError) as error:
            raise self._no_ept("its description cannot be read") from error
        if not is_sound:
            raise self._no_ept("its cube has no size")
        is_read_here = self.kind == "laszip" or is_address(self._address)
        if self.kind not in _ENDINGS or not is_read_here:
            raise BareEarthError(
                f"The tiles of {shown(self._address)} are {self.kind}, which cannot be read here."
                " Use 'pdal translate'."
            )

    def _numbers(self, bounds: Iterable[float]) -> Box:
        """Return smallest x and y, largest x and y of bounds in the description."""
        try:
            west, south, _, east, north, _ = map(float, bounds)
        except (TypeError, ValueError) as error:
            raise self._no_ept("its extent cannot be read") from error
        return west, south, east, north

    def _find_tiles(self, progress: Progress) -> dict[Key, int]:
        """Return the numbers of points of the needed tiles, by their keys in ascending order."""
        found: dict[Key, int] = {}
        files: list[Key] = [(0, 0, 0, 0)]
        seen: set[Key] = set()
        while files:
            seen |= {*files}
            tasks = [partial(self._read_hierarchy, key) for key in files]
            below: set[Key] = set()
            for page in self._transfers.run(tasks, progress.quiet()):
                below |= {key for key, count in page.items() if count < 0}
                for key, count in page.items():
                    if count >= 0 and found.setdefault(key, count) != count:
                        raise self._no_ept(f"its hierarchy contradicts itself on {_name(key)}")
                if len(found) + len(below) > _MOST_TILES:
                    raise BareEarthError(
                        f"More than {_MOST_TILES:,} tiles of {self.name} are needed. Choose a"
                        " smaller area or a coarser resolution."
                    )
            files = sorted(below - seen)
        return {key: count for key, count in sorted(found.items()) if count}

    def _read_hierarchy(self, key: Key) -> dict[Key, int]:
        """Return the numbers of points of the needed nodes in a file of the hierarchy; -1 for nodes
        that another file describes.
        """
        name = f"ept-hierarchy/{_name(key)}.json"
        _, entries = self._document(name, _MOST_HIERARCHY)
        try:
            if not all(map(_KEY.fullmatch, entries)):
                raise ValueError("a key is invalid")
            keys = np.array("-".join(entries).split("-") if entries else [], dtype=np.int64)
            counts = np.array([*entries.values()], dtype=np.int64)
        except (ValueError, TypeError, AttributeError, OverflowError) as error:
            raise self._no_ept(f"{name} cannot be read") from error
        # This file describes the node itself.
        if entries.get(_name(key), 0) < 0:
            raise self._no_ept(f"{name} names itself in place of a number of points")
        if (counts > _MOST_POINTS).any():
            raise self._no_ept(f"{name} names a tile of {counts.max():,} points")
        keys = keys.reshape(-1, 4)
        side = np.exp2(np.clip(keys[:, 0], 0, _DEEPEST))
        if (keys[:, 0] > _DEEPEST).any() or (keys[:, 1:] >= side[:, None]).any():
            raise self._no_ept(f"{name} names tiles outside of the cube")
        width = (self._cube[3] - self._cube[0]) / side
        # Tiles may be a little wider by rounding.
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
        """Download the tiles, each by one request; missing ones are an error, or are counted if
        they may be skipped.
        """

        def get(key: Key) -> bool:
            if key not in waiting and self._is_sound(key):
                return True
            data = self._tile(key)
            if data is None:
                return False
            try:
                self._keep(key, data)
            except BareEarthError:  # the tile is damaged, so it is requested once more
                self._keep(key, self._tile(key) or b"")
            return True

        waiting = {*self._waiting}
        keys = [*self.tiles] if is_address(self._address) else []
        there = self._transfers.run([partial(get, key) for key in keys], progress, self.size)
        gone = [key for key, is_there in zip(keys, there) if not is_there]
        self.missing_count = len(gone)
        if gone:
            points = sum(self.tiles.pop(key) for key in gone)
            self._transfers.progress.warning(
                f"The server lacks {counted(len(gone), 'tile')} of {self.name} with"
                f" {counted(points, 'point')}: the points have gaps."
            )

    def _tile(self, key: Key) -> bytes | None:
        """Return the bytes of a tile; None if it is missing and may be skipped."""
        most = min(self.tiles[key] * _MOST_A_POINT + (1 << 20), _MOST_TILE)
        try:
            return self._whole(f"ept-data/{_name(key)}.{_ENDINGS[self.kind]}", most)
        except Missing as error:
            if self._skips:
                return None
            raise BareEarthError(
                f"{error} If it is a tile that is missing in this data set, go on without it:"
                f" {option('skip_missing', True, of='fetch')}."
            ) from error

    def _keep(self, key: Key, data: bytes) -> None:
        """Keep a tile if all of its points can be read."""
        if self.kind != "laszip":
            try:
                data = self._schema.las(data, self.tiles[key])
            except (ValueError, OverflowError) as error:
                raise self._no_ept(f"tile {_name(key)} is damaged") from error
        self._parts.add_file(self._path(key).name, data)
        self._check(key)

    def _is_sound(self, key: Key) -> bool:
        with contextlib.suppress(BareEarthError):
            self._check(key)
            return True
        return False

    def _check(self, key: Key) -> None:
        """Read a tile; remove a damaged one, so that it is requested again."""
        path = self._path(key)
        try:
            for _ in read_records(open_las(path), _PIECE):
                pass
        except BareEarthError:
            remove(path)
            raise

    def write(self, target: Path, progress: Progress = SILENT) -> int:
        """Write the points as LAZ, or as COPC if the name says so, after they have been fetched;
        return their number, 0 if none lies in the area.
        """
        with temporary_folder(target.parent) as folder:
            plain = folder / "points.las"
            with open(plain, "w+b") as file:
                # Tiles are opened one after the other: there can be a million.
                tiles = ((open_las(self._path(key)), count) for key, count in self.tiles.items())
                tell = progress.part(0.0, 0.4).shares(*[1.0] * len(self.tiles))
                count = joined(tiles, file, self.name, self._wkt, self.area, tell)
            if count:
                write_changed(plain, target, Edits(), progress.part(0.4, 1.0))
        return count

    def _whole(self, name: str, most: int) -> bytes:
        """Return a file of the data set, of at most `most` bytes."""
        place = beside(self._address, name)
        if is_address(place):
            return self._transfers.read_whole(place, most)
        return read_local(Path(place), most)

    def _path(self, key: Key) -> Path:
        """Return the path of a tile on this computer, after its download."""
        if is_address(self._address):
            return self._parts.path_of(f"{_name(key)}.{'laz' if self.kind == 'laszip' else 'las'}")
        return Path(beside(self._address, f"ept-data/{_name(key)}.laz"))

    def _no_ept(self, why: str) -> BareEarthError:
        return BareEarthError(
            f"{shown(self._address)} is no EPT data set that can be read: {why}. Check the address."
        )


def _name(key: Key) -> str:
    return "-".join(map(str, key))
