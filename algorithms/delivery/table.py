"""Tables of tools that work one after another, each with what those before it found."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any, Callable, Iterable, Mapping, NamedTuple, TypeVar

from ..core.parameters import ParameterSet
from ..core.progress import Progress
from ..engine.memory import Resources
from ..engine.options import TileInput, TileOutput
from ..engine.workers import Workers
from ..filters import DEFAULT_METHOD, METHODS
from ..survey.files import Inputs
from ..survey.ground_classes import GroundClasses
from ..survey.selection import Selection
from ..tools import any_tool
from ..tools.declaration import FileTool, MapTool, Tool
from ..tools.ground.method import TileMethod
from ..tools.running import run

_Set = TypeVar("_Set", bound=ParameterSet)
_METHODS = tuple(method.parameters for method in METHODS.values())


class Row(NamedTuple):
    """A tool in a table: what it gets, and what it writes."""

    title: str  # of the time that it takes
    tool: str  # its command
    weight: float  # its share of the progress bar
    needs: tuple[str, ...] = ()  # it is left out unless all of these are known, and not empty
    inputs: Mapping[str, str] = {}  # what is known, by the names of the tool's inputs
    outputs: Mapping[str, str] = {}  # names for `Job.place`, by the names of the tool's outputs
    tells: str = ""  # the field of the summary for what the tool returns
    work: Callable[..., Any] = lambda job, row, progress: job.run(row, progress)


class Job:
    """Rows while they work: what the user gave, and what is known by now; a base class."""

    def __init__(
        self,
        sources: Inputs,
        sets: Iterable[ParameterSet],
        values: Mapping[str, Any],
        known: Mapping[str, Any],
        summary: Any,
        workers: Workers | None = None,
    ) -> None:
        self.sources = sources  # the points that the next row reads
        self.values = dict(values)  # of parameters that the user left at their defaults, by name
        # By name: inputs of the user, what is wanted, and what rows have written and found.
        self.known = dict(known)
        self.summary, self.workers = summary, workers  # is filled by the rows; for many files
        named = (one.parameters if isinstance(one, TileMethod) else one for one in sets)
        self.sets: list[ParameterSet] = [*named, METHODS[DEFAULT_METHOD].parameters()]
        self.sets.append(GroundClasses.of_selection(self.set_of(Selection)))
        self.seconds: dict[str, float] = {}  # that rows took, by their titles

    def place(self, kind: str, name: str) -> Path | None:
        """Return where an output of a kind is written; None if it is not wanted."""
        raise NotImplementedError

    def opened(self, progress: Progress) -> tuple[Inputs, Progress]:
        """Return the points for a row that only reads them, and what is left of its progress."""
        return self.sources, progress

    def work(self, rows: Iterable[Row], progress: Progress) -> None:
        """Let the tools work one after another."""
        # What is not known yet may become known.
        left = [row for row in rows if all(self.known.get(name, True) for name in row.needs)]
        for row, part in zip(left, progress.shares(*(row.weight for row in left))):
            if all(self.known.get(name) for name in row.needs):
                begun = time.perf_counter()
                done = row.work(self, row, part)
                if row.tells:
                    setattr(self.summary, row.tells, done)
                took = self.seconds.get(row.title, 0.0) + time.perf_counter() - begun
                self.seconds[row.title] = round(took, 2)

    def run(self, row: Row, progress: Progress, **outputs: Path) -> Any:
        """Let the tool of a row work, with further outputs that are given here."""
        tool, paths = any_tool(row.tool), dict(outputs)
        inputs = {name: self.known.get(value) for name, value in row.inputs.items()}
        for output in tool.all_outputs:
            if output.name in row.outputs and inputs.get(output.needs, True) is not None:
                path = self.place(output.kind, row.outputs[output.name])
                paths.update({output.name: path} if path else {})
        for declared in tool.inputs:
            if declared.name in inputs:
                inputs[declared.name] = declared.of(inputs[declared.name])
        for declared in tool.all_inputs:
            if declared.kind == "crs":
                inputs[declared.name] = self.known["crs"]
            elif declared.kind == "clouds" and "output" in outputs:
                inputs[declared.name] = self.sources
            elif declared.kind == "clouds":
                inputs[declared.name], progress = self.opened(progress)
        return run(tool, inputs, paths, self.sets_of(tool), progress, self.workers)

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
