"""A run: steps that work on the points of a file, or of many files as one survey."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..core.progress import SILENT, Progress
from ..survey.files import Inputs
from .memory import Resources
from .one_file import work_on_file
from .options import TileOutput
from .step import Step
from .survey_run import work_on_survey
from .workers import Threads, Workers


@dataclass(frozen=True)
class Run:
    """Steps, each of which sees the points with what those before it have found."""

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
    ) -> Any:
        """Let the steps work, and write the points into a file, those of a survey into a folder;
        return the summary.
        """
        # `target`, and the virtual point cloud of a survey, are None if no step finds a value for
        # each point. The workers are by default threads of this process.
        if not inputs.is_survey:
            return work_on_file(self.steps, inputs, target, self.resources, progress)
        workers = workers or Threads(self.resources)
        return work_on_survey(self.steps, inputs, target, self.output, progress, workers, vpc)
