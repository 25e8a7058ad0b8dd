"""Which points take part in a classification, and what the classes become."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import BareEarthError
from ..parameters import ParameterSet, parameter
from ..progress import Progress
from .cloud import PointCloud
from .records import check_class

NEVER_CLASSIFIED, UNCLASSIFIED, GROUND = 0, 1, 2
LOW_NOISE = 7
NOISE = (LOW_NOISE, 18)


@dataclass(frozen=True)
class Selection(ParameterSet):
    """The policy for points and classes, one for every ground filter."""

    from_classes: tuple[int, ...] | None = parameter(
        None,
        kind="integers",
        label="Classes to classify anew",
        minimum=0,
        maximum=255,
        empty="all but noise",
        help="Only points of these classes take part and may change their class; every class but"
        " low and high noise (7 and 18) when none is given.",
    )
    seed_classes: tuple[int, ...] | None = parameter(
        None,
        kind="integers",
        label="Classes of known ground",
        minimum=0,
        maximum=255,
        empty="none",
        help="Points of these classes are ground for certain, whatever their return: they are not"
        " judged, and the TIN densification starts from them. They get the class of the ground,"
        " too, unless theirs is not among those to classify anew.",
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
        help="The laser reaches the ground last. Take all returns where the return numbers of the"
        " file are wrong.",
    )
    others: str = parameter(
        "keep",
        label="Class of other points",
        choices={
            "keep": "Keep, but old ground that is not confirmed becomes 1",
            "unclassified": "Set to 1 (unclassified)",
        },
        help="What becomes of points that are not ground. Points that were never classified (0)"
        " become 1 in either case; noise, withheld points and other classes than those to classify"
        " anew stay as they are.",
    )
    low_noise_class: bool = parameter(
        False,
        label="Put low outliers into class 7",
        help="Points that took part and lie far below the ground that was found (multipath, faults"
        " of the sensor) become low noise, class 7, instead of what becomes of other points.",
    )
    low_noise_depth: float = parameter(
        1.0,
        label="Depth of low outliers",
        unit="m",
        minimum=0.05,
        maximum=1000.0,
        advanced=True,
        help="How far below the ground a point must lie to become low noise, in level terrain; on"
        " slopes the rise of the ground over 1 m is added. Only where low outliers are put into"
        " class 7.",
    )

    def select(
        self, cloud: PointCloud, progress: Progress, within: np.ndarray | None = None
    ) -> np.ndarray:
        """Return which points take part.

        Parameters
        ----------
        cloud : PointCloud
            All points, with their present classes.
        progress : Progress
            Told how many points are left out, and why.
        within : numpy.ndarray of bool, shape (n,), optional
            Points outside take no part; all are within where it is not given.

        Returns
        -------
        numpy.ndarray of bool, shape (n,)

        Raises
        ------
        BareEarthError
            If no point is left, the CRS is geographic, or the points cannot hold the class.
        """
        cloud.require_projected()
        check_class(cloud.path, cloud.point_format, self.to_class, "the ground")
        noise = self._left_out_noise(cloud)
        if noise:
            counts = ", ".join(f"{count:,} of class {value}" for value, count in noise.items())
            progress.info(f"Noise is left out: {counts}.")
        withheld = int(np.count_nonzero(cloud.withheld))
        if withheld:
            progress.info(f"{withheld:,} withheld points are left out.")
        eligible = self._eligible(cloud, within)
        selected = eligible & self._returns(cloud, progress)
        if not selected.any():
            raise BareEarthError(self._why_empty(cloud, eligible, within))
        if self.seed_classes:
            known = self.known_ground(cloud, within)
            classes = ", ".join(map(str, self.seed_classes))
            if known.any():
                progress.info(
                    f"{np.count_nonzero(known):,} points of class {classes} are known ground."
                )
            else:
                progress.warning(f"There are no points of known ground (class {classes}).")
            selected |= known
        count = int(np.count_nonzero(selected))
        progress.info(f"{count:,} of {cloud.count:,} points take part.")
        return selected

    def known_ground(self, cloud: PointCloud, within: np.ndarray | None = None) -> np.ndarray:
        """Return which points, of those within, are ground for certain."""
        known = _is_one_of(cloud.classification, self.seed_classes or ()) & ~cloud.withheld
        return known if within is None else known & within

    def classes(
        self,
        cloud: PointCloud,
        ground: np.ndarray,
        low: np.ndarray | None = None,
        inside: np.ndarray | None = None,
    ) -> np.ndarray:
        """Return the new class of every point.

        Parameters
        ----------
        cloud : PointCloud
            All points, with their present classes.
        ground : numpy.ndarray of bool, shape (n,)
            Which points, of those that took part, are ground.
        low : numpy.ndarray of bool, shape (n,), optional
            Which of the others are low outliers.
        inside : numpy.ndarray of bool, shape (n,), optional
            Points outside keep their class; all are inside where it is not given.

        Returns
        -------
        numpy.ndarray of uint8, shape (n,)
        """
        old = cloud.classification
        eligible = self._eligible(cloud, inside)
        changes = eligible
        if self.others == "keep":
            # Old ground of returns that did not take part goes too: it was not confirmed either.
            changes = eligible & _is_one_of(old, (NEVER_CLASSIFIED, GROUND, self.to_class))
        classes = old.copy()
        classes[changes] = UNCLASSIFIED
        classes[eligible & ground] = self.to_class
        if low is not None:
            classes[eligible & low] = LOW_NOISE
        return classes

    def _left_out_noise(self, cloud: PointCloud) -> dict[int, int]:
        """Return the number of points of each noise class that is left out."""
        counts = {
            value: int(np.count_nonzero(cloud.classification == value))
            for value in NOISE
            if value not in (self.from_classes or ())
        }
        return {value: count for value, count in counts.items() if count}

    def _eligible(self, cloud: PointCloud, within: np.ndarray | None) -> np.ndarray:
        """Return which points, of those within, may change their class, whatever their return."""
        if self.from_classes:
            eligible = _is_one_of(cloud.classification, self.from_classes)
        else:
            eligible = ~_is_one_of(cloud.classification, NOISE)
        eligible &= ~cloud.withheld
        return eligible if within is None else eligible & within

    def _returns(self, cloud: PointCloud, progress: Progress) -> np.ndarray:
        """Return which points are of the wanted returns."""
        if self.returns == "all":
            return np.ones(cloud.count, dtype=bool)
        number, total = cloud.return_number, cloud.number_of_returns
        unnumbered = (number == 0) | (total == 0)
        count = int(np.count_nonzero(unnumbered))
        if count == cloud.count:
            progress.warning("The points have no return numbers: all of them are used.")
        elif count:
            progress.warning(
                f"{count:,} points have no return number: they are taken as single returns."
            )
        # A number above the total is wrong, but a last return whatever the total should be.
        return (number >= total) | unnumbered

    def _why_empty(self, cloud: PointCloud, eligible: np.ndarray, within: np.ndarray | None) -> str:
        """Return the sentence for a selection without points: what to change."""
        which = np.ones(cloud.count, dtype=bool) if within is None else within
        place = f"{cloud.path}" if within is None else f"{cloud.path} in the area"
        if eligible.any():
            return f"No point of {place} is a last or single return. Choose all returns instead."
        if cloud.withheld[which].all():
            return f"All points of {place} are withheld. Clear that flag first."
        present = ", ".join(str(value) for value in np.unique(cloud.classification[which]))
        return (
            f"No point of {place} is left to classify: it has the classes {present}. Choose among"
            " them the classes to classify anew."
        )


def _is_one_of(classification: np.ndarray, classes: tuple[int, ...]) -> np.ndarray:
    """Return which points have one of the classes; by table, as there are but 256 classes."""
    table = np.zeros(256, dtype=bool)
    table[list(classes)] = True
    return table[classification]
