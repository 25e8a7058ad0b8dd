"""The jobs of a survey of many files: plain functions of what can be pickled, with files between.

They run in a thread, in another process or on another computer that sees the same folders.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Iterator, NamedTuple

import numpy as np

from ..core.errors import BareEarthError, Cancelled
from ..core.files import replacing
from ..core.progress import Progress, Unsaid
from ..core.threads import may_use
from ..las.cloud import PointCloud
from ..las.edits import Edits
from ..las.reading import read_cloud, read_parts
from ..las.writing import layers_kept, write_changed
from ..survey.collection import Tile
from ..survey.selection import Tally
from ..survey.window import read_window
from .blocks import BRIDGE, GROUND, LOW
from .ground import label_ground
from .memory import GIGABYTE, Resources
from .memory_points import MemoryPoints, SurveyFile
from .record import Record, write_record
from .streaming import fits_in_memory
from .survey import BlockIndex, Survey, code

_FAILURE = "no ground"


class Share(NamedTuple):
    """What a job may use.

    Attributes
    ----------
    threads : int
        Threads.
    memory : int
        Bytes.
    """

    threads: int
    memory: int

    @property
    def resources(self) -> Resources:
        """The same in the terms of `label_ground`."""
        return Resources(threads=self.threads, memory=max(self.memory / GIGABYTE, 0.001))


class JobResult(NamedTuple):
    """What became of a job.

    Attributes
    ----------
    result : object
        What it returned.
    messages : tuple of tuple of str
        Kind and text of each.
    failure : str or None
        Why it failed.
    """

    result: Any
    messages: tuple[tuple[str, str], ...] = ()
    failure: str | None = None


@dataclass(frozen=True)
class BlockJob:
    """Does something with the points of some blocks.

    Attributes
    ----------
    survey : Survey
        What all jobs share.
    places : tuple of BlockIndex
        The blocks.
    files : tuple of Path
        Where what is made of each goes.
    sources : tuple of Path
        The files that may have points which these blocks need.
    count : float
        About how many points the blocks hold.
    """

    survey: Survey
    places: tuple[BlockIndex, ...]
    files: tuple[Path, ...]
    sources: tuple[Path, ...]
    count: float

    def split(self) -> list[BlockJob]:
        """Return a job for each of the blocks."""
        count = self.count / len(self.places)
        pairs = zip(self.places, self.files)
        return [replace(self, places=(a,), files=(b,), count=count) for a, b in pairs]

    def run(self, share: Share, progress: Progress) -> None:
        """Do it."""
        raise NotImplementedError

    def clouds(self, progress: Progress) -> Iterator[PointCloud]:
        """Yield the points of each file that the blocks need."""
        window = self.survey.window(self.places)
        for number, source in enumerate(self.sources):
            start, end = (each / len(self.sources) for each in (number, number + 1))
            try:
                part = Unsaid(progress.part(start, end))
                cloud = read_window(source, window, part, trust_header=True)
            except BareEarthError as error:
                progress.warning(
                    f"The tiles beside {source.name} are classified without its points. {error}"
                )
                continue
            if cloud.count:
                yield cloud


class PointJob(BlockJob):
    """Finds something of each point of some blocks, and keeps it by files and blocks."""

    def run(self, share: Share, progress: Progress) -> None:
        """Do it."""
        parts, codes = self._read(progress.part(0.0, 0.3))
        values, failure = [np.zeros(part.cloud.count, self.kind()) for part in parts], ""
        if any(part.wanted.any() and part.selected.any() for part in parts):
            survey, part = self.survey, progress.part(0.3, 0.35)
            store = MemoryPoints(parts, survey.frame, survey.blocks, part, self.kind())
            try:
                self.work(store, share.resources, progress.part(0.35, 0.95))
                values = store.labels
            except BareEarthError as error:
                failure = str(error)
        for place, file in zip(self.places, self.files):
            self._write(file, code(place), parts, codes, values, failure)
        progress(1.0)

    def kind(self) -> type:
        """Return the type of what is found."""
        raise NotImplementedError

    def marks(self, cloud: PointCloud) -> tuple[np.ndarray, np.ndarray]:
        """Return which points of a file take part, and which are known ground."""
        raise NotImplementedError

    def work(self, store: MemoryPoints, resources: Resources, progress: Progress) -> None:
        """Put what is found into the store."""
        raise NotImplementedError

    def _read(self, progress: Progress) -> tuple[list[SurveyFile], list[np.ndarray]]:
        """Return the points that the blocks need, and the block of each."""
        parts, codes = [], []
        here = np.array([code(place) for place in self.places])
        for cloud in self.clouds(progress):
            codes.append(self.survey.codes(cloud))
            parts.append(SurveyFile(cloud, *self.marks(cloud), np.isin(codes[-1], here)))
        return parts, codes

    def _write(
        self,
        file: Path,
        block: int,
        parts: list[SurveyFile],
        codes: list[np.ndarray],
        values: list[np.ndarray],
        failure: str,
    ) -> None:
        """Keep what was found in a block: for each file that of its points there, in its order."""
        kept = {
            _key(part.cloud.path): some[there == block]
            for part, there, some in zip(parts, codes, values)
        }
        if failure:
            kept[_FAILURE] = np.array(failure)
        with replacing(file) as temporary:
            np.savez(temporary, **kept)


class LabelJob(PointJob):
    """Labels the points of some blocks."""

    def kind(self) -> type:
        """Return the type of labels."""
        return np.uint8

    def marks(self, cloud: PointCloud) -> tuple[np.ndarray, np.ndarray]:
        """Return which points are selected, and which of them are surely ground."""
        selection = self.survey.selection
        selected = selection.choose(cloud, Tally())
        return selected, selection.known_ground(cloud, selected)

    def work(self, store: MemoryPoints, resources: Resources, progress: Progress) -> None:
        """Label the points."""
        survey = self.survey
        special = survey.selection.special
        label_ground(store, survey.parameters, survey.blocks, special, resources, progress)


def _key(path: Path) -> str:
    """Return a name for the labels of a file; its own may be none that can be written."""
    return os.fsencode(path.name).hex()


class TileSummary(NamedTuple):
    """What became of one file.

    Attributes
    ----------
    name : str
        Of the output.
    point_count, ground_count : int
        Its points, and those of the target class.
    """

    name: str
    point_count: int
    ground_count: int

    @property
    def text(self) -> str:
        """All of it in words."""
        share = self.ground_count / self.point_count
        return f"{self.name}: {self.point_count:,} points, {share:.1%} ground"


@dataclass(frozen=True)
class TileJob:
    """Writes a tile with what was found in its blocks.

    Attributes
    ----------
    survey : Survey
        What all jobs share.
    tile : Tile
        The input.
    target : Path
        The output.
    places : tuple of BlockIndex
        The blocks that may hold its points.
    files : tuple of Path
        Where what was found in each is.
    record : Record
        Says from what the output is made; written after it.
    """

    survey: Survey
    tile: Tile
    target: Path
    places: tuple[BlockIndex, ...]
    files: tuple[Path, ...]
    record: Record

    def run(self, share: Share, progress: Progress) -> Any:
        """Do it; return what became of it."""
        raise NotImplementedError

    def parts(self, share: Share, progress: Progress) -> Iterator[PointCloud]:
        """Yield the points: all at once, to be written without being read again, if they fit."""
        count, length = self.tile.count, self.tile.record_length
        if fits_in_memory(count, share.resources, length):
            keep = not layers_kept(self.tile.file, self.target)
            yield read_cloud(self.tile.file, progress, keep_records=keep)
        else:
            yield from read_parts(self.tile.file, progress)


class ClassJob(TileJob):
    """Writes a tile with the classes that follow from the labels of its points."""

    def run(self, share: Share, progress: Progress) -> TileSummary:
        """Do it."""
        selection, path, tally = self.survey.selection, self.tile.path, Tally()
        kept, any_ground = KeptValues(self, np.uint8), False
        classes = np.zeros(self.tile.count, dtype=np.uint8)
        for part in self.parts(share, Unsaid(progress.part(0.0, 0.4))):
            if not kept.start:
                selection.check(part)
            selection.choose(part, tally)
            where, labels = kept.of(part)
            low, decks = labels == LOW, labels == BRIDGE
            any_ground |= bool((labels == GROUND).any())
            classes[where] = selection.classes(part, labels == GROUND, low, decks=decks)
        selection.tell(tally, path, progress)
        kept.check()
        if not any_ground:
            raise BareEarthError(kept.failure or f"No ground was found in {path}.")
        changes, rest = Edits(classification=classes), progress.part(0.4, 1.0)
        write_changed(self.tile.file, self.target, changes, rest, part)
        ground = int(np.count_nonzero(classes == selection.to_class))
        summary = TileSummary(self.target.name, len(classes), ground)
        write_record(self.target, self.record, summary._asdict())
        return summary


class KeptValues:
    """What was found of the points of a tile, as the blocks have it.

    Parameters
    ----------
    job : TileJob
        The tile.
    kind : type
        Of the values.

    Attributes
    ----------
    start : int
        How many points were asked for so far.
    failure : str
        Why nothing was found in a block; empty if it was.
    """

    def __init__(self, job: TileJob, kind: type) -> None:
        self._survey, self._path, self._count = job.survey, job.tile.path, job.tile.count
        self._kind, self.start, self.failure = kind, 0, ""
        self._left: dict[int, np.ndarray] = {}
        for place, file in zip(job.places, job.files):
            with np.load(file, allow_pickle=False) as kept:
                if _key(self._path) in kept:
                    self._left[code(place)] = kept[_key(self._path)]
                    self.failure = self.failure or str(kept.get(_FAILURE, ""))

    def of(self, part: PointCloud) -> tuple[slice, np.ndarray]:
        """Return where the next points stand in the file, and what was found of them.

        Raises
        ------
        BareEarthError
            If there are points where the header says that there are none.
        """
        where = slice(self.start, self.start + part.count)
        self.start = where.stop
        if where.stop > self._count:
            raise self._changed()
        codes, values = self._survey.codes(part), np.zeros(part.count, dtype=self._kind)
        for each in np.unique(codes):
            here, left = np.flatnonzero(codes == each), self._left.get(int(each))
            if left is None:
                raise BareEarthError(
                    f"The header of {self._path} states a smaller extent than its points have."
                    " Write the file anew with a program that corrects it."
                )
            if len(left) < len(here):
                raise self._changed()
            values[here], self._left[int(each)] = left[: len(here)], left[len(here) :]
        return where, values

    def check(self) -> None:
        """Refuse a tile of whose values some are left."""
        if any(map(len, self._left.values())):
            raise self._changed()

    def _changed(self) -> BareEarthError:
        """Return the error for a file that is not what it was."""
        return BareEarthError(f"{self._path} changed while it was worked on. Classify it again.")


def attempt(job: BlockJob | TileJob, share: Share, progress: Progress) -> JobResult:
    """Run a job; what goes wrong with it is told, not raised."""
    notes = _Notes(progress)
    try:
        with may_use(share.threads):
            return JobResult(job.run(share, notes), tuple(notes.messages))
    except Cancelled:
        raise
    except BareEarthError as error:
        failure = str(error)
    except MemoryError:
        failure = "There is not enough memory for it. Allow fewer threads."
    except Exception as error:
        failure = f"Unexpected {type(error).__name__}: {error}. Please report it."
    return JobResult(None, tuple(notes.messages), failure)


class _Notes(Progress):
    """Passes on progress and keeps the messages, each with its kind."""

    def __init__(self, whole: Progress) -> None:
        self._whole = whole
        self.messages: list[tuple[str, str]] = []

    def report(self, fraction: float) -> None:
        self._whole(fraction)

    def info(self, text: str) -> None:
        self.messages.append(("info", text))

    def warning(self, text: str) -> None:
        self.messages.append(("warning", text))
