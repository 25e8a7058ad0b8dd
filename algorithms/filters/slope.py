"""Slope filter, exact on one scale or on many.

References
----------
Vosselman, G. (2000): Slope based filtering of laser altimetry data. International Archives of
Photogrammetry and Remote Sensing 33 (B3), 935-942.
Lindsay, J. (2025): WhiteboxTools, LidarGroundPointFilter. https://www.whiteboxgeo.com/manual/
Pingel, T., Clarke, K., McBride, W. (2013): An improved simple morphological filter for the terrain
classification of airborne LIDAR data. ISPRS Journal 77, 21-30.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass

import numpy as np

from ..errors import BareEarthError
from ..parameters import ParameterSet, parameter
from ..points import Points
from ..progress import SILENT, Progress
from ..terrain.cells import Cells, spacing
from ..terrain.doubts import tell_of_outliers
from ..terrain.gradient import gradient, steepness
from ..terrain.inpaint import inpaint
from ..terrain.low_clusters import low_clusters
from ..terrain.morphology import erosion
from ..terrain.near_surface import near_surface
from ..terrain.outliers import low_outliers
from ..terrain.standing_above import Rule, stands_above

# Metres between points up to which the automatic radius and cells are the least.
_DENSE = 2.5
# Radii grow by this factor from scale to scale: the area of the disc doubles.
_SCALE_STEP = math.sqrt(2.0)
# Rise over run of the sides of a pit that holds low outliers, one cell wide or a few metres.
_OUTLIER_SLOPE = 5.0
_CLUSTER_SLOPE = 2.0
_CLUSTER_WIDTH = 6.0
# They must lie below the terrain within this many search radii: the ground seen through a hole in
# a large roof is a pit as well, but there is ground as low beyond the roof.
_SURROUNDINGS = 3.0
# Metres beyond which points do not matter: so many times the search radius, on one scale just what
# erosion, dilation and comparison need, and at least this where it follows from the points.
_REACH_RADII, _REACH_RADII_ON_ONE_SCALE, _LEAST_REACH = 5.0, 3.01, 100.0
_WHITEBOX_RADIUS = 2.0
# Least search radius (m), slope threshold (deg) and height threshold (m) of each preset that
# looks at many scales.
_MANY_SCALES = {
    "automatic": (18.0, 15.0, 0.5),
    "flat": (24.0, 15.0, 0.4),
    "hilly": (15.0, 15.0, 0.5),
    "steep": (12.0, 20.0, 0.5),
    "town": (24.0, 15.0, 0.5),
    "city": (50.0, 15.0, 0.5),
}


@dataclass(frozen=True)
class SlopeFilter(ParameterSet):
    """Parameters of the slope filter, named as in Whitebox's *LidarGroundPointFilter*.

    Those left empty are taken from the preset; `resolve` says which.
    """

    preset: str = parameter(
        "automatic",
        label="Preset",
        choices={
            "automatic": "Automatic (many scales, follows the terrain)",
            "flat": "Flat land, fields",
            "hilly": "Hilly land, forest",
            "steep": "Steep or rugged terrain",
            "town": "Town",
            "city": "City, large halls",
            "whitebox": "Whitebox (one scale, 2 m, 45 deg, 1 m)",
        },
        help="Automatic finds buildings as well as shrubs; the kinds of terrain do so with other"
        " values for what is left empty. Whitebox is the classic filter with the"
        " values of WhiteboxTools: its radius of 2 m cannot see a building.",
    )
    search_radius: float | None = parameter(
        None,
        label="Search radius",
        unit="m",
        minimum=0.1,
        maximum=500.0,
        kind="number",
        empty="automatic",
        help="How far a point is compared with its neighbours, the largest distance in the"
        " automatic preset: at least half the shorter side of the largest building. Empty: 18 m"
        " (more if points are sparse), or 2 m in the preset Whitebox.",
    )
    min_neighbours: int = parameter(
        0,
        label="Minimum number of neighbours",
        unit="points",
        minimum=0,
        maximum=10_000,
        help="A point with fewer neighbours within the search radius is compared with this many"
        " nearest ones. For the preset Whitebox only.",
    )
    slope_threshold: float | None = parameter(
        None,
        label="Slope threshold",
        unit="deg",
        minimum=0.0,
        maximum=88.0,
        kind="number",
        empty="automatic",
        help="A point is not ground if it stands above a neighbour at a steeper slope than this;"
        " in the automatic preset, steeper by this than the terrain round it. Empty: 15 deg, or"
        " 45 deg in the preset Whitebox.",
    )
    height_threshold: float | None = parameter(
        None,
        label="Height threshold",
        unit="m",
        minimum=0.0,
        maximum=100.0,
        kind="number",
        empty="automatic",
        help="Only points that stand above a neighbour by at least this much are not ground."
        " Empty: 0.5 m, or 1 m in the preset Whitebox.",
    )
    slope_norm: bool = parameter(
        True,
        label="Slope normalisation",
        help="Compare heights above a surface that follows the terrain (white top-hat) instead of"
        " heights, so that sloping ground is not lost.",
    )
    cell_size: float | None = parameter(
        None,
        label="Cell size",
        unit="m",
        minimum=0.05,
        maximum=50.0,
        kind="number",
        empty="automatic",
        advanced=True,
        help="Side of the cells whose lowest points are compared in the automatic preset. Empty:"
        " 1 m, more if points are sparse.",
    )
    slope_tolerance: float = parameter(
        1.2,
        label="Height tolerance on slopes",
        unit="m",
        minimum=0.0,
        maximum=10.0,
        advanced=True,
        help="What a slope of 45 degrees adds to the height threshold when, in the automatic"
        " preset, points are compared with the ground that was found. Less in proportion on"
        " gentler slopes.",
    )

    def resolve(self, points: Points) -> SlopeFilter:
        """Return the parameters with a value for each that was left empty.

        Parameters
        ----------
        points : Points
            The whole survey: its blocks must all be classified with the same values.

        Returns
        -------
        SlopeFilter
            Equal to this one if nothing was empty.
        """
        if self.preset == "whitebox":
            chosen = {
                "search_radius": _WHITEBOX_RADIUS,
                "slope_threshold": 45.0,
                "height_threshold": 1.0,
            }
        else:
            radius, slope, height = _MANY_SCALES[self.preset]
            chosen = {"slope_threshold": slope, "height_threshold": height}
            if self.search_radius is None or self.cell_size is None:
                apart = spacing(points, _DENSE)
                chosen["search_radius"] = max(radius, round(4.0 * apart, 1))
                chosen["cell_size"] = max(1.0, round(0.4 * apart, 1))
        empty = {name: value for name, value in chosen.items() if getattr(self, name) is None}
        return dataclasses.replace(self, **empty)


def largest_object(parameters: SlopeFilter) -> float:
    """Return the width in metres of the largest building that is looked for, about."""
    if parameters.preset == "whitebox":
        return 2.0 * (parameters.search_radius or _WHITEBOX_RADIUS)
    return 2.0 * (parameters.search_radius or _MANY_SCALES[parameters.preset][0])


def reach(parameters: SlopeFilter) -> float:
    """Return the metres beyond which a point does not matter for another."""
    if parameters.preset == "whitebox":
        metres = _REACH_RADII_ON_ONE_SCALE * (parameters.search_radius or _WHITEBOX_RADIUS)
        return max(_LEAST_REACH, metres) if parameters.min_neighbours else metres
    radius = parameters.search_radius or _MANY_SCALES[parameters.preset][0]
    return max(_LEAST_REACH, _REACH_RADII * radius)


def classify(points: Points, parameters: SlopeFilter, progress: Progress = SILENT) -> np.ndarray:
    """Tell ground from other points.

    A point is not ground if it stands above a neighbour by at least the height threshold and at a
    slope above the slope threshold (Vosselman 2000, section 2).

    Parameters
    ----------
    points : Points
        All points that take part.
    parameters : SlopeFilter
        Distances in metres, angles in degrees.
    progress : Progress
        Receives progress and messages.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
        True for ground.

    Raises
    ------
    BareEarthError
        If the points spread too far for a grid, or no ground is found.
    Cancelled
        If the user asked to stop.
    """
    resolved = parameters.resolve(points)
    if resolved != parameters:
        progress.info(_in_words(resolved))
    if resolved.preset == "whitebox":
        return _on_one_scale(points, resolved, progress)
    return _on_many_scales(points, resolved, progress)


def _in_words(parameters: SlopeFilter) -> str:
    if parameters.preset == "whitebox":
        last = f"minimum number of neighbours {parameters.min_neighbours}"
    else:
        last = f"cell size {parameters.cell_size:g} m"
    return (
        f"Slope filter: preset {parameters.preset}, search radius {parameters.search_radius:g} m,"
        f" slope threshold {parameters.slope_threshold:g} deg, height threshold"
        f" {parameters.height_threshold:g} m, {last}."
    )


def _on_one_scale(points: Points, parameters: SlopeFilter, progress: Progress) -> np.ndarray:
    """Return the ground mask of the classic filter: every point against all its neighbours."""
    rule = Rule(
        parameters.search_radius,
        parameters.height_threshold,
        math.tan(math.radians(parameters.slope_threshold)),
        parameters.slope_norm,
    )
    above = stands_above(points, rule, parameters.min_neighbours, progress)
    progress(1.0)
    return ~above


def _on_many_scales(points: Points, parameters: SlopeFilter, progress: Progress) -> np.ndarray:
    """Return the ground mask of the filter on the lowest points of cells, scale by scale."""
    cells = Cells.over(points, parameters.cell_size)
    lowest = cells.minimum(points.z)
    progress(0.2)
    count = np.count_nonzero(np.isfinite(lowest))
    # One after the other: a deep outlier would hide a shallow one beside it.
    lowest[low_outliers(lowest, cells.size, _OUTLIER_SLOPE, cells.first)] = np.nan
    around = _SURROUNDINGS * parameters.search_radius
    pits = low_clusters(lowest, cells.size, _CLUSTER_SLOPE, _CLUSTER_WIDTH, around, cells.first)
    lowest[pits] = np.nan
    tell_of_outliers(count, lowest, progress)
    objects = _objects(lowest, cells, parameters, progress.part(0.3, 0.6))
    lowest[objects] = np.nan
    if not np.isfinite(lowest).any():
        raise BareEarthError(
            "No point can be taken for ground with certainty. Check the thresholds and the"
            " selection of points."
        )
    surface = inpaint(lowest, first=cells.first)
    rise = parameters.slope_tolerance * steepness(surface, cells.size)
    tolerance = parameters.height_threshold + rise
    limits = np.stack((surface - tolerance, surface + tolerance), axis=-1)
    return near_surface(points, cells, limits, progress.part(0.6, 1.0))


def _objects(
    lowest: np.ndarray, cells: Cells, parameters: SlopeFilter, progress: Progress
) -> np.ndarray:
    """Return which cells stand above another, on any scale, by more than the terrain allows.

    The allowance at a distance is that of the disc's radius: a staircase on Vosselman's line.
    """
    known, size = np.isfinite(lowest), cells.size
    reach = max(round(parameters.search_radius / size, 6), 1.0)
    # Single precision (better than a millimetre) halves the time that the discs take.
    heights = np.where(known, lowest, np.inf).astype(np.float32)
    eroded = erosion(heights, reach)
    slope = math.tan(math.radians(parameters.slope_threshold)) + _slope(eroded, cells, reach)
    if parameters.slope_norm:
        opened = -erosion(np.where(np.isfinite(eroded), -eroded, np.float32(np.inf)), reach)
        heights[known] -= opened[known]
    objects = np.zeros(lowest.shape, dtype=bool)
    # Rounded, as a radius that falls short of whole cells by rounding alone would be another disc.
    scales = range(int(2.0 * math.log2(reach)) + 1)
    radii = [round(reach / _SCALE_STEP**scale, 6) for scale in scales]
    for done, radius in enumerate(reversed(radii), start=1):
        allowed = np.maximum(slope * radius * size, parameters.height_threshold)
        objects |= known & (heights > erosion(heights, radius) + allowed)
        progress(done / len(radii))
    return objects


def _slope(eroded: np.ndarray, cells: Cells, reach: float) -> np.ndarray:
    """Return the slope of the terrain, rise over run, averaged over about the search radius.

    The eroded surface has no objects. Its gradient is averaged, not its height, which a border
    would flatten.
    """

    from scipy import ndimage

    surface = inpaint(np.where(np.isfinite(eroded), eroded, np.nan), first=cells.first)
    window = 2 * max(round(reach / 2), 1) + 1
    slopes = gradient(surface, cells.size)
    for _ in range(2):
        slopes = [ndimage.uniform_filter(each, window, mode="nearest") for each in slopes]
    return np.hypot(*slopes)
