"""Commands, options of declared parameters, and the parameters that they give."""

from __future__ import annotations

import argparse
from functools import partial
from typing import Callable, NamedTuple, Sequence

from ..core.errors import BareEarthError, UsageError
from ..core.parameters import Declaration, ParameterSet, shown_value

# Exit codes.
DONE = 0
FAILED = 1
USAGE = 2


class Command(NamedTuple):
    """One command."""

    name: str
    line: str  # a sentence, for the list of commands
    more: str  # its help behind the line; empty if `add` sets the whole help
    # adds options to a parser; they can depend on the whole command line
    add: Callable[[argparse.ArgumentParser, Sequence[str]], None]
    run: Callable[[argparse.Namespace], int]  # returns the exit code


_NOT_USED = ("none", "automatic")


def add_json(parser: argparse.ArgumentParser, result: str = "what was done ") -> None:
    """Add the option to print the result as JSON."""
    parser.add_argument("--json", action="store_true", help=f"print {result}as JSON")


def add_parameters(
    parser: argparse.ArgumentParser, *declared: type[ParameterSet], titles: Sequence[str] = ()
) -> None:
    """Add an option for each declared parameter of some sets, which `chosen` returns in this order,
    with a title in the help for each set.
    """
    for place, group in enumerate(declared):
        _add_options(parser.add_argument_group(titles[place]) if titles else parser, group)
    parser.set_defaults(declared=declared)


def chosen(options: argparse.Namespace) -> list[ParameterSet]:
    """Return the sets of parameters with the values of the options; `UsageError` if not allowed."""
    return [_from_options(group, options) for group in options.declared]


def keep_what_was_given(options: argparse.Namespace) -> None:
    """Put the names of the parameters that were given into `named`, and defaults for the others."""
    declared = [one for group in getattr(options, "declared", ()) for one in group.declarations()]
    options.named = {one.name for one in declared if hasattr(options, one.name)}
    for one in declared:
        if one.name not in options.named:
            setattr(options, one.name, one.default)


def _add_options(
    parser: argparse.ArgumentParser | argparse._ArgumentGroup, declared: type[ParameterSet]
) -> None:
    for parameter in declared.declarations():
        add = partial(
            parser.add_argument, "--" + parameter.name.replace("_", "-"), dest=parameter.name,
            default=argparse.SUPPRESS, help=_help_of(parameter),
        )  # fmt: skip
        choices = list(parameter.choices)
        if parameter.kind == "boolean":
            add(action=argparse.BooleanOptionalAction)
        elif parameter.kind == "choice":
            add(choices=choices)
        elif parameter.kind == "choices":
            add(nargs="+", choices=choices, metavar=parameter.name.upper().rstrip("S"))
        elif parameter.kind in ("numbers", "integers"):
            add(nargs="*", metavar=parameter.unit or "N")
        else:
            add(metavar=parameter.unit.replace(" ", "_") or "N")


def _help_of(parameter: Declaration) -> str:
    default = parameter.default
    if isinstance(default, bool):
        default = "on" if default else "off"
    elif isinstance(default, tuple):
        default = " ".join(map(shown_value, default)) or "none"
    unit = f" {parameter.unit}" if parameter.unit and default is not None else ""
    words = [parameter.help, f"(default: {parameter.empty if default is None else default}{unit})"]
    words[1:1] = [f"{value}: {label}." for value, label in parameter.choices.items()]
    return " ".join(words).replace("%", "%%")


def _from_options(declared: type[ParameterSet], options: argparse.Namespace) -> ParameterSet:
    values = {
        parameter.name: getattr(options, parameter.name) for parameter in declared.declarations()
    }
    for parameter in declared.declarations():
        value = values[parameter.name]
        word = value[0] if isinstance(value, list) and len(value) == 1 else value
        if parameter.optional and str(word).lower() in _NOT_USED:
            values[parameter.name] = None
    try:
        return declared(**values)
    except BareEarthError as error:
        raise UsageError(str(error)) from error
