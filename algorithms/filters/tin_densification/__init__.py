"""Progressive TIN densification."""

from ..method import Method, Toolbox
from .filter import CLASSIC, PRESETS, TinDensification, classify, largest_object, reach

_ABOUT = (
    "Finds the ground points of airborne or drone lidar by progressive TIN densification, and"
    " writes a point cloud with the new classes; nothing else in it changes. The filter starts"
    " from a sparse triangulation (TIN) of points that are surely ground. Round by round it adds"
    " points that lie close to the TIN.\n"
    "Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and"
    " its hillshade are GeoTIFFs."
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
