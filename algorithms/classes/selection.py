"""Which points take part in a classification, and which classes they get."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet, parameter
from ..core.progress import Progress
from ..core.words import counted
from ..las.cloud import PointCloud
from ..las.extrabytes import REMEMBERED
from ..las.return_numbers import FROM_ZERO
from .corrections import DEMOTED, ByHand, Corrections, changed_since
from .kept_classes import (
    ALL_CLASSES,
    DECIDED,
    GROUND,
    HIGH_NOISE,
    LOW_NOISE,
    NEVER_CLASSIFIED,
    NOISE,
    ROADS,
    UNCLASSIFIED,
    is_one_of,
    overlapping,
    report_kept,
    reserved,
    used,
)
from .point_counts import PointCounts, count_classes


@dataclass(frozen=True)
class Selection(ParameterSet):
    """Selection of points and classes, the same for all ground filters."""

    from_classes: tuple[int, ...] | str | None = parameter(
        None,
        kind="integers",
        label="Classes to classify",
        minimum=0,
        maximum=255,
        empty="0 to 6, 8 and 12",
        word=ALL_CLASSES,
        help="Only points of these classes take part and may change their class. Empty: 0 to 6, 8,"
        " 12 and the class of the ground. Points of other classes, such as water (9) and bridge"
        " decks (17), keep their class. Rails and roads (10 and 11) keep theirs too, but take part,"
        " except in point formats 0 to 5, which reserve 10, 11 and 13 to 31."
        " all: all classes but low and high noise (7 and 18).",
    )
    seed_classes: tuple[int, ...] | None = parameter(
        None,
        kind="integers",
        label="Classes of known ground",
        minimum=0,
        maximum=255,
        empty="none",
        help="Points of these classes are certain ground, whatever their return: the filter does"
        " not judge them, and TIN densification starts from them. They get the class of the"
        " ground, unless their class is not among the classes to classify. Empty: none.",
    )
    to_class: int = parameter(
        GROUND,
        label="Class of the ground",
        minimum=0,
        maximum=255,
        help="The class that ground points get; 2 is ground in the LAS specification. Point formats"
        " 0 to 5 hold classes up to 31.",
    )
    returns: str = parameter(
        "last",
        label="Returns",
        choices={
            "last": "Last and single returns (return number = number of returns)",
            "all": "All returns",
        },
        help="Last returns reach the ground. Take all returns if the return numbers of the file"
        " are wrong.",
    )
    overlap: str = parameter(
        "use",
        label="Points of overlap",
        choices={"use": "Take part as others do", "leave-out": "Leave out; they keep their class"},
        advanced=True,
        help="Points in the overlap of flight strips, by their flag in LAS 1.4, or by class 12 in"
        " older files. If strips do not fit together, leave them out: ground, and rasters made in"
        " the same run, then come from one strip everywhere.",
    )
    others: str = parameter(
        "keep",
        label="Class of other points",
        choices={
            "keep": "Keep; old ground that is not ground now becomes 1",
            "unclassified": "Set to 1 (unclassified)",
        },
        help="The class of points that are not ground. Points that were never classified (0)"
        " become 1 in both cases. Noise, withheld points, and classes that are not classified stay"
        " as they are.",
    )
    low_noise_class: bool = parameter(
        False,
        label="Put low outliers into class 7",
        help="Points that took part and lie far below the ground (multipath, faults of the sensor)"
        " become low noise, class 7. If this is off, they are treated as other points.",
    )
    low_noise_depth: float = parameter(
        1.0,
        label="Depth of low outliers",
        unit="m",
        minimum=0.05,
        maximum=1000.0,
        advanced=True,
        help="A point becomes low noise if it lies farther below the ground than this. On slopes,"
        " the rise of the ground over 1 m is added. Points with ground all round them that lie"
        " 0.4 m and more below it become low noise too. Used only if low outliers are put into"
        " class 7.",
    )
    high_noise_class: bool = parameter(
        False,
        label="Put high outliers into class 18",
        help="Points that took part and hang far above all others of their place, alone or in small"
        " groups (birds, clouds, faults of the sensor) become high noise, class 18. Wires, masts"
        " and trees do not. Surface and canopy models never use such points, whether this is on or"
        " off.",
    )
    high_noise_height: float = parameter(
        10.0,
        label="Height of high outliers",
        unit="m",
        minimum=1.0,
        maximum=1000.0,
        advanced=True,
        help="A point becomes high noise if it hangs at least this far above all others within"
        " about 10 m. Used only if high outliers are put into class 18.",
    )
    bridges: str = parameter(
        "automatic",
        label="Bridges",
        choices={
            "automatic": "Not ground, except with a classic preset",
            "find": "Not ground",
            "keep": "As the filter classifies them",
        },
        help="The class of bridge decks. They are found by cross-sections that fall to lower"
        " ground on both sides; ramps, dams and embankments stay ground. A classic preset"
        " (Whitebox, LiDAR360's, the paper's) works as the original does, and does not look for"
        " bridges.",
    )
    bridge_class: int | None = parameter(
        None,
        kind="integer",
        label="Class of bridges",
        minimum=0,
        maximum=255,
        advanced=True,
        empty="as other points",
        help="The class of bridge decks that are not ground. In the LAS specification it is 17,"
        " and every point format can hold it. Empty: the class of other points.",
    )
    remember_classes: bool = parameter(
        False,
        label="Remember the classes",
        help=f"Adds the extra dimension {REMEMBERED} with the class that this run gives to each"
        " point. A later run on the output finds the classes that were changed by hand since, and"
        " keeps them, whatever its settings. It then remembers the classes again.",
    )

    def choose(
        self,
        part: PointCloud,
        counts: PointCounts,
        within: np.ndarray | None = None,
        by_hand: ByHand | None = None,
    ) -> np.ndarray:
        """Return which points of a part of a file take part, and count them."""
        unnumbered = _unnumbered(part)
        eligible = self._eligible(part, within)
        of_returns = self._of_returns(part, unnumbered)
        selected = eligible & of_returns
        in_use = used(part, self.overlap) & (True if within is None else within)
        masks = {"in_use": in_use, "unnumbered": unnumbered, "eligible": eligible}
        counts.add(part, within, of_returns=selected, **masks)
        counts.add_counts(overlap=overlapping(part))
        unknown = reserved(part)
        counts.reserved += count_classes(part.classification[unknown])
        if self.roads:
            roads = self._of_classes(part, self.roads, within) & ~unknown
            selected = selected | (roads & of_returns)
        if self.seed_classes:
            known = self.known_ground(part, within)
            selected = selected | known
            counts.add_counts(known=known)
        if by_hand is not None:
            known = self.known_ground(part, within, by_hand)
            selected = np.where(by_hand.known, known, selected)
            counts.add_counts(by_hand=by_hand.known)
        counts.add_counts(selected=selected)
        return selected

    def by_hand(self, part: PointCloud, corrections: Corrections) -> ByHand | None:
        """Return the classes set by hand; None without corrections and remembered classes."""
        if part.remembered is None and not corrections.polygons:
            return None
        of_polygons = corrections.classes_of(part)
        demoted = self._eligible(part, None) & (of_polygons == DEMOTED)
        of_polygons[demoted] = UNCLASSIFIED
        # Points may get a class by hand that keep theirs by default.
        corrected = self._of_classes(part, self.from_classes or ALL_CLASSES, None)
        corrected &= of_polygons >= 0
        corrected &= (of_polygons != self.to_class) | self._of_returns(part, _unnumbered(part))
        classes = np.where(corrected, of_polygons, part.classification).astype(np.uint8)
        return ByHand(corrected | changed_since(part), classes)

    def report(
        self, counts: PointCounts, path: Path, progress: Progress, in_area: bool = False
    ) -> None:
        """Report how many points of a file take part, and why the others do not."""
        given = () if self.from_classes == ALL_CLASSES else self.from_classes or ()
        noise = [value for value in NOISE if value not in given]
        numbers = counts.classes - counts.reserved
        left_out = ", ".join(
            f"{numbers[value]:,} of class {value}" for value in noise if numbers[value]
        )
        if left_out:
            progress.info(f"Noise is left out: {left_out}.")
        if counts.withheld:
            words = "withheld point is", "withheld points are"
            progress.info(f"{counted(counts.withheld, *words)} left out.")
        self.report_kept(counts, progress)
        if counts.from_zero:
            progress.warning(FROM_ZERO)
        elif self.returns == "last" and counts.unnumbered == counts.points:
            progress.warning("The points have no return numbers: all of them are used.")
        elif self.returns == "last" and counts.unnumbered:
            words = (
                "point has no return number: it is taken as a single return.",
                "points have no return number: they are taken as single returns.",
            )
            progress.warning(counted(counts.unnumbered, *words))
        if not counts.of_returns:
            raise BareEarthError(counts.why_empty(f"{path} in the area" if in_area else f"{path}"))
        if self.seed_classes:
            classes = ", ".join(map(str, self.seed_classes))
            if counts.known:
                words = f"point of class {classes} is", f"points of class {classes} are"
                progress.info(f"{counted(counts.known, *words)} known ground.")
            else:
                progress.warning(f"There are no points of known ground (class {classes}).")
        if counts.by_hand:
            words = (
                "point has a class that was set by hand, and keeps it.",
                "points have a class that was set by hand, and keep it.",
            )
            progress.info(counted(counts.by_hand, *words))
        progress.info(f"{counts.selected:,} of {counts.points:,} points take part.")

    def report_kept(self, counts: PointCounts, progress: Progress) -> None:
        """Report which classes stay by default, and how many points are overlap."""
        if not self.from_classes:
            report_kept(counts, {self.to_class, *(self.seed_classes or ())}, progress)
        if counts.overlap:
            words = "point of overlap takes", "points of overlap take"
            fate = "part as others do"
            if self.overlap == "leave-out":
                words, fate = ("point of overlap is", "points of overlap are"), "left out"
            progress.info(f"{counted(counts.overlap, *words)} {fate}.")

    @property
    def roads(self) -> tuple[int, ...]:
        """Classes whose points keep their class, but take part."""
        return () if self.from_classes else ROADS

    def known_ground(
        self, cloud: PointCloud, within: np.ndarray | None = None, by_hand: ByHand | None = None
    ) -> np.ndarray:
        """Return which points, among those within if given, are known ground."""
        known = is_one_of(cloud.classification, self.seed_classes or ())
        if by_hand is not None:
            np.copyto(known, by_hand.classes == self.to_class, where=by_hand.known)
        known &= used(cloud, self.overlap)
        return known if within is None else known & within

    def classes(
        self,
        cloud: PointCloud,
        ground: np.ndarray,
        low: np.ndarray | None = None,
        inside: np.ndarray | None = None,
        decks: np.ndarray | None = None,
        by_hand: ByHand | None = None,
        high: np.ndarray | None = None,
    ) -> np.ndarray:
        """Return the new class of every point."""
        old = cloud.classification
        eligible = self._eligible(cloud, inside)
        changes = eligible
        if self.others == "keep":
            # This includes old ground of returns that did not take part, since nothing confirms it.
            changes = eligible & is_one_of(old, (NEVER_CLASSIFIED, GROUND, self.to_class))
        classes = old.copy()
        np.copyto(classes, UNCLASSIFIED, where=changes)
        np.copyto(classes, self.to_class, where=eligible & ground)
        if low is not None:
            np.copyto(classes, LOW_NOISE, where=eligible & low)
        if high is not None:
            np.copyto(classes, HIGH_NOISE, where=eligible & high)
        if decks is not None and self.bridge_class is not None:
            np.copyto(classes, self.bridge_class, where=eligible & decks)
        if by_hand is not None:
            known = by_hand.known if inside is None else by_hand.known & inside
            np.copyto(classes, by_hand.classes, where=known)
        return classes

    def _of_returns(self, part: PointCloud, unnumbered: np.ndarray) -> np.ndarray:
        if self.returns != "last":
            return np.ones(part.count, dtype=bool)
        # A return number above the number of returns is wrong, but still means a last return.
        return (part.return_number >= part.number_of_returns) | unnumbered

    def _eligible(self, cloud: PointCloud, within: np.ndarray | None) -> np.ndarray:
        """Return which points, of all returns, may change their class."""
        return self._of_classes(cloud, self.from_classes or (*DECIDED, self.to_class), within)

    def _of_classes(
        self, cloud: PointCloud, classes: tuple[int, ...] | str, within: np.ndarray | None
    ) -> np.ndarray:
        """Return which points have one of the classes and are used, among those within if given."""
        if isinstance(classes, str):  # all
            result = ~is_one_of(cloud.classification, NOISE) | reserved(cloud)
        else:
            result = is_one_of(cloud.classification, classes)
        result &= used(cloud, self.overlap)
        return result if within is None else result & within


def _unnumbered(part: PointCloud) -> np.ndarray:
    return (part.return_number == 0) | (part.number_of_returns == 0)
