"""The minimum-Z grid filter."""

from ..method import Method, Toolbox
from .filter import CLASSIC, PRESETS, GridMinimum, classify, largest_object, reach

_SUMMARY = "Finds the ground points of a lidar point cloud by rules on the lowest points of cells."
_ABOUT = (
    "Finds the ground points of airborne or drone lidar on a grid of lowest points, and writes a"
    " point cloud with the new classes; nothing else in it changes. Steps between neighbouring"
    " cells are the rims of objects. What such rims enclose is removed, tall objects first. The"
    " method is fast, and needs only heights, no return numbers.\n"
    "Lengths are metres and angles degrees, whatever the unit of the CRS. The terrain model and"
    " its hillshade are GeoTIFFs."
)
METHOD = Method(
    "grid-minimum",
    "Grid minimum",
    GridMinimum,
    classify,
    reach,
    largest_object,
    "max_object_size",
    CLASSIC,
    PRESETS,
    Toolbox(
        "gridminimum",
        "Classify ground (grid minimum)",
        _SUMMARY,
        _ABOUT,
        "grid-minimum",
        ("grid,raster,rasterize,interpolate", "lowest,minimum"),
    ),
)
