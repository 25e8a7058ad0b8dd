"""Reads the profiles of all places in another thread."""

from __future__ import annotations

from pathlib import Path
from typing import Sequence

import numpy as np
from qgis.core import QgsTask
from qgis.PyQt.QtCore import pyqtSignal

from ...algorithms.core.errors import BareEarthError, Cancelled
from ...algorithms.core.progress import Progress
from ...algorithms.rasters.sampling import HeightRaster, HeightSampler
from ...algorithms.survey.files import Inputs
from ...algorithms.tools.review.lift import lifts_of
from ...algorithms.tools.review.profile import ProfilePoints, points_along
from ..i18n import tr
from ..processing.runs import Sources
from .session import Line, ReviewPlace

# The terrain along a line is sampled at this number of places.
SAMPLES = 300


class PointsTask(QgsTask):
    """Reads the points along the lines of places, and then how far places would rise as ground."""

    along = pyqtSignal()  # the profiles are read

    def __init__(self, sources: Sources, places: Sequence[ReviewPlace]) -> None:
        super().__init__(tr("Bare Earth: points of the places to review"), QgsTask.Flag.CanCancel)
        self._sources, self._places = sources, list(places)
        # By the id of the feature.
        self.points: dict[int, ProfilePoints] = {}
        self.lifts: dict[int, float] = {}  # metres; NaN for none
        self.error = ""

    def run(self) -> bool:
        """Read the points; QGIS calls this in the other thread."""
        try:
            self._read(_TaskProgress(self))
        except Cancelled:
            return False
        except BareEarthError as error:
            self.error = str(error)
        except Exception as error:  # nobody would see an exception in this thread
            self.error = f"{type(error).__name__}: {error}"
        return not self.error

    def _read(self, progress: Progress) -> None:
        inputs = Inputs([Path(self._sources.cloud)])
        lines = np.array([place.line for place in self._places])
        points = points_along(inputs, lines, progress=progress.part(0.0, 0.5))
        self.points = {place.feature: found for place, found in zip(self._places, points)}
        self.along.emit()
        if self._sources.dtm:
            parts = [(place.feature, part) for place in self._places for part in place.polygons]
            polygons, rest = [part for _, part in parts], progress.part(0.5, 1.0)
            for (name, _), lift in zip(parts, lifts_of(inputs, polygons, self._sources.dtm, rest)):
                self.lifts[name] = float(np.fmax(lift, self.lifts.get(name, np.nan)))


class _TaskProgress(Progress):
    """Shows the progress of a task, and stops it after a cancel."""

    def __init__(self, task: QgsTask) -> None:
        self._task = task

    def report(self, fraction: float) -> None:
        """Report how much is done."""
        if self._task.isCanceled():
            raise Cancelled
        self._task.setProgress(100.0 * fraction)


def sampler_of(path: str) -> HeightSampler | None:
    """Return what reads a raster without keeping its file open; None if it can't be read."""
    if not path:
        return None
    try:
        return HeightSampler(HeightRaster.of(path))
    except BareEarthError:
        return None  # a profile shows what there is


def values_along(sampler: HeightSampler | None, line: Line) -> np.ndarray:
    """Return the values of a raster along a line, float64 with NaN in voids."""
    share, (x1, y1, x2, y2) = np.linspace(0.0, 1.0, SAMPLES), line
    if sampler is None:
        return np.full(SAMPLES, np.nan)
    return sampler.heights(x1 + share * (x2 - x1), y1 + share * (y2 - y1))
