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

from dataclasses import dataclass
from typing import NamedTuple

from ..core.parameters import ParameterSet, parameter
from ..core.points import Points
from ..core.progress import Progress
from ..grids.cells import spacing
from .method import TERRAINS, Method, as_given, of_metres, of_preset
from .pipeline import Pipeline
from .stages import shared_pipeline
from .stages.breaks import Plants
from .stages.opening import SteepRises
from .stages.seeds import LowestPoints, Seeds
from .stages.tolerance import ToleranceSurface
from .whitebox import StandsAbove

# The distance within which points affect each other: in search radii (those on one scale are for
# erosion, dilation and comparison), in widths of the largest building, and the least value in
# metres if the radius follows from the points.
_REACH_RADII = 5.0
_REACH_RADII_ON_ONE_SCALE = 3.01
_REACH_BUILDINGS = 2.0
_LEAST_REACH = 100.0
_WHITEBOX_RADIUS = 2.0  # metres
# The preset with the rules of Whitebox's filter.
CLASSIC = "whitebox"
# Width of the largest building in search radii, if the radius is given.
_WIDEST = 2.0


class OneScale(NamedTuple):
    """The values of Whitebox's filter, named as those of `ManyScales`."""

    search_radius: float = _WHITEBOX_RADIUS
    slope_threshold: float = 45.0
    height_threshold: float = 1.0


class ManyScales(NamedTuple):
    """The values of a preset that compares on many scales."""

    search_radius: float  # least search radius in metres
    slope_threshold: float  # degrees
    height_threshold: float  # metres
    max_building_size: float  # metres
    cell_size: float = 1.0  # least cell size in metres; cells are larger where points are sparse


MANY_SCALES = {
    "automatic": ManyScales(18.0, 15.0, 0.5, 150.0),
    "flat": ManyScales(24.0, 15.0, 0.4, 100.0),
    "hilly": ManyScales(15.0, 15.0, 0.5, 30.0),
    "steep": ManyScales(12.0, 20.0, 0.5, 24.0),
    "town": ManyScales(24.0, 15.0, 0.5, 100.0),
    "city": ManyScales(50.0, 15.0, 0.5, 150.0),
    "site": ManyScales(12.0, 30.0, 0.5, 25.0, 0.5),
}


@dataclass(frozen=True)
class SlopeFilter(ParameterSet):
    """Parameters of the slope filter, named as in Whitebox's *LidarGroundPointFilter*."""

    preset: str = parameter(
        "automatic",
        label="Preset",
        choices={
            **TERRAINS,
            "automatic": "Automatic (many scales, follows the terrain)",
            CLASSIC: "Whitebox (one scale, 2 m, 45 deg, 1 m)",
        },
        help="Sets the fields that are left empty. Automatic and the kinds of terrain remove"
        " buildings as well as shrubs. Whitebox is the classic filter with the values of"
        " WhiteboxTools: within its radius of 2 m it cannot find a building.",
    )
    search_radius: float | None = of_preset(
        "Search radius",
        (0.1, 500.0),
        "Points are compared with their neighbours up to this distance. Choose at least half"
        " the shorter side of the largest building. Empty: from the preset, 18 m in the automatic"
        " one (more if points are sparse), 2 m in Whitebox.",
    )
    min_neighbours: int = parameter(
        0,
        label="Minimum number of neighbours",
        unit="points",
        minimum=0,
        maximum=10_000,
        help="A point with fewer neighbours within the search radius is compared with this many"
        " nearest points. Only for the preset Whitebox.",
    )
    slope_threshold: float | None = of_preset(
        "Slope threshold",
        (0.0, 88.0),
        "A point is not ground if it stands above a neighbour at a steeper slope than this."
        " In all presets but Whitebox, the slope of the terrain around the point is added to it."
        " Empty: from the preset, 15 deg in most, 45 deg in Whitebox.",
        unit="deg",
    )
    height_threshold: float | None = of_preset(
        "Height threshold",
        (0.0, 100.0),
        "A point is not ground only if it stands at least this high above a neighbour. Empty:"
        " from the preset, 0.5 m in most, 1 m in Whitebox.",
    )
    slope_norm: bool = parameter(
        True,
        label="Slope normalisation",
        help="Compares heights above a surface that follows the terrain (white top-hat), not"
        " elevations, so that ground on slopes is not lost.",
    )
    cell_size: float | None = of_preset(
        "Cell size",
        (0.05, 50.0),
        "Side of the cells whose lowest points are compared. Not used with the preset"
        " Whitebox. Empty: the usual distance between points, at least 1 m (0.5 m in the preset for"
        " sites).",
        advanced=True,
    )
    max_building_size: float | None = of_preset(
        "Maximum building size",
        (0.1, 500.0),
        "Shorter side of the largest building. Buildings wider than two search radii are"
        " found by the drop on all their sides. Empty: from the preset, or two search radii if the"
        " search radius is given. Not used with the preset Whitebox.",
    )
    ground_tolerance: float | None = of_preset(
        "Ground tolerance",
        (0.0, 10.0),
        "In level terrain, points up to this height above the surface through the ground are"
        " ground. Empty: 0.18 m, and more where points are sparse or noisy. Not used with the"
        " preset Whitebox.",
        advanced=True,
    )
    slope_tolerance: float = of_metres(
        1.4,
        "Ground tolerance on slopes",
        10.0,
        "Added to the ground tolerance on a slope of 45 degrees, if points are a metre apart."
        " Less is added, in proportion, on gentler slopes and if points are closer.",
    )

    def resolve(self, points: Points) -> SlopeFilter:
        """Return the parameters with values in place of empty ones."""
        if self.preset == CLASSIC:
            chosen = OneScale()._asdict()
        else:
            preset = MANY_SCALES[self.preset]
            chosen = preset._asdict()
            if self.search_radius is not None:
                chosen["max_building_size"] = _WIDEST * self.search_radius
            if self.search_radius is None or self.cell_size is None:
                apart = spacing(points, preset.cell_size)
                chosen["search_radius"] = max(preset.search_radius, round(4.0 * apart, 1))
                chosen["cell_size"] = apart
        return self.filled(chosen)


def largest_object(parameters: SlopeFilter) -> float:
    """Return the width in metres of the largest building that is removed."""
    given = parameters.search_radius
    if parameters.preset == CLASSIC:
        return _WIDEST * (given or _WHITEBOX_RADIUS)
    if parameters.max_building_size is not None:
        return parameters.max_building_size
    return MANY_SCALES[parameters.preset].max_building_size if given is None else _WIDEST * given


def reach(parameters: SlopeFilter) -> float:
    """Return the distance in metres within which points affect each other."""
    if parameters.preset == CLASSIC:
        metres = _REACH_RADII_ON_ONE_SCALE * (parameters.search_radius or _WHITEBOX_RADIUS)
        return max(_LEAST_REACH, metres) if parameters.min_neighbours else metres
    preset = MANY_SCALES[parameters.preset]
    radius = parameters.search_radius or preset.search_radius
    size = largest_object(parameters)
    return max(_LEAST_REACH, _REACH_RADII * radius, _REACH_BUILDINGS * size)


def pipeline(points: Points, parameters: SlopeFilter, progress: Progress) -> Pipeline:
    """Return the rules for some points, and tell which values were chosen."""
    # A point is not ground if it stands above a neighbour by at least the height threshold and at a
    # slope above the slope threshold (Vosselman 2000, section 2).
    resolved = parameters.resolve(points)
    if resolved != parameters:
        progress.choice(_in_words(resolved))
    if resolved.preset == CLASSIC:
        one = as_given(OneScale(), resolved)
        return Pipeline((StandsAbove(*one, resolved.slope_norm, resolved.min_neighbours),))
    many = as_given(MANY_SCALES[resolved.preset], resolved)
    rises = SteepRises(
        many.search_radius, many.slope_threshold, many.height_threshold, resolved.slope_norm
    )
    return shared_pipeline(
        LowestPoints(size=many.cell_size),
        many.max_building_size,
        ToleranceSurface(resolved.ground_tolerance, resolved.slope_tolerance),
        (Seeds(hint="Check the thresholds and the selection of points."),),
        Plants(where_dense=False),
        is_site=parameters.preset == "site",
        opening=(rises,),
    )


def _in_words(parameters: SlopeFilter) -> str:
    names = ["preset", "search_radius", "slope_threshold", "height_threshold"]
    if parameters.preset == CLASSIC:
        neighbours = f"minimum number of neighbours {parameters.min_neighbours}"
        return f"Slope filter: {parameters.in_words(*names)}, {neighbours}."
    return f"Slope filter: {parameters.in_words(*names, 'cell_size', 'max_building_size')}."


METHOD = Method(
    "slope", "Slope filter", SlopeFilter, pipeline, reach, largest_object, "max_building_size",
    CLASSIC, MANY_SCALES,
)  # fmt: skip
