"""A run: steps that work on the points of a file, or of many files as one survey."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..core.files import Outputs
from ..core.progress import SILENT, Progress
from ..las.opening import NoPoints
from ..survey.files import Inputs
from .file_run import OneFile
from .memory import Resources
from .options import TileOutput
from .step import Step

if TYPE_CHECKING:
    from .workers import Workers


@dataclass(frozen=True)
class Run:
    """Steps; each sees the points with the results of the steps before it."""

    steps: tuple[Step, ...]
    output: TileOutput = field(default_factory=TileOutput)  # of many files
    resources: Resources = field(default_factory=Resources)

    def work(
        self,
        inputs: Inputs,
        target: Path | None = None,
        progress: Progress = SILENT,
        workers: Workers | None = None,
        vpc: Path | None = None,
        outputs: Outputs | None = None,
    ) -> Any:
        """Let the steps work, write the points into a file or, for a survey, into a folder, and
        return the summary.
        """
        # `target`, and the virtual point cloud of a survey, are None if no step computes a value
        # for each point. The workers are by default threads of this process. All but the files of a
        # survey get their names when `outputs` ends, or else at the end of the run.
        kind: Any = OneFile
        if inputs.is_survey:
            from .survey_run import ManyFiles

            kind = ManyFiles
        execution = kind(
            self.steps, self.resources, progress, target, vpc, outputs, self.output, workers
        )
        with execution.opened:
            try:
                execution.open(inputs)
            except NoPoints as empty:
                if target is None:
                    raise
                return execution.copy_empty(empty.layouts, target)
            execution.work()
            if target is None:
                return execution.step_summaries[-1]
            return execution.write(target)
