"""Progressive TIN densification."""

from ..method import Method, Toolbox
from .filter import CLASSIC, PRESETS, TinDensification, classify, largest_object, reach

_ABOUT = (
    "Finds the ground points of airborne or drone lidar by progressive TIN densification, and"
    " writes the point cloud anew with their class; nothing else in it changes. It starts from"
    " a sparse triangulation of points that are surely ground and adds, round by round, the"
    " points that lie close to it.\nLengths are metres and angles degrees, whatever the unit of"
    " the CRS. The terrain model and its hillshade are GeoTIFFs."
)
METHOD = Method(
    "tin-densification",
    "TIN densification",
    TinDensification,
    classify,
    reach,
    largest_object,
    "max_building_size",
    CLASSIC,
    PRESETS,
    Toolbox(
        "tindensification",
        "Classify ground (TIN densification)",
        "Finds the ground points of a lidar point cloud, and makes a terrain model of them.",
        _ABOUT,
        "tin-densification",
        ("tin,triangulation", "ptd,axelsson,densification"),
    ),
    takes_known_ground=True,
)
