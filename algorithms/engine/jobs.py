"""The jobs of a survey of many files: values that can be pickled, and pass results on in files.

They run in threads, in processes, or on other computers that see the same folders.
"""

from __future__ import annotations

import contextlib
import os
import time
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Iterator, NamedTuple

import numpy as np

from ..core.errors import BareEarthError, Cancelled
from ..core.files import replacing
from ..core.progress import Notes, Progress
from ..core.threads import SharedThreads
from ..las.cloud import PointCloud
from ..las.lasfile import LasFile
from ..las.writing import layers_kept, write_changed
from .block_grid import BlockGrid, BlockIndex, code, memory_held
from .cloud_cache import CloudCache
from .disk_store import DiskStore
from .file_points import FilePoints, held_by_file
from .manifest import Fingerprint, write_record
from .memory import PeakMemory, Resources
from .memory_store import MemoryStore
from .steps import PointStep

_FAILURE = "no ground"


@dataclass(frozen=True)
class Taken:
    """What a job took.

    Attributes
    ----------
    job : str
        What was done: "blocks" or the name of a file.
    seconds : float
        Wall-clock time.
    memory : int or None
        Most bytes of memory at a time; None if other jobs ran in the same process, or the system
        does not tell it.
    planned : int
        Bytes of memory that it was expected to take at most.
    """

    job: str
    seconds: float
    memory: int | None
    planned: int


class JobResult(NamedTuple):
    """The result of a job.

    Attributes
    ----------
    result : object
        The return value.
    messages : tuple of tuple of str
        Kind and text of each message.
    failure : str or None
        Why the job failed, if it did.
    taken : Taken or None
        What it took, if it did not fail.
    """

    result: Any
    messages: tuple[tuple[str, str], ...] = ()
    failure: str | None = None
    taken: Taken | None = None


class Share(NamedTuple):
    """What a job may use.

    Attributes
    ----------
    resources : Resources
        Threads of its own, and memory.
    cache : CloudCache
        Files in memory, shared by the jobs of a process.
    threads : SharedThreads
        All threads of the run, of which it may use those that are free.
    is_alone : bool
        Whether no other job runs in the same process.
    """

    resources: Resources
    cache: CloudCache
    threads: SharedThreads
    is_alone: bool = False


@dataclass(frozen=True)
class BlockJob:
    """A job that works on the points of some blocks.

    Attributes
    ----------
    grid : BlockGrid
        The blocks of the survey.
    places : tuple of BlockIndex
        The blocks of this job.
    files : tuple of Path
        The file for the result of each block.
    sources : tuple of Path
        The input files that may have points for these blocks.
    count : float
        Estimated number of points in the blocks.
    """

    grid: BlockGrid
    places: tuple[BlockIndex, ...]
    files: tuple[Path, ...]
    sources: tuple[Path, ...]
    count: float

    def split(self) -> list[BlockJob]:
        """Return one job for each block."""
        count = self.count / len(self.places)
        pairs = zip(self.places, self.files)
        return [replace(self, places=(a,), files=(b,), count=count) for a, b in pairs]

    def run(self, share: Share, progress: Progress) -> None:
        """Do it."""
        raise NotImplementedError

    @property
    def title(self) -> str:
        """What it is called in reports."""
        return "blocks"

    def planned(self, resources: Resources) -> int:
        """Return the bytes of memory that it takes at most, as far as is known before."""
        held = memory_held(self.grid, self.count)
        return held if held <= resources.bytes else resources.bytes

    def clouds(self, cache: CloudCache, progress: Progress) -> Iterator[PointCloud]:
        """Yield the points of each file that the blocks need."""
        window = self.grid.window(self.places)
        for source, part in zip(self.sources, progress.shares(*[1.0] * len(self.sources))):
            try:
                cloud = cache.window(source, window, part.quiet(), self.grid.stated)
            except BareEarthError as error:
                progress.warning(
                    f"{source.name} is left out: the results beside it are made without its"
                    f" points. {error}"
                )
                continue
            if cloud.count:
                yield cloud

    @contextlib.contextmanager
    def store(self, share: Share, kind: type = np.uint8) -> Iterator[MemoryStore | DiskStore]:
        """Yield an empty store for the points: on disk if they do not fit into memory."""
        frame, blocks = self.grid.frame, self.grid.blocks
        if memory_held(self.grid, self.count) <= share.resources.bytes:
            yield MemoryStore(frame, blocks, kind)
            return
        with DiskStore(self.files[0], frame, blocks, kind) as store:
            yield store


@dataclass(frozen=True)
class PointJob(BlockJob):
    """A job that finds a value for each point of some blocks, and stores it by block and file.

    Attributes
    ----------
    step : PointStep
        The step that finds the values.
    """

    step: PointStep

    def run(self, share: Share, progress: Progress) -> None:
        """Do it."""
        failure = ""
        with self.store(share, self.step.kind) as store:
            parts = self._fill(store, share.cache, progress.part(0.0, 0.3))
            store.finish(progress.part(0.3, 0.35))
            if any(part.has_work for part in parts):
                try:
                    self.step.work(store, share.resources, progress.part(0.35, 0.95))
                except BareEarthError as error:
                    failure = str(error)
            progress(1.0)  # ends a job of a run that was cancelled, before it writes
            for number, file in enumerate(self.files):
                self._write(file, number, parts, store, failure)

    def _fill(
        self, store: MemoryStore | DiskStore, cache: CloudCache, progress: Progress
    ) -> list[_Part]:
        """Add the points that the blocks need to a store; return what else is known of them."""
        parts, counts = [], self.step.counts()
        here = np.array([code(place) for place in self.places])
        for cloud in self.clouds(cache, progress):
            codes = self.grid.codes(cloud)
            places = np.zeros(cloud.count, dtype=np.uint8)
            for number, block in enumerate(here.tolist(), start=1):
                places[codes == block] = number
            marks = self.step.marks(cloud, counts)
            wanted = places > 0
            if marks.wanted is not None:
                wanted &= marks.wanted
            store.append(cloud, marks._replace(wanted=wanted))
            parts.append(_Part(_key(cloud.path), places, bool((wanted & marks.selected).any())))
        return parts

    def _write(
        self,
        file: Path,
        number: int,
        parts: list[_Part],
        store: MemoryStore | DiskStore,
        failure: str,
    ) -> None:
        """Write the values of a block: for each file those of its points in it, in file order."""
        kept = {}
        for which, part in enumerate(parts):
            here = part.places == number + 1
            if failure:
                kept[part.key] = np.zeros(np.count_nonzero(here), dtype=self.step.kind)
            else:
                kept[part.key] = store.values(which)[here]
        if failure:
            kept[_FAILURE] = np.array(failure)
        with replacing(file) as temporary:
            np.savez(temporary, **kept)


class _Part(NamedTuple):
    """What a job knows of a file, beside the points that its store holds.

    Attributes
    ----------
    key : str
        Name of its values.
    places : numpy.ndarray of uint8, shape (n,)
        Number of the block that holds each point, from 1; 0 for other blocks.
    has_work : bool
        Whether any point is to get a value.
    """

    key: str
    places: np.ndarray
    has_work: bool


def _key(path: Path) -> str:
    """Return a name for the values of a file, whose own name may have unsuitable characters."""
    return os.fsencode(path.name).hex()


@dataclass(frozen=True)
class TileJob:
    """A job that writes a file with the values that were found for its points.

    Attributes
    ----------
    grid : BlockGrid
        The blocks of the survey.
    step : PointStep
        The step that found the values.
    tile : LasFile
        The input.
    target : Path
        The output.
    places : tuple of BlockIndex
        The blocks that may hold its points.
    files : tuple of Path
        The file with the result of each block.
    fingerprint : Fingerprint
        What the output is made from; written after the output.
    """

    grid: BlockGrid
    step: PointStep
    tile: LasFile
    target: Path
    places: tuple[BlockIndex, ...]
    files: tuple[Path, ...]
    fingerprint: Fingerprint

    @property
    def title(self) -> str:
        """What it is called in reports."""
        return self.tile.path.name

    def planned(self, resources: Resources) -> int:
        """Return the bytes of memory that it takes at most, as far as is known before."""
        return min(held_by_file(self.tile), resources.bytes)

    def run(self, share: Share, progress: Progress) -> Any:
        """Write the file. Return the summary of the step, or None if there is nothing to write."""
        step, las, path, resources = self.step, self.tile, self.tile.path, share.resources
        counts, kept = step.counts(), TileValues(self)
        is_copied = layers_kept(las, self.target) is not None
        reading = progress.part(0.0, 0.4).quiet()
        # Where whole records are needed, the file is read again.
        cloud = share.cache.whole(las, reading) if is_copied else None
        if cloud is None:
            points = FilePoints.opened(las, self.target, resources, not is_copied, reading)
        else:
            points = FilePoints(cloud, resources, self.target)
        with points:
            result = step.result(path, points.allocate)
            for where, part in points.parts(is_last=True):
                step.count(part, counts)
                result.add(where, part, kept.of(where, part))
            kept.check()
            step.tell_of_tile(counts, path, progress)
            result.check(kept.failure)
            if result.is_empty:
                return None
            edits = result.edits(points.cloud, progress)
            last = progress.part(0.4, 1.0)
            write_changed(las, self.target, edits, last, points.cloud, points.memory_left)
        summary = result.summary(self.target.name)
        write_record(self.target, self.fingerprint, asdict(summary))
        return summary


class TileValues:
    """The values of the points of a tile, as the blocks stored them.

    Parameters
    ----------
    job : TileJob
        The tile.

    Attributes
    ----------
    failure : str
        Why a block has no values; empty if all have.
    """

    def __init__(self, job: TileJob) -> None:
        self._grid, self._path, self._count = job.grid, job.tile.path, job.tile.count
        self._kind, self.failure = job.step.kind, ""
        self._left: dict[int, np.ndarray] = {}
        for place, file in zip(job.places, job.files):
            with np.load(file, allow_pickle=False) as kept:
                if _key(self._path) in kept:
                    self._left[code(place)] = kept[_key(self._path)]
                    self.failure = self.failure or str(kept.get(_FAILURE, ""))

    def of(self, where: slice, part: PointCloud) -> np.ndarray:
        """Return the values of the next points.

        Raises
        ------
        BareEarthError
            If points lie outside the extent in the header.
        """
        if where.stop > self._count:
            raise self._changed()
        codes, values = self._grid.codes(part), np.zeros(part.count, dtype=self._kind)
        for each in np.unique(codes):
            here, left = np.flatnonzero(codes == each), self._left.get(int(each))
            if left is None:
                raise BareEarthError(
                    f"The header of {self._path} states a smaller extent than its points have."
                    " Write the file again with a program that corrects the header."
                )
            if len(left) < len(here):
                raise self._changed()
            values[here], self._left[int(each)] = left[: len(here)], left[len(here) :]
        return values

    def check(self) -> None:
        """Refuse a tile if some values were not used."""
        if any(map(len, self._left.values())):
            raise self._changed()

    def _changed(self) -> BareEarthError:
        """Return the error for a file that has changed."""
        return BareEarthError(f"{self._path} changed while it was worked on. Classify it again.")


def attempt(job: BlockJob | TileJob, share: Share, progress: Progress) -> JobResult:
    """Run a job. Return its errors in the result instead of raising them."""
    notes = _JobMessages(progress)
    begun, memory = time.monotonic(), PeakMemory() if share.is_alone else None
    try:
        with share.threads.used():
            result = job.run(share, notes)
        taken = Taken(
            job.title,
            round(time.monotonic() - begun, 3),
            None if memory is None else memory.end(),
            job.planned(share.resources),
        )
        return JobResult(result, tuple(notes.messages), taken=taken)
    except Cancelled:
        raise
    except BareEarthError as error:
        failure = str(error)
    except MemoryError:
        failure = "There is not enough memory for it. Allow fewer threads."
    except Exception as error:
        failure = f"Unexpected {type(error).__name__}: {error}. Please report it."
    return JobResult(None, tuple(notes.messages), failure)


class _JobMessages(Notes):
    """Passes on progress and collects the messages."""

    def __init__(self, whole: Progress) -> None:
        super().__init__()
        self._whole = whole

    def report(self, fraction: float) -> None:
        self._whole(fraction)
