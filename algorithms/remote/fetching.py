"""Downloads the parts of remote point clouds that an area needs, into files of this computer."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Iterable, Protocol, Sequence

from ..core.errors import BareEarthError
from ..core.files import make_work_folder, temporary_folder, write_errors_told
from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..core.words import counted, option
from ..crs.measurable import length_scale, wrong_lengths
from ..crs.system import Crs
from ..survey.area import Area
from ..survey.shapes import Outside, outside
from .addresses import checked, is_address, name_of, shown
from .copc import SUFFIX, CopcPart
from .ept import DESCRIPTION, EptPart
from .files import LocalFile, RemoteFile
from .lists import clouds_of, near
from .parts import remove_parts
from .transfers import Transfers
from .utm import STATED, Utm, states_height_unit, utm_of

_GIGABYTE = 1e9
_ADVICE = "Choose a smaller area or a coarser resolution"
_UNSAFE = re.compile(r"[^\w.,+() -]")  # characters that are replaced in names of files


@dataclass(frozen=True)
class Wanted:
    """What a user wants of remote point clouds."""

    area: Area | None = None  # None for all of it
    resolution: float | None = None  # metres between points; None for all points
    most: float = 2.0 * _GIGABYTE  # largest number of bytes to download
    skips_missing: bool = False  # whether tiles may be missing
    follows: bool = False  # whether lists may name servers that the user did not name
    crs: Crs | None = None  # CRS of the points, if the user states it
    to_utm: bool = False  # whether points in Web Mercator are transformed
    height_unit: str = STATED  # unit of heights in Web Mercator, or one of `HEIGHT_UNITS`
    is_measured: bool = False  # whether lengths in the CRS must be those on the ground


@dataclass(frozen=True)
class Fetched:
    """The result of a download."""

    point_count: int
    file_count: int  # files that were written
    size: int  # bytes that were downloaded
    request_count: int
    missing_count: int  # tiles that the server lacks

    @property
    def text(self) -> str:
        """The counts in a sentence."""
        return (
            f"{counted(self.point_count, 'point')} in {counted(self.file_count, 'file')};"
            f" {in_words(self.size)} were downloaded in {counted(self.request_count, 'request')}"
        )


class CloudPart(Protocol):
    """The part of a point cloud that an area and a resolution need."""

    name: str
    box: Box  # of the whole cloud
    crs: Crs
    area: Area | None  # in the CRS of the points
    size: int  # bytes to download
    is_exact: bool  # whether this number is known, and not estimated
    is_whole: bool  # whether the part is a whole file, since no part of it can be read
    request_count: int
    point_count: int  # including some outside of the area
    missing_count: int  # tiles that the server lacks

    def fetch(self, progress: Progress) -> None:
        """Download the part."""

    def write(self, target: Path, progress: Progress) -> int:
        """Write a file, after `fetch`; return the number of points."""


def fetch(
    address: str, target: Path, wanted: Wanted, waiting: Path, progress: Progress = SILENT
) -> Fetched:
    """Write the points as a .laz or .copc.laz file, or as several in a folder if the target has no
    such ending; downloads are kept in the folder `waiting` until then, so that the next run goes on
    after an error or a cancel.
    """
    address = checked(address) if is_address(address) else address
    again = f"run it again with {option('follow', True)}"
    is_planned, was_begun = False, _size_of_parts(waiting) > 0
    with write_errors_told(waiting):
        make_work_folder(waiting)
    try:
        with Transfers(progress, None if wanted.follows else again) as transfers:
            progress = transfers.progress
            parts = _found(address, transfers, waiting, wanted, progress.part(0.0, 0.1))
            if len(parts) > 1 and target.suffix:
                raise BareEarthError(
                    f"{len(parts)} point clouds have points there. Name a new folder as output,"
                    " without an ending: each becomes a file in it."
                )
            zones = [_zone_of(part, wanted, progress) for part in parts]
            check_size(parts, wanted.most, _ADVICE, progress)
            is_planned = True
            shares = progress.part(0.1, 0.7).shares(*(part.size for part in parts))
            for part, share in zip(parts, shares):
                part.fetch(share)
            counts = _written(parts, zones, target, progress.part(0.7, 1.0))
            if not counts:
                is_planned = False
                raise nothing_there(parts, address)
    except BaseException:
        if is_planned or was_begun:
            _report_rest(waiting, progress)
        else:
            remove_parts(waiting)
        raise
    remove_parts(waiting)
    missing = sum(part.missing_count for part in parts)
    return Fetched(sum(counts), len(counts), transfers.received, transfers.requests, missing)


def _found(
    address: str, transfers: Transfers, waiting: Path, wanted: Wanted, progress: Progress
) -> list[CloudPart]:
    """Return the part of each point cloud that has points in the area."""
    clouds = near(clouds_of(address, transfers), wanted.area)
    shares = progress.shares(*[1.0] * len(clouds))
    parts = [
        _part(cloud.address, transfers, waiting / str(number), wanted, share)
        for number, (cloud, share) in enumerate(zip(clouds, shares))
    ]
    found = [part for part in parts if part.point_count]
    if not found:
        raise nothing_there(parts, address)
    return found


def _part(
    address: str, transfers: Transfers, waiting: Path, wanted: Wanted, progress: Progress
) -> CloudPart:
    """Return the part of a point cloud."""
    if name_of(address).lower() == DESCRIPTION:
        skips = wanted.skips_missing
        return EptPart(transfers, address, waiting, wanted.area, wanted.resolution, skips, progress)
    if is_address(address):
        file = RemoteFile(transfers, address).keep_in(waiting)
        return CopcPart(file, wanted.area, wanted.resolution, progress)
    local = transfers.files.enter_context(LocalFile(Path(address)))
    return CopcPart(local, wanted.area, wanted.resolution, progress)


def _zone_of(part: CloudPart, wanted: Wanted, progress: Progress) -> Utm | None:
    """Return the zone of UTM to which points are transformed; warn of wrong lengths if not."""
    box = part.box if part.area is None else part.area.bounds
    if wanted.to_utm and (zone := utm_of(part.name, part.crs, box, wanted.height_unit)):
        progress.info(
            f"{part.name} is transformed from {part.crs.name} to UTM ({zone.zone}), and its heights"
            " to metres."
        )
        return zone
    if wrong := wrong_lengths(length_scale(part.crs, box)):
        how, unit = option("to_utm", True, of="fetch"), ""
        if not states_height_unit(part.crs):
            unit = (
                " The unit of its heights is not stated, and can be metres or feet: look it up, and"
                f" give it with {option('height_unit', of='fetch')}."
            )
        progress.warning(
            f"{part.name} is in a Mercator projection ({part.crs.name}), in which {wrong}. Its"
            f" points are kept as they are. Transform them to UTM: {how}.{unit}"
        )
    return None


def check_size(parts: Sequence[CloudPart], most: float, advice: str, progress: Progress) -> None:
    """Tell how much will be downloaded; refuse too much, with advice."""
    size, points = sum(part.size for part in parts), sum(part.point_count for part in parts)
    about = "" if all(part.is_exact for part in parts) else "about "
    whole = [part for part in parts if part.is_whole]
    if whole:
        advice = (
            f"{whole[0].name} is not COPC, so that no part of it can be read. Download it by other"
            " means"
        )
    if size > most:
        raise BareEarthError(
            f"This would download {about}{in_words(size)} ({counted(points, 'point')}), more than"
            f" the limit of {in_words(most)}. {advice}, or raise the limit:"
            f" {option('limit', round(size / _GIGABYTE + 0.1, 1))}."
        )
    requests = sum(part.request_count for part in parts)
    progress.info(
        f"Downloads {about}{in_words(size)} in {counted(requests, 'request')}, with"
        f" {counted(points, 'point')} in and near the area."
    )
    for part in whole:
        if part.area is not None:
            progress.warning(
                f"{part.name} is not COPC, so that no part of it can be read: all of it is"
                f" downloaded ({in_words(part.size)}), not only the area."
            )


def _write(part: CloudPart, zone: Utm | None, target: Path, progress: Progress) -> int:
    """Write a file, transformed to a zone; return the number of points."""
    if zone is None:
        return part.write(target, progress)
    with temporary_folder(target.parent) as folder:
        count = part.write(folder / "points.laz", progress.part(0.0, 0.4))
        if count:
            zone.write(folder / "points.laz", target, progress.part(0.4, 1.0))
    return count


def _written(
    parts: list[CloudPart], zones: list[Utm | None], target: Path, progress: Progress
) -> list[int]:
    """Write one file, or one for each part into a new folder; return their numbers of points."""
    if target.suffix:
        counts = [_write(parts[0], zones[0], target, progress)]
    else:
        target.mkdir()
        counts, names = [], names_of([part.name for part in parts])
        shares = progress.shares(*[1] * len(parts))
        for part, zone, name, share in zip(parts, zones, names, shares):
            counts.append(_write(part, zone, target / name, share))
            if not counts[-1]:
                (target / name).unlink(missing_ok=True)
    return [count for count in counts if count]


def names_of(clouds: Iterable[str]) -> list[str]:
    """Return different names for the files of a folder, given the names of the clouds."""
    names: list[str] = []
    for stem in clouds:
        number = 1
        for ending in (SUFFIX, ".laz", ".las"):
            stem = stem[: -len(ending)] if stem.lower().endswith(ending) else stem
        # A list of others must not decide in which folder a file is written.
        stem = _UNSAFE.sub("_", stem).strip(" .") or "points"
        while (new := f"{stem}{'' if number == 1 else f'-{number}'}{SUFFIX}") in names:
            number += 1
        names.append(new)
    return names


def nothing_there(parts: Sequence[CloudPart], address: str) -> Outside:
    """Return the error for an area without points."""
    area = parts[0].area if len(parts) == 1 else None
    if area is not None:
        bounds = getattr(area, "asked", area.bounds)  # if surroundings are fetched, too
        return outside("the area", bounds, parts[0].name, parts[0].box)
    return Outside(
        f"No point cloud of {name_of(address) or shown(address)} has points in the area. Give the"
        " area in the CRS of their points."
    )


def _report_rest(waiting: Path, progress: Progress) -> None:
    """Tell the user where downloads are kept for the next run; remove a folder without any."""
    size = _size_of_parts(waiting)
    if not size:
        remove_parts(waiting)
        return
    progress.warning(
        f"{in_words(size)} are kept in {waiting}: the same command goes on from there. Delete this"
        " folder if you do not need it."
    )


def _size_of_parts(waiting: Path) -> int:
    """Return the number of bytes that were downloaded before."""
    return sum(path.stat().st_size for path in waiting.rglob("*-*") if path.is_file())


def in_words(size: float) -> str:
    """Return a number of bytes with a unit."""
    for unit, name in ((1e9, "GB"), (1e6, "MB")):
        if size >= unit:
            return f"{size / unit:.1f} {name}"
    return f"{size / 1e3:.1f} kB"
