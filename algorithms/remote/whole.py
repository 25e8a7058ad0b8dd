"""A file on a server that can't be read in parts, such as plain LAZ: all of it is downloaded."""

from __future__ import annotations

from pathlib import Path
from typing import BinaryIO, cast

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..las.crs_records import read_crs
from ..las.opening import open_las, read_layout
from ..las.records import read_records
from ..las.sources import FileState, damaged
from ..survey.area import Area
from ..survey.shapes import Place
from .copc import area_of
from .files import RemoteFile

_PIECE = 1 << 23  # bytes of a request


class WholePart:
    """The whole of a file, or nothing if it has no points in an area."""

    is_exact = is_whole = True
    missing_count = 0

    def __init__(self, file: RemoteFile, area: Area | None, progress: Progress = SILENT) -> None:
        self.file, self.name = file, file.name
        state = FileState(file.size, 0, 0, 0)
        layout = file.twice(lambda: read_layout(Path(file.name), cast(BinaryIO, file), state))
        self.crs, self.box, self.point_count = read_crs(layout), layout.box, layout.count
        self.area = area_of(area, Place(file.name, self.crs, self.box), progress)
        if self.area is not None and not self.area.may_touch(self.box):
            self.point_count = 0
        starts = range(0, file.size, _PIECE)
        self._pieces = [(start, min(start + _PIECE, file.size)) for start in starts]
        plan = file.plan(self._pieces)
        self.size, self.request_count = plan.size, len(plan.requests)

    def fetch(self, progress: Progress) -> None:
        """Download the file."""
        self.file.fetch(self.file.plan(self._pieces), progress)

    def write(self, target: Path, progress: Progress = SILENT) -> int:
        """Write the file as it is, and check that all points can be read; return their number."""
        self.file.twice(lambda: self._write(target, progress))
        return self.point_count

    def _write(self, target: Path, progress: Progress) -> None:
        self.fetch(progress.part(0.0, 0.1))  # pieces that were damaged are requested again
        with open(target, "wb") as file:
            for start, stop in self._pieces:
                self.file.seek(start)
                file.write(self.file.read(stop - start))
                progress(0.1 + 0.2 * stop / self.file.size)
        try:
            layout, done = open_las(target), 0
            for records in read_records(layout):
                done += len(records)
                progress(0.3 + 0.7 * done / layout.count)
        except BareEarthError as error:
            raise damaged(Path(self.name)) from error
