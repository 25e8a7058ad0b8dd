"""What a delivery holds, in figures."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from ..tools.check.hold_out import AGREEMENT
from ..tools.check.results import Check
from ..tools.contours import Interval
from ..tools.quality.figures import Quality
from ..tools.water.tool import WaterSummary


@dataclass(frozen=True)
class DeliverySummary:
    """What a delivery holds."""

    folder: str
    delivery: str
    page: str  # that shows it
    cloud: str  # the classified file, or the virtual point cloud of many
    layers: dict[str, str]  # files that a map shows, by names of `RASTERS` and of vector layers
    point_count: int
    ground_count: int
    class_counts: dict[int, int]
    cell_size: float  # of the terrain model, in metres or in the unit asked for
    cell_text: str  # the same in words, with its unit
    failures: dict[str, str]  # why some of many files are left out, by their paths
    warnings: list[str]
    seconds: dict[str, float]  # that each step took
    quality: Quality = field(repr=False)
    # errors at checkpoints and at points that were held out
    check: Check | None = field(default=None, repr=False)
    water: WaterSummary | None = None  # that was found; None if none was looked for
    interval: Interval | None = None  # the height between contour lines

    @property
    def text(self) -> str:
        """The result in words."""
        share = self.ground_count / max(self.point_count, 1)
        return f"{self.ground_count:,} of {self.point_count:,} points are ground ({share:.1%})."

    def rows(self) -> list[tuple[str, str]]:
        """Return titles and values of the figures that matter most, as text."""
        classes = ", ".join(f"{value}: {count:,}" for value, count in self.class_counts.items())
        found = [("classes", classes)]
        if self.water is not None:
            found.append(("water", self.water.text))
        found += self.accuracy()
        lines, left = self.quality.lines, self.quality.left
        if lines:
            names = ", ".join(f"{each.name} ({each.state})" for each in left)
            passed = f"{len(lines) - len(left)} of {len(lines)} pass"
            found.append(("comparisons", f"{passed}; not: {names}" if left else passed))
        return [*found, ("cell size", self.cell_text), ("page", self.page)]

    def accuracy(self) -> list[tuple[str, str]]:
        """Return the rows of the errors at checkpoints and at points that were held out."""
        check = self.check
        nva, vva = (None, None) if check is None else (check.nva, check.vva)
        found = [] if nva or vva else [("accuracy", "not measured: no checkpoints are given")]
        for name, figures in (("checkpoints", nva), ("vegetated", vva)):
            if figures is not None:
                found.append((name, figures.text))
        if check is not None and check.verdict:
            found.append(("verdict", check.verdict))
        left = None if check is None or check.hold_out is None else check.hold_out.all
        if left is not None:
            found.append(("held out", f"{left.text}; {AGREEMENT}"))
        return found

    def lines(self) -> list[str]:
        """Return the figures as lines of text."""
        return [f"{title:<11} {value}" for title, value in self.rows()]

    def as_dict(self) -> dict[str, Any]:
        """Return all figures as plain values."""
        plain = {**vars(self), "quality": self.quality.as_dict()}
        for name in ("check", "water", "interval"):
            value = plain[name]
            plain[name] = None if value is None else _plain(value)
        return plain


def _plain(value: Any) -> Any:
    return value.as_dict() if hasattr(value, "as_dict") else dict(vars(value))
