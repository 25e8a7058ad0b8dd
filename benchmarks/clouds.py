"""Classifies a cloud in memory, whose points need no file."""

from __future__ import annotations

import numpy as np

from bare_earth.algorithms.classes.corrections import NO_CORRECTIONS, Corrections
from bare_earth.algorithms.classes.selection import Selection
from bare_earth.algorithms.core.parameters import ParameterSet
from bare_earth.algorithms.core.progress import SILENT, Progress
from bare_earth.algorithms.core.threads import may_use
from bare_earth.algorithms.engine.file_run import OneFile
from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.las.cloud import PointCloud
from bare_earth.algorithms.survey.area import Area
from bare_earth.algorithms.tools.ground.step import LabelGround


def classify_cloud(
    cloud: PointCloud,
    parameters: ParameterSet,
    selection: Selection = Selection(),
    progress: Progress = SILENT,
    area: Area | None = None,
    resources: Resources = Resources(),
    corrections: Corrections = NO_CORRECTIONS,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the new class of every point, uint8 (n,), and which points in the area took part."""
    step = LabelGround(parameters, selection, area, corrections=corrections)
    run = OneFile.on_cloud([step], cloud, resources, progress.part(0.0, 0.97))
    with may_use(resources.thread_count):
        result = run.result(progress.part(0.97, 1.0))
        inside, selected, _ = run.steps[0].chooser.choose(cloud, step.counts())
    return result.classification, selected & inside
