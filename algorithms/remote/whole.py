"""A file on a server of which no part can be found, as plain LAZ: all of it is fetched."""

from __future__ import annotations

from pathlib import Path
from typing import BinaryIO, cast

from ..core.progress import SILENT, Progress
from ..las.crs_records import read_crs
from ..las.opening import read_layout
from ..las.sources import FileState
from ..survey.area import Area
from ..survey.shapes import Place
from .copc import area_of
from .files import RemoteFile

# Bytes of a request.
_PIECE = 1 << 23


class WholePart:
    """All of a file, if it can have points in an area."""

    is_exact = is_whole = True
    missing_count = 0

    def __init__(self, file: RemoteFile, area: Area | None, progress: Progress = SILENT) -> None:
        self.file, self.name = file, file.name
        state = FileState(file.size, 0, 0, 0)
        layout = read_layout(Path(file.name), cast(BinaryIO, file), state)
        self.crs, self.box, self.point_count = read_crs(layout), layout.box, layout.count
        self.area = area_of(area, Place(file.name, self.crs, self.box), progress)
        if self.area is not None and not self.area.may_touch(self.box):
            self.point_count = 0
        starts = range(0, file.size, _PIECE)
        self._pieces = [(start, min(start + _PIECE, file.size)) for start in starts]
        self._plan = file.plan(self._pieces)
        self.size, self.request_count = self._plan.size, len(self._plan.requests)

    def fetch(self, progress: Progress) -> None:
        """Get all of it."""
        self.file.fetch(self._plan, progress)

    def write(self, target: Path, progress: Progress = SILENT) -> int:
        """Write the same bytes; return the number of points."""
        with open(target, "wb") as file:
            for start, stop in self._pieces:
                self.file.seek(start)
                file.write(self.file.read(stop - start))
                progress(stop / self.file.size)
        return self.point_count
