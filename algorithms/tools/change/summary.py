"""The figures of the change between two surveys."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Sequence

import numpy as np

from ...core.words import counted
from ...report.units import Units
from .judged import EARTH, SAME
from .pair import SEEN, Pair
from .places import ChangePlace, limits_of
from .stable import Alignment, Sample, Scatter

# Metres of which the summary tells in which share of the area such a change could be told.
TOLD = (0.1, 0.3, 1.0)


class TerrainChange(NamedTuple):
    """What was found out about two terrains."""

    pair: Pair
    sample: Sample
    alignment: Alignment
    scatter: Scatter
    places: list[ChangePlace]


@dataclass(frozen=True)
class ChangeSummary:
    """The change between two surveys; lengths are metres."""

    cell_count: int  # with a value in both
    place_count: int  # of significant change
    earth_count: int  # those that are probably earth, of which all below is
    risen_area: float  # square metres
    sunk_area: float
    volume_up: float  # cubic metres
    volume_up_error: float  # 95 %
    volume_down: float
    volume_down_error: float
    left_out: int  # places that the points of both dates show in both
    alignment: Alignment
    nmad: float  # of the difference on stable land
    median_limit: float  # of the detection limits
    can_tell: dict[float, float]  # share of the area in which a change of so many metres is told
    unseen: float  # share of the area without ground points of both dates nearby
    by_error: bool  # whether limits follow from expected errors

    @property
    def shift(self) -> float:
        """The vertical shift that was taken off, to a micrometre."""
        return round(self.alignment.shift, 6)

    def figures(self, units: Units) -> list[tuple[str, str]]:
        """Return the figures of the page, with their titles."""
        told = (f"{units.height(metres)} in {share:.0%}" for metres, share in self.can_tell.items())
        up, down = self._volumes(units)
        return [
            (
                "Places of significant change",
                f"{self.place_count:,}, {self.earth_count:,} of earth",
            ),
            ("Earth, up", up),
            ("Earth, down", down),
            (f"Left out: {SAME}", f"{self.left_out:,}"),
            ("Taken off", self.alignment.text),
            ("NMAD of stable land", units.height(self.nmad)),
            ("Detection limit of a cell, median", units.height(self.median_limit)),
            ("A change can be told, share of the area", ", ".join(told)),
            (
                f"No ground points of a date within {units.length(SEEN)}, share of the area",
                f"{self.unseen:.0%}",
            ),
        ]

    def _volumes(self, units: Units) -> tuple[str, ...]:
        """Return the volumes up and down with their errors and areas."""
        area, volume = units.horizontal**2, units.horizontal**2 * units.vertical
        return tuple(
            f"{value / volume:,.0f} ± {error / volume:,.0f} {units.cubic} on"
            f" {square / area:,.0f} {units.across}²"
            for value, error, square in (
                (self.volume_up, self.volume_up_error, self.risen_area),
                (self.volume_down, self.volume_down_error, self.sunk_area),
            )
        )

    @property
    def text(self) -> str:
        """The result in sentences."""
        left = f" Left out: {counted(self.left_out, 'place')}, {SAME}." * (self.left_out > 0)
        told = ", ".join(f"{metres:g} m in {share:.0%}" for metres, share in self.can_tell.items())
        hidden = (
            f" {self.unseen:.0%} has no ground points of a date within {SEEN:g} m: what is smaller"
            " than these gaps can hide there."
        ) * (self.unseen >= 0.005)
        up, down = self._volumes(Units())
        return (
            f"{counted(self.place_count, 'place')} of significant change; earth, probably, in"
            f" {self.earth_count:,}: {up} up, {down} down (errors 95 %).{left} Taken off:"
            f" {self.alignment.text}. A change can be told: {told} of the area.{hidden}"
        )


def summary_of(found: TerrainChange, left_out: int) -> ChangeSummary:
    """Return the figures of all places and of the whole area."""
    sample, alignment = found.sample, found.alignment
    limits = limits_of(found.scatter, alignment, sample.spread, sample.slope)
    earth = [place for place in found.places if place.kind == EARTH]
    up, down = ([place for place in earth if sign * place.volume > 0] for sign in (1, -1))
    volume_up, volume_up_error = _volume(up, alignment)
    volume_down, volume_down_error = _volume(down, alignment)
    risen, sunk = (round(sum(place.area for place in places), 1) for places in (up, down))
    return ChangeSummary(
        cell_count=sample.common,
        place_count=len(found.places),
        earth_count=len(earth),
        risen_area=risen,
        sunk_area=sunk,
        volume_up=volume_up,
        volume_up_error=volume_up_error,
        volume_down=volume_down,
        volume_down_error=volume_down_error,
        left_out=left_out,
        alignment=alignment,
        nmad=round(found.scatter.nmad, 4),
        median_limit=round(float(np.nanmedian(limits)), 3),
        can_tell={
            metres: round(float(np.mean((limits <= metres) & sample.is_seen)), 4) for metres in TOLD
        },
        unseen=round(float(np.mean(~sample.is_seen)), 4),
        by_error=found.scatter.by_error,
    )


def _volume(places: Sequence[ChangePlace], alignment: Alignment) -> tuple[float, float]:
    """Return the volume of places, positive, and its error: that of the alignment is the same in
    all of them, the others are independent.
    """
    aligned = alignment.limit * sum(place.area for place in places)
    others = sum(place.volume_error**2 - (alignment.limit * place.area) ** 2 for place in places)
    total = abs(sum(place.volume for place in places))
    return round(total, 2), round(float(np.sqrt(aligned**2 + max(others, 0.0))), 2)
