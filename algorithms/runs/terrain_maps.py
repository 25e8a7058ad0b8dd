"""From a raw point cloud to all maps of its terrain, in one step."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass, field, fields, replace
from functools import partial
from pathlib import Path
from typing import NamedTuple, Sequence

from ..core.files import Outputs, temporary_folder
from ..core.progress import SILENT, Progress
from ..engine.options import TileOutput
from ..survey.files import Inputs
from ..survey.outputs import check_outputs, place
from ..tools.contours import Interval
from ..tools.ground.output import Output
from ..tools.rasters.parameters import MapTerrain
from ..tools.rasters.rows import RasterFiles
from .entry import classify, with_contours
from .requests import ClassifyRequest

# The longest first, since it ends as the second does.
_FORMATS = ("copc.laz", "laz", "las")


class MapFiles(NamedTuple):
    """The files to make; None for those that are not wanted."""

    cloud: Path | None  # for many files a folder of this name, without its ending
    rasters: RasterFiles
    contours: Path | None = None


@dataclass(frozen=True)
class MapRequest(ClassifyRequest):
    """A request for all steps from a point cloud to maps, of an area only if there is one."""

    terrain: MapTerrain = field(default_factory=MapTerrain)

    def __post_init__(self) -> None:
        """Check nothing: `classify` does."""

    def classify(self, rasters: RasterFiles) -> ClassifyRequest:
        """Return the request to classify and to make rasters in the same run."""
        own = {declared.name: getattr(self, declared.name) for declared in fields(ClassifyRequest)}
        output = Output(area_only=self.area is not None)
        return ClassifyRequest(**{**own, "rasters": rasters, "output": output})


class MapSummary(NamedTuple):
    """What a run made."""

    cloud: Path  # the classified file, or the virtual point cloud of them
    point_count: int  # those of the area if there is one
    ground_count: int
    class_counts: dict[int, int]
    contour_interval: Interval | None = None  # None if no contour lines were wanted


def make_maps(
    sources: Sequence[Path], files: MapFiles, request: MapRequest, progress: Progress = SILENT
) -> MapSummary:
    """Classify the ground of a file, or of those of a survey, and make maps of its terrain."""
    wanted = [files.cloud, *files.rasters.wanted.values(), files.contours]
    folders = [path.parent for path in wanted if path]
    beside = next((folder for folder in folders if folder.is_dir()), Path(tempfile.gettempdir()))
    sources = Inputs(sources)
    is_one = not sources.is_survey
    # All or none: the outputs get their names when all of them are finished.
    with temporary_folder(beside) as waiting, Outputs() as outputs:
        cloud = files.cloud or waiting / "cloud.las"
        checked = [("cloud", files.cloud), *files.rasters.outputs(), ("features", files.contours)]
        check_outputs([(kind, path) for kind, path in checked if path], sources)
        if files.cloud and is_one:
            cloud = outputs.file(cloud)
        rasters = files.rasters.wanted
        maps = {name: place(outputs, "raster", rasters[name]) for name in rasters}
        lines = place(outputs, "features", files.contours) if files.contours else None
        how = replace(request, contour_lines=lines).classify(RasterFiles(**maps))
        summary = _classified(sources, cloud, how, progress, is_one)
    return summary._replace(cloud=files.cloud) if files.cloud and is_one else summary


def _classified(
    sources: Sequence[Path], target: Path, how: ClassifyRequest, progress: Progress, is_one: bool
) -> MapSummary:
    """Classify into a file, or into a folder of this name without its ending."""
    if not is_one:
        name = target.name.lower()
        kind = next(
            (ending for ending in _FORMATS if name.endswith(f".{ending}")), target.suffix[1:]
        )
        target = target.with_name(target.name[: -len(kind) - 1])
        how = replace(how, tiles=TileOutput(kind if kind in _FORMATS else "same", overview=True))
    run = partial(classify, sources, target)
    done, interval = with_contours(run, list(sources), how, progress)
    written, count = (target, done.area_count) if is_one else (Path(done.vpc), done.point_count)
    return MapSummary(written, count, done.ground_count, done.class_counts, interval)
