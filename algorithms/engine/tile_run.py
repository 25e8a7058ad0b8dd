"""Runs a step on many files: finds which ones are to be done, and makes their jobs."""

from __future__ import annotations

import shutil
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterable, NamedTuple, Sequence

from ..core.errors import BareEarthError
from ..core.files import alone_in, write_errors_told
from ..core.progress import SILENT, Progress
from ..core.temporary import remove_leftovers
from ..las.cloud import survey_frame
from ..las.lasfile import LasFile
from ..survey.files import Survey, open_survey
from .block_grid import BlockGrid, BlockIndex, places_of, sources_of
from .job_queue import JobQueue, block_jobs
from .jobs import PointJob, Taken, TileJob
from .manifest import (
    Fingerprint,
    block_file,
    fingerprint_of,
    folders_of,
    read_record,
    remove_record,
    stamp_of,
)
from .raster_jobs import make_rasters
from .rasters import MakeRasters
from .steps import PointStep
from .workers import Workers


class _Needs(NamedTuple):
    """A tile, the blocks that it touches, and the files that these blocks need."""

    tile: LasFile
    places: list[BlockIndex]
    sources: list[Path]


@dataclass(frozen=True)
class Task:
    """What one of several steps has to do.

    Attributes
    ----------
    only : frozenset of str, or None
        Names of the files to do; None for all.
    fingerprints : dict of str to Fingerprint
        Records of the outputs by the names of the files, if they do not follow from these files.
    kept : list
        Summaries of the outputs that an earlier run finished.
    """

    only: frozenset[str] | None = None
    fingerprints: dict[str, Fingerprint] = field(default_factory=dict)
    kept: list[Any] = field(default_factory=list)


class TileRun:
    """Runs a step on the files of a survey, and writes them into a folder with the results.

    Parameters
    ----------
    survey : Survey
        The files.
    folder : Path
        The folder of the outputs.
    targets : dict of Path to Path
        The output of each input.
    step : PointStep
        The step that finds the values.
    progress : Progress
        Receives progress, and a line on each finished file.
    task : Task
        Which files are to be done.

    Attributes
    ----------
    done : list
        Summaries of the finished files, sorted by their names.
    kept_count : int
        How many of them an earlier run finished.
    empty_count : int
        Number of files with nothing to write.
    failures : dict of Path to str
        Files that cannot be done, and why.
    taken : list of Taken
        What the jobs took.
    """

    def __init__(
        self,
        survey: Survey,
        folder: Path,
        targets: dict[Path, Path],
        step: PointStep,
        progress: Progress,
        task: Task = Task(),
    ) -> None:
        self.done: list[Any] = []
        self.kept_count, self.empty_count, self.failures = 0, 0, {}
        self.taken: list[Taken] = []
        self._grid = BlockGrid(survey_frame(survey.crs), step.blocks, survey.stated)
        self._survey, self._folder, self._targets = survey, folder, targets
        self._step, self._progress, self._task = step, progress, task
        self._sources: dict[BlockIndex, list[Path]] = {}
        # Those of several blocks, which many small tiles share.
        self._together: dict[tuple[BlockIndex, ...], list[Path]] = {}
        # Taken before any of them is read.
        self._stamps = {each.path: stamp_of(each.path) for each in survey.tiles}
        self._todo: list[_Needs] = []
        for number, tile in enumerate(survey.tiles, start=1):
            if step.skips(tile):
                self.empty_count += 1
                continue
            try:
                step.check_tile(tile)
                if task.only is None or tile.path.name in task.only:
                    self._todo.append(self._needs(tile))
            except BareEarthError as error:
                self.failures[tile.path] = str(error)
            progress(0.02 * number / len(survey.tiles))

    def work(self, workers: Workers, resume: bool, rasters: MakeRasters | None = None) -> None:
        """Do it.

        Parameters
        ----------
        workers : Workers
            The workers, which are stopped at the end.
        resume : bool
            Whether outputs that an earlier run finished are kept.
        rasters : MakeRasters, optional
            Rasters to make from the outputs.

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
            self.taken = queue.taken
            if self.done and rasters is not None:
                paths = [self._folder / each.name for each in self.done]
                made = open_survey(paths, progress=progress.quiet(), stated=self._survey.stated)
                make_rasters(made, waiting, rasters, workers, progress.part(end, 1.0))
            self._clear(values=True)

    def _clear(self, values: bool) -> None:
        """Remove what killed runs left, and the results of blocks if `values`."""
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

    @property
    def sources(self) -> dict[Path, list[Path]]:
        """The files that affect each file that is to be done."""
        return {needs.tile.path: needs.sources for needs in self._todo}

    def fingerprint(self, tile: Path, sources: Iterable[Path]) -> Fingerprint:
        """Return the record of the output of a file, given the files that affect it."""
        stamps = map(self._stamps.__getitem__, sources)
        return fingerprint_of(self._grid, self._step, tile, stamps, self._targets[tile])

    def _fingerprint(self, needs: _Needs) -> Fingerprint:
        path = needs.tile.path
        return self._task.fingerprints.get(path.name) or self.fingerprint(path, needs.sources)

    def _keep_done(self, resume: bool) -> list[Any]:
        """Remove finished tiles from those to do; return their summaries."""
        kept, todo, changed = [*self._task.kept], [], 0
        for needs in self._todo:
            target = self._targets[needs.tile.path]
            before = read_record(target) if resume else None
            if before is not None and before[0] == self._fingerprint(needs):
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
        """Return the jobs for the tiles to do and their blocks, and start the workers."""
        grid, survey, step = self._grid, self._survey, self._step
        places = sorted({place for needs in self._todo for place in needs.places})
        waiting = folders_of(self._folder)[2]
        files = {
            each: block_file(grid, step, waiting, each, map(self._stamps.get, self._sources[each]))
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
                self._fingerprint(needs),
            )
            for needs in self._todo
        ]
        missing = {each: files[each] for each in places if not files[each].exists()}
        where = missing, self._sources, self._folder
        blocks = block_jobs(PointJob, grid, survey, *where, len(tiles), workers, step=step)
        return blocks, tiles


def tasks_of(
    survey: Survey,
    steps: Sequence[PointStep],
    targets: Sequence[dict[Path, Path]],
    resume: bool,
) -> list[Task]:
    """Return what each of several steps has to do. Each reads the outputs of the one before.

    These are removed at the end. So the record of a final output names the inputs of the first
    step, and a step is repeated only for the files that the steps after it still need.

    Parameters
    ----------
    survey : Survey
        The inputs of the first step.
    steps : sequence of PointStep
        The steps.
    targets : sequence of dict of Path to Path
        The outputs of each step, by the inputs of the first.
    resume : bool
        Whether outputs that an earlier run finished are kept.
    """
    if len(steps) == 1:
        return [Task()]
    runs = [
        TileRun(survey, next(iter(where.values())).parent, where, step, SILENT)
        for step, where in zip(steps, targets)
    ]
    sources = [run.sources for run in runs]
    records, kept, todo = {}, [], []
    for path in set.intersection(*(set(of_step) for of_step in sources)):
        record = _record_of(path, runs, sources)
        before = read_record(targets[-1][path]) if resume else None
        if before is not None and before[0] == record:
            kept.append(steps[-1].summary_type(**before[1]))
        else:
            todo.append(path)
        records[path.name] = record
    if not kept:
        return [*(Task() for _ in steps[1:]), Task(fingerprints=records)]
    tasks = [Task(frozenset(path.name for path in todo), records, kept)]
    needed = set(todo)
    for of_step, of_next in zip(sources[-2::-1], sources[:0:-1]):
        needed = {path for each in needed for path in of_next[each] if path in of_step}
        refused = of_step.keys() - of_next.keys()
        tasks.insert(0, Task(frozenset(path.name for path in needed | refused)))
    return tasks


def _record_of(
    path: Path, runs: Sequence[TileRun], sources: Sequence[dict[Path, list[Path]]]
) -> Fingerprint:
    """Return the record of a final output: of all steps, and of the files of the first one."""
    files = {path}
    for of_step in reversed(sources):
        files = {file for each in files for file in of_step.get(each, ())}
    record = runs[-1].fingerprint(path, sorted(files))
    within = record
    for run in runs[-2::-1]:
        within["before"] = run.fingerprint(path, ())
        within = within["before"]
    return record


def _make(folder: Path, *within: Path) -> None:
    """Make the folder of the outputs, and folders within it."""
    with write_errors_told(folder):
        for each in (folder, *within):
            each.mkdir(parents=True, exist_ok=True)
