"""Where the points of a survey are read with the results of the steps before."""

from __future__ import annotations

from pathlib import Path
from types import MappingProxyType
from typing import Iterator, Mapping

from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud
from ..las.lasfile import LasFile
from ..las.reading import read_parts
from ..survey.files import Survey
from .unpacking import Unpacking
from .values import BlockFiles, BlockValues, numbered, with_values


class Results:
    """Where to read the points of a survey with the results of earlier steps: from its files, or
    from `inputs`, which some of the files were made from, and the results.
    """

    def __init__(
        self,
        survey: Survey,
        inputs: Mapping[Path, LasFile] = MappingProxyType({}),
        earlier: tuple[BlockFiles, ...] = (),
    ) -> None:
        self.survey, self._inputs, self.earlier = survey, inputs, earlier
        self.read_from = {tile.path: inputs.get(tile.path, tile).path for tile in survey.tiles}
        self.finished = frozenset(self.read_from) - inputs.keys()

    def parts(
        self, unpacking: Unpacking | None = None, progress: Progress = SILENT
    ) -> Iterator[PointCloud]:
        """Yield the points of all files, part by part."""
        tiles = self.survey.tiles
        for tile, part in zip(tiles, progress.shares(*[1.0] * len(tiles))):
            las, values = self._inputs.get(tile.path, tile), []
            if tile.path in self._inputs:
                values = [BlockValues(files, las, are_all=False) for files in self.earlier]
            if unpacking is not None:
                las = unpacking.of(las, part.quiet())
            parts = numbered(read_parts(las, part.quiet()))
            yield from (points for _, points in with_values(parts, values))
