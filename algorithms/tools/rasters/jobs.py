"""Jobs that make rasters of many classified files. Files pass on the rasters of blocks."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Dict, Iterable, Iterator, Mapping, NamedTuple, Sequence

import numpy as np

from ...core.errors import BareEarthError, Cancelled
from ...core.files import Outputs, replacing, split_name
from ...core.progress import SILENT, Progress
from ...core.temporary import remove
from ...engine.block_grid import (
    BlockGrid,
    BlockIndex,
    grouped,
    least_memory,
    places_of,
    points_in,
    sources_of,
)
from ...engine.blocks import Block
from ...engine.job_queue import JobQueue
from ...engine.jobs import BlockJob, Share
from ...engine.manifest import block_file, stamp_of
from ...engine.plan import Results
from ...engine.unpacking import Unpacking
from ...engine.values import BlockFiles
from ...engine.workers import Workers
from ...grids.cell_window import CellWindow
from ...las.cloud import survey_frame
from ...survey.files import Survey
from .block import BlockRasters
from .output import AROUND_AREA, RasterSize, no_point_in, write_rasters
from .step import MakeRasters


@dataclass(frozen=True, eq=False)
class RasterJob(BlockJob):
    """A job that makes the rasters of some blocks."""

    def run(self, share: Share, progress: Progress) -> None:
        """Do it."""
        step, files, has_points = self.output.grid.step, self.output.files, False
        counts = step.counts()
        found: dict[BlockIndex, list[BlockRasters]] = {place: [] for place in files}
        with self.store(share) as store:
            for cloud in self.clouds(progress.part(0.0, 0.5)):
                marks = step.marks(cloud, counts)
                has_points |= bool(marks.selected.any())
                store.append(cloud, marks)
            store.finish(progress.part(0.5, 0.6))
            if has_points:
                rest = progress.part(0.6, 0.95)
                for rasters in step.work(store, share.resources, rest, self._is_wanted):
                    found[self._place_of(rasters.window)].append(rasters)
        progress(1.0)  # ends a job of a run that was cancelled, before it writes
        for place, file in files.items():
            _store(file, found[place])

    def _is_wanted(self, block: Block) -> bool:
        """Return whether a block, or a part of one, is one of this job."""
        return self._place(block) in self.output.files

    def _place(self, block: Block) -> BlockIndex:
        """Return the index of the block that holds a smaller block."""
        share = round(self.output.grid.blocks.side / block.side)
        return BlockIndex(block.column // share, block.row // share)

    def _place_of(self, window: CellWindow) -> BlockIndex:
        """Return the index of the block that holds the centre of the first cell."""
        cell, blocks = self.output.grid.step.cell, self.output.grid.blocks
        return BlockIndex(
            int(blocks.number((window.column + 0.5) * cell)),
            int(blocks.number((window.row + 0.5) * cell)),
        )


def _store(file: Path, rasters: Sequence[BlockRasters]) -> None:
    """Write the rasters of a block, or of its parts."""
    content: dict[str, Any] = {}
    for number, part in enumerate(rasters):
        arrays = {"window": np.array(part.window), "box": part.box, "counts": part.counts}
        arrays |= {f"loose.{name}": places for name, places in part.loose.items()}
        arrays |= {f"layers.{name}": cells for name, cells in part.layers.items()}
        content |= {f"{number}.{name}": array for name, array in arrays.items()}
    with replacing(file) as temporary, temporary.open("wb") as stream:
        np.savez(stream, count=len(rasters), **content)


class _StoredLayers(Dict[str, np.ndarray]):
    """The layers of a part of a block, read from a file of `_store` whenever they are used."""

    def __init__(self, file: Path, start: str) -> None:
        super().__init__()
        self._file, self._start = file, start

    def __missing__(self, name: str) -> np.ndarray:
        with np.load(self._file, allow_pickle=False) as stored:
            return stored[self._start + name]


def _stored_in(file: Path) -> Iterator[BlockRasters]:
    """Yield the rasters that `_store` wrote; their layers stay in the file."""
    with np.load(file, allow_pickle=False) as stored:
        for number in range(int(stored["count"])):
            start = f"{number}.loose."
            loose = {name[len(start) :]: stored[name] for name in stored if name.startswith(start)}
            window, box, counts = (
                stored[f"{number}.{name}"] for name in ("window", "box", "counts")
            )
            layers = _StoredLayers(file, f"{number}.layers.")
            yield BlockRasters(CellWindow(*window.tolist()), layers, loose, box, counts)


def make_rasters(
    survey: Survey,
    folder: Path,
    step: MakeRasters,
    workers: Workers,
    progress: Progress = SILENT,
    results: Results | None = None,
    unpacking: Unpacking | None = None,
) -> RasterSize:
    """Make rasters of a survey of classified files, or of `results`; an error says if a block fails
    or there is no ground, and the workers are stopped.
    """
    # The rasters of blocks go to an existing folder that all workers see. Those that a run left
    # there when it was cancelled or killed are not made again if nothing has changed.
    results = results or Results(survey)
    step = step.placed(survey.crs, survey.box, progress)
    frame = survey_frame(survey.crs, step.origin)
    reading, progress = progress.part(0.0, 0.05), progress.part(0.05, 1.0)
    step = step.seeing(results.parts(unpacking, reading), frame, reading)
    run = _RasterRun(survey, BlockGrid(frame, step, survey.stated), results)
    is_cancelled = False
    files = run.files(folder)
    try:
        jobs = run.jobs(files, workers, unpacking)
        # What was found stays as long as a cancelled run may go on.
        kept = {file for job in jobs for file in job.needs}
        queue = JobQueue(jobs, [], workers, progress.part(0.0, 0.8), kept)
        queue.work()
        if queue.lost:
            raise BareEarthError(f"The rasters cannot be made. {queue.lost[0]}")
        return run.written(files.values(), progress.part(0.8, 1.0))
    except Cancelled:
        is_cancelled = True
        raise
    finally:
        if not is_cancelled:
            for file in files.values():
                remove(file)


class _RasterRun(NamedTuple):
    """A run that makes rasters of a survey."""

    survey: Survey
    grid: BlockGrid
    results: Results

    def files(self, folder: Path) -> dict[BlockIndex, Path]:
        """Return the file for the rasters of each block."""
        survey, grid, results = self
        places = sorted({place for tile in survey.tiles for place in places_of(grid, tile)})
        area = grid.step.area
        if area is not None:
            around = area.buffered_box(AROUND_AREA / grid.frame.horizontal_unit)
            places = grid.among(places, around)
            if not places:
                raise no_point_in(area)
        stamps = {path: stamp_of(source) for path, source in results.read_from.items()}
        grids = [*(found.grid for found in results.found), grid]
        sources = {place: sources_of(grid, survey, place) for place in places}
        return {
            place: block_file(grids, folder, place, [stamps[path] for path in paths])
            for place, paths in sources.items()
        }

    def jobs(
        self, files: Mapping[BlockIndex, Path], workers: Workers, unpacking: Unpacking | None
    ) -> list[RasterJob]:
        """Start the workers, and return the jobs of the blocks that are not done yet."""
        survey, grid, results = self
        missing = [place for place, file in files.items() if not file.exists()]
        least = max((least_memory(grid, survey, place) for place in missing), default=0)
        workers.start(next(iter(files.values())).parent, least, len(missing), 0)
        jobs = []
        for group in grouped(grid, survey, missing, workers.at_once, workers.share.bytes):
            window = grid.window(group)
            paths = {path for place in group for path in sources_of(grid, survey, place)}
            sources = tuple(sorted(results.read_from[path] for path in paths))
            jobs.append(
                RasterJob(
                    output=BlockFiles(grid, {place: files[place] for place in group}),
                    sources=sources,
                    count=points_in(survey, window),
                    before=tuple(found.within(window) for found in results.found),
                    finished=results.finished.intersection(sources),
                    unpacking=unpacking,
                )
            )
        if unpacking is None:
            return jobs
        uses = Counter(path for job in jobs for path in job.sources)
        once = frozenset(path for path, count in uses.items() if count == 1)
        return [
            replace(job, unpacking=unpacking._replace(once=once.intersection(job.sources)))
            for job in jobs
        ]

    def written(self, files: Iterable[Path], progress: Progress) -> RasterSize:
        """Write the rasters, given the files of those of all blocks."""
        blocks = [rasters for file in files for rasters in _stored_in(file)]
        frame, step, per_file = self.grid.frame, self.grid.step, None
        if step.per_file:
            per_file = {split_name(tile.path)[0]: tile.box for tile in self.survey.tiles}
        with Outputs() as outputs:
            return write_rasters(blocks, frame, step, outputs, progress, per_file)
