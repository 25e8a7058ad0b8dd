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
from ..parameters import ParameterSet, parameter, parameter_of
from ..points import Points
from ..progress import SILENT, Progress
from ..terrain.cells import Cells
from ..terrain.doubts import tell_of_outliers
from ..terrain.densification import DensificationRules, densified, with_lower
from ..terrain.breaks import at_breaks
from ..terrain.gradient import steepness
from ..terrain.ground_cells import ground_cells
from ..terrain.inpaint import inpaint
from ..terrain.lowest_points import LowestPoints
from ..terrain.model_key_points import ModelKeyPoints, model_key_points
from ..terrain.near_surface import near_surface
from ..threads import in_threads

# Side of the cells whose lowest points may become vertices of the TIN.
_CELL = 1.0
# Metres over which the final surface is smoothed to take its slope.
_FACET_SMOOTHING = 0.7
# Rows next to a cell that have a part in its slope then.
_SMOOTHING_REACH = math.ceil(4.0 * _FACET_SMOOTHING / _CELL) + 1
# Cells that are worked on at a time: they stay in the processor's cache.
_CELLS_A_STRIP = 1 << 16
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
        0.18,
        label="Ground tolerance above",
        unit="m",
        minimum=0.0,
        maximum=10.0,
        advanced=True,
        help="Points no higher above the final surface are ground, in level terrain. More takes in"
        " grass and low bushes.",
    )
    ground_tolerance_below: float = parameter(
        0.6,
        label="Ground tolerance below",
        unit="m",
        minimum=0.0,
        maximum=10.0,
        advanced=True,
        help="Points no deeper below the final surface are ground, in level terrain: it lies"
        " through the lowest points, and is smooth where they are not.",
    )
    slope_tolerance: float = parameter(
        1.4,
        label="Ground tolerance on slopes",
        unit="m",
        minimum=0.0,
        maximum=10.0,
        advanced=True,
        help="What a slope of 45 degrees adds to both ground tolerances, less in proportion on"
        " gentler slopes.",
    )
    only_key_points: bool = parameter(
        False,
        label="Only key points",
        advanced=True,
        help="Of the ground, keep only the points that a terrain model needs: those whose TIN lies"
        " within the two tolerances below of every other ground point.",
    )
    key_point_tolerance_above: float = parameter_of(
        ModelKeyPoints, "tolerance_above", label="Key points: tolerance above", advanced=True
    )
    key_point_tolerance_below: float = parameter_of(
        ModelKeyPoints, "tolerance_below", label="Key points: tolerance below", advanced=True
    )
    key_point_grid_size: float = parameter_of(
        ModelKeyPoints, "grid_size", label="Key points: grid size", advanced=True
    )

    def resolve(self, points: Points) -> TinDensification:
        """Return the parameters with a value for each that was left to the preset.

        Parameters
        ----------
        points : Points
            The whole survey: its blocks must all be classified with the same values.
        """
        return self._resolved(LowestPoints(points, _CELL))

    def _resolved(self, survey: LowestPoints) -> TinDensification:
        preset = PRESETS[self.preset]
        names = ("max_building_size", "iteration_angle", "iteration_distance")
        empty = {name: getattr(preset, name) for name in names if getattr(self, name) is None}
        if "max_building_size" in empty and empty["max_building_size"] is None:
            width = survey.tall.largest(_LARGEST_BUILDING)
            empty["max_building_size"] = float(max(_USUAL_BUILDING, math.ceil(width)))
        return dataclasses.replace(self, **empty)


def largest_object(parameters: TinDensification) -> float:
    """Return the width in metres of the largest building that is looked for in any case."""
    size = parameters.max_building_size or PRESETS[parameters.preset].max_building_size
    return size or _USUAL_BUILDING


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
    3); last, every point close to the surface through all vertices is ground.

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
    survey = LowestPoints(points, _CELL)
    progress(0.1)
    resolved = parameters._resolved(survey)
    if resolved != parameters:
        progress.info(_in_words(resolved))
    tell_of_outliers(len(survey.lowest), survey.heights, progress)
    cells = survey.cells
    which, seeds, free = _seeds(survey, resolved)
    if MODE:
        moved = points._replace(x=points.x + 0.5 * _CELL, y=points.y + 0.5 * _CELL)
        other = _seeds(LowestPoints(moved, _CELL), resolved)
        state = np.zeros((2, points.count), dtype=np.int8)
        for k, (w, s, f) in enumerate(((which, seeds, free), other)):
            state[k, w] = 1 + s.astype(np.int8) + 0  # 1 candidate, 2 seed
            state[k, w[~f & ~s]] = 3  # object or outlier
        which = np.flatnonzero(state.any(axis=0))
        a, b = state[:, which]
        if MODE == 1:
            seeds = (a == 2) | (b == 2)
        elif MODE in (2, 3, 5):
            seeds = ((a == 2) & ((b == 2) | (b == 0))) | ((b == 2) & (a == 0))
        free = ~((a == 3) | (b == 3)) if MODE == 2 else ((a == 1) | (b == 1) | (a == 2) | (b == 2))
        if MODE == 5:
            free = ((a == 1) | (a == 2)) & ((b == 1) | (b == 2)) | (a == 2) | (b == 2)
    seeds = at_breaks(points, which, seeds, free, survey.spacing, cells)
    first, waiting = which[seeds], which[~seeds & free]
    heights = with_lower(np.full(cells.shape, np.nan), cells, points, first)
    if known_ground is not None and known_ground.any():
        known = _lowest_of(points, np.flatnonzero(known_ground))
        first, heights = np.append(first, known), with_lower(heights, cells, points, known)
    if not len(first):
        raise BareEarthError(
            "No point can be taken for ground with certainty. Check the maximum building size and"
            " the selection of points."
        )
    rules, part = _rules(resolved), progress.part(0.7, 0.8)
    joined = densified(points, first, waiting, heights, cells, survey.spacing, rules, part)
    from ..terrain.final import final_limits
    limits = final_limits(points, np.append(first, joined), cells, survey.spacing, resolved)
    found = near_surface(points, cells, limits, progress.part(0.8, 0.95))
    return _key_points(points, found, resolved, progress.part(0.95, 1.0))


MODE = 3


def _seeds(survey: LowestPoints, resolved: TinDensification):
    heights = survey.heights
    objects = survey.objects(resolved.max_building_size, SILENT)
    radius = resolved.max_building_size / 2.0
    ground = ground_cells(heights, _CELL, objects, radius, first=survey.cells.first)
    seeds = ground.ravel()[survey.cell]
    free = np.isfinite(heights).ravel()[survey.cell] & ~objects.ravel()[survey.cell]
    return survey.lowest, seeds, free


def _in_words(parameters: TinDensification) -> str:
    return (
        f"TIN densification: preset {parameters.preset}, maximum building size"
        f" {parameters.max_building_size:g} m, iteration angle {parameters.iteration_angle:g} deg,"
        f" iteration distance {parameters.iteration_distance:g} m."
    )


def _lowest_of(points: Points, which: np.ndarray) -> np.ndarray:
    """Return the indices of the lowest of some points in each cell."""
    some = points.take(which)
    return which[Cells.over(some, _CELL).lowest_points(some)]


def _rules(parameters: TinDensification) -> DensificationRules:
    names = (each.name for each in dataclasses.fields(DensificationRules))
    return DensificationRules(**{name: getattr(parameters, name) for name in names})


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


def _limits(surface: np.ndarray, parameters: TinDensification) -> np.ndarray:
    """Return between which heights points are ground, shape (rows, columns, 2).

    The slope that adds to the tolerances is that of the smoothed surface: between single lowest
    points it is too uneven.
    """
    from scipy import ndimage

    rows, columns = surface.shape
    limits = np.empty((rows, columns, 2))
    strip = max(_CELLS_A_STRIP // columns, _SMOOTHING_REACH)

    def fill(first: int) -> None:
        last, before = min(first + strip, rows), min(first, _SMOOTHING_REACH)
        part = surface[first - before : last + _SMOOTHING_REACH]
        smooth = ndimage.gaussian_filter(part, _FACET_SMOOTHING / _CELL, mode="nearest")
        inside = slice(before, before + last - first)
        rise = parameters.slope_tolerance * steepness(smooth, _CELL)[inside]
        limits[first:last, :, 0] = part[inside] - parameters.ground_tolerance_below - rise
        limits[first:last, :, 1] = part[inside] + parameters.ground_tolerance + rise

    in_threads(fill, range(0, rows, strip))
    return limits
