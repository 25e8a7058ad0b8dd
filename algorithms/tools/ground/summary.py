"""What a classification tells of a file, and of those of a survey that have no ground."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Sequence

from ...classes.without_ground import (
    UNCHANGED,
    WithoutGround,
    refuse_groundless,
    report_groundless,
)
from ...core.progress import Progress
from ...engine.summary import TileSummary
from ...las.lasfile import LasFile


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
    # Of these, the points of classes that their point format reserves.
    reserved_class_counts: dict[int, int] = field(default_factory=dict)
    class_counts: dict[int, int] = field(default_factory=dict)  # in the output, also outside
    found_ground: bool = True  # in the area
    why_no_ground: str = ""  # of one of many files, a sentence if the reason is known

    def __post_init__(self) -> None:
        super().__post_init__()
        # The keys of the JSON record are strings.
        for name in ("input_class_counts", "reserved_class_counts"):
            counts = {int(value): count for value, count in vars(self)[name].items()}
            object.__setattr__(self, name, counts)

    @property
    def without_ground(self) -> WithoutGround:
        """The warning about one of many files in which no ground was found."""
        took_part = self.selected_count or self.class_counts != self.input_class_counts
        fate = "written as not ground" if took_part else UNCHANGED
        return WithoutGround(self.name, self.area_count, fate, self.why_no_ground)

    @property
    def text(self) -> str:
        """The share of the ground in words."""
        ground, count = self.area_ground_count, self.area_count
        where = " in the area" if count < self.point_count else ""
        share = 100 * ground / max(count, 1)
        return f"{self.name}: {ground:,} of {count:,} points{where} are ground ({share:.1f} %)"


def report_groundless_files(
    done: Sequence[Summary], unwritten: Sequence[LasFile], has_area: bool, progress: Progress
) -> None:
    """Warn of files of a survey without ground, written or not; refuse a survey in which no file
    has any.
    """
    without = [summary.without_ground for summary in done if not summary.found_ground]
    without = [file for file in without if file.points]
    without += [WithoutGround(las.path.name, las.count, "not written") for las in unwritten]
    where = " in the area" if has_area else ""
    # Other points near an area may show its ground, though none of them lies in it.
    is_seen = has_area and not all(file.why for file in without)
    is_known = any(summary.found_ground or summary.by_hand_count for summary in done)
    if is_known or is_seen or not without:
        report_groundless(without, progress, where=where)
        return
    reasons = {file.why for file in without}
    why = without[0].why if len(reasons) == 1 else ""
    advice = why or "Check the parameters and the selection of points."
    if done and not any(summary.selected_count for summary in done):
        advice = f"{why or 'No point takes part.'} Choose other classes or returns to classify."
    refuse_groundless([file.name for file in without], f"ground{where}", advice)
