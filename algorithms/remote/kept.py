"""The place in the cache of what an area needs of a remote point cloud."""

from __future__ import annotations

import contextlib
import hashlib
import json
from dataclasses import dataclass
from pathlib import Path

from ..core.files import rename, replacing, temporary_folder, write_errors_told
from ..core.locks import one_at_a_time
from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..core.temporary import remove
from ..core.words import tool
from ..crs.system import Crs
from ..survey.area import Area
from ..survey.shapes import Place, Shapes
from .addresses import beside, name_of, shown
from .copc import SUFFIX, CopcPart
from .ept import DESCRIPTION, MOST_DESCRIPTION, EptPart
from .fetching import CloudPart, Wanted, names_of
from .files import RemoteFile
from .lists import Cloud
from .parts import remove_parts
from .transfers import Transfers
from .whole import WholePart

# Digits of a hash, of 64, in the names of folders: paths must be short for Windows.
DIGITS = 16
# Units in a metre for points whose CRS is not known: they may be feet.
_UNITS_A_METRE = 3.3


@dataclass(frozen=True, eq=False)
class _Wider(Area):
    asked: Box = (0.0, 0.0, 0.0, 0.0)  # the bounds of what the user gave


@dataclass(frozen=True, eq=False)
class AreaAround(Area):
    """The rectangle round an area with a margin, whose points help to classify those inside."""

    margin: float = 0.0  # metres
    crs: Crs | None = None  # of the points, if the user states it

    def located(self, place: Place, progress: Progress = SILENT) -> Area:
        """Return the rectangle in the CRS of the points."""
        crs = self.crs or place.crs
        area = super().located(place._replace(crs=crs), progress)
        metre = _UNITS_A_METRE if crs == Crs() else 1.0 / crs.horizontal_unit
        return _Wider(area.buffered_box(self.margin * metre), asked=area.bounds)

    @property
    def key(self) -> str:
        """Text that differs for different areas."""
        rings = [[ring.tolist() for ring in polygon] for polygon in self.polygons]
        stated = self.polygons.crs if isinstance(self.polygons, Shapes) else None
        return json.dumps([self.box, rings, stated, self.margin, repr(self.crs)])


class CachedPart:
    """The file in the cache with the part of a point cloud that an area needs; in the folder of a
    version of the cloud, which also holds downloads for other areas.
    """

    def __init__(self, cloud: Cloud, wanted: Wanted, cache: Path, transfers: Transfers) -> None:
        self.address, self._wanted, self._transfers = cloud.address, wanted, transfers
        area = wanted.area.key if isinstance(wanted.area, AreaAround) else ""
        self.name, ending, part = name_of(cloud.address), SUFFIX, f"{area} {wanted.resolution}"
        self._file: RemoteFile | None = None
        self._is_certain = True
        # One request, whose answer states the version.
        if self.name.lower() == DESCRIPTION:
            text = transfers.whole(cloud.address, MOST_DESCRIPTION)
            version, ending = hashlib.sha256(text).hexdigest(), ".laz"
            self.name = name_of(beside(cloud.address, ""))
        else:
            self._file = RemoteFile(transfers, cloud.address)
            version, self._is_certain = str(self._file.version), self._file.version.is_certain
            if not self._file.is_copc:
                # The whole file is kept, for any area.
                part, ending = "all", ".las" if self.name.lower().endswith(".las") else ".laz"
        # Addresses are kept without their signatures, which differ from run to run and are secret.
        folder = cache / _digest(shown(cloud.address)) / _digest(version)
        name = names_of([self.name])[0].replace(SUFFIX, ending)
        self.waiting, self.path = folder / "parts", folder / _digest(part) / name
        self._lock = self.path.with_name("lock")
        _make_private(self.path.parent, cache)
        self.is_here = self._is_certain and self._is_sound()

    def _is_sound(self) -> bool:
        """Return whether the file is as it was written; remove one that is not."""
        if not self.path.is_file():
            return False
        if is_sound(self.path):
            return True
        self._transfers.progress.warning(
            f"The copy of {shown(self.address)} in the cache is damaged, and is fetched anew."
            f" {tool('clear-cache')} empties the cache."
        )
        remove(self.path)
        return False

    def part(self, progress: Progress) -> CloudPart:
        """Return the part that has to be downloaded."""
        wanted = self._wanted
        if self._file is None:
            place = self._transfers, self.address, self.waiting
            return EptPart(*place, wanted.area, wanted.resolution, wanted.skips_missing, progress)
        file = self._file.keep_in(self.waiting)
        if file.is_copc:
            return CopcPart(file, wanted.area, wanted.resolution, progress)
        return WholePart(file, wanted.area, progress)

    def download(self, part: CloudPart, progress: Progress) -> None:
        """Download and write a part, unless another run has done this meanwhile."""
        with one_at_a_time(self._lock, lambda: progress(0.0)):
            self.is_here = self._is_certain and self._is_sound()
            if not self.is_here:
                part.fetch(progress.part(0.0, 0.7))
                self.is_here = self._write(part, progress.part(0.7, 1.0)) > 0
        if part.is_whole or not self._is_certain:
            remove_parts(self.waiting)

    def _write(self, part: CloudPart, progress: Progress) -> int:
        """Write the file, and return the number of points."""
        with write_errors_told(self.path), temporary_folder(self.path.parent) as folder:
            new = folder / self.path.name
            count = part.write(new, progress)
            # An equal file is not replaced, because another run may read it.
            if count and not (self.path.is_file() and digest_of(new) == digest_of(self.path)):
                with replacing(_digest_beside(self.path)) as temporary:
                    temporary.write_text(digest_of(new), encoding="ascii")
                rename(new, self.path)
        return count


def is_sound(path: Path) -> bool:
    """Return whether a file of the cache is as it was written."""
    with contextlib.suppress(OSError, ValueError):
        return _digest_beside(path).read_text(encoding="ascii") == digest_of(path)
    return False


def digest_of(path: Path) -> str:
    """Return the SHA-256 digest of a file."""
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        while data := file.read(1 << 20):
            digest.update(data)
    return digest.hexdigest()


def _digest_beside(path: Path) -> Path:
    return path.with_name(f"{path.name}.sha256")


def _make_private(folder: Path, cache: Path) -> None:
    """Make a folder in the cache that only its owner may read, since its files may be secret."""
    with write_errors_told(folder):
        cache.parent.mkdir(parents=True, exist_ok=True)
        depth = len(folder.relative_to(cache).parts)
        for inner in reversed([folder, *list(folder.parents)[:depth]]):
            inner.mkdir(mode=0o700, exist_ok=True)
        top = cache / folder.relative_to(cache).parts[0]
        with contextlib.suppress(OSError):  # not every file system has permissions
            top.chmod(0o700)


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:DIGITS]
