"""The step that finds the ground, and the classes that follow from it."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Sequence

import numpy as np

from ...classes.corrections import NO_CORRECTIONS, ByHand, Corrections
from ...classes.point_chooser import PointChooser
from ...classes.point_counts import PointCounts, by_class
from ...classes.selection import Selection
from ...core.errors import BareEarthError
from ...core.files import Outputs
from ...core.parameters import ParameterSet
from ...core.points import Box, Frame
from ...core.progress import SILENT, Progress
from ...core.words import counted
from ...engine.blocks import Block, Blocks, Visit
from ...engine.step import Allocate, PointResult, PointStep, Step, with_classes
from ...engine.store import Marks, Store
from ...engine.summary import TileSummary
from ...filters import method_of
from ...las.cloud import PointCloud
from ...las.edits import Edits
from ...las.lasfile import LasFile
from ...las.return_numbers import MULTI_RETURN, SeveralReturns
from ...rasters.writing import raster_file
from ...survey.area import Area
from .explanation import ExplainedCells, write_explanation
from .labelling import Label, blocks_of, labelled, tell
from .looks import Look, label_of, looks_in, looks_of
from .output import Output


@dataclass(frozen=True, order=True)
class Summary(TileSummary):
    """The result of a classification; without an area, all points are in it."""

    name: str  # of the output
    point_count: int  # of the input
    area_count: int  # in the area
    selected_count: int  # in the area, took part in the filter
    ground_count: int  # of the target class in the output, also outside
    area_ground_count: int  # of the target class in the area
    by_hand_count: int = 0  # in the area, whose class is known by hand
    overlap_count: int = 0
    input_class_counts: dict[int, int] = field(default_factory=dict)
    class_counts: dict[int, int] = field(default_factory=dict)  # in the output, also outside
    found_ground: bool = True

    def __post_init__(self) -> None:
        super().__post_init__()
        # The keys of the JSON record are strings.
        counts = {int(value): count for value, count in self.input_class_counts.items()}
        object.__setattr__(self, "input_class_counts", counts)

    @property
    def text(self) -> str:
        """The share of the ground in words."""
        ground, count = self.area_ground_count, self.area_count
        where = " in the area" if count < self.point_count else ""
        share = 100 * ground / max(count, 1)
        return f"{self.name}: {ground:,} of {count:,} points{where} are ground ({share:.1f} %)"


@dataclass(frozen=True)
class LabelGround(PointStep):
    """Finds the ground, low outliers and bridge decks."""

    parameters: ParameterSet  # of one method, which their type chooses
    selection: Selection = field(default_factory=Selection)
    area: Area | None = None  # points outside keep their class; those near it are context
    output: Output = field(default_factory=Output)  # which points are written
    cut: Blocks | None = None  # the blocks, if not those of the method
    corrections: Corrections = NO_CORRECTIONS  # beside those that the files remember
    explain: Path | None = None  # raster of the rules that decided, of one file

    counts = PointCounts
    weight = 5.0
    imports = ("scipy.ndimage",)
    summary_type = Summary

    @property
    def blocks(self) -> Blocks:
        """The blocks in which the method works."""
        return self.cut or blocks_of(self.parameters)

    @property
    def chooser(self) -> PointChooser:
        """Chooses the points that take part."""
        reach = method_of(self.parameters).reach(self.parameters)
        return PointChooser(self.selection, self.area, reach, self.corrections)

    @property
    def _looks(self) -> tuple[Look, ...]:
        """The looks beside that of the filter."""
        return () if self.output.looks == "1" else tuple(looks_of(self.parameters))

    @property
    def only_classes(self) -> bool:
        """Whether the output differs only in its classes."""
        return not (self.output.changes_points or self.selection.remember_classes)

    def marks(self, part: PointCloud, counts: PointCounts) -> Marks:
        """Return which points take part, are known ground, and lie in the area."""
        inside, selected, known = self.chooser.choose(part, counts)
        return Marks(selected, known, inside, {MULTI_RETURN: SeveralReturns(part)})

    def applied(self, part: PointCloud, values: np.ndarray) -> PointCloud:
        """Return points with their new classes; points that are not written become withheld."""
        return self.decided(part, values, self.chooser.inside(part), self.chooser.by_hand(part))

    def decided(
        self, part: PointCloud, values: np.ndarray, inside: np.ndarray, by_hand: ByHand | None
    ) -> PointCloud:
        """Return points as `applied`, given those in the area and those set by hand."""
        labels = label_of(values)
        ground, low, decks, high = (labels == label for label in Label)
        classes = self.selection.classes(part, ground, low, inside, decks, by_hand, high)
        part = with_classes(part, classes, self.selection.remember_classes)
        if self.output.area_only:
            part = dataclasses.replace(part, withheld=part.withheld | ~inside)
        if self.output.looks != "1":
            part = dataclasses.replace(part, looks=looks_in(values, Label.GROUND))
        return part

    def tell(self, counts: PointCounts, path: Path, progress: Progress) -> None:
        """Report how many points take part; refuse a file without any."""
        self.chooser.tell(counts, path, progress)

    def check_tile(self, tile: LasFile) -> None:
        """Refuse a file whose points cannot hold the classes."""
        self.chooser.check_classes(tile.path, tile.point_format)

    @property
    def writes_all(self) -> bool:
        """Whether all points are written, and not only the ground."""
        return not self.output.ground_only

    def check_survey(self, box: Box, steps: Sequence[Step]) -> None:
        """Refuse a survey that the area does not touch, or an explanation of many files."""
        if self.explain is not None:
            raise BareEarthError("The raster of rules (explain) is made of one file, not of many.")
        if self.area is not None and not self.area.may_touch(box):
            raise self.chooser.no_point_in_area("the files", box)

    def skips(self, tile: LasFile) -> bool:
        """Return whether only the area is written and a file lies outside it."""
        if self.area is None or not self.output.area_only:
            return False
        return not self.area.may_touch(tile.outer_box)

    def tell_of_survey(self, done: Sequence[Summary], progress: Progress) -> None:
        """Tell which classes stay, warn if no point lies in the area or in the corrections, and
        refuse files none of which has points that can be ground.
        """
        if self.area is None and done and not any(summary.found_ground for summary in done):
            raise BareEarthError(
                f"None of the {len(done):,} files could be done: no point of them can be"
                " classified. Choose other classes to classify."
            )
        counts = PointCounts(overlap=sum(summary.overlap_count for summary in done))
        for summary in done:
            for value, count in summary.input_class_counts.items():
                counts.classes[value] += count
        self.selection.tell_of_kept(counts, progress)
        if self.area is not None and not any(summary.area_count for summary in done):
            progress.warning(
                "No point lies in the area. Give the extent or the boundary in the CRS of the"
                " points."
            )
        elif not any(summary.by_hand_count for summary in done):
            self.chooser.tell_of_corrections(progress)

    @property
    def outputs(self) -> list[tuple[str, Path]]:
        """The raster of rules, if it is wanted."""
        return [] if self.explain is None else [("raster", self.explain)]

    def in_block(self, visit: Visit, progress: Progress) -> tuple[Any, ...]:
        """Label the points of a block; see `labelled`."""
        explains = self.explain is not None
        return labelled(visit, self.parameters, self.selection, explains, self._looks, progress)

    def end(
        self, store: Store, results: Sequence[tuple[Block, Any]], progress: Progress
    ) -> list[ExplainedCells]:
        """Tell what was found in the blocks, and refuse points without ground in any; return the
        cells of the rules that decided, if they are wanted.
        """
        method = method_of(self.parameters)
        if store.has_known and not method.takes_known_ground:
            progress.info(
                f"{method.label} does not start from known ground; it only keeps these"
                " points as ground."
            )
        tell(progress, [notes for _, (notes, _) in results if notes.count])
        return [cells for _, (_, cells) in results if cells is not None]

    def finish(
        self,
        result: Sequence[ExplainedCells],
        frame: Frame,
        outputs: Outputs,
        progress: Progress,
        tiles: Sequence[LasFile] | None = None,
    ) -> None:
        """Write the raster of rules, if it is wanted."""
        if self.explain is not None:
            write_explanation(raster_file(outputs, self.explain), result, frame, progress)

    def result(self, path: Path, allocate: Allocate) -> ClassifiedPoints:
        """Return an object that counts the classified points of a file."""
        return ClassifiedPoints(self, path, allocate)


class ClassifiedPoints(PointResult):
    """The numbers of classified points of a file, in its area and in all, and which points are
    written; `allocate` returns an array of one value for each point.
    """

    def __init__(self, step: LabelGround, path: Path, allocate: Allocate) -> None:
        super().__init__(step)
        self._path, self._counts, output = path, PointCounts(), step.output
        # bool, (n,); None for all
        self.kept = allocate(bool) if output.ground_only or output.area_only else None
        self._ground_count = 0  # with the class of the ground
        # in the area
        self._area_ground_count = self._by_hand_count = 0
        self._low_count = self._deck_count = self._high_count = 0
        self._has_ground = False

    def applied(self, part: PointCloud, values: np.ndarray) -> PointCloud:
        """Return points with their new classes, and keep for `add` which lie in the area."""
        chooser = self._step.chooser
        # Kept, since searching points in polygons takes long.
        self._inside, _, _ = chooser.choose(part, self._counts)
        self._by_hand = chooser.by_hand(part)
        return self._step.decided(part, values, self._inside, self._by_hand)

    def add(self, where: slice, before: PointCloud, after: PointCloud, values: np.ndarray) -> None:
        """Count some points, given their labels."""
        inside, by_hand = self._inside, self._by_hand
        ground = after.classification == self._step.selection.to_class
        if self.kept is not None:
            self.kept[where] = inside if self._step.output.area_only else True
            if self._step.output.ground_only:
                self.kept[where] &= ground
        labels = label_of(values)
        self._has_ground |= bool((labels == Label.GROUND).any())
        if by_hand is not None:
            self._by_hand_count += int(np.count_nonzero(by_hand.known & inside))
        self._ground_count += int(np.count_nonzero(ground))
        self._area_ground_count += int(np.count_nonzero(ground & inside))
        self._low_count += int(np.count_nonzero((labels == Label.LOW) & inside))
        self._deck_count += int(np.count_nonzero((labels == Label.BRIDGE) & inside))
        self._high_count += int(np.count_nonzero((labels == Label.HIGH) & inside))

    @property
    def is_empty(self) -> bool:
        """Whether no point is to be written."""
        if not self._step.output.area_only:
            return False
        in_area = self._area_ground_count if self._step.output.ground_only else self._counts.inside
        return not in_area

    def check(self, progress: Progress, why: str = "") -> None:
        """Tell how many points of one of many files took part, or refuse it without ground."""
        step, counts = self._step, self._counts
        # If an area is given, a file need not have points in it. Others need not have points that
        # can be ground, such as a file of water only.
        if step.area is None and not (counts.eligible or step.output.ground_only):
            classes = np.flatnonzero(counts.classes).tolist()
            words = "class" if len(classes) == 1 else "classes"
            all_are = f"all are of {words} {', '.join(map(str, classes))}"
            reason = all_are if counts.free else "all are withheld"
            progress.warning(f"No point can be ground: {reason}. The file is written unchanged.")
            return
        if step.area is None or counts.of_returns:
            step.selection.tell(counts, self._path, progress)
        if not self._has_ground and (step.area is None or (why and counts.inside)):
            raise BareEarthError(why or f"No ground was found in {self._path}.")

    def tell(self, progress: Progress) -> None:
        """Report the numbers of outliers and of points on bridges in the area."""
        selection = self._step.selection
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
        """Return which points are written; refuse a file without any, or without heights."""
        output, counts = self._step.output, self._counts
        count, ground = counts.points, self._ground_count
        if output.area_only:
            count, ground, left_out = counts.inside, self._area_ground_count, count - counts.inside
            words = "point outside of the area is", "points outside of the area are"
            progress.info(f"{counted(left_out, *words)} left out of the output.")
        # Without an area, only files come here without ground whose points are written as they are.
        is_needed = output.ground_only or self._step.area is not None
        if output.needs_ground and is_needed and not ground:
            raise BareEarthError(
                f"{cloud.path} has no ground points, so there are no ground points to write,"
                " and no heights above ground. Check the parameters and the selection of"
                " points."
            )
        if output.ground_only:
            words = "point that is not ground is", "points that are not ground are"
            progress.info(f"{counted(count - ground, *words)} left out of the output.")
        return Edits(kept=self.kept)

    def summary(self, name: str, class_counts: dict[int, int]) -> Summary:
        """Return the numbers of points."""
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
            class_counts,
            self._has_ground,
        )
