"""Reads from servers in a few threads, with further attempts after errors, until cancelled."""

from __future__ import annotations

import contextlib
import queue
import threading
import time
from typing import Callable, Protocol, Sequence, TypeVar
from urllib.parse import urlsplit

from ..core.errors import BareEarthError
from ..core.progress import PassingOn, Progress
from ..core.words import counted
from .addresses import STORES, host_of
from .answers import Expired, FileVersion, Missing, Unfinished
from .connections import HttpReader
from .object_stores import StoreReader
from .signing import Signatures

_Result = TypeVar("_Result")

_THREADS = 6  # most servers allow about six connections
_ATTEMPTS = 6
_SIGNED = 2  # most signatures for an address: the first may have expired when it is used
# Seconds before the second attempt, doubled before each further one, and the longest pause that a
# server may state.
_FIRST_PAUSE = 0.25
_LONGEST_PAUSE = 120.0
# Seconds that failed attempts may take together, beside the pauses that the server states and the
# time for the received bytes at the least speed, in bytes a second.
_LONGEST = 45.0
_LEAST_SPEED = 10_000
_SILENCE = 5.0  # seconds without a byte after which the log names the server that we wait for
_BEAT = 0.1  # seconds after which the caller checks again whether the user has cancelled
_LONGEST_END = 1.0  # seconds that the threads may take to end
# Requests a second that hosts allow, by the ends of their names. IGN blocks users who make more.
_LIMITS = {"geopf.fr": 9.0, "ign.fr": 9.0}


class Reader(Protocol):
    """Makes single requests: here by http.client or fsspec, in QGIS by its network manager."""

    # It checks answers by `answers.py`, and raises `Unfinished` if another attempt may succeed.
    requests: int  # number of requests so far
    received: int  # bytes received so far
    notes: list[str]  # warnings for the user that are not yet shown
    # How the user can allow redirects to other servers; None if they are allowed.
    refusal: str | None

    def read(
        self, address: str, start: int, stop: int, known: FileVersion | None
    ) -> tuple[bytes, FileVersion]:
        """Return bytes of a file, of the known version of it."""

    def read_whole(self, address: str, most: int) -> bytes:
        """Return a whole file of at most `most` bytes."""

    def place_of(self, address: str) -> str:
        """Return the address to which another one led before."""

    def close(self) -> None:
        """End all connections, also those in use by other threads."""

    def end_overdue(self) -> None:
        """End the connections whose answers take too long."""


class _Pace:
    """The least time between requests of all threads to a host."""

    def __init__(self) -> None:
        self._next: dict[str, float] = {}
        self._lock = threading.Lock()

    def pause(self, host: str) -> float:
        """Return the seconds to wait before the next request."""
        limits = [rate for end, rate in _LIMITS.items() if f".{host}".endswith(f".{end}")]
        if not limits:
            return 0.0
        with self._lock:
            now = time.monotonic()
            start = max(now, self._next.get(host, now))
            self._next[host] = start + 1.0 / min(limits)
            return start - now


# One for the process, so that two runs in QGIS share the limit of a host.
_PACE = _Pace()
# Makes the reader for the web. The plugin puts that of QGIS here.
_READERS: list[Callable[[], Reader]] = [HttpReader]


def use(reader: Callable[[], Reader]) -> None:
    """Let all further transfers of this process read from the web by another reader."""
    _READERS[:] = [reader]


class _Latest(PassingOn):
    """Passes on progress, and knows how much of the whole is done."""

    share = 0.0

    def report(self, fraction: float) -> None:
        self.share = fraction
        super().report(fraction)


class Transfers:
    """The requests of a run, which end with the block; with a `refusal`, which says how the user
    can allow it, other servers in lists and redirects are refused, and signatures not requested.
    """

    def __init__(self, progress: Progress, refusal: str | None = "give its address") -> None:
        self.progress, self.refusal = _Latest(progress), refusal
        self._web, self._stores = _READERS[0](), StoreReader()
        self._web.refusal = refusal
        self._signatures = Signatures(self.read_whole, refusal is None)
        self._asked = ""  # the server of the last request
        self._silent = {""}  # the silent servers that the log has named
        self._heard = (0, 0.0)  # bytes so far, and when they grew
        self._stopped = threading.Event()
        self._threads: list[threading.Thread] = []
        self.files = contextlib.ExitStack()  # files that are closed when the block ends

    def __enter__(self) -> Transfers:
        return self

    def __exit__(self, *exception: object) -> None:
        self._stopped.set()
        self.files.close()
        for reader in (self._web, self._stores):
            reader.close()
        # Threads must not use anything that the program closes after this.
        end = time.monotonic() + _LONGEST_END
        for thread in self._threads:
            thread.join(max(end - time.monotonic(), 0.0))

    @property
    def requests(self) -> int:
        """Number of requests so far."""
        return self._web.requests + self._stores.requests

    @property
    def received(self) -> int:
        """Bytes of answers so far."""
        return self._web.received + self._stores.received

    def read(
        self,
        address: str,
        start: int,
        stop: int,
        known: FileVersion | None,
        keep: Callable[[int, bytes], object] = lambda start, data: None,
    ) -> tuple[bytes, FileVersion]:
        """Return bytes of a file, of the known version of it, after further attempts if needed; the
        bytes of an answer that was cut off or cancelled are given to `keep`.
        """
        reader, came = self._reader(address), bytearray()

        def ask(place: str) -> tuple[bytes, FileVersion]:
            if known is not None and start + len(came) == stop:
                return bytes(came), known
            try:
                data, state = reader.read(place, start + len(came), stop, known)
            except Unfinished as error:
                if known is not None and error.data:
                    keep(start + len(came), error.data)
                    came.extend(error.data)
                raise
            return bytes(came) + data, state

        return self._patiently(address, ask)

    def read_whole(self, address: str, most: int) -> bytes:
        """Return a whole file of at most `most` bytes."""
        reader = self._reader(address)
        return self._patiently(address, lambda place: reader.read_whole(place, most))

    def run(
        self,
        tasks: Sequence[Callable[[], _Result]],
        progress: Progress | None = None,
        size: int = 0,
    ) -> list[_Result]:
        """Do tasks, which call `read`, in threads, and return their results in order; the progress
        tells the share of `size` bytes.
        """
        # `core.threads` is not used: these threads wait, and a cancel must not wait for them.
        results: dict[int, _Result] = {}
        waiting = iter(enumerate(tasks))
        done: queue.Queue[tuple[int, _Result | None, BaseException | None]] = queue.Queue()
        lock, before = threading.Lock(), self.received
        self._heard = before, time.monotonic()

        def work() -> None:
            while not self._stopped.is_set():
                with lock:
                    number, task = next(waiting, (-1, None))
                if task is None:
                    return
                try:
                    done.put((number, task(), None))
                except BaseException as error:  # raised in the thread of the caller
                    done.put((number, None, error))

        for _ in range(min(_THREADS, len(tasks))):
            self._threads.append(threading.Thread(target=work, name="download", daemon=True))
            self._threads[-1].start()
        while len(results) < len(tasks):
            try:
                number, result, error = done.get(timeout=_BEAT)
            except queue.Empty:
                number, result, error = -1, None, None
            if error is not None:
                self._stopped.set()
                raise error
            if number >= 0:
                results[number] = result  # type: ignore[assignment]
            self._watch()
            self._report(progress, (self.received - before) / size if size else 0.0)
        return [results[number] for number in range(len(tasks))]

    def whole(self, address: str, most: int) -> bytes:
        """Return a whole file of at most `most` bytes, while the caller can cancel."""
        return self.one(lambda: self.read_whole(address, most))

    def _watch(self) -> None:
        """End connections that take too long, and tell the user once of each silent server."""
        self._web.end_overdue()
        if self.received != self._heard[0]:
            self._heard = self.received, time.monotonic()
        elif time.monotonic() - self._heard[1] > _SILENCE and self._asked not in self._silent:
            self._silent.add(self._asked)
            self.progress.warning(
                f"No bytes have come from {self._asked} for {_SILENCE:.0f} seconds: waiting for it."
            )

    def one(self, task: Callable[[], _Result]) -> _Result:
        """Do one task, as `run`."""
        return self.run([task])[0]

    def _report(self, progress: Progress | None, share: float) -> None:
        """Report progress, which raises an error after a cancel, and show the warnings."""
        for source in (self._web, self._stores, self._signatures):
            while source.notes:
                self.progress.warning(source.notes.pop(0))
        if progress is None:
            self.progress(self.progress.share)
        else:
            progress(share)

    def _reader(self, address: str) -> Reader:
        return self._stores if urlsplit(address).scheme.lower() in STORES else self._web

    def _patiently(self, address: str, ask: Callable[[str], _Result]) -> _Result:
        """Ask until there is an answer, at most some times."""
        reader, host, attempt, signed = self._reader(address), host_of(address), 0, 0
        place, took = self._signatures.signed(address), 0.0
        while True:
            self._stopped.wait(_PACE.pause(host_of(reader.place_of(place))))
            if self._stopped.is_set():
                raise Unfinished("cancelled")
            self._asked, begun = host, time.monotonic()
            try:
                return ask(place)
            except (Missing, Expired) as error:
                signed += 1
                if signed > _SIGNED:
                    raise
                place = self._signatures.sign(address, place, error)
            except Unfinished as error:
                # What came until then was worth its time.
                took += time.monotonic() - begun - len(error.data) / _LEAST_SPEED
                attempt += not error.is_stale
                pause = error.pause or _FIRST_PAUSE * 2 ** (attempt - 1)
                if attempt >= _ATTEMPTS or pause > _LONGEST_PAUSE or took > _LONGEST:
                    raise BareEarthError(
                        f"{host} cannot be read: {error}, after {counted(attempt, 'attempt')}."
                        " Check the connection and the address, or run it again later."
                    ) from error
                self._stopped.wait(0.0 if error.is_stale else pause)
