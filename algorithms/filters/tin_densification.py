"""Improved progressive TIN densification.

References
----------
Axelsson, P. (2000): DEM generation from laser scanner data using adaptive TIN models.
International Archives of Photogrammetry and Remote Sensing 33 (B4), 110-117.
Zhao, X., Guo, Q., Su, Y., Xue, B. (2016): Improved progressive TIN densification filtering
algorithm for airborne LiDAR data in forested areas. ISPRS Journal 117, 79-91.
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
from ..terrain.densification import DensificationRules, densified
from ..terrain.ground_cells import ground_cells
from ..terrain.inpaint import inpaint
from ..terrain.model_key_points import ModelKeyPoints, model_key_points
from ..terrain.objects import largest_object, raised_objects
from ..terrain.outliers import low_outliers
from ..terrain.tin import Tin

# Side of the cells whose lowest points may become vertices of the TIN.
_CELL = 1.0
_OUTLIER_SLOPE = 5.0
# Metres between the virtual points round the survey.
_RING_SPACING = 5.0
# Heights in metres of the drops that bound an object, the tall ones first.
_OBJECT_HEIGHTS = (5.0, 4.5, 2.0)
# Metres over which the final surface is smoothed to take its slope.
_FACET_SMOOTHING = 0.7
_POINTS_A_STEP = 1_000_000
# Metres: no larger building is expected where none is seen, or looked for.
_USUAL_BUILDING, _LARGEST_BUILDING = 48.0, 150.0
# Metres beyond which points do not matter: so many times the largest building, but at least this.
_REACH_BUILDINGS, _LEAST_REACH = 2.0, 100.0


@dataclass(frozen=True)
class Preset:
    """Values for the parameters that are left empty; the building size may be left to the data."""

    label: str
    max_building_size: float | None
    iteration_angle: float
    iteration_distance: float


PRESETS = {
    "automatic": Preset("Automatic", None, 15.0, 1.4),
    "flat": Preset("Flat land, fields", 48.0, 8.0, 0.7),
    "hilly": Preset("Hilly land, forest", 30.0, 15.0, 1.4),
    "steep": Preset("Steep or rugged terrain", 30.0, 25.0, 2.0),
    "town": Preset("Town", 60.0, 12.0, 1.4),
    "city": Preset("City, large halls", 120.0, 12.0, 1.4),
    "lidar360": Preset("LiDAR360's values", 20.0, 8.0, 1.4),
}


@dataclass(frozen=True)
class TinDensification(ParameterSet):
    """Parameters of improved progressive TIN densification.

    Named as in LiDAR360's *Classify Ground Points* and TerraScan's *Ground*.
    """

    preset: str = parameter(
        "automatic",
        label="Preset",
        choices={name: preset.label for name, preset in PRESETS.items()},
        help="Where the values come from that are left empty: from the points (automatic), or from"
        " what suits a kind of terrain. The log says which values were used.",
    )
    max_building_size: float | None = parameter(
        None,
        label="Maximum building size",
        unit="m",
        minimum=1.0,
        maximum=500.0,
        kind="number",
        empty="automatic",
        help="Shorter side of the largest building or other object. Whatever is narrower and stands"
        " out from its surroundings gives no seed of the ground. Too large costs time and sharp"
        " hilltops. Empty: from the preset.",
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
    iteration_angle: float | None = parameter(
        None,
        label="Iteration angle",
        unit="deg",
        minimum=0.1,
        maximum=90.0,
        kind="number",
        empty="automatic",
        help="Largest angle between a triangle and the line from one of its corners to a new"
        " point. Larger follows rugged ground better, smaller keeps low objects out: 4 in flat,"
        " 10 and more in steep terrain. Empty: from the preset.",
    )
    iteration_distance: float | None = parameter(
        None,
        label="Iteration distance",
        unit="m",
        minimum=0.01,
        maximum=50.0,
        kind="number",
        empty="automatic",
        help="Largest distance of a new point from its triangle. Empty: from the preset.",
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
    noise_distance: float = parameter(
        0.3,
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
    only_key_points: bool = parameter(
        False,
        label="Only key points",
        advanced=True,
        help="Of the ground, keep only the points that a terrain model needs: those whose TIN lies"
        " within the two tolerances below of every other ground point.",
    )
    key_point_tolerance_above: float = parameter(
        0.15,
        label="Key points: tolerance above",
        unit="m",
        minimum=0.0,
        maximum=100.0,
        advanced=True,
        help="How far ground may lie above the TIN of the key points.",
    )
    key_point_tolerance_below: float = parameter(
        0.15,
        label="Key points: tolerance below",
        unit="m",
        minimum=0.0,
        maximum=100.0,
        advanced=True,
        help="How far ground may lie below the TIN of the key points.",
    )
    key_point_grid_size: float = parameter(
        20.0,
        label="Key points: grid size",
        unit="m",
        minimum=0.1,
        maximum=10000.0,
        advanced=True,
        help="Every cell of this size that has ground keeps at least one point.",
    )

    def resolve(self, points: Points) -> TinDensification:
        """Return the parameters with a value for each that was left to the preset.

        Parameters
        ----------
        points : Points
            The whole survey: its blocks must all be classified with the same values.
        """
        preset = PRESETS[self.preset]
        names = ("max_building_size", "iteration_angle", "iteration_distance")
        empty = {name: getattr(preset, name) for name in names if getattr(self, name) is None}
        if "max_building_size" in empty and empty["max_building_size"] is None:
            empty["max_building_size"] = _building_size(points)
        return dataclasses.replace(self, **empty)


def reach(parameters: TinDensification) -> float:
    """Return the metres beyond which a point does not matter for another."""
    size = parameters.max_building_size or PRESETS[parameters.preset].max_building_size or 0.0
    return max(_LEAST_REACH, _REACH_BUILDINGS * size)


def classify(
    points: Points,
    parameters: TinDensification,
    progress: Progress = SILENT,
    known_ground: np.ndarray | None = None,
) -> np.ndarray:
    """Tell ground from other points.

    Low outliers are taken out of the grid of lowest points; its cells that morphology takes for
    ground give the seeds of a TIN (after Zhao et al. 2016, section 2); in rounds, each
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
    known_ground : numpy.ndarray of bool, shape (n,), optional
        Points that are surely ground: seeds whatever the grid says.

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
    resolved = parameters.resolve(points)
    if resolved != parameters:
        progress.info(_in_words(resolved))
    cells = Cells.over(points, _CELL)
    lowest = cells.lowest_points(points)
    heights = np.full(cells.rows * cells.columns, np.nan)
    heights[cells.index[lowest]] = points.z[lowest]
    heights = heights.reshape(cells.shape)
    heights[low_outliers(heights, cells.size, _OUTLIER_SLOPE)] = np.nan
    progress(0.1)
    objects = _objects(points, cells, resolved, progress.part(0.1, 0.2))
    radius = resolved.max_building_size / 2.0
    ground = ground_cells(heights, cells.size, objects, radius, progress=progress.part(0.2, 0.5))
    is_seed = ground.ravel()[cells.index[lowest]]
    is_candidate = (np.isfinite(heights) & ~ground).ravel()[cells.index[lowest]]
    first = points.take(lowest[is_seed])
    if known_ground is not None and known_ground.any():
        known = points.take(known_ground)
        first = Points(*(np.concatenate(pair) for pair in zip(first, known.take(_thinned(known)))))
    if not first.count:
        raise BareEarthError(
            "No point can be taken for ground with certainty. Check the maximum building size and"
            " the selection of points."
        )
    seeds = _with_margin(first, cells, np.where(ground, heights, np.nan))
    candidates = points.take(lowest[is_candidate])
    tin = densified(seeds, candidates, _rules(resolved), progress.part(0.5, 0.8))
    found = _near_surface(points, tin, cells, resolved, progress.part(0.8, 0.95))
    return _key_points(points, found, resolved, progress.part(0.95, 1.0))


def _in_words(parameters: TinDensification) -> str:
    return (
        f"TIN densification: preset {parameters.preset}, maximum building size"
        f" {parameters.max_building_size:g} m, iteration angle {parameters.iteration_angle:g} deg,"
        f" iteration distance {parameters.iteration_distance:g} m."
    )


def _rules(parameters: TinDensification) -> DensificationRules:
    names = (each.name for each in dataclasses.fields(DensificationRules))
    return DensificationRules(**{name: getattr(parameters, name) for name in names})


def _thinned(points: Points) -> np.ndarray:
    """Return the index of the lowest point of each cell."""
    return Cells.over(points, _CELL).lowest_points(points)


def _key_points(
    points: Points, ground: np.ndarray, parameters: TinDensification, progress: Progress
) -> np.ndarray:
    """Return the key points of the ground where only they are wanted, else all of it."""
    if not parameters.only_key_points or not ground.any():
        return ground
    closeness = ModelKeyPoints(
        parameters.key_point_tolerance_above,
        parameters.key_point_tolerance_below,
        parameters.key_point_grid_size,
    )
    key = np.zeros(points.count, dtype=bool)
    key[ground] = model_key_points(points.take(ground), closeness, progress)
    return key


def _wide_cells(points: Points) -> tuple[Cells, np.ndarray]:
    """Return cells wide enough to be without gaps, and their lowest heights without outliers.

    Where points are sparse, gaps would break the rims of objects.
    """
    cells = Cells.over(points, max(_CELL, spacing(points)))
    heights = cells.minimum(points.z)
    heights[low_outliers(heights, cells.size, _OUTLIER_SLOPE)] = np.nan
    return cells, heights


def _building_size(points: Points) -> float:
    """Return the width of the largest tall object in metres, but at least the usual one."""
    cells, heights = _wide_cells(points)
    width = largest_object(heights, cells.size, _OBJECT_HEIGHTS[0], _LARGEST_BUILDING)
    return float(max(_USUAL_BUILDING, math.ceil(width)))


def _objects(
    points: Points, cells: Cells, parameters: TinDensification, progress: Progress
) -> np.ndarray:
    """Return which cells belong to tall objects bounded by drops all round."""
    wide, heights = _wide_cells(points)
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
