"""The figures of a delivery."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, is_dataclass

from ..tools.check.results import Check
from ..tools.contours import Interval
from ..tools.quality.figures import Quality
from ..tools.review import ReviewSummary
from ..tools.water.tool import WaterSummary

_NO_CHECKPOINTS = "accuracy", "not measured: no checkpoints are given"
# The facts on accuracy that matter most, by their names.
_MAIN = (
    "look at this", "checkpoints", "not counted", "points NVA", "points VVA", "verdict",
    "held out, all", "what it shows",
)  # fmt: skip


@dataclass
class DeliverySummary:
    """The files and figures of a delivery."""

    folder: str
    delivery: str
    page: str  # that lists and shows them
    cloud: str = ""  # the classified file, or the virtual point cloud of many
    # rasters and vector files that maps show, by names of `RASTERS` and of vector layers
    layers: dict[str, str] = field(default_factory=dict)
    point_count: int = 0
    ground_count: int = 0
    class_counts: dict[int, int] = field(default_factory=dict)
    cell_size: float = 1.0  # of the terrain model, in metres or in the unit asked for
    cell_text: str = ""  # the same in words, with its unit
    # why some of many files are left out, by their paths
    failures: dict[str, str] = field(default_factory=dict)
    warnings: list[str] = field(default_factory=list)
    seconds: dict[str, float] = field(default_factory=dict)  # by the titles of rows
    quality: Quality | None = field(default=None, repr=False)
    # errors at checkpoints and at points that were held out
    check: Check | None = field(default=None, repr=False)
    water: WaterSummary | None = None  # that was found; None if none was looked for
    review: ReviewSummary | None = None  # the expected error, and the places to look at
    interval: Interval | None = None  # the height between contour lines

    @property
    def text(self) -> str:
        """The result in words."""
        share = self.ground_count / max(self.point_count, 1)
        return f"{self.ground_count:,} of {self.point_count:,} points are ground ({share:.1%})."

    @property
    def verdict(self) -> str:
        """The verdicts on the errors at checkpoints, and on the specification of the delivery."""
        verdicts = [part.verdict for part in (self.check, self.quality) if part is not None]
        return " ".join(f"{verdict.rstrip('.')}." for verdict in verdicts if verdict)

    def rows(self) -> list[tuple[str, str]]:
        """Return titles and values of the figures that matter most, as text."""
        classes = ", ".join(f"{value}: {count:,}" for value, count in self.class_counts.items())
        rows = [("classes", classes)]
        if self.water is not None:
            rows.append(("water", self.water.text))
        rows += self.accuracy()
        if self.quality is not None and self.quality.verdict:
            rows.append(("comparisons", self.quality.verdict))
        if self.review is not None:
            rows.append(("expected", self.review.text))
        return [*rows, ("cell size", self.cell_text), ("page", self.page)]

    def accuracy(self) -> list[tuple[str, str]]:
        """Return the rows of the errors at checkpoints and at points that were held out."""
        check = self.check
        if check is None:
            return [_NO_CHECKPOINTS]
        rows = [] if check.nva or check.vva else [_NO_CHECKPOINTS]
        return rows + [(fact.name, fact.text) for fact in check.facts if fact.name in _MAIN]

    def lines(self) -> list[str]:
        """Return the figures as lines of text."""
        return [f"{title:<15} {value}" for title, value in self.rows()]

    def as_dict(self) -> dict[str, object]:
        """Return all figures as plain values."""
        return {name: _plain(value) for name, value in vars(self).items()}


def _plain(value: object) -> object:
    if hasattr(value, "as_dict"):
        return value.as_dict()
    return asdict(value) if is_dataclass(value) and not isinstance(value, type) else value
