"""The jobs that workers are running, which are repeated where a worker died."""

from __future__ import annotations

import collections
from concurrent.futures import BrokenExecutor, CancelledError, Future
from typing import Callable, Generic, Iterator, TypeVar

from ..core.errors import BareEarthError
from .blockwise import as_they_end
from .jobs import Job, JobResult
from .workers import Running, Workers, scheduler_gone

_Job = TypeVar("_Job", bound=Job)

_DIED = (
    "The process that worked on it ended unexpectedly, perhaps because memory was short. Allow"
    " fewer threads, or less memory."
)


class RunningJobs(Generic[_Job]):
    """The jobs of `next_job` that run, as many at once as the workers allow."""

    def __init__(self, workers: Workers, next_job: Callable[[], _Job | None]) -> None:
        self._workers, self._next_job = workers, next_job
        self._running: dict[Future[JobResult], tuple[_Job, Running]] = {}
        # Jobs that were running when a worker died. They are repeated one by one, to find the one
        # that kills its worker.
        self._suspects = collections.deque[_Job]()
        self._repeated: _Job | None = None  # the last job that was repeated

    def results(self, poll: Callable[[float], None]) -> Iterator[tuple[_Job, JobResult]]:
        """Yield each job with its result when it ends, until `next_job` returns None and no job is
        running; `poll` gets the weight of what running jobs have done, ten times a second.
        """

        def check() -> None:
            self._workers.check()
            poll(sum(job.weight * run.progress.fraction for job, run in self._running.values()))

        for future in as_they_end(self._start, check):
            if future not in self._running:  # its job has become a suspect meanwhile
                continue
            job, _ = self._running[future]
            outcome = self._outcome(future)
            if outcome is not None:
                yield job, outcome

    def _start(self) -> list[Future[JobResult]]:
        """Start jobs, up to the number that may run at once; return the running ones."""
        while len(self._running) < (1 if self._suspects else self._workers.at_once):
            is_repeated = bool(self._suspects)
            job = self._suspects.popleft() if is_repeated else self._next_job()
            if job is None:
                break
            try:
                run = self._workers.submit(job)
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
        self._workers.restart()

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
