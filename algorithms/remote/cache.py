"""Keeps the parts of remote point clouds that runs read, so that the next run finds them here."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Iterator, Mapping, NamedTuple, Sequence

from ..core.errors import BareEarthError
from ..core.files import describe_write_error, replacing, write_errors_told
from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..crs.measurable import require_measurable
from ..crs.system import Crs
from ..survey.area import Area
from ..survey.files import Inputs
from ..survey.shapes import Place, Shapes
from .addresses import beside, checked, is_address, name_of, shown
from .copc import SUFFIX, CopcPart
from .ept import DESCRIPTION, EptPart
from .fetching import Part, Wanted, check_size, names_of, nothing_there
from .files import RemoteFile
from .lists import Cloud, clouds_of
from .parts import remove_parts
from .transfers import Transfers
from .whole import WholePart

VARIABLE = "BARE_EARTH_CACHE"
# Of folders; 16 of the 64 digits of a hash, since paths must be short for Windows.
_DIGITS, _OURS = 16, re.compile(r"[0-9a-f]{16}")
# Units of points whose CRS is not known may be feet: about so many are a metre.
_UNITS_A_METRE = 3.3
_MOST_JSON = 1 << 28
_HOW = "fetch them first, by 'bare-earth fetch' with --follow"


@dataclass(frozen=True, eq=False)
class Surroundings(Area):
    """The rectangle round an area, wider by a margin, whose points help to judge those inside."""

    margin: float = 0.0  # metres
    crs: Crs | None = None  # of the points, if the user states it

    def located(self, place: Place, progress: Progress = SILENT) -> Area:
        """Return the rectangle in the CRS of the points."""
        crs = self.crs or place.crs
        area = super().located(place._replace(crs=crs), progress)
        metre = _UNITS_A_METRE if crs == Crs() else 1.0 / crs.horizontal_unit
        return Area(area.buffered_box(self.margin * metre))

    @property
    def key(self) -> str:
        """Text that differs for different areas."""
        rings = [[ring.tolist() for ring in polygon] for polygon in self.polygons]
        stated = self.polygons.crs if isinstance(self.polygons, Shapes) else None
        return json.dumps([self.box, rings, stated, self.margin, repr(self.crs)])


class Here(NamedTuple):
    """What is on this computer of some addresses."""

    paths: dict[Path, str]  # of the point clouds, with their addresses as they are shown
    is_list: bool  # whether an address is that of a list of point clouds


class _NoPoint(Exception):
    """No point lies in the area, so that there is no file to keep."""


class _Kept:
    """The place in the cache of what an area needs of a point cloud."""

    def __init__(self, cloud: Cloud, wanted: Wanted, cache: Path, transfers: Transfers) -> None:
        self.address, self._wanted, self._transfers = cloud.address, wanted, transfers
        area = wanted.area.key if isinstance(wanted.area, Surroundings) else ""
        # Signatures differ from run to run, and belong into no file.
        folder = cache / _digest(shown(cloud.address)) / _digest(f"{area} {wanted.resolution}")
        self.waiting = folder / "parts"
        with write_errors_told(folder):
            folder.mkdir(parents=True, exist_ok=True)
        self._file: RemoteFile | None = None
        self.name, ending = name_of(cloud.address), SUFFIX
        is_certain = True
        # One request, which tells the version.
        if self.name.lower() == DESCRIPTION:
            text = transfers.one(lambda: transfers.read_whole(cloud.address, _MOST_JSON))
            version, ending = hashlib.sha256(text).hexdigest(), ".laz"
            self.name = name_of(beside(cloud.address, ""))
        else:
            self._file = RemoteFile(transfers, cloud.address, self.waiting)
            version, is_certain = json.dumps(self._file.version), self._file.version.is_certain
            if not self._file.is_copc:
                # All of it serves any area.
                folder = folder.with_name(_digest("all"))
                ending = ".las" if self.name.lower().endswith(".las") else ".laz"
        name = names_of([self.name])[0].replace(SUFFIX, ending)
        self.path = folder / _digest(version) / name
        self.is_here = is_certain and self.path.is_file()
        if self.is_here:
            self._remove_parts()

    def part(self, progress: Progress) -> Part:
        """Return what has to be fetched."""
        wanted = self._wanted
        if self._file is not None and not self._file.is_copc:
            return WholePart(self._file, wanted.area, progress)
        if self._file is not None:
            return CopcPart(self._file, wanted.area, wanted.resolution, progress)
        place = self._transfers, self.address, self.waiting
        return EptPart(*place, wanted.area, wanted.resolution, wanted.skips_missing, progress)

    def write(self, part: Part, progress: Progress) -> int:
        """Write what was fetched, and return the number of points."""
        count = 0
        with contextlib.suppress(_NoPoint), write_errors_told(self.path):
            self.path.parent.mkdir(parents=True, exist_ok=True)
            with replacing(self.path) as temporary:
                count = part.write(temporary, progress)
                if not count:
                    raise _NoPoint
        self._remove_parts()
        return count

    def _remove_parts(self) -> None:
        remove_parts(self.waiting)
        with contextlib.suppress(OSError):  # it holds what was wanted
            self.waiting.parent.rmdir()


def cache_of(folder: str | Path | None) -> Path:
    """Return the folder of the cache: the given one, that of the environment, or the user's."""
    if folder or os.environ.get(VARIABLE):
        return Path(folder or os.environ[VARIABLE]).expanduser().absolute()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData/Local", "bare-earth")
    if sys.platform == "darwin":
        return Path.home() / "Library/Caches/bare-earth"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache", "bare-earth")


def bring_here(
    addresses: Sequence[str], wanted: Wanted, cache: Path, advice: str, progress: Progress
) -> Here:
    """Return files with what is wanted of addresses, fetched unless the cache has them; `advice`
    says what to do if that is too much.
    """
    with Transfers(progress) as transfers:
        progress, clouds, is_list = transfers.progress, [], False
        for address in map(checked, addresses):
            listed = clouds_of(address, transfers, False, _HOW)
            is_list = is_list or [cloud.address for cloud in listed] != [address]
            clouds += [cloud for cloud in listed if cloud.may_touch(wanted.area)]
        kept = [_Kept(cloud, wanted, cache, transfers) for cloud in dict.fromkeys(clouds)]
        missing = [cloud for cloud in kept if not cloud.is_here]
        shares = progress.part(0.0, 0.1).shares(*[1.0] * len(missing))
        planned = [(cloud, cloud.part(share)) for cloud, share in zip(missing, shares)]
        parts = [(cloud, part) for cloud, part in planned if part.point_count]
        if wanted.is_measured:
            for _, part in parts:
                _check_lengths(part, wanted.crs or part.crs)
        if parts:
            check_size([part for _, part in parts], wanted.most, advice, progress)
        shares = progress.part(0.1, 0.7).shares(*(part.size for _, part in parts))
        for (_, part), share in zip(parts, shares):
            part.fetch(share)
        shares = progress.part(0.7, 1.0).shares(*(part.point_count for _, part in parts))
        for (cloud, part), share in zip(parts, shares):
            cloud.is_here = cloud.write(part, share) > 0
    found = [cloud for cloud in kept if cloud.is_here]
    if not found:
        raise nothing_there([part for _, part in planned], addresses[0])
    paths = {cloud.path: shown(cloud.address) for cloud in found}
    for path, address in paths.items():
        progress.info(f"{address} is read from {path}.")
    return Here(paths, is_list)


def _check_lengths(part: Part, crs: Crs) -> None:
    """Refuse a cloud in which nothing can be measured, such as those of 3DEP, before a download."""
    try:
        require_measurable(part.name, crs, part.box if part.area is None else part.area.bounds)
    except BareEarthError as error:
        raise BareEarthError(
            f"{error} Or transform it while it is downloaded: 'bare-earth fetch' with --to-utm, in"
            " QGIS 'Download part of a remote point cloud' with 'Transform Web Mercator to UTM'."
        ) from error


def bring_all(
    given: Mapping[str, Sequence[str | Path]],
    wanted: Wanted,
    cache: Path,
    advice: str,
    progress: Progress,
) -> tuple[dict[str, Inputs], dict[Path, str]]:
    """Return the files of inputs, by their names, of which some are addresses, and what
    `addresses_named` needs.
    """
    inputs, found = {}, {}
    shares = progress.shares(*[1.0] * len(given))
    for (name, sources), share in zip(given.items(), shares):
        addresses = [str(source) for source in sources if is_address(str(source))]
        if addresses:
            here = bring_here(addresses, wanted, cache, advice, share)
            found.update(here.paths)
            paths = [*here.paths, *(source for source in sources if source not in addresses)]
            # A list is a survey, however many of its files have points in the area.
            inputs[name] = Inputs(paths, True if here.is_list else None)
    return inputs, found


@contextlib.contextmanager
def addresses_named(found: Mapping[Path, str]) -> Iterator[None]:
    """Let errors name addresses in place of files of the cache."""
    try:
        yield
    except BareEarthError as error:
        for path, address in found.items():
            error.args = (str(error).replace(str(path), address),)
        raise


class Seen(NamedTuple):
    """What is known of a remote point cloud before its points are fetched."""

    address: str
    crs: Crs
    box: Box  # smallest x and y, largest x and y in this CRS


def look(addresses: Sequence[str], cache: Path, progress: Progress = SILENT) -> list[Seen]:
    """Return CRS and extent of the point clouds at addresses, all in the CRS of the first where a
    list states the extent.
    """
    found: list[Seen] = []
    with Transfers(progress) as transfers:
        clouds = [
            cloud
            for address in map(checked, addresses)
            for cloud in clouds_of(address, transfers, False, _HOW)
        ]
        # No part of a cloud lies there, so that hardly more than its header is read.
        nowhere = Wanted(Surroundings((0.0, 0.0, 1e-6, 1e-6)))
        for cloud in dict.fromkeys(clouds):
            if found and cloud.box is not None:
                west, south, east, north = cloud.box  # lists round
                box = west - 1.0, south - 1.0, east + 1.0, north + 1.0
                found.append(Seen(cloud.address, found[0].crs, box))
                continue
            part = _Kept(cloud, nowhere, cache, transfers).part(transfers.progress.quiet())
            found.append(Seen(cloud.address, part.crs, part.box))
    return found


def clear(cache: Path) -> int:
    """Remove what is kept, nothing else, and return how many bytes that were."""
    if not cache.is_dir():
        return 0
    size = 0
    for folder in cache.iterdir():
        if _OURS.fullmatch(folder.name) and folder.is_dir() and not folder.is_symlink():
            size += sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
            try:
                shutil.rmtree(folder)
            except OSError as error:
                raise describe_write_error(folder, error) from error
    with contextlib.suppress(OSError):  # it holds something else
        cache.rmdir()
    return size


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()[:_DIGITS]
