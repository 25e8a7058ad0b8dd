"""Runs jobs in threads, and reports their progress and messages in the calling thread."""

from __future__ import annotations

import contextlib
import itertools
import threading
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from typing import Callable, Collection, Iterator, Sequence, TypeVar

from ..core.errors import Cancelled
from ..core.progress import Notes, Progress
from ..core.threads import SharedThreads, shared_threads

# Seconds between two checks of running jobs.
_POLL = 0.1
_Result = TypeVar("_Result")


def run_jobs(
    jobs: Sequence[Callable[[Progress], _Result]],
    weights: Sequence[float],
    at_once: int,
    threads: int,
    progress: Progress,
) -> Iterator[tuple[int, _Result]]:
    """Run jobs in threads, and yield the number and the result of each job when it ends; raise the
    error of a job, or `Cancelled`, at once, and let the other jobs end soon.
    """
    # Only the calling thread calls `progress`, ten times a second. If the calling thread is one of
    # `SharedThreads`, the jobs share these, otherwise `threads`. A job has at least one thread.
    # `weights` are the shares of the jobs in the progress. After an error the other jobs end when
    # they next report progress.
    outer = shared_threads()
    shared, at_once = outer or SharedThreads(threads), max(1, at_once)
    stop, done, total = threading.Event(), 0.0, max(sum(weights), 1e-9)
    reports: dict[int, JobProgress] = {}
    running: dict[Future[_Result], int] = {}
    waiting = iter(range(len(jobs)))
    pool = ThreadPoolExecutor(at_once, thread_name_prefix="block")

    def run(number: int) -> _Result:
        with shared.used():
            return jobs[number](reports[number])

    def start() -> list[Future[_Result]]:
        # Not all jobs at once, since results that were not fetched yet would fill the memory.
        for number in itertools.islice(waiting, at_once - len(running)):
            reports[number] = JobProgress(stop)
            running[pool.submit(run, number)] = number
        return list(running)

    def poll() -> None:
        for report in reports.values():
            report.pass_on(progress)
        in_part = sum(report.fraction * weights[number] for number, report in reports.items())
        progress((done + in_part) / total)

    with contextlib.nullcontext() if outer is None else outer.lent():
        try:
            for future in as_they_end(start, poll):
                number = running.pop(future)
                result = future.result()
                del reports[number]
                done += weights[number]
                yield number, result
        finally:
            stop.set()
            pool.shutdown(wait=False, cancel_futures=True)


def as_they_end(
    start: Callable[[], Collection[Future[_Result]]], poll: Callable[[], None]
) -> Iterator[Future[_Result]]:
    """Yield jobs when they end, until none is running; `start` starts further jobs and returns all
    that are running, and `poll` is called ten times a second and may end the loop by an error.
    """
    # Threads, processes and the workers of a cluster all have such futures. `poll` is also called
    # when a job has ended, before the job is yielded.
    while running := start():
        done, _ = wait(running, _POLL, FIRST_COMPLETED)
        poll()
        yield from (future for future in running if future in done)


class JobProgress(Notes):
    """The progress of a job, for the calling thread; ends the job when `stop` is set."""

    def __init__(self, stop: threading.Event) -> None:
        super().__init__()
        self.fraction, self._stop = 0.0, stop

    def report(self, fraction: float) -> None:
        if self._stop.is_set():
            raise Cancelled
        self.fraction = fraction

    def pass_on(self, progress: Progress) -> None:
        """Pass on the messages since the last call."""
        while self.messages:
            kind, text = self.messages.pop(0)
            getattr(progress, kind)(text)
