"""Files on servers, or on this computer, that are read by ranges."""

from __future__ import annotations

import io
from functools import partial
from pathlib import Path
from typing import Callable, Iterable, NamedTuple, Protocol, TypeVar

from ..core.errors import BareEarthError
from ..core.progress import Progress
from ..las.sources import open_source
from .addresses import name_of, shown
from .answers import FileVersion, changed, too_large
from .parts import Parts, Range
from .transfers import Transfers

_Result = TypeVar("_Result")

_COPC = slice(377, 381)  # place of the user id of the first record of a LAS 1.4 file
_FIRST = 1 << 16  # bytes of the first request, for the header and most records
_LEAST = 1 << 14  # least bytes of other requests
# Most bytes of a request of several pieces, of any request, and of a single read.
_MOST = 1 << 23
_LARGEST = 1 << 25
_MOST_READ = 1 << 28
# Pieces are joined across gaps, which are downloaded too: most bytes of a gap, about the cost of a
# request, and of all gaps, as a share of the pieces.
_WIDEST_GAP = 1 << 16
_GAPS = 0.1


class RequestPlan(NamedTuple):
    """The requests for some pieces of a file."""

    requests: list[Range]  # without ranges that are here already
    size: int  # bytes of all requests


class RangeFile(Protocol):
    """A file that is read by ranges, by position as an open file."""

    name: str
    size: int

    def plan(self, pieces: Iterable[Range]) -> RequestPlan:
        """Return the requests that give some pieces."""

    def fetch(self, plan: RequestPlan, progress: Progress) -> None:
        """Get what was planned, before it is read."""

    def seek(self, position: int, whence: int = 0) -> int:
        """Move to a position."""

    def read(self, count: int = -1) -> bytes:
        """Return the bytes from the position on."""

    def checked(self) -> None:
        """Note that all bytes that were read so far are sound."""

    def twice(self, work: Callable[[], _Result]) -> _Result:
        """Do work that reads and checks; if it fails, request the bytes anew and repeat it once."""


class RemoteFile(io.RawIOBase):
    """A file on a server; bytes that were not fetched before are requested when they are read."""

    def __init__(self, transfers: Transfers, address: str) -> None:
        super().__init__()
        self.address, self.name = address, name_of(address)
        self._transfers, self._position = transfers, 0
        # Ranges that were read, but are not yet known to be sound.
        self._unchecked: list[Range] = []
        # The first bytes are always requested, since the answer states the version of the file.
        self._head, self.version = self._first()
        self.size = self.version.size

    def _first(self) -> tuple[bytes, FileVersion]:
        return self._transfers.one(lambda: self._transfers.read(self.address, 0, _FIRST, None))

    def keep_in(self, folder: Path) -> RemoteFile:
        """Keep fetched bytes in a folder, so that they are not fetched again."""
        self._parts = Parts(folder, self.address)
        self._parts.begin(self.version._asdict(), self.version.is_certain)
        return self

    @property
    def is_copc(self) -> bool:
        """Whether the first record is that of COPC, whatever the name is."""
        return self._head[_COPC.start : _COPC.stop] == b"copc"

    def plan(self, pieces: Iterable[Range]) -> RequestPlan:
        """Return the requests that give some pieces, joined across gaps."""
        wanted = [piece for piece in pieces if piece[1] > len(self._head)]
        if any(stop > self.size for _, stop in wanted):
            raise BareEarthError(f"{shown(self.address)} is cut off. Check the address.")
        missing = sorted(part for piece in wanted for part in self._parts.missing(*piece))
        requests = [
            (first, min(first + _LARGEST, stop))
            for start, stop in _joined(missing)
            for first in range(start, stop, _LARGEST)
        ]
        return RequestPlan(requests, sum(stop - start for start, stop in requests))

    def fetch(self, plan: RequestPlan, progress: Progress | None = None) -> None:
        """Get what was planned, in threads, and keep it on disk."""
        tasks = [partial(self._fetch, *piece) for piece in plan.requests]
        self._transfers.run(tasks, progress, plan.size)

    def checked(self) -> None:
        """Note that all bytes that were read so far are sound."""
        self._unchecked.clear()

    def twice(self, work: Callable[[], _Result]) -> _Result:
        """Do work that reads and checks; if it fails, request the bytes anew and repeat it once."""
        self.checked()
        try:
            return work()
        except BareEarthError:
            if not self._dropped():
                raise
        try:
            return work()
        except BareEarthError:
            self._dropped()
            raise

    def _dropped(self) -> bool:
        """Drop the bytes that were read and are not known to be sound, so that they are requested
        once more; return whether there were any.
        """
        doubtful, self._unchecked = self._unchecked, []
        for piece in doubtful:
            self._parts.drop(*piece)
        if any(start < len(self._head) for start, _ in doubtful):
            self._head, version = self._first()
            if version != self.version:
                raise changed(self.address)
        return bool(doubtful)

    def readable(self) -> bool:
        """Return that it can be read."""
        return True

    def seekable(self) -> bool:
        """Return that positions can be chosen."""
        return True

    def tell(self) -> int:
        """Return the position."""
        return self._position

    def seek(self, position: int, whence: int = 0) -> int:
        """Move to a position, relative to the start, here or the end."""
        self._position = position + (0, self._position, self.size)[whence]
        return self._position

    def read(self, count: int = -1) -> bytes:
        """Return the bytes from the position on."""
        start = min(self._position, self.size)
        stop = self.size if count < 0 else min(start + count, self.size)
        if stop - start > _MOST_READ:
            raise too_large(self.address, f"wants {stop - start:,} bytes to be read at once")
        data = self._kept(start, stop)
        if data is None:
            piece = start, min(max(stop, start + _LEAST), self.size)
            self.fetch(self.plan([piece]))
            data = self._kept(start, stop)
        if data is None:
            raise BareEarthError(f"What was fetched of {self.name} has changed. Run it again.")
        self._unchecked.append((start, stop))
        self._position = stop
        return data

    def _kept(self, start: int, stop: int) -> bytes | None:
        """Return bytes that are here already."""
        if stop <= len(self._head):
            return self._head[start:stop]
        return self._parts.read(start, stop)

    def _fetch(self, start: int, stop: int) -> None:
        try:
            data, _ = self._transfers.read(self.address, start, stop, self.version, self._parts.add)
        except BareEarthError:
            self.checked()  # the error is not in the bytes that were read
            raise
        self._parts.add(start, data)


class LocalFile(io.FileIO):
    """A file on this computer, from which nothing has to be fetched."""

    def __init__(self, path: Path) -> None:
        open_source(path).close()  # raises an error that says what to do
        super().__init__(path, "rb")
        self.name, self.size = path.name, path.stat().st_size

    def plan(self, pieces: Iterable[Range]) -> RequestPlan:
        """Return that no request is needed."""
        return RequestPlan([], 0)

    def fetch(self, plan: RequestPlan, progress: Progress) -> None:
        """Get nothing."""

    def checked(self) -> None:
        """Do nothing, because a second attempt would read the same bytes."""

    def twice(self, work: Callable[[], _Result]) -> _Result:
        """Do the work once."""
        return work()


def read_local(path: Path, most: int) -> bytes:
    """Return a whole file of this computer, of at most `most` bytes."""
    with open_source(path) as file:
        data = file.read(most + 1)
    if len(data) > most:
        raise too_large(str(path), f"has more than {most:,} bytes")
    return data


def _joined(pieces: list[Range]) -> list[Range]:
    """Return sorted pieces as fewer requests, across the narrowest gaps."""
    wanted = sum(stop - start for start, stop in pieces)
    gaps = sorted(max(later[0] - piece[1], 0) for piece, later in zip(pieces, pieces[1:]))
    allowed, total = 0, 0
    for gap in gaps:
        total += gap
        if gap > _WIDEST_GAP or total > max(_GAPS * wanted, _LEAST):
            allowed = min(allowed, gap - 1)
            break
        allowed = gap
    requests: list[Range] = []
    for start, stop in pieces:
        if requests:
            first, last = requests[-1]
            if start - last <= allowed and max(stop, last) - first <= _MOST:
                requests[-1] = first, max(stop, last)
                continue
        requests.append((start, stop))
    return requests
