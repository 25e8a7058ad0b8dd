"""The points in a window of a survey, which are read once, and their classes by each setting."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple, Sequence

import numpy as np

from ...core.errors import BareEarthError
from ...core.points import Box, Points, box_in_words, box_round
from ...core.progress import Progress
from ...crs.measurable import require_measurable
from ...crs.system import Crs
from ...engine.block_grid import BlockGrid
from ...engine.memory import Resources
from ...engine.visits import values_of
from ...grids.expected_error import expected_error, expected_rmse
from ...las.cloud import PointCloud, survey_frame
from ...las.lasfile import LasFile
from ...las.reading import read_chunks
from ...report.units import Units
from ...survey.area import Area
from ...survey.files import Inputs, open_survey
from ...survey.window import may_touch, read_window
from ...tin.dense_surface import VERTICES_A_SIDE, DenseSurface
from ...tools.ground.step import LabelGround
from .settings import Setting

_WIDEST = 1000.0  # metres: a wider window would take long
_SIDE = 250.0  # metres: of the square that is shown if no window is given
# Greatest number of cells along the longer side of the terrain, and the sides in metres that cells
# can have below one metre. Larger cells have whole metres.
_MOST_CELLS = 300
_CELL_SIZES = (0.25, 0.5)
# Distance in metres up to which points around the window are used for the expected error.
_NEAR = 20.0


class Outcome(NamedTuple):
    """The result of a setting."""

    setting: Setting
    ground: np.ndarray  # bool, (n,)
    terrain: np.ndarray  # float64, (rows, columns): metres, from north to south; NaN for none
    expected_rmse: float  # of the terrain in the window, in metres; NaN without ground


@dataclass(frozen=True)
class Window:
    """The points in and round a window."""

    clouds: tuple[PointCloud, ...]  # the points of each file that has any
    crs: Crs
    box: Box  # the window, in units of the CRS

    @property
    def count(self) -> int:
        """Number of points."""
        return sum(cloud.count for cloud in self.clouds)

    @property
    def units(self) -> Units:
        """The units of the survey."""
        return Units(self.crs.horizontal_unit, self.crs.vertical_unit)

    @cached_property
    def sides(self) -> tuple[float, float]:
        """Width and height in metres."""
        west, south, east, north = (side * self.crs.horizontal_unit for side in self.box)
        return east - west, north - south

    @cached_property
    def points(self) -> Points:
        """The points in metres from the lower left corner of the window."""
        corner = (self.box[0] * self.crs.horizontal_unit, self.box[1] * self.crs.horizontal_unit)
        frame = survey_frame(self.crs).moved(corner)
        parts = [cloud.points(slice(None), frame) for cloud in self.clouds]
        return Points(*map(np.concatenate, zip(*parts)))

    @cached_property
    def inside(self) -> np.ndarray:
        """Which points lie in the window; bool, (n,)."""
        return np.concatenate([Area(self.box).of(cloud) for cloud in self.clouds])

    @property
    def cell_size(self) -> float:
        """Side of a cell of the terrain in metres."""
        least = max(self.sides) / _MOST_CELLS
        return next((size for size in _CELL_SIZES if size >= least), float(math.ceil(least)))

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns of the terrain."""
        width, height = self.sides
        return math.ceil(height / self.cell_size), math.ceil(width / self.cell_size)

    def outcome(
        self, setting: Setting, resources: Resources, progress: Progress, is_first: bool
    ) -> Outcome:
        """Classify the points with a setting, and warn if there is no ground; messages that do not
        depend on the setting are reported for the first one only.
        """
        step = LabelGround(setting.parameters)
        counts, reporting = step.counts(), progress if is_first else progress.quiet()
        selected = np.concatenate([step.marks(cloud, counts).selected for cloud in self.clouds])
        step.report_counts(counts, self.clouds[0].path, reporting)
        progress.info(f"{setting.label}:")
        grid = BlockGrid(survey_frame(self.crs), step)
        work = values_of(grid, self.clouds, resources, progress)
        if work.failure:
            progress.warning(f"{setting.label}: {work.failure}")
        classified = [
            step.applied(cloud, work.values(part)) for part, cloud in enumerate(self.clouds)
        ]
        classes = np.concatenate([cloud.classification for cloud in classified])
        ground = classes == step.selection.to_class
        rmse = self._expected_rmse(ground, selected)
        return Outcome(setting, ground, self._terrain(ground), rmse)

    def _terrain(self, ground: np.ndarray) -> np.ndarray:
        """Return the heights of the terrain, from north to south."""
        if not ground.any():
            return np.full(self.shape, np.nan)
        # One vertex a cell is enough for a picture, and faster than the four of a terrain model.
        surface = DenseSurface(self.points.take(ground), VERTICES_A_SIDE * self.cell_size)
        y, x = ((np.arange(count) + 0.5) * self.cell_size for count in self.shape)
        heights = surface.heights(np.tile(x, len(y)), np.repeat(y, len(x)))
        return heights.reshape(self.shape)[::-1]

    def _expected_rmse(self, ground: np.ndarray, selected: np.ndarray) -> float:
        """Return the expected RMSE of the terrain in cells of 1 m in the window."""
        if not ground.any():
            return math.nan
        (x, y, _), (width, height) = self.points, self.sides
        near = (x >= -_NEAR) & (y >= -_NEAR) & (x <= width + _NEAR) & (y <= height + _NEAR)
        near &= selected
        cells, values = expected_error(self.points.take(near), ground[near])
        rows, columns = (
            slice(max(-first, 0), max(math.ceil(side / cells.size) - first, 0))
            for first, side in zip(cells.first, (height, width))
        )
        return expected_rmse(values[rows, columns])


def read_points(inputs: Inputs, box: Box | None, context: float, progress: Progress) -> Window:
    """Read the points in a window in units of the CRS, by default in the middle of the survey, and
    up to `context` metres round it.
    """
    # An error says if the window is invalid, too wide or empty.
    area = None
    if box is not None:
        west, south, east, north = map(float, box)
        area = Area((west, south, east, north))
    survey = open_survey(inputs, progress.part(0.0, 0.1))
    files, crs, extent = survey.tiles, survey.crs, survey.box
    require_measurable("The survey", crs, extent)
    if area is not None:
        area = area.located(survey.place, progress)
    wanted, unit = area, crs.horizontal_unit
    area = area or Area(_middle_window(files, unit))
    reading = progress.quiet()  # opening the files has given their messages
    window = _read(files, crs, area, context / unit, reading.part(0.1, 1.0 if wanted else 0.8))
    where = "in the middle of the points"
    if wanted is None and not (window.count and window.inside.any()):
        where = "round the point that is nearest to the middle"
        area = Area(_nearest_window(files, unit, progress.part(0.8, 0.9)))
        window = _read(files, crs, area, context / unit, progress.quiet().part(0.9, 1.0))
    if wanted is None:
        progress.choice(f"window {where}, {box_in_words(area.bounds)}")
    if not (window.count and window.inside.any()):
        raise BareEarthError(
            f"No point lies in the window ({box_in_words(area.bounds)}): the points lie in"
            f" {box_in_words(extent)}. Give the window in the CRS of the points."
        )
    return window


def _read(
    files: Sequence[LasFile], crs: Crs, area: Area, context: float, progress: Progress
) -> Window:
    """Return the points in the area and round it, up to a distance in units of the CRS."""
    west, south, east, north = area.bounds
    widest = max(east - west, north - south) * crs.horizontal_unit
    if widest > _WIDEST:
        raise BareEarthError(
            f"The window is {widest:,.0f} m wide. Choose one of at most {_WIDEST:,.0f} m, such as"
            " 250 x 250 m: in QGIS, zoom in."
        )
    box = area.buffered_box(context)
    if len(files) > 1:  # a survey, whose headers are right
        files = [file for file in files if may_touch(file, box)]
    parts = progress.shares(*[1.0] * len(files))
    clouds = [read_window(las, box, part) for las, part in zip(files, parts)]
    return Window(tuple(cloud for cloud in clouds if cloud.count), crs, area.bounds)


def _middle_window(files: Sequence[LasFile], unit: float) -> Box:
    """Return a square window in the middle of the extent of a survey, in units of the CRS (`unit`
    metres); no points are read, so it may contain none.
    """
    # Its borders are whole numbers, except where the survey ends before.
    west, south, east, north = extent = _extent(files)
    return _square((west + east) / 2.0, (south + north) / 2.0, unit, extent)


def _nearest_window(files: Sequence[LasFile], unit: float, progress: Progress) -> Box:
    """Return a square window as `_middle_window` round the point that is nearest to the middle of a
    survey; all points of the nearest files are read.
    """
    west, south, east, north = extent = _extent(files)
    middle = (west + east) / 2.0, (south + north) / 2.0
    best, place = math.inf, middle
    ordered = sorted(files, key=lambda file: _distance(file, middle))
    for file, part in zip(ordered, progress.shares(*[1.0] * len(ordered))):
        if not file.count or _distance(file, middle) > best:
            continue
        done = 0
        for chunk in read_chunks(file):
            x, y = (
                np.asarray(chunk[name]) * file.scale[axis] + file.offset[axis]
                for axis, name in enumerate("XY")
            )
            apart = np.hypot(x - middle[0], y - middle[1])
            nearest = int(apart.argmin())
            if apart[nearest] < best:
                best, place = float(apart[nearest]), (float(x[nearest]), float(y[nearest]))
            done += len(x)
            part(done / file.count)
    return _square(*place, unit, extent)


def _square(x: float, y: float, unit: float, extent: Box) -> Box:
    """Return the window round a place, cut off where the survey ends."""
    half = float(np.rint(_SIDE / 2.0 / unit))
    x, y = float(np.rint(x)), float(np.rint(y))
    return (
        max(x - half, extent[0]), max(y - half, extent[1]),
        min(x + half, extent[2]), min(y + half, extent[3]),
    )  # fmt: skip


def _extent(files: Sequence[LasFile]) -> Box:
    """Return smallest x and y, largest x and y of files that have points."""
    boxes = np.array([file.outer_box for file in files if file.count] or [files[0].outer_box])
    return box_round(boxes)


def _distance(file: LasFile, place: tuple[float, float]) -> float:
    """Return the distance of a place from the extent of a file; 0 inside."""
    west, south, east, north = file.outer_box
    x, y = place
    return math.hypot(max(west - x, x - east, 0.0), max(south - y, y - north, 0.0))
