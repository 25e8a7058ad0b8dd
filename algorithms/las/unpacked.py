"""The records of compressed files, uncompressed on disk, so that a run decompresses each once."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path
from typing import BinaryIO, Sequence

from ..core.progress import SILENT, Progress
from ..core.unnamed import reach_disk
from .lasfile import LasFile, Unpacked
from .records import read_records

# Records are written only if the disk has room for this many bytes per point, several times their
# size.
_BYTES_A_POINT = 100


def has_room(folder: Path, count: int) -> bool:
    """Return whether the disk of a folder has room for the records of `count` points."""
    return shutil.disk_usage(folder).free > _BYTES_A_POINT * count


def unpack(
    layout: LasFile,
    file: BinaryIO,
    columns: Sequence[str] | None = None,
    progress: Progress = SILENT,
) -> LasFile:
    """Write the records of a compressed file into an open empty file, and return the compressed
    file, which now reads its records from there, so that the open file must stay open.
    """
    done = 0
    for records in read_records(layout, columns=columns):
        file.write(records.data)
        done += len(records)
        progress(done / layout.count)
    reach_disk(file)
    return replace(layout, unpacked=Unpacked(file, None if columns is None else tuple(columns)))
