"""The points of a window, which are read once and labelled with several settings."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import NamedTuple, Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.points import Box, Points, box_in_words
from ..core.progress import SILENT, Progress
from ..core.threads import in_threads
from ..crs.measurable import require_measurable
from ..crs.system import Crs
from ..engine.memory import Resources
from ..engine.memory_store import MemoryStore
from ..las.cloud import PointCloud, survey_frame
from ..las.crs_records import read_crs
from ..las.lasfile import LasFile
from ..las.opening import open_las
from ..report.units import Units
from ..steps.labelling import LabelGround
from ..survey.area import Area
from ..survey.files import is_one_file, open_survey
from ..survey.middle import middle_window, nearest_window
from ..survey.window import may_touch, read_window
from .options import Setting
from .window import Line, Outcome, Window, outcome_of

# Metres. A wider window would take long.
_WIDEST = 1000.0


class Labelled(NamedTuple):
    """The points as classified with a setting."""

    names: tuple[str, str]  # name and label of the setting
    classes: np.ndarray  # uint8, (n,)
    ground: np.ndarray  # bool, (n,)
    selected: np.ndarray  # bool, (n,): which points took part


@dataclass(frozen=True)
class TrialPoints:
    """The points in and round a window."""

    clouds: tuple[PointCloud, ...]  # the points of each file that has any
    crs: Crs
    box: Box  # the window, in units of the CRS

    @property
    def count(self) -> int:
        """Number of points."""
        return sum(cloud.count for cloud in self.clouds)

    @cached_property
    def window(self) -> Window:
        """The points in the form that a comparison needs."""
        frame = survey_frame(self.crs)
        west, south, east, north = (each * frame.horizontal_unit for each in self.box)
        frame, width, height = frame.moved((west, south)), east - west, north - south
        parts = [cloud.points(slice(None), frame) for cloud in self.clouds]
        points = Points(*map(np.concatenate, zip(*parts)))
        inside = np.concatenate([Area(self.box).of(cloud) for cloud in self.clouds])
        units = Units(frame.horizontal_unit, frame.vertical_unit)
        return Window(points, inside, width, height, units)

    @property
    def withheld(self) -> np.ndarray:
        """Which points are withheld; boolean, shape (n,)."""
        return np.concatenate([cloud.withheld for cloud in self.clouds])

    def line(self, ends: Sequence[float]) -> Line:
        """Return the line between two points, given as x1, y1, x2, y2 in units of the CRS."""
        corner, unit = self.box[:2] * 2, self.crs.horizontal_unit
        x1, y1, x2, y2 = ((each - start) * unit for each, start in zip(ends, corner))
        return Line((x1, y1), (x2, y2))

    def labelled(
        self, setting: Setting, resources: Resources, progress: Progress, is_first: bool = True
    ) -> Labelled:
        """Classify the points with a setting, and warn if there is no ground; messages that all
        settings have in common are only reported for the first.
        """
        step = LabelGround(setting.parameters)
        counts = step.counts()
        marks = [step.marks(cloud, counts) for cloud in self.clouds]
        step.tell(counts, self.clouds[0].path, progress if is_first else progress.quiet())
        progress.info(f"{setting.label}:")
        frame = survey_frame(self.crs)
        store = MemoryStore(frame, step.blocks, step.kind)
        for cloud, its_marks in zip(self.clouds, marks):
            store.append(cloud, its_marks)
        store.finish(progress.part(0.0, 0.1))
        try:
            step.work(store, resources, progress.part(0.1, 1.0))
        except BareEarthError as error:
            progress.warning(f"{setting.label}: {error}")
        found = [step.applied(cloud, store.values(n)) for n, cloud in enumerate(self.clouds)]
        classes = np.concatenate([cloud.classification for cloud in found])
        ground = classes == step.selection.to_class
        selected = np.concatenate([its_marks.selected for its_marks in marks])
        return Labelled((setting.name, setting.label), classes, ground, selected)

    def outcomes(self, labelled: Sequence[Labelled]) -> list[Outcome]:
        """Return the results of settings, several of which run at the same time."""
        window = self.window
        return in_threads(lambda each: outcome_of(window, *each), labelled)


def read_trial_points(
    paths: Sequence[Path],
    box: Box | None,
    context: float,
    progress: Progress = SILENT,
    stated: str | None = None,
) -> TrialPoints:
    """Read the points in a window, in units of the CRS, or in the middle of the survey, which a
    message tells, and in `context` metres round it.
    """
    # An error says if the window is invalid, too wide or empty.
    area, reading = None if box is None else Area(tuple(map(float, box))), progress
    if is_one_file(paths):
        las = open_las(paths[0], stated)
        files, crs = [las], read_crs(las)
        extent = las.box
    else:
        survey = open_survey(paths, progress=progress.part(0.0, 0.1), stated=stated)
        crs, extent = survey.crs, survey.box
        files, reading = survey.tiles, progress.quiet()  # the messages were given
    require_measurable("The survey", crs, extent)
    wanted, unit = area, crs.horizontal_unit
    area = area or Area(middle_window(files, unit))
    _check_width(area, crs)
    clouds = _read(files, area, context / unit, reading.part(0.1, 1.0 if wanted else 0.8))
    is_empty = not any(area.of(cloud).any() for cloud in clouds)
    where = "in the middle of the points"
    if is_empty and wanted is None:
        where = "round the point that is nearest to the middle"
        area = Area(nearest_window(files, unit, progress.part(0.8, 0.9)))
        clouds = _read(files, area, context / unit, progress.quiet().part(0.9, 1.0))
        is_empty = not any(area.of(cloud).any() for cloud in clouds)
    if wanted is None:
        progress.choice(f"window {where}, {box_in_words(area.box)}")
    if is_empty:
        raise BareEarthError(
            f"No point lies in the window ({box_in_words(area.box)}): the points lie in"
            f" {box_in_words(extent)}. Give the window in the CRS of the points."
        )
    return TrialPoints(clouds, crs, area.box)


def _check_width(area: Area, crs: Crs) -> None:
    west, south, east, north = area.box
    widest = max(east - west, north - south) * crs.horizontal_unit
    if widest > _WIDEST:
        raise BareEarthError(
            f"The window is {widest:,.0f} m wide. Choose one of at most {_WIDEST:,.0f} m, such as"
            " 250 x 250 m: in QGIS, zoom in."
        )


def _read(
    files: Sequence[LasFile], area: Area, context: float, progress: Progress
) -> tuple[PointCloud, ...]:
    """Return the points in the area and round it, up to a distance in units of the CRS."""
    box = area.buffered_box(context)
    if len(files) > 1:  # a survey, whose headers are right
        files = [file for file in files if may_touch(file, box)]
    parts = progress.shares(*[1.0] * len(files))
    clouds = [read_window(las, box, part) for las, part in zip(files, parts)]
    return tuple(cloud for cloud in clouds if cloud.count)
