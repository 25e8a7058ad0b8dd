"""The number of threads that a computation may use, and functions that run in these threads.

Each block is filtered in one thread. If there are fewer blocks than threads, a block can use
several: `workers` tells how many, and `in_threads` uses them.
"""

from __future__ import annotations

import contextlib
import os
import threading
from typing import Any, Callable, Iterable, Iterator, Sequence, TypeVar

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


def workers() -> int:
    """Return how many threads the calling thread may use; 1 outside of `may_use`."""
    return _allowed()()


def _allowed() -> Callable[[], int]:
    """Return a function that returns the number of threads for the calling thread now."""
    return getattr(_current, "allowed", lambda: 1)


@contextlib.contextmanager
def may_use(count: int | Callable[[], int]) -> Iterator[None]:
    """Let the calling thread use several threads while the block runs.

    Parameters
    ----------
    count : int or callable
        The number of threads, or a function that returns it. The number can change during the run.
    """
    before = _allowed()
    tells = count if callable(count) else lambda: int(count)
    _current.allowed = lambda: max(1, tells())
    try:
        yield
    finally:
        _current.allowed = before


def in_threads(
    function: Callable[[_Item], _Result], items: Iterable[_Item], progress: Progress = SILENT
) -> list[_Result]:
    """Return the results of a function for each item, in order.

    The calls run in as many threads as the calling thread may use, including itself. Each call may
    use one thread.

    Parameters
    ----------
    function : callable
        Takes one item. It must not change data that another call reads.
    items : iterable
        The items.
    progress : Progress
        Receives progress, from the calling thread.

    Raises
    ------
    Exception
        The exception of the first item whose call failed. Calls that have not started are left out.
    """
    items = list(items)
    return _Shared(function, items).results(progress)


def over_parts(
    function: Callable[[slice], object], count: int, part: int, progress: Progress
) -> None:
    """Call a function for the parts of a range, in threads; see `in_threads`.

    Parameters
    ----------
    function : callable
        Takes a slice of the range. It must not write where another call writes.
    count : int
        Length of the range.
    part : int
        Length of a part.
    progress : Progress
        Receives progress, from the calling thread.
    """
    _Shared(function, parts_of(count, part)).results(progress)


def parts_of(count: int, part: int) -> list[slice]:
    """Return slices of length `part` (the last may be shorter) that cover a range."""
    return [slice(start, min(start + part, count)) for start in range(0, count, part)]


class _Shared:
    """A list of calls, which several threads, including the calling one, work off.

    There is no thread pool, since making one for each step would take longer than many steps.
    """

    def __init__(self, function: Callable[[_Item], _Result], items: Sequence[_Item]) -> None:
        self._function, self._items = function, items
        self._next = iter(range(len(items)))
        self._lock = threading.Lock()
        self._results: list[Any] = [None] * len(items)
        self._failures: dict[int, BaseException] = {}

    def results(self, progress: Progress) -> list[_Result]:
        """Make the calls and return their results, or raise the first exception."""
        others: list[threading.Thread] = []
        allowed = _allowed()
        try:
            with may_use(1):
                for number in self._numbers():
                    while len(others) < min(allowed(), len(self._items) - number) - 1:
                        one = threading.Thread(target=self._help, name="strip", daemon=True)
                        others.append(one)
                        one.start()
                    self._call(number)
                    progress((number + 1) / len(self._items))
        finally:
            self._end()
            for each in others:
                each.join()
        if self._failures:
            raise self._failures[min(self._failures)]
        return self._results

    def _help(self) -> None:
        for number in self._numbers():
            self._call(number)

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
