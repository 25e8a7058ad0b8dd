"""The numbers that rules hold, and how one of them is changed to measure what it is worth."""

from __future__ import annotations

import contextlib
import dataclasses
import importlib
import pkgutil
import re
from functools import cache
from pathlib import Path
from typing import Any, Iterator, NamedTuple

import numpy as np

from bare_earth.algorithms import filters
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.filters.method import Method
from bare_earth.algorithms.filters.pipeline import Pipeline, Rule

from .replay import Kept, Replay
from .rules import pipeline_of

# The name of the value that is a rule as a whole.
RULE = "rule"
# Where in the filters a constant is used before or after the pipeline, or by all rules.
_EVERYWHERE = ("state", "height_grid", "pipeline", "method")
# Side of the cells of a grid, which follows from the points.
_OF_POINTS = "lowest-points", "size"
FILES = {
    found.name.rpartition(".")[2]: importlib.import_module(found.name)
    for found in pkgutil.walk_packages(filters.__path__, f"{filters.__name__}.")
}


class Value(NamedTuple):
    """A number of a rule, or of a file: what it belongs to, its name, and what it is; or a rule."""

    owner: str  # name of the rule, or of the file
    name: str
    now: tuple[Any, ...]  # one, or several where rules or methods differ; none of a rule

    @property
    def title(self) -> str:
        """The name by which it is asked for."""
        return f"{self.owner}.{self.name}"


class Change(NamedTuple):
    """A value times a factor."""

    owner: str
    name: str
    factor: float


def _is_number(value: object) -> bool:
    if isinstance(value, (tuple, list)):
        return bool(value) and all(map(_is_number, value))
    return isinstance(value, (int, float, np.number))


def _numbers(value: object) -> Any:
    """Return the numbers of a value, or of a named tuple of numbers; None if it has none."""
    if isinstance(value, tuple):
        value = tuple(one for one in value if isinstance(one, tuple) or _is_number(one))
    return value if _is_number(value) else None


def rule_classes() -> dict[str, type[Rule]]:
    """Return all rules, also those of which no preset makes use, by their names."""
    found, todo = {}, [Rule]
    while todo:
        for kind in todo.pop().__subclasses__():
            todo.append(kind)
            if kind.__module__.startswith(filters.__name__) and kind.__name__[:1] != "_":
                found[kind.name] = kind
    return {name: kind for name, kind in found.items() if kind.__module__ != Pipeline.__module__}


def values() -> list[Value]:
    """Return every number that rules hold in fields, and every one that has a name in a file."""
    parts = [
        part for method in METHODS for rule in pipeline_of(method).rules for part in rule.parts()
    ]
    found = []
    for name, kind in rule_classes().items():
        found.append(Value(name, RULE, ()))
        for field in dataclasses.fields(kind):
            now = [getattr(part, field.name) for part in parts if part.name == name]
            if not now and field.default is not dataclasses.MISSING:
                now = [field.default]
            numbers = tuple(dict.fromkeys(one for one in map(_numbers, now) if one is not None))
            if numbers and (name, field.name) != _OF_POINTS:
                found.append(Value(name, field.name, numbers))
    return found + [constant for stem in FILES for constant in _constants(stem)]


def _constants(stem: str) -> Iterator[Value]:
    """Yield the numbers that have a name in a file, and the presets."""
    for name in re.findall(
        r"^(_?[A-Z][A-Z_]*)\b[^=\n]*=", Path(FILES[stem].__file__).read_text("utf-8"), re.M
    ):
        held = getattr(FILES[stem], name)
        if isinstance(held, Method):
            continue
        for key, one in held.items() if isinstance(held, dict) else [("", held)]:
            numbers = _numbers(one)
            if numbers is not None:
                yield Value(f"{stem}.py", f"{name}[{key}]" if key else name, (numbers,))


def scaled(value: Any, factor: float) -> Any:
    """Return a number, or each of several, times a factor; what is on is off."""
    if isinstance(value, tuple):
        return tuple(scaled(one, factor) for one in value)
    if isinstance(value, bool) or not isinstance(value, int):
        return not value if isinstance(value, bool) else value * factor
    return (
        min(value - 1, int(value * factor)) if factor < 1 else max(value + 1, int(value * factor))
    )


def is_movable(value: Value) -> bool:
    """Return whether a value has multiples; presets are not moved, nor rules."""
    return "[" not in value.name and scaled(value.now, 2.0) != value.now


def _varied(rule: Rule, change: Change) -> Rule:
    """Return a rule with a changed value in it, or in the rules that are its fields."""
    fields = {field.name: getattr(rule, field.name) for field in dataclasses.fields(rule)}
    new: dict[str, Any] = {
        name: _varied(part, change) for name, part in fields.items() if isinstance(part, Rule)
    }
    if rule.name == change.owner and _numbers(fields[change.name]) is not None:
        new[change.name] = scaled(fields[change.name], change.factor)
    return dataclasses.replace(rule, **new)


def _stem(owner: str) -> str:
    return owner.rpartition(".")[0]


@cache
def _needs(stem: str) -> frozenset[str]:
    """Return the files that a file of the filters imports, with itself."""
    text = Path(FILES[stem].__file__).read_text("utf-8")
    imported = set(re.findall(r"^ *from \.[\w.]*?(\w+) import", text, re.M)) & set(FILES) - {stem}
    return frozenset({stem}).union(*map(_needs, imported))


def _marked(rule: Rule, stem: str) -> Rule:
    """Return a rule that is unequal to the usual one if it needs a file."""
    modules = {type(part).__module__.rpartition(".")[2] for part in rule.parts()}
    if not any(stem in _needs(one) for one in modules):
        return rule
    kind = type(type(rule).__name__, (type(rule),), {})
    return kind(**{field.name: getattr(rule, field.name) for field in dataclasses.fields(rule)})


@contextlib.contextmanager
def _constant(change: Change) -> Iterator[None]:
    """Give a constant another value, wherever it was imported."""
    usual = getattr(FILES[_stem(change.owner)], change.name)
    own = FILES[_stem(change.owner)]
    held = [
        one
        for one in FILES.values()
        if one is own or (change.name[0] != "_" and vars(one).get(change.name) is usual)
    ]
    for one in held:
        setattr(one, change.name, scaled(usual, change.factor))
    try:
        yield
    finally:
        for one in held:
            setattr(one, change.name, usual)


@contextlib.contextmanager
def changed(change: Change | None, kept: Kept) -> Iterator[None]:
    """Run the filters with a value changed, on the same points as a run before."""
    is_rule = change is not None and change.owner in rule_classes()
    is_whole = change is not None and _stem(change.owner) in _EVERYWHERE and not is_rule

    def varied(method: Method) -> Method:
        def pipeline(*given: Any) -> Pipeline:
            found = method.pipeline(*given)
            if is_whole or change is None:
                return found if is_whole else Replay(found.rules, kept)
            vary = _varied if is_rule else (lambda rule, one: _marked(rule, _stem(one.owner)))
            return Replay(tuple(vary(rule, change) for rule in found.rules), kept)

        return method._replace(pipeline=pipeline)

    usual = dict(METHODS)
    METHODS.update({name: varied(method) for name, method in usual.items()})
    try:
        with _constant(change) if change and not is_rule else contextlib.nullcontext():
            yield
    finally:
        METHODS.update(usual)


def methods_of(value: Value) -> list[str]:
    """Return the methods whose rules have a value, or need the file of it."""
    found = []
    for method in METHODS:
        parts = [part for rule in pipeline_of(method).rules for part in rule.parts()]
        files = {type(part).__module__.rpartition(".")[2] for part in parts}
        files |= {METHODS[method].parameters.__module__.rpartition(".")[2]}
        owner, needed = value.owner, frozenset().union(*map(_needs, files))
        if owner in {part.name for part in parts} or owner in {f"{one}.py" for one in needed}:
            found.append(method)
    return found
