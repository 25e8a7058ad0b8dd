"""The parts of a compressed file on disk, so that the file is decompressed once."""

from __future__ import annotations

import contextlib
import dataclasses
import shutil
from pathlib import Path
from typing import Any, Iterator, NamedTuple

import numpy as np

from ..core.files import reach_disk, unnamed_file, write_errors_told
from ..las.cloud import PointCloud
from ..las.lasfile import LasFile

# Parts are kept only if the disk has room for so many bytes a point, several times what they take.
_BYTES_A_POINT = 100


class _Column(NamedTuple):
    """Name, type, and position of the values of a column in the file."""

    name: str
    kind: np.dtype
    start: int


class PartsOnDisk:
    """Parts of a file, in a temporary file without a name.

    Parameters
    ----------
    target : Path
        The output. The temporary file is in its folder.

    Attributes
    ----------
    is_complete : bool
        Whether all parts have been added.
    """

    def __init__(self, target: Path) -> None:
        self._target, self._end, self.is_complete = target, 0, False
        self._parts: list[tuple[PointCloud, int, list[_Column]]] = []
        self._files = contextlib.ExitStack()
        with write_errors_told(self._target):
            self._file = self._files.enter_context(unnamed_file(target.parent))

    def __enter__(self) -> PartsOnDisk:
        return self

    def __exit__(self, *exception: object) -> None:
        self._files.close()

    def add(self, part: PointCloud) -> None:
        """Add the next part."""
        columns = []
        with write_errors_told(self._target):
            for name, values in vars(part).items():
                if isinstance(values, np.ndarray):
                    columns.append(_Column(name, values.dtype, self._end))
                    self._end += self._file.write(np.ascontiguousarray(values).tobytes())
        self._parts.append((without_points(part), part.count, columns))

    def finish(self) -> None:
        """Finish adding."""
        with write_errors_told(self._target):
            reach_disk(self._file)
        self.is_complete = True

    def __iter__(self) -> Iterator[PointCloud]:
        """Yield the parts in their order."""
        for part, count, columns in self._parts:
            values: dict[str, Any] = {}
            for name, kind, start in columns:
                self._file.seek(start)
                values[name] = np.frombuffer(self._file.read(count * kind.itemsize), kind)
            yield dataclasses.replace(part, **values)


def may_keep(las: LasFile, folder: Path) -> bool:
    """Return whether the parts of a file are worth keeping in a folder, and its disk has room."""
    if not las.is_compressed:
        return False
    return shutil.disk_usage(folder).free > _BYTES_A_POINT * las.count


def without_points(part: PointCloud) -> PointCloud:
    """Return a cloud with all but its points."""
    columns: dict[str, Any] = {
        # Copies, because a view would keep the points.
        name: value[:0].copy()
        for name, value in vars(part).items()
        if isinstance(value, np.ndarray)
    }
    return dataclasses.replace(part, **columns)
