"""Parameters, declared once for the dialog, the command line, the docs and validation.

The parameters of a method are a frozen dataclass derived from `ParameterSet`. Its fields are made
by `parameter`:

>>> @dataclass(frozen=True)
... class Example(ParameterSet):
...     cell_size: float = parameter(
...         0.5, label="Cell size", unit="m", minimum=0.01, help="Side of a square cell.")
>>> Example().cell_size
0.5
>>> Example(cell_size=-1)  # doctest: +IGNORE_EXCEPTION_DETAIL
Traceback (most recent call last):
    ...
BareEarthError: Cell size must be at least 0.01 m, not -1.
"""

from __future__ import annotations

import dataclasses
import functools
import math
from dataclasses import dataclass
from typing import Any, Iterable, Mapping, TypeVar

from .errors import BareEarthError

_KEY = "declaration"
_Set = TypeVar("_Set", bound="ParameterSet")
_HasSets = TypeVar("_HasSets", bound="HasSets")


@dataclass(frozen=True)
class Declaration:
    """The declaration of one parameter."""

    name: str  # upper case in Processing, with hyphens on the command line
    # "number", "integer", "boolean", "choice", "choices", "numbers" or "integers" (lists).
    kind: str
    default: Any  # None if the parameter is off by default
    label: str  # title of the field
    help: str  # one or two sentences on what it does and how to choose it
    unit: str = ""  # "m", "deg", "points"; empty if it has none
    minimum: float | None = None  # inclusive, of a number, or of each number of a list
    maximum: float | None = None  # inclusive
    # The labels of the values of a choice.
    choices: Mapping[str, str] = dataclasses.field(default_factory=dict)
    optional: bool = False  # whether None is allowed
    advanced: bool = False
    empty: str = "not used"  # what None means: "not used", "automatic", or other words
    word: str = ""  # may be given in place of a list of numbers, such as "all"; empty for none

    def check(self, value: Any) -> Any:
        """Return `value`, converted to the type of this parameter; refuse what is not allowed."""
        if value is None:
            if not self.optional:
                raise BareEarthError(f"{self.label} must have a value.")
            return None
        if self.kind == "boolean":
            return bool(value)
        if self.kind == "choice":
            return self._check_choice(value)
        if self.kind == "choices":
            chosen = [value] if isinstance(value, str) else value
            checked = tuple(dict.fromkeys(map(self._check_choice, chosen)))
            if not checked:
                raise BareEarthError(f"{self.label}: choose at least one.")
            return checked
        if self.kind in ("numbers", "integers"):
            if self._is_word(value):
                return self.word
            if isinstance(value, (str, bytes)) or not hasattr(value, "__iter__"):
                raise BareEarthError(f"{self.label} must be a list of numbers, not {value!r}.")
            return tuple(map(self._check_number, value))
        return self._check_number(value)

    def _is_word(self, value: object) -> bool:
        """Return whether a list, or its only element, is the word that may replace it."""
        only = value[0] if isinstance(value, (list, tuple)) and len(value) == 1 else value
        return bool(self.word) and isinstance(only, str) and only.strip().lower() == self.word

    def _check_choice(self, value: Any) -> str:
        if isinstance(value, int) and str(value) in self.choices:  # programs write numbers so
            return str(value)
        if value not in self.choices:
            raise BareEarthError(
                f"{self.label} must be one of {', '.join(self.choices)}, not {value}."
            )
        return value

    def _check_number(self, value: Any) -> float | int:
        try:
            number = float(value)
        except (TypeError, ValueError):
            raise BareEarthError(f"{self.label} must be a number, not {value!r}.") from None
        unit = f" {self.unit}" if self.unit else ""
        if not math.isfinite(number):
            raise BareEarthError(f"{self.label} must be a finite number, not {value}.")
        if self.minimum is not None and number < self.minimum:
            raise BareEarthError(
                f"{self.label} must be at least {self.minimum:g}{unit}, not {value}."
            )
        if self.maximum is not None and number > self.maximum:
            raise BareEarthError(
                f"{self.label} must be at most {self.maximum:g}{unit}, not {value}."
            )
        if self.kind in ("integer", "integers"):
            if number != int(number):
                raise BareEarthError(f"{self.label} must be a whole number, not {value}.")
            return int(number)
        return number


def parameter(
    default: Any,
    *,
    label: str,
    help: str,
    unit: str = "",
    minimum: float | None = None,
    maximum: float | None = None,
    choices: Mapping[str, str] | None = None,
    kind: str | None = None,
    optional: bool = False,
    advanced: bool = False,
    empty: str = "not used",
    word: str = "",
) -> Any:
    """Declare one field of a `ParameterSet`, with the arguments of `Declaration`; `kind` must be
    given if the default is None.
    """
    if kind is None:
        kind = "choice" if choices else _kind_of(default)
    declaration = Declaration(
        "", kind, default, label, help, unit, minimum, maximum, dict(choices or {}),
        optional or default is None, advanced, empty, word,
    )  # fmt: skip
    return dataclasses.field(default=default, metadata={_KEY: declaration})


def parameter_of(declared: type[ParameterSet], name: str, **differently: Any) -> Any:
    """Declare the field of another set again, with other attributes of its `Declaration`."""
    declaration = next(known for known in declared.declarations() if known.name == name)
    declaration = dataclasses.replace(declaration, **differently)
    return dataclasses.field(default=declaration.default, metadata={_KEY: declaration})


def shown_value(value: str | float) -> str:
    """Return a value of a list as a user types it."""
    return value if isinstance(value, str) else f"{value:g}"


def _kind_of(default: object) -> str:
    if isinstance(default, bool):
        return "boolean"
    if isinstance(default, int):
        return "integer"
    if isinstance(default, float):
        return "number"
    if isinstance(default, tuple):
        whole = default and all(isinstance(number, int) for number in default)
        return "integers" if whole else "numbers"
    raise TypeError(f"Give the kind of a parameter whose default is {default!r}.")


@dataclass(frozen=True)
class ParameterSet:
    """Base class of parameters: checks each value when an instance is made."""

    only_for_many = False  # whether they mean nothing for a single file

    def __post_init__(self) -> None:
        for declaration in self.declarations():
            checked = declaration.check(getattr(self, declaration.name))
            object.__setattr__(self, declaration.name, checked)

    def filled(self: _Set, values: Mapping[str, Any]) -> _Set:
        """Return a copy in which empty parameters (None) get the values, given by name."""
        empty = {
            name: value for name, value in values.items() if getattr(self, name, value) is None
        }
        return dataclasses.replace(self, **empty)

    def in_words(self, *names: str) -> str:
        """Return some parameters in words: their labels, values and units."""
        declared = {declaration.name: declaration for declaration in self.declarations()}
        words = []
        for name in names:
            value = getattr(self, name)
            values = value if isinstance(value, tuple) else (value,)
            shown = ", ".join(map(shown_value, values))
            words.append(f"{declared[name].label.lower()} {shown} {declared[name].unit}".rstrip())
        return ", ".join(words)

    @classmethod
    def among(cls: type[_Set], sets: Iterable[ParameterSet]) -> _Set:
        """Return the set of this type from a list of sets, or the defaults."""
        return next((found for found in sets if isinstance(found, cls)), None) or cls()

    @classmethod
    @functools.cache
    def declarations(cls) -> tuple[Declaration, ...]:
        """Return the declarations of all parameters, in order."""
        return tuple(
            dataclasses.replace(field.metadata[_KEY], name=field.name)
            for field in dataclasses.fields(cls)
        )


class HasSets:
    """Base of dataclasses with a default for each field; some fields are parameter sets."""

    @classmethod
    def of(cls: type[_HasSets], sets: Iterable[ParameterSet], **fields: Any) -> _HasSets:
        """Return an instance with other fields, and with parameter sets in any order: a set goes to
        the field of its type, or to the field `parameters` if no field has its type.
        """
        names = {type(default): name for name, default in vars(cls()).items()}
        fields.update((names.get(type(given), "parameters"), given) for given in sets)
        return cls(**fields)
