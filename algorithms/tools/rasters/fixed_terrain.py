"""Breaklines and water as vertices of the terrain, with heights of the ground near them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, partial
from typing import Iterable, Iterator, NamedTuple, Sequence

import numpy as np

from ...classes.ground_classes import GroundClasses, GroundCounts
from ...classes.kept_classes import IGNORED_GROUND
from ...core.points import Frame, Points
from ...core.progress import SILENT, Progress
from ...grids.lines import NearestHeights, NearPlaces, along, inside_grid, squares
from ...las.cloud import PointCloud
from ...survey.area import Area, Polygon
from ..water.descent import falling
from .block_view import BlockView
from .constraints import NEAR, STATION, Constraints
from .given_heights import without_wrong_heights
from .level_water import LevelWater

# This share of the ground along the border of water is below its level: banks are higher.
_LEVEL = 10.0
# The level is that of the points of this class in the water.
_WATER_CLASS = 9
_FEWEST = 8  # of these points; with fewer there is no level
_SQUARE = 2.0  # metres: side of the squares whose points count as one, their mean
# Metres between vertices inside water.
_INSIDE = 10.0
# Metres beyond the points of a block up to which lines are used.
_BEYOND = 20.0
# Places on a line for each cell in which points are thinned: the line misses no cell.
PER_CELL = 4.0


@dataclass(frozen=True, eq=False)
class FixedTerrain:
    """Constraints as vertices of the terrain, in metres and in the frame of the survey."""

    edges: np.ndarray  # float64, (n, 3): along lines and borders
    inside: np.ndarray  # float64, (n, 3): in water
    cell: float  # metres: side of the cells in which points are thinned
    waters: tuple[LevelWater, ...] = ()  # the water, if its level is known

    def added_to(self, view: BlockView) -> BlockView:
        """Return the points of a block with the vertices near them last, as ground."""
        # Ground points that share a cell of the lattice with a vertex are no longer ground: they
        # may lie on the other side of a line.
        points, corner = view.points, np.array((*view.corner, 0.0))
        low, high = np.reshape(points.box, (2, 2)) + corner[:2] + [[-_BEYOND], [_BEYOND]]
        edges, inside = (
            vertices[((vertices[:, :2] >= low) & (vertices[:, :2] <= high)).all(axis=1)]
            for vertices in (self.edges, self.inside)
        )
        new = np.concatenate((edges, inside)) - corner
        codes = squares(points.x + corner[0], points.y + corner[1], self.cell)
        stays = view.ground & ~np.isin(codes, self._cells)

        def longer(flags: np.ndarray, value: bool = False) -> np.ndarray:
            return np.pad(flags, (0, len(new)), constant_values=value)

        are_edges = longer(np.zeros(points.count, dtype=bool))
        are_edges[points.count : points.count + len(edges)] = True
        together = Points(*(np.concatenate(columns) for columns in zip(points, new.T)))
        top, core = longer(view.top), longer(view.core)
        return BlockView(together, longer(stays, True), top, core, view.corner, are_edges)

    @cached_property
    def _cells(self) -> np.ndarray:
        """The cells of the lattice with a vertex."""
        vertices = np.concatenate((self.edges, self.inside))
        return np.unique(squares(vertices[:, 0], vertices[:, 1], self.cell))


def fixed_terrain(
    constraints: Constraints,
    clouds: Iterable[PointCloud],
    frame: Frame,
    ground: GroundClasses,
    cell: float,
    progress: Progress = SILENT,
) -> FixedTerrain:
    """Return constraints as vertices; missing heights are taken from the ground nearby, and a
    warning tells what cannot be used.
    """
    # All points of the survey, part by part, show the ground near lines and water. `cell` is the
    # side in metres of the cells in which points are thinned.
    step = cell / PER_CELL
    given = GivenTerrain.of(constraints, clouds, frame, ground, step, progress)
    waters = tuple(water for water in given.waters if water.is_known)
    dry = len(given.waters) - len(waters)
    if dry:
        progress.warning(
            f"Polygons of water that are not flattened: {dry:,}. They have no ground point"
            f" within {NEAR:g} m of their border. The terrain uses no ground points in them."
        )
    lines, none = _along_breaklines(given, step, progress), np.zeros((0, 3))
    borders = (along(ring, step) for water in waters for ring in water.rings)
    edges = np.concatenate([none, *lines, *borders])
    return FixedTerrain(edges, np.concatenate([none, *map(_inside, waters)]), cell, waters)


class GivenTerrain(NamedTuple):
    """Lines and water in metres, in the frame of the survey, and the ground near them."""

    lines: list[np.ndarray]  # float64, (n, 3) each; z is NaN for none, or one that cannot be
    waters: list[LevelWater]  # without a level if no ground is near
    ground: NearestHeights  # near breaklines and water

    @classmethod
    def of(
        cls,
        constraints: Constraints,
        clouds: Iterable[PointCloud],
        frame: Frame,
        ground: GroundClasses,
        step: float,
        progress: Progress = SILENT,
    ) -> GivenTerrain:
        """Return constraints with the ground near them, searched at places a step apart."""
        metres = partial(_in_metres, frame)
        lines = [metres(line) for line in constraints.breaklines]
        polygons = [tuple(map(metres, polygon)) for polygon in constraints.water]
        borders = [
            np.concatenate([along(ring, step, is_closed=True) for ring in polygon])
            for polygon in polygons
        ]
        places = [along(line, step) for line in lines]
        # Levels that are given need no points.
        open_ones = tuple(
            _outline_of(polygon)
            for polygon, border in zip(polygons, borders)
            if np.isnan(border[:, 2]).any()
        )
        surface = _WaterSurface(Area(None, open_ones) if open_ones else None)
        near, is_ground = _ground_near([*places, *borders], clouds, ground, frame, surface)
        if polygons:
            # Points in the water are not on its banks.
            dry = ~Area(None, tuple(map(_outline_of, polygons))).contains(*near[:, :2].T)
            near, is_ground = near[dry], is_ground[dry]
        heights = NearestHeights(near[is_ground], NEAR)
        # The level is that of the foot of the bank, where ground is ignored by the surface.
        shore = heights if is_ground.all() else NearestHeights(near, NEAR)
        rivers = [along(metres(line), STATION) for line in constraints.rivers]
        waters = [
            _with_level(polygon, border, rivers, shore, surface)
            for polygon, border in zip(polygons, borders)
        ]
        lines = without_wrong_heights(lines, heights, frame.vertical_unit, progress)
        return cls(lines, waters, heights)


def _in_metres(frame: Frame, line: np.ndarray) -> np.ndarray:
    """Return the corners of a line or ring in metres, shape (n, 3); NaN for z without any."""
    x, y = ((line[:, :2] - frame.origin) * frame.horizontal_unit).T
    z = line[:, 2] * frame.vertical_unit if line.shape[1] > 2 else np.full(len(line), np.nan)
    return np.column_stack((x, y, np.where(np.isfinite(z), z, np.nan)))


def _outline_of(polygon: Polygon) -> Polygon:
    return tuple(ring[:, :2] for ring in polygon)


def _with_level(
    polygon: Polygon,
    border: np.ndarray,
    rivers: Sequence[np.ndarray],
    shore: NearestHeights,
    surface: _WaterSurface,
) -> LevelWater:
    """Return a polygon with its level: that of its corners, of the points of class 9 in it, or of
    the ground along its border.
    """
    rings = tuple(along(ring, STATION, is_closed=True) for ring in polygon)
    area = Area(None, (_outline_of(polygon),))
    parts = [line[area.contains(*line[:, :2].T)] for line in rivers]
    parts = [part for part in parts if len(part) > 1]
    if not np.isnan(border[:, 2]).any():
        return LevelWater(rings, tuple(parts))
    places, percentile = border[:, :2], _LEVEL
    heights, seen = shore.near(places), surface.within(area)
    if np.isnan(heights).all() and not len(seen):
        return LevelWater(rings)
    stations = [part[:, :2] for part in parts]
    if len(seen):
        # Banks count for the shape of a fall only, and only where no such points are.
        percentile = 50.0
        if stations and not np.isnan(heights).all():
            banks = falling(
                stations, places, heights, np.concatenate((places, seen[:, :2])), _LEVEL
            )
            far = ~NearPlaces(seen[:, 0], seen[:, 1], 2.0 * NEAR).of(*places.T)
            heights = banks[: len(places)] + np.median(seen[:, 2] - banks[len(places) :])
            places, heights = places[far], heights[far]
        else:
            places, heights = places[:0], heights[:0]
        places = np.concatenate((places, seen[:, :2]))
        heights = np.concatenate((heights, seen[:, 2]))
    level = float(np.nanpercentile(seen[:, 2] if len(seen) else heights, percentile))

    def raised(line: np.ndarray) -> np.ndarray:
        z = np.full(len(line), level)
        if stations:
            z = falling(stations, places, heights, line[:, :2], percentile)
        return np.column_stack((line[:, :2], z))

    lines = map(raised, parts)
    downstream = (line if line[0, 2] >= line[-1, 2] else line[::-1] for line in lines)
    return LevelWater(tuple(map(raised, rings)), tuple(downstream))


def _along_breaklines(given: GivenTerrain, step: float, progress: Progress) -> Iterator[np.ndarray]:
    """Yield the vertices of each breakline."""
    lost = 0
    for line in (along(corners, step) for corners in given.lines):
        unknown = np.isnan(line[:, 2])
        sides = given.ground.beside(line)[np.tile(unknown, 2)]
        sides = sides[~np.isnan(sides[:, 2])]
        lost += bool(unknown.all()) and not len(sides)
        yield np.concatenate((line[~unknown], sides))
    if lost:
        progress.warning(
            f"Breaklines left out: {lost:,}. They have no z, and no ground point within {NEAR:g} m."
        )


class _WaterSurface:
    """The points of class 9 in water, whose level is not given, as means of squares."""

    def __init__(self, water: Area | None) -> None:
        self.water = water
        # Of each part of the survey: the number of each square; sums of x, y and z in whole
        # millimetres, which are the same in any order, and of points
        self._parts = [(np.zeros(0, dtype=np.int64), np.zeros((0, 4)))]

    def add(self, points: np.ndarray) -> None:
        """Add those of some points, shape (n, 3), that lie in the water."""
        if self.water is not None:
            points = points[self.water.contains(*points[:, :2].T)]
            numbers = squares(points[:, 0], points[:, 1], _SQUARE)
            sums = np.column_stack((np.rint(points * 1000.0), np.ones(len(points))))
            self._parts.append(_summed(numbers, sums))

    @cached_property
    def _means(self) -> np.ndarray:
        """The mean x, y and z in each square, and the number of points; shape (n, 4)."""
        _, sums = _summed(*map(np.concatenate, zip(*self._parts)))
        return np.column_stack((sums[:, :3] / 1000.0 / sums[:, 3:], sums[:, 3]))

    def within(self, area: Area) -> np.ndarray:
        """Return the means in an area, shape (n, 3); none of too few points."""
        means = self._means[area.contains(*self._means[:, :2].T)]
        return means[:, :3] if means[:, 3].sum() >= _FEWEST else means[:0, :3]


def _summed(numbers: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the numbers, each once, and the sums of the values of each, shape (k, 4)."""
    names, group = np.unique(numbers, return_inverse=True)
    sums = [np.bincount(group, column, len(names)) for column in values.T]
    return names, np.column_stack(sums)


def _inside(water: LevelWater) -> np.ndarray:
    """Return vertices inside of water, shape (n, 3)."""
    x, y = inside_grid(water.bounds, _INSIDE).T
    inside = water.contains(x, y)
    x, y = x[inside], y[inside]
    return np.column_stack((x, y, water.level_at(x, y)))


def _ground_near(
    lines: Sequence[np.ndarray],
    clouds: Iterable[PointCloud],
    ground: GroundClasses,
    frame: Frame,
    surface: _WaterSurface,
) -> tuple[np.ndarray, np.ndarray]:
    """Return ground and ignored ground round lines, shape (n, 3), and which is ground; add the
    points of class 9 to the surface of water.
    """
    found, are_ground = [np.zeros((0, 3))], [np.zeros(0, dtype=bool)]
    if lines:
        places = np.concatenate(lines)
        wanted = NearPlaces(places[:, 0], places[:, 1], NEAR)
        for cloud in clouds:
            is_ground = ground.of(cloud, GroundCounts())
            candidates = np.flatnonzero(is_ground | ground.points_of(cloud, (IGNORED_GROUND,)))
            near = candidates[wanted.of(*cloud.places(candidates, frame))]
            found.append(np.column_stack(cloud.points(near, frame)))
            are_ground.append(is_ground[near])
            if surface.water is not None:
                wet = np.flatnonzero(ground.points_of(cloud, (_WATER_CLASS,)))
                surface.add(np.column_stack(cloud.points(wet, frame)))
    return np.concatenate(found), np.concatenate(are_ground)
