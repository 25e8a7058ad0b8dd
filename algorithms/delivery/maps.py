"""Single outputs of a raw point cloud: classes, maps of its terrain, and contour lines."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Mapping, Sequence

from ..core.files import Outputs, temporary_folder
from ..core.parameters import ParameterSet
from ..core.progress import SILENT, Progress
from ..engine.options import TileOutput
from ..survey.files import Inputs
from ..survey.outputs import check_outputs, place
from ..tools import map_tool
from ..tools.contours import Interval
from ..tools.ground.output import Output as Written
from ..tools.running import run

_KINDS = {"cloud": "cloud", "contours": "features"}
# The longest first, since it ends as the second does.
_FORMATS = ("copc.laz", "laz", "las")


@dataclass
class MapSummary:
    """What a run made."""

    cloud: Path  # the classified file, or the virtual point cloud of them
    point_count: int  # those of the area if there is one
    ground_count: int
    class_counts: dict[int, int]
    contour_interval: Interval | None  # None if no contour lines were wanted


def make_maps(
    sources: Inputs,
    outputs: Mapping[str, Path],
    sets: Sequence[ParameterSet],
    inputs: Mapping[str, Any],
    progress: Progress = SILENT,
) -> MapSummary:
    """Make outputs, all or none, given by the names of rasters, "contours" and "cloud", which is of
    many files a folder of this name without its ending.
    """
    folders = [path.parent for path in outputs.values()]
    beside = next((folder for folder in folders if folder.is_dir()), Path(tempfile.gettempdir()))
    sets = [*sets, Written(area_only=inputs["area"] is not None)]
    with temporary_folder(beside) as waiting, Outputs() as pending:
        kinds = {name: _KINDS.get(name, "raster") for name in outputs}
        check_outputs([(kinds[name], path) for name, path in outputs.items()], sources)
        cloud = outputs.get("cloud", waiting / "cloud.las")
        if sources.is_survey:
            target, tiles = _folder_of(cloud)
            sets = [*sets, tiles]
        else:
            target = pending.file(cloud) if "cloud" in outputs else cloud
        places = {
            name: place(pending, kinds[name], path)
            for name, path in outputs.items()
            if name != "cloud"
        }
        tool, given = map_tool("classify"), {**inputs, "input": sources}
        done = run(tool, given, {**places, "output": target}, sets, progress)
    return MapSummary(
        Path(done.vpc or cloud),
        sum(done.class_counts.values()),
        done.ground_count,
        done.class_counts,
        done.drawn.get("contours"),
    )


def _folder_of(cloud: Path) -> tuple[Path, TileOutput]:
    """Return the folder of this name without its ending, and how the files in it are written."""
    name = cloud.name.lower()
    kind = next((ending for ending in _FORMATS if name.endswith(f".{ending}")), cloud.suffix[1:])
    folder = cloud.with_name(cloud.name[: -len(kind) - 1])
    return folder, TileOutput(kind if kind in _FORMATS else "same", overview=True)
