"""Jobs in threads, watched by the thread that the user's progress belongs to."""

from __future__ import annotations

import threading
from concurrent.futures import FIRST_COMPLETED, Future, ThreadPoolExecutor, wait
from typing import Any, Callable, Iterator, Sequence

from ..core.errors import Cancelled
from ..core.progress import Notes, Progress
from ..core.threads import may_use

_POLL = 0.1

Job = Callable[[Progress], Any]


def run_jobs(
    jobs: Sequence[Job],
    weights: Sequence[float],
    at_once: int,
    workers: int,
    progress: Progress,
) -> Iterator[tuple[int, Any]]:
    """Run jobs in threads, and yield the result of each when it is there.

    The calling thread asks `progress` ten times a second: when the user cancels, it leaves at once
    and waits for nobody. The jobs then end at their next call of the progress that they got.

    Parameters
    ----------
    jobs : sequence of callable
        Each takes a `Progress` and computes; messages to it are relayed in the calling thread.
    weights : sequence of float
        The share of each job in the whole.
    at_once : int
        How many run at the same time.
    workers : int
        How many threads each may use itself. The last ones share those of the others that ended.
    progress : Progress
        Used in the calling thread only.

    Yields
    ------
    tuple of (int, object)
        Number of a job, and what it returned; in the order in which they end.

    Raises
    ------
    Exception
        What a job raised.
    Cancelled
        If the user asked to stop.
    """
    stop, ended, total = threading.Event(), 0.0, max(sum(weights), 1e-9)
    talks: dict[int, JobProgress] = {}
    left = len(jobs)

    def share() -> int:
        return at_once * workers // max(1, min(left, at_once))

    def run(number: int) -> Any:
        with may_use(share):
            return jobs[number](talks[number])

    pool = ThreadPoolExecutor(max(1, at_once), thread_name_prefix="block")
    try:
        waiting = iter(range(len(jobs)))
        running: dict[Future[Any], int] = {}
        # Not all at once: results that nobody has fetched yet would fill the memory.
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
                left -= 1
                yield number, result
    finally:
        stop.set()
        pool.shutdown(wait=False, cancel_futures=True)


class JobProgress(Notes):
    """How far a job is, for the thread that looks on; ends the job once `stop` is set."""

    def __init__(self, stop: threading.Event) -> None:
        super().__init__()
        self.fraction, self._stop = 0.0, stop

    def report(self, fraction: float) -> None:
        """Note how far the job is."""
        if self._stop.is_set():
            raise Cancelled
        self.fraction = fraction

    def tell(self, progress: Progress) -> None:
        """Pass on the messages since the last time."""
        while self.messages:
            kind, text = self.messages.pop(0)
            getattr(progress, kind)(text)
