"""Ground filters as the command line, the dialogs and the runs know them.

Warnings contain no figures that differ from block to block, so that each is shown only once.
"""

from __future__ import annotations

from typing import Any, Callable, Mapping, NamedTuple, TypeVar

import numpy as np

from ..core.parameters import ParameterSet, parameter
from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..grids.cells import Cells
from .pipeline import Pipeline

_Preset = TypeVar("_Preset", bound=NamedTuple)

# The presets that all methods have, besides their classic one, with their labels.
TERRAINS = {
    "automatic": "Automatic",
    "flat": "Flat land, fields",
    "hilly": "Hilly land, forest",
    "steep": "Steep or rugged terrain",
    "town": "Town",
    "city": "City, large halls",
    "site": "Drone survey, construction or mining site",
}
# Added to the number of the rule in a cell that is not ground.
NOT_GROUND = 100
# Usual width in metres of the largest building; few are wider.
_USUAL_OBJECT = 50.0
# A warning says that there is hardly any ground if fewer than this share of the cells with points
# have ground; side of the cells in metres.
_LEAST_GROUND = 0.02
_CELL = 1.0
# Share of ground among the points from which on the cells need not be counted.
_SURELY_ENOUGH = 0.1


class FoundGround(NamedTuple):
    """The result of a method."""

    ground: np.ndarray  # bool (n,): Which points are ground
    low: np.ndarray | None  # bool (n,): Which were left out as low noise; None for none
    decided: Decisions | None = None  # None if that was not asked for


class Decisions(NamedTuple):
    """Which rule decided the cell of each point."""

    # uint8 (n,): Number of the rule, from 1; `NOT_GROUND` is added where the cell is not ground. 0
    # if no rule works on cells.
    codes: np.ndarray
    size: float  # side of a cell in metres
    rules: tuple[str, ...]  # names of the rules; the first has number 1


class Method(NamedTuple):
    """One ground filter."""

    name: str  # as on the command line
    label: str  # as in the toolbox
    # The class of its parameters, with a field `preset` that has a choice ``automatic``.
    parameters: type[ParameterSet]
    # ``pipeline(points, parameters, progress)`` returns the rules for some points, and tells the
    # progress which values were chosen.
    pipeline: Callable[..., Pipeline]
    # ``reach(parameters)`` returns the distance in metres within which points affect each other.
    reach: Callable[..., float]
    # ``largest_object(parameters)`` returns the width in metres of the largest object that is
    # removed.
    largest_object: Callable[..., float]
    size_parameter: str  # name of the parameter for this width
    classic: str  # the preset with the rules of the original program or paper only
    presets: Mapping[str, NamedTuple]  # the values of each preset that has some, for the help
    takes_known_ground: bool = False  # whether the pipeline starts from points of known ground

    def ground(
        self,
        points: Points,
        parameters: ParameterSet,
        progress: Progress = SILENT,
        known: np.ndarray | None = None,
        multi_return: np.ndarray | None = None,
        explains: bool = False,
    ) -> FoundGround:
        """Return which points are ground, given those of `known` ground and those of pulses with
        several returns.
        """
        pipeline = self.pipeline(points, parameters, progress)
        state = pipeline.run(points, progress, known, multi_return, explains)
        decided = None
        if explains:
            rules = tuple(rule.name for rule in pipeline.rules)
            decided = Decisions(*state.codes(NOT_GROUND), rules)
        return FoundGround(state.ground, state.low_noise, decided)

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
        """Return the width in metres of the largest expected object (a usual one if the user gave
        none) and the label of its parameter.
        """
        labels = {declaration.name: declaration.label for declaration in parameters.declarations()}
        size = self.largest_object(parameters)
        if vars(parameters)["preset"] == "automatic" and size == self.largest_object(
            self.parameters()
        ):
            size = min(size, _USUAL_OBJECT)
        return size, labels[self.size_parameter]


def of_preset(
    label: str, limits: tuple[float, float], help: str, unit: str = "m", advanced: bool = False
) -> Any:  # as `parameter`
    """Declare a number that the preset gives if the user leaves it empty."""
    return parameter(
        None, label=label, help=help, unit=unit, minimum=limits[0], maximum=limits[1],
        advanced=advanced, kind="number", empty="automatic",
    )  # fmt: skip


def of_metres(
    default: float | None, label: str, most: float, help: str, optional: bool = False
) -> Any:  # as `parameter`
    """Declare an advanced length in metres, from 0 on, which may be left out if it is optional."""
    return parameter(
        default, label=label, help=help, unit="m", minimum=0.0, maximum=most,
        advanced=True, kind="number", optional=optional,
    )  # fmt: skip


def as_given(preset: _Preset, parameters: ParameterSet) -> _Preset:
    """Return the values of a preset, replaced by those of parameters that are not empty."""
    given = {name: vars(parameters)[name] for name in preset._fields}
    return preset._replace(**{name: value for name, value in given.items() if value is not None})


def warn_of_extent(points: Points, largest: float, name: str, progress: Progress) -> None:
    """Warn if the points extend less than the largest expected object, which may then have no
    ground on two sides; `name` is the label of the parameter for its width.
    """
    if min(points.sides) < largest:
        rise = float(np.ptp(points.z))
        is_upright = rise > max(min(points.sides), 0.5 * max(points.sides))
        progress.warning(
            f"In one direction the points reach less than {largest:g} m, the expected width of the"
            " largest object. An object at their border, or one that covers all of them, may be"
            " taken for ground. Add the points around them, or give the width of the largest"
            f" object ({name})."
            + f" Their heights reach {rise:.0f} m: check whether y is up in the file."
            * is_upright
        )


def warn_of_little_ground(points: Points, ground: np.ndarray, progress: Progress) -> None:
    """Warn if very few of the cells with points have ground."""
    if np.count_nonzero(ground) >= _SURELY_ENOUGH * points.count:
        return
    cells = Cells.over(points, _CELL)
    if np.count_nonzero(cells.holding(ground)) < _LEAST_GROUND * np.count_nonzero(cells.occupied):
        progress.warning(
            f"Hardly any ground was found: fewer than {100 * _LEAST_GROUND:g} % of the square"
            " metres with points have ground points. The terrain between them is a guess. Check"
            " the selection of points (returns, classes) and the result. In steep land, try the"
            " preset for it."
        )
