"""How many threads a computation may use, and work spread over so many.

The filters run in threads, one for each block. Where there are fewer blocks than threads, a block
may use several itself: it asks `workers` how many, or lets `in_threads` do so.
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
    except AttributeError:  # Windows and macOS do not tell
        return os.cpu_count() or 1


def workers() -> int:
    """Return how many threads the computation of the calling thread may use: 1 if none said so."""
    return _allowed()()


def _allowed() -> Callable[[], int]:
    """Return what tells how many threads the calling thread may use: that may change."""
    return getattr(_current, "allowed", lambda: 1)


@contextlib.contextmanager
def may_use(count: int | Callable[[], int]) -> Iterator[None]:
    """Let the computations of the calling thread use some threads while the block runs.

    Parameters
    ----------
    count : int or callable
        How many, or what tells how many at a time: more of them help as soon as they may.
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
    """Return the results of a function for each item, in their order.

    The calls run in as many threads as the calling thread may use, itself among them, each in one
    itself.

    Parameters
    ----------
    function : callable
        Takes one item. It must not change what another call reads.
    items : iterable
        What to call it for.
    progress : Progress
        Receives progress, from the calling thread.

    Raises
    ------
    Exception
        What the first call that failed raised; calls that have not begun are left out then.
    """
    items = list(items)
    return _Shared(function, items).results(progress)


def over_parts(
    function: Callable[[slice], object], count: int, part: int, progress: Progress
) -> None:
    """Call a function for the parts of a range, in threads, and say between them how far it is.

    Parameters
    ----------
    function : callable
        Takes a slice of the range; it keeps its result where no other call writes.
    count : int
        Length of the range.
    part : int
        Length of a part.
    progress : Progress
        Receives progress, from the calling thread.
    """
    _Shared(function, parts_of(count, part)).results(progress)


def parts_of(count: int, part: int) -> list[slice]:
    """Return the slices that cut a range of some length into parts."""
    return [slice(start, min(start + part, count)) for start in range(0, count, part)]


class _Shared:
    """Calls that several threads take one after the other, the calling thread among them.

    No pool: to make one anew for each step would take longer than many of the steps.
    """

    def __init__(self, function: Callable[[_Item], _Result], items: Sequence[_Item]) -> None:
        self._function, self._items = function, items
        self._next = iter(range(len(items)))
        self._lock = threading.Lock()
        self._results: list[Any] = [None] * len(items)
        self._failures: dict[int, BaseException] = {}

    def results(self, progress: Progress) -> list[_Result]:
        """Make the calls; return what they returned, or raise what the first to fail raised."""
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
        """Yield the numbers of calls that nobody has begun yet."""
        while True:
            with self._lock:
                number = next(self._next, None)
            if number is None:
                return
            yield number

    def _end(self) -> None:
        """Let no call begin any more."""
        with self._lock:
            self._next = iter(())
