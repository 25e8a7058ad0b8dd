"""The ground filters: parameters in, points in, mask out."""

from __future__ import annotations

from typing import Callable, NamedTuple

import numpy as np

from ..core.parameters import ParameterSet
from .grid_minimum import filter as grid_minimum
from .slope import filter as slope
from .tin_densification import filter as tin_densification

# Metres: few buildings are wider.
_USUAL_OBJECT = 50.0


class Method(NamedTuple):
    """One ground filter.

    Attributes
    ----------
    name : str
        As on the command line.
    label : str
        As in the toolbox.
    parameters : type
        Its `ParameterSet`.
    classify : callable
        ``classify(points, parameters, progress)``, a pure function that returns the ground mask.
    reach : callable
        ``reach(parameters)``, the metres beyond which a point does not matter for another.
    largest_object : callable
        ``largest_object(parameters)``, the width in metres of the largest object looked for.
    size_parameter : str
        Name of the parameter that says so.
    classic : str
        The preset that does just what an original does: nothing is added to it.
    takes_known_ground : bool
        Whether `classify` takes the keyword ``known_ground``, a mask of points that are surely
        ground, and starts from them.
    """

    name: str
    label: str
    parameters: type[ParameterSet]
    classify: Callable[..., np.ndarray]
    reach: Callable[..., float]
    largest_object: Callable[..., float]
    size_parameter: str
    classic: str
    takes_known_ground: bool = False

    def is_classic(self, parameters: ParameterSet) -> bool:
        """Return whether parameters ask for what an original does."""
        return parameters.preset == self.classic

    def largest(self, parameters: ParameterSet) -> tuple[float, str]:
        """Return the width in metres of the largest object to be expected, and what says so.

        Where nobody said so, it is that of a usual one: larger ones are looked for, but are few.
        """
        labels = {each.name: each.label for each in parameters.declarations()}
        size = self.largest_object(parameters)
        if parameters.preset == "automatic" and size == self.largest_object(self.parameters()):
            size = min(size, _USUAL_OBJECT)
        return size, labels[self.size_parameter]


# The most accurate one.
DEFAULT_METHOD = "tin-densification"
METHODS = {
    method.name: method
    for method in (
        Method(
            "tin-densification",
            "TIN densification",
            tin_densification.TinDensification,
            tin_densification.classify,
            tin_densification.reach,
            tin_densification.largest_object,
            "max_building_size",
            tin_densification.CLASSIC,
            takes_known_ground=True,
        ),
        Method(
            "grid-minimum",
            "Grid minimum",
            grid_minimum.GridMinimum,
            grid_minimum.classify,
            grid_minimum.reach,
            grid_minimum.largest_object,
            "max_object_size",
            grid_minimum.CLASSIC,
        ),
        Method(
            "slope",
            "Slope filter",
            slope.SlopeFilter,
            slope.classify,
            slope.reach,
            slope.largest_object,
            "max_building_size",
            slope.CLASSIC,
        ),
    )
}


def method_of(parameters: ParameterSet) -> Method:
    """Return the method that `parameters` belong to."""
    return next(method for method in METHODS.values() if isinstance(parameters, method.parameters))
