"""Threads for a computation, and functions that run in them.

Each block is filtered in one thread. `in_threads` lets a computation use further threads, if some
are free at that moment. All computations of a run share one number of threads, nested ones too.
"""

from __future__ import annotations

import contextlib
import os
import threading
from typing import Any, Callable, ContextManager, Iterable, Iterator, Protocol, Sequence, TypeVar

from .progress import SILENT, Progress

_Item = TypeVar("_Item")
_Result = TypeVar("_Result")
_current = threading.local()


def available_cpus() -> int:
    """Return the number of CPUs that this process may use."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # not available in Windows and macOS
        return os.cpu_count() or 1


class Counter(Protocol):
    """A number with a lock, such as `multiprocessing.Value`."""

    value: int

    def get_lock(self) -> ContextManager[object]:
        """Return the lock."""


class _LocalCounter:
    """A `Counter` for the threads of this process."""

    def __init__(self, value: int) -> None:
        self.value, self._lock = value, threading.Lock()

    def get_lock(self) -> ContextManager[object]:
        return self._lock


class SharedThreads:
    """A number of threads, at least 1, that several computations share, in one or in several
    processes.
    """

    def __init__(self, count: int | Counter) -> None:
        self._free = _LocalCounter(max(1, count)) if isinstance(count, int) else count

    @property
    def free(self) -> int:
        """How many threads are free; negative if too many work."""
        return self._free.value

    @contextlib.contextmanager
    def used(self) -> Iterator[None]:
        """Make the calling thread one of the threads, which can use free threads, while the block
        runs.
        """
        # If no thread is free, a thread that helps another computation will soon end.
        before = shared_threads()
        self._add(-1)
        _current.shared = self
        try:
            yield
        finally:
            _current.shared = before
            self._add(1)

    def take(self) -> bool:
        """Take one of the free threads and return True, or return False if all are in use."""
        with self._free.get_lock():
            if self.free <= 0:
                return False
            self._free.value -= 1
            return True

    def help(self, work: Iterator[object]) -> None:
        """Do the steps of some work in a thread that was taken, until too many threads work."""
        _current.shared = self
        try:
            for _ in work:
                if self.free < 0:
                    return
        finally:
            self._add(1)

    @contextlib.contextmanager
    def lent(self) -> Iterator[None]:
        """Free the place of the calling thread while it waits in the block."""
        self._add(1)
        try:
            yield
        finally:
            self._add(-1)

    def _add(self, count: int) -> None:
        with self._free.get_lock():
            self._free.value += count


def shared_threads() -> SharedThreads | None:
    """Return the threads to which the calling thread belongs; None outside of `may_use`."""
    return getattr(_current, "shared", None)


def workers() -> int:
    """Return how many threads the calling thread may use now; 1 outside of `may_use`."""
    shared = shared_threads()
    return 1 if shared is None else 1 + max(0, shared.free)


def may_use(count: int) -> contextlib.AbstractContextManager[None]:
    """Let the calling thread use `count` threads, including itself, while the block runs."""
    return SharedThreads(count).used()


def in_threads(
    function: Callable[[_Item], _Result], items: Iterable[_Item], progress: Progress = SILENT
) -> list[_Result]:
    """Return the results of a function for each item, in order, or raise the exception of the first
    call that failed; a call must not change data that another call reads.
    """
    # The calls run in the calling thread, which also reports progress, and in free threads. A call
    # may use free threads as well. After a failure, no further call starts.
    items = list(items)
    return _Shared(function, items).results(progress)


def over_parts(
    function: Callable[[slice], object], count: int, part: int, progress: Progress
) -> None:
    """Call a function for the slices of a range, in threads (see `in_threads`); two calls must not
    write to the same place.
    """
    _Shared(function, parts_of(count, part)).results(progress)


def parts_of(count: int, part: int) -> list[slice]:
    """Return slices of length `part` (the last may be shorter) that cover a range."""
    return [slice(start, min(start + part, count)) for start in range(0, count, part)]


class _Shared:
    """A list of calls that are made in the calling thread and in further threads."""

    # There is no thread pool, since to make one would take longer than many computations.

    def __init__(self, function: Callable[[_Item], _Result], items: Sequence[_Item]) -> None:
        self._function, self._items = function, items
        self._next = iter(range(len(items)))
        self._lock = threading.Lock()
        self._results: list[Any] = [None] * len(items)
        self._failures: dict[int, BaseException] = {}

    def results(self, progress: Progress) -> list[_Result]:
        """Make the calls and return their results, or raise the first exception."""
        helpers: list[threading.Thread] = []
        shared = shared_threads()
        try:
            for number in self._numbers():
                while len(helpers) < len(self._items) - number - 1 and shared and shared.take():
                    helper = threading.Thread(
                        target=shared.help, args=[self._calls()], name="strip", daemon=True
                    )
                    helpers.append(helper)
                    helper.start()
                self._call(number)
                progress((number + 1) / len(self._items))
        finally:
            self._end()
            if helpers and shared:
                with shared.lent():
                    for helper in helpers:
                        helper.join()
        if self._failures:
            raise self._failures[min(self._failures)]
        return self._results

    def _calls(self) -> Iterator[None]:
        """Make a call at each step."""
        for number in self._numbers():
            self._call(number)
            yield

    def _call(self, number: int) -> None:
        try:
            self._results[number] = self._function(self._items[number])
        except BaseException as error:
            self._failures[number] = error
            self._end()

    def _numbers(self) -> Iterator[int]:
        """Yield the numbers of calls that have not started yet."""
        while True:
            with self._lock:
                number = next(self._next, None)
            if number is None:
                return
            yield number

    def _end(self) -> None:
        """Start no further call."""
        with self._lock:
            self._next = iter(())
