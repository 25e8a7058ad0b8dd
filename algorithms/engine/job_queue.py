"""Runs the jobs of a survey, each as soon as the files that it needs are there."""

from __future__ import annotations

import collections
from dataclasses import replace
from graphlib import TopologicalSorter
from pathlib import Path
from typing import Collection, Iterator, Sequence, Union

from ..core.progress import Progress
from ..core.temporary import remove
from ..las.lasfile import LasFile
from .job_messages import JobMessages, report_costs
from .jobs import BlockJob, JobResult, TileJob
from .summary import JobCost, TileSummary
from .workers import Workers

AnyJob = Union[BlockJob, TileJob]


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
        self.lost: dict[Path, str] = {}  # why results of blocks could not be made
        self.costs: list[JobCost] = []  # of the finished jobs
        self._workers, self._progress, self._messages = workers, progress, JobMessages()
        jobs: list[AnyJob] = [*blocks, *tiles]
        makers = {file: job for job in blocks for file in job.output.files.values()}
        self._jobs = TopologicalSorter(
            {job: [makers[file] for file in job.needs if file in makers] for job in jobs}
        )
        self._jobs.prepare()
        # Jobs that can start; jobs that use results of others go first.
        self._first = collections.deque(self._jobs.get_ready())
        self._next = collections.deque[AnyJob]()
        # The job of `jobs` that a job is a part or a copy of, and how many of its parts are left.
        self._whole: dict[AnyJob, AnyJob] = {}
        self._left = collections.Counter(jobs)
        # Results that lack the results of failed blocks nearby.
        self._partial: set[Path] = set()
        # How many jobs use a result.
        self._uses = collections.Counter([*kept, *(file for job in jobs for file in job.needs)])
        self._total = max(sum(job.weight for job in jobs), 1e-9)
        self._finished = 0.0

    def work(self) -> None:
        """Run all jobs, and stop the workers; raise an error if the workers are gone."""
        try:
            ended: Iterator[tuple[AnyJob, JobResult]]
            ended = self._workers.results(self._next_job, self._report)
            for job, outcome in ended:
                self._end(job, outcome)
            self._messages.report(self._progress)
            report_costs(self.costs, self._progress)
        finally:
            self._workers.stop()

    def _next_job(self) -> AnyJob | None:
        queue = self._next or self._first
        return queue.popleft() if queue else None

    def _report(self, in_part: float) -> None:
        """Report progress, given the weight of what running jobs have done."""
        self._progress((self._finished + in_part) / self._total)

    def _end(self, job: AnyJob, outcome: JobResult) -> None:
        self._finished += job.weight
        if outcome.cost is not None:
            self.costs.append(outcome.cost)
        name = job.tile.path.name if isinstance(job, TileJob) else ""
        self._messages.add(name, outcome.messages)
        if isinstance(job, TileJob):
            self._end_tile(job, outcome)
        elif outcome.failure is not None and len(job.output.files) > 1:
            self._split(job)
        elif outcome.failure is not None:
            self.lost.update(dict.fromkeys(job.output.files.values(), outcome.failure))
        self._close(job)

    def _end_tile(self, job: TileJob, outcome: JobResult) -> None:
        if outcome.failure is not None:
            self.failures[job.tile.path] = outcome.failure
        elif outcome.result is None:
            self.empty.append(job.tile)
        else:
            self.done.append(outcome.result)
            self._progress.info(outcome.result.text)

    def _split(self, job: BlockJob) -> None:
        """Try the blocks of a job one by one."""
        parts, whole = job.split(), self._whole.get(job, job)
        self._whole.update(dict.fromkeys(parts, whole))
        self._left[whole] += len(parts)
        self._uses.update(file for part in parts for file in part.needs)
        self._total += sum(part.weight for part in parts)
        self._first.extend(parts)

    def _close(self, job: AnyJob) -> None:
        """Remove the results that no other job needs, and queue the jobs that can start now."""
        for file in job.needs:
            self._uses[file] -= 1
            if not self._uses[file]:
                remove(file)
        whole = self._whole.pop(job, job)
        self._left[whole] -= 1
        if not self._left[whole]:
            self._jobs.done(whole)
            for ready in self._jobs.get_ready():
                self._queue(ready)

    def _queue(self, job: AnyJob) -> None:
        """Queue a job that can start, or end one that writes a file with a failed block."""
        failure = next((self.lost[file] for file in job.needs if file in self.lost), None)
        is_partial = failure is not None or not self._partial.isdisjoint(job.needs)
        if isinstance(job, BlockJob):
            if is_partial:
                self._partial.update(job.output.files.values())
            self._next.append(job)
        elif failure is not None:
            self._end(job, JobResult(None, failure=failure))
        elif is_partial:  # a later run is to repeat it
            marked = replace(job, fingerprint={})
            self._whole[marked] = job
            self._next.append(marked)
        else:
            self._next.append(job)
