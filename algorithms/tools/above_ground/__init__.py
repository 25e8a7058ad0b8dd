"""Classify above ground: classes of vegetation, buildings, bridges and high noise."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Sequence

import numpy as np

from ...classes.corrections import NO_CORRECTIONS, Corrections, changed_since
from ...classes.ground_classes import ROADS_FLAG, GroundClasses, GroundCounts
from ...classes.kept_classes import DECIDED, ROADS, is_one_of
from ...classes.without_ground import UNCHANGED, WithoutGround
from ...core.progress import Progress
from ...engine.blocks import Blocks, Visit
from ...engine.memory import Cost
from ...engine.step import PointStep, with_classes
from ...engine.store import Marks
from ...engine.summary import TileSummary
from ...las.cloud import PointCloud
from ...las.lasfile import LasFile
from ...las.return_numbers import MULTI_RETURN, SeveralReturns
from ...survey.area import Area
from ...tin.height_above_ground import with_roads
from ..declaration import CANOPY, CLOUD, Input, PointTool
from .classes import AboveGround, classes_above_ground

# The buffer of a block in metres, and the memory that it takes. A face of a roof that reaches
# farther is large enough without what lies beyond.
_BLOCKS = Blocks.of(100.0, Cost(350.0, 120.0))


@dataclass(frozen=True, order=True)
class AboveGroundSummary(TileSummary):
    """The classes of the points above the ground of a file."""

    name: str  # of the output
    point_count: int = 0
    ground_count: int = 0
    changed_count: int = 0  # points with another class than before
    class_counts: dict[int, int] = field(default_factory=dict)  # in the output

    @property
    def without_ground(self) -> WithoutGround:
        """The warning about one of many files without ground."""
        fate = "classified above the ground of other files"
        if not self.changed_count:
            fate = UNCHANGED
        return WithoutGround(self.name, self.point_count, fate)

    @property
    def text(self) -> str:
        """The summary as a sentence."""
        vegetation = sum(self.class_counts.get(value, 0) for value in (3, 4, 5))
        return (
            f"{self.name}: {self.changed_count:,} of {self.point_count:,} points have a new class;"
            f" {self.class_counts.get(6, 0):,} are buildings and {vegetation:,} vegetation"
        )


@dataclass(frozen=True)
class ClassifyAboveGround(PointStep):
    """Finds the classes of points above the ground."""

    parameters: AboveGround = field(default_factory=AboveGround)  # which classes they get
    ground: GroundClasses = field(default_factory=GroundClasses)  # which points are ground
    area: Area | None = None  # where points can change; None for everywhere
    # Points in these polygons keep the class that they have by hand
    corrections: Corrections = NO_CORRECTIONS

    counts = GroundCounts
    blocks = _BLOCKS
    summary_type = AboveGroundSummary

    def marks(self, part: PointCloud, counts: GroundCounts) -> Marks:
        """Return the ground points and those on it, without classes such as water, wires or noise,
        and which of them can change.
        """
        ground = self.ground.of(part, counts)
        roads = self.ground.roads_of(part, ROADS) & ~ground
        selected = ground | roads | self.ground.points_of(part, DECIDED)
        wanted = selected & ~ground & self.can_change(part)
        flags = {ROADS_FLAG: roads, MULTI_RETURN: SeveralReturns(part)}
        return Marks(selected, ground, wanted, flags)

    def can_change(self, part: PointCloud) -> np.ndarray:
        """Return which points can change: of certain classes, in the area, not set by hand."""
        changes = is_one_of(part.classification, self.parameters.changing) & ~changed_since(part)
        if self.corrections.polygons:
            changes &= self.corrections.classes_of(part) != part.classification
        return changes if self.area is None else changes & self.area.of(part)

    def report_counts(self, counts: GroundCounts, path: Path, progress: Progress) -> None:
        """Refuse a file without ground; warn of a file in which no point can change."""
        self.ground.check(counts, path)
        if not counts.classes[list(self.parameters.changing)].any():
            progress.warning(
                f"No point of {path} has one of the classes that are decided anew"
                f" ({', '.join(map(str, self.parameters.changing))})."
            )

    def report_survey(
        self, done: Sequence[AboveGroundSummary], empty: Sequence[LasFile], progress: Progress
    ) -> None:
        """Warn of files without ground; refuse them if no file has any."""
        files = [(summary.ground_count, summary.without_ground) for summary in done]
        self.ground.report_survey(files, progress)

    def in_block(self, visit: Visit, progress: Progress) -> tuple[np.ndarray, np.ndarray]:
        """Return the positions of the wanted points and their classes; 0 if there is no ground."""
        contents = visit.contents(progress.part(0.0, 0.1))
        core, (points, known, *_), flags = visit.core(contents), contents, contents.flags
        positions = contents.positions[core]
        if not len(positions) or not known.any():
            return positions, np.zeros(len(positions), dtype=np.uint8)
        ground = with_roads(points, known, flags[ROADS_FLAG], progress.part(0.1, 0.2))
        rest = progress.part(0.2, 1.0)
        classes = classes_above_ground(points, ground, flags[MULTI_RETURN], self.parameters, rest)
        return positions, classes[core]

    def applied(self, part: PointCloud, values: np.ndarray) -> PointCloud:
        """Return points with their classes; a value of 0 leaves the class as it is."""
        classes = np.where(values > 0, values, part.classification).astype(np.uint8)
        return with_classes(part, classes)

    def numbers(self, part: PointCloud, after: PointCloud, values: np.ndarray) -> dict[str, int]:
        """Return how many points are ground, and how many have another class than before."""
        is_ground = is_one_of(after.classification, self.ground.ground_classes)
        is_changed = after.classification != part.classification
        return {
            "ground_count": int(np.count_nonzero(is_ground)),
            "changed_count": int(np.count_nonzero(is_changed)),
        }


TOOL = PointTool(
    step=ClassifyAboveGround,
    list_name="above_ground.vpc",
    sets=(AboveGround, GroundClasses),
    inputs=(
        Input(
            "area",
            "area",
            Area,
            "Only points in {area} change. Points outside keep their class. Empty: all points.",
        ),
    ),
    command="above-ground",
    identifier="classifyaboveground",
    title="Classify above ground",
    about="The classes are low, medium and high vegetation (3, 4, 5) by height above ground,"
    " buildings (6), bridges (17) and high noise (18). Buildings are found by planes that laser"
    " pulses meet once; without return numbers the planes alone decide, and smooth crowns can"
    " become buildings.\n"
    "Only points of class 0 and 1 change, unless you ask for more. Nothing else in the file"
    " changes. Lengths are metres, whatever the unit of the CRS.",
    page="heights#classes-above-the-ground",
    words=(
        CLOUD,
        CANOPY,
        "buildings,roofs,trees,classes,classification,bridges,noise,lasclassify,asprs,ign",
    ),
    output_label="Point cloud with all classes",
    output_help="The same points, with the classes above the ground.",
    numbers=(
        ("POINT_COUNT", "Points"),
        ("GROUND_COUNT", "Ground points"),
        ("CHANGED_COUNT", "Points with a new class"),
    ),
)
