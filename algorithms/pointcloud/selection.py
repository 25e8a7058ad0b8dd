"""Which points take part in a classification, and what the classes become."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import BareEarthError
from ..parameters import ParameterSet, parameter
from ..progress import Progress
from .cloud import PointCloud

NEVER_CLASSIFIED, UNCLASSIFIED, GROUND = 0, 1, 2
NOISE = (7, 18)
_LAST_LEGACY_FORMAT, _LARGEST_LEGACY_CLASS = 5, 31


@dataclass(frozen=True)
class Selection(ParameterSet):
    """The policy for points and classes, one for every ground filter."""

    from_classes: tuple[int, ...] | None = parameter(
        None,
        kind="integers",
        label="Classes to classify anew",
        minimum=0,
        maximum=255,
        help="Only points of these classes take part and may change their class; every class but"
        " low and high noise (7 and 18) when none is given.",
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

    def select(self, cloud: PointCloud, progress: Progress) -> np.ndarray:
        """Return which points take part.

        Parameters
        ----------
        cloud : PointCloud
            All points, with their present classes.
        progress : Progress
            Told how many points are left out, and why.

        Returns
        -------
        numpy.ndarray of bool, shape (n,)

        Raises
        ------
        BareEarthError
            If no point is left, the CRS is geographic, or the points cannot hold the class.
        """
        cloud.require_projected()
        self._check_class(cloud)
        noise = self._left_out_noise(cloud)
        if noise:
            counts = ", ".join(f"{count:,} of class {value}" for value, count in noise.items())
            progress.info(f"Noise is left out: {counts}.")
        withheld = int(np.count_nonzero(cloud.withheld))
        if withheld:
            progress.info(f"{withheld:,} withheld points are left out.")
        eligible = self._eligible(cloud)
        selected = eligible & self._returns(cloud, progress)
        if not selected.any():
            raise BareEarthError(self._why_empty(cloud, eligible))
        count = int(np.count_nonzero(selected))
        progress.info(f"{count:,} of {cloud.count:,} points take part.")
        return selected

    def classes(self, cloud: PointCloud, selected: np.ndarray, ground: np.ndarray) -> np.ndarray:
        """Return the new class of every point.

        Parameters
        ----------
        cloud : PointCloud
            All points, with their present classes.
        selected, ground : numpy.ndarray of bool, shape (n,)
            Which points took part, and which of those are ground.

        Returns
        -------
        numpy.ndarray of uint8, shape (n,)
        """
        old = cloud.classification
        eligible = self._eligible(cloud)
        if self.others == "unclassified":
            changes = eligible | selected
        else:
            # Old ground of returns that did not take part goes too: it was not confirmed either.
            changes = eligible & _is_one_of(old, (NEVER_CLASSIFIED, GROUND, self.to_class))
        classes = old.copy()
        classes[changes] = UNCLASSIFIED
        classes[ground] = self.to_class
        return classes

    def _check_class(self, cloud: PointCloud) -> None:
        if cloud.point_format <= _LAST_LEGACY_FORMAT and self.to_class > _LARGEST_LEGACY_CLASS:
            raise BareEarthError(
                f"{cloud.path} has point format {cloud.point_format}, which holds classes up to"
                f" {_LARGEST_LEGACY_CLASS}, not {self.to_class}. Choose another class for the"
                " ground."
            )

    def _left_out_noise(self, cloud: PointCloud) -> dict[int, int]:
        """Return the number of points of each noise class that is left out."""
        counts = {
            value: int(np.count_nonzero(cloud.classification == value))
            for value in NOISE
            if value not in (self.from_classes or ())
        }
        return {value: count for value, count in counts.items() if count}

    def _eligible(self, cloud: PointCloud) -> np.ndarray:
        """Return which points may change their class, whatever their return."""
        if self.from_classes:
            eligible = _is_one_of(cloud.classification, self.from_classes)
        else:
            eligible = ~_is_one_of(cloud.classification, NOISE)
        return eligible & ~cloud.withheld

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

    def _why_empty(self, cloud: PointCloud, eligible: np.ndarray) -> str:
        """Return the sentence for a selection without points: what to change."""
        if eligible.any():
            return (
                f"No point of {cloud.path} is a last or single return. Choose all returns instead."
            )
        if cloud.withheld.all():
            return f"All points of {cloud.path} are withheld. Clear that flag first."
        present = ", ".join(str(value) for value in np.unique(cloud.classification))
        return (
            f"No point of {cloud.path} is left to classify: it has the classes {present}. Choose"
            " among them the classes to classify anew."
        )


def _is_one_of(classification: np.ndarray, classes: tuple[int, ...]) -> np.ndarray:
    """Return which points have one of the classes; by table, as there are but 256 classes."""
    table = np.zeros(256, dtype=bool)
    table[list(classes)] = True
    return table[classification]
