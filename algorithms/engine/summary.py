"""What runs return: numbers of points, and what could not be done."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, Mapping


@dataclass(frozen=True)
class JobCost:
    """The time and memory that a job took."""

    job: str  # "blocks" or the name of a file
    seconds: float  # of wall-clock time
    memory: int | None  # most bytes at a time; None if unknown, or other jobs ran in the process
    planned: int  # most bytes that it was expected to take


class RunSummary:
    """Base of what runs return, frozen dataclasses."""

    # The results of tools that drew further outputs, such as contour lines, by output.
    drawn: Mapping[str, Any] = MappingProxyType({})
    vpc: str | None = None  # the virtual point cloud of many files
    failures: Mapping[str, str] = MappingProxyType({})  # why files could not be done

    @property
    def tiles(self) -> tuple[Any, ...]:
        return (self,)

    @property
    def text(self) -> str:
        """What the run did, as a sentence."""
        raise NotImplementedError

    def line(self, output: Path) -> str:
        """Return the text with the output, or with the input if nothing was written."""
        return f"{output}: {self.text}"


class TileSummary(RunSummary):
    """Base of the summaries of written files."""

    name: str  # of the file
    class_counts: dict[int, int]  # points of each class in the output

    def __post_init__(self) -> None:
        # The keys of the JSON record are strings.
        counts = {int(value): count for value, count in self.class_counts.items()}
        object.__setattr__(self, "class_counts", counts)

    def line(self, output: Path) -> str:
        return f"{output.parent / self.text}"  # which begins with the name


@dataclass(frozen=True)
class SurveySummary(RunSummary):
    """The result of a run on a survey."""

    tile_count: int  # files in the survey
    done_count: int  # finished files, of this run and of earlier ones
    kept_count: int  # files that an earlier run finished
    point_count: int  # in the finished files
    ground_count: int  # in the finished files
    # Why the other files could not be processed, by path.
    failures: Mapping[str, str] = field(default_factory=dict)
    vpc: str = ""  # the virtual point cloud of the finished files
    tiles: tuple[Any, ...] = field(default=(), repr=False)  # of the finished files
    jobs: tuple[JobCost, ...] = field(default=(), repr=False)

    @property
    def class_counts(self) -> dict[int, int]:
        """Points of each class in the finished files; empty if a step does not count them."""
        counts: Counter[int] = Counter()
        for tile in self.tiles:
            counts.update(tile.class_counts)
        return dict(sorted(counts.items()))

    @property
    def text(self) -> str:
        kept = f" ({self.kept_count:,} of them in an earlier run)" if self.kept_count else ""
        text = f"{self.done_count:,} of {self.tile_count:,} files are done{kept}"
        if not self.ground_count:
            return f"{text}: {self.point_count:,} points"
        share = self.ground_count / max(self.point_count, 1)
        return (
            f"{text}: {self.ground_count:,} of {self.point_count:,} points are ground ({share:.1%})"
        )
