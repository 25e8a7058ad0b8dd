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
    """What a method finds."""

    ground: np.ndarray  # bool (n,): Which points are ground
    # bool (n,) or None: Which points were left out as low outliers; None for none.
    low: np.ndarray | None
    # Which rule decided the cell of each point, if that was asked for.
    decided: Decisions | None = None


class Decisions(NamedTuple):
    """Which rule decided the cell of each point."""

    # uint8 (n,): Number of the rule, from 1; `NOT_GROUND` is added where the cell is not ground. 0
    # if no rule works on cells.
    codes: np.ndarray
    size: float  # side of a cell in metres
    rules: tuple[str, ...]  # names of the rules; the first has number 1


class Toolbox(NamedTuple):
    """A ground filter in the toolbox of QGIS."""

    identifier: str  # second half of the id; it never changes
    # Name and tooltip.
    title: str
    summary: str
    about: str  # first paragraphs of the help
    page: str  # its page in the folder docs
    words: tuple[str, ...]  # search words, separated by commas; each text is translated as a whole


class Method(NamedTuple):
    """One ground filter."""

    name: str  # as on the command line
    label: str  # as in the toolbox
    # Its `ParameterSet`. It has a field `preset` with a choice ``automatic``.
    parameters: type[ParameterSet]
    # ``pipeline(points, parameters, progress)`` returns the rules for some points, and tells the
    # progress which values were chosen.
    pipeline: Callable[..., Pipeline]
    # ``reach(parameters)``, the distance in metres within which points affect each other.
    reach: Callable[..., float]
    # ``largest_object(parameters)``, the width in metres of the largest object that is searched.
    largest_object: Callable[..., float]
    size_parameter: str  # name of the parameter with this width
    # The preset that does the same as the original program or paper, without additions.
    classic: str
    presets: Mapping[str, Any]  # the values of each preset that has some, for the help
    toolbox: Toolbox  # its texts in the toolbox
    takes_known_ground: bool = False  # whether the pipeline starts from points of known ground

    def ground(
        self,
        points: Points,
        parameters: ParameterSet,
        progress: Progress = SILENT,
        known: np.ndarray | None = None,
        multi_return: np.ndarray | None = None,
        explains: bool = False,
    ) -> Found:
        """Return which points are ground, without low noise (except by a classic preset), given
        known ground and points of pulses with several returns.
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
        """Return the width in metres of the largest expected object, a usual one if the user gave
        none, and the parameter's name.
        """
        labels = {each.name: each.label for each in parameters.declarations()}
        size = self.largest_object(parameters)
        if vars(parameters)["preset"] == "automatic" and size == self.largest_object(
            self.parameters()
        ):
            size = min(size, _USUAL_OBJECT)
        return size, labels[self.size_parameter]
