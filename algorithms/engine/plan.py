"""The plan of a run on many files: which blocks and files are to be done, and from which inputs.

The result of a block of a step has a file of its own. Its name depends on everything that the
result depends on: the steps up to this one, the input files, and the version. So a result that
exists already is not computed again.
"""

from __future__ import annotations

import dataclasses
from collections import defaultdict
from functools import cached_property, partial
from operator import attrgetter
from pathlib import Path
from typing import Callable, Iterable, Mapping, Sequence

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..las.cloud import survey_frame
from ..las.lasfile import LasFile
from ..survey.area import Area
from ..survey.files import Survey
from .block_grid import (
    BlockGrid,
    BlockIndex,
    grouped,
    least_memory,
    places_of,
    points_in,
    sources_of,
)
from .jobs import BlockJob, TileJob
from .manifest import (
    Fingerprint,
    Stamp,
    block_file,
    fingerprint_of,
    read_record,
    remove_record,
    stamp_of,
)
from .results import Results
from .step import OUTSIDE, PointStep
from .summary import TileSummary
from .unpacking import Unpacking
from .values import BlockFiles
from .workers import Workers


class _PlannedBlock:
    """A block of a step of a plan, and what its result depends on."""

    # `step` is the number of the step, from 0.
    def __init__(self, plan: Plan, step: int, place: BlockIndex) -> None:
        self._plan, self.step, self.place = plan, step, place
        self._grid, self._survey = plan.grids[step], plan.surveys[step]

    @property
    def key(self) -> tuple[int, BlockIndex]:
        return self.step, self.place

    @cached_property
    def sources(self) -> list[Path]:
        return sources_of(self._grid, self._survey, self.place)

    @cached_property
    def needs(self) -> frozenset[_PlannedBlock]:
        """The blocks of earlier steps that change classes, whose results this block needs."""
        box, plan = self._grid.window([self.place]), self._plan
        tiles, blocks = plan.near_survey.touching(box), []
        for number in range(self.step):
            if not plan.steps[number].gives_classes:
                continue
            places = {place for tile in tiles for place in plan.places_of(tile, number)}
            blocks += [plan.block(number, place) for place in plan.grids[number].among(places, box)]
        return frozenset(blocks)

    @cached_property
    def inputs(self) -> frozenset[Path]:
        """The files that affect the result."""
        return frozenset(self.sources).union(*(block.inputs for block in self.needs))

    @cached_property
    def file(self) -> Path:
        """The file for the result."""
        plan, end = self._plan, self.step + 1
        stamps = plan.stamps_of(self.inputs)
        return block_file(plan.grids[:end], plan.folder, self.place, stamps)


class Plan:
    """The blocks and files that a run of steps on many files has to do."""

    def __init__(
        self,
        survey: Survey,
        targets: dict[Path, Path],
        steps: Sequence[PointStep],
        folder: Path,
        progress: Progress = SILENT,
        has_sinks: bool = False,
    ) -> None:
        self.steps, self.folder, self._targets = steps, folder, targets
        # Only points in the area of the first step get values; points round it are context.
        self._area = steps[0].area
        # Whether sinks need results that the outputs do not have.
        self._needs_context = has_sinks and self._area is not None
        frame = survey_frame(survey.crs)
        self.grids = [BlockGrid(frame, step, survey.stated) for step in steps]
        # Taken before any file is read.
        self._stamps = {tile.path: stamp_of(tile.path) for tile in survey.tiles}
        self._blocks: dict[tuple[int, BlockIndex], _PlannedBlock] = {}
        self._places: dict[tuple[Path, int], list[BlockIndex]] = {}
        # What `_inputs_of` returns, by blocks: many small files touch the same blocks.
        self._inputs: dict[tuple[_PlannedBlock, ...], list[Path]] = {}
        self.kept: list[TileSummary] = []  # of the outputs that an earlier run finished
        self.failures: dict[Path, str] = {}  # why files cannot be done
        # Files without a point to write, as their headers show.
        self.empty = [
            tile
            for tile in survey.tiles
            if OUTSIDE in steps[0].changes and not self._is_near(tile, 0.0)
        ]
        skipped = {tile.path for tile in self.empty}
        seen = [tile for tile in survey.tiles if tile.path not in skipped]
        # The points of the others take part only in the first step.
        shown = (t for t in survey.tiles if t.path not in skipped or self._is_near(t))
        self.near_survey = dataclasses.replace(survey, tiles=tuple(shown))
        self.surveys = [survey, *[self.near_survey] * (len(steps) - 1)]
        self.todo: list[LasFile] = []  # the files that are to be done
        for number, tile in enumerate(seen, start=1):
            try:
                for step in steps:
                    step.check_file(tile)
                self._inputs_of(tile)
                self.todo.append(tile)
            except BareEarthError as error:
                self.failures[tile.path] = str(error)
            progress(number / len(seen))

    def stamps_of(self, paths: Iterable[Path]) -> list[Stamp]:
        return [self._stamps[path] for path in sorted(paths)]

    def block(self, step: int, place: BlockIndex) -> _PlannedBlock:
        return self._blocks.setdefault((step, place), _PlannedBlock(self, step, place))

    def places_of(self, tile: LasFile, step: int) -> list[BlockIndex]:
        key = tile.path, step
        if key not in self._places:
            self._places[key] = places_of(self.grids[step], tile)
        return self._places[key]

    def _blocks_of(self, tile: LasFile) -> list[_PlannedBlock]:
        """Return the blocks of all steps that may hold points of a file."""
        steps = range(len(self.steps))
        return [self.block(step, place) for step in steps for place in self.places_of(tile, step)]

    def _inputs_of(self, tile: LasFile) -> list[Path]:
        together = tuple(self._blocks_of(tile))
        if together not in self._inputs:
            self._inputs[together] = sorted(set().union(*(block.inputs for block in together)))
        return self._inputs[together]

    def _fingerprint(self, tile: LasFile) -> Fingerprint:
        stamps, target = self.stamps_of(self._inputs_of(tile)), self._targets[tile.path]
        return fingerprint_of(self.grids, tile.path, stamps, target)

    def keep_finished(self, resume: bool, progress: Progress) -> None:
        """If `resume`, do not do files whose outputs an earlier run finished."""
        todo, changed = [], 0
        for tile in self.todo:
            target = self._targets[tile.path]
            record = read_record(target) if resume else None
            if record is not None and record[0] == self._fingerprint(tile):
                self.kept.append(self.steps[0].summary_type(**record[1]))
                continue
            changed += record is not None
            remove_record(target)
            todo.append(tile)
        self.todo = todo
        if self.kept:
            progress.info(f"{len(self.kept):,} files are done already.")
        if changed:
            progress.info(
                f"{changed:,} finished files are made again, because parameters, inputs or the"
                " version have changed."
            )

    def jobs(
        self, workers: Workers, outputs: Path, unpacking: Unpacking | None
    ) -> tuple[list[BlockJob], list[TileJob]]:
        """Start the workers, which all see the folder `outputs`; return the jobs on blocks, and the
        jobs that write files.
        """
        missing = self._missing()
        least = [
            least_memory(self.grids[block.step], self.surveys[block.step], block.place)
            for block in missing.values()
        ]
        workers.start(outputs, max(least, default=0), len(missing), len(self.todo))
        blocks: list[BlockJob] = []
        for number, (grid, survey) in enumerate(zip(self.grids, self.surveys)):
            of_step = {block.place: block for block in missing.values() if block.step == number}

            blocks += block_jobs(
                grid, survey, {place: block.file for place, block in of_step.items()},
                {place: block.sources for place, block in of_step.items()},
                partial(self._files_before, of_step), workers, unpacking,
            )  # fmt: skip
        tiles = [
            TileJob(
                self._files_of(self._blocks_of(tile)), unpacking, tile, self._targets[tile.path],
                self._fingerprint(tile),
            )
            for tile in self.todo
        ]  # fmt: skip
        return blocks, tiles

    def _files_before(
        self, blocks: Mapping[BlockIndex, _PlannedBlock], group: Iterable[BlockIndex]
    ) -> tuple[BlockFiles, ...]:
        """Return the results of earlier steps that a group of blocks needs."""
        return self._files_of(set().union(*(blocks[place].needs for place in group)))

    def _missing(self) -> dict[tuple[int, BlockIndex], _PlannedBlock]:
        """Return the blocks whose results are needed but do not exist, sorted by their keys."""
        todo = {block for tile in self.todo for block in self._blocks_of(tile)}
        todo.update(block for tile in self._only_context() for block in self._with_classes(tile))
        missing = {}
        while todo:
            block = todo.pop()
            if block.key not in missing and not block.file.exists():
                missing[block.key] = block
                todo |= block.needs
        return dict(sorted(missing.items()))

    def _files_of(self, blocks: Iterable[_PlannedBlock]) -> tuple[BlockFiles, ...]:
        """Return the files of some blocks, by their steps."""
        files: dict[int, dict[BlockIndex, Path]] = defaultdict(dict)
        for block in sorted(blocks, key=attrgetter("key")):
            files[block.step][block.place] = block.file
        return tuple(BlockFiles(self.grids[number], files[number]) for number in files)

    def _with_classes(self, tile: LasFile) -> list[_PlannedBlock]:
        """Return the blocks of a file whose results later steps and rasters need."""
        return [block for block in self._blocks_of(tile) if self.steps[block.step].gives_classes]

    def files_for_sinks(self) -> list[Path]:
        """Return the results of blocks that rasters need after all files are written."""
        tiles = [*self.todo, *self._only_context()]
        return [block.file for tile in tiles for block in self._with_classes(tile)]

    def _only_context(self) -> list[LasFile]:
        """Return the files that are not to be done, but whose results sinks need."""
        if not self._needs_context:
            return []
        others = {tile.path for tile in self.todo}.union(self.failures)
        tiles = (tile for tile in self.near_survey.tiles if tile.path not in others)
        return [tile for tile in tiles if self._is_near(tile)]

    def _is_near(self, tile: LasFile, distance: float | None = None) -> bool:
        """Return whether a file may have points in the area, or up to a distance in metres from it,
        by default as far as points matter to the first step.
        """
        if self._area is None:
            return True
        grid = self.grids[0]
        distance = grid.blocks.buffer if distance is None else distance
        box = self._area.buffered_box(distance / grid.frame.horizontal_unit)
        return Area(box).may_touch(tile.outer_box)

    def results(self, outputs: Survey, empty: Iterable[LasFile]) -> Results:
        """Return where to read the points that rasters are made from, given the files that were
        written, and the files without a point to write.
        """
        inputs = {self._targets[tile.path].name: tile for tile in self.near_survey.tiles}
        needed, read_from = set(), {}
        for output in outputs.tiles:
            tile = inputs[output.path.name]
            blocks = self._with_classes(tile)
            # Of a file that an earlier run finished, only the output exists.
            if all(block.file.exists() for block in blocks):
                read_from[output.path] = tile
                needed.update(blocks)
        shown, unwritten = {tile.path for tile in self.near_survey.tiles}, []
        for tile in empty if self._needs_context else ():
            blocks = self._with_classes(tile)
            if tile.path in shown and all(block.file.exists() for block in blocks):
                read_from[tile.path] = tile
                needed.update(blocks)
                unwritten.append(tile)
        survey = dataclasses.replace(outputs, tiles=(*outputs.tiles, *unwritten))
        return Results(survey, read_from, self._files_of(needed))


def block_jobs(
    grid: BlockGrid,
    survey: Survey,
    files: Mapping[BlockIndex, Path],
    sources: Mapping[BlockIndex, Iterable[Path]],
    before: Callable[[Sequence[BlockIndex]], tuple[BlockFiles, ...]],
    workers: Workers,
    unpacking: Unpacking | None,
) -> list[BlockJob]:
    """Return jobs on groups of blocks, given for each block the file for its result and the files
    with its points; `before` returns the results of earlier steps that a group needs.
    """
    return [
        BlockJob(
            output=BlockFiles(grid, {place: files[place] for place in group}),
            sources=tuple(sorted({path for place in group for path in sources[place]})),
            count=points_in(survey, grid.window(group)),
            before=before(group),
            unpacking=unpacking,
        )
        for group in grouped(grid, survey, list(files), workers.at_once, workers.share.bytes)
    ]
