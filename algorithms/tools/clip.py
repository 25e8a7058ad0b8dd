"""Clips point clouds: the points in an area, with everything that their files hold about them."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..engine.blocks import Blocks
from ..engine.step import MORE, OUTSIDE, Allocate, PointResult, PointStep
from ..engine.store import Marks
from ..engine.summary import TileSummary
from ..las.cloud import PointCloud
from ..las.edits import Edits
from ..survey.area import Area
from ..survey.shapes import Place, outside
from .declaration import CLOUD, POINTS, TILES, Input, PointTool


@dataclass(frozen=True, order=True)
class ClipSummary(TileSummary):
    """The points of a file that lie in the area."""

    name: str  # of the output
    point_count: int = 0  # in the output
    input_count: int = 0
    class_counts: dict[int, int] = field(default_factory=dict)  # in the output

    @property
    def text(self) -> str:
        """The summary as a sentence."""
        return f"{self.name}: {self.point_count:,} of {self.input_count:,} points lie in the area"


@dataclass(frozen=True)
class Clip(PointStep):
    """Finds the points in an area, which alone are written."""

    area: Area | None = None

    counts = Counter
    blocks = Blocks.of(1.0)
    changes = frozenset({MORE, OUTSIDE})
    summary_type = ClipSummary

    @property
    def wanted(self) -> Area:
        """The area; without one there is nothing to clip."""
        if self.area is None:
            raise BareEarthError("Give an extent or a boundary: the points in it are written.")
        return self.area

    def in_crs(self, place: Place, progress: Progress = SILENT) -> Clip:
        """Refuse to clip by no area, and polygons where the points are in degrees."""
        if self.wanted.polygons and place.crs.is_geographic:
            raise BareEarthError(
                f"{place.name} is in degrees ({place.crs.name}): give an extent, since boundaries"
                " are not transformed to such a CRS."
            )
        return self

    def marks(self, part: PointCloud, counts: Any) -> Marks:
        """Mark no point, since none needs others."""
        none = np.zeros(part.count, dtype=bool)
        return Marks(none, none, none)

    def result(self, path: Path, allocate: Allocate) -> ClippedPoints:
        return ClippedPoints(self)


class ClippedPoints(PointResult):
    """The points of a file that are written."""

    def add(
        self, where: slice, before: PointCloud, values: np.ndarray
    ) -> tuple[PointCloud, np.ndarray]:
        """Return points, and which of them lie in the area."""
        inside = self._step.wanted.of(before)
        self._numbers.update(point_count=int(inside.sum()), input_count=before.count)
        return before, inside

    def edits(self, cloud: PointCloud, progress: Progress = SILENT) -> Edits:
        """Refuse a file without points in the area."""
        if not self._numbers["point_count"]:
            box = cloud.box if cloud.file is None else cloud.file.outer_box
            raise outside("the area", self._step.wanted.bounds, str(cloud.path), box)
        return Edits()


TOOL = PointTool(
    step=Clip,
    points=replace(POINTS, help="", label="Point cloud"),
    list_name="clipped.vpc",
    looks_around=False,
    sets=(),
    inputs=(
        Input(
            "area",
            "area",
            help="Only points in {area} are written. One of extent and boundary is needed.",
            label="Area",
            optional=True,
        ),
    ),
    command="clip",
    identifier="clip",
    title="Clip point clouds",
    about="The points in an extent or in polygons are written as they are, in their order, with"
    " their classes, all dimensions, extra bytes and records. Nothing is classified. Of many files"
    " each with points there becomes a file in a folder; of remote point clouds only the part that"
    " is needed is downloaded.",
    page="many-files#clip",
    words=(CLOUD, TILES, "clip,crop,cut,extent,boundary,polygon,subset,las2las,pdal crop"),
    output_label="Clipped point cloud",
    output_help="The points in the area.",
    numbers=(("POINT_COUNT", "Points"),),
)
