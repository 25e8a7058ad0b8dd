"""Makes functions of the library from their declarations."""

from __future__ import annotations

import inspect
import re
import textwrap
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any, Callable, Collection, Iterable, Mapping, Sequence

from ..core.parameters import Declaration, ParameterSet
from ..crs.stated import crs_text
from ..engine.summary import TileSummary
from ..filters import METHODS
from ..tools.ground.method import TileMethod
from .arguments import KINDS, REQUIRED, Argument, Kind
from .given import extent_of
from .remote_points import with_downloaded_points

PACKAGE = __name__.partition(".algorithms.")[0]
_WIDTH = 92
# Arguments that come after the parameters.
_LAST = ("crs", "vpc", "cache", "limit", "scheduler", "progress")
_TYPES = {"number": "float", "integer": "int", "boolean": "bool"}
# Converts the values of some kinds, which users can give in several types.
_CONVERTERS = {KINDS["crs"]: crs_text, KINDS["extent"]: extent_of}
_RAISES = """
Raises
------
BareEarthError
    If an input cannot be read, a value is not allowed, or an output cannot be written.
Cancelled
    If `progress` asked to stop; no output is incomplete.
"""

# Does the work of a function: gets all values by their names, and instances of its sets;
# the first is that of the ground filter if the function has one.
Run = Callable[[SimpleNamespace, Sequence[ParameterSet]], object]


@dataclass(frozen=True)
class Described:
    """A parameter of a function with its documentation."""

    parameter: inspect.Parameter
    words: str  # its type and default
    help: str

    @property
    def section(self) -> str:
        text = textwrap.fill(
            self.help, _WIDTH, initial_indent="    ", subsequent_indent="    ",
            break_on_hyphens=False,
        )  # fmt: skip
        return f"{self.parameter.name} : {self.words}\n{text}"


@dataclass(frozen=True)
class Function:
    """The declaration of a function of the library."""

    name: str
    about: str  # a sentence, or paragraphs
    positional: tuple[Argument, ...]
    keywords: tuple[Argument, ...]
    sets: tuple[type[ParameterSet], ...]
    run: Run
    result: type | None = None  # class of the value that it returns
    gives: Kind | None = None  # kind of this value, if `result` is None
    has_method: bool = False  # whether it takes the parameters of a ground filter
    # Other names of parameters with several values, which take one value.
    flags: Mapping[str, str] = field(default_factory=dict)
    without: tuple[str, ...] = ()  # parameters of the sets that have no effect in it
    looks_around: bool = True  # as of the tool
    classifies: bool = False  # as of the tool
    result_of_many: type | None = None  # class of the value of many files, if it is another

    @property
    def parameters(self) -> list[Described]:
        first = [argument for argument in self.keywords if argument.name not in _LAST]
        last = [argument for argument in self.keywords if argument.name in _LAST]
        parameters = [_of_argument(argument, is_keyword=False) for argument in self.positional]
        parameters += map(_of_argument, first)
        if self.has_method:
            parameters += [_of_declaration(TileMethod.declarations()[0]), *_of_methods()]
        for declared in (parameter for group in self.sets for parameter in group.declarations()):
            if declared.name in self.without:
                continue
            parameters.append(_of_declaration(declared))
            if declared.name in self.flags:
                parameters.append(_of_flag(declared, self.flags[declared.name]))
        return [*parameters, *map(_of_argument, last)]

    @property
    def documentation(self) -> str:
        sections = "\n".join(described.section for described in self.parameters)
        about = "\n\n".join(
            textwrap.fill(paragraph, _WIDTH, break_on_hyphens=False)
            for paragraph in self.about.split("\n")
        )
        returns = ""
        if self.gives is not None:
            returns = f"\n\nReturns\n-------\n{self.gives.type}\n    {self.gives.words}"
        if self.result is not None:
            first = (self.result.__doc__ or "").partition("\n")[0]
            many = f"; of many files a `{self._many}`." if self._many else "."
            text = f"{first.rstrip('.')}{many}"
            returns = f"\n\nReturns\n-------\n{self.result.__name__}\n    {text}"
        return f"{about}\n\nParameters\n----------\n{sections}{returns}\n{_RAISES}"

    @property
    def returns(self) -> str:
        """The annotation of the value that it returns."""
        if self.gives is not None:
            return self.gives.type
        name = "None" if self.result is None else self.result.__name__
        return f"{name} | Any" if self._many else name

    @property
    def _many(self) -> str:
        """The name of the class that it returns if there are many files, if that is another."""
        if self.result_of_many is not None:
            return self.result_of_many.__name__
        writes_points = self.result is not None and issubclass(self.result, TileSummary)
        return "SurveySummary" if writes_points else ""

    @property
    def signature(self) -> inspect.Signature:
        """The signature, whose annotations are texts."""
        parameters = [described.parameter for described in self.parameters]
        return inspect.Signature(parameters, return_annotation=self.returns)

    def sets_of(self, values: Mapping[str, object], named: Collection[str]) -> list[ParameterSet]:
        """Return the sets of parameters from all values, and the names that the user gave."""
        sets: list[ParameterSet] = []
        if self.has_method:
            (method,) = TileMethod.declarations()[:1]
            chosen = METHODS[method.check(values["method"])].parameters
            names = {declared.name for declared in chosen.declarations()}
            for name in _declared_by_method():
                if name in named and name not in names:
                    raise TypeError(
                        f"{self.name}(): {name} is no parameter of method={values['method']!r}."
                        f"{_suggestion(name, names)}"
                    )
            sets.append(chosen(**{key: values[key] for key in names if values[key] is not None}))
        for declared in self.sets:
            given = {
                parameter.name: values[parameter.name]
                for parameter in declared.declarations()
                if parameter.name not in self.without
            }
            for name, flag in self.flags.items():
                if name in given and values[flag] is not None:
                    given[name] = values[flag]
            sets.append(declared(**given))
        return sets

    def work(self, values: SimpleNamespace, sets: Sequence[ParameterSet]) -> Any:
        """Download points that are given by address, and run."""
        arguments = *self.positional, *self.keywords
        with with_downloaded_points(arguments, values, sets, self.looks_around, self.classifies):
            return self.run(values, sets)

    def callable(self, module: str = PACKAGE) -> Callable[..., Any]:
        """Return the function, as one of a module."""
        signature, name = self.signature, self.name

        def function(*positional: object, **named: object) -> object:
            for keyword in named:
                if keyword not in signature.parameters:
                    nearest = _suggestion(keyword, signature.parameters)
                    raise TypeError(f"{name}() has no parameter {keyword}.{nearest}")
            try:
                bound = signature.bind(*positional, **named)
            except TypeError as error:
                raise TypeError(f"{name}(): {error}.") from None
            bound.apply_defaults()
            values = bound.arguments
            for argument in (*self.positional, *self.keywords):
                if argument.kind in _CONVERTERS:
                    values[argument.name] = _CONVERTERS[argument.kind](values[argument.name])
            given = SimpleNamespace(**values, named={*named})
            return self.work(given, self.sets_of(values, named))

        function.__name__ = function.__qualname__ = name
        function.__module__ = module
        function.__doc__ = self.documentation
        function.__signature__ = signature  # type: ignore[attr-defined]
        return function


def _suggestion(name: str, names: Iterable[str]) -> str:
    import difflib

    nearest = difflib.get_close_matches(name, names)
    return f" Did you mean {' or '.join(nearest)}?" if nearest else ""


def _of_argument(argument: Argument, is_keyword: bool = True) -> Described:
    kind, default = argument.kind, argument.default
    annotation, words = kind.type, kind.words
    if default is None:
        annotation, words = f"{annotation} | None", f"{words}, optional"
    elif default is not REQUIRED:
        words = f'{words}, default "{default}"'
    kinds = inspect.Parameter
    place = kinds.KEYWORD_ONLY if is_keyword else kinds.POSITIONAL_OR_KEYWORD
    parameter = kinds(argument.name, place, default=default, annotation=annotation)
    return Described(parameter, words, argument.help.replace("Empty:", "None:"))


def _of_declaration(declared: Declaration) -> Described:
    kind, default, help = _kind_of(declared), declared.default, declared.help
    unit = f" {declared.unit}" if declared.unit else ""
    words = f"{kind.words}, optional"
    if default is not None:
        text = f'"{default}"' if isinstance(default, str) else repr(default)
        words = f"{kind.words}, default {text}{unit}"
    if declared.minimum is not None and declared.maximum is not None:
        help = f"{help} From {declared.minimum:g} to {declared.maximum:g}{unit}."
    choices = " ".join(f'"{name}": {label}.' for name, label in declared.choices.items())
    if declared.optional and "Empty:" not in help:
        help = f"{help} None: {declared.empty}."
    text = f"{help.replace('Empty:', 'None:')} {choices}".rstrip()
    keyword = inspect.Parameter.KEYWORD_ONLY
    parameter = inspect.Parameter(declared.name, keyword, default=default, annotation=kind.type)
    return Described(parameter, words, text)


def _of_flag(declared: Declaration, flag: str) -> Described:
    """Return another name of a parameter with several values, which takes one value."""
    kind = re.sub(r"^Sequence\[(.*)\]$", r"\1", _kind_of(declared).type)
    annotation = kind if kind.endswith("None") else f"{kind} | None"
    keyword = inspect.Parameter.KEYWORD_ONLY
    parameter = inspect.Parameter(flag, keyword, default=None, annotation=annotation)
    return Described(parameter, "optional", f"The same as `{declared.name}`, of one value.")


def _kind_of(declared: Declaration) -> Kind:
    choices = ", ".join(map(repr, declared.choices)).replace("'", '"')
    word = f' | Literal["{declared.word}"]' if declared.word else ""
    kind = {
        "choice": Kind(f"Literal[{choices}]", f"{{{choices}}}"),
        "choices": Kind(f"Sequence[Literal[{choices}]]", f"sequence of {{{choices}}}"),
        "numbers": Kind(f"Sequence[float]{word}", "sequence of float"),
        "integers": Kind(f"Sequence[int]{word}", "sequence of int"),
    }.get(declared.kind) or Kind(*[_TYPES[declared.kind]] * 2)
    if declared.word:
        kind = kind._replace(words=f'{kind.words} or "{declared.word}"')
    return kind._replace(type=f"{kind.type} | None") if declared.optional else kind


def _declared_by_method() -> dict[str, dict[str, Declaration]]:
    """Return the declarations of all parameters of ground filters, by name and method."""
    declarations: dict[str, dict[str, Declaration]] = {}
    for method in METHODS.values():
        for declared in method.parameters.declarations():
            declarations.setdefault(declared.name, {})[method.name] = declared
    return declarations


def _of_methods() -> list[Described]:
    """Return the parameters of all ground filters, those with one name as one parameter."""
    parameters_of_methods = []
    for by_method in _declared_by_method().values():
        described = {method: _of_declaration(declared) for method, declared in by_method.items()}
        parameters = [only.parameter for only in described.values()]
        types = dict.fromkeys(
            part for parameter in parameters for part in parameter.annotation.split(" | ")
        )  # "None" stands last
        types = {**{kind: None for kind in types if kind != "None"}, "None": None}
        if len(described) == 1:
            ((method, only),) = described.items()
            words, help = only.words, f"Only of method={method!r}. {only.help}"
        else:
            words = "by method"
            help = " ".join(
                f"With method={method!r}: {declared.words}. {declared.help}"
                for method, declared in described.items()
            )
        parameter = parameters[0].replace(default=None, annotation=" | ".join(types))
        parameters_of_methods.append(Described(parameter, words, help))
    return parameters_of_methods
