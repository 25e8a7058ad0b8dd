"""The run of a step over many files: which of them are to be done, and by which jobs."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any, NamedTuple

from ..core.errors import BareEarthError
from ..core.files import alone_in, describe_write_error
from ..core.progress import Progress
from ..core.temporary import remove_leftovers
from ..las.cloud import survey_frame
from ..las.lasfile import LasFile
from ..survey.files import Survey, open_survey
from .block_grid import BlockGrid, BlockIndex, places_of, sources_of
from .job_queue import JobQueue
from .jobs import PointJob, TileJob
from .planning import block_jobs
from .raster_jobs import make_rasters
from .rasters import MakeRasters
from .record import Record, folders_of, label_file, made_of, read_record, remove_record, state_of
from .steps import PointStep
from .workers import Workers


class _Needs(NamedTuple):
    """A tile, the blocks that may hold its points, and the files that these need."""

    tile: LasFile
    places: list[BlockIndex]
    sources: list[Path]


class TileRun:
    """Writes the files of a survey into a folder, with what a step finds of their points.

    Parameters
    ----------
    survey : Survey
        The files.
    folder : Path
        That of the outputs.
    targets : dict of Path to Path
        The output of each input.
    step : PointStep
        What is to be found.
    progress : Progress
        Receives progress, and a line on each finished file.

    Attributes
    ----------
    done : list
        What became of the files that are done, by their names.
    kept_count : int
        How many of them a run before had done.
    empty_count : int
        Files of which there is nothing to write.
    failures : dict of Path to str
        Files that cannot be done, and why.
    """

    def __init__(
        self,
        survey: Survey,
        folder: Path,
        targets: dict[Path, Path],
        step: PointStep,
        progress: Progress,
    ) -> None:
        self.done: list[Any] = []
        self.kept_count, self.empty_count, self.failures = 0, 0, {}
        self._grid = BlockGrid(survey_frame(survey.crs), step.blocks)
        self._survey, self._folder, self._targets = survey, folder, targets
        self._step, self._progress = step, progress
        self._sources: dict[BlockIndex, list[Path]] = {}
        # Those of several blocks, which many small tiles share.
        self._together: dict[tuple[BlockIndex, ...], list[Path]] = {}
        # As they are before any of them is read.
        self._states = {each.path: state_of(each.path) for each in survey.tiles}
        self._todo: list[_Needs] = []
        for number, tile in enumerate(survey.tiles, start=1):
            if step.skips(tile):
                self.empty_count += 1
                continue
            try:
                step.check_tile(tile)
                self._todo.append(self._needs(tile))
            except BareEarthError as error:
                self.failures[tile.path] = str(error)
            progress(0.02 * number / len(survey.tiles))

    def work(self, workers: Workers, resume: bool, rasters: MakeRasters | None = None) -> None:
        """Do it.

        Parameters
        ----------
        workers : Workers
            Who does it; they are stopped afterwards.
        resume : bool
            Whether files that a run before has done stay.
        rasters : MakeRasters, optional
            Rasters to make of the outputs.

        Raises
        ------
        BareEarthError
            If the folder cannot be written, or a raster cannot be made.
        Cancelled
            If the user asked to stop.
        """
        _, records, waiting = folders_of(self._folder)
        progress = self._progress
        _make(self._folder, records)
        with alone_in(records):
            self._clear(values=not resume)
            _make(waiting)
            kept = self._keep_done(resume)
            blocks, tiles = self._jobs(workers)
            end = 0.8 if rasters else 1.0
            queue = JobQueue(blocks, tiles, workers, progress.part(0.02, end))
            queue.work()
            self.done, self.kept_count = sorted([*kept, *queue.done]), len(kept)
            self.empty_count += queue.empty_count
            self.failures.update(queue.failures)
            if self.done and rasters is not None:
                paths = [self._folder / each.name for each in self.done]
                made = open_survey(paths, progress=progress.quiet())
                make_rasters(made, waiting, rasters, workers, progress.part(end, 1.0))
            self._clear(values=True)

    def _clear(self, values: bool) -> None:
        """Remove what a killed run left, and all that was found in blocks if wanted."""
        folders = folders_of(self._folder)
        if values:
            shutil.rmtree(folders[2], ignore_errors=True)
        for each in folders:
            remove_leftovers(each)

    def _needs(self, tile: LasFile) -> _Needs:
        places = places_of(self._grid, tile)
        for place in places:
            if place not in self._sources:
                self._sources[place] = sources_of(self._grid, self._survey, place)
        together = tuple(places)
        if together not in self._together:
            every = {path for place in places for path in self._sources[place]}
            self._together[together] = sorted(every)
        return _Needs(tile, places, self._together[together])

    def _made_of(self, needs: _Needs) -> Record:
        path = needs.tile.path
        sources = map(self._states.__getitem__, needs.sources)
        return made_of(self._grid, self._step, path, sources, self._targets[path])

    def _keep_done(self, resume: bool) -> list[Any]:
        """Take out the tiles that are done; return what became of them."""
        kept, todo, changed = [], [], 0
        for needs in self._todo:
            target = self._targets[needs.tile.path]
            before = read_record(target) if resume else None
            if before is not None and before[0] == self._made_of(needs):
                kept.append(self._step.summary_type(**before[1]))
                continue
            changed += before is not None
            remove_record(target)
            todo.append(needs)
        self._todo = todo
        if kept:
            self._progress.info(f"{len(kept):,} files are done already.")
        if changed:
            self._progress.info(
                f"{changed:,} finished files are made again, because parameters, inputs or the"
                " version have changed."
            )
        return kept

    def _jobs(self, workers: Workers) -> tuple[list[PointJob], list[TileJob]]:
        """Return the jobs for all that is to be done, and let the workers begin."""
        grid, survey, step = self._grid, self._survey, self._step
        places = sorted({place for needs in self._todo for place in needs.places})
        waiting = folders_of(self._folder)[2]
        files = {
            each: label_file(grid, step, waiting, each, map(self._states.get, self._sources[each]))
            for each in places
        }
        tiles = [
            TileJob(
                grid,
                step,
                needs.tile,
                self._targets[needs.tile.path],
                tuple(needs.places),
                tuple(files[each] for each in needs.places),
                self._made_of(needs),
            )
            for needs in self._todo
        ]
        missing = {each: files[each] for each in places if not files[each].exists()}
        blocks = block_jobs(
            PointJob, grid, survey, missing, self._folder, len(tiles), workers, step=step
        )
        return blocks, tiles


def _make(folder: Path, *within: Path) -> None:
    """Make the folder of the output, and others within it."""
    try:
        for each in (folder, *within):
            each.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise describe_write_error(folder, error) from error
