"""The results of a comparison with checkpoints, worded once for terminal, pages and deliveries."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Iterator, NamedTuple, Sequence

import numpy as np

from .accuracy import NEEDED, Figures
from .hold_out import HoldOut

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


class Fact(NamedTuple):
    """A line of the result as users see it."""

    name: str  # in the terminal
    title: str  # on pages
    text: str
    errors: Figures | None = None  # that the text reports


# The figures of a `Check` and of its `HoldOut`, by attribute: their names and titles.
_ERRORS = {
    "nva": ("points NVA", "Ground points, without vegetation (NVA)"),
    "vva": ("points VVA", "Ground points, with vegetation (VVA)"),
    "dtm_nva": ("DTM NVA", "Terrain model, without vegetation (NVA)"),
    "dtm_vva": ("DTM VVA", "Terrain model, with vegetation (VVA)"),
    "low_confidence": ("low confidence", "Ground points, in low confidence areas"),
    "dtm_low_confidence": ("DTM low conf.", "Terrain model, in low confidence areas"),
}
_HELD_OUT = {
    "all": ("held out, all", "Ground points held out"),
    "open": ("open land", "Held out, open land"),
    "under_trees": ("under trees", "Held out, under trees"),
    "steep": ("steep", "Held out, steep"),
}


@dataclass(frozen=True)
class Expectation:
    """How many errors at checkpoints are within the expected error of the terrain model."""

    count: int  # counted checkpoints with an error and an expected error
    inside: int  # their number with an error of at most the expected one
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
    low_confidence: Figures | None = None  # of ground points, in low confidence areas
    dtm_low_confidence: Figures | None = None  # of the terrain model
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

    @property
    def facts(self) -> list[Fact]:
        """The result, line by line."""
        return [*self._at_checkpoints(), *self._held_out()]

    def _at_checkpoints(self) -> Iterator[Fact]:
        if not self.checkpoint_count:
            return
        if self.doubt:
            yield Fact("look at this", "Look at this", self.doubt)
        bare = 0 if self.nva is None else self.nva.count
        yield Fact(
            "checkpoints",
            "Checkpoints",
            f"{self.counted:,} of {self.checkpoint_count:,} are counted, {bare:,} of them without"
            f" vegetation; the standard asks for {self.needed}",
        )
        for reason, names in (self.not_counted or {}).items():
            text = f"{len(names):,} {REASONS[reason]}: {listed(names)}"
            yield Fact("not counted", "Checkpoints that are not counted", text)
        yield from _errors(self, _ERRORS)
        if self.expected is not None:
            yield Fact("expected error", "Errors and the expected error", self.expected.text)
        worst = ", ".join(f"{one['name']} {one['error']:+.3f} m" for one in self.largest or ())
        if worst:
            yield Fact("largest errors", "Largest errors", worst)
        if self.shift is not None:
            text = f"a shift of {self.shift:+.3f} m would remove it; nothing is shifted"
            yield Fact("mean difference", "Mean difference", text)
        if self.verdict and not self.doubt:
            yield Fact("verdict", "Verdict", self.verdict)
        if self.statement:
            yield Fact("statement", "Statement", self.statement)
        if self.dtm_statement:
            yield Fact("DTM statement", "Statement on the terrain model", self.dtm_statement)

    def _held_out(self) -> Iterator[Fact]:
        left = self.hold_out
        if left is None:
            return
        text = (
            f"{left.left_out:,} ground points ({100 * left.share:g} %) are left out of the TIN,"
            f" {left.no_height:,} of them in voids of the others"
        )
        yield Fact("held out", "Points held out", text)
        yield from _errors(left, _HELD_OUT)
        yield Fact("what it shows", "What held-out points show", left.limits())

    def lines(self) -> list[str]:
        """Return the result as lines of text for a terminal or a log."""
        return [f"{fact.name:<16} {fact.text}" for fact in self.facts]


def _errors(found: Check | HoldOut, names: dict[str, tuple[str, str]]) -> Iterator[Fact]:
    """Yield the figures of errors."""
    for attribute, (name, title) in names.items():
        errors: Figures | None = getattr(found, attribute)
        if errors is not None:
            yield Fact(name, title, errors.text, errors)


def listed(names: Sequence[str]) -> str:
    """Return names in a sentence: the first ones, and the number of the others."""
    more = len(names) - _MOST_NAMES
    return ", ".join(names[:_MOST_NAMES]) + (f" and {more:,} more" if more > 0 else "")


def limits_of(scale: float) -> tuple[float, ...]:
    """Return the four errors between the `COLOURS` in metres, given the scale of a `Check`."""
    return tuple(float(f"{share * scale:.3g}") for share in _SHARES)
