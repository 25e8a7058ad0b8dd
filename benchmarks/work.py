"""Runs what can be measured side by side in two processes."""

from __future__ import annotations

import multiprocessing
import os
from concurrent.futures import ProcessPoolExecutor
from typing import Callable, Iterable, Iterator, TypeVar

Job, Result = TypeVar("Job"), TypeVar("Result")
PROCESSES = int(os.environ.get("BARE_EARTH_PROCESSES") or min(2, os.cpu_count() or 1))


def side_by_side(function: Callable[[Job], Result], jobs: Iterable[Job]) -> Iterator[Result]:
    """Yield the result of each job, in the order of the jobs.

    Parameters
    ----------
    function : callable
        A function of a module, that the other process can import.
    jobs : iterable
        Values that can be pickled.
    """
    todo = list(jobs)
    if PROCESSES < 2 or len(todo) < 2:
        yield from map(function, todo)
        return
    # New processes, as those that are forked may hold a lock of a thread that they do not have.
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(PROCESSES, mp_context=context) as pool:
        yield from pool.map(function, todo)
