"""One file while a run works on it: its points, in memory or read again part by part, and the
results of the steps, which are written into the output.
"""

from __future__ import annotations

import contextlib
import dataclasses
from pathlib import Path
from typing import Any, Iterator, Sequence

import numpy as np

from ..classes.point_counts import by_class, count_classes
from ..core.disk_arrays import ValuesOnDisk
from ..core.files import write_errors_told
from ..core.memory import GIGABYTE, GivingBack
from ..core.points import Frame
from ..core.progress import SILENT, Progress
from ..core.unnamed import unnamed_file
from ..las.cloud import PointCloud, survey_frame
from ..las.crs_records import read_crs
from ..las.edits import Edits
from ..las.extrabytes import REMEMBERED, ExtraDimension, remembers
from ..las.lasfile import LasFile
from ..las.reading import read_cloud, read_parts
from ..las.records import needed
from ..las.unpacked import has_room, unpack
from ..las.writing import layers_kept, write_changed
from ..survey.shapes import Place
from .disk_store import DiskStore
from .memory import Resources
from .memory_store import MemoryStore
from .step import CLASSES, PointStep, Step
from .store import Store
from .summary import TileSummary
from .values import PointValues, numbered

# Bytes per point of a cloud in memory.
_BYTES_A_POINT_KEPT = 40
# Bytes per point that a filter works on.
_BYTES_A_POINT_SEEN = 110
# The most points that a filter works on at a time: about those of a full block with its buffer.
_MOST_SEEN = 12_000_000
# Bytes of memory per point that is on disk: for its class and other changes.
_BYTES_A_POINT_ON_DISK = 3
# Bytes that blocks may take at most when the points are on disk.
_MOST_FOR_BLOCKS = GIGABYTE
# Largest record length at which whole records are kept in memory. To read them again for
# writing would take as long as the filter.
_LONGEST_KEPT = 48


def fits_in_memory(count: int, resources: Resources, record_length: int = 0) -> bool:
    """Return whether the points of a file fit into memory while it is processed, with their records
    of `record_length` bytes if these are kept as well.
    """
    seen = _BYTES_A_POINT_SEEN * min(count, _MOST_SEEN)
    return (_BYTES_A_POINT_KEPT + record_length) * count + seen <= resources.bytes


def memory_of_file(las: LasFile) -> int:
    """Return about how many bytes the points of a file and its records take in memory."""
    return (_BYTES_A_POINT_KEPT + las.record_length) * las.count


class FilePoints:
    """The points of one file, in memory or read in parts; temporary files go beside `target`."""

    def __init__(
        self,
        cloud: PointCloud | LasFile,
        resources: Resources,
        target: Path | None = None,
        needs_records: bool = True,
    ) -> None:
        self.path, self.count, self.resources = cloud.path, cloud.count, resources
        self._given = resources
        self.is_in_memory = isinstance(cloud, PointCloud)
        # All points if in memory; otherwise None, and the first part after it was read.
        self.cloud: Any = cloud if self.is_in_memory else None
        self.file: Any = cloud.file if isinstance(cloud, PointCloud) else cloud
        # Points in memory need no target.
        self._target, self._needs_records = target or Path(), needs_records
        self._files, self._was_read = contextlib.ExitStack(), False
        self._mapped: list[ValuesOnDisk] = []
        if not self.is_in_memory:
            memory = max(self.memory_left, resources.bytes // 2)
            self.resources = Resources.of(resources.threads, min(memory, _MOST_FOR_BLOCKS))

    @classmethod
    def opened(
        cls,
        las: LasFile,
        target: Path,
        resources: Resources,
        needs_records: bool = True,
        progress: Progress = SILENT,
    ) -> FilePoints:
        """Read a file if it fits into memory, with whole records if needed and if they fit."""
        if not fits_in_memory(las.count, resources):
            progress.info(
                f"The {las.count:,} points do not fit into the memory that may be used: they are"
                " read twice, and wait in a temporary file in the output folder."
            )
            return cls(las, resources, target, needs_records)
        length = las.record_length
        keep = needs_records and length <= _LONGEST_KEPT
        keep = keep and fits_in_memory(las.count, resources, length)
        return cls(read_cloud(las, progress, keep_records=keep), resources, target)

    def __enter__(self) -> FilePoints:
        return self

    def __exit__(self, *exception: object) -> None:
        self._files.close()

    @property
    def place(self) -> Place:
        if self.is_in_memory:
            box = self.cloud.box if self.count else None
            return Place(str(self.path), self.cloud.crs, box)
        return place_of(self.file)

    @property
    def memory_left(self) -> int:
        """Bytes that may be used for writing, in addition to what the points take."""
        size = _BYTES_A_POINT_ON_DISK
        if self.is_in_memory:
            records = self.cloud.records
            size = _BYTES_A_POINT_KEPT + (0 if records is None else records.shape[1])
        return max(self._given.bytes - size * self.count, 0)

    def parts(
        self, progress: Progress = SILENT, is_last: bool = False
    ) -> Iterator[tuple[slice, PointCloud]]:
        """Yield the points with their indices, in the same parts each time; if this is the last
        reading, a compressed file is not unpacked for it.
        """
        if self.is_in_memory:
            for where, part in self.cloud.parts():
                yield where, part
                progress(where.stop / max(self.count, 1))
            return
        is_packed = self.file.is_compressed and self.file.unpacked is None
        if not is_last and is_packed and has_room(self._target.parent, self.count):
            columns = None if self._needs_records else needed(self.file)
            with write_errors_told(self._target):
                file = self._files.enter_context(unnamed_file(self._target.parent))
                self.file = unpack(self.file, file, columns, progress.part(0.0, 0.7))
            progress = progress.part(0.7, 1.0)
        # Reading reports what is wrong with the file only the first time.
        reading = progress.quiet() if self._was_read else progress
        self._was_read = True
        for where, part in numbered(read_parts(self.file, reading)):
            self.cloud = self.cloud or part
            yield where, part

    def freeing_memory(self, progress: Progress) -> Progress:
        """Return a progress that also gives memory back to the system, if points are on disk."""
        if self.is_in_memory:
            return progress

        def leave_memory() -> None:
            for values in self._mapped:
                values.leave_memory()

        return GivingBack(progress, leave_memory)

    def allocate(self, kind: type) -> np.ndarray:
        """Return an array of one value for each point; on disk if the points are."""
        if self.is_in_memory:
            return np.empty(self.count, dtype=kind)
        self._mapped.append(ValuesOnDisk(self._target, kind, self.count))
        return self._mapped[-1].values

    def as_stored(self, where: slice, part: PointCloud) -> PointCloud:
        """Return a part as it is stored: a view of the cloud in memory, without new classes."""
        return self.cloud.take(where) if self.is_in_memory else part

    def frame_of(self, step: Step) -> Frame:
        crs = self.cloud.crs if self.is_in_memory else read_crs(self.file)
        return survey_frame(crs, step.blocks.origin)

    def store_for(self, step: Step) -> Store:
        """Return an empty store for the points that a step needs."""
        frame = self.frame_of(step)
        if self.is_in_memory:
            return MemoryStore(frame, step.blocks, step.kind)
        store = DiskStore(self._target, frame, step.blocks, step.kind)
        return self._files.enter_context(store)


def place_of(las: LasFile) -> Place:
    """Return where the points of a file lie, according to its header."""
    # The header can be wrong: without a valid extent nothing is refused.
    return Place(str(las.path), read_crs(las), las.outer_box if las.states_extent else None)


def copies_all_else(las: LasFile, target: Path, steps: Sequence[PointStep]) -> bool:
    """Return whether only the layers of classes are written, and all other bytes are copied."""
    if remembers(las) or any(step.changes != {CLASSES} for step in steps):
        return False
    return layers_kept(las, target) is not None


class TileResult:
    """The results of the steps of a run for the points of a file."""

    def __init__(self, points: FilePoints, values: Sequence[PointValues]) -> None:
        self._points, self._values = points, values
        steps = [of_step.step for of_step in values]
        # The results of each step, except for classes.
        self.results = [step.result(points.path, points.allocate) for step in steps]
        self.classification: np.ndarray | None = None
        if any(step.gives_classes for step in steps):
            self.classification = points.allocate(np.uint8)
        self._remembered: np.ndarray | None = None
        self._kept: np.ndarray | None = None  # bool, (n,): which points are written; None for all
        # int64, (256,): points of each class in the output
        self.class_counts = np.zeros(256, dtype=np.int64)

    @classmethod
    def collected(
        cls, points: FilePoints, values: Sequence[PointValues], progress: Progress = SILENT
    ) -> TileResult:
        """Read all points once more, and return the results for them."""
        result = cls(points, values)
        for where, part in points.parts(points.freeing_memory(progress), is_last=True):
            result._add(where, part)
        for of_step in values:
            of_step.check()
        return result

    def _add(self, where: slice, part: PointCloud) -> None:
        kept = None
        for result, of_step in zip(self.results, self._values):
            part, of_result = result.add(where, part, of_step.of(where, part))
            kept = of_result if kept is None else kept
        if self.classification is not None:
            self.classification[where] = part.classification
            if part.remembered is not None:
                if self._remembered is None:
                    self._remembered = self._points.allocate(np.uint8)
                self._remembered[where] = part.remembered
        classes = part.classification
        if kept is not None:
            if self._kept is None:
                self._kept = self._points.allocate(bool)
            self._kept[where] = kept
            classes = classes[kept]
        self.class_counts += count_classes(classes)

    def report(self, progress: Progress, is_alone: bool = True) -> None:
        """Report the results of the steps for the only file, or for one of many."""
        for result, values in zip(self.results, self._values):
            result.report(progress, None if is_alone else values.failure)

    @property
    def is_empty(self) -> bool:
        return not self.class_counts.any()

    def edits(self, progress: Progress = SILENT) -> Edits:
        """Return all changes of the file, or refuse a file that cannot hold them."""
        edits = Edits(classification=self.classification, kept=self._kept)
        if self._remembered is not None:
            dimension = ExtraDimension(REMEMBERED, "Before changes by hand", self._remembered)
            edits = dataclasses.replace(edits, remembered=dimension)
        for result in self.results:
            fields = vars(result.edits(self._points.cloud, progress))
            changes = {name: value for name, value in fields.items() if value is not None}
            edits = dataclasses.replace(edits, **changes)
        return edits

    def write(self, target: Path, progress: Progress) -> None:
        points, edits = self._points, self.edits(progress)
        progress = points.freeing_memory(progress)
        write_changed(points.file, target, edits, progress, points.cloud, points.memory_left)

    def summary(self, name: str) -> TileSummary:
        """Return the summary of the output `name`, as the first step makes it."""
        return self.results[0].summary(name, by_class(self.class_counts))
