"""From the files of a survey to classified ones without a seam, however many there are."""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterable, NamedTuple, Sequence

from ..core.errors import BareEarthError
from ..core.files import (
    alone_in,
    check_output,
    describe_write_error,
    is_same_file,
    remove_leftovers,
)
from ..core.parameters import ParameterSet
from ..core.progress import SILENT, Progress, Unsaid
from ..las.records import check_class
from ..las.writing import check_writable
from ..survey.collection import Collection, Tile, open_collection
from ..survey.selection import Selection
from ..survey.vpc import SUFFIX as VPC_SUFFIX
from ..survey.vpc import write_vpc
from .blocks import Blocks
from .ground import blocks_of
from .job_queue import JobQueue
from .jobs import ClassJob, LabelJob, TileSummary
from .options import TileInput, TileOutput
from .planning import block_jobs
from .raster_jobs import make_rasters
from .rasters import RasterFiles, RasterPoints, RasterRequest
from .record import folders_of, label_file, made_of, read_record, remove_record, state_of
from .survey import BlockIndex, Survey, frame_of, places_of
from .workers import Threads, Workers

VPC_NAME = "classified.vpc"
_COPC = ".copc.laz"


@dataclass(frozen=True)
class TilesSummary:
    """What became of a survey.

    Attributes
    ----------
    tile_count : int
        Files of the survey.
    done_count : int
        Those that are classified, in this run or before it.
    kept_count : int
        Those that a run before had classified.
    point_count, ground_count : int
        Points of the classified files, and those of the target class.
    failures : dict of str to str
        Why the others are not, by their paths.
    vpc : str
        The virtual point cloud of all that are.
    """

    tile_count: int
    done_count: int
    kept_count: int
    point_count: int
    ground_count: int
    failures: dict[str, str]
    vpc: str

    @property
    def text(self) -> str:
        """The counts in words."""
        share = self.ground_count / max(self.point_count, 1)
        kept = f" ({self.kept_count:,} of them before)" if self.kept_count else ""
        return (
            f"{self.done_count:,} of {self.tile_count:,} tiles are classified{kept}:"
            f" {self.ground_count:,} of {self.point_count:,} points are ground ({share:.1%})"
        )


def classify_tiles(
    sources: Iterable[Path],
    folder: Path,
    parameters: ParameterSet,
    selection: Selection = Selection(),
    files: TileInput = TileInput(),
    output: TileOutput = TileOutput(),
    vpc: Path | None = None,
    progress: Progress = SILENT,
    workers: Workers | None = None,
    blocks: Blocks | None = None,
    rasters: RasterRequest = RasterRequest(),
) -> TilesSummary:
    """Classify the ground points of many files as one survey, and write each anew.

    The labels are those that one file with all the points would get. A file that cannot be read or
    has no ground does not stop the others.

    Parameters
    ----------
    sources : iterable of Path
        Files, folders, virtual point clouds and lists, as for `open_collection`.
    folder : Path
        Where the classified files go, under the names of the inputs; made if it is not there.
    parameters : ParameterSet
        The parameters of one method; their type chooses the method.
    selection : Selection
        Which points take part, and what their classes become.
    files : TileInput
        Whether the folders in folders are searched, too.
    output : TileOutput
        The format, and whether tiles that are done are kept.
    vpc : Path, optional
        The virtual point cloud of the results; ``classified.vpc`` in the folder if not given.
    progress : Progress
        Receives progress, and a line on each finished tile.
    workers : Workers, optional
        Who does the work; threads of this process if not given.
    blocks : Blocks, optional
        How the survey is cut, if not as the method has it.
    rasters : RasterRequest
        Terrain model and hillshade of the whole survey, if they are wanted.

    Raises
    ------
    BareEarthError
        If no file can be classified, or the outputs cannot be written.
    Cancelled
        If the user asked to stop; finished tiles stay, and nothing is half written.
    """
    folder, sources = Path(folder), [Path(each) for each in sources]
    vpc = folder / VPC_NAME if vpc is None else Path(vpc)
    for source in sources:
        if is_same_file(source, vpc):
            raise BareEarthError(
                f"Input and output are the same file, {source}. Choose another output."
            )
    collection = open_collection(sources, files.recursive, progress.part(0.0, 0.02))
    check_survey(collection, folder, vpc, sources if files.recursive else [])
    targets = targets_of(collection, folder, output.format)
    _check_rasters(rasters, folder, (vpc, *targets, *targets.values()))
    blocks = blocks or blocks_of(parameters)
    survey = Survey(parameters, selection, frame_of(collection), blocks)
    workers = Threads() if workers is None else workers
    plan = _Plan(survey, collection, targets, progress)
    _, records, _ = folders = folders_of(folder)
    _make(folder, records)
    with alone_in(records):
        _clear(folder, labels=not output.resume)
        _make(*folders)
        kept = plan.keep_done(output.resume, progress)
        labels, tiles = plan.jobs(folder, workers)
        end = 0.8 if rasters.files.wanted else 0.98
        run = JobQueue(labels, tiles, workers, progress.part(0.05, end))
        try:
            run.work()
        finally:
            workers.stop()
        done = sorted([*kept, *run.done])
        if done and rasters.files.wanted:
            made = open_collection([folder / each.name for each in done], progress=Unsaid(progress))
            points = RasterPoints((selection.to_class,), covers_ground=True)
            waiting = folders_of(folder)[2]
            make_rasters(made, waiting, rasters, points, workers, progress.part(end, 0.98))
        _clear(folder, labels=True)
    failures = {each.path: each.reason for each in collection.broken}
    failures = {**failures, **plan.failures, **run.failures}
    failures = {str(path): failures[path] for path in sorted(failures)}
    for path, reason in failures.items():
        progress.warning(f"{path} is not classified. {reason}")
    if not done:
        raise BareEarthError(f"None of the {len(failures):,} tiles could be classified.")
    write_vpc(vpc, [folder / each.name for each in done], progress.part(0.98, 1.0))
    return TilesSummary(
        tile_count=len(collection.tiles) + len(collection.broken),
        done_count=len(done),
        kept_count=len(kept),
        point_count=sum(each.point_count for each in done),
        ground_count=sum(each.ground_count for each in done),
        failures=failures,
        vpc=str(vpc),
    )


def check_survey(
    collection: Collection, folder: Path, vpc: Path, searched: Sequence[Path] = ()
) -> None:
    """Refuse what could not be done or would do harm, before any work."""
    if collection.crs.is_geographic:
        raise BareEarthError(
            f"The files are not in a projected CRS ({collection.crs.name}), so that nothing can be"
            " measured in them. Reproject them first."
        )
    if folder.exists() and not folder.is_dir():
        raise BareEarthError(f"Cannot write into {folder}: it is a file. Give a folder.")
    if not folder.exists():
        check_output(folder)
    here = folder.resolve()
    for path in [each.path for each in (*collection.tiles, *collection.broken)]:
        if path.parent.resolve() == here:
            raise BareEarthError(
                f"Input and output are in the same folder, {folder}. Choose another output."
            )
    for each in filter(Path.is_dir, searched):
        if each.resolve() in here.parents:
            raise BareEarthError(
                f"The output {folder} is in the folder {each}, which is searched for inputs with"
                " all folders in it. Choose another output."
            )
    if vpc.suffix.lower() != VPC_SUFFIX:
        raise BareEarthError(f"Cannot write {vpc}: name it {VPC_SUFFIX}.")
    if vpc.parent.resolve() != here:
        check_output(vpc)


def _check_rasters(rasters: RasterRequest, folder: Path, others: tuple[Path, ...]) -> None:
    """Refuse rasters that could not be written; the folder of the output may not be there yet."""
    if folder.exists():
        rasters.files.check(others)
        return
    elsewhere = {name: path for name, path in rasters.files.wanted.items() if path.parent != folder}
    RasterFiles(**elsewhere).check(others)


def targets_of(collection: Collection, folder: Path, format: str = "same") -> dict[Path, Path]:
    """Return the output of each input; refuse those that would get the same name."""
    targets, inputs = {}, {}
    for tile in (*collection.tiles, *collection.broken):
        name = tile.path.name
        if format != "same":
            stem = name[: -len(_COPC)] if name.lower().endswith(_COPC) else tile.path.stem
            name = f"{stem}.{format}"
        other = inputs.setdefault(os.path.normcase(name).lower(), tile.path)
        if other is not tile.path:
            raise BareEarthError(
                f"{other} and {tile.path} would both become {folder / name}. Rename one of them, or"
                " classify them into different folders."
            )
        targets[tile.path] = folder / name
        check_writable(targets[tile.path])
    return targets


def _make(folder: Path, *within: Path) -> None:
    """Make the folder of the output, and others within it."""
    try:
        for each in (folder, *within):
            each.mkdir(exist_ok=True)
    except OSError as error:
        raise describe_write_error(folder, error) from error


def _clear(folder: Path, labels: bool) -> None:
    """Remove what a killed run left in the folders of the output, and all labels if wanted."""
    if labels:
        shutil.rmtree(folders_of(folder)[2], ignore_errors=True)
    for each in folders_of(folder):
        remove_leftovers(each)


class _Needs(NamedTuple):
    """A tile, the blocks that may hold its points, and the files that these need."""

    tile: Tile
    places: list[BlockIndex]
    sources: list[Path]


class _Plan:
    """Which tiles are to be done, and by which jobs.

    Parameters
    ----------
    survey, collection
        The survey.
    targets : dict of Path to Path
        The output of each input.
    progress : Progress
        Receives progress.

    Attributes
    ----------
    failures : dict of Path to str
        Tiles that cannot be done, and why.
    """

    def __init__(
        self, survey: Survey, collection: Collection, targets: dict[Path, Path], progress: Progress
    ) -> None:
        self.failures: dict[Path, str] = {}
        self._survey, self._collection, self._targets = survey, collection, targets
        self._sources: dict[BlockIndex, list[Path]] = {}
        # As they are before any of them is read.
        self._states = {each.path: state_of(each.path) for each in collection.tiles}
        self._todo: list[_Needs] = []
        for number, tile in enumerate(collection.tiles, start=1):
            try:
                for value, name in survey.selection.new_classes():
                    check_class(tile.path, tile.point_format, value, name)
                self._todo.append(self._needs(tile))
            except BareEarthError as error:
                self.failures[tile.path] = str(error)
            progress(0.02 + 0.02 * number / len(collection.tiles))

    def _needs(self, tile: Tile) -> _Needs:
        places = places_of(self._survey, tile)
        for place in places:
            if place not in self._sources:
                box = self._survey.window([place])
                self._sources[place] = [each.path for each in self._collection.touching(box)]
        sources = sorted({path for place in places for path in self._sources[place]})
        return _Needs(tile, places, sources)

    def _made_of(self, needs: _Needs) -> dict[str, Any]:
        path = needs.tile.path
        sources = map(self._states.__getitem__, needs.sources)
        return made_of(self._survey, path, sources, self._targets[path])

    def keep_done(self, resume: bool, progress: Progress) -> list[TileSummary]:
        """Take out the tiles that are done; return what became of them."""
        kept, changed = [], 0
        for needs in self._todo:
            target = self._targets[needs.tile.path]
            before = read_record(target) if resume else None
            if before is not None and before[0] == self._made_of(needs):
                kept.append(TileSummary(**before[1]))
                continue
            changed += before is not None
            remove_record(target)
        names = {each.name for each in kept}
        self._todo = [
            each for each in self._todo if self._targets[each.tile.path].name not in names
        ]
        if kept:
            progress.info(f"{len(kept):,} tiles are done already.")
        if changed:
            progress.info(
                f"{changed:,} tiles that were done are classified anew: parameters, inputs or the"
                " version are others than before."
            )
        return kept

    def jobs(self, folder: Path, workers: Workers) -> tuple[list[LabelJob], list[ClassJob]]:
        """Return the jobs for all that is to be done, and let the workers begin."""
        survey, collection = self._survey, self._collection
        places = sorted({place for needs in self._todo for place in needs.places})
        labels = folders_of(folder)[2]
        files = {
            each: label_file(survey, labels, each, map(self._states.get, self._sources[each]))
            for each in places
        }
        tiles = [
            ClassJob(
                survey,
                needs.tile,
                self._targets[needs.tile.path],
                tuple(needs.places),
                tuple(files[each] for each in needs.places),
                self._made_of(needs),
            )
            for needs in self._todo
        ]
        missing = {each: files[each] for each in places if not files[each].exists()}
        count = len(tiles)
        return block_jobs(LabelJob, survey, collection, missing, folder, count, workers), tiles
