"""The plan of a run on many files: which blocks and files are to be done, and from what.

Each block of each step has a file for its result, whose name follows from all that the result
depends on: the steps up to this one, the input files, and the version. So what is there already is
not done again.
"""

from __future__ import annotations

import dataclasses
from collections import defaultdict
from pathlib import Path
from types import MappingProxyType
from typing import Any, Iterable, Iterator, Mapping, NamedTuple, Sequence

from ..core.errors import BareEarthError
from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud, survey_frame
from ..las.lasfile import LasFile
from ..las.reading import read_parts
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
from .jobs import BlockJob, PointJob, TileJob
from .manifest import Fingerprint, block_file, fingerprint_of, read_record, remove_record, stamp_of
from .step import PointStep
from .unpacking import Unpacking
from .values import BlockFiles, BlockValues, numbered, with_values
from .workers import Workers


class _Wanted(NamedTuple):
    """A block of one of the steps, which are counted from 0."""

    step: int
    place: BlockIndex


class Plan:
    """What a run of steps, which see what those before them found, has to do on many files."""

    def __init__(
        self,
        survey: Survey,
        targets: dict[Path, Path],
        steps: Sequence[PointStep],
        folder: Path,
        progress: Progress = SILENT,
    ) -> None:
        self._survey, self._targets, self._steps, self._folder = survey, targets, steps, folder
        frame = survey_frame(survey.crs)
        self._grids = [BlockGrid(frame, step.blocks, survey.stated) for step in steps]
        # Taken before any of them is read.
        self._stamps = {tile.path: stamp_of(tile.path) for tile in survey.tiles}
        self._places: dict[tuple[int, Path], list[BlockIndex]] = {}
        self._needed: dict[_Wanted, frozenset[_Wanted]] = {}
        self._inputs: dict[_Wanted, frozenset[Path]] = {}
        # Those of several blocks, which many small files share.
        self._together: dict[tuple[_Wanted, ...], list[Path]] = {}
        self._files: dict[_Wanted, Path] = {}
        self.kept: list[Any] = []  # summaries of the outputs that an earlier run finished
        self.failures: dict[Path, str] = {}  # why files cannot be done
        skipped = {tile.path for tile in survey.tiles if any(step.skips(tile) for step in steps)}
        # files of which no point is to be written, by their headers
        self.empty_count = len(skipped)
        # Their points take part only in the first step.
        self._seen = dataclasses.replace(
            survey, tiles=tuple(tile for tile in survey.tiles if tile.path not in skipped)
        )
        self.todo: list[LasFile] = []  # the files that are to be done
        for number, tile in enumerate(self._seen.tiles, start=1):
            try:
                for step in steps:
                    step.check_tile(tile)
                self._inputs_of(tile)
                self.todo.append(tile)
            except BareEarthError as error:
                self.failures[tile.path] = str(error)
            progress(number / len(self._seen.tiles))

    def keep_finished(self, resume: bool, progress: Progress) -> None:
        """Remove files whose outputs an earlier run finished from those to do, if `resume`."""
        todo, changed = [], 0
        for tile in self.todo:
            target = self._targets[tile.path]
            before = read_record(target) if resume else None
            if before is not None and before[0] == self._fingerprint(tile):
                self.kept.append(self._steps[0].summary_type(**before[1]))
                continue
            changed += before is not None
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
        """Start the workers, which all see the folder `outputs`, and return the jobs of the blocks,
        and those that write the files.
        """
        missing = self._missing()
        least = [
            least_memory(self._grids[number], self._survey, place) for number, place in missing
        ]
        workers.start(outputs, max(least, default=0), len(missing), len(self.todo))
        blocks: list[BlockJob] = []
        for number, step in enumerate(self._steps):
            grid, survey = self._grids[number], self._survey if number == 0 else self._seen
            places = [wanted.place for wanted in missing if wanted.step == number]
            groups = grouped(grid, survey, places, workers.at_once, workers.share.bytes)
            for group in groups:
                wanted = [_Wanted(number, place) for place in group]
                files = tuple(map(self._file, wanted))
                sources = tuple(sorted({path for block in wanted for path in self._sources(block)}))
                needed = set().union(*map(self._needs, wanted))
                blocks.append(
                    PointJob(
                        grid, tuple(group), files, sources, points_in(survey, grid.window(group)),
                        self._block_files(needed), frozenset(), unpacking, step,
                    )
                )  # fmt: skip
        tiles = [
            TileJob(
                tile, self._targets[tile.path], self._block_files(self._wanted(tile)),
                self._fingerprint(tile), unpacking,
            )
            for tile in self.todo
        ]  # fmt: skip
        return blocks, tiles

    def _missing(self) -> list[_Wanted]:
        """Return the blocks whose results are needed and not there."""
        todo = {wanted for tile in self.todo for wanted in self._wanted(tile)}
        missing = set()
        while todo:
            wanted = todo.pop()
            if wanted not in missing and not self._file(wanted).exists():
                missing.add(wanted)
                todo |= self._needs(wanted)
        return sorted(missing)

    def _block_files(self, some: Iterable[_Wanted]) -> tuple[BlockFiles, ...]:
        """Return the files of some blocks, by their steps."""
        files: dict[int, dict[BlockIndex, Path]] = defaultdict(dict)
        for wanted in sorted(some):
            files[wanted.step][wanted.place] = self._file(wanted)
        return tuple(
            BlockFiles(self._grids[number], self._steps[number], files[number]) for number in files
        )

    def _wanted(self, tile: LasFile) -> list[_Wanted]:
        """Return the blocks of all steps that may hold points of a file."""
        steps = range(len(self._steps))
        return [_Wanted(step, place) for step in steps for place in self._touched(step, tile)]

    def _touched(self, number: int, tile: LasFile) -> list[BlockIndex]:
        """Return the blocks of a step that may hold points of a file."""
        key = number, tile.path
        if key not in self._places:
            self._places[key] = places_of(self._grids[number], tile)
        return self._places[key]

    def _sources(self, wanted: _Wanted) -> list[Path]:
        """Return the files with points that a block may need."""
        survey = self._survey if wanted.step == 0 else self._seen
        return sources_of(self._grids[wanted.step], survey, wanted.place)

    def _needs(self, wanted: _Wanted) -> frozenset[_Wanted]:
        """Return the blocks of earlier steps whose results a block needs."""
        if wanted not in self._needed:
            window = self._grids[wanted.step].window([wanted.place])
            self._needed[wanted] = frozenset(self._round(window, wanted.step))
        return self._needed[wanted]

    def _round(self, box: Box, before: int) -> Iterator[_Wanted]:
        """Yield the blocks of steps that change classes, before one of them, within a box."""
        tiles = self._seen.touching(box)
        for number in range(before):
            if self._steps[number].gives_classes:
                columns, rows = self._grids[number].places_in(box)
                for tile in tiles:
                    for place in self._touched(number, tile):
                        if place.column in columns and place.row in rows:
                            yield _Wanted(number, place)

    def _inputs_of(self, tile: LasFile) -> list[Path]:
        """Return the files that affect the output of a file."""
        together = tuple(self._wanted(tile))
        if together not in self._together:
            every = set().union(*map(self._all_sources, together))
            self._together[together] = sorted(every)
        return self._together[together]

    def _all_sources(self, wanted: _Wanted) -> frozenset[Path]:
        """Return the files that affect the result of a block."""
        if wanted not in self._inputs:
            earlier = map(self._all_sources, self._needs(wanted))
            self._inputs[wanted] = frozenset(self._sources(wanted)).union(*earlier)
        return self._inputs[wanted]

    def _file(self, wanted: _Wanted) -> Path:
        """Return the file for the result of a block."""
        if wanted not in self._files:
            stamps = map(self._stamps.__getitem__, sorted(self._all_sources(wanted)))
            self._files[wanted] = block_file(
                self._grids[: wanted.step + 1], self._steps[: wanted.step + 1], self._folder,
                wanted.place, stamps,
            )  # fmt: skip
        return self._files[wanted]

    def _fingerprint(self, tile: LasFile) -> Fingerprint:
        """Return what the output of a file is made from."""
        stamps = map(self._stamps.__getitem__, self._inputs_of(tile))
        return fingerprint_of(self._grids, self._steps, tile.path, stamps, self._targets[tile.path])

    def files_kept(self) -> list[Path]:
        """Return the results of blocks that rasters need after all files are written."""
        return [
            self._file(wanted)
            for tile in self.todo
            for wanted in set(self._wanted(tile))
            if self._steps[wanted.step].gives_classes
        ]

    def results(self, outputs: Survey) -> Results:
        """Return where to read the points that rasters are made from."""
        inputs = {self._targets[tile.path].name: tile for tile in self._seen.tiles}
        wanted, read_from = set(), {}
        for output in outputs.tiles:
            tile = inputs[output.path.name]
            needed = [
                block for block in self._wanted(tile) if self._steps[block.step].gives_classes
            ]
            # Of a file that an earlier run finished there is only the output.
            if all(self._file(block).exists() for block in needed):
                read_from[output.path] = tile
                wanted.update(needed)
        return Results(outputs, read_from, self._block_files(wanted))


class Results:
    """Where to read the points of a survey with what was found for them: from its files, or from
    `inputs` that can be read in place of these.
    """

    def __init__(
        self,
        survey: Survey,
        inputs: Mapping[Path, LasFile] = MappingProxyType({}),
        found: tuple[BlockFiles, ...] = (),
    ) -> None:
        self._survey, self._inputs, self.found = survey, inputs, found
        self.read_from = {tile.path: inputs.get(tile.path, tile).path for tile in survey.tiles}
        self.finished = frozenset(self.read_from) - inputs.keys()

    def parts(
        self, unpacking: Unpacking | None = None, progress: Progress = SILENT
    ) -> Iterator[PointCloud]:
        """Yield the points of all files, part by part."""
        tiles = self._survey.tiles
        for tile, part in zip(tiles, progress.shares(*[1.0] * len(tiles))):
            las, values = self._inputs.get(tile.path, tile), []
            if tile.path in self._inputs:
                values = [BlockValues(found, las, are_all=False) for found in self.found]
            if unpacking is not None:
                las = unpacking.of(las, part.quiet())
            parts = numbered(read_parts(las, part.quiet()))
            yield from (some for _, some in with_values(parts, values))
