"""Ground classification by progressive TIN densification, in the toolbox."""

from __future__ import annotations

from .classification import ClassificationAlgorithm


class TinDensificationAlgorithm(ClassificationAlgorithm):
    """Classify ground (TIN densification)."""

    method = "tin-densification"
    identifier = "tindensification"
    title = "Classify ground (TIN densification)"
    summary = "Finds the ground points of a lidar point cloud, and makes a terrain model of them."
    about = (
        "Finds the ground points of airborne or drone lidar by progressive TIN densification, and"
        " writes the point cloud anew with their class; nothing else in it changes. It starts from"
        " a sparse triangulation of points that are surely ground and adds, round by round, the"
        " points that lie close to it.\nLengths are metres and angles degrees, whatever the unit of"
        " the CRS. The terrain model and its hillshade are GeoTIFFs."
    )
    page = "tin-densification"
