"""Ground classification by the slope filter, in the toolbox."""

from __future__ import annotations

from .classification import ClassificationAlgorithm


class SlopeFilterAlgorithm(ClassificationAlgorithm):
    """Classify ground (slope filter)."""

    method = "slope"
    identifier = "slopefilter"
    title = "Classify ground (slope filter)"
    summary = "Finds the ground points of a lidar point cloud by the slopes between neighbours."
    about = (
        "Finds the ground points of airborne or drone lidar by slopes, and writes the point cloud"
        " anew with their class; nothing else in it changes. A point that stands above a neighbour"
        " by more than the terrain can is not ground. The preset Automatic compares on many scales"
        " and follows the terrain; the preset Whitebox repeats WhiteboxTools'"
        " LidarGroundPointFilter.\nLengths are metres and angles degrees, whatever the unit of the"
        " CRS. The terrain model and its hillshade are GeoTIFFs."
    )
    page = "slope-filter"
