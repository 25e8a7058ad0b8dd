"""Tables of tools that work one after another, and the parameters with which they work."""

from __future__ import annotations

from typing import Any, Callable, Iterable, Mapping, NamedTuple, TypeVar

from ..core.parameters import ParameterSet
from ..engine.memory import Resources
from ..engine.options import TileInput, TileOutput
from ..filters import DEFAULT_METHOD, METHODS
from ..survey.ground_classes import GroundClasses
from ..survey.selection import Selection
from ..tools.declaration import FileTool, MapTool, Tool
from ..tools.ground.method import TileMethod

_Set = TypeVar("_Set", bound=ParameterSet)
_METHODS = tuple(method.parameters for method in METHODS.values())


class Row(NamedTuple):
    """A tool in a table: what it gets, and what it writes."""

    title: str  # of the time that it takes
    tool: str  # its command
    weight: float  # its share of the progress bar
    needs: tuple[str, ...] = ()  # it is left out unless all of these are known, and not empty
    inputs: Mapping[str, str] = {}  # what is known, by the names of the tool's inputs
    outputs: Mapping[str, str] = {}  # names of files, by the names of the tool's outputs
    tells: str = ""  # the field of the summary for what the tool returns
    work: Callable[..., Any] = lambda job, row, progress: job.run(row, progress)


class Settings:
    """The parameters of a delivery: what the user gave, and values of the table for the rest."""

    def __init__(self, sets: Iterable[ParameterSet], values: Mapping[str, Any]) -> None:
        self.values = dict(values)  # of parameters that the user left at their defaults, by name
        named = (one.parameters if isinstance(one, TileMethod) else one for one in sets)
        self.sets: list[ParameterSet] = [*named, METHODS[DEFAULT_METHOD].parameters()]
        self.sets.append(GroundClasses.of_selection(self.set_of(Selection)))

    def sets_of(self, tool: Tool) -> list[ParameterSet]:
        """Return the parameters of a tool."""
        kinds = tool.sets
        if isinstance(tool, MapTool) and tool.classifies:
            kinds = type(self.method), *kinds
        if not isinstance(tool, (FileTool, MapTool)):
            kinds = *kinds, TileInput, TileOutput, Resources
        return [self.set_of(kind) for kind in kinds]

    def set_of(self, kind: type[_Set]) -> _Set:
        """Return parameters with the values of the table where the user left the defaults."""
        values: dict[str, Any] = {}
        given = next((known for known in self.sets if isinstance(known, kind)), kind())
        for declared in given.declarations():
            value, name = getattr(given, declared.name), declared.name
            if value == declared.default:
                value = self.values.get(name, value)
                if declared.choices and value not in declared.choices:
                    value = declared.default
            # What was left open, and only in the table, has the default of the tool.
            if value is not None or declared.default is not None:
                values[name] = value
        return kind(**values)

    @property
    def method(self) -> ParameterSet:
        """The parameters of the ground filter, without values of the table."""
        return next(values for values in self.sets if isinstance(values, _METHODS))
