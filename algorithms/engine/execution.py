"""How a run works on its inputs: on one file in memory, or on many in jobs."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import Any, Sequence

from ..core.files import Outputs
from ..core.progress import Progress
from ..las.lasfile import LasFile
from ..survey.files import Inputs
from .memory import Resources
from .options import TileOutput


@dataclass(eq=False)
class Execution:
    """Base of the ways in which a run works on its inputs; the parameters are those of a run."""

    steps: Sequence[Any]
    resources: Resources
    progress: Progress
    target: Any = None  # the file or folder for the points; None if no step finds a value for each
    vpc: Any = None
    outputs: Outputs | None = None
    output: TileOutput = field(default_factory=TileOutput)
    workers: Any = None
    opened: ExitStack = field(default_factory=ExitStack)  # what the end of the run closes

    def open(self, inputs: Inputs) -> None:
        """Open the inputs, and refuse now what would fail at the end."""
        raise NotImplementedError

    def without_points(self, layouts: Sequence[LasFile]) -> Any:
        """Write inputs, none of which holds a point, as they are; return the summary."""
        raise NotImplementedError

    def work(self) -> None:
        """Let the steps work, each on what those before it found."""
        raise NotImplementedError

    def finish(self) -> Any:
        """Write what is left to write; return the summary."""
        raise NotImplementedError
