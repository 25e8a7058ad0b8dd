"""The step that finds the ground, and the classes that follow from it."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from pathlib import Path
from typing import Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet
from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..filters import method_of
from ..las.cloud import PointCloud
from ..las.edits import Edits
from ..las.lasfile import LasFile
from ..survey.area import Area
from ..survey.corrections import NO_CORRECTIONS, Corrections
from ..survey.kept_classes import overlapping
from ..survey.point_chooser import PointChooser
from ..survey.point_counts import PointCounts, by_class, count_classes
from ..survey.selection import Selection
from .blocks import Blocks
from .explanation import Explanation
from .ground import Label, blocks_of, label_ground
from .memory import Resources
from .output import Output, height_dimension
from .steps import Allocate, PointResult, PointStep, RememberedClasses
from .store import Marks, Store


@dataclass(frozen=True, order=True)
class ClassifiedSummary:
    """The result for one file of a survey.

    Attributes
    ----------
    name : str
        Name of the output.
    point_count, ground_count : int
        Numbers of all points and of points of the target class. If only the area is written,
        only points in the area count.
    area_count, by_hand_count : int
        Numbers of points in the area, and of points whose class is known by hand.
    overlap_count : int
        Number of points of overlap.
    input_class_counts, class_counts : dict of int to int
        Points of each class in the input, and in the output.
    """

    name: str
    point_count: int
    ground_count: int
    area_count: int = 0
    by_hand_count: int = 0
    overlap_count: int = 0
    input_class_counts: dict[int, int] = field(default_factory=dict)
    class_counts: dict[int, int] = field(default_factory=dict)

    def __post_init__(self) -> None:
        # The keys of the JSON record are strings.
        for name in ("input_class_counts", "class_counts"):
            counts = {int(value): count for value, count in getattr(self, name).items()}
            object.__setattr__(self, name, counts)

    @property
    def text(self) -> str:
        """The summary as a sentence."""
        share = self.ground_count / max(self.point_count, 1)
        return f"{self.name}: {self.point_count:,} points, {share:.1%} ground"


@dataclass(frozen=True)
class LabelGround(PointStep):
    """Finds the ground, low outliers and bridge decks.

    Attributes
    ----------
    parameters : ParameterSet
        The parameters of one method. Their type chooses the method.
    selection : Selection
        Which points take part, and what their classes become.
    area : Area or None
        Where points are classified. Points outside keep their class; those near it are context.
    output : Output
        Which points are written.
    cut : Blocks or None
        The blocks, if they are not those of the method.
    corrections : Corrections
        Corrections by hand, beside those that the files remember.
    explanation : Explanation or None
        Receives which rule decided each cell.
    """

    parameters: ParameterSet
    selection: Selection = field(default_factory=Selection)
    area: Area | None = None
    output: Output = field(default_factory=Output)
    cut: Blocks | None = None
    corrections: Corrections = NO_CORRECTIONS
    explanation: Explanation | None = field(default=None, compare=False)

    counts = PointCounts
    summary_type = ClassifiedSummary
    vpc_name = "classified.vpc"

    @property
    def blocks(self) -> Blocks:
        """The blocks in which the method works."""
        return self.cut or blocks_of(self.parameters)

    @property
    def chooser(self) -> PointChooser:
        """Chooses the points that take part."""
        reach = method_of(self.parameters).reach(self.parameters)
        return PointChooser(self.selection, self.area, reach, self.corrections)

    def marks(self, part: PointCloud, counts: PointCounts) -> Marks:
        """Return which points take part, are known ground, and lie in the area."""
        inside, selected, known = self.chooser.choose(part, counts)
        return Marks(selected, known, inside)

    def tell(self, counts: PointCounts, path: Path, progress: Progress) -> None:
        """Report how many points take part; refuse a file without any."""
        self.chooser.tell(counts, path, progress)

    def check_tile(self, tile: LasFile) -> None:
        """Refuse a file whose points cannot hold the classes."""
        self.chooser.check_classes(tile.path, tile.point_format)

    def count(self, part: PointCloud, counts: PointCounts) -> None:
        """Count which points take part."""
        self.chooser.choose(part, counts)

    def tell_of_tile(self, counts: PointCounts, path: Path, progress: Progress) -> None:
        """Report how many points took part; refuse a file without any.

        If an area is given, a file need not have points in it.
        """
        if self.area is None or counts.of_returns:
            self.selection.tell(counts, path, progress)

    def check_survey(self, box: Box) -> None:
        """Refuse the survey if the area lies outside its extent."""
        if self.area is not None and not self.area.may_touch(box):
            raise self.chooser.no_point_in_area("the files", box)

    def skips(self, tile: LasFile) -> bool:
        """Return whether only the area is written and a file lies outside it."""
        if self.area is None or not self.output.area_only:
            return False
        return not self.area.may_touch(tile.outer_box)

    def tell_of_survey(self, done: Sequence[ClassifiedSummary], progress: Progress) -> None:
        """Tell which classes stay; warn if no point lies in the area or in the corrections."""
        counts = PointCounts(overlap=sum(each.overlap_count for each in done))
        for summary in done:
            for value, count in summary.input_class_counts.items():
                counts.classes[value] += count
        self.selection.tell_of_kept(counts, progress)
        if self.area is not None and not any(each.area_count for each in done):
            progress.warning(
                "No point lies in the area. Give the extent or the boundary in the CRS of the"
                " points."
            )
        elif not any(each.by_hand_count for each in done):
            self.chooser.tell_of_corrections(progress)

    def work(self, store: Store, resources: Resources, progress: Progress) -> None:
        """Label the points."""
        label_ground(
            store,
            self.parameters,
            self.blocks,
            self.selection,
            resources,
            progress,
            self.explanation,
        )

    def result(self, path: Path, allocate: Allocate) -> ClassifiedPoints:
        """Return an object that turns the labels of a file into classes."""
        return ClassifiedPoints(self, path, allocate)


class ClassifiedPoints(PointResult):
    """The new classes of the points of a file.

    Parameters
    ----------
    step : LabelGround
        The step.
    path : Path
        The file.
    allocate : callable
        Returns an array of one value for each point.

    Attributes
    ----------
    classification : numpy.ndarray of uint8, shape (n,)
        The new class of every point, in file order.
    class_counts : numpy.ndarray of int64, shape (256,)
        Numbers of written points of each class.
    area_ground_count, area_low_count, area_deck_count, area_high_count : int
        Numbers of points in the area with the class of the ground, of low outliers, of points on
        bridge decks, and of high outliers.
    """

    def __init__(self, step: LabelGround, path: Path, allocate: Allocate) -> None:
        self._step, self._path = step, path
        self.classification = allocate(np.uint8)
        self._inside = allocate(bool) if step.output.area_only else None
        self._memory = RememberedClasses(allocate, step.selection.remember_classes)
        self.class_counts = np.zeros(256, dtype=np.int64)
        self.area_ground_count = self.area_low_count = self.area_deck_count = 0
        self.area_high_count = 0
        self._area_count = self._by_hand_count = self._overlap_count = 0
        self._counts_before = np.zeros(256, dtype=np.int64)
        self._has_ground = False

    def add(self, where: slice, part: PointCloud, values: np.ndarray) -> None:
        """Set the classes of some points from their labels, and count them."""
        selection, chooser = self._step.selection, self._step.chooser
        inside = chooser.inside(part)
        ground, low, decks, high = (values == label for label in Label)
        by_hand = chooser.by_hand(part)
        classes = selection.classes(part, ground, low, inside, decks, by_hand, high)
        self.classification[where] = classes
        self._counts_before += count_classes(part.classification)
        self._overlap_count += int(np.count_nonzero(overlapping(part)))
        self._memory.add(where, part, classes)
        if self._inside is not None:
            self._inside[where] = inside
        self.class_counts += count_classes(classes if self._inside is None else classes[inside])
        self._area_count += int(np.count_nonzero(inside))
        if by_hand is not None:
            self._by_hand_count += int(np.count_nonzero(by_hand.known & inside))
        self._has_ground |= bool(ground.any())
        ground = classes == selection.to_class
        self.area_ground_count += int(np.count_nonzero(ground & inside))
        self.area_low_count += int(np.count_nonzero(low & inside))
        self.area_deck_count += int(np.count_nonzero(decks & inside))
        self.area_high_count += int(np.count_nonzero(high & inside))

    def part(self, where: slice, part: PointCloud) -> PointCloud:
        """Return points with their new classes; points that are not written become withheld."""
        part = dataclasses.replace(part, classification=self.classification[where])
        part = self._memory.part(where, part)
        if self._inside is not None:
            part = dataclasses.replace(part, withheld=part.withheld | ~self._inside[where])
        return part

    def refine(self, where: slice, part: PointCloud, values: np.ndarray) -> None:
        """Set further classes of some points, and count them; 0 leaves a class as it is."""
        before = self.classification[where].copy()
        classes = np.where(values > 0, values, before).astype(np.uint8)
        self.classification[where] = classes
        self._memory.add(where, part, classes)
        counted = slice(None) if self._inside is None else self._inside[where]
        self.class_counts += count_classes(classes[counted]) - count_classes(before[counted])

    @property
    def is_empty(self) -> bool:
        """Whether no point is to be written."""
        if self._inside is None:
            return False
        return not (self.area_ground_count if self._step.output.ground_only else self._area_count)

    def check(self, why: str = "") -> None:
        """Refuse to write a file without ground.

        A file at the border of an area is allowed to have none: few of its points may be in it.
        """
        if self._has_ground:
            return
        if self._step.area is None or (why and self._area_count):
            raise BareEarthError(why or f"No ground was found in {self._path}.")

    def tell(self, progress: Progress) -> None:
        """Report the numbers of outliers and of points on bridges in the area."""
        selection = self._step.selection
        if selection.low_noise_class:
            progress.info(
                f"{self.area_low_count:,} points lie more than {selection.low_noise_depth:g} m"
                " below the ground, or in groups below ground all round them: low noise."
            )
        if selection.high_noise_class:
            progress.info(
                f"{self.area_high_count:,} points hang {selection.high_noise_height:g} m and more"
                " above all others of their place: high noise."
            )
        if self.area_deck_count:
            progress.info(
                f"{self.area_deck_count:,} points lie on decks of bridges: they are not ground."
            )

    def edits(
        self,
        cloud: PointCloud,
        progress: Progress = SILENT,
        heights: np.ndarray | None = None,
    ) -> Edits:
        """Return the new classes and all other changes of the output.

        Raises
        ------
        BareEarthError
            If no point would be written, or no height can be measured.
        """
        output, kept = self._step.output, self._inside
        if kept is not None:
            count = np.count_nonzero(~kept)
            progress.info(f"{count:,} points outside of the area are left out of the output.")
        if output.needs_ground:
            ground = self.classification == self._step.selection.to_class
            written = ground if kept is None else ground & kept
            if not written.any():
                raise BareEarthError(
                    f"{cloud.path} has no ground points, so there are no ground points to write,"
                    " and no heights above ground. Check the parameters and the selection of"
                    " points."
                )
            if output.ground_only:
                count = np.count_nonzero(~ground if kept is None else kept & ~ground)
                kept = written
                progress.info(f"{count:,} points that are not ground are left out of the output.")
        extra = None if heights is None else height_dimension(cloud, heights)
        return self._memory.added_to(Edits(self.classification, extra=extra, kept=kept))

    def summary(self, name: str) -> ClassifiedSummary:
        """Return the numbers of points."""
        written = len(self.classification) if self._inside is None else self._area_count
        ground = int(self.class_counts[self._step.selection.to_class])
        return ClassifiedSummary(
            name,
            written,
            ground,
            self._area_count,
            self._by_hand_count,
            self._overlap_count,
            by_class(self._counts_before),
            by_class(self.class_counts),
        )
