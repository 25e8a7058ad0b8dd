"""The results of a comparison with checkpoints."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Sequence

import numpy as np

from .accuracy import NEEDED, Figures
from .hold_out import AGREEMENT, HoldOut

COUNTED = "counted"
# The standard asks for separate figures in low confidence areas.
LOW_CONFIDENCE = "low confidence area"
NO_HEIGHT = "no height"
REPEATED = "repeated"
SEVERAL_HEIGHTS = "several heights"
# Colours of errors, from low to high. Blue: the data lie below the checkpoint; red: above it. They
# differ for colour-blind people.
COLOURS = ("#2166ac", "#92c5de", "#f7f7f7", "#f4a582", "#b2182b")
NOT_COUNTED = "#888888"  # of checkpoints that are not counted
# Limits between the colours, as shares of the scale.
_SHARES = (-0.6, -0.2, 0.2, 0.6)
# In place of a statement while there is a doubt.
NOT_STATED = "No accuracy is stated before the difference in height is settled."
# Most names in a sentence.
_MOST_NAMES = 30
# Why a checkpoint is not counted, in words.
REASONS = {
    "outside": "outside of the survey",
    "void": "where there is no ground near",
    LOW_CONFIDENCE: "in low confidence areas, which have figures of their own",
    "control": "to which the survey was fitted (control)",
    NO_HEIGHT: "without a height (missing, or a nodata value such as 0 or -9999)",
    REPEATED: "listed again (each point counts once)",
    SEVERAL_HEIGHTS: "listed with several heights",
}


# Fewest checkpoints for a factor of the expected error: 95 % of fewer is too uncertain.
_ENOUGH = 30


@dataclass(frozen=True)
class Expectation:
    """How many errors at checkpoints are within the expected error of the terrain model."""

    count: int  # counted checkpoints with an error and an expected error
    inside: int  # of these, those whose error is at most the expected one
    factor: float | None  # for the expected error to hold 95 %; None for too few checkpoints

    @classmethod
    def of(cls, errors: np.ndarray, expected: np.ndarray) -> Expectation | None:
        """Return the numbers for errors and expected errors in metres; None without any pair."""
        known = np.isfinite(errors) & (expected > 0.0)
        if not known.any():
            return None
        ratio = np.abs(errors[known]) / expected[known]
        factor = float(np.quantile(ratio, 0.95)) if len(ratio) >= _ENOUGH else None
        return cls(len(ratio), int(np.count_nonzero(ratio <= 1.0)), factor)

    @property
    def text(self) -> str:
        """The result in a sentence."""
        inside = f"{self.inside:,} of {self.count:,} errors lie inside the expected error"
        if self.factor is None:
            return f"{inside}; with {_ENOUGH} checkpoints it could be corrected."
        return f"{inside}; 95 % would with the factor {self.factor:.2f}."


@dataclass(frozen=True)
class Check:
    """The result of a comparison with checkpoints; all errors are in metres."""

    checkpoint_count: int = 0
    counted: int = 0
    nva: Figures | None = None  # errors of the TIN of ground points on land without vegetation
    vva: Figures | None = None  # errors of the TIN on land with vegetation
    dtm_nva: Figures | None = None  # errors of the terrain model on both kinds of land
    dtm_vva: Figures | None = None
    low_confidence: Figures | None = None  # errors of both in low confidence areas
    dtm_low_confidence: Figures | None = None
    not_counted: dict[str, list[str]] | None = None  # names by the reason as in `REASONS`
    # unknown land covers, and how many checkpoints have them, which count as without vegetation
    unknown_covers: dict[str, int] | None = None
    doubt: str = ""  # why no accuracy can be stated, such as another vertical datum; or empty
    # names and errors of the counted checkpoints with the largest errors of the TIN
    largest: list[dict[str, Any]] | None = None
    # metres that would remove the mean error without vegetation, None in doubt; nothing is shifted
    shift: float | None = None
    needed: int = NEEDED  # fewest checkpoints without vegetation for a test by the standard
    accuracy_class: float | None = None  # to meet
    # by the TIN; None without a class or counted `nva`, or in doubt
    meets_class: bool | None = None
    scale: float = 1.0  # metres at which the colours of maps and bars end
    statement: str = ""  # for the points; empty if there is nothing to state
    dtm_statement: str = ""  # for the terrain model
    expected: Expectation | None = None  # by checkpoints; None in doubt, or without the raster
    hold_out: HoldOut | None = None  # errors at ground points that were left out

    @property
    def nva_rmse(self) -> float | None:
        """RMSE on land without vegetation, with the error of the checkpoints."""
        return None if self.nva is None else self.nva.total_rmse

    @property
    def vva_rmse(self) -> float | None:
        """RMSE on land with vegetation, with the error of the checkpoints."""
        return None if self.vva is None else self.vva.total_rmse

    @property
    def hold_out_rmse(self) -> float | None:
        """RMSE of the points that were left out."""
        figures = None if self.hold_out is None else self.hold_out.all
        return None if figures is None else figures.rmse

    @property
    def verdict(self) -> str:
        """A sentence on whether the accuracy class is met; empty without checkpoints or class."""
        if not self.checkpoint_count:
            return ""
        if self.doubt:
            return f"{NOT_STATED} {self.doubt}"
        if self.nva is None:
            return "No accuracy is stated: no checkpoint without vegetation is counted."
        if self.meets_class is None:
            return ""
        does = "meet" if self.meets_class else "do not meet"
        few = self.nva.count < self.needed
        by = f", by {self.nva.count:,} of the {self.needed} checkpoints that the standard asks for"
        return (
            f"The ground points {does} the class of {self.accuracy_class:g} m{by if few else ''}."
        )

    def as_dict(self) -> dict[str, object]:
        """Return all figures for JSON."""
        return asdict(self)

    def lines(self) -> list[str]:
        """Return the figures as lines of text for a terminal or a log."""
        rows = [f"look at this      {self.doubt}"] if self.doubt else []
        if self.checkpoint_count:
            rows.append(
                f"checkpoints       {self.counted:>6,} of {self.checkpoint_count:,} counted"
            )
        for left in self.left_out:
            count, _, why = left.partition(" ")
            rows.append(f"not counted       {count:>6} {why}")
        named = {
            "points NVA": self.nva, "points VVA": self.vva,
            "DTM NVA": self.dtm_nva, "DTM VVA": self.dtm_vva,
            "low confidence": self.low_confidence, "DTM low conf.": self.dtm_low_confidence,
        }  # fmt: skip
        held_out = self.hold_out
        if held_out is not None:
            rows.append(
                f"held out          {held_out.left_out:>6,} ground points,"
                f" {held_out.no_height:,} in voids"
            )
            rows.append(f"what this tells   {AGREEMENT}")
            named |= {
                "held out, all": held_out.all, "open land": held_out.open,
                "under trees": held_out.under_trees, "steep": held_out.steep,
            }  # fmt: skip
        rows += [f"{name:<17} {figures.line}" for name, figures in named.items() if figures]
        if self.expected is not None:
            rows.append(f"expected error    {self.expected.text}")
        if self.largest:
            worst = ", ".join(f"{one['name']} {one['error']:+.3f} m" for one in self.largest)
            rows.append(f"largest errors    {worst}")
        if self.shift is not None:
            rows.append(
                f"mean difference   would be removed by a shift of {self.shift:+.3f} m; nothing is"
                " shifted"
            )
        return [*rows, *self.statements]

    @property
    def left_out(self) -> list[str]:
        """The numbers and names of the checkpoints that are not counted, by the reason."""
        left = (self.not_counted or {}).items()
        return [f"{len(names):,} {REASONS[reason]}: {listed(names)}" for reason, names in left]

    @property
    def statements(self) -> list[str]:
        """The statements on the points and on the terrain model."""
        stated = {"": self.statement, "Terrain model: ": self.dtm_statement}
        return [f"{whose}{words}" for whose, words in stated.items() if words]


def listed(names: Sequence[str]) -> str:
    """Return names in a sentence: the first ones, and the number of the others."""
    more = len(names) - _MOST_NAMES
    return ", ".join(names[:_MOST_NAMES]) + (f" and {more:,} more" if more > 0 else "")


def limits_of(scale: float) -> tuple[float, ...]:
    """Return the four errors between the `COLOURS` in metres, given the scale of a `Check`."""
    return tuple(float(f"{share * scale:.3g}") for share in _SHARES)
