"""From a raw point cloud to all maps of its terrain, in one step."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any, Mapping, NamedTuple, Sequence

from ..core.files import Outputs, temporary_folder
from ..core.parameters import ParameterSet
from ..core.progress import SILENT, Progress
from ..engine.options import TileOutput
from ..survey.files import Inputs
from ..survey.outputs import check_outputs, place
from ..tools import file_tool, map_tool
from ..tools.contours import Interval
from ..tools.ground.output import Output
from ..tools.rasters.rows import RasterFiles
from ..tools.running import run

# The longest first, since it ends as the second does.
_FORMATS = ("copc.laz", "laz", "las")


class MapFiles(NamedTuple):
    """The files to make; None for those that are not wanted."""

    cloud: Path | None  # for many files a folder of this name, without its ending
    rasters: RasterFiles
    contours: Path | None = None


class MapSummary(NamedTuple):
    """What a run made."""

    cloud: Path  # the classified file, or the virtual point cloud of them
    point_count: int  # those of the area if there is one
    ground_count: int
    class_counts: dict[int, int]
    contour_interval: Interval | None = None  # None if no contour lines were wanted


def make_maps(
    inputs: Inputs,
    files: MapFiles,
    sets: Sequence[ParameterSet],
    given: Mapping[str, Any],
    progress: Progress = SILENT,
) -> MapSummary:
    """Classify the ground of a file, or of those of a survey, and make maps of its terrain, given
    parameters and further inputs of *Classify ground* by their names.
    """
    wanted = [files.cloud, *files.rasters.wanted.values(), files.contours]
    folders = [path.parent for path in wanted if path]
    beside = next((folder for folder in folders if folder.is_dir()), Path(tempfile.gettempdir()))
    sets = [*sets, Output(area_only=given.get("area") is not None)]
    working, drawing = progress.part(0.0, 0.9), progress.part(0.9, 1.0)
    # All or none: the outputs get their names when all of them are finished.
    with temporary_folder(beside) as waiting, Outputs() as outputs:
        cloud, interval = files.cloud or waiting / "cloud.las", None
        checked = [("cloud", files.cloud), *files.rasters.outputs(), ("features", files.contours)]
        check_outputs([(kind, path) for kind, path in checked if path], inputs)
        if inputs.is_survey:
            cloud, tiles = _folder_of(cloud)
            sets.append(tiles)
        elif files.cloud:
            cloud = outputs.file(cloud)
        rasters = files.rasters.wanted
        maps = {name: place(outputs, "raster", rasters[name]) for name in rasters}
        if files.contours:
            maps.setdefault("dtm", waiting / "dtm.tif")
        how = {**given, "input": inputs}
        part = working if files.contours else progress
        done = run(map_tool("classify"), how, {"output": cloud, **maps}, sets, part)
        if files.contours:
            lines = {"output": place(outputs, "features", files.contours)}
            interval = run(file_tool("contours"), {"source": maps["dtm"]}, lines, sets, drawing)
    written = Path(done.vpc) if inputs.is_survey else files.cloud or cloud
    count = done.point_count if inputs.is_survey else done.area_count
    return MapSummary(written, count, done.ground_count, done.class_counts, interval)


def _folder_of(cloud: Path) -> tuple[Path, TileOutput]:
    """Return the folder of this name without its ending, and how the files in it are written."""
    name = cloud.name.lower()
    kind = next((ending for ending in _FORMATS if name.endswith(f".{ending}")), cloud.suffix[1:])
    folder = cloud.with_name(cloud.name[: -len(kind) - 1])
    return folder, TileOutput(kind if kind in _FORMATS else "same", overview=True)
