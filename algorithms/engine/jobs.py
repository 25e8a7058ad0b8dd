"""The jobs of a survey of many files: values that can be pickled, and pass results on in files.

They run in threads, in processes, or on other computers that see the same folders.
"""

from __future__ import annotations

import contextlib
import time
from collections import defaultdict
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, Iterator, Mapping, NamedTuple

import numpy as np

from ..core.errors import BareEarthError, Cancelled
from ..core.memory import PeakMemory
from ..core.progress import Notes, Progress
from ..core.threads import SharedThreads
from ..las.cloud import PointCloud
from ..las.lasfile import LasFile
from ..las.opening import open_las
from ..survey.window import may_touch, parts_in_window, read_window
from .block_grid import BlockIndex, memory_of
from .disk_store import DiskStore
from .file_points import FilePoints, TileResult, copies_all_else, memory_of_file
from .manifest import Fingerprint, write_record
from .memory import Resources
from .memory_store import MemoryStore
from .step import Sink
from .store import Store
from .summary import JobCost, TileSummary
from .unpacking import Unpacking
from .values import BlockFiles, BlockValues, applied, write_arrays
from .visits import Work, values_of

# The time of a point in a block, in proportion to that of reading and writing it.
_BLOCK_WEIGHT = 2.0


class JobResult(NamedTuple):
    """The return value of a job and its messages, as kind and text, or why it failed."""

    result: TileSummary | None  # of a job that wrote a file
    messages: tuple[tuple[str, str], ...] = ()
    failure: str | None = None
    cost: JobCost | None = None  # None if it failed


class Share(NamedTuple):
    """What a job may use: its own threads and memory, and all threads of the run that are free."""

    resources: Resources
    threads: SharedThreads
    is_alone: bool = False  # no other job runs in the same process


@dataclass(frozen=True, eq=False)
class Job:
    """Base of the jobs."""

    before: tuple[BlockFiles, ...]  # the results of earlier steps for its points
    unpacking: Unpacking | None  # where inputs wait uncompressed

    @property
    def needs(self) -> list[Path]:
        """The files that must exist before the job starts."""
        return [file for results in self.before for file in results.files.values()]

    @property
    def weight(self) -> float:
        raise NotImplementedError

    @property
    def title(self) -> str:
        """The name of the job in reports."""
        return "blocks"

    def planned(self, resources: Resources) -> int:
        """Estimate the largest number of bytes of memory that the job takes."""
        raise NotImplementedError

    def run(self, share: Share, progress: Progress) -> TileSummary | None:
        """Do the job; return the summary of a file that it wrote."""
        raise NotImplementedError


@dataclass(frozen=True, eq=False)
class BlockJob(Job):
    """A job that works on the points of some blocks."""

    output: BlockFiles  # for the results
    sources: tuple[Path, ...]  # files that may have points for the blocks
    count: float  # of points in the blocks, estimated
    # Sources that already have the results of the earlier steps.
    finished: frozenset[Path] = frozenset()

    @property
    def weight(self) -> float:
        return _BLOCK_WEIGHT * self.count

    def split(self) -> list[BlockJob]:
        count, jobs = self.count / len(self.output.files), []
        for place, file in self.output.files.items():
            window = self.output.grid.window([place])
            before = tuple(results.within(window) for results in self.before)
            output = replace(self.output, files={place: file})
            jobs.append(replace(self, output=output, count=count, before=before))
        return jobs

    def planned(self, resources: Resources) -> int:
        return min(memory_of(self.output.grid, self.count), resources.bytes)

    def _clouds(self, store: Store, progress: Progress) -> Iterator[PointCloud]:
        """Yield the points of each file that the blocks need, with the results of earlier steps, in
        parts if the points will wait on disk.
        """
        grid = self.output.grid
        window = grid.window(self.output.files)
        for source, part in zip(self.sources, progress.shares(*[1.0] * len(self.sources))):
            try:
                las = open_las(source, grid.stated)
                if not may_touch(las, window):
                    continue
                if self.unpacking is not None:
                    las = self.unpacking.of(las, part.part(0.0, 0.7).quiet())
                change = None
                if self.before and source not in self.finished:
                    values = [BlockValues(files, las, are_all=False) for files in self.before]
                    change = partial(applied, values)
                # Stored parts cannot be removed again. So only a file that is known to be sound,
                # since it was decompressed before, is stored in parts.
                is_sound = las.unpacked is not None or not las.is_compressed
                if isinstance(store, DiskStore) and is_sound:
                    clouds = parts_in_window(las, window, part.quiet(), change)
                else:
                    whole = read_window(las, window, part.quiet(), trust_header=True, change=change)
                    clouds = iter([whole])
            except BareEarthError as error:
                progress.warning(
                    f"{source.name} is left out: the results beside it are made without its"
                    f" points. {error}"
                )
                continue
            yield from (cloud for cloud in clouds if cloud.count)

    def _store(self, share: Share) -> contextlib.AbstractContextManager[Store]:
        """Return an empty store, which is on disk if the points do not fit into memory."""
        grid, (file, *_) = self.output.grid, self.output.files.values()
        if memory_of(grid, self.count) <= share.resources.bytes:
            return contextlib.nullcontext(MemoryStore(grid.frame, grid.blocks, grid.step.kind))
        return DiskStore(file, grid.frame, grid.blocks, grid.step.kind)

    def run(self, share: Share, progress: Progress) -> None:
        """Let the step work, and write one file for each block."""
        grid, places, working = self.output.grid, [*self.output.files], progress.part(0.3, 0.95)
        with self._store(share) as store:
            clouds = self._clouds(store, progress.part(0.0, 0.3))
            work = values_of(grid, clouds, share.resources, working, places, store)
            progress(1.0)  # ends a job of a run that was cancelled, before it writes
            if isinstance(grid.step, Sink):
                self._write_arrays(work)
            else:
                self._write_values(work)

    def _write_values(self, work: Work) -> None:
        """Write the values of the points of each block by file."""
        for number, place in enumerate(self.output.files, start=1):
            of_files: dict[Path, list[np.ndarray]] = defaultdict(list)
            for part, (path, numbers) in enumerate(work.parts):
                of_files[path].append(work.values(part)[numbers == number])
            values = {path: np.concatenate(parts) for path, parts in of_files.items()}
            self.output.write(place, values, str(work.failure or ""))

    def _write_arrays(self, work: Work) -> None:
        grid = self.output.grid
        of_blocks: dict[BlockIndex, list[Mapping[str, Any]]] = defaultdict(list)
        for block, arrays in work.arrays:
            of_blocks[grid.holding(block)].append(arrays)
        for place, file in self.output.files.items():
            write_arrays(file, of_blocks[place])


@dataclass(frozen=True, eq=False)
class TileJob(Job):
    """A job that writes a file with the results of the blocks that may hold its points."""

    tile: LasFile
    target: Path
    fingerprint: Fingerprint  # what the output is made from; written after the output

    @property
    def weight(self) -> float:
        return float(self.tile.count)

    @property
    def title(self) -> str:
        return self.tile.path.name

    def planned(self, resources: Resources) -> int:
        return min(memory_of_file(self.tile), resources.bytes)

    def run(self, share: Share, progress: Progress) -> TileSummary | None:
        """Write the file; return its summary, or None if no point is to be written."""
        las, steps = self.tile, [results.grid.step for results in self.before]
        if self.unpacking is not None:
            las = self.unpacking.of(las, progress.part(0.0, 0.3))
        values = [BlockValues(results, las) for results in self.before]
        needs_records = not copies_all_else(las, self.target, steps)
        reading, resources = progress.part(0.3, 0.4).quiet(), share.resources
        with FilePoints.opened(las, self.target, resources, needs_records, reading) as points:
            result = TileResult.collected(points, values)
            result.report(progress, is_alone=False)
            if result.is_empty:
                return None
            result.write(self.target, progress.part(0.4, 1.0))
        summary = result.summary(self.target.name)
        write_record(self.target, self.fingerprint, vars(summary))
        return summary


def attempt(job: Job, share: Share, progress: Progress) -> JobResult:
    """Run a job and return its errors in the result instead of raising them."""
    notes = Notes(progress)
    begun, memory = time.monotonic(), PeakMemory() if share.is_alone else None
    try:
        with share.threads.used():
            result = job.run(share, notes)
        cost = JobCost(
            job.title,
            round(time.monotonic() - begun, 3),
            None if memory is None else memory.end(),
            job.planned(share.resources),
        )
        return JobResult(result, tuple(notes.messages), cost=cost)
    except Cancelled:
        raise
    except BareEarthError as error:
        failure = str(error)
    except MemoryError:
        failure = "There is not enough memory for it. Allow fewer threads."
    except Exception as error:
        failure = f"Unexpected {type(error).__name__}: {error}. Please report it."
    return JobResult(None, tuple(notes.messages), failure)
