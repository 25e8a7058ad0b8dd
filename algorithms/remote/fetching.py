"""Fetches the parts of remote point clouds that an area needs, into files of this computer."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

from ..core.errors import BareEarthError
from ..core.files import make_work_folder, write_errors_told
from ..core.progress import SILENT, Progress
from ..crs.system import Crs
from ..las.lasfile import LasFile
from ..survey.area import Area
from ..survey.shapes import outside
from .addresses import checked, is_address, name_of, shown
from .copc import SUFFIX, CopcPart
from .files import LocalFile, RemoteFile
from .parts import remove_parts
from .transfers import Transfers

_GIGABYTE = 1e9


@dataclass(frozen=True)
class Wanted:
    """What is wanted of a point cloud."""

    area: Area | None = None  # None for all of it
    resolution: float | None = None  # metres between points; None for all points
    most: float = 2.0 * _GIGABYTE  # bytes


@dataclass(frozen=True)
class Fetched:
    """What was downloaded."""

    point_count: int
    file_count: int  # files that were written
    size: int  # bytes that were downloaded
    request_count: int

    @property
    def text(self) -> str:
        """The counts in a sentence."""
        files = "1 file" if self.file_count == 1 else f"{self.file_count} files"
        return (
            f"{self.point_count:,} points in {files}; {in_words(self.size)} were downloaded in"
            f" {self.request_count:,} requests"
        )


class Part(Protocol):
    """What an area and a resolution need of a point cloud."""

    layout: LasFile  # of the points; its extent may be larger than that of the part
    crs: Crs
    area: Area | None  # in the CRS of the points
    size: int  # bytes to download, as far as they are known
    request_count: int
    point_count: int  # with some that lie outside of the area

    def fetch(self, progress: Progress) -> None:
        """Get all that is needed."""

    def write(self, target: Path, progress: Progress) -> int:
        """Write a file, after all was fetched; return the number of points."""


def fetch(
    address: str, target: Path, wanted: Wanted, waiting: Path, progress: Progress = SILENT
) -> Fetched:
    """Write the points as a .laz or .copc.laz file, or as several in a folder if the target has no
    such ending; what was downloaded waits in the folder `waiting`, where the next run goes on after
    an error or a cancel.
    """
    address = checked(address) if is_address(address) else address
    with Transfers(progress) as transfers:
        with write_errors_told(waiting):
            make_work_folder(waiting)
        is_planned = False
        try:
            parts = _planned(address, transfers, waiting, wanted, progress.part(0.0, 0.1))
            is_planned, tell = True, progress.part(0.1, 0.7)
            for part, share in zip(parts, tell.shares(*(part.size for part in parts))):
                part.fetch(share)
            counts = _written(parts, target, progress.part(0.7, 1.0))
            if not counts:
                remove_parts(waiting)
                raise _nothing_there(parts[0], address)
        except BaseException:
            if is_planned:
                _tell_of_rest(waiting, progress)
            else:
                remove_parts(waiting)
            raise
        done = Fetched(sum(counts), len(counts), transfers.received, transfers.requests)
    remove_parts(waiting)
    return done


def _planned(
    address: str, transfers: Transfers, waiting: Path, wanted: Wanted, progress: Progress
) -> list[Part]:
    """Return what is needed of each point cloud that has points in the area, and tell how much that
    is; refuse too much.
    """
    addresses = [address]
    parts = [
        _part(one, transfers, waiting / str(number), wanted, share)
        for number, (one, share) in enumerate(
            zip(addresses, progress.shares(*[1] * len(addresses)))
        )
    ]
    found = [part for part in parts if part.point_count]
    if not found:
        raise _nothing_there(parts[0], address)
    size = sum(part.size for part in found)
    points = sum(part.point_count for part in found)
    if size > wanted.most:
        raise BareEarthError(
            f"This would download {in_words(size)} ({points:,} points), more than the limit of"
            f" {in_words(wanted.most)}. Choose a smaller area or a coarser resolution, or raise the"
            f" limit: --limit {size / _GIGABYTE + 0.1:.1f}."
        )
    requests = sum(part.request_count for part in found)
    progress.info(
        f"Downloads {in_words(size)} in {requests:,} requests, with {points:,} points in and near"
        " the area."
    )
    return found


def _part(
    address: str, transfers: Transfers, waiting: Path, wanted: Wanted, progress: Progress
) -> Part:
    """Return what is needed of a point cloud."""
    file = (
        RemoteFile(transfers, address, waiting) if is_address(address) else LocalFile(Path(address))
    )
    return CopcPart(file, wanted.area, wanted.resolution, progress)


def _written(parts: list[Part], target: Path, progress: Progress) -> list[int]:
    """Write one file, or one for each part into a new folder; return their numbers of points."""
    if target.suffix:
        if len(parts) > 1:
            raise BareEarthError(
                f"{len(parts)} point clouds have points there. Name a new folder as output: each"
                " becomes a file in it."
            )
        counts = [parts[0].write(target, progress)]
    else:
        target.mkdir()
        counts, names = [], _names(parts)
        for part, name, share in zip(parts, names, progress.shares(*[1] * len(parts))):
            counts.append(part.write(target / name, share))
            if not counts[-1]:
                (target / name).unlink()
    return [count for count in counts if count]


def _names(parts: list[Part]) -> list[str]:
    """Return different names for the files of a folder."""
    names: list[str] = []
    for part in parts:
        name = part.layout.path.name
        stem = name[: -len(SUFFIX)] if name.lower().endswith(SUFFIX) else Path(name).stem
        ending, number = SUFFIX, 1
        while (new := f"{stem}{'' if number == 1 else f'-{number}'}{ending}") in names:
            number += 1
        names.append(new)
    return names


def _nothing_there(part: Part, address: str) -> BareEarthError:
    bounds = part.layout.box if part.area is None else part.area.bounds
    return outside("the area", bounds, name_of(address) or shown(address), part.layout.box)


def _tell_of_rest(waiting: Path, progress: Progress) -> None:
    """Tell where the next run goes on; remove what would not save a request."""
    files = [path for path in waiting.rglob("*-*") if path.is_file()]
    size = sum(path.stat().st_size for path in files)
    if not size:
        remove_parts(waiting)
        return
    progress.warning(
        f"{in_words(size)} are kept in {waiting}: the same command goes on from there. Delete this"
        " folder if you do not need it."
    )


def in_words(size: float) -> str:
    """Return a number of bytes with a unit."""
    for unit, name in ((1e9, "GB"), (1e6, "MB")):
        if size >= unit:
            return f"{size / unit:.1f} {name}"
    return f"{size / 1e3:.1f} kB"
