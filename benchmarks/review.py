"""Measures what a reviewer's answers to places to review are worth, on labelled tiles.

Each tile is classified by each method. The first places to review are answered as somebody would
who sees the profile with its points and knows the land: by the TIN of the reference's ground. Then
the tile is classified again with the answers.
"""

from __future__ import annotations

import argparse
from collections import Counter
from typing import NamedTuple, Sequence

import numpy as np

from bare_earth.algorithms.classes.corrections import NO_CORRECTIONS, Corrections
from bare_earth.algorithms.classes.point_counts import PointCounts
from bare_earth.algorithms.classes.selection import Selection
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.grids.cells import Cells
from bare_earth.algorithms.grids.continued_ground import continued_ground
from bare_earth.algorithms.grids.expected_error import CELL, expected_error
from bare_earth.algorithms.report.units import Units
from bare_earth.algorithms.survey.area import Area, Polygon
from bare_earth.algorithms.tools.review.places import Rasters, Review, places_of

from . import data
from .clouds import classify_cloud
from .expected_error import Terrain, tin
from .measure import GROUND, Filter
from .work import side_by_side

TILES = ("hillside_images.laz", "ahn3_urban.laz")
_ANSWERED = 25  # places
_RIGHT = 0.3  # metres: a terrain is right where 95 of 100 cells of a place are this near
_MOSTLY = 0.5  # share of the points that an answer changes which must be right


class Reviewed(NamedTuple):
    """RMSE of the terrain before and after answers, in metres: of all cells, and in the places
    whose answer changes classes; and with only the answers *right*.
    """

    tile: str
    method: str
    answers: Counter[str]
    before: float
    after: float
    in_places: tuple[float, float]
    only_right: float


class Land(NamedTuple):
    """A tile, its true terrain, and the grid of its terrain models."""

    points: Points  # that take part
    terrain: Terrain
    cells: Cells

    def model(self, terrain: Terrain) -> np.ndarray:
        """Return the heights of a terrain at the centres of cells, (rows, columns) from south."""
        y, x = (
            (first + np.arange(count) + 0.5) * CELL
            for first, count in zip(self.cells.first, self.cells.shape)
        )
        centres = (axis.ravel() for axis in np.meshgrid(x, y))
        return terrain(*centres).reshape(self.cells.shape)

    def answer(self, error: np.ndarray, inside: np.ndarray, ground: np.ndarray) -> str:
        """Return the answer to a place, given the errors of its cells and the points in it."""
        known = error[np.isfinite(error)]
        if not len(known) or np.quantile(np.abs(known), 0.95) <= _RIGHT:
            return "right"
        is_high = (np.maximum(known, 0) ** 2).sum() > (np.minimum(known, 0) ** 2).sum()
        if not is_high:
            new = continued_ground(self.points, ground, inside) & ~ground
            if self._true_share(new) > _MOSTLY:
                return "ground"
        # Ground that is no ground is seen in the profile, above the land or below it.
        return "not ground" if self._true_share(inside & ground) < 1 - _MOSTLY else "skip"

    def _true_share(self, chosen: np.ndarray) -> float:
        """Return the share of some points that lie on the land; NaN without any."""
        x, y, z = self.points.take(chosen)
        return float(np.mean(np.abs(z - self.terrain(x, y)) <= _RIGHT)) if len(z) else np.nan


def rmse(error: np.ndarray) -> float:
    """Return the root mean square of the errors that are known."""
    return float(np.sqrt(np.nanmean(error**2))) if np.isfinite(error).any() else np.nan


def reviewed(job: tuple[str, str]) -> Reviewed:
    """Return what answers are worth on a tile, by a method."""
    name, method = job
    cloud, reference = data.load(data.real(name))
    takes_part = Selection().choose(cloud, PointCounts())
    every = cloud.points(np.ones(cloud.count, dtype=bool))
    points, parameters = every.take(takes_part), Filter(method).parameters

    def classified(corrections: Corrections = NO_CORRECTIONS) -> np.ndarray:
        classes, _ = classify_cloud(cloud, parameters, corrections=corrections)
        return (classes == GROUND)[takes_part]

    ground = classified()
    cells, expected = expected_error(points, ground)
    land = Land(points, tin(every.take(reference == GROUND)), cells)
    truth, terrain = land.model(land.terrain), land.model(tin(points.take(ground)))
    expected = np.where(np.isfinite(terrain), expected, np.nan).astype(np.float32)
    how, rasters = Review(), Rasters(expected, terrain.astype(np.float32), None, CELL)
    places = places_of(rasters, how, how.limit(expected), Units())[0][:_ANSWERED]
    corner = np.array(cells.first[::-1]) + 0.5
    rings = [tuple((ring[:, ::-1] + corner) * CELL for ring in place.rings) for place in places]
    polygons: list[Polygon] = [tuple(ring + cloud.frame.origin for ring in one) for one in rings]
    answers, changed = [], np.zeros(cells.shape, dtype=bool)
    for place, polygon in zip(places, rings):
        inside = Area(None, (polygon,)).contains(points.x, points.y)
        answers.append(land.answer((terrain - truth)[place.window][place.cells], inside, ground))
        if answers[-1] in ("ground", "not ground"):
            changed[place.window] |= place.cells
    found = Corrections(tuple(polygons), (None,) * len(places), tuple(answers))
    right = Corrections(tuple(polygons), (None,) * len(places), ("right",) * len(places))
    after = land.model(tin(points.take(classified(found)))) - truth
    return Reviewed(
        name.partition(".")[0], method, Counter(answers), rmse(terrain - truth), rmse(after),
        (rmse((terrain - truth)[changed]), rmse(after[changed])),
        rmse(land.model(tin(points.take(classified(right)))) - truth),
    )  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> None:
    """Print a table of the tiles and methods."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--tiles", nargs="+", default=TILES, help="names of files")
    chosen = parser.parse_args(arguments)
    print("| Tile | Method | right, ground, not ground, skip | RMSE, m | in places | only right |")
    print("|---|---|--:|--:|--:|--:|")
    jobs = [(tile, method) for tile in chosen.tiles for method in METHODS]
    for one in side_by_side(reviewed, jobs):
        counts = ", ".join(str(one.answers[a]) for a in ("right", "ground", "not ground", "skip"))
        inside = "{:.3f} -> {:.3f}".format(*one.in_places)
        row = one.tile, one.method, counts, f"{one.before:.3f} -> {one.after:.3f}", inside
        print(f"| {' | '.join(row)} | {one.only_right:.3f} |", flush=True)


if __name__ == "__main__":
    main()
