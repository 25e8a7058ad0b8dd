"""Heights above ground of a survey of many classified files."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress, Unsaid
from ..las.cloud import PointCloud
from ..las.writing import write_changed
from ..survey.collection import open_collection
from ..survey.selection import Selection, ground_of
from ..survey.vpc import write_vpc
from .heights import HEIGHT_BLOCKS, in_unit, measure_heights
from .job_queue import JobQueue
from .jobs import KeptValues, PointJob, Share, TileJob
from .memory import Resources
from .memory_points import MemoryPoints
from .output import height_changes
from .planning import block_jobs
from .survey import Survey, frame_of, places_of
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
        return np.ones(cloud.count, dtype=bool), ground_of(cloud, self.ground_classes)

    def work(self, store: MemoryPoints, resources: Resources, progress: Progress) -> None:
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
        changes = height_changes(part, heights, self.as_z)
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
        of_tile = {tile.path: tuple(places_of(survey, tile)) for tile in collection.tiles}
        places = sorted({place for each in of_tile.values() for place in each})
        files = {each: Path(waiting) / f"{each.column}_{each.row}.npz" for each in places}
        more = {"ground_classes": ground_classes}
        blocks = block_jobs(
            HeightJob, survey, collection, files, folder, len(of_tile), workers, **more
        )
        tiles = []
        for tile in collection.tiles:
            where = of_tile[tile.path]
            kept = tuple(files[each] for each in where)
            tiles.append(HeightTile(survey, tile, targets[tile.path], where, kept, {}, as_z))
        run = JobQueue(blocks, tiles, workers, progress.part(0.02, 0.98))
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
