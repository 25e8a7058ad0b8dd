"""Agreement of a classification with a reference: type I, type II and total error, kappa."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any, NamedTuple

import numpy as np

from ..core.parameters import ParameterSet, parameter

GROUND = 2


@dataclass(frozen=True)
class AssessmentOptions(ParameterSet):
    """Which classes count as ground, which are ignored, and the cells of the error map."""

    ground_classes: tuple[int, ...] = parameter(
        (GROUND,),
        label="Ground classes of the reference",
        minimum=0,
        maximum=255,
        help="Classes of the reference that are ground. Add 9 if water counts as ground.",
    )
    ignored_classes: tuple[int, ...] | None = parameter(
        None,
        kind="integers",
        label="Ignored classes of the reference",
        minimum=0,
        maximum=255,
        help="Points of these classes of the reference are not counted, for example noise (7, 18)."
        " Empty: all points are counted.",
    )
    map_cell_size: float = parameter(
        1.0,
        label="Cell size of the error map",
        unit="m",
        minimum=0.01,
        maximum=1000.0,
        advanced=True,
        help="Side of a cell of the error map. The map in the report has its own cell size.",
    )


class Comparison(NamedTuple):
    """Errors point by point, boolean arrays of shape (n,)."""

    counted: np.ndarray  # points that are not ignored
    rejected: np.ndarray  # ground among these that was rejected (type I)
    accepted: np.ndarray  # other points among these that were accepted (type II)

    @classmethod
    def of(
        cls, ground: np.ndarray, reference: np.ndarray, options: AssessmentOptions
    ) -> Comparison:
        """Compare a ground mask with reference classes of the same points; see `compare`."""
        counted = ~np.isin(reference, options.ignored_classes or ())
        truth = np.isin(reference, options.ground_classes)
        return cls(counted, counted & truth & ~ground, counted & ~truth & ground)


@dataclass(frozen=True)
class Assessment:
    """Agreement of a classification with a reference, in percent; NaN without points to count."""

    # Sithole and Vosselman (2004), ISPRS Journal 59, section 3.2: type I error is the share of
    # reference ground that was rejected, type II error the share of reference non-ground that was
    # accepted, and total error the share of all points that are wrong. Kappa is that of Cohen
    # (1960).

    point_count: int
    ground_as_ground: int
    ground_as_other: int
    other_as_ground: int
    other_as_other: int
    type_1_error: float
    type_2_error: float
    total_error: float
    kappa: float
    classes: dict[int, dict[str, int]] = field(default_factory=dict)
    classified_only: int = 0  # points that only this file has, which are not counted
    reference_only: int = 0  # as classified_only

    def as_dict(self) -> dict[str, Any]:
        """Return all figures for JSON; NaN becomes None."""
        figures = asdict(self)
        return {
            name: None if isinstance(value, float) and np.isnan(value) else value
            for name, value in figures.items()
        }

    def lines(self) -> list[str]:
        """Return the figures as lines of text for a terminal or a log."""
        rows = [
            f"points            {self.point_count:>12,}",
            f"type I error      {self.type_1_error:>12.2f} %   ground taken for other "
            f"({self.ground_as_other:,} of {self.ground_as_ground + self.ground_as_other:,})",
            f"type II error     {self.type_2_error:>12.2f} %   other taken for ground "
            f"({self.other_as_ground:,} of {self.other_as_ground + self.other_as_other:,})",
            f"total error       {self.total_error:>12.2f} %",
            f"kappa             {self.kappa:>12.2f} %",
        ]
        if self.classified_only or self.reference_only:
            rows.append(
                f"not compared      {self.classified_only:>12,}     points of the classified file"
                f" only, and {self.reference_only:,} of the reference only"
            )
        for value, counts in self.classes.items():
            rows.append(
                f"reference class {value:>3} {counts['points']:>10,}     "
                f"classified as ground {counts['ground']:,}"
            )
        return rows


def compare(
    ground: np.ndarray, reference: np.ndarray, options: AssessmentOptions = AssessmentOptions()
) -> Assessment:
    """Compare a ground mask, bool (n,), with the reference classes of the same points."""
    counted, rejected, accepted = Comparison.of(ground, reference, options)
    truth = np.isin(reference, options.ground_classes)
    b, c = int(np.count_nonzero(rejected)), int(np.count_nonzero(accepted))
    a = int(np.count_nonzero(counted & truth)) - b
    d = int(np.count_nonzero(counted & ~truth)) - c
    ground, reference = ground[counted], reference[counted]
    classes = {
        int(value): {
            "points": int(np.count_nonzero(reference == value)),
            "ground": int(np.count_nonzero(ground[reference == value])),
        }
        for value in np.unique(reference)
    }
    n = a + b + c + d
    chance = ((a + b) * (a + c) + (c + d) * (b + d)) / n**2 if n else float("nan")
    agreement = _percent(a + d, n) / 100
    kappa = (agreement - chance) / (1 - chance) * 100 if chance != 1 else float("nan")
    return Assessment(
        point_count=n,
        ground_as_ground=a,
        ground_as_other=b,
        other_as_ground=c,
        other_as_other=d,
        type_1_error=_percent(b, a + b),
        type_2_error=_percent(c, c + d),
        total_error=_percent(b + c, n),
        kappa=kappa,
        classes=classes,
    )


def _percent(part: int, whole: int) -> float:
    return 100.0 * part / whole if whole else float("nan")
