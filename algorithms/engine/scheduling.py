"""Runs jobs in threads, while the calling thread reports their progress."""

from __future__ import annotations

import contextlib
import threading
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from typing import Any, Callable, Iterator, Sequence

from ..core.errors import Cancelled
from ..core.progress import Notes, Progress
from ..core.threads import SharedThreads, shared_threads

_POLL = 0.1

Job = Callable[[Progress], Any]


def run_jobs(
    jobs: Sequence[Job],
    weights: Sequence[float],
    at_once: int,
    threads: int,
    progress: Progress,
) -> Iterator[tuple[int, Any]]:
    """Run jobs in threads, and yield the result of each when it is finished.

    The calling thread calls `progress` ten times a second. When the user cancels, it returns at
    once. The jobs then end at their next call of their own progress.

    Parameters
    ----------
    jobs : sequence of callable
        Each takes a `Progress`, whose messages are passed on in the calling thread.
    weights : sequence of float
        The share of each job in the whole.
    at_once : int
        How many jobs run at the same time.
    threads : int
        How many threads all jobs together may use, at least one each. If the calling thread is one
        of `SharedThreads`, the jobs use these instead.
    progress : Progress
        Used in the calling thread only.

    Yields
    ------
    tuple of (int, object)
        Number and return value of each job, in the order in which they end.

    Raises
    ------
    Exception
        The error of a job.
    Cancelled
        If the user asked to stop.
    """
    outer = shared_threads()
    with contextlib.nullcontext() if outer is None else outer.lent():
        yield from _run(jobs, weights, at_once, outer or SharedThreads(threads), progress)


def _run(
    jobs: Sequence[Job],
    weights: Sequence[float],
    at_once: int,
    shared: SharedThreads,
    progress: Progress,
) -> Iterator[tuple[int, Any]]:
    stop, ended, total = threading.Event(), 0.0, max(sum(weights), 1e-9)
    talks: dict[int, JobProgress] = {}

    def run(number: int) -> Any:
        with shared.used():
            return jobs[number](talks[number])

    pool = ThreadPoolExecutor(max(1, at_once), thread_name_prefix="block")
    try:
        waiting = iter(range(len(jobs)))
        running: dict[Future[Any], int] = {}
        # Not all at once, since results that were not fetched yet would fill the memory.
        while True:
            for number in waiting:
                talks[number] = JobProgress(stop)
                running[pool.submit(run, number)] = number
                if len(running) >= max(1, at_once):
                    break
            if not running:
                return
            done, _ = wait(running, _POLL, FIRST_COMPLETED)
            for talk in talks.values():
                talk.tell(progress)
            under_way = sum(talk.fraction * weights[number] for number, talk in talks.items())
            progress((ended + under_way) / total)
            for future in sorted(done, key=running.__getitem__):
                number = running.pop(future)
                result = future.result()
                del talks[number]
                ended += weights[number]
                yield number, result
    finally:
        stop.set()
        pool.shutdown(wait=False, cancel_futures=True)


class JobProgress(Notes):
    """The progress of a job, for the calling thread; ends the job when `stop` is set."""

    def __init__(self, stop: threading.Event) -> None:
        super().__init__()
        self.fraction, self._stop = 0.0, stop

    def report(self, fraction: float) -> None:
        """Store the progress of the job."""
        if self._stop.is_set():
            raise Cancelled
        self.fraction = fraction

    def tell(self, progress: Progress) -> None:
        """Pass on the messages since the last call."""
        while self.messages:
            kind, text = self.messages.pop(0)
            getattr(progress, kind)(text)
