"""How many threads a computation may use, and work spread over so many.

The filters run in threads, one for each block. Where there are fewer blocks than threads, a block
may use several itself: it asks `workers` how many, or lets `in_threads` do so.
"""

from __future__ import annotations

import contextlib
import os
import threading
from concurrent.futures import ThreadPoolExecutor
from typing import Callable, Iterable, Iterator, TypeVar

from .progress import Progress

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
    return getattr(_current, "workers", 1)


@contextlib.contextmanager
def may_use(count: int) -> Iterator[None]:
    """Let the computations of the calling thread use `count` threads while the block runs."""
    before = workers()
    _current.workers = max(1, int(count))
    try:
        yield
    finally:
        _current.workers = before


def in_threads(function: Callable[[_Item], _Result], items: Iterable[_Item]) -> list[_Result]:
    """Return the results of a function for each item, in their order.

    The calls run in as many threads as the calling thread may use, each in one itself; in the
    calling thread where that is 1.

    Parameters
    ----------
    function : callable
        Takes one item. It must not change what another call reads.
    items : iterable
        What to call it for.

    Raises
    ------
    Exception
        What the first call that failed raised; calls that have not begun are left out then.
    """
    items = list(items)
    count = min(workers(), len(items))
    if count <= 1:
        return [function(item) for item in items]
    with ThreadPoolExecutor(count, thread_name_prefix="strip") as pool:
        return list(pool.map(function, items))


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
    at_once = 4 * workers() * part
    for start in range(0, count, at_once):
        end = min(start + at_once, count)
        in_threads(function, (slice(at, min(at + part, end)) for at in range(start, end, part)))
        progress(end / count)
