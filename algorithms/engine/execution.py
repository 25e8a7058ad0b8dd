"""How a run works on its inputs: on one file in memory, or on many in jobs."""

from __future__ import annotations

from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Sequence

from ..core.files import Outputs
from ..core.progress import Progress
from .memory import Resources
from .options import TileOutput
from .step import Step

if TYPE_CHECKING:
    from .workers import Workers


@dataclass(eq=False)
class Execution:
    """Base of the two ways in which a run opens its inputs, works and writes, with the parameters
    of the run.
    """

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
