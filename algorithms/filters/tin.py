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
from typing import NamedTuple

from ..core.parameters import ParameterSet, parameter, parameter_of
from ..core.points import Points
from ..core.progress import Progress
from ..grids.cells import spacing
from ..tin.model_key_points import ModelKeyPoints
from .method import TERRAINS, Method, as_given, of_metres, of_preset
from .pipeline import Pipeline
from .stages import shared_pipeline
from .stages.accept import NearSurface, OnlyKeyPoints
from .stages.breaks import Plants
from .stages.densify import Densification
from .stages.objects import RaisedObjects
from .stages.opening import ProgressiveOpening
from .stages.outliers import NarrowPits
from .stages.raised_regions import LowBanks
from .stages.seeds import DENSE_SPACING, KnownGround, LowestPoints, Seeds
from .stages.shrubs import Shrubs
from .stages.terrain import GentleBorder, GentleRegions
from .stages.tolerance import PlainSurface, ToleranceSurface

_LEAST_SPACING = 0.01  # least spacing of points in metres; a smaller one counts as this
_SMALL = 600.0  # square metres up to which a tall and slender region is an object, not a hill
# The distance within which points affect each other, in widths of the largest building, and its
# least value in metres.
_REACH_BUILDINGS = 1.2
_LEAST_REACH = 100.0
# The preset with the rules of another program.
CLASSIC = "lidar360"


class TinPreset(NamedTuple):
    """Values for the parameters that are left empty; lengths in metres."""

    max_building_size: float
    iteration_angle: float  # degrees
    iteration_distance: float
    cell_size: float = 1.0


class Lidar360Preset(NamedTuple):
    """The values of LiDAR360, named as those of `TinPreset`, and its ground tolerance."""

    max_building_size: float = 20.0
    iteration_angle: float = 8.0
    iteration_distance: float = 1.4
    cell_size: float = 1.0
    ground_tolerance: float = 0.18  # above the final surface in level terrain


# Cells of 0.5 m lose 2 to 11 % of generated berms of 0.6 to 1.8 m, cells of 1 m 35 to 43 %
# (`python -m benchmarks.site`).
PRESETS: dict[str, TinPreset | Lidar360Preset] = {
    "automatic": TinPreset(150.0, 15.0, 1.4),
    "flat": TinPreset(48.0, 8.0, 0.7),
    "hilly": TinPreset(30.0, 15.0, 1.4),
    "steep": TinPreset(30.0, 25.0, 2.0),
    "town": TinPreset(60.0, 12.0, 1.4),
    "city": TinPreset(120.0, 12.0, 1.4),
    "site": TinPreset(25.0, 15.0, 1.4, 0.5),
    CLASSIC: Lidar360Preset(),
}


@dataclass(frozen=True)
class TinDensification(ParameterSet):
    """Parameters of improved progressive TIN densification."""

    preset: str = parameter(
        "automatic",
        label="Preset",
        choices={**TERRAINS, CLASSIC: "LiDAR360's values"},
        help="Sets the fields that are left empty: from the points (automatic), or to values that"
        " suit a kind of terrain. The log says which values were used.",
    )
    max_building_size: float | None = of_preset(
        "Maximum building size",
        (1.0, 500.0),
        "Shorter side of the largest building or other object. Nothing that is narrower and"
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
    iteration_angle: float | None = of_preset(
        "Iteration angle",
        (0.1, 90.0),
        "Largest angle between a triangle and the line from one of its corners to a new"
        " point. A larger angle follows rugged ground better, a smaller one keeps low objects out:"
        " 4 deg in flat terrain, 10 deg and more in steep terrain. Empty: from the preset.",
        unit="deg",
    )
    iteration_distance: float | None = of_preset(
        "Iteration distance",
        (0.01, 50.0),
        "Largest distance of a new point from its triangle. Empty: from the preset.",
    )
    cell_size: float | None = of_preset(
        "Cell size",
        (0.1, 50.0),
        "Side of the cells whose lowest points may become vertices of the TIN; at least the"
        " usual distance between points. Smaller cells keep narrow banks and sharp edges, but under"
        " trees also more plants. Empty: from the preset.",
        advanced=True,
    )
    reduce_angle_edge: float | None = of_metres(
        5.0,
        "Reduce iteration angle when edges are shorter than",
        100.0,
        "In triangles whose longest edge is shorter than this, the iteration angle is reduced"
        " in proportion. So the TIN does not climb low vegetation step by step. Empty: the angle"
        " is never reduced.",
        optional=True,
    )
    stop_edge: float | None = of_metres(
        2.0,
        "Stop triangulation when edges are shorter than",
        100.0,
        "Triangles whose longest edge is shorter than this take no more points. Empty: all"
        " triangles can take points.",
        optional=True,
    )
    noise_distance: float = of_metres(
        0.3,
        "Noise distance",
        5.0,
        "A point that is closer to its triangle than this joins the TIN whatever its angle."
        " Near a corner, noise alone makes a large angle.",
    )
    ground_tolerance: float | None = of_preset(
        "Ground tolerance above",
        (0.0, 10.0),
        "In level terrain, points up to this height above the final surface are ground. A larger"
        " value takes in grass and low bushes. Empty: 0.18 m, and more where points are sparse or"
        " noisy.",
        advanced=True,
    )
    ground_tolerance_below: float = of_metres(
        0.6,
        "Ground tolerance below",
        10.0,
        "In level terrain, points down to this depth below the final surface are ground. The"
        " surface goes through the lowest points, but is smoother than they are.",
    )
    slope_tolerance: float = of_metres(
        1.4,
        "Ground tolerance on slopes",
        10.0,
        "Added to both ground tolerances on a slope of 45 degrees. On gentler slopes less is"
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
        """Return the parameters with values in place of those left to the preset."""
        return self.filled(PRESETS[self.preset]._asdict())


def largest_object(parameters: TinDensification) -> float:
    """Return the width in metres of the largest building that is removed."""
    return parameters.max_building_size or PRESETS[parameters.preset].max_building_size


def reach(parameters: TinDensification) -> float:
    """Return the distance in metres within which points affect each other."""
    return max(_LEAST_REACH, _REACH_BUILDINGS * largest_object(parameters))


def pipeline(points: Points, parameters: TinDensification, progress: Progress) -> Pipeline:
    """Return the rules for some points, and tell which values were chosen."""
    # The cells that morphology takes for ground give the seeds of a TIN (Zhao et al. 2016, section
    # 2). In rounds, each triangle takes the candidate nearest to it if distance and angle allow it
    # (Axelsson 2000, section 3).
    resolved = parameters.resolve(points)
    if parameters.preset == CLASSIC:
        if resolved != parameters:
            progress.choice(_in_words(resolved))
        return _classic(resolved, as_given(Lidar360Preset(), resolved))
    values = as_given(PRESETS[parameters.preset], resolved)
    apart = spacing(points, _LEAST_SPACING)
    if resolved != parameters or apart <= DENSE_SPACING:
        progress.choice(_in_words(resolved, apart))
    size, cell = values.max_building_size, max(values.cell_size, apart)
    is_site = parameters.preset == "site"
    densification = _densification(resolved, values)
    if is_site or parameters.iteration_distance is not None:
        # A distance that the user gave, and that of a site, is used in clouds from images as well.
        densification = dataclasses.replace(densification, in_images=None)
    return shared_pipeline(
        LowestPoints(cell, grids=2),
        size,
        ToleranceSurface(
            resolved.ground_tolerance, resolved.slope_tolerance, resolved.ground_tolerance_below
        ),
        (Seeds(),),
        Plants(),
        is_site=is_site,
        regions=GentleRegions(gentle_border=GentleBorder(small=_SMALL)),
        surface=(
            # Where nearly all points lie near the lowest ones, there is no low plant to look for.
            *(() if is_site else (Shrubs(most_open=0.95),)),
            KnownGround(),
            densification,
        ),
        accepted=_key_points(resolved),
    )


def _classic(resolved: TinDensification, values: Lidar360Preset) -> Pipeline:
    """Return the rules of LiDAR360's preset."""
    size, pits = values.max_building_size, NarrowPits(corroborated=None, under_canopy=None)
    objects = RaisedObjects(
        size,
        heights=(5.0, 4.5, 2.0),
        whole_share=0.4,
        wide=None,
        plateau_height=None,
        narrow_pits=pits,
    )
    return Pipeline(
        (
            LowestPoints(size=values.cell_size),
            pits,
            objects,
            ProgressiveOpening(size / 2.0, level_beyond=False, usual_window=math.inf),
            GentleRegions(
                judges_gaps=False,
                on_slope=None,
                in_images=True,
                gentle_border=GentleBorder(
                    shares=(0.5, 0.5),
                    in_one_place=0.5,
                    least_area=0.0,
                    most_cut=1.0,
                    row_width=0.0,
                    vault_level=0.0,
                ),
                rocks=None,
                low_banks=LowBanks(sparse=0.0, most_in_row=1.0),
                level_across=None,
                ramps=None,
            ),
            Seeds(objects_wait=True),
            KnownGround(),
            dataclasses.replace(_densification(resolved, values), in_images=None, level=None),
            PlainSurface(
                values.ground_tolerance,
                resolved.slope_tolerance,
                resolved.ground_tolerance_below,
            ),
            NearSurface(),
            *_key_points(resolved),
        )
    )


def _densification(resolved: TinDensification, values: TinPreset | Lidar360Preset) -> Densification:
    return Densification(
        values.iteration_angle, values.iteration_distance, resolved.max_terrain_angle,
        resolved.reduce_angle_edge, resolved.stop_edge, resolved.noise_distance,
    )  # fmt: skip


def _key_points(resolved: TinDensification) -> tuple[OnlyKeyPoints, ...]:
    """Return the rule for key points if only they are wanted."""
    if not resolved.only_key_points:
        return ()
    closeness = ModelKeyPoints(
        resolved.key_point_tolerance_above, resolved.key_point_tolerance_below,
        resolved.key_point_grid_size,
    )  # fmt: skip
    return (OnlyKeyPoints(closeness),)


def _in_words(parameters: TinDensification, apart: float = math.inf) -> str:
    """Return the chosen values for the log, and what follows if points are close together."""
    words = parameters.in_words("preset", *TinPreset._fields)
    if apart <= DENSE_SPACING:
        words += f", a tolerance that follows the noise, as points lie {apart:.2g} m apart"
    return f"TIN densification: {words}."


METHOD = Method(
    "tin-densification", "TIN densification", TinDensification, pipeline, reach, largest_object,
    "max_building_size", CLASSIC, PRESETS, takes_known_ground=True,
)  # fmt: skip
