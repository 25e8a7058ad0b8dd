"""Rasters of a survey of many classified files: a job for some blocks, with files between."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.files import replacing
from ..core.progress import SILENT, Progress
from ..grids.cell_window import CellWindow
from ..products.raster_block import BlockRasters
from ..survey.collection import Collection
from ..survey.selection import Selection
from .blocks import Block
from .job_queue import JobQueue
from .jobs import BlockJob, Share
from .memory_points import MemoryPoints, SurveyFile
from .planning import block_jobs
from .rasters import RasterPoints, RasterRequest, RasterSize, rasters_of_store, write_rasters
from .survey import BlockIndex, Survey, frame_of, places_of
from .workers import Workers

_LARGE = ("terrain", "surface", "confidence")


@dataclass(frozen=True)
class RasterJob(BlockJob):
    """Makes the rasters of some blocks.

    Attributes
    ----------
    request : RasterRequest
        What is wanted.
    points : RasterPoints
        Which points they are made of.
    """

    request: RasterRequest = field(default_factory=RasterRequest)
    points: RasterPoints = field(default_factory=lambda: RasterPoints((2,)))

    def run(self, share: Share, progress: Progress) -> None:
        """Do it."""
        parts = [
            SurveyFile(cloud, *self.points.of(cloud, self.request))
            for cloud in self.clouds(progress.part(0.0, 0.5))
        ]
        made: dict[BlockIndex, list[BlockRasters]] = {place: [] for place in self.places}
        if any(part.selected.any() for part in parts):
            survey, rest = self.survey, progress.part(0.6, 0.95)
            store = MemoryPoints(parts, survey.frame, survey.blocks, progress.part(0.5, 0.6))
            for each in rasters_of_store(
                store, self.request, share.resources, rest, lambda b: self._place(b) in made
            ):
                made[self._place_of(each.window)].append(each)
        for place, file in zip(self.places, self.files):
            _keep(file, made[place])
        progress(1.0)

    def _place(self, block: Block) -> BlockIndex:
        """Return the place of the block of which one is a part."""
        share = round(self.survey.blocks.side / block.side)
        return BlockIndex(block.column // share, block.row // share)

    def _place_of(self, window: CellWindow) -> BlockIndex:
        """Return the place of the block in which the first of some cells has its centre."""
        cell, blocks = self.request.model.dtm_cell_size, self.survey.blocks
        x, y = ((each + 0.5) * cell for each in (window.column, window.row))
        return BlockIndex(int(blocks.number(x)), int(blocks.number(y)))


def _keep(file: Path, made: Sequence[BlockRasters]) -> None:
    """Write the rasters of a block, or of the parts of one."""
    content = {
        f"{name}_{number}": np.asarray(value)
        for number, each in enumerate(made)
        for name, value in each._asdict().items()
    }
    with replacing(file) as temporary, temporary.open("wb") as stream:
        np.savez(stream, count=len(made), **content)


class _Kept:
    """The rasters of a block, of which the large arrays stay in their file until they are needed.

    Parameters
    ----------
    file : Path
        As `_keep` wrote it.
    number : int
        Of the rasters in it.
    """

    def __init__(self, file: Path, number: int) -> None:
        self._file, self._number = file, number
        with np.load(file, allow_pickle=False) as kept:
            for name in BlockRasters._fields:
                if name not in _LARGE:
                    setattr(self, name, kept[f"{name}_{number}"])
        self.window = CellWindow(*map(int, self.window))

    def __getattr__(self, name: str) -> np.ndarray:
        if name not in _LARGE:
            raise AttributeError(name)
        with np.load(self._file, allow_pickle=False) as kept:
            return kept[f"{name}_{self._number}"]


def _kept_in(file: Path) -> list[_Kept]:
    with np.load(file, allow_pickle=False) as kept:
        count = int(kept["count"])
    return [_Kept(file, number) for number in range(count)]


def make_rasters(
    collection: Collection,
    folder: Path,
    request: RasterRequest,
    points: RasterPoints,
    workers: Workers,
    progress: Progress = SILENT,
) -> RasterSize:
    """Make rasters of a survey of classified files.

    Parameters
    ----------
    collection : Collection
        The files.
    folder : Path
        Where the rasters of the blocks wait; it must be there, and is seen by all workers.
    request : RasterRequest
        What is wanted, and where it goes.
    points : RasterPoints
        Which points they are made of.
    workers : Workers
        Who does it; they are stopped afterwards.
    progress : Progress
        Receives progress and messages.

    Raises
    ------
    BareEarthError
        If a block could not be done, there is no ground, or a raster cannot be written.
    Cancelled
        If the user asked to stop.
    """
    survey = Survey(None, Selection(), frame_of(collection), request.blocks)
    places = sorted({place for tile in collection.tiles for place in places_of(survey, tile)})
    files = {each: folder / f"rasters_{each.column}_{each.row}.npz" for each in places}
    jobs = block_jobs(
        RasterJob, survey, collection, files, folder, 0, workers, request=request, points=points
    )
    try:
        run = JobQueue(jobs, [], workers, progress.part(0.0, 0.8))
        try:
            run.work()
        finally:
            workers.stop()
        if run.lost:
            raise BareEarthError(f"The rasters cannot be made. {run.lost[0]}")
        made = [each for file in files.values() for each in _kept_in(file)]
        with contextlib.ExitStack() as outputs:
            return write_rasters(made, survey.frame, request, outputs, progress.part(0.8, 1.0))
    finally:
        for file in files.values():
            file.unlink(missing_ok=True)
