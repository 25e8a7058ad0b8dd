"""Changes of the points of a file, and their effect on the bytes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Iterator

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import paced
from .extrabytes import ExtraDimension, place_dimension
from .header_edits import with_count, with_z_offset, with_z_range
from .lasfile import LasFile
from .records import MOST_KEPT, check_class, column, named, read_records


@dataclass(frozen=True)
class Edits:
    """New values of points, of shape (n,) in file order; None for values that do not change."""

    classification: np.ndarray | None = None  # uint8
    # int8; 1 sets the flag for model key points, 0 clears it, -1 leaves it.
    key_points: np.ndarray | None = None
    z: np.ndarray | None = None  # int32, in the scale of the file
    z_offset: float | None = None  # by default that of the file
    extra: ExtraDimension | None = None
    remembered: ExtraDimension | None = None
    kept: np.ndarray | None = None  # bool, which points are written; by default all

    def columns(self) -> list[np.ndarray]:
        """Return the arrays that are given."""
        extra = [dimension.values for dimension in self.dimensions()]
        columns = self.classification, self.key_points, self.z, self.kept, *extra
        return [column for column in columns if column is not None]

    def dimensions(self) -> list[ExtraDimension]:
        """Return the dimensions that are given."""
        return [dimension for dimension in (self.extra, self.remembered) if dimension is not None]


class EditedFile:
    """A file (`source`) with its changes, and with header and records of the output (`target`);
    records in memory are changed in place.
    """

    def __init__(self, source: LasFile, changes: Edits, records: np.ndarray | None = None) -> None:
        read = (source.count, source.record_length) if records is None else records.shape
        if read != (source.count, source.record_length) or any(
            len(column) != source.count for column in changes.columns()
        ):
            raise BareEarthError(f"{source.path} has changed while it was worked on. Run it again.")
        self.source = self.target = source
        self._changes, self._places, self._records = changes, [], records
        if changes.kept is not None and not changes.kept.any():
            raise BareEarthError(f"None of the points of {source.path} is left to be written.")
        for dimension in changes.dimensions():
            if changes.kept is not None:
                dimension = replace(dimension, values=dimension.values[changes.kept])
            self.target, place = place_dimension(self.target, dimension)
            self._places.append(place)
        if changes.z is not None:
            if changes.z_offset is not None:
                self.target = with_z_offset(self.target, changes.z_offset)
            self.target = with_z_range(self.target, int(changes.z.min()), int(changes.z.max()))
        if changes.kept is not None:
            self.target = with_count(self.target, int(np.count_nonzero(changes.kept)))

    @property
    def leaves_out(self) -> bool:
        """Whether not all points are written."""
        return self._changes.kept is not None

    @property
    def only_classes(self) -> np.ndarray | None:
        """The new classes, if nothing else changes."""
        given = self._changes.columns()
        return given[0] if len(given) == 1 and given[0] is self._changes.classification else None

    def points(self) -> Iterator[tuple[np.ndarray, np.ndarray, float]]:
        """Yield part by part the records to write, their new classes, and the share of the source
        that was read; parts can use the same memory.
        """
        start = 0
        for old in self._sources():
            part = slice(start, start + len(old))
            records = self._applied(old, part)
            classes = self._classes(records, part)
            if self._changes.kept is not None:
                kept = self._changes.kept[part]
                records, classes = records[kept], classes[kept]
            yield records, classes, part.stop / self.source.count
            start = part.stop

    def _sources(self) -> Iterator[np.ndarray]:
        if self._records is None:
            return read_records(self.source)
        return (self._records[piece] for piece in paced(len(self._records), MOST_KEPT))

    def check_classes(self) -> None:
        """Refuse classes that do not fit into the point format of the file."""
        classes = self._changes.classification
        if classes is not None:
            largest = int(classes.max())
            check_class(self.source.path, self.source.point_format, largest, "the ground")

    def _classes(self, records: np.ndarray, part: slice) -> np.ndarray:
        if self._changes.classification is not None:
            return self._changes.classification[part]
        return np.asarray(named(self.target, records)["classification"])

    def _applied(self, records: np.ndarray, part: slice) -> np.ndarray:
        """Return records with all changes but the classes; they may be changed in place."""
        if self.target.record_length > records.shape[1]:
            longer = np.empty((len(records), self.target.record_length), dtype=np.uint8)
            longer[:, : records.shape[1]] = records
            records = longer
        points = named(self.target, records)
        if self._changes.z is not None:
            points["Z"] = self._changes.z[part]
        for place, dimension in zip(self._places, self._changes.dimensions()):
            column(records, place.start, place.kind)[:] = dimension.values[part]
        if self._changes.key_points is not None:
            flags = self._changes.key_points[part]
            points["key_point"] = np.where(flags < 0, points["key_point"], flags)
        return records
