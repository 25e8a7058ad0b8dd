"""The description of a ground filter, for the command line, the dialogs and the runs."""

from __future__ import annotations

from typing import Any, Callable, Mapping, NamedTuple

import numpy as np

from ..core.parameters import ParameterSet
from ..core.points import Points
from ..core.progress import SILENT, Progress
from .shared.low_groups import LowGroups
from .shared.scattered import scattered_lows

# If more than this share of the points are scattered low outliers, the log says so.
_MANY_OUTLIERS = 1e-4
# Usual width in metres of the largest building; few are wider.
_USUAL_OBJECT = 50.0


class Found(NamedTuple):
    """What a method finds.

    Attributes
    ----------
    ground : numpy.ndarray of bool, shape (n,)
        Which points are ground.
    low : numpy.ndarray of bool, shape (n,), or None
        Which points were left out as low outliers; None for none.
    """

    ground: np.ndarray
    low: np.ndarray | None


class Toolbox(NamedTuple):
    """A ground filter in the toolbox of QGIS.

    Attributes
    ----------
    identifier : str
        Second half of the id; it never changes.
    title, summary : str
        Name and tooltip.
    about : str
        First paragraphs of the help.
    page : str
        Its page in the folder docs.
    words : tuple of str
        Search words, separated by commas; each text is translated as a whole.
    """

    identifier: str
    title: str
    summary: str
    about: str
    page: str
    words: tuple[str, ...]


class Method(NamedTuple):
    """One ground filter.

    Attributes
    ----------
    name : str
        As on the command line.
    label : str
        As in the toolbox.
    parameters : type
        Its `ParameterSet`. It has a field `preset` with a choice ``automatic``.
    classify : callable
        ``classify(points, parameters, progress)``, a pure function that returns the ground mask.
    reach : callable
        ``reach(parameters)``, the distance in metres within which points affect each other.
    largest_object : callable
        ``largest_object(parameters)``, the width in metres of the largest object that is searched.
    size_parameter : str
        Name of the parameter with this width.
    classic : str
        The preset that does the same as the original program or paper, without additions.
    presets : mapping of str to dataclass or NamedTuple
        The values of each preset that has some, for the help.
    toolbox : Toolbox
        Its texts in the toolbox.
    takes_known_ground : bool
        Whether `classify` takes the keyword ``known_ground``, a mask of known ground points, and
        starts from these.
    """

    name: str
    label: str
    parameters: type[ParameterSet]
    classify: Callable[..., np.ndarray]
    reach: Callable[..., float]
    largest_object: Callable[..., float]
    size_parameter: str
    classic: str
    presets: Mapping[str, Any]
    toolbox: Toolbox
    takes_known_ground: bool = False

    def ground(
        self,
        points: Points,
        parameters: ParameterSet,
        progress: Progress = SILENT,
        known: np.ndarray | None = None,
    ) -> Found:
        """Return which points are ground. Low outliers are left out, except by a classic preset.

        Parameters
        ----------
        points : Points
            All points that take part.
        parameters : ParameterSet
            Parameters of the method.
        progress : Progress
            Receives progress and messages.
        known : numpy.ndarray of bool, shape (n,), optional
            Points that are known to be ground.
        """
        starts = known is not None and known.any() and self.takes_known_ground

        def found(points: Points, known: np.ndarray | None) -> np.ndarray:
            seeds = {"known_ground": known} if starts else {}
            return self.classify(points, parameters, progress, **seeds)

        low = None if self.is_classic(parameters) else _low_outliers(points, known, progress)
        if low is None:
            return Found(found(points, known), None)
        left, ground = ~low, np.zeros(points.count, dtype=bool)
        ground[left] = found(points.take(left), None if known is None else known[left])
        return Found(ground, low)

    def is_classic(self, parameters: ParameterSet) -> bool:
        """Return whether the parameters select the classic preset."""
        return vars(parameters)["preset"] == self.classic

    def largest(self, parameters: ParameterSet) -> tuple[float, str]:
        """Return the width in metres of the largest expected object, and the parameter's name.

        If the user gave no width, it is a usual one: wider objects are searched, but rare.
        """
        labels = {each.name: each.label for each in parameters.declarations()}
        size = self.largest_object(parameters)
        if vars(parameters)["preset"] == "automatic" and size == self.largest_object(
            self.parameters()
        ):
            size = min(size, _USUAL_OBJECT)
        return size, labels[self.size_parameter]


def _low_outliers(
    points: Points, known: np.ndarray | None, progress: Progress
) -> np.ndarray | None:
    """Return which points are low outliers, scattered or in groups; None if there are none."""
    low = scattered_lows(points)
    if np.count_nonzero(low) > _MANY_OUTLIERS * points.count:
        progress.info(
            "Low outliers are scattered all over the points. They are left out, and are not ground."
        )
    rest = np.flatnonzero(~low) if low.any() else slice(None)
    groups = LowGroups().find(points.take(rest))
    if groups.any():
        low[rest] |= groups
    if known is not None:
        low &= ~known
    return low if low.any() else None
