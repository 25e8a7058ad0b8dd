"""Two terrains of the same place on one grid, from point clouds or from rasters."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Iterator, NamedTuple

import numpy as np

from ...classes.ground_classes import GroundClasses
from ...classes.selection import Selection
from ...core.errors import BareEarthError
from ...core.points import Box, box_in_words
from ...core.progress import SILENT, Progress
from ...crs.matching import described, is_same_map, other_datums
from ...crs.system import Crs
from ...engine.memory import Resources
from ...engine.run import Run
from ...engine.step import Step
from ...grids.gradient import gradient, length
from ...rasters.cell_grid import RasterTarget
from ...rasters.content import NO_CELLS, MemoryRaster, Source
from ...rasters.geotiff import HeightBand, read_raster
from ...rasters.windows import RasterWindows, SampledWindows, Window, Windows, is_same_grid
from ...report.units import Units
from ...survey.files import Inputs, is_cloud
from ...survey.vpc import SUFFIX
from ..ground.method import TileMethod
from ..ground.step import LabelGround
from ..rasters.parameters import TerrainModel
from ..rasters.rows import RasterFiles
from ..rasters.step import MakeRasters

# Cells of a strip, and rows beyond it that places near its border need.
_CELLS = 4_000_000
MARGIN = 12
# Two rasters whose heights have this ratio have them in metres and in feet.
_FEET = 0.3048
_ALIKE = 0.01
_LEAST_HEIGHT = 20.0  # metres: of lower land the ratio says nothing
SEEN = 2.0  # metres from ground points of both dates up to which their terrains can show a change


class CellStrip(NamedTuple):
    """Cells of both terrains, with some more rows above and below; float32, metres."""

    row: int  # the first row and column in the raster
    column: int
    own: slice  # which of the rows belong to the strip
    old: np.ndarray
    new: np.ndarray
    spread: np.ndarray  # what 95 of 100 differences do not exceed by both expected errors, or NaN
    distance: np.ndarray  # to the nearest ground point, in the date where it is larger, or NaN

    @property
    def change(self) -> np.ndarray:
        """New minus old, as the rasters have them."""
        return self.new - self.old

    @property
    def is_seen(self) -> np.ndarray:
        """Which cells have ground points of both dates near them, as far as that is known."""
        return ~(self.distance > SEEN)

    def slopes(self, cell: float) -> tuple[np.ndarray, np.ndarray]:
        """Return the slope of the old terrain towards east and north, rise over run."""
        south, east = gradient(self.old, cell)
        return east, -south

    def steepness(self, cell: float) -> np.ndarray:
        """Return the slope of the old terrain, rise over run."""
        return length(*self.slopes(cell))


class Pair(NamedTuple):
    """Two terrains on one grid; windows in metres, NaN for no value."""

    grid: HeightBand  # whose cells all of them have
    old: Windows
    new: Windows
    errors: tuple[Windows, Windows] | None  # the expected errors of both
    distances: tuple[Windows | None, Windows | None]  # to the ground points of each

    @property
    def cell(self) -> float:
        """The side of a cell in metres."""
        return self.grid.cell_metres[0]

    @property
    def units(self) -> Units:
        """The units of lengths and heights in outputs."""
        return Units(self.grid.frame.horizontal_unit, self.grid.frame.vertical_unit)

    def strips(self, progress: Progress) -> Iterator[CellStrip]:
        """Yield all rows, strip by strip."""
        rows, columns = self.grid.whole
        step = max(_CELLS // columns, 4 * MARGIN)
        for start in range(0, rows, step):
            end, first = min(start + step, rows), max(start - MARGIN, 0)
            strip = self.strip((slice(first, end + MARGIN), slice(0, columns)))
            yield strip._replace(own=slice(start - first, end - first))
            progress(end / rows)

    def strip(self, window: Window) -> CellStrip:
        """Return the cells of a window, those that there are."""

        def cells(of: Windows) -> np.ndarray:
            return of[window].astype(np.float32, copy=False)

        old, new = cells(self.old), cells(self.new)
        unknown = np.full(old.shape, np.nan, dtype=np.float32)
        spread = unknown if self.errors is None else np.hypot(*map(cells, self.errors))
        distance = unknown
        for of_date in self.distances:
            distance = distance if of_date is None else np.fmax(distance, cells(of_date))
        row, column = (max(part.start, 0) for part in window)
        return CellStrip(row, column, slice(0, len(old)), old, new, spread, distance)

    def places(self, rows: np.ndarray, columns: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return where cells lie, in metres east and north of the middle of the grid."""
        middle = [(count - 1) / 2.0 for count in self.grid.whole]
        return (columns - middle[1]) * self.cell, (middle[0] - rows) * self.cell

    def shifted(self, east: float, north: float) -> Pair:
        """Return the pair with the new terrain moved by metres."""
        unit = self.grid.frame.horizontal_unit
        move = east / unit, north / unit
        new = _moved(self.new, self.grid, move)
        errors = self.errors and (self.errors[0], _moved(self.errors[1], self.grid, move))
        distance = self.distances[1] and _moved(self.distances[1], self.grid, move)
        return self._replace(new=new, errors=errors, distances=(self.distances[0], distance))


class Given(NamedTuple):
    """What the user gives of one date: a terrain model, or points; and its expected error."""

    terrain: Source
    error: Source | None = None
    cloud: Inputs | None = None  # the opened points that the terrain has to be made of
    distance: Source | None = None  # a raster of the distance to them

    @property
    def crs(self) -> Crs:
        """The CRS that it states."""
        if self.cloud is not None:
            return self.cloud.open().crs
        return read_raster(self.terrain, window=NO_CELLS).crs


def given(terrain: Source, error: Source | None, crs: str | None, progress: Progress) -> Given:
    """Return what is given of one date; points are opened, with the CRS that the user states."""
    if isinstance(terrain, MemoryRaster):
        return Given(terrain, error)
    path = Path(terrain)
    if not (path.is_dir() or is_cloud(path) or path.suffix.lower() in (SUFFIX, ".txt")):
        return Given(terrain, error)
    cloud = Inputs(path).read_as(crs)
    return Given(terrain, error, cloud.holding(cloud.open(progress)))


def _moved(windows: Windows, grid: HeightBand, move: tuple[float, float]) -> Windows:
    if isinstance(windows, SampledWindows):
        return windows.moved(move)
    of = windows.raster  # type: ignore[attr-defined]
    return SampledWindows(of.source, grid, of.frame.vertical_unit, move)


def pair_of(
    dates: tuple[Given, Given],
    like: Source | None,
    folder: Path,
    how: tuple[TerrainModel, TileMethod | None, Resources],
    progress: Progress,
) -> Pair:
    """Return both terrains on one grid: that of `like`, of a raster that is given, or of both
    clouds, whose rasters are made in a folder; refuse what cannot be compared.
    """
    names = [str(date.terrain) for date in dates]
    # Before the long work begins.
    _refuse_other_crs((dates[0].crs, dates[1].crs), names)
    rasters = [date.terrain for date in dates if date.cloud is None]
    if like is not None or rasters:
        target = RasterTarget(like=like if like is not None else rasters[0])
    else:
        boxes = [date.cloud.open().box for date in dates if date.cloud is not None]
        target = RasterTarget(extent=_common(*boxes))
    made = [
        date if date.cloud is None else _made(date.cloud, target, folder / name, how, part)
        for date, name, part in zip(dates, ("old", "new"), progress.shares(1, 1))
    ]
    return _on_one_grid((made[0], made[1]), like, names, progress)


def _common(one: Box, other: Box) -> Box:
    """Return the common rectangle of two surveys."""
    west, south, east, north = (
        pick(*ends) for pick, ends in zip((max, max, min, min), zip(one, other))
    )
    if west >= east or south >= north:
        raise BareEarthError(
            f"The two surveys have no common area: the old one covers {box_in_words(one)}, the new"
            f" one {box_in_words(other)}. Give two surveys of the same place."
        )
    return west, south, east, north


def _made(
    cloud: Inputs,
    target: RasterTarget,
    folder: Path,
    how: tuple[TerrainModel, TileMethod | None, Resources],
    progress: Progress,
) -> Given:
    """Make the terrain model of points, and its expected error."""
    model, method, resources = how
    folder.mkdir()
    names = "dtm", "expected_error", "ground_distance"
    dtm, error, distance = (folder / f"{name}.tif" for name in names)
    files = RasterFiles(dtm=dtm, expected_error=error, ground_distance=distance)
    ground, steps = GroundClasses(), list[Step]()
    if method is not None:
        steps, ground = [LabelGround(method.parameters)], GroundClasses.of_selection(Selection())
    steps.append(MakeRasters(files, model, ground=ground, target=target))
    # Rasters of many files are made of written ones.
    written = folder / "points" if cloud.is_survey and method is not None else None
    run = Run(tuple(steps), resources=resources)
    run.work(cloud, written, progress, vpc=written and folder / "points.vpc")
    return Given(str(dtm), str(error), distance=str(distance))


def _on_one_grid(
    dates: tuple[Given, Given], like: Source | None, names: list[str], progress: Progress
) -> Pair:
    """Return the pair of two rasters with their expected errors."""
    rasters = [
        read_raster(date.terrain, 1, progress if str(date.terrain) == name else SILENT, NO_CELLS)
        for date, name in zip(dates, names)
    ]
    grid = rasters[0] if like is None else read_raster(like, window=NO_CELLS)
    _refuse_other_crs((rasters[0].crs, grid.crs), [names[0], str(like)], heights=False)
    width, height = grid.cell_metres
    if not math.isclose(width, height, rel_tol=1e-3):
        raise BareEarthError(f"{grid.source} has cells that are no squares. Resample it.")
    old, new = (_windows(date.terrain, grid) for date in dates)
    for date, raster in zip(dates, rasters):
        if date.error is not None:
            of_error = read_raster(date.error, window=NO_CELLS)
            _refuse_other_crs((raster.crs, of_error.crs), [names[0], str(date.error)], False)
    errors = [_windows(date.error, grid) for date in dates if date.error is not None]
    old_distance, new_distance = (
        None if date.distance is None else _windows(date.distance, grid) for date in dates
    )
    if len(errors) < 2:
        missing = (
            "Only one date has an expected error" if errors else "There are no expected errors"
        )
        progress.warning(
            f"{missing}: limits follow from stable land alone, and are too small in gaps and under"
            " plants. Give the expected errors of both."
        )
    both = (errors[0], errors[1]) if len(errors) == 2 else None
    return Pair(grid, old, new, both, (old_distance, new_distance))


def _windows(source: Source, grid: HeightBand) -> Windows:
    """Return the cells of a raster on a grid, in metres."""
    raster = read_raster(source, window=NO_CELLS)
    unit = raster.frame.vertical_unit
    if is_same_grid(raster, grid):
        return RasterWindows(raster, unit)
    return SampledWindows(source, grid, unit)


def _refuse_other_crs(systems: tuple[Crs, Crs], names: list[str], heights: bool = True) -> None:
    """Refuse two dates in different CRS, or whose heights are not above the same datum."""
    old, new = systems
    if Crs() in systems:
        return
    if not is_same_map(old, new):
        raise BareEarthError(
            f"{names[1]} is in another CRS ({described(new)}) than {names[0]} ({described(old)})."
            " Reproject one of them."
        )
    if heights and (told := other_datums(names, old, new)):
        raise BareEarthError(
            f"{told} Transform one of them first, such as with gdalwarp and a geoid model."
        )


def refuse_other_units(old: np.ndarray, new: np.ndarray, names: tuple[str, str]) -> None:
    """Refuse heights of which one are metres and the others feet, given those of many cells."""
    low, high = sorted((abs(float(np.median(old))), abs(float(np.median(new)))))
    if low > _LEAST_HEIGHT and abs(low / high / _FEET - 1.0) < _ALIKE:
        raise BareEarthError(
            f"The heights of {names[0]} (about {np.median(old):,.1f} m) and {names[1]} (about"
            f" {np.median(new):,.1f} m) differ as metres and feet do. State the unit of both, such"
            " as with 'gdal_edit.py -units ft RASTER'."
        )
