"""Heights above ground of a survey of many classified files."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress, Unsaid
from ..las.changes import Changes
from ..las.cloud import PointCloud
from ..las.writing import write_changed
from ..survey.collection import open_collection
from ..survey.selection import Selection
from ..survey.vpc import write_vpc
from .cloudstore import CloudStore
from .heights import HEIGHT_BLOCKS, in_unit, measure_heights
from .jobs import KeptValues, PointJob, Share, TileJob
from .memory import Resources
from .output import height_dimension, z_of
from .run import Run
from .survey import Survey, frame_of, grouped, memory_of, places_of, points_in
from .tiles import check_survey, targets_of
from .workers import Threads, Workers

VPC_NAME = "heights.vpc"


@dataclass(frozen=True)
class HeightJob(PointJob):
    """Measures the heights of the points of some blocks.

    Attributes
    ----------
    ground_classes : tuple of int
        Classes of the ground.
    """

    ground_classes: tuple[int, ...] = (2,)

    def kind(self) -> type:
        """Return the type of heights."""
        return np.float64

    def marks(self, cloud: PointCloud) -> tuple[np.ndarray, np.ndarray]:
        """Return all points, and which of them are ground."""
        ground = np.isin(cloud.classification, self.ground_classes) & ~cloud.withheld
        return np.ones(cloud.count, dtype=bool), ground

    def work(self, store: CloudStore, resources: Resources, progress: Progress) -> None:
        """Measure the heights."""
        measure_heights(store, resources, progress)


@dataclass(frozen=True)
class HeightTile(TileJob):
    """Writes a tile with the heights of its points.

    Attributes
    ----------
    as_z : bool
        Whether they replace z.
    """

    as_z: bool = False

    def run(self, share: Share, progress: Progress) -> HeightTileSummary:
        """Do it."""
        kept, heights = KeptValues(self, np.float64), np.zeros(self.tile.count)
        for part in self.parts(share, Unsaid(progress.part(0.0, 0.4))):
            where, some = kept.of(part)
            heights[where] = in_unit(some, part)
        kept.check()
        if self.as_z:
            changes = Changes(z=z_of(part, heights))
        else:
            changes = Changes(extra=height_dimension(part, heights))
        write_changed(self.tile.file, self.target, changes, progress.part(0.4, 1.0), part)
        known = heights[~np.isnan(heights)]
        extremes = (float(known.min()), float(known.max())) if len(known) else (np.nan, np.nan)
        return HeightTileSummary(self.target.name, len(heights), *extremes)


@dataclass(frozen=True, order=True)
class HeightTileSummary:
    """What became of one file.

    Attributes
    ----------
    name : str
        Of the output.
    point_count : int
        Its points.
    minimum, maximum : float
        Its lowest and its highest height, in the vertical unit of the CRS.
    """

    name: str
    point_count: int
    minimum: float
    maximum: float

    @property
    def text(self) -> str:
        """All of it in words."""
        return f"{self.name}: {self.point_count:,} points, {self.minimum:.2f} to {self.maximum:.2f}"


@dataclass(frozen=True)
class HeightsSummary:
    """What became of a survey.

    Attributes
    ----------
    tile_count, done_count, point_count : int
        Files, those that were written, and their points.
    failures : dict of str to str
        Why the others were not, by their paths.
    vpc : str
        The virtual point cloud of all that were.
    """

    tile_count: int
    done_count: int
    point_count: int
    failures: dict[str, str]
    vpc: str


def write_heights_of_survey(
    sources: Sequence[Path],
    folder: Path,
    ground_classes: tuple[int, ...] = (2,),
    as_z: bool = False,
    progress: Progress = SILENT,
    workers: Workers | None = None,
) -> HeightsSummary:
    """Write many classified files anew with the heights of their points above ground.

    The heights are those that one file with all the points would get.

    Parameters
    ----------
    sources : sequence of Path
        Files, folders, virtual point clouds and lists, as for `open_collection`.
    folder : Path
        Where the outputs go, under the names of the inputs; made if it is not there.
    ground_classes : tuple of int
        Classes of the ground.
    as_z : bool
        Whether the heights replace z; else they are an extra dimension.
    progress : Progress
        Receives progress, and a line on each finished tile.
    workers : Workers, optional
        Who does the work; threads of this process if not given.

    Raises
    ------
    BareEarthError
        If no file can be written.
    Cancelled
        If the user asked to stop; finished tiles stay, and nothing is half written.
    """
    folder = Path(folder)
    collection = open_collection(sources, progress=progress.part(0.0, 0.02))
    vpc = folder / VPC_NAME
    check_survey(collection, folder, vpc)
    targets = targets_of(collection, folder)
    folder.mkdir(exist_ok=True)
    survey = Survey(None, Selection(), frame_of(collection), HEIGHT_BLOCKS)
    workers = Threads() if workers is None else workers
    with tempfile.TemporaryDirectory(prefix=".bare-earth-", dir=folder) as waiting:
        blocks, tiles = _jobs(collection, survey, Path(waiting), targets, workers)
        blocks = [_with(HeightJob, each, ground_classes=ground_classes) for each in blocks]
        tiles = [_with(HeightTile, each, as_z=as_z) for each in tiles]
        run = Run(blocks, tiles, workers, progress.part(0.02, 0.98))
        try:
            run.work()
        finally:
            workers.stop()
    failures = {str(each.path): each.reason for each in collection.broken}
    failures.update({str(path): reason for path, reason in run.failures.items()})
    for path, reason in failures.items():
        progress.warning(f"{path} is left out. {reason}")
    done = sorted(run.done)
    if not done:
        raise BareEarthError(f"None of the {len(failures):,} files could be written.")
    write_vpc(vpc, [folder / each.name for each in done], progress.part(0.98, 1.0))
    points = sum(each.point_count for each in done)
    return HeightsSummary(len(targets), len(done), points, failures, str(vpc))


def _with(kind: type, job: Any, **more: Any) -> Any:
    """Return a job of a kind with the fields of another."""
    return kind(**vars(job), **more)


def _jobs(
    collection: Any, survey: Survey, waiting: Path, targets: dict[Path, Path], workers: Workers
) -> tuple[list[PointJob], list[TileJob]]:
    """Return the jobs of blocks and tiles, and let the workers begin."""
    of_tile = {tile.path: places_of(survey, tile) for tile in collection.tiles}
    places = sorted({place for each in of_tile.values() for place in each})
    files = {each: waiting / f"{each.column}_{each.row}.npz" for each in places}
    least = max((memory_of(survey, collection, [each]) for each in places), default=0)
    workers.start(targets[collection.tiles[0].path].parent, least, len(places), len(of_tile))
    groups = grouped(survey, collection, places, workers.at_once, workers.share.memory)
    blocks = [
        PointJob(
            survey,
            tuple(group),
            tuple(files[each] for each in group),
            tuple(each.path for each in collection.touching(survey.window(group))),
            points_in(collection, survey.window(group)),
        )
        for group in groups
    ]
    tiles = [
        TileJob(
            survey,
            tile,
            targets[tile.path],
            tuple(of_tile[tile.path]),
            tuple(files[each] for each in of_tile[tile.path]),
            {},
        )
        for tile in collection.tiles
    ]
    return blocks, tiles
