"""How a run works on its inputs: on one file in memory, or on many in jobs."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Sequence

from ..core.files import Outputs
from ..core.progress import Progress
from ..las.lasfile import LasFile
from ..survey.files import Inputs
from .memory import Resources
from .options import TileOutput
from .step import Step
from .summary import RunSummary

if TYPE_CHECKING:
    from .workers import Workers


@dataclass(eq=False)
class Execution:
    """Base of the two ways in which a run works on its inputs, with the parameters of the run."""

    steps: Sequence[Step]
    resources: Resources
    progress: Progress
    target: Path | None = None  # the file or folder for the points; None if none are written
    vpc: Any = None  # the path of the virtual point cloud of many files, if points are written
    outputs: Outputs | None = None
    output: TileOutput = field(default_factory=TileOutput)
    workers: Workers | None = None
    opened: ExitStack = field(default_factory=ExitStack)  # is closed when the run ends
    # What `Step.finish` returned for the steps that write files.
    step_summaries: list[Any] = field(default_factory=list)

    def open(self, inputs: Inputs) -> None:
        """Open the inputs, and refuse now what would fail at the end."""
        raise NotImplementedError

    def copy_empty(self, layouts: Sequence[LasFile], target: Path) -> RunSummary:
        """Write inputs that hold no points unchanged; return the summary."""
        raise NotImplementedError

    def work(self) -> None:
        """Let the steps work one after another; each uses the results of those before it."""
        raise NotImplementedError

    def write(self, target: Path) -> RunSummary:
        """Write the points that `work` has not written yet; return the summary."""
        raise NotImplementedError
