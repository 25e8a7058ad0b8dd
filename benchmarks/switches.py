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
    finds_nothing : bool
        Whether the replacement is a function that finds nothing. The rule does not act where the
        function itself returns the same.
    """

    place: str
    by: Callable[[Any], Any]
    finds_nothing: bool = False

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
        for place in self.code or [each.place for each in self.changes if each.finds_nothing]:
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
    places: dict[str, tuple[Change, set[str]]] = {}
    for rule in rules:
        if not all(each.finds_nothing for each in rule.changes):
            acted.add(rule.name)
            continue
        for change in rule.changes:
            places.setdefault(change.place, (change, set()))[1].add(rule.name)

    def watch(change: Change, names: set[str], found: Callable[..., Any]) -> Callable[..., Any]:
        nothing = change.by(found)

        def run(*given: Any, **named: Any) -> Any:
            result = found(*given, **named)
            if not names <= acted and not _same(result, nothing(*given, **named)):
                acted.update(names)
            return result

        return run

    def changes() -> Iterator[tuple[Any, str, Any]]:
        for change, names in places.values():
            owner, name = change.owner()
            yield owner, name, watch(change, names, getattr(owner, name))

    with _replaced(changes()):
        yield acted


def _same(one: Any, other: Any) -> bool:
    if isinstance(one, tuple):
        return all(map(_same, one, other))
    return np.array_equal(one, other)
