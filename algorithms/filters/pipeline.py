"""Ground filters as pipelines of rules.

A rule decides about cells or points on which earlier rules have not decided. A pipeline runs its
rules in the order of their stages. Each rule can be left out by its name.
"""

from __future__ import annotations

import dataclasses
import re
import threading
import time
from dataclasses import dataclass
from enum import Enum
from typing import ClassVar, Iterator

import numpy as np

from ..core.points import Points
from ..core.progress import SILENT, Progress
from ..core.threads import in_threads
from .state import GridState, RuleTime, State

# A warning tells of low outliers if they are more than this share of the lowest points, and these
# are numerous enough for a share.
_MOST_OUTLIERS = 0.02
_LEAST_CELLS = 500


class Stage(Enum):
    """The stages of a pipeline, in their order."""

    LOWEST = "lowest points"
    LOW_NOISE = "low noise"
    OUTLIERS = "outliers"
    OBJECTS = "objects"
    OPENING = "opening"
    TERRAIN = "terrain"
    SEEDS = "seeds"
    SURFACE = "surface"
    ACCEPTED = "accepted points"


@dataclass(frozen=True)
class Rule:
    """One rule of a filter, whose fields are its values."""

    # Fields can be other rules, such as exceptions of this one. If such a field is None, the rule
    # works without it.

    stage: ClassVar[Stage]  # when the rule is applied
    writes: ClassVar[tuple[str, ...]] = ()  # fields of the state that the rule changes
    name: ClassVar[str]

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        cls.name = re.sub(r"(?<!^)(?=[A-Z])", "-", cls.__name__).lower()

    def parts(self) -> Iterator[Rule]:
        """Yield this rule and the rules that are fields of it."""
        yield self
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if isinstance(value, Rule):
                yield from value.parts()

    def without(self, names: frozenset[str]) -> Rule:
        """Return this rule without those of its fields that have these names."""
        changes = {}
        for field in dataclasses.fields(self):
            value = getattr(self, field.name)
            if isinstance(value, Rule):
                changes[field.name] = None if value.name in names else value.without(names)
        return dataclasses.replace(self, **changes)


@dataclass(frozen=True)
class PointRule(Rule):
    """A rule that is applied to the state of a pipeline as a whole."""

    def apply(self, state: State) -> None:
        """Change the state by this rule."""
        raise NotImplementedError


@dataclass(frozen=True)
class GridRule(Rule):
    """A rule that is applied to each grid of the state."""

    def apply(self, grid: GridState, progress: Progress) -> None:
        """Change the state of one grid by this rule."""
        raise NotImplementedError


@dataclass(frozen=True)
class Pipeline:
    """The rules of a ground filter, in the order of their stages."""

    rules: tuple[Rule, ...]  # applied one after another

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all rules, including fields of others."""
        return tuple(dict.fromkeys(part.name for rule in self.rules for part in rule.parts()))

    def without(self, *names: str) -> Pipeline:
        """Return a pipeline without the rules of these names."""
        unknown = set(names) - set(self.names)
        if unknown:
            raise ValueError(f"No rule is called {', '.join(sorted(unknown))}.")
        left_out = frozenset(names)
        rules = (rule for rule in self.rules if rule.name not in left_out)
        return Pipeline(tuple(rule.without(left_out) for rule in rules))

    def through(self, stage: Stage) -> Pipeline:
        """Return a pipeline of the rules of the stages up to and including one."""
        stages = list(Stage)
        last = stages.index(stage)
        return Pipeline(tuple(rule for rule in self.rules if stages.index(rule.stage) <= last))

    def run(
        self,
        points: Points,
        progress: Progress = SILENT,
        known_ground: np.ndarray | None = None,
        multi_return: np.ndarray | None = None,
        explains: bool = False,
    ) -> State:
        """Return the state after all rules, with the rule that decided each cell if it `explains`;
        BareEarthError if the points spread too far for a grid or there is no ground.
        """
        state = State(points, progress, known_ground, multi_return)
        outliers = [n for n, rule in enumerate(self.rules) if rule.stage is Stage.OUTLIERS]
        for number, rule in enumerate(self.rules):
            part = progress.part(number / len(self.rules), (number + 1) / len(self.rules))
            begun = time.perf_counter()
            self.apply(rule, state, part)
            seconds = time.perf_counter() - begun
            state.times.append(RuleTime(rule.stage.value, rule.name, seconds))
            progress.took(rule.stage.value, seconds)
            if explains:
                state.note(number)
            part(1.0)
            if outliers and number == outliers[-1]:
                grid = state.grids[0]
                known = int(np.count_nonzero(np.isfinite(grid.heights.values)))
                warn_of_outliers(len(grid.lowest), len(grid.lowest) - known, progress)
        return state

    @staticmethod
    def apply(rule: Rule, state: State, progress: Progress) -> None:
        """Change a state by one rule."""
        if isinstance(rule, GridRule):
            _apply_to_grids(rule, state, progress)
        elif isinstance(rule, PointRule):
            state.progress = progress
            rule.apply(state)


def _apply_to_grids(rule: GridRule, state: State, progress: Progress) -> None:
    caller, count = threading.get_ident(), len(state.grids)

    def apply(number: int) -> None:
        # Progress is for the calling thread only.
        is_caller = threading.get_ident() == caller
        part = progress.part(number / count, (number + 1) / count) if is_caller else SILENT
        rule.apply(state.grids[number], part)

    in_threads(apply, range(count))


def warn_of_outliers(count: int, outliers: int, progress: Progress) -> None:
    """Warn if many of the `count` lowest points are low outliers."""
    if count >= _LEAST_CELLS and outliers > _MOST_OUTLIERS * count:
        progress.warning(
            f"More than {100 * _MOST_OUTLIERS:g} % of the lowest points are taken for low outliers."
            " If they are noise, put them into class 7 to be sure that they take no part. If they"
            " are the ground below trees or in pits, compare the result with the points there."
        )
