"""Breaklines and water as vertices of the terrain, with heights of the ground near them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Callable, Iterable, Iterator, NamedTuple, Sequence

import numpy as np

from ..core.points import Frame, Points
from ..core.progress import SILENT, Progress
from ..grids.lines import NearestHeights, NearPlaces, along, falling, inside_grid, squares
from ..las.cloud import PointCloud
from ..las.lasfile import LasFile
from ..las.reading import read_parts
from ..survey.area import Area, Polygon
from ..survey.ground_classes import GroundClasses, GroundCounts
from ..survey.kept_classes import IGNORED_GROUND
from .constraints import NEAR, STATION, Constraints

# Returns the level of water at places of shape (n, 2), in metres.
Levels = Callable[[np.ndarray], np.ndarray]
# This share of the ground along the border of water is below its level: banks are higher.
_LEVEL = 10.0
# Metres between vertices inside water.
_INSIDE = 10.0
# Lines are used up to so many metres beyond the points of a block.
_BEYOND = 20.0
# Places on a line for each cell in which points are thinned: the line misses no cell.
PER_CELL = 4.0


@dataclass(frozen=True, eq=False)
class FixedTerrain:
    """Constraints as vertices of the terrain.

    Attributes
    ----------
    edges, inside : numpy.ndarray of float64, shape (n, 3)
        Places along lines and borders, and inside of water: metres, in the frame of the survey.
    cell : float
        Side in metres of the cells in which points are thinned.
    """

    edges: np.ndarray
    inside: np.ndarray
    cell: float

    def added_to(
        self, points: Points, ground: np.ndarray, corner: tuple[float, float]
    ) -> tuple[Points, np.ndarray, np.ndarray]:
        """Return points with the vertices near them.

        Ground points that share a cell of the lattice with a vertex are no longer ground: they may
        lie on the other side of a line.

        Parameters
        ----------
        points : Points
            Relative to a corner.
        ground : numpy.ndarray of bool, shape (n,)
            Which are ground.
        corner : tuple of float
            x and y in the frame of the survey.

        Returns
        -------
        points : Points
            All, the vertices last.
        ground, edges : numpy.ndarray of bool, shape (n + m,)
            Which of them are ground, and which of these lie on lines.
        """
        low = np.array(points.box[:2]) + corner - _BEYOND
        high = np.array(points.box[2:]) + corner + _BEYOND
        edges, inside = (
            each[((each[:, :2] >= low) & (each[:, :2] <= high)).all(axis=1)]
            for each in (self.edges, self.inside)
        )
        some = np.concatenate((edges, inside)) - (*corner, 0.0)
        codes = squares(points.x + corner[0], points.y + corner[1], self.cell)
        stays = ground & ~np.isin(codes, self._taken)
        together = Points(*(np.concatenate(pair) for pair in zip(points, some.T)))
        are_edges = np.zeros(together.count, dtype=bool)
        are_edges[points.count : points.count + len(edges)] = True
        return together, np.pad(stays, (0, len(some)), constant_values=True), are_edges

    @cached_property
    def _taken(self) -> np.ndarray:
        """The cells of the lattice that hold a vertex."""
        vertices = np.concatenate((self.edges, self.inside))
        return np.unique(squares(*vertices[:, :2].T, self.cell))


def fixed_terrain(
    constraints: Constraints,
    clouds: Iterable[PointCloud],
    frame: Frame,
    ground: GroundClasses,
    cell: float,
    progress: Progress = SILENT,
) -> FixedTerrain | None:
    """Return constraints as vertices. Missing heights are taken from the ground nearby.

    Parameters
    ----------
    constraints : Constraints
        The constraints.
    clouds : iterable of PointCloud
        All points of the survey, part by part. They are read only if there are lines or water,
        to find the ground near these.
    frame : Frame
        That of the survey.
    ground : GroundClasses
        Which points are ground.
    cell : float
        Side in metres of the cells in which points are thinned.
    progress : Progress
        Receives a warning about what cannot be used.

    Raises
    ------
    BareEarthError
        If a file cannot be read.
    Cancelled
        If the user asked to stop.
    """
    if not constraints.any:
        return None
    given = GivenTerrain.of(constraints, clouds, frame, ground, cell / PER_CELL)
    flat = list(_flattened(given, progress))
    borders, insides = zip(*flat) if flat else ((), ())
    lines, none = _along_breaklines(given.lines, given.ground, progress), np.zeros((0, 3))
    edges = np.concatenate([none, *lines, *borders])
    return FixedTerrain(edges, np.concatenate([none, *insides]), cell)


class GivenTerrain(NamedTuple):
    """Lines and water in metres, in the frame of the survey, and the ground near them.

    Attributes
    ----------
    lines : list of numpy.ndarray of float64, shape (n, 3)
        Places along each breakline.
    waters : list of polygon
        Each with rings of shape (n, 3), whose z is not used.
    borders : list of numpy.ndarray of float64, shape (n, 3)
        Places along the rings of each polygon of water.
    rivers : list of numpy.ndarray of float64, shape (n, 2)
        Stations along each river.
    ground, shore : NearestHeights
        The ground near breaklines, and near water, where ignored ground counts too.
    """

    lines: list[np.ndarray]
    waters: list[Polygon]
    borders: list[np.ndarray]
    rivers: list[np.ndarray]
    ground: NearestHeights
    shore: NearestHeights

    @classmethod
    def of(
        cls,
        constraints: Constraints,
        clouds: Iterable[PointCloud],
        frame: Frame,
        ground: GroundClasses,
        step: float,
    ) -> GivenTerrain:
        """Return constraints with the ground near them; places are at most a step apart."""
        unit, origin = frame.horizontal_unit, np.array(frame.origin)
        lines = [
            along((line - (*origin, 0.0)) * (unit, unit, frame.vertical_unit), step)
            for line in constraints.breaklines
        ]
        waters = [
            tuple(np.column_stack(((ring - origin) * unit, np.zeros(len(ring)))) for ring in each)
            for each in constraints.water
        ]
        borders = [
            np.concatenate([along(ring, step, is_closed=True) for ring in polygon])
            for polygon in waters
        ]
        rivers = [
            along((line - (*origin, 0.0)) * (unit, unit, 1.0), STATION)[:, :2]
            for line in constraints.rivers
        ]
        near, is_ground = _ground_near([*lines, *borders], clouds, ground, frame)
        if waters:
            # Points in the water are not on its banks.
            water = Area(None, tuple(tuple(ring[:, :2] for ring in each) for each in waters))
            dry = ~water.contains(*near[:, :2].T)
            near, is_ground = near[dry], is_ground[dry]
        heights = NearestHeights(near[is_ground], NEAR)
        # The level is that of the foot of the bank, where ground is ignored by the surface.
        shore = heights if is_ground.all() else NearestHeights(near, NEAR)
        return cls(lines, waters, borders, rivers, heights, shore)

    def lines_in(self, area: Area) -> list[np.ndarray]:
        """Return the stations of each river that lie in an area."""
        return [each[area.contains(*each.T)] for each in self.rivers]

    def levels(self, number: int) -> Levels | None:
        """Return what tells the level of a polygon of water; None without ground on its border."""
        border = self.borders[number][:, :2]
        heights = self.shore.at(border)
        if np.isnan(heights).all():
            return None
        line = np.concatenate([np.zeros((0, 2)), *self.lines_in(area_of(self.waters[number]))])
        if len(line) > 1:
            return lambda places: falling(line, border, heights, places, _LEVEL)
        level = np.nanpercentile(heights, _LEVEL)
        return lambda places: np.full(len(places), level)


def area_of(polygon: Polygon) -> Area:
    """Return a polygon of water as an area."""
    return Area(None, (tuple(ring[:, :2] for ring in polygon),))


def parts_of(files: Sequence[LasFile], progress: Progress = SILENT) -> Iterator[PointCloud]:
    """Yield the points of files, part by part."""
    for las, part in zip(files, progress.shares(*[1.0] * len(files))):
        yield from read_parts(las, part.quiet())


def _along_breaklines(
    lines: Sequence[np.ndarray], ground: NearestHeights, progress: Progress
) -> Iterator[np.ndarray]:
    """Yield the vertices of each breakline."""
    lost = 0
    for line in lines:
        unknown = np.isnan(line[:, 2])
        sides = ground.beside(line)[np.tile(unknown, 2)]
        sides = sides[~np.isnan(sides[:, 2])]
        lost += bool(unknown.all()) and not len(sides)
        yield np.concatenate((line[~unknown], sides))
    if lost:
        progress.warning(
            f"Breaklines left out: {lost:,}. They have no z, and no ground point within {NEAR:g} m."
        )


def _flattened(given: GivenTerrain, progress: Progress) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield the vertices of each water polygon, on its border and inside."""
    dry = 0
    for number, (polygon, border) in enumerate(zip(given.waters, given.borders)):
        levels = given.levels(number)
        if levels is None:
            dry += 1
            yield np.zeros((0, 3)), np.zeros((0, 3))
            continue
        area = area_of(polygon)
        inside = inside_grid(area.bounds, _INSIDE)
        inside = inside[area.contains(*inside.T)]
        places = np.concatenate((border[:, :2], inside))
        vertices = np.column_stack((places, levels(places)))
        yield vertices[: len(border)], vertices[len(border) :]
    if dry:
        progress.warning(
            f"Polygons of water that are not flattened: {dry:,}. They have no ground point"
            f" within {NEAR:g} m of their border. The terrain uses no ground points in them."
        )


def _ground_near(
    lines: Sequence[np.ndarray],
    clouds: Iterable[PointCloud],
    ground: GroundClasses,
    frame: Frame,
) -> tuple[np.ndarray, np.ndarray]:
    """Return ground and ignored ground round lines, shape (n, 3), and which is ground."""
    found, are_ground = [np.zeros((0, 3))], [np.zeros(0, dtype=bool)]
    if lines:
        wanted = NearPlaces(*np.concatenate(lines)[:, :2].T, NEAR)
        for some in clouds:
            is_ground = ground.of(some, GroundCounts())
            which = np.flatnonzero(is_ground | ground.points_of(some, (IGNORED_GROUND,)))
            near = which[wanted.of(*some.places(which, frame))]
            found.append(np.column_stack(some.points(near, frame)))
            are_ground.append(is_ground[near])
    return np.concatenate(found), np.concatenate(are_ground)
