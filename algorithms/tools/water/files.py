"""Finds the water of a survey, and writes it as polygons and as breaklines with heights."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Iterable, Iterator, Sequence

import numpy as np

from ...core.files import Outputs, check_distinct
from ...core.parameters import HasSets
from ...core.progress import SILENT, Progress
from ...core.words import counted
from ...crs.system import Crs
from ...las.cloud import PointCloud
from ...products.survey_ground import SurveyGround
from ...survey.feature_files import Feature, Layer, check_features, feature_writer, files_beside
from ...survey.ground_classes import GroundClasses
from ...survey.kept_classes import NOISE, is_one_of
from ..rasters.constraints import Constraints
from .bridges import decks_without_water
from .finding import GRADES, Water, WaterBody, find_water
from .grid import WaterGrid, cell_for

# The classes of water and of the decks of bridges in the LAS specification.
WATER_CLASS, _DECK_CLASS = 9, 17
# Fields of the polygons. Levels are in the unit of the heights, all others in metres.
FIELDS: dict[str, type] = {
    "ID": int, "KIND": str, "LEVEL": float, "LEVEL_LOW": float, "SPREAD": float,
    "CERTAINTY": float, "GRADE": str, "AREA": float, "WIDTH": float, "CLASS9": float,
    "RETURNS": float,
}  # fmt: skip
# Fields of the breaklines: ID is that of the polygon, or the number of a breakline of the user.
LINE_FIELDS: dict[str, type] = {"ID": int, "KIND": str}


@dataclass(frozen=True)
class WaterRequest(HasSets):
    """A request to find water.

    Attributes
    ----------
    water : Water
        Which water is found.
    ground : GroundClasses
        Which points are ground.
    crs : str or None
        The CRS of the points in place of the one that files state: an EPSG code, such as
        "EPSG:25832", or "EPSG:2230+6360" with that of the heights, or well-known text.
    breaklines : Path or None
        A file for the shores, islands and middles of rivers as lines with heights.
    """

    water: Water = field(default_factory=Water)
    ground: GroundClasses = field(default_factory=GroundClasses)
    crs: str | None = None
    breaklines: Path | None = None


@dataclass(frozen=True)
class WaterSummary:
    """What was found."""

    lakes: int  # polygons
    rivers: int  # polygons
    area: float  # of them in square metres
    grades: dict[str, int]  # number of polygons by grade of certainty
    cell: float  # metres: side of the cells in which points were counted
    min_area: float  # square metres
    min_width: float  # metres, of a river

    @property
    def text(self) -> str:
        """The result as words."""
        if not self.lakes + self.rivers:
            return (
                f"no lake of {self.min_area:,g} m² or more, and no river as large and at least"
                f" {self.min_width:g} m wide, in cells of {self.cell:g} m"
            )
        grades = ", ".join(f"{count:,} {grade}" for grade, count in self.grades.items())
        lakes = f"{self.lakes:,} lake{'' if self.lakes == 1 else 's'}"
        rivers = "1 part of a river" if self.rivers == 1 else f"{self.rivers:,} parts of rivers"
        return (
            f"{lakes} and {rivers}, {self.area / 10_000:,.1f} ha ({grades}),"
            f" in cells of {self.cell:g} m"
        )


@dataclass(frozen=True)
class SurveyWater:
    """The water of a survey."""

    bodies: list[WaterBody]  # metres, in the frame with its origin at (0, 0) of the CRS
    crs: Crs
    cell: float  # metres
    how: Water  # which water was looked for

    @classmethod
    def of(
        cls, sources: Sequence[Path], request: WaterRequest, progress: Progress = SILENT
    ) -> SurveyWater:
        """Find the water of a survey, read in parts, so that memory depends on the area only."""
        survey = SurveyGround.of(sources, request.ground, progress.part(0.0, 0.05), request.crs)
        unit, tiles = survey.frame.horizontal_unit, survey.survey.tiles
        boxes = np.array([each.outer_box for each in tiles]) * unit
        area = float((boxes[:, 2:] - boxes[:, :2]).prod(axis=1).sum())
        west, south, east, north = (float(each) * unit for each in survey.survey.box)
        extent = (east - west) * (north - south)
        cell = cell_for(area, survey.survey.count, request.water.water_cell, extent)
        grid = WaterGrid((west, south, east, north), cell)
        for cloud, ground in survey.parts(progress.part(0.05, 0.9)):
            used = request.ground.used(cloud) & ~is_one_of(cloud.classification, NOISE)
            last = cloud.return_number >= cloud.number_of_returns
            is_water = cloud.classification == WATER_CLASS
            is_deck = cloud.classification == _DECK_CLASS
            _add(grid, cloud, survey, (ground, used & is_water, used & last, used & is_deck))
        survey.check()
        found = find_water(grid, request.water, progress.part(0.9, 1.0))
        outlines = tuple(tuple(ring[:, :2] for ring in each.rings) for each in found)
        _tell_of_decks(decks_without_water(grid, outlines), progress)
        return cls(found, survey.survey.crs, cell, request.water)

    @property
    def summary(self) -> WaterSummary:
        """What was found."""
        kinds = [each.kind for each in self.bodies]
        grades = [each.grade for each in self.bodies]
        return WaterSummary(
            kinds.count("lake"), kinds.count("river"), sum(each.area for each in self.bodies),
            {name: grades.count(name) for name in GRADES if name in grades}, self.cell,
            self.how.min_area, self.how.min_width,
        )  # fmt: skip

    def in_crs(self, places: np.ndarray) -> np.ndarray:
        """Return x, y and level, shape (n, 3), in units of the CRS."""
        across, up = self.crs.horizontal_unit, self.crs.vertical_unit
        return places / (across, across, up)

    @property
    def constraints(self) -> Constraints:
        """The water and its levels as constraints of a terrain model, in units of the CRS."""
        return Constraints(
            water=tuple(tuple(map(self.in_crs, each.rings)) for each in self.bodies),
            rivers=tuple(self.in_crs(line) for each in self.bodies for line in each.lines),
        )

    def polygons(self) -> Iterator[Feature]:
        """Yield the polygons with `FIELDS`."""
        up = self.crs.vertical_unit
        for number, each in enumerate(self.bodies, start=1):
            figures = (
                each.level / up, each.lowest / up, each.spread, each.certainty, each.grade,
                each.area, each.width, each.class_share, each.filled,
            )  # fmt: skip
            values = [round(value, 3) if isinstance(value, float) else value for value in figures]
            rings = [self.in_crs(ring)[:, :2] for ring in each.rings]
            yield Feature((number, each.kind, *values), rings)

    def lines(self) -> Iterator[Feature]:
        """Yield the breaklines with `LINE_FIELDS`: shores, islands and the middles of rivers."""
        for number, each in enumerate(self.bodies, start=1):
            for place, ring in enumerate(each.rings):
                yield Feature((number, "island" if place else "shore"), self.in_crs(ring))
            for line in each.lines:
                yield Feature((number, "river"), self.in_crs(line))

    def write(
        self, target: Path, breaklines: Path | None = None, progress: Progress = SILENT
    ) -> None:
        """Write the polygons, and the breaklines if they have a file; both of them or none."""
        lines = None if breaklines is None else (breaklines, self.lines())
        write_features(self.crs, (target, self.polygons()), lines, progress)


def write_features(
    crs: Crs,
    polygons: tuple[Path, Iterable[Feature]] | None,
    lines: tuple[Path, Iterable[Feature]] | None,
    progress: Progress = SILENT,
) -> None:
    """Write polygons of water with `FIELDS`, and breaklines with `LINE_FIELDS`; all or none."""
    layers = []
    if polygons is not None:
        layers.append((*polygons, Layer("water", "Polygon", FIELDS, crs.wkt, crs.epsg)))
    if lines is not None:
        layer = Layer("breaklines", "LineString Z", LINE_FIELDS, crs.wkt, crs.epsg)
        layers.append((*lines, layer))
    with Outputs() as outputs:
        for output, features, layer in layers:
            write = feature_writer(output)
            write(outputs.files(output, files_beside(output)), features, layer, progress)
        progress(1.0)  # the last moment to cancel


def _tell_of_decks(count: int, progress: Progress) -> None:
    """Warn of bridges below which the terrain may be a dam."""
    if count:
        words = "bridge has no water below it", "bridges have no water below them"
        progress.warning(
            f"{counted(count, *words)} that was found: there the terrain follows from the ground"
            " beside the deck, and can dam a stream. Where one flows, give its water as a polygon."
        )


def _add(
    grid: WaterGrid,
    cloud: PointCloud,
    survey: SurveyGround,
    marks: tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray],
) -> None:
    """Add the points of a part that have any mark: ground, water, last return, deck."""
    which = np.flatnonzero(np.logical_or.reduce(marks))
    grid.add(cloud.points(which, survey.frame), *(each[which] for each in marks))


def write_water(
    sources: Iterable[Path],
    target: Path,
    request: WaterRequest = WaterRequest(),
    progress: Progress = SILENT,
) -> WaterSummary:
    """Find the water of one classified file or many, and write it as polygons.

    Parameters
    ----------
    sources : iterable of Path
        Classified LAS, LAZ and COPC files, folders of them, virtual point clouds and lists: all of
        them together are one survey.
    target : Path
        The polygons to write: .gpkg, .geojson, .shp or .fgb.
    request : WaterRequest
        Which water is found, and a file for breaklines.
    progress : Progress
        Receives progress and messages.

    Returns
    -------
    WaterSummary

    Raises
    ------
    BareEarthError
        If an input cannot be read, there is no ground, the survey is too large for its cells, or an
        output cannot be written.
    Cancelled
        If the user asked to stop; no output is left behind.

    Examples
    --------
    >>> from bare_earth.algorithms import find_water
    >>> find_water(["ground.laz"], "water.gpkg").lakes  # doctest: +SKIP
    3
    """
    paths, target = [Path(each) for each in sources], Path(target)
    outputs = [target] if request.breaklines is None else [target, Path(request.breaklines)]
    check_distinct(outputs)
    for each in outputs:
        check_features(each, tuple(paths))
    found = SurveyWater.of(paths, request, progress.part(0.0, 0.95))
    found.write(target, request.breaklines, progress)
    return found.summary
