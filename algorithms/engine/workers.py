"""Workers that run the jobs of a survey: threads of this process, or other processes.

Where a worker dies, its jobs are repeated one by one.
"""

from __future__ import annotations

import collections
import contextlib
import os
import signal
import sys
import threading
import time
from concurrent.futures import (
    BrokenExecutor,
    CancelledError,
    Future,
    ThreadPoolExecutor,
    wait,
)
from functools import partial
from pathlib import Path
from typing import Any, Callable, Iterator, NamedTuple, TypeVar

from ..core.errors import BareEarthError
from ..core.imports import import_only_what_runs_need, own_this_process
from ..core.memory import give_back, share_one_heap
from ..core.temporary import remove_leftovers
from ..core.threads import Counter, SharedThreads
from ..core.words import Keywords, names_in_use, option, use_names
from .blockwise import JobProgress, as_they_end
from .jobs import Job, JobResult, Share, attempt
from .manifest import folders_of
from .memory import Resources

# Seconds that jobs have to stop by themselves when the user cancels.
_PATIENCE = 0.7
_DIED = (
    "The process that worked on it ended unexpectedly, perhaps because memory was short. Allow"
    " fewer threads, or less memory."
)
_Job = TypeVar("_Job")


def scheduler_gone() -> str:
    """Return the text of the error that the scheduler of a cluster is gone."""
    return f"The scheduler is gone. Start it again, and continue with {option('resume', True)}."


class Running(NamedTuple):
    """A running job, with the future of its `JobResult` and its progress."""

    future: Future[JobResult]
    progress: JobProgress


class Workers:
    """Base of the workers, which share threads and memory."""

    are_local = True  # on this computer
    # How many jobs can run at the same time at most.
    most: int | None = None

    def __init__(self, resources: Resources = Resources()) -> None:
        self.resources = resources
        self.at_once, self.share = 1, Resources.of(1, 0)  # of each job

    def start(self, folder: Path, least: int, blocks: int, tiles: int) -> None:
        """Prepare for jobs on numbers of blocks and tiles, with outputs in a folder; the largest
        job needs `least` bytes.
        """
        threads, memory = self.resources.thread_count, self.resources.bytes
        most = min(threads, self.most or threads)
        self.at_once = int(max(1, min(most, memory // max(least, 1), max(blocks, tiles))))
        # If there are few blocks, each can use the threads that would be idle.
        together = max(1, min(self.at_once, blocks))
        self.share = Resources.of(max(1, threads // together), memory // self.at_once)

    def results(
        self, next_job: Callable[[], _Job | None], poll: Callable[[float], None]
    ) -> Iterator[tuple[_Job, JobResult]]:
        """Yield each job with its result when it ends, until `next_job` returns None and no job is
        running; `poll` gets the weight of what running jobs have done, ten times a second.
        """
        self._running: dict[Future[JobResult], tuple[Any, Running]] = {}
        # Jobs that were running when a worker died. They are repeated one by one, to find the one
        # that kills its worker.
        self._suspects = collections.deque[Any]()
        self._repeated: Job | None = None  # the last job that was repeated

        def check() -> None:
            self.check()
            poll(sum(job.weight * run.progress.fraction for job, run in self._running.values()))

        for future in as_they_end(partial(self._fill, next_job), check):
            if future not in self._running:  # its job has become a suspect meanwhile
                continue
            job, _ = self._running[future]
            outcome = self._outcome(future)
            if outcome is not None:
                yield job, outcome

    def _fill(self, next_job: Callable[[], Any]) -> list[Future[JobResult]]:
        """Start jobs, up to the number that may run at once; return the running ones."""
        while len(self._running) < (1 if self._suspects else self.at_once):
            is_repeated = bool(self._suspects)
            job = self._suspects.popleft() if is_repeated else next_job()
            if job is None:
                break
            try:
                run = self.submit(job)
            except BrokenExecutor:  # a worker died between two jobs
                self._suspects.appendleft(job)
                self._suspect_all()
                continue
            self._running[run.future] = job, run
            self._repeated = job if is_repeated else self._repeated
        return list(self._running)

    def _suspect_all(self) -> None:
        """Repeat all running jobs one by one, since one of them may have killed its worker."""
        self._suspects.extend(job for job, _ in self._running.values())
        self._running.clear()
        self.restart()

    def _outcome(self, future: Future[JobResult]) -> JobResult | None:
        """Return the result of a job that ended; None if it is to be repeated."""
        job, _ = self._running[future]
        try:
            outcome = future.result()
        except BrokenExecutor:
            # The first time something else may have killed the worker, even if the job ran alone.
            is_guilty = job is self._repeated and len(self._running) == 1
            self._suspect_all()
            if not is_guilty:
                return None
            self._suspects.pop()
            return JobResult(None, failure=_DIED)
        except CancelledError as error:
            raise BareEarthError(scheduler_gone()) from error
        except Exception as error:  # the cluster gave up the job
            failure = f"It could not be done: {error or type(error).__name__}."
            outcome = JobResult(None, failure=failure)
        del self._running[future]
        return outcome

    def submit(self, job: Job) -> Running:
        """Start a job."""
        raise NotImplementedError

    def check(self) -> None:
        """Raise an error if there are no workers for the running jobs any more."""

    def restart(self) -> None:
        """Prepare for jobs again after a worker died."""

    def stop(self) -> None:
        """Stop all jobs, which remove their unfinished files."""


class Threads(Workers):
    """Threads of this process."""

    def start(self, folder: Path, least: int, blocks: int, tiles: int) -> None:
        super().start(folder, least, blocks, tiles)
        self._stop = threading.Event()
        self._futures: list[Future[JobResult]] = []
        self._pool = ThreadPoolExecutor(self.at_once, thread_name_prefix="tile")
        self._threads = SharedThreads(self.resources.thread_count)

    def submit(self, job: Job) -> Running:
        progress = JobProgress(self._stop)
        share = Share(self.share, self._threads, is_alone=self.at_once == 1)
        future = self._pool.submit(attempt, job, share, progress)
        self._futures = [running for running in self._futures if not running.done()] + [future]
        return Running(future, progress)

    def stop(self) -> None:
        """Stop all jobs; running ones stop when they next report progress."""
        self._stop.set()
        self._pool.shutdown(wait=False, cancel_futures=True)
        wait(self._futures, _PATIENCE)


class Processes(Workers):
    """Processes of this computer, started by "spawn", since a fork of threads may hang."""

    # Windows cannot wait for more.
    most = 61 if sys.platform == "win32" else None

    def start(self, folder: Path, least: int, blocks: int, tiles: int) -> None:
        import multiprocessing

        super().start(folder, least, blocks, tiles)
        self._folder = folder
        self._context = multiprocessing.get_context("spawn")
        self._stop = self._context.Event()
        self._known: dict[int, Any] = {}
        self._open()

    def _open(self) -> None:
        from concurrent.futures import ProcessPoolExecutor

        free = self._context.Value("i", self.resources.thread_count)
        begin: Any = _begin
        values = self._stop, free, self.share.thread_count, names_in_use()
        self._pool = ProcessPoolExecutor(self.at_once, self._context, begin, values)

    def submit(self, job: Job) -> Running:
        future = self._pool.submit(_in_process, job, self.share)
        self._known.update(self._pool._processes or {})
        return Running(future, JobProgress(threading.Event()))

    def restart(self) -> None:
        self._close()
        self._open()

    def stop(self) -> None:
        """Stop the processes, also in the middle of a job."""
        self._stop.set()
        self._close()

    def _close(self) -> None:
        with contextlib.suppress(RuntimeError):  # broken pools
            self._pool.shutdown(wait=False, cancel_futures=True)
        end = time.monotonic() + _PATIENCE
        for process in self._known.values():
            process.join(max(0.0, end - time.monotonic()))
            if process.is_alive():
                process.terminate()
                process.join(_PATIENCE)
        for folder in folders_of(self._folder):
            remove_leftovers(folder, self._known)
        self._known = {}


class Local(Workers):
    """Processes of this computer, or threads of this process if there is only one block."""

    # The job of a single block uses all threads, so the time to start processes would be lost.

    def start(self, folder: Path, least: int, blocks: int, tiles: int) -> None:
        self._workers: Workers = (Processes if blocks > 1 else Threads)(self.resources)
        self._workers.start(folder, least, blocks, tiles)
        self.at_once, self.share = self._workers.at_once, self._workers.share

    def submit(self, job: Job) -> Running:
        return self._workers.submit(job)

    def restart(self) -> None:
        self._workers.restart()

    def stop(self) -> None:
        self._workers.stop()


class _OfProcess(NamedTuple):
    """What all jobs of a process share."""

    stop: threading.Event
    threads: SharedThreads


_common: _OfProcess | None = None


def _begin(stop: threading.Event, free: Counter, threads: int, names: Keywords) -> None:
    global _common
    _common = _OfProcess(stop, SharedThreads(free))
    share_one_heap()
    own_this_process()
    import_only_what_runs_need()
    use_names(names)
    # Ctrl-C reaches all processes of a terminal. Only the first one reacts, and stops the others.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    # The threads that decompress.
    os.environ["RAYON_NUM_THREADS"] = str(threads)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """End this process when its parent is killed."""
    import multiprocessing
    from multiprocessing.connection import wait as wait_for

    parent = multiprocessing.parent_process()
    if parent is not None:
        wait_for([parent.sentinel])
        os._exit(1)


def _in_process(job: Job, resources: Resources) -> JobResult:
    common = _common or _OfProcess(threading.Event(), SharedThreads(1))
    share = Share(resources, common.threads, is_alone=True)
    result = attempt(job, share, JobProgress(common.stop))
    give_back()
    return result
