"""Parts of a remote file that are kept on disk until the output is there."""

from __future__ import annotations

import bisect
import contextlib
import json
import re
import threading
from pathlib import Path
from typing import Mapping

from ..core.errors import BareEarthError
from ..core.files import make_work_folder, replacing, write_errors_told
from ..core.temporary import is_temporary, remove
from .addresses import shown

_ABOUT, _RANGE = "about.json", re.compile(r"(\d+)-(\d+)")
_TILE = re.compile(r"\d+-\d+-\d+-\d+\.\w+")


class Parts:
    """Ranges or tiles of one version of a remote point cloud, each a file in a folder, which stays
    after an error or a cancel, so that the next run goes on.
    """

    def __init__(self, folder: Path, address: str) -> None:
        self._folder, self._address = folder, address
        self._starts: list[int] = []
        self._stops: dict[int, int] = {}
        self._lock = threading.Lock()

    def begin(self, version: Mapping[str, object], is_certain: bool) -> None:
        """Keep what is there of this version of the cloud, if it is certain which one it is, and
        remove what is not.
        """
        # Signatures differ from run to run, and belong into no file.
        about = json.dumps({"address": shown(self._address), **version})
        with write_errors_told(self._folder):
            make_work_folder(self._folder)
            if not all(map(_is_ours, self._folder.iterdir())):
                raise BareEarthError(
                    f"{self._folder} is in the way: what is downloaded waits in a folder of this"
                    " name. Rename it, or choose another output."
                )
            if not is_certain or self._about() != about:
                for path in self._folder.iterdir():
                    remove(path)
                with replacing(self._folder / _ABOUT) as temporary:
                    temporary.write_text(about, encoding="utf-8")
            for path in self._folder.iterdir():
                found = _RANGE.fullmatch(path.name)
                if found and path.stat().st_size == int(found[2]) - int(found[1]):
                    self._know(int(found[1]), int(found[2]))

    def _about(self) -> str | None:
        with contextlib.suppress(OSError, ValueError):
            return (self._folder / _ABOUT).read_text(encoding="utf-8")
        return None

    def _know(self, start: int, stop: int) -> None:
        if start not in self._stops:
            bisect.insort(self._starts, start)
        self._stops[start] = max(stop, self._stops.get(start, 0))

    def holding(self, start: int, stop: int) -> tuple[int, int] | None:
        """Return the part that holds all bytes of a range, if any."""
        with self._lock:
            for first in reversed(self._starts[: bisect.bisect_right(self._starts, start)]):
                if self._stops[first] >= stop:
                    return first, self._stops[first]
        return None

    def add(self, start: int, data: bytes) -> None:
        """Keep bytes; the file gets its name when it is whole."""
        self.add_file(f"{start}-{start + len(data)}", data)
        with self._lock:
            self._know(start, start + len(data))

    def add_file(self, name: str, data: bytes) -> None:
        """Keep a whole file."""
        path = self.path_of(name)
        with write_errors_told(self._folder), replacing(path) as temporary:
            temporary.write_bytes(data)

    def path_of(self, name: str) -> Path:
        """Return where a whole file is kept."""
        return self._folder / name

    def read(self, start: int, stop: int) -> bytes | None:
        """Return the bytes of a range; None if they are not all in one part."""
        part = self.holding(start, stop)
        if part is None:
            return None
        with open(self._folder / f"{part[0]}-{part[1]}", "rb") as file:
            file.seek(start - part[0])
            data = file.read(stop - start)
        return data if len(data) == stop - start else None


def _is_ours(path: Path) -> bool:
    is_part = _RANGE.fullmatch(path.name) or _TILE.fullmatch(path.name)
    return path.name == _ABOUT or is_part is not None or is_temporary(path)


def remove_parts(folder: Path) -> None:
    """Remove a folder of parts, or one that holds several, and leave what is not ours."""
    if not folder.is_dir():
        return
    for path in folder.iterdir():
        if path.is_dir() and not path.is_symlink():
            remove_parts(path)
        elif _is_ours(path):
            remove(path)
    with contextlib.suppress(OSError):  # it holds something else
        folder.rmdir()
