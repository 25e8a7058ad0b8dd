"""Runs the jobs of a survey, each as soon as the files that it needs are there."""

from __future__ import annotations

import collections
import re
from concurrent.futures import BrokenExecutor, CancelledError, Future
from dataclasses import replace
from pathlib import Path
from typing import Collection, Sequence, Union

from ..core.errors import BareEarthError
from ..core.progress import Progress
from ..core.temporary import remove
from ..core.words import first_of
from ..las.lasfile import LasFile
from .blockwise import ended
from .jobs import BlockJob, JobResult, TileJob
from .memory import GIGABYTE
from .summary import JobCost, TileSummary
from .workers import Running, Workers, scheduler_gone

AnyJob = Union[BlockJob, TileJob]
# The time of a point in a block, in proportion to that of reading and writing it.
_BLOCK_WEIGHT = 2.0
_DIED = (
    "The process that worked on it ended unexpectedly, perhaps because memory was short. Allow"
    " fewer threads, or less memory."
)


class JobQueue:
    """The jobs of a survey and their results; files not in `kept` are removed when last used."""

    def __init__(
        self,
        blocks: Sequence[BlockJob],
        tiles: Sequence[TileJob],
        workers: Workers,
        progress: Progress,
        kept: Collection[Path] = (),
    ) -> None:
        self.done: list[TileSummary] = []  # of the files that were written
        self.empty: list[LasFile] = []  # files without points to write
        self.failures: dict[Path, str] = {}  # why the other files were not written, by input
        self.lost: list[str] = []  # why blocks failed
        self.costs: list[JobCost] = []  # of the finished jobs
        self._workers, self._progress = workers, progress
        # Jobs that were running when a worker died. They are repeated one by one, to find the one
        # that kills its worker.
        self._suspects: collections.deque[AnyJob] = collections.deque()
        self._repeated: AnyJob | None = None  # the last job that was repeated
        # Jobs that can start: the blocks of the first step, and all others.
        self._blocks: collections.deque[AnyJob] = collections.deque()
        self._ready: collections.deque[AnyJob] = collections.deque()
        # Results of blocks that do not exist yet.
        self._missing = {file for job in blocks for file in job.output.files.values()}
        # Results that were made without those of failed blocks near them.
        self._partial: set[Path] = set()
        # How many jobs use a result.
        self._uses = collections.Counter(kept)
        # The jobs that wait for a result, and for how many results a job waits.
        self._waiting: dict[Path, list[AnyJob]] = collections.defaultdict(list)
        self._lacks: dict[AnyJob, int] = {}
        jobs: list[AnyJob] = [*blocks, *tiles]
        for job in jobs:
            self._add(job, self._blocks if isinstance(job, BlockJob) else self._ready)
        self._running: dict[Running, AnyJob] = {}
        # The texts of messages, each with the name of its file ("" for blocks), by kind, text
        # without numbers, and whether the message is about a file.
        self._messages: dict[tuple[str, str, bool], dict[str, str]] = {}
        self._total = max(sum(map(_weight, jobs)), 1e-9)
        self._finished = 0.0

    def _add(self, job: AnyJob, ready: collections.deque[AnyJob]) -> None:
        """Queue a job, or let it wait for the results that it needs."""
        self._uses.update(job.needs)
        lacking = [file for file in job.needs if file in self._missing]
        for file in lacking:
            self._waiting[file].append(job)
        if lacking:
            self._lacks[job] = len(lacking)
        else:
            ready.append(job)

    def work(self) -> None:
        """Run all jobs, and stop the workers; raise an error if the workers are gone."""
        try:
            for future in ended(self._start, self._look):
                running = next((run for run in self._running if run.future is future), None)
                if running is not None:  # otherwise the job has become a suspect meanwhile
                    self._end(running)
            self._tell()
            self._tell_of_memory()
        finally:
            self._workers.stop()

    def _look(self) -> None:
        """Check the workers, and report progress."""
        self._workers.check()
        running = sum(run.progress.fraction * _weight(job) for run, job in self._running.items())
        self._progress((self._finished + running) / self._total)

    def _start(self) -> list[Future[JobResult]]:
        """Start as many jobs as may run at once; return those that are running."""
        while len(self._running) < (1 if self._suspects else self._workers.at_once):
            queues = (self._suspects, self._ready, self._blocks)
            queue = next((jobs for jobs in queues if jobs), None)
            if queue is None:
                break
            try:
                self._running[self._workers.submit(queue[0])] = queue[0]
                job = queue.popleft()
                self._repeated = job if queue is self._suspects else self._repeated
            except BrokenExecutor:  # a worker died between two jobs
                self._suspect_all()
        return [run.future for run in self._running]

    def _suspect_all(self) -> None:
        """Repeat all running jobs one by one, since one of them may have killed its worker."""
        self._suspects.extend(self._running.values())
        self._running.clear()
        self._workers.restart()

    def _end(self, running: Running) -> None:
        job = self._running[running]
        try:
            outcome = running.future.result()
        except BrokenExecutor:
            # The first time something else may have killed the worker, even if the job ran alone.
            is_guilty = job is self._repeated and len(self._running) == 1
            self._suspect_all()
            if not is_guilty:
                return
            self._suspects.pop()
            outcome = JobResult(None, failure=_DIED)
        except CancelledError as error:
            raise BareEarthError(scheduler_gone()) from error
        except Exception as error:
            # The cluster gave up the job.
            failure = f"It could not be done: {error or type(error).__name__}."
            outcome = JobResult(None, failure=failure)
        self._running.pop(running, None)
        self._finished += _weight(job)
        if outcome.cost is not None:
            self.costs.append(outcome.cost)
        self._keep_messages(job, outcome)
        if isinstance(job, TileJob):
            self._end_tile(job, outcome)
        else:
            self._end_blocks(job, outcome)

    def _end_blocks(self, job: BlockJob, outcome: JobResult) -> None:
        if outcome.failure is not None and len(job.output.files) > 1:
            self._split(job)
            return
        if outcome.failure is not None:
            self.lost.append(outcome.failure)
        files = job.output.files.values()
        self._missing.difference_update(files)
        for user in [user for file in files for user in self._waiting.pop(file, ())]:
            if user not in self._lacks:  # the job was given up
                continue
            self._lacks[user] -= 1
            if outcome.failure is not None:
                if isinstance(user, TileJob):
                    del self._lacks[user]
                    self._finished += _weight(user)
                    self._end_tile(user, outcome)
                    continue
                self._partial.update(user.output.files.values())
            if not self._lacks[user]:
                del self._lacks[user]
                self._ready.append(self._marked(user))
        self._release(job)

    def _marked(self, job: AnyJob) -> AnyJob:
        """Return a job; if its results will be partial, mark it so that a later run repeats it."""
        if self._partial.isdisjoint(job.needs):
            return job
        if isinstance(job, TileJob):
            return replace(job, fingerprint={})
        self._partial.update(job.output.files.values())
        return job

    def _split(self, job: BlockJob) -> None:
        """Try the blocks of a job one by one."""
        for part in job.split():
            self._total += _weight(part)
            self._add(part, self._blocks)
        self._release(job)

    def _end_tile(self, job: TileJob, outcome: JobResult) -> None:
        if outcome.failure is not None:
            self.failures[job.tile.path] = outcome.failure
        elif outcome.result is None:
            self.empty.append(job.tile)
        else:
            self.done.append(outcome.result)
            self._progress.info(outcome.result.text)
        self._release(job)

    def _release(self, job: AnyJob) -> None:
        """Remove the results of blocks that no other job needs."""
        for file in job.needs:
            self._uses[file] -= 1
            if not self._uses[file] and file not in self._missing:
                remove(file)

    def _keep_messages(self, job: AnyJob, outcome: JobResult) -> None:
        """Collect the messages of a job, of jobs on files only the warnings."""
        name = job.tile.path.name if isinstance(job, TileJob) else ""
        for kind, text in outcome.messages:
            if not name or kind == "warning":
                alike = self._messages.setdefault((kind, _without_numbers(text), bool(name)), {})
                alike.setdefault(f"{name}: {text}" if name else text, name)

    def _tell(self) -> None:
        """Report each message once, with the files whose messages differ only in numbers."""
        for (kind, _, of_files), alike in self._messages.items():
            first, *more_texts = alike
            more = ""
            if more_texts and of_files:
                names = first_of(sorted(alike[text] for text in more_texts))
                more = f" The same, with other numbers: {names}."
            elif more_texts:
                parts = (
                    "another part" if len(more_texts) == 1 else f"{len(more_texts):,} other parts"
                )
                more = f" The same, with other numbers, in {parts} of the survey."
            getattr(self._progress, kind)(first + more)

    def _tell_of_memory(self) -> None:
        """Report how long the jobs took, and the one that took most memory."""
        for cost in self.costs:
            stage = "blocks" if cost.job == "blocks" else "files"
            self._progress.took(stage, cost.seconds)
        known = [cost for cost in self.costs if cost.memory is not None]
        if known:
            most = max(known, key=lambda cost: cost.memory or 0)
            self._progress.info(
                f"{len(self.costs):,} jobs are done. The largest took"
                f" {(most.memory or 0) / GIGABYTE:.2f} GB of memory"
                f" ({most.planned / GIGABYTE:.2f} GB planned)."
            )


def _without_numbers(text: str) -> str:
    """Return a message without names of files and numbers."""
    return re.sub(r"\S*\d\S*|\S+\.la[sz]\b\S*", "#", text)


def _weight(job: AnyJob) -> float:
    """Return the cost of a job, as a number of points to read and write."""
    return float(job.tile.count) if isinstance(job, TileJob) else _BLOCK_WEIGHT * job.count
