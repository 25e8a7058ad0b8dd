"""Water and breaklines of the user as files, with the heights that they have in the terrain."""

from __future__ import annotations

from typing import Iterable, Iterator, NamedTuple

import numpy as np

from ...crs.system import Crs
from ...grids.lines import along
from ...las.cloud import PointCloud, survey_frame
from ...survey.area import Polygon
from ...survey.feature_files import Feature
from ...survey.ground_classes import GroundClasses
from ..rasters.constraints import STATION, Constraints
from ..rasters.fixed_terrain import PER_CELL, GivenTerrain
from ..rasters.level_water import LevelWater

# What stands for the grade of certainty of water that was not found.
_GRADE = "given"


class GivenWater(NamedTuple):
    """Water and breaklines of the user, in the CRS of the points."""

    polygons: tuple[Polygon, ...]  # as given
    waters: tuple[LevelWater, ...]  # the levels of the polygons
    # number, and corners in metres, float64 (n, 3); twice, for either side, if given without
    # heights
    breaklines: tuple[tuple[int, np.ndarray], ...]
    crs: Crs

    @classmethod
    def of(
        cls,
        constraints: Constraints,
        clouds: Iterable[PointCloud],
        crs: Crs,
        ground: GroundClasses,
        cell: float,
    ) -> GivenWater:
        """Return water and breaklines, in the CRS of the points, with the heights that
        `fixed_terrain` gives them.
        """
        given = GivenTerrain.of(constraints, clouds, survey_frame(crs), ground, cell / PER_CELL)
        lines = (
            (number, each)
            for number, line in enumerate(given.lines, start=1)
            for each in _with_heights(line, given)
        )
        return cls(constraints.water_outlines, tuple(given.waters), tuple(lines), crs)

    def features(self) -> Iterator[Feature]:
        """Yield the polygons with the fields of found water; what is not known is empty."""
        up, none = self.crs.vertical_unit, float("nan")
        for number, (rings, each) in enumerate(zip(self.polygons, self.waters), start=1):
            kind = "river" if each.rivers else "lake"
            high, low = (round(level / up, 3) for level in each.levels)
            area = round(each.area, 3)
            values = number, kind, high, low, none, none, _GRADE, area, none, none, none
            yield Feature(values, [_closed(ring) for ring in rings])

    def lines(self) -> Iterator[Feature]:
        """Yield shores, islands, rivers and breaklines, if their heights are known."""
        across, up = self.crs.horizontal_unit, self.crs.vertical_unit
        units = across, across, up
        for number, each in enumerate(self.waters, start=1):
            if each.is_known:
                for place, ring in enumerate(each.rings):
                    yield Feature((number, "island" if place else "shore"), ring / units)
                for line in each.rivers:
                    yield Feature((number, "river"), line / units)
        for number, line in self.breaklines:
            yield Feature((number, "breakline"), line / units)


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
