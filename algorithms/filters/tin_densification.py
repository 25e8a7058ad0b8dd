"""Improved progressive TIN densification.

References
----------
Axelsson, P. (2000): DEM generation from laser scanner data using adaptive TIN models.
International Archives of Photogrammetry and Remote Sensing 33 (B4), 110-117.
Zhao, X., Guo, Q., Su, Y., Xue, B. (2016): Improved progressive TIN densification filtering
algorithm for airborne LiDAR data in forested areas. ISPRS Journal 117, 79-91.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..errors import BareEarthError
from ..parameters import ParameterSet, parameter
from ..points import Points
from ..progress import SILENT, Progress
from ..terrain.cells import Cells, spacing
from ..terrain.ground_cells import Allowance, ground_cells
from ..terrain.inpaint import inpaint
from ..terrain.objects import raised_objects
from ..terrain.outliers import low_outliers
from ..terrain.tin import Tin

# Side of the cells whose lowest points may become vertices of the TIN.
_CELL = 1.0
_OUTLIER_SLOPE = 5.0
_MOST_ROUNDS = 20
# Metres between the virtual points round the survey.
_RING_SPACING = 5.0
# Heights in metres of the drops that bound an object, the tall ones first.
_OBJECT_HEIGHTS = (5.0, 4.5, 2.0)
# Metres over which the final surface is smoothed to take its slope.
_FACET_SMOOTHING = 0.7
_POINTS_A_STEP = 1_000_000
# Rounds that add less than this share of the vertices are not worth a triangulation.
_LEAST_SHARE = 0.001


@dataclass(frozen=True)
class TinDensification(ParameterSet):
    """Parameters of improved progressive TIN densification.

    Named as in LiDAR360's *Classify Ground Points* and TerraScan's *Ground*.
    """

    max_building_size: float = parameter(
        48.0,
        label="Maximum building size",
        unit="m",
        minimum=1.0,
        maximum=500.0,
        help="Shorter side of the largest building or other object. Whatever is narrower and stands"
        " out from its surroundings gives no seed of the ground.",
    )
    max_terrain_angle: float = parameter(
        88.0,
        label="Maximum terrain angle",
        unit="deg",
        minimum=1.0,
        maximum=89.9,
        help="Steepest slope of the ground. On steeper triangles a point is judged by its mirror"
        " image beyond the nearest vertex.",
    )
    iteration_angle: float = parameter(
        15.0,
        label="Iteration angle",
        unit="deg",
        minimum=0.1,
        maximum=90.0,
        help="Largest angle between a triangle and the line from one of its corners to a new"
        " point. Larger follows rugged ground better, smaller keeps low objects out: 4 in flat,"
        " 10 and more in steep terrain.",
    )
    iteration_distance: float = parameter(
        1.0,
        label="Iteration distance",
        unit="m",
        minimum=0.01,
        maximum=50.0,
        help="Largest distance of a new point from its triangle.",
    )
    reduce_angle_edge: float | None = parameter(
        5.0,
        label="Reduce iteration angle when edges are shorter than",
        unit="m",
        minimum=0.0,
        maximum=100.0,
        advanced=True,
        help="In triangles whose longest edge is shorter the iteration angle is reduced in"
        " proportion, so that low vegetation is not climbed step by step. Empty: never.",
        kind="number",
        optional=True,
    )
    stop_edge: float | None = parameter(
        2.0,
        label="Stop triangulation when edges are shorter than",
        unit="m",
        minimum=0.0,
        maximum=100.0,
        advanced=True,
        help="Triangles whose longest edge is shorter take no further point. Empty: never.",
        kind="number",
        optional=True,
    )
    seed_slope: float = parameter(
        0.15,
        label="Seed slope",
        minimum=0.01,
        maximum=5.0,
        advanced=True,
        help="Rise over run above which a bump of the lowest points is taken for an object and"
        " gives no seed. Smaller is more careful, and loses sharp ridges.",
    )
    noise_distance: float = parameter(
        0.2,
        label="Noise distance",
        unit="m",
        minimum=0.0,
        maximum=5.0,
        advanced=True,
        help="A point this close to its triangle is a vertex whatever its angle: near a corner the"
        " angle of mere noise is large.",
    )
    ground_tolerance: float = parameter(
        0.4,
        label="Ground tolerance",
        unit="m",
        minimum=0.0,
        maximum=10.0,
        advanced=True,
        help="Points within this height of the final TIN are ground, in level terrain.",
    )
    slope_tolerance: float = parameter(
        1.2,
        label="Ground tolerance on slopes",
        unit="m",
        minimum=0.0,
        maximum=10.0,
        advanced=True,
        help="What a slope of 45 degrees adds to the ground tolerance, less in proportion on"
        " gentler slopes.",
    )


def classify(
    points: Points, parameters: TinDensification, progress: Progress = SILENT
) -> np.ndarray:
    """Tell ground from other points.

    Low outliers are taken out of the grid of lowest points; its cells that a progressive opening
    leaves as they are give the seeds of a TIN (Zhao et al. 2016, section 2); in rounds, each
    triangle takes the candidate nearest to it if distance and angle allow (Axelsson 2000, section
    3); last, every point close to the final TIN is ground.

    Parameters
    ----------
    points : Points
        All points that take part.
    parameters : TinDensification
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
        If the points spread too far for a grid, or no seed of the ground is left.
    Cancelled
        If the user asked to stop.
    """
    cells = Cells.over(points, _CELL)
    lowest = cells.lowest_points(points)
    heights = np.full(cells.rows * cells.columns, np.nan)
    heights[cells.index[lowest]] = points.z[lowest]
    heights = heights.reshape(cells.shape)
    heights[low_outliers(heights, cells.size, _OUTLIER_SLOPE)] = np.nan
    progress(0.1)
    objects = _objects(points, cells, parameters, progress.part(0.1, 0.2))
    largest = parameters.max_building_size / 2.0
    ground = ground_cells(
        heights, cells.size, objects, largest, Allowance(), progress.part(0.2, 0.5)
    )
    if not ground.any():
        raise BareEarthError(
            "No point can be taken for ground with certainty. Check the maximum building size and"
            " the selection of points."
        )
    is_seed = ground.ravel()[cells.index[lowest]]
    is_candidate = (np.isfinite(heights) & ~ground & ~objects).ravel()[cells.index[lowest]]
    seeds = _with_margin(points.take(lowest[is_seed]), cells, np.where(ground, heights, np.nan))
    candidates = points.take(lowest[is_candidate])
    tin = _densified(seeds, candidates, parameters, progress.part(0.5, 0.8))
    return _near_surface(points, tin, cells, parameters, progress.part(0.8, 1.0))


def _objects(
    points: Points, cells: Cells, parameters: TinDensification, progress: Progress
) -> np.ndarray:
    """Return which cells belong to tall objects bounded by drops all round.

    Where points are sparse they are looked for among wider cells, since gaps would break the rims.
    """
    wide = Cells.over(points, max(cells.size, spacing(points)))
    heights = wide.minimum(points.z)
    heights[low_outliers(heights, wide.size, _OUTLIER_SLOPE)] = np.nan
    found = raised_objects(
        heights, wide.size, _OBJECT_HEIGHTS, parameters.max_building_size, progress
    )
    return wide.resampled(found, cells)


def _with_margin(seeds: Points, cells: Cells, heights: np.ndarray) -> Points:
    """Return the seeds and a ring of virtual points round all cells.

    Without it, ground beyond the hull of the seeds would have no triangle to be judged by.
    """
    south, west = cells.first_row * cells.size, cells.first_column * cells.size
    height, width = cells.rows * cells.size, cells.columns * cells.size
    x = west + width * np.linspace(0.0, 1.0, max(int(width / _RING_SPACING), 1) + 1)
    y = south + height * np.linspace(0.0, 1.0, max(int(height / _RING_SPACING), 1) + 1)
    ring_x = np.concatenate((x, x, np.full(len(y), west), np.full(len(y), west + width)))
    ring_y = np.concatenate((np.full(len(x), south), np.full(len(x), south + height), y, y))
    ring_z = cells.at(inpaint(heights), ring_x, ring_y)
    ring = Points(ring_x, ring_y, ring_z)
    return Points(*(np.concatenate(pair) for pair in zip(seeds, ring)))


def _densified(
    seeds: Points, candidates: Points, parameters: TinDensification, progress: Progress
) -> Tin:
    """Return the TIN of the seeds, densified by candidates in rounds."""
    tin = Tin(*seeds)
    for round_ in range(_MOST_ROUNDS):
        accepted = _round(tin, candidates, parameters)
        if len(accepted) <= _LEAST_SHARE * len(tin.x):
            break
        joined = [
            np.concatenate(pair) for pair in zip((tin.x, tin.y, tin.z), candidates.take(accepted))
        ]
        tin = Tin(*joined)
        rest = np.ones(candidates.count, dtype=bool)
        rest[accepted] = False
        candidates = candidates.take(rest)
        progress((round_ + 1) / _MOST_ROUNDS)
    return tin


def _round(tin: Tin, candidates: Points, parameters: TinDensification) -> np.ndarray:
    """Return the indices of the candidates to add, at most one of each triangle."""
    triangle = tin.locate(candidates.x, candidates.y)
    which = np.flatnonzero(triangle >= 0)
    triangle = triangle[which]
    points = candidates.take(which)
    distance, angle, longest = _distance_and_angle(tin, triangle, points, parameters)
    allowed = np.full(len(which), math.radians(parameters.iteration_angle))
    if parameters.reduce_angle_edge:
        allowed *= np.minimum(longest / parameters.reduce_angle_edge, 1.0)
    fits = (distance <= parameters.noise_distance) | (
        (distance <= parameters.iteration_distance) & (angle <= allowed)
    )
    if parameters.stop_edge:
        fits &= longest >= parameters.stop_edge
    fitting = np.flatnonzero(fits)
    order = np.lexsort((points.y[fitting], points.x[fitting], distance[fitting], triangle[fitting]))
    fitting = fitting[order]
    first = np.ones(len(fitting), dtype=bool)
    first[1:] = np.diff(triangle[fitting]) != 0
    return which[fitting[first]]


def _distance_and_angle(
    tin: Tin, triangle: np.ndarray, points: Points, parameters: TinDensification
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return distance to the facet, largest angle at its corners (rad), and its longest edge."""
    corners = tin.triangles[triangle]
    x, y, z = tin.x[corners], tin.y[corners], tin.z[corners]
    normal, longest = _facets(x, y, z)
    steep = np.arctan(np.hypot(normal[0], normal[1])) > math.radians(parameters.max_terrain_angle)
    px, py, pz = points.x.copy(), points.y.copy(), points.z
    if steep.any():
        nearest = np.argmin((x - px[:, None]) ** 2 + (y - py[:, None]) ** 2, axis=1)
        vertex = corners[np.arange(len(corners)), nearest]
        px[steep] = 2 * tin.x[vertex[steep]] - px[steep]
        py[steep] = 2 * tin.y[vertex[steep]] - py[steep]
        beyond = tin.locate(px[steep], py[steep])
        inside = np.flatnonzero(steep)[beyond >= 0]
        corners[inside] = tin.triangles[beyond[beyond >= 0]]
        x, y, z = tin.x[corners], tin.y[corners], tin.z[corners]
        normal, _ = _facets(x, y, z)
    height = pz - (z[:, 0] + normal[0] * (px - x[:, 0]) + normal[1] * (py - y[:, 0]))
    distance = np.abs(height) / np.sqrt(1.0 + normal[0] ** 2 + normal[1] ** 2)
    reach = np.sqrt((x - px[:, None]) ** 2 + (y - py[:, None]) ** 2 + (z - pz[:, None]) ** 2).min(
        axis=1
    )
    angle = np.arcsin(np.clip(distance / np.maximum(reach, 1e-9), 0.0, 1.0))
    return distance, angle, longest


def _facets(
    x: np.ndarray, y: np.ndarray, z: np.ndarray
) -> tuple[tuple[np.ndarray, np.ndarray], np.ndarray]:
    """Return the gradient of each facet, in x and y, and its longest edge in the plane."""
    ux, uy, uz = x[:, 1] - x[:, 0], y[:, 1] - y[:, 0], z[:, 1] - z[:, 0]
    vx, vy, vz = x[:, 2] - x[:, 0], y[:, 2] - y[:, 0], z[:, 2] - z[:, 0]
    area = np.maximum(ux * vy - uy * vx, 1e-12)
    gradient = (uz * vy - uy * vz) / area, (ux * vz - uz * vx) / area
    edges = ux**2 + uy**2, vx**2 + vy**2, (vx - ux) ** 2 + (vy - uy) ** 2
    return gradient, np.sqrt(np.maximum.reduce(edges))


def _near_surface(
    points: Points, tin: Tin, cells: Cells, parameters: TinDensification, progress: Progress
) -> np.ndarray:
    """Return which points lie close to the TIN, sampled once in each cell.

    The slope is that of the smoothed surface: single facets between lowest points are too uneven.
    """
    from scipy import ndimage

    surface = inpaint(tin.interpolate(*cells.centres()).reshape(cells.shape))
    progress(0.4)
    smooth = ndimage.gaussian_filter(surface, _FACET_SMOOTHING / cells.size, mode="nearest")
    # A grid one cell wide has no slope across.
    slopes = [np.gradient(smooth, cells.size, axis=k) for k in (0, 1) if cells.shape[k] > 1]
    slope = np.sqrt(sum((each**2 for each in slopes), np.zeros(cells.shape)))
    tolerance = parameters.ground_tolerance + parameters.slope_tolerance * slope
    ground = np.empty(points.count, dtype=bool)
    for first in range(0, points.count, _POINTS_A_STEP):
        part = slice(first, first + _POINTS_A_STEP)
        place = points.x[part], points.y[part]
        distance = np.abs(points.z[part] - cells.at(surface, *place))
        ground[part] = distance <= cells.at(tolerance, *place)
        progress(0.4 + 0.6 * min((first + _POINTS_A_STEP) / points.count, 1.0))
    return ground
