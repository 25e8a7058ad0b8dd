"""Switching off rules of the filters, by changing what their modules hold.

A rule is switched off by a function that finds nothing in its place, or by a constant without
effect. Only this file knows how; the table of the rules is in `rules.py`.
"""

from __future__ import annotations

import contextlib
import functools
import importlib
import inspect
from dataclasses import dataclass
from typing import Any, Callable, Iterable, Iterator

import numpy as np

from bare_earth.algorithms import filters

# The code of a rule that is less than a function.
NO_CODE = ("",)
# The folder of each method; what lies there is used by this method alone.
FOLDERS = {name: name.replace("-", "_") for name in filters.METHODS}


def module_named(name: str) -> Any:
    """Return a module below `algorithms/filters`."""
    return importlib.import_module(f"{filters.__name__}.{name}")


@dataclass(frozen=True)
class Change:
    """What is put in the place of something while a rule is off.

    Attributes
    ----------
    place : str
        Module below `algorithms/filters`, a colon, and the name there, with the class if it is in
        one.
    by : callable
        Takes what is there and returns what replaces it.
    is_of_function : bool
        Whether it is a function that can be called beside what is there. The rule does not act
        where both return the same.
    """

    place: str
    by: Callable[[Any], Any]
    is_of_function: bool = False

    def owner(self) -> tuple[Any, str]:
        """Return the module or class that holds it, and its name there."""
        module, name = self.place.split(":")
        *classes, name = name.split(".")
        owner = module_named(module)
        return functools.reduce(getattr, classes, owner), name

    def serves(self, method: str) -> bool:
        """Return whether a method uses what is replaced."""
        folder = self.place.split(":")[0].split(".")[0]
        return folder == FOLDERS[method] or folder not in FOLDERS.values()


@dataclass(frozen=True)
class Rule:
    """A rule of the filters.

    Attributes
    ----------
    name : str
        As in the tables.
    changes : tuple of Change
        What switches it off.
    code : tuple of str
        Modules, or functions after a colon, that it consists of; by default what is replaced.
    methods : tuple of str
        Methods that may use it.
    """

    name: str
    changes: tuple[Change, ...]
    code: tuple[str, ...] = ()
    methods: tuple[str, ...] = tuple(filters.METHODS)

    def serves(self, method: str) -> bool:
        """Return whether a method may use the rule."""
        return method in self.methods and any(each.serves(method) for each in self.changes)

    def lines(self) -> int:
        """Return how many lines of code the rule has; 0 if it is less than a function."""
        total = 0
        replaced = [each.place for each in self.changes if each.is_of_function]
        for place in filter(None, self.code or replaced):
            module, _, name = place.partition(":")
            part: Any = module_named(module)
            part = functools.reduce(getattr, filter(None, name.split(".")), part)
            total += len(inspect.getsource(part).splitlines())
        return total


@contextlib.contextmanager
def _replaced(changes: Iterable[tuple[Any, str, Any]]) -> Iterator[None]:
    with contextlib.ExitStack() as stack:
        for owner, name, value in changes:
            stack.callback(setattr, owner, name, getattr(owner, name))
            setattr(owner, name, value)
        yield


def _changes(rules: Iterable[Rule]) -> Iterator[tuple[Any, str, Any]]:
    """Yield what to replace, each after what came before has been replaced."""
    for rule in rules:
        for change in rule.changes:
            owner, attribute = change.owner()
            yield owner, attribute, change.by(getattr(owner, attribute))


@contextlib.contextmanager
def without(rules: Iterable[Rule]) -> Iterator[None]:
    """Run the filters without some rules."""
    with _replaced(_changes(rules)):
        yield


@contextlib.contextmanager
def watched(rules: Iterable[Rule]) -> Iterator[set[str]]:
    """Run the filters with all rules, and tell at the end the names of those that found something.

    A rule that found nothing need not be switched off: the result would be the same. Rules that
    are no functions of their own always count as acting.
    """
    acted: set[str] = set()
    places: dict[str, list[tuple[str, Change]]] = {}
    for rule in rules:
        if not all(each.is_of_function for each in rule.changes):
            acted.add(rule.name)
            continue
        for change in rule.changes:
            places.setdefault(change.place, []).append((rule.name, change))

    def watch(found: Callable[..., Any], changes: list[tuple[str, Change]]) -> Callable[..., Any]:
        others = [(name, change.by(found)) for name, change in changes]

        def run(*given: Any, **named: Any) -> Any:
            result = found(*given, **named)
            for name, other in others:
                if name not in acted and not _same(result, other(*given, **named)):
                    acted.add(name)
            return result

        return run

    def changes() -> Iterator[tuple[Any, str, Any]]:
        for at_place in places.values():
            owner, name = at_place[0][1].owner()
            yield owner, name, watch(getattr(owner, name), at_place)

    with _replaced(changes()):
        yield acted


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, tuple):
        return all(map(_same, one, other))
    return np.array_equal(one, other)
