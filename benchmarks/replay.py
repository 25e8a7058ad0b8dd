"""Runs a changed pipeline from the rule where it differs, and only as far as that matters."""

from __future__ import annotations

import copy
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.core.progress import SILENT, Progress
from bare_earth.algorithms.filters.pipeline import Pipeline, Rule
from bare_earth.algorithms.filters.state import State


class Usual(NamedTuple):
    """The rules of a usual run, and the states before the first of them, and after each."""

    rules: tuple[Rule, ...]
    states: tuple[State, ...]


@dataclass
class Kept:
    """The usual runs: blocks of a file, which threads work on, have one each."""

    runs: list[Usual] = field(default_factory=list)


@dataclass(frozen=True)
class Replay(Pipeline):
    """A pipeline that differs in some rules from a usual one, which was run on the same points."""

    kept: Kept = field(default_factory=Kept)

    def run(
        self,
        points: Points,
        progress: Progress = SILENT,
        known_ground: np.ndarray | None = None,
        multi_return: np.ndarray | None = None,
        explains: bool = False,
    ) -> State:
        """Return what `Pipeline.run` returns but times and decisions; the first run on some points
        is the usual one.
        """
        same = (run for run in self.kept.runs if _is_same(run.states[0].points, points))
        usual = next(same, None)
        if usual is None:
            return self._record(State(points, progress, known_ground, multi_return))
        same_end = _same_rules(usual.rules[::-1], self.rules[::-1])
        first = min(_same_rules(usual.rules, self.rules), len(self.rules) - same_end)
        state = _copied(usual.states[first])
        for number in range(first, len(self.rules)):
            left = len(self.rules) - number
            if left <= same_end and _is_same(state, usual.states[len(usual.rules) - left]):
                return _copied(usual.states[-1])
            self.apply(self.rules[number], state, SILENT)
        return state

    def _record(self, state: State) -> State:
        states = [_copied(state)]
        for rule in self.rules:
            self.apply(rule, state, SILENT)
            states.append(_copied(state))
        self.kept.runs.append(Usual(self.rules, tuple(states)))
        return state


def _same_rules(some: tuple[Any, ...], others: tuple[Any, ...]) -> int:
    """Return how many rules are equal, from the first on."""
    count = 0
    for one, other in zip(some, others):
        if one != other:
            break
        count += 1
    return count


def _copied(state: State) -> State:
    """Return a copy, but of what no rule changes."""
    given = state.points, state.progress, state.known_ground, state.multi_return
    unchanged: list[object] = list(given)
    for grid in state.grids:
        unchanged += grid.points, grid.cells
    return copy.deepcopy(state, {id(value): value for value in unchanged})


def _is_same(one: Any, other: Any) -> bool:
    """Return whether two values of states are equal, whatever has been counted or timed."""
    if one is other:
        return True
    if type(one) is not type(other):
        return False
    if isinstance(one, np.ndarray):
        return np.array_equal(one, other, equal_nan=one.dtype.kind == "f")
    if isinstance(one, dict):
        names = set(one) - {"times", "progress"}
        return names == set(other) - {"times", "progress"} and all(
            _is_same(one[name], other[name]) for name in names
        )
    if isinstance(one, (list, tuple)):
        return len(one) == len(other) and all(map(_is_same, one, other))
    if hasattr(one, "__dict__"):
        return _is_same(vars(one), vars(other))
    return bool(one == other)
