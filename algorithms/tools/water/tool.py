"""Find water: the lakes and rivers of a survey, as polygons and as breaklines with heights."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from pathlib import Path
from typing import Iterable, Iterator, Sequence

import numpy as np

from ...classes.ground_classes import GroundClasses
from ...classes.kept_classes import NOISE, is_one_of
from ...core.progress import SILENT, Progress
from ...core.words import counted
from ...crs.system import Crs
from ...grids.lines import along
from ...las.cloud import PointCloud, survey_frame
from ...survey.area import Polygon
from ...survey.feature_files import Feature, FeatureLayer, feature_writer
from ...survey.files import Inputs
from ..check.survey_ground import SurveyGround
from ..declaration import CLASSIFIED, CLOUD, CRS, FileTool, Output
from ..rasters.constraints import STATION, Constraints
from ..rasters.fixed_terrain import PER_CELL, GivenTerrain
from .bridges import decks_without_water
from .finding import GRADES, Water, WaterBody, find_water, north_first
from .grid import cell_for, grids_of

# Classes of the LAS specification: of water, and of the decks of bridges.
_WATER_CLASS = 9
_DECK_CLASS = 17
# Fields of the polygons. Levels are in the unit of the heights, all others in metres.
FIELDS: dict[str, type] = {
    "ID": int, "KIND": str, "LEVEL": float, "LEVEL_LOW": float, "SPREAD": float,
    "CERTAINTY": float, "GRADE": str, "AREA": float, "WIDTH": float, "CLASS9": float,
    "RETURNS": float,
}  # fmt: skip
# Fields of the breaklines: ID is that of the polygon, or the number of a breakline of the user.
LINE_FIELDS: dict[str, type] = {"ID": int, "KIND": str}
# Bridges that a warning names.
_MOST_PLACES = 5


@dataclass(frozen=True)
class WaterSummary:
    """The figures of the water that was found."""

    lakes: int  # polygons
    rivers: int  # polygons
    area: float  # of them in square metres
    grades: dict[str, int]  # number of polygons by grade of certainty
    cell: float  # metres: side of the cells in which points were counted
    min_area: float  # square metres
    min_width: float  # metres, of a river
    dry_bridges: int = 0  # decks of bridges with no water below them that was found
    dry_places: tuple[tuple[float, float], ...] = ()  # their middles, in units of the CRS

    @property
    def doubt(self) -> str:
        """A warning of bridges without water below them, or an empty text."""
        if not self.dry_bridges:
            return ""
        words = "bridge has no water below it", "bridges have no water below them"
        places = ", ".join(f"{x:.0f} {y:.0f}" for x, y in self.dry_places[:_MOST_PLACES])
        more = " and others" if self.dry_places[_MOST_PLACES:] else ""
        return (
            f"{counted(self.dry_bridges, *words)} that was found (at {places}{more}). The deck is"
            " left out, but the terrain below follows from the ground beside it, and can dam a"
            " stream. Where one flows, give its water as a polygon."
        )

    @property
    def text(self) -> str:
        """The result in words."""
        if not self.lakes + self.rivers:
            return (
                f"no lake of {self.min_area:,g} m² or more, and no river as large and at least"
                f" {self.min_width:g} m wide, in cells of {self.cell:g} m"
            )
        grades = ", ".join(f"{count:,} {grade}" for grade, count in self.grades.items())
        return (
            f"{counted(self.lakes, 'lake', 'lakes')} and"
            f" {counted(self.rivers, 'part of a river', 'parts of rivers')},"
            f" {self.area / 10_000:,.1f} ha ({grades}), in cells of {self.cell:g} m"
        )


@dataclass(frozen=True)
class SurveyWater:
    """The water of a survey, found or of the user, and breaklines."""

    crs: Crs
    bodies: list[WaterBody]  # metres, in the frame with its origin at (0, 0) of the CRS
    outlines: Sequence[Polygon]  # outlines of `bodies`, in the CRS
    # Breaklines of the user: number, and corners in metres, float64 (n, 3), with heights. A line
    # without heights is here twice, with the heights on either side.
    breaklines: Sequence[tuple[int, np.ndarray]] = ()

    @property
    def constraints(self) -> Constraints:
        """The water and its levels as constraints of a terrain model, in units of the CRS."""
        return Constraints(
            water=tuple(tuple(map(self._in_crs, body.rings)) for body in self.bodies),
            rivers=tuple(self._in_crs(line) for body in self.bodies for line in body.lines),
        )

    def _in_crs(self, places: np.ndarray) -> np.ndarray:
        """Return x, y and level, shape (n, 3), in units of the CRS."""
        across, up = self.crs.horizontal_unit, self.crs.vertical_unit
        return places / (across, across, up)

    def polygons(self) -> Iterator[Feature]:
        """Yield the polygons with `FIELDS`."""
        up = self.crs.vertical_unit
        for number, (body, outline) in enumerate(zip(self.bodies, self.outlines), start=1):
            figures = (
                body.level / up, body.lowest / up, body.spread, body.certainty, body.grade,
                body.area, body.width, body.class_share, body.filled,
            )  # fmt: skip
            values = [round(value, 3) if isinstance(value, float) else value for value in figures]
            yield Feature((number, body.kind, *values), outline)

    def lines(self) -> Iterator[Feature]:
        """Yield shores, islands, middles of rivers and breaklines, if their heights are known."""
        for number, body in enumerate(self.bodies, start=1):
            if not np.isnan(body.level):
                for place, ring in enumerate(body.rings):
                    yield Feature((number, "island" if place else "shore"), self._in_crs(ring))
                for line in body.lines:
                    yield Feature((number, "river"), self._in_crs(line))
        for number, line in self.breaklines:
            yield Feature((number, "breakline"), self._in_crs(line))

    def layers(self) -> tuple[tuple[FeatureLayer, Iterator[Feature]], ...]:
        """Return the polygons and the breaklines."""
        crs = self.crs.wkt, self.crs.epsg
        return (
            (FeatureLayer("water", "Polygon", FIELDS, *crs), self.polygons()),
            (FeatureLayer("breaklines", "LineString Z", LINE_FIELDS, *crs), self.lines()),
        )

    def write(self, polygons: Path | None, lines: Path | None, progress: Progress) -> None:
        """Write the polygons and the breaklines into new files, if they are given."""
        for path, (layer, features) in zip((polygons, lines), self.layers()):
            if path is not None:
                feature_writer(path)(path, features, layer, progress)


def water_of(
    sources: Inputs | SurveyGround,
    how: Water = Water(),
    classes: GroundClasses = GroundClasses(),
    progress: Progress = SILENT,
) -> tuple[SurveyWater, WaterSummary]:
    """Find the water of a survey, whose points are read in parts to save memory."""
    if isinstance(sources, SurveyGround):
        survey = sources
    else:
        survey = SurveyGround.of(sources, classes, progress.part(0.0, 0.05))
    unit = survey.frame.horizontal_unit
    pieces = [piece for piece in survey.survey.pieces if not piece.is_stray]
    boxes = [piece.box_in_metres for piece in pieces]
    extent = sum((east - west) * (north - south) for west, south, east, north in boxes)
    area, count = (sum(column) for column in zip(*((one.area, one.points) for one in pieces)))
    cell = cell_for(area, count, how.water_cell, extent)
    grids = grids_of(boxes, cell)
    for cloud, ground in survey.parts(progress.part(0.05, 0.9)):
        used = classes.used(cloud) & ~is_one_of(cloud.classification, NOISE)
        last = used & (cloud.return_number >= cloud.number_of_returns)
        water, decks = (
            used & (cloud.classification == value) for value in (_WATER_CLASS, _DECK_CLASS)
        )
        marks = np.array((ground, water, last, decks))
        marked = np.flatnonzero(marks.any(axis=0))
        points = cloud.points(marked, survey.frame)
        for grid in grids:
            if points.count and grid.meets(points.box):
                grid.add(points, *marks[:, marked])
    survey.check()
    parts = progress.part(0.9, 1.0).shares(*[1.0] * len(grids))
    found = [find_water(grid, how, part) for grid, part in zip(grids, parts)]
    bodies = sorted(itertools.chain(*found), key=north_first)
    outlines = tuple(tuple(ring[:, :2] for ring in body.rings) for body in bodies)
    kinds, grades = [body.kind for body in bodies], [body.grade for body in bodies]
    dry = [deck for grid in grids for deck in decks_without_water(grid, outlines)]
    summary = WaterSummary(
        kinds.count("lake"), kinds.count("river"), sum(body.area for body in bodies),
        {name: grades.count(name) for name in GRADES if name in grades}, cell, how.min_area,
        how.min_width, len(dry), tuple((x / unit, y / unit) for x, y in dry),
    )  # fmt: skip
    if summary.doubt:
        progress.warning(summary.doubt)
    in_crs = [tuple(ring / unit for ring in outline) for outline in outlines]
    return SurveyWater(survey.survey.crs, bodies, in_crs), summary


def found_water(
    sources: Inputs, ground: GroundClasses, progress: Progress, how: Water = Water()
) -> tuple[SurveyWater, WaterSummary]:
    """Find the water in classified files, for another tool, and report it."""
    water, summary = water_of(sources, how, ground, progress)
    progress.info(f"Water: {summary.text}.")
    return water, summary


def given_water(
    constraints: Constraints,
    clouds: Iterable[PointCloud],
    crs: Crs,
    ground: GroundClasses,
    cell: float,
) -> SurveyWater:
    """Return water and breaklines of the user, in the CRS of the points, with the heights that they
    have in a terrain model whose points are thinned in cells of `cell` metres.
    """
    given = GivenTerrain.of(constraints, clouds, survey_frame(crs), ground, cell / PER_CELL)
    kinds = {True: "river", False: "lake"}
    bodies = [
        WaterBody(kinds[bool(water.rivers)], water.rings, water.rivers, *water.levels, water.area)
        for water in given.waters
    ]
    outlines = [tuple(map(_closed, polygon)) for polygon in constraints.water_outlines]
    breaklines = [
        (number, side)
        for number, line in enumerate(given.lines, start=1)
        for side in _with_heights(line, given)
    ]
    return SurveyWater(crs, bodies, outlines, breaklines)


def _with_heights(line: np.ndarray, given: GivenTerrain) -> Iterator[np.ndarray]:
    """Yield a breakline if it has heights, otherwise a line for each of its sides."""
    if not np.isnan(line[:, 2]).any():
        yield line
        return
    line = along(line, STATION)
    unknown = np.isnan(line[:, 2])
    for side in np.split(given.ground.beside(line), 2):
        side[~unknown] = line[~unknown]
        side = side[~np.isnan(side[:, 2])]
        if len(side) > 1:
            yield side


def _closed(ring: np.ndarray) -> np.ndarray:
    return ring if np.array_equal(ring[0], ring[-1]) else np.concatenate((ring, ring[:1]))


def _write(
    sources: Inputs,
    output: Path,
    breaklines: Path | None,
    water: Water = Water(),
    ground: GroundClasses = GroundClasses(),
    progress: Progress = SILENT,
) -> WaterSummary:
    """Find water and write it into new files."""
    water_of_survey, summary = water_of(sources, water, ground, progress.part(0.0, 0.95))
    water_of_survey.write(output, breaklines, progress)
    return summary


TOOL = FileTool(
    work=_write,
    sets=(Water, GroundClasses),
    inputs=(CLASSIFIED, CRS),
    outputs=(
        Output(
            "output",
            "features",
            help="Polygons of water with the level (LEVEL), the spread of the shore in metres"
            " (SPREAD) and a grade of certainty (GRADE).",
            label="Water",
            is_main=True,
            look="water",
        ),
        Output(
            "breaklines",
            "features",
            help="Shores, islands and the middles of rivers as lines with heights.",
            label="Breaklines",
            flag="breaklines-out",
            by_default=False,
            look="breaklines",
        ),
    ),
    always_reports=True,
    command="water",
    identifier="water",
    title="Find water",
    about="Water is where hardly any last return is, and the ground along the shore is level or"
    " falls steadily, or where points have class 9. Gaps between strips, roofs and woods are told"
    " from it. Each polygon has the level, the spread of the shore, and a grade of certainty."
    " `terrain()` takes the polygons as water.",
    page="water",
    words=(CLOUD, "lake,river,pond,shore,shoreline,hydro-flattening,hydroflatten,breaklines"),
    numbers=(("LAKES", "Lakes"), ("RIVERS", "Parts of rivers"), ("AREA", "Area [m²]")),
    shown=("min_area", "min_width"),
)
