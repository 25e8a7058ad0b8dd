"""Single outputs of a raw point cloud: classes, maps of its terrain, and contour lines."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass, field
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
from ..tools.rasters.rows import RASTERS
from .table import Job, Row

_KINDS = {"cloud": "cloud", "contours": "features"}
# The longest first, since it ends as the second does.
_FORMATS = ("copc.laz", "laz", "las")


@dataclass
class MapSummary:
    """What a run made."""

    cloud: Path  # the classified file, or the virtual point cloud of them
    point_count: int = 0  # those of the area if there is one
    ground_count: int = 0
    class_counts: dict[int, int] = field(default_factory=dict)
    contour_interval: Interval | None = None  # None if no contour lines were wanted


class MapJob(Job):
    """Single outputs while they are made."""

    summary: MapSummary

    def place(self, kind: str, name: str) -> Path | None:
        """Return where an output waits for its name."""
        return self.known.get(name)


def _rows() -> tuple[Row, ...]:
    """Return the rows; rasters are made in the same run as the classes."""
    limits = {declared.name: declared.name for declared in map_tool("classify").inputs}
    rasters = {name: name for name in RASTERS}
    return (
        Row("classes", "classify", 9.0, (), limits, rasters, work=_classify),
        Row("contour lines", "contours", 1.0, ("contours",), {"source": "dtm"},
            {"output": "contours"}, "contour_interval"),
    )  # fmt: skip


def _classify(job: MapJob, row: Row, progress: Progress) -> None:
    """Classify the ground, and make the rasters."""
    summary, is_survey = job.summary, job.sources.is_survey
    done = job.run(row, progress, output=job.known["cloud"])
    summary.ground_count, summary.class_counts = done.ground_count, done.class_counts
    summary.point_count = done.point_count if is_survey else done.area_count
    if is_survey:
        summary.cloud = Path(done.vpc)


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
    with temporary_folder(beside) as waiting, Outputs() as pending:
        check_outputs(
            [(_KINDS.get(name, "raster"), path) for name, path in outputs.items()], sources
        )
        summary = MapSummary(outputs.get("cloud", waiting / "cloud.las"))
        known = {**inputs, "cloud": summary.cloud, "contours": None}
        for name, path in outputs.items():
            if name != "cloud":
                known[name] = place(pending, _KINDS.get(name, "raster"), path)
            elif not sources.is_survey:
                known[name] = pending.file(path)
        if known["contours"]:
            known.setdefault("dtm", waiting / "dtm.tif")
        if sources.is_survey:
            known["cloud"], tiles = _folder_of(summary.cloud)
            sets = [*sets, tiles]
        values = {"area_only": inputs["area"] is not None}
        MapJob(sources, sets, values, known, summary).work(_rows(), progress)
    return summary


def _folder_of(cloud: Path) -> tuple[Path, TileOutput]:
    """Return the folder of this name without its ending, and how the files in it are written."""
    name = cloud.name.lower()
    kind = next((ending for ending in _FORMATS if name.endswith(f".{ending}")), cloud.suffix[1:])
    folder = cloud.with_name(cloud.name[: -len(kind) - 1])
    return folder, TileOutput(kind if kind in _FORMATS else "same", overview=True)
