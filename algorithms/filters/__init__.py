"""The ground filters: parameters in, points in, mask out."""

from __future__ import annotations

from ..core.parameters import ParameterSet
from . import grid_minimum, slope, tin
from .method import Method

# The most accurate one.
DEFAULT_METHOD = "tin-densification"
METHODS = {module.METHOD.name: module.METHOD for module in (tin, grid_minimum, slope)}


def method_of(parameters: ParameterSet) -> Method:
    """Return the method that `parameters` belong to."""
    return next(method for method in METHODS.values() if isinstance(parameters, method.parameters))
