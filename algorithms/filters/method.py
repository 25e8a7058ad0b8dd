"""The description of a ground filter, for the command line, the dialogs and the runs."""

from __future__ import annotations

from typing import Any, Callable, Mapping, NamedTuple

import numpy as np

from ..core.parameters import ParameterSet
from ..core.points import Points
from ..core.progress import SILENT, Progress
from .pipeline import Pipeline

# Added to the number of the rule in a cell that is not ground.
NOT_GROUND = 100
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
    decided : Decisions or None
        Which rule decided the cell of each point, if that was asked for.
    """

    ground: np.ndarray
    low: np.ndarray | None
    decided: Decisions | None = None


class Decisions(NamedTuple):
    """Which rule decided the cell of each point.

    Attributes
    ----------
    codes : numpy.ndarray of uint8, shape (n,)
        Number of the rule, from 1; `NOT_GROUND` is added where the cell is not ground. 0 if no rule
        works on cells.
    size : float
        Side of a cell in metres.
    rules : tuple of str
        Names of the rules; the first has number 1.
    """

    codes: np.ndarray
    size: float
    rules: tuple[str, ...]


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
    pipeline : callable
        ``pipeline(points, parameters, progress)`` returns the rules for some points, and tells the
        progress which values were chosen.
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
        Whether the pipeline starts from points of known ground.
    """

    name: str
    label: str
    parameters: type[ParameterSet]
    pipeline: Callable[..., Pipeline]
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
        multi_return: np.ndarray | None = None,
        explains: bool = False,
    ) -> Found:
        """Return which points are ground. Low noise is left out, except by a classic preset.

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
        multi_return : numpy.ndarray of bool, shape (n,), optional
            Points of pulses with several returns, as they are many under trees.
        explains : bool
            Whether to tell which rule decided.
        """
        pipeline = self.pipeline(points, parameters, progress)
        state = pipeline.run(points, progress, known, multi_return, explains)
        decided = None
        if explains:
            rules = tuple(rule.name for rule in pipeline.rules)
            decided = Decisions(*state.codes(NOT_GROUND), rules)
        return Found(state.ground, state.low_noise, decided)

    def classify(
        self,
        points: Points,
        parameters: ParameterSet,
        progress: Progress = SILENT,
        known_ground: np.ndarray | None = None,
    ) -> np.ndarray:
        """Return which points are ground; boolean, shape (n,)."""
        return self.ground(points, parameters, progress, known_ground).ground

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
