"""The rules of the filters, which their pipelines tell, and what is changed to measure them."""

from __future__ import annotations

import ast
import contextlib
import dataclasses
import inspect
import re
from typing import Any, Iterator

import numpy as np

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.core.progress import SILENT
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.filters.method import Method
from bare_earth.algorithms.filters.pipeline import Pipeline, Rule
from bare_earth.algorithms.filters.stages.breaks import LevelSeeds
from bare_earth.algorithms.filters.stages.densify import Densification
from bare_earth.algorithms.filters.stages.objects import RaisedObjects
from bare_earth.algorithms.filters.stages.opening import ProgressiveOpening
from bare_earth.algorithms.filters.stages.seeds import LowestPoints
from bare_earth.algorithms.filters.stages.terrain import GentleRegions
from bare_earth.algorithms.filters.stages.tolerance import ToleranceSurface

from .replay import Kept, Replay

# The variant with all rules.
BASE = "base"
# Nothing works without these, and the last does nothing if no ground is known.
_LEFT_IN = "lowest-points", "seeds", "tolerance-surface", "near-surface", "known-ground"
# Rules that are left out together.
GROUPS = {
    "low points": (
        "dense-outliers", "below-water", "low-groups", "below-land", "narrow-pits",
        "isolated-low-points",

    ),
    "checks of seeds": ("plants", "shrubs", "level-seeds"),
}  # fmt: skip
# Other values of a rule: its class, and the values.
VALUES: dict[str, tuple[type[Rule], dict[str, Any]]] = {
    "one grid": (LowestPoints, {"grids": 1}),
    "objects on the cells of the filter": (RaisedObjects, {"wide": None}),
    "low and wide objects": (RaisedObjects, {"steepness": 0.0}),
    "windows for halls as for houses": (ProgressiveOpening, {"usual_window": np.inf}),
    "level seeds under plants": (LevelSeeds, {"openness": 0.0}),
    "plateaus are not cut off": (ProgressiveOpening, {"plateau_share": 1.1}),
    "large windows in woods": (ProgressiveOpening, {"crown": np.inf}),
    "vertices without a level neighbour": (Densification, {"level": None}),
    "vertices in woods": (Densification, {"in_woods": True}),
    "tolerance at breaks as elsewhere": (ToleranceSurface, {"at_breaks": 0.0}),
    "tolerance under trees as elsewhere": (ToleranceSurface, {"under_trees": 1.0}),
    "nothing beyond the survey": (ProgressiveOpening, {"level_beyond": False}),
    "gaps are not judged": (GentleRegions, {"judges_gaps": False}),
}


def pipeline_of(method: str) -> Pipeline:
    """Return the rules of a method as it runs by default."""
    parameters = METHODS[method].parameters()
    return METHODS[method].pipeline(Points(*np.eye(3)), parameters, SILENT)


def rules(method: str) -> dict[str, type[Rule]]:
    """Return the rules of a method that can be left out, by their names."""
    parts = (part for rule in pipeline_of(method).rules for part in rule.parts())
    return {part.name: type(part) for part in parts if part.name not in _LEFT_IN}


def variants(method: str) -> list[str]:
    """Return what can be changed in a method: first nothing, then rules, groups and values."""
    usual = pipeline_of(method)
    changes = (name for name in (*GROUPS, *VALUES) if changed(usual, name) != usual)
    return [BASE, *rules(method), *changes]


def lines(method: str, variant: str) -> int:
    """Return how many lines the classes of the rules have that a variant leaves out."""
    usual = pipeline_of(method)
    whole, kept = (
        {type(part) for rule in pipeline.rules for part in rule.parts()}
        for pipeline in (usual, changed(usual, variant))
    )
    return sum(len(inspect.getsource(part).splitlines()) for part in whole - kept)


def changed(pipeline: Pipeline, variant: str) -> Pipeline:
    """Return a pipeline without the rule or the group of this name, or with values: those of
    `VALUES`, or one as in ``gentle-border.least_area=50``.
    """
    kind, values = VALUES.get(variant, (None, {}))
    if "=" in variant:
        name, field, text = re.split("[.=]", variant, maxsplit=2)
        parts = (part for rule in pipeline.rules for part in rule.parts())
        kind, values = {part.name: type(part) for part in parts}.get(name), {}
        values[field] = ast.literal_eval(text)
    if kind is not None:
        return Pipeline(tuple(_with(rule, kind, values) for rule in pipeline.rules))
    names = set(GROUPS.get(variant, (variant,)))
    return pipeline.without(*names.intersection(pipeline.names))


def _with(rule: Rule, kind: type[Rule], values: dict[str, Any]) -> Rule:
    """Return a rule with values for itself, if it is of a kind, and for the rules in its fields."""
    fields = {field.name: getattr(rule, field.name) for field in dataclasses.fields(rule)}
    parts = {
        name: _with(part, kind, values) for name, part in fields.items() if isinstance(part, Rule)
    }
    return dataclasses.replace(rule, **parts, **(values if isinstance(rule, kind) else {}))


@contextlib.contextmanager
def switched_off(variant: str, kept: Kept | None = None) -> Iterator[None]:
    """Run the filters as a variant has them, on the same points as a run before where `kept` is
    given.
    """

    def varied(method: Method) -> Method:
        def pipeline(*given: Any) -> Pipeline:
            found = changed(method.pipeline(*given), variant)
            return found if kept is None else Replay(found.rules, kept)

        return method._replace(pipeline=pipeline)

    usual = dict(METHODS)
    METHODS.update({name: varied(method) for name, method in usual.items()})
    try:
        yield
    finally:
        METHODS.update(usual)
