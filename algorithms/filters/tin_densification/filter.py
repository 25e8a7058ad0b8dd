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
from dataclasses import dataclass

import numpy as np

from ...core.errors import BareEarthError
from ...core.parameters import ParameterSet, parameter, parameter_of
from ...core.points import Points
from ...core.progress import SILENT, Progress
from ...core.threads import in_threads
from ...grids.cells import Cells, spacing
from ...grids.model_key_points import ModelKeyPoints, model_key_points
from ..shared.allowance import CLASSIC as CLASSIC_ALLOWANCE
from ..shared.breaks import checked_seeds
from ..shared.doubts import tell_of_outliers
from ..shared.ground_limits import (
    DENSE_SPACING,
    NOISE_SPACING,
    Tolerance,
    plain_limits,
)
from ..shared.lowest_points import LowestPoints
from ..shared.near_ground import with_banks
from ..shared.near_surface import near_surface
from .densification import DensificationRules, densified, with_lower
from .seeds import seeds_of_one_grid, seeds_of_two_grids

# Side in metres of the cells whose lowest points may become vertices of the TIN, unless points are
# farther apart. The second is for points so dense that their noise is measured.
_CELL, _DENSE_CELL = 1.0, 0.5
# Least spacing of points in metres; a smaller one counts as this.
_LEAST_SPACING = 0.01
# Points affect each other within so many times the largest building, and within at least so many
# metres.
_REACH_BUILDINGS, _LEAST_REACH = 1.2, 100.0
# One of the eight cells round a candidate must be within so many metres of its height, apart from
# the rise of the seeds' surface. Ground continues, but bushes below trees have points at any
# height.
_LEVEL = 0.3
# The preset with the rules of another program.
CLASSIC = "lidar360"


@dataclass(frozen=True)
class Preset:
    """Values for the parameters that are left empty."""

    label: str
    max_building_size: float
    iteration_angle: float
    iteration_distance: float


PRESETS = {
    "automatic": Preset("Automatic", 150.0, 15.0, 1.4),
    "flat": Preset("Flat land, fields", 48.0, 8.0, 0.7),
    "hilly": Preset("Hilly land, forest", 30.0, 15.0, 1.4),
    "steep": Preset("Steep or rugged terrain", 30.0, 25.0, 2.0),
    "town": Preset("Town", 60.0, 12.0, 1.4),
    "city": Preset("City, large halls", 120.0, 12.0, 1.4),
    CLASSIC: Preset("LiDAR360's values", 20.0, 8.0, 1.4),
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
        help="Sets the fields that are left empty: from the points (automatic), or to values that"
        " suit a kind of terrain. The log says which values were used.",
    )
    max_building_size: float | None = parameter(
        None,
        label="Maximum building size",
        unit="m",
        minimum=1.0,
        maximum=500.0,
        kind="number",
        empty="automatic",
        help="Shorter side of the largest building or other object. Nothing that is narrower and"
        " stands out from its surroundings can be a seed of the ground. A value that is too large"
        " takes longer and loses sharp hilltops. Empty: from the preset.",
    )
    max_terrain_angle: float = parameter(
        88.0,
        label="Maximum terrain angle",
        unit="deg",
        minimum=1.0,
        maximum=89.9,
        help="Steepest slope of the ground. In steeper triangles, the mirror image of a point"
        " beyond the nearest vertex is judged in its place.",
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
        " point. A larger angle follows rugged ground better, a smaller one keeps low objects out:"
        " 4 deg in flat terrain, 10 deg and more in steep terrain. Empty: from the preset.",
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
        help="In triangles whose longest edge is shorter than this, the iteration angle is reduced"
        " in proportion. So the TIN does not climb low vegetation step by step. Empty: the angle"
        " is never reduced.",
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
        help="Triangles whose longest edge is shorter than this take no more points. Empty: all"
        " triangles can take points.",
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
        help="A point that is closer to its triangle than this joins the TIN whatever its angle."
        " Near a corner, noise alone makes a large angle.",
    )
    ground_tolerance: float = parameter(
        0.18,
        label="Ground tolerance above",
        unit="m",
        minimum=0.0,
        maximum=10.0,
        advanced=True,
        help="In level terrain, points up to this height above the final surface are ground. A"
        " larger value takes in grass and low bushes.",
    )
    ground_tolerance_below: float = parameter(
        0.6,
        label="Ground tolerance below",
        unit="m",
        minimum=0.0,
        maximum=10.0,
        advanced=True,
        help="In level terrain, points down to this depth below the final surface are ground. The"
        " surface goes through the lowest points, but is smoother than they are.",
    )
    slope_tolerance: float = parameter(
        1.4,
        label="Ground tolerance on slopes",
        unit="m",
        minimum=0.0,
        maximum=10.0,
        advanced=True,
        help="Added to both ground tolerances on a slope of 45 degrees. On gentler slopes less is"
        " added, in proportion.",
    )
    only_key_points: bool = parameter(
        False,
        label="Only key points",
        advanced=True,
        help="Only the points that a terrain model needs become ground. Of all other ground"
        " points, none lies farther from the TIN of these key points than the two tolerances"
        " below.",
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
        """Return the parameters with values in place of those left to the preset.

        Parameters
        ----------
        points : Points
            All points of the survey, because all its blocks must be classified with the same
            values.
        """
        return self.filled(vars(PRESETS[self.preset]))


def largest_object(parameters: TinDensification) -> float:
    """Return the width in metres of the largest building that is searched."""
    return parameters.max_building_size or PRESETS[parameters.preset].max_building_size


def reach(parameters: TinDensification) -> float:
    """Return the distance in metres within which points affect each other."""
    return max(_LEAST_REACH, _REACH_BUILDINGS * largest_object(parameters))


def classify(
    points: Points,
    parameters: TinDensification,
    progress: Progress = SILENT,
    known_ground: np.ndarray | None = None,
) -> np.ndarray:
    """Return which points are ground.

    Low outliers are removed from the grid of lowest points. The cells that morphology takes for
    ground give the seeds of a TIN (after Zhao et al. 2016, section 2). In rounds, each triangle
    takes the candidate nearest to it if distance and angle allow it (Axelsson 2000, section 3).
    Last, every point close to the surface through all vertices is ground.

    Parameters
    ----------
    points : Points
        All points that take part.
    parameters : TinDensification
        Distances in metres, angles in degrees.
    progress : Progress
        Receives progress and messages.
    known_ground : numpy.ndarray of bool, shape (n,), optional
        Points of known ground, which are always seeds.

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
    is_classic = parameters.preset == CLASSIC
    apart = spacing(points, _LEAST_SPACING)
    is_dense = apart <= DENSE_SPACING and not is_classic
    if resolved != parameters or (apart <= NOISE_SPACING and not is_classic):
        progress.choice(_in_words(resolved, apart, is_dense))
    size = _DENSE_CELL if is_dense else _CELL if is_classic else max(_CELL, apart)
    # Dense points fill their cells so well that it hardly matters where the cells begin.
    shifts = (0.0,) if is_dense or is_classic else (0.0, 0.5 * size)
    grids = in_threads(lambda shift: LowestPoints(points, size, is_classic, shift), shifts)
    survey = grids[0]
    progress(0.1)
    tell_of_outliers(len(survey.lowest), survey.heights, progress)
    ground, waiting = _seeds(points, grids, resolved, progress.part(0.1, 0.7))
    del grids  # four bytes a point of the second one
    cells = survey.cells
    heights = cells.minimum(points.z, ground)
    if known_ground is not None and known_ground.any():
        known = _lowest_of(points, np.flatnonzero(known_ground))
        ground, heights = np.append(ground, known), with_lower(heights, cells, points, known)
    if not len(ground):
        raise BareEarthError(
            "No point can be taken for ground with certainty. Check the maximum building size and"
            " the selection of points."
        )
    rules, part = densification_rules(resolved), progress.part(0.7, 0.8)
    joined = densified(points, ground, waiting, heights, cells, survey.spacing, rules, part)
    vertices = np.append(ground, joined)
    tolerance = Tolerance(
        resolved.ground_tolerance, resolved.slope_tolerance, resolved.ground_tolerance_below
    )
    part = progress.part(0.8, 0.95)
    if is_classic:
        limits = plain_limits(points, vertices, cells, tolerance)
        found = near_surface(points, cells, limits, part)
    else:
        found = with_banks(points, vertices, cells, apart, tolerance, part)
    return _key_points(points, found, resolved, progress.part(0.95, 1.0))


def _seeds(
    points: Points, grids: list[LowestPoints], parameters: TinDensification, progress: Progress
) -> tuple[np.ndarray, np.ndarray]:
    """Return the indices of the seeds, and of the points that may join them."""
    size, survey, part = parameters.max_building_size, grids[0], progress.part(0.0, 0.8)
    if parameters.preset == CLASSIC:
        return seeds_of_one_grid(survey, size, progress, CLASSIC_ALLOWANCE)
    if len(grids) == 1:
        seeds = seeds_of_one_grid(survey, size, part)
    else:
        seeds = seeds_of_two_grids(points.count, grids, size, part)
    has_gaps = len(grids) > 1
    return checked_seeds(points, *seeds, survey.cells, survey.spacing, has_gaps)


def _in_words(parameters: TinDensification, spacing: float, is_dense: bool) -> str:
    cells = f", cells of {_DENSE_CELL:g} m" if is_dense else ""
    if spacing <= NOISE_SPACING and parameters.preset != CLASSIC:
        cells += f", a tolerance that follows the noise, as points lie {spacing:.2g} m apart"
    names = "preset", "max_building_size", "iteration_angle", "iteration_distance"
    return f"TIN densification: {parameters.in_words(*names)}{cells}."


def _lowest_of(points: Points, which: np.ndarray) -> np.ndarray:
    """Return the indices of the lowest of some points in each cell."""
    some = points.take(which)
    return which[Cells.over(some, _CELL).lowest_points(some)]


def densification_rules(parameters: TinDensification) -> DensificationRules:
    """Return the rules by which a point becomes a vertex, from parameters without empty ones."""
    names = (each.name for each in dataclasses.fields(DensificationRules) if each.name != "level")
    level = None if parameters.preset == CLASSIC else _LEVEL
    return DensificationRules(*(getattr(parameters, name) for name in names), level=level)


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
