"""Classify model key points: a class or a flag for the few ground points a model needs."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Sequence

import numpy as np

from ..classes.ground_classes import GroundClasses, GroundCounts
from ..classes.without_ground import UNCHANGED, WithoutGround
from ..core.parameters import ParameterSet, parameter
from ..core.progress import SILENT, Progress
from ..engine.blocks import Blocks, Visit
from ..engine.step import CLASSES, MORE, Allocate, PointResult, PointStep, with_classes
from ..engine.store import Marks
from ..engine.summary import TileSummary
from ..las.cloud import PointCloud
from ..las.edits import Edits
from ..las.lasfile import LasFile
from ..las.records import check_class
from ..tin.model_key_points import ModelKeyPoints, model_key_points, reach
from .declaration import CLOUD, TERRAIN, TIN, PointTool

# Values that a store holds.
_KEY = 1
_OTHER = 2  # of other ground points


@dataclass(frozen=True)
class KeyPointMark(ParameterSet):
    """How model key points are marked."""

    mark_as: str = parameter(
        "class",
        label="Mark key points by",
        choices={
            "class": "A class of their own",
            "flag": "The key-point flag of LAS; the class stays",
        },
        help="Up to LAS 1.3, and in most programs, key points have a class. LAS 1.4 has a flag for"
        " them, so that they keep the class of the ground.",
    )
    key_class: int = parameter(
        8,
        label="Class of key points",
        minimum=0,
        maximum=255,
        help="The class that key points get. Points that already have it count as ground; those"
        " that are not needed get the first of the ground classes. Point formats 0 to 5 hold"
        " classes up to 31.",
    )


@dataclass(frozen=True, order=True)
class KeyPointSummary(TileSummary):
    """The numbers of key points of a file."""

    name: str  # of the output
    point_count: int = 0
    ground_count: int = 0
    key_point_count: int = 0
    class_counts: dict[int, int] = field(default_factory=dict)  # in the output

    @property
    def text(self) -> str:
        """The summary as a sentence."""
        return (
            f"{self.name}: {self.key_point_count:,} of {self.ground_count:,} ground points are key"
            " points"
        )


@dataclass(frozen=True)
class FindKeyPoints(PointStep):
    """Finds the few ground points whose TIN is as good as that of all of them."""

    # How closely they follow the ground
    parameters: ModelKeyPoints = field(default_factory=ModelKeyPoints)
    ground: GroundClasses = field(default_factory=GroundClasses)  # which points are ground
    mark: KeyPointMark = field(default_factory=KeyPointMark)  # whether they get a class or a flag

    counts = GroundCounts
    imports = "scipy.ndimage", "scipy.spatial"
    summary_type = KeyPointSummary

    @property
    def blocks(self) -> Blocks:
        """The blocks in which key points are found."""
        return Blocks.of(reach(self.parameters))

    @property
    def changes(self) -> frozenset[str]:
        """Key points get a class or a flag."""
        return frozenset({CLASSES if self.mark.mark_as == "class" else MORE})

    def marks(self, part: PointCloud, counts: GroundCounts) -> Marks:
        """Return the ground points."""
        self.check_file(part)
        also = (self.mark.key_class,) if self.gives_classes else ()
        ground = self.ground.of(part, counts, also)
        return Marks(ground, ground, ground)

    def report_counts(self, counts: GroundCounts, path: Path, progress: Progress) -> None:
        """Refuse a file without ground."""
        self.ground.check(counts, path)

    def report_survey(
        self, done: Sequence[KeyPointSummary], empty: Sequence[LasFile], progress: Progress
    ) -> None:
        """Warn of files without ground; refuse them if no file has any."""
        files = [
            (summary.ground_count, WithoutGround(summary.name, summary.point_count, UNCHANGED))
            for summary in done
        ]
        self.ground.report_survey(files, progress)

    def check_file(self, file: LasFile | PointCloud) -> None:
        """Refuse a file whose points cannot hold the class."""
        if self.gives_classes:
            check_class(file.path, file.point_format, self.mark.key_class, "the key points")

    def in_block(self, visit: Visit, progress: Progress) -> tuple[np.ndarray, np.ndarray]:
        """Return the positions of the ground points of a block, and `_KEY` or `_OTHER` for each."""
        contents = visit.contents(progress.part(0.0, 0.1))
        core = visit.core(contents)
        if not core.any():
            return contents.positions[core], np.zeros(0, dtype=np.uint8)
        # The grid belongs to the CRS, not to the block.
        anchor, part = (-visit.corner[0], -visit.corner[1]), progress.part(0.1, 1.0)
        keys = model_key_points(contents.points, self.parameters, part, anchor)[core]
        return contents.positions[core], np.where(keys, _KEY, _OTHER).astype(np.uint8)

    def applied(self, part: PointCloud, values: np.ndarray) -> PointCloud:
        """Return points with their classes, if key points get a class."""
        if not self.gives_classes:
            return part
        classes = part.classification.copy()
        before = (values == _OTHER) & (classes == self.mark.key_class)
        classes[before] = self.ground.ground_classes[0]
        classes[values == _KEY] = self.mark.key_class
        return with_classes(part, classes)

    def numbers(self, part: PointCloud, after: PointCloud, values: np.ndarray) -> dict[str, int]:
        """Return how many points are ground, and how many key points."""
        return {
            "ground_count": int(np.count_nonzero(values)),
            "key_point_count": int(np.count_nonzero(values == _KEY)),
        }

    def result(self, path: Path, allocate: Allocate) -> PointResult:
        """Return an object that counts the key points of a file, and collects their flags."""
        return PointResult(self) if self.gives_classes else _KeyPointFlags(self, allocate)


class _KeyPointFlags(PointResult):
    """The key points of a file that keep their class, as a flag of each point."""

    def __init__(self, step: FindKeyPoints, allocate: Allocate) -> None:
        super().__init__(step)
        self._flags = allocate(np.int8)

    def add(
        self, where: slice, before: PointCloud, values: np.ndarray
    ) -> tuple[PointCloud, np.ndarray | None]:
        """Count some points, and set their flags."""
        self._flags[where] = np.select([values == _KEY, values == _OTHER], [1, 0], -1)
        return super().add(where, before, values)

    def edits(self, cloud: PointCloud, progress: Progress = SILENT) -> Edits:
        """Return the flags."""
        return Edits(key_points=self._flags)


TOOL = PointTool(
    step=FindKeyPoints,
    list_name="key_points.vpc",
    sets=(ModelKeyPoints, KeyPointMark, GroundClasses),
    dialog_sets=(ModelKeyPoints, GroundClasses, KeyPointMark),
    command="key-points",
    identifier="modelkeypoints",
    title="Classify model key points",
    about="No other ground point lies farther above or below the triangulation (TIN) of these model"
    " key points than the tolerances. Key points get a class of their own, or the key-point flag;"
    " nothing else in the file changes.\n"
    "Lengths are metres, whatever the unit of the CRS.",
    page="heights#model-key-points",
    words=(CLOUD, TERRAIN, TIN, "ground,thin,thinning,generalize,keypoints,contours"),
    output_label="Point cloud with key points",
    output_help="The same points, with the key points marked.",
    numbers=(
        ("POINT_COUNT", "Points"),
        ("GROUND_COUNT", "Ground points"),
        ("KEY_POINT_COUNT", "Key points"),
    ),
    shows="key points",
)
