"""Runs functions in threads, whose progress and messages come from the calling one; the loop of all
jobs.
"""

from __future__ import annotations

import contextlib
import itertools
import threading
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from typing import Any, Callable, Collection, Iterator, Sequence

from ..core.errors import Cancelled
from ..core.progress import Notes, Progress
from ..core.threads import SharedThreads, shared_threads

# Seconds between two looks at running jobs.
_POLL = 0.1


def run_jobs(
    jobs: Sequence[Callable[[Progress], Any]],
    weights: Sequence[float],
    at_once: int,
    threads: int,
    progress: Progress,
) -> Iterator[tuple[int, Any]]:
    """Run jobs in threads, and yield number and result of each as it ends; raise its error, or
    `Cancelled` at once, while the jobs end when they next call their progress.
    """
    # The calling thread calls `progress` ten times a second, and no other thread calls it. If it is
    # one of `SharedThreads`, the jobs use these, otherwise `threads` in all, at least one each.
    # `weights` are the shares of the jobs in the whole.
    outer = shared_threads()
    shared, at_once = outer or SharedThreads(threads), max(1, at_once)
    stop, done, total = threading.Event(), 0.0, max(sum(weights), 1e-9)
    talks: dict[int, JobProgress] = {}
    running: dict[Future[Any], int] = {}
    waiting = iter(range(len(jobs)))
    pool = ThreadPoolExecutor(at_once, thread_name_prefix="block")

    def run(number: int) -> Any:
        with shared.used():
            return jobs[number](talks[number])

    def start() -> list[Future[Any]]:
        # Not all at once, since results that were not fetched yet would fill the memory.
        for number in itertools.islice(waiting, at_once - len(running)):
            talks[number] = JobProgress(stop)
            running[pool.submit(run, number)] = number
        return list(running)

    def look() -> None:
        for talk in talks.values():
            talk.tell(progress)
        under_way = sum(talk.fraction * weights[number] for number, talk in talks.items())
        progress((done + under_way) / total)

    with contextlib.nullcontext() if outer is None else outer.lent():
        try:
            for future in ended(start, look):
                number = running.pop(future)
                result = future.result()
                del talks[number]
                done += weights[number]
                yield number, result
        finally:
            stop.set()
            pool.shutdown(wait=False, cancel_futures=True)


def ended(
    start: Callable[[], Collection[Future[Any]]], look: Callable[[], None]
) -> Iterator[Future[Any]]:
    """Yield jobs as they end until none runs; `start` begins what may run and returns what runs,
    `look` is called ten times a second and ends the loop if it raises.
    """
    # Threads, processes and the workers of a cluster all have such futures. `look` is called in the
    # calling thread, also when a job ends, before it is yielded.
    while running := start():
        done, _ = wait(running, _POLL, FIRST_COMPLETED)
        look()
        yield from (future for future in running if future in done)


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
