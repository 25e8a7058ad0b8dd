"""The step that finds the ground, and the classes that follow from it."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Sequence

import numpy as np

from ...classes.corrections import CONTINUED, NO_CORRECTIONS, ByHand, Corrections
from ...classes.lifts import Lifts
from ...classes.point_chooser import PointChooser
from ...classes.point_counts import PointCounts, by_class
from ...classes.selection import Selection
from ...core.errors import BareEarthError
from ...core.parameters import ParameterSet
from ...core.progress import SILENT, Progress
from ...core.words import counted
from ...engine.blocks import Blocks, Visit
from ...engine.step import CLASSES, MORE, OUTSIDE, Allocate, PointResult, PointStep, with_classes
from ...engine.store import Marks
from ...filters import method_of
from ...las.cloud import PointCloud
from ...las.edits import Edits
from ...las.lasfile import LasFile
from ...las.return_numbers import MULTI_RETURN, SeveralReturns
from ...survey.area import Area
from .labelling import (
    TO_CONTINUE,
    BlockMessages,
    Label,
    blocks_of,
    labelled,
    reach_of,
    report_continued,
    report_notes,
)
from .output import PointOutput
from .summary import Summary, report_groundless_files


@dataclass(frozen=True)
class LabelGround(PointStep):
    """Finds the ground, low outliers and bridge decks."""

    parameters: ParameterSet  # of one method, which their type chooses
    selection: Selection = field(default_factory=Selection)
    area: Area | None = None  # points outside keep their class; those near it are context
    output: PointOutput = field(default_factory=PointOutput)  # which points are written
    cut: Blocks | None = None  # the blocks, if not those of the method
    corrections: Corrections = NO_CORRECTIONS  # beside the ones that the files remember

    counts = PointCounts
    weight = 5.0
    imports = ("scipy.ndimage",)
    summary_type = Summary

    @property
    def blocks(self) -> Blocks:
        """The blocks in which the method works."""
        more = (True,) if self.corrections.continues else ()
        return self.cut or blocks_of(self.parameters, *more)

    @property
    def chooser(self) -> PointChooser:
        """Chooses the points that take part."""
        reach = reach_of(self.parameters, self.corrections.continues)
        return PointChooser(self.selection, self.area, reach, self.corrections)

    @property
    def changes(self) -> frozenset[str]:
        """What differs in the output."""
        changes = {CLASSES}
        if self.output.changes_points or self.selection.remember_classes:
            changes.add(MORE)
        if self.output.area_only:
            changes.add(OUTSIDE)
        return frozenset(changes)

    def marks(self, part: PointCloud, counts: PointCounts) -> Marks:
        """Return which points take part, are known ground, and get a label."""
        _, selected, known = self.chooser.choose(part, counts)
        flags: dict[str, Any] = {MULTI_RETURN: SeveralReturns(part)}
        if self.corrections.continues:
            flags[TO_CONTINUE] = self.corrections.classes_of(part) == CONTINUED
        return Marks(selected, known, self.chooser.near(part), flags)

    def applied(self, part: PointCloud, values: np.ndarray) -> PointCloud:
        """Return points with their new classes, also those near the area: they keep their class
        where they are written, but rasters and heights in the area need the ground round it.
        """
        return self.decided(part, values, self.chooser.near(part), self.chooser.by_hand(part))

    def decided(
        self, part: PointCloud, values: np.ndarray, inside: np.ndarray, by_hand: ByHand | None
    ) -> PointCloud:
        """Return points with their new classes, given which change, and which are set by hand; if
        only the area is written, the others become withheld.
        """
        ground, low, decks, high = (values == label for label in Label)
        classes = self.selection.classes(part, ground, low, inside, decks, by_hand, high)
        part = with_classes(part, classes, self.selection.remember_classes)
        if self.output.area_only:
            part = dataclasses.replace(part, withheld=part.withheld | ~inside)
        return part

    def report_counts(self, counts: PointCounts, path: Path, progress: Progress) -> None:
        """Report how many points take part; refuse a file without any."""
        self.chooser.report(counts, path, progress)

    def check_file(self, file: LasFile) -> None:
        """Refuse a file whose points cannot hold the classes."""
        self.chooser.check_classes(file.path, file.point_format)

    def report_survey(
        self, done: Sequence[Summary], empty: Sequence[LasFile], progress: Progress
    ) -> None:
        """Tell which files have no ground and which classes stay, and warn if no point lies in the
        area or in the corrections; refuse files if none has ground.
        """
        if self.output.area_only:
            super().report_survey(done, empty, progress)
            empty = ()
        report_groundless_files(done, empty, self.area is not None, progress)
        counts = PointCounts(overlap=sum(summary.overlap_count for summary in done))
        for summary in done:
            for value, count in summary.input_class_counts.items():
                counts.classes[value] += count
            for value, count in summary.reserved_class_counts.items():
                counts.classes[value] -= count  # each file has told of them
        self.selection.report_kept(counts, progress)
        if self.area is not None and not any(summary.area_count for summary in done):
            progress.warning(
                "No point lies in the area. Give the extent or the boundary in the CRS of the"
                " points."
            )
        elif not any(summary.by_hand_count for summary in done):
            self.chooser.report_unused_corrections(progress)

    def in_block(self, visit: Visit, progress: Progress) -> tuple[Any, ...]:
        """Label the points of a block; see `labelled`."""
        return labelled(visit, self.parameters, self.selection, progress)

    def report_blocks(
        self, notes: Sequence[BlockMessages], has_known: bool, progress: Progress
    ) -> None:
        """Report what was found in the blocks; refuse points without ground in any."""
        method = method_of(self.parameters)
        if has_known and not method.takes_known_ground:
            progress.info(
                f"{method.label} does not start from known ground; it only keeps these"
                " points as ground."
            )
        report_notes(progress, [of_block for of_block in notes if of_block.count])
        if self.corrections.continues:
            report_continued(sum(of_block.continued for of_block in notes), progress)

    def result(self, path: Path, allocate: Allocate) -> ClassifiedPoints:
        return ClassifiedPoints(self, path)


class ClassifiedPoints(PointResult):
    """The numbers of classified points of a file, in its area and in all."""

    def __init__(self, step: LabelGround, path: Path) -> None:
        super().__init__(step)
        self._path, self._counts = path, PointCounts()
        self._ground_count = 0  # with the class of the ground
        # in the area
        self._area_ground_count = self._by_hand_count = 0
        self._low_count = self._deck_count = self._high_count = 0
        self._has_ground, self._why = False, ""
        self._lifts = Lifts(step.corrections, step.selection.to_class)

    def add(
        self, where: slice, before: PointCloud, values: np.ndarray
    ) -> tuple[PointCloud, np.ndarray | None]:
        """Return points with their new classes, and which of them are written; count them."""
        chooser, output = self._step.chooser, self._step.output
        inside, _, _ = chooser.choose(before, self._counts)
        by_hand = chooser.by_hand(before)
        after = self._step.decided(before, values, inside, by_hand)
        ground = after.classification == self._step.selection.to_class
        kept = inside if output.area_only else None
        if output.ground_only:
            kept = ground if kept is None else ground & inside
        self._lifts.see(after, ground)
        self._has_ground |= bool(((values == Label.GROUND) & inside).any())
        if by_hand is not None:
            self._by_hand_count += int(np.count_nonzero(by_hand.known & inside))
        self._ground_count += int(np.count_nonzero(ground))
        self._area_ground_count += int(np.count_nonzero(ground & inside))
        self._low_count += int(np.count_nonzero((values == Label.LOW) & inside))
        self._deck_count += int(np.count_nonzero((values == Label.BRIDGE) & inside))
        self._high_count += int(np.count_nonzero((values == Label.HIGH) & inside))
        return after, kept

    @property
    def _written_ground_count(self) -> int:
        return self._area_ground_count if self._step.output.area_only else self._ground_count

    def report(self, progress: Progress, failure: str | None = None) -> None:
        """Report how many points of one of many files took part, or what was found in the only
        file; refuse the only file if there is no ground to write.
        """
        if failure is not None:
            if self._counts.of_returns:
                self._step.selection.report(self._counts, self._path, progress)
            self._why = failure or self._counts.why_none
            return
        self._lifts.report(progress)
        selection, output = self._step.selection, self._step.output
        if output.ground_only and not self._written_ground_count:
            raise BareEarthError(
                f"{self._path} has no ground points, so that there is nothing to write. Check the"
                " parameters and the selection of points."
            )
        if selection.low_noise_class:
            progress.info(
                f"{counted(self._low_count, 'point lies', 'points lie')} more than"
                f" {selection.low_noise_depth:g} m below the ground, or in groups below ground all"
                " round them: low noise."
            )
        if selection.high_noise_class:
            progress.info(
                f"{counted(self._high_count, 'point hangs', 'points hang')}"
                f" {selection.high_noise_height:g} m and more above all others of their place: high"
                " noise."
            )
        if self._deck_count:
            words = "point on a deck of a bridge is", "points on decks of bridges are"
            progress.info(f"{counted(self._deck_count, *words)} not ground.")

    def edits(self, cloud: PointCloud, progress: Progress = SILENT) -> Edits:
        """Report how many points are left out of the output."""
        output, counts = self._step.output, self._counts
        count, ground = counts.points, self._written_ground_count
        if output.area_only:
            count, left_out = counts.inside, count - counts.inside
            words = "point outside of the area is", "points outside of the area are"
            progress.info(f"{counted(left_out, *words)} left out of the output.")
        if output.ground_only:
            words = "point that is not ground is", "points that are not ground are"
            progress.info(f"{counted(count - ground, *words)} left out of the output.")
        return Edits()

    def summary(self, name: str, class_counts: dict[int, int]) -> Summary:
        counts, to_class = self._counts, self._step.selection.to_class
        return Summary(
            name,
            counts.points,
            counts.inside,
            counts.wanted,
            class_counts.get(to_class, 0),
            self._area_ground_count,
            self._by_hand_count,
            counts.overlap,
            by_class(counts.classes),
            by_class(counts.reserved),
            class_counts,
            self._has_ground,
            "" if self._has_ground else self._why,
        )
