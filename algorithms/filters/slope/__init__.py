"""The slope-based filter."""

from ..method import Method, Toolbox
from .filter import CLASSIC, MANY_SCALES, SlopeFilter, classify, largest_object, reach

_ABOUT = (
    "Finds the ground points of airborne or drone lidar by slopes, and writes a point cloud with"
    " the new classes; nothing else in it changes. A point is not ground if it stands higher above"
    " a neighbour than terrain can. The preset Automatic compares points on many scales and"
    " follows the terrain; the preset Whitebox repeats WhiteboxTools' LidarGroundPointFilter.\n"
    "Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and"
    " its hillshade are GeoTIFFs."
)
METHOD = Method(
    "slope",
    "Slope filter",
    SlopeFilter,
    classify,
    reach,
    largest_object,
    "max_building_size",
    CLASSIC,
    MANY_SCALES,
    Toolbox(
        "slopefilter",
        "Classify ground (slope filter)",
        "Finds the ground points of a lidar point cloud by the slopes between neighbouring points.",
        _ABOUT,
        "slope-filter",
        ("slope,vosselman,whitebox,top-hat",),
    ),
)
