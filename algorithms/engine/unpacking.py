"""Unpacks compressed files, so that the jobs of a run decompress each file only once."""

from __future__ import annotations

import dataclasses
import os
from pathlib import Path
from typing import NamedTuple

from ..core.errors import BareEarthError
from ..core.files import replacing
from ..core.locks import one_at_a_time
from ..core.progress import Progress
from ..las.lasfile import LasFile, Unpacked
from ..las.records import needed
from ..las.unpacked import has_room, unpack
from .manifest import short_name


class Unpacking(NamedTuple):
    """Where the records of compressed files wait uncompressed, for all local jobs of a run."""

    folder: Path  # exists, and is removed when the run ends
    is_whole: bool  # whole records, for writing, or only the columns of a cloud
    # Files that are read only once more, which are not unpacked.
    once: frozenset[Path] = frozenset()

    def of(self, las: LasFile, progress: Progress) -> LasFile:
        """Return a file that is read uncompressed; the file itself if the disk is full."""
        if not las.is_compressed or las.unpacked is not None:
            return las
        columns = None if self.is_whole else needed(las)
        key = os.fsencode(las.path.resolve()) + repr(las.state).encode()
        path = self.folder / f"{short_name(key)}.rec"
        with one_at_a_time(path.with_suffix(".lock")):
            if not path.exists():
                if las.path in self.once or not has_room(self.folder, las.count):
                    return las
                try:
                    with replacing(path) as temporary, temporary.open("w+b") as file:
                        unpack(las, file, columns, progress)
                except BareEarthError:  # a damaged file is reported when it is read
                    return las
        return dataclasses.replace(las, unpacked=Unpacked(path, columns))
