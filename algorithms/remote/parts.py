"""Parts of a remote file that are kept on disk until the output is complete."""

from __future__ import annotations

import bisect
import contextlib
import json
import re
import threading
from pathlib import Path
from typing import Iterable, Iterator, Mapping

from ..core.errors import BareEarthError
from ..core.files import make_work_folder, replacing, write_errors_told
from ..core.temporary import is_temporary, remove
from .addresses import shown

_ABOUT = "about.json"
# Attempts to write a file: another run that has all of the cloud may remove the folder meanwhile.
_TRIES = 5
_RANGE = re.compile(r"(\d+)-(\d+)")
_TILE = re.compile(r"\d+-\d+-\d+-\d+\.\w+")
Range = tuple[int, int]  # first byte, and the one after the last


class Parts:
    """Ranges or tiles of one version of a remote point cloud, each a file in a folder; the folder
    stays after an error or a cancel, so that the next run continues.
    """

    def __init__(self, folder: Path, address: str) -> None:
        self._folder, self._address = folder, address
        self._ranges: list[Range] = []  # in order
        self._lock = threading.Lock()

    def begin(self, version: Mapping[str, object], is_certain: bool) -> None:
        """Find the parts of this version of the cloud, and remove others; remove all if it is not
        certain which version it is.
        """
        # The address is kept without its signature, which differs from run to run and is secret.
        about = json.dumps({"address": shown(self._address), **version})
        with write_errors_told(self._folder):
            make_work_folder(self._folder)
            if not all(map(_is_ours, self._paths())):
                raise BareEarthError(
                    f"{self._folder} is in the way: what is downloaded waits in a folder of this"
                    " name. Rename it, or choose another output."
                )
            if not is_certain or self._about() != about:
                for path in self._paths():
                    remove(path)
                self.add_file(_ABOUT, about.encode())
            for path in self._paths():
                found = _RANGE.fullmatch(path.name)
                if found and _size_of(path) == int(found[2]) - int(found[1]):
                    self._know(int(found[1]), int(found[2]))

    def _paths(self) -> list[Path]:
        """Return the files in the folder; none if another run has removed it."""
        with contextlib.suppress(FileNotFoundError):
            return list(self._folder.iterdir())
        return []

    def _about(self) -> str | None:
        with contextlib.suppress(OSError, ValueError):
            return (self._folder / _ABOUT).read_text(encoding="utf-8")
        return None

    def _know(self, start: int, stop: int) -> None:
        with self._lock:
            bisect.insort(self._ranges, (start, stop))

    def _pieces(self, start: int, stop: int) -> Iterator[tuple[Range, Range | None]]:
        """Yield the pieces of a range, each with the part that holds it, or None."""
        with self._lock:
            ranges = self._ranges[: bisect.bisect_left(self._ranges, (stop, 0))]
        while start < stop:
            inside = [part for part in ranges if part[0] <= start < part[1]]
            if inside:
                part = max(inside, key=lambda part: part[1])
                yield (start, min(part[1], stop)), part
                start = part[1]
            else:
                end = min((part[0] for part in ranges if part[0] > start), default=stop)
                yield (start, end), None
                start = end

    def missing(self, start: int, stop: int) -> list[Range]:
        """Return the pieces of a range that are not here."""
        return [piece for piece, part in self._pieces(start, stop) if part is None]

    def add(self, start: int, data: bytes) -> None:
        """Keep bytes from `start` on, and remove parts within them."""
        stop = start + len(data)
        self.add_file(_name(start, stop), data)
        with self._lock:
            within = [part for part in self._ranges if start <= part[0] and part[1] <= stop]
        self._remove(part for part in within if part != (start, stop))
        if (start, stop) not in within:
            self._know(start, stop)

    def drop(self, start: int, stop: int) -> None:
        """Remove the parts with bytes of a range, which are damaged."""
        with self._lock:
            damaged = [part for part in self._ranges if part[0] < stop and part[1] > start]
        self._remove(damaged)

    def _remove(self, parts: Iterable[Range]) -> None:
        for part in parts:
            with self._lock:
                self._ranges.remove(part)
            remove(self.path_of(_name(*part)))

    def add_file(self, name: str, data: bytes) -> None:
        """Keep a whole file, which gets its name when it is complete."""
        with write_errors_told(self._folder):
            for tries_left in reversed(range(_TRIES)):
                make_work_folder(self._folder)
                try:
                    with replacing(self.path_of(name)) as temporary:
                        temporary.write_bytes(data)
                    return
                except BareEarthError as error:
                    if not (tries_left and isinstance(error.__cause__, FileNotFoundError)):
                        raise

    def path_of(self, name: str) -> Path:
        """Return where a whole file is kept."""
        return self._folder / name

    def read(self, start: int, stop: int) -> bytes | None:
        """Return the bytes of a range; None if some are not here."""
        data = bytearray()
        for (first, last), part in self._pieces(start, stop):
            if part is None:
                return None
            with contextlib.suppress(OSError), open(self.path_of(_name(*part)), "rb") as file:
                file.seek(first - part[0])
                data += file.read(last - first)
            if len(data) != last - start:  # somebody has removed or changed the file
                self.drop(*part)
                return None
        return bytes(data)


def _name(start: int, stop: int) -> str:
    return f"{start}-{stop}"


def _size_of(path: Path) -> int:
    """Return the size of a file, -1 if another process has removed it."""
    with contextlib.suppress(OSError):
        return path.stat().st_size
    return -1


def _is_ours(path: Path) -> bool:
    is_part = _RANGE.fullmatch(path.name) or _TILE.fullmatch(path.name)
    return path.name == _ABOUT or is_part is not None or is_temporary(path)


def remove_parts(folder: Path) -> None:
    """Remove a folder of parts, or of such folders, but no files of others in it."""
    if not folder.is_dir():
        return
    for path in folder.iterdir():
        if path.is_dir() and not path.is_symlink():
            remove_parts(path)
        elif _is_ours(path):
            remove(path)
    with contextlib.suppress(OSError):  # it holds something else
        folder.rmdir()
