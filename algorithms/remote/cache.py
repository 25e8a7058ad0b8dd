"""Keeps parts of remote point clouds on this computer, so that the next run finds them here."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import sys
from pathlib import Path
from typing import Iterator, Mapping, NamedTuple, Sequence

from ..core.errors import BareEarthError
from ..core.files import describe_write_error
from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..core.temporary import remove
from ..core.words import option, tool
from ..crs.measurable import require_measurable
from ..crs.system import Crs
from ..survey.files import Inputs
from .addresses import checked, is_address, shown
from .fetching import CloudPart, Wanted, check_size, nothing_there
from .kept import DIGITS, AreaAround, CachedPart, is_sound
from .lists import clouds_of, near
from .transfers import Transfers

__all__ = ["AreaAround"]

VARIABLE = "BARE_EARTH_CACHE"
_OURS = re.compile(rf"[0-9a-f]{{{DIGITS}}}")  # names of folders


def _how_to_follow() -> str:
    return f"download the points first, with {option('follow', True, of='fetch')}"


class Here(NamedTuple):
    """The local files of some addresses."""

    paths: dict[Path, str]  # of the files, with the addresses of the point clouds as they are shown
    is_list: bool  # whether an address is that of a list of point clouds


def cache_of(folder: str | Path | None) -> Path:
    """Return the folder of the cache: the given one, that of the environment, or the user's."""
    if folder or os.environ.get(VARIABLE):
        return Path(folder or os.environ[VARIABLE]).expanduser().absolute()
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData/Local", "bare-earth")
    if sys.platform == "darwin":
        return Path.home() / "Library/Caches/bare-earth"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache", "bare-earth")


def download(
    addresses: Sequence[str], wanted: Wanted, cache: Path, advice: str, progress: Progress
) -> Here:
    """Return local files with the wanted parts of addresses, after a download of the parts that
    the cache lacks; `advice` says what to do if it is too large.
    """
    with Transfers(progress, _how_to_follow()) as transfers:
        progress, clouds, is_list = transfers.progress, [], False
        for address in map(checked, addresses):
            listed = clouds_of(address, transfers)
            is_list = is_list or [cloud.address for cloud in listed] != [address]
            clouds += near(listed, wanted.area)
        kept = [CachedPart(cloud, wanted, cache, transfers) for cloud in dict.fromkeys(clouds)]
        missing = [cloud for cloud in kept if not cloud.is_here]
        shares = progress.part(0.0, 0.1).shares(*[1.0] * len(missing))
        planned = [(cloud, cloud.part(share)) for cloud, share in zip(missing, shares)]
        parts = [(cloud, part) for cloud, part in planned if part.point_count]
        if wanted.is_measured:
            for _, part in parts:
                _check_lengths(part, wanted.crs or part.crs)
        if parts:
            check_size([part for _, part in parts], wanted.most, advice, progress)
        shares = progress.part(0.1, 1.0).shares(*(part.point_count for _, part in parts))
        for (cloud, part), share in zip(parts, shares):
            cloud.download(part, share)
    found = [cloud for cloud in kept if cloud.is_here]
    if not found:
        raise nothing_there([part for _, part in planned], addresses[0])
    paths = {cloud.path: shown(cloud.address) for cloud in found}
    for path, address in paths.items():
        progress.info(f"{address} is read from {path}.")
    return Here(paths, is_list)


def _check_lengths(part: CloudPart, crs: Crs) -> None:
    """Refuse, before the download, a cloud in a CRS with wrong lengths, such as those of 3DEP."""
    try:
        require_measurable(part.name, crs, part.box if part.area is None else part.area.bounds)
    except BareEarthError as error:
        raise BareEarthError(
            f"{error} Or transform it while it is downloaded: {option('to_utm', True, of='fetch')}."
        ) from error


def download_all(
    given: Mapping[str, Sequence[str | Path]],
    wanted: Wanted,
    cache: Path,
    advice: str,
    progress: Progress,
) -> tuple[dict[str, Inputs], dict[Path, str]]:
    """Return the files of inputs with some addresses, by the names of the inputs, and the mapping
    for `addresses_named`.
    """
    inputs, found = {}, {}
    shares = progress.shares(*[1.0] * len(given))
    for (name, sources), share in zip(given.items(), shares):
        addresses = [str(source) for source in sources if is_address(str(source))]
        if addresses:
            here = download(addresses, wanted, cache, advice, share)
            found.update(here.paths)
            paths = [*here.paths, *(source for source in sources if source not in addresses)]
            # A list is a survey, however many of its files have points in the area.
            inputs[name] = Inputs(paths, True if here.is_list else None)
    return inputs, found


@contextlib.contextmanager
def addresses_named(found: Mapping[Path, str]) -> Iterator[None]:
    """Let errors name addresses in place of files in the cache, and remove damaged files."""
    try:
        yield
    except BareEarthError as error:
        for path, address in found.items():
            if str(path) in str(error) and not is_sound(path):
                remove(path)
                raise BareEarthError(
                    f"The copy of {address} in the cache was damaged, and is removed. Run it again."
                    f" {tool('clear-cache')} empties the cache."
                ) from error
            error.args = (str(error).replace(str(path), address),)
        raise


class Seen(NamedTuple):
    """A remote point cloud as it is known before its points are downloaded."""

    address: str
    crs: Crs
    box: Box  # smallest x and y, largest x and y in this CRS


def look(addresses: Sequence[str], cache: Path, progress: Progress = SILENT) -> list[Seen]:
    """Return CRS and extent of the point clouds at addresses; where a list states the extent, the
    CRS is that of the first cloud.
    """
    found: list[Seen] = []
    with Transfers(progress, _how_to_follow()) as transfers:
        clouds = [
            cloud for address in map(checked, addresses) for cloud in clouds_of(address, transfers)
        ]
        # No points lie in this area, so that hardly more than the headers is read.
        nowhere = Wanted(AreaAround((0.0, 0.0, 1e-6, 1e-6)))
        for cloud in dict.fromkeys(clouds):
            if found and cloud.box is not None:
                west, south, east, north = cloud.box  # lists round
                box = west - 1.0, south - 1.0, east + 1.0, north + 1.0
                found.append(Seen(cloud.address, found[0].crs, box))
                continue
            part = CachedPart(cloud, nowhere, cache, transfers).part(transfers.progress.quiet())
            found.append(Seen(cloud.address, part.crs, part.box))
    return found


def clear(cache: Path) -> int:
    """Remove the files that are kept, but no others, and return their number of bytes."""
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
