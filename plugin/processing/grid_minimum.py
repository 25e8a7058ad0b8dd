"""Ground classification by the minimum-Z grid filter, in the toolbox."""

from __future__ import annotations

from .classification import ClassificationAlgorithm


class GridMinimumAlgorithm(ClassificationAlgorithm):
    """Classify ground (grid minimum)."""

    method = "grid-minimum"
    identifier = "gridminimum"
    title = "Classify ground (grid minimum)"
    summary = (
        "Finds the ground points of a lidar point cloud by rules on the lowest points of cells."
    )
    about = (
        "Finds the ground points of airborne or drone lidar on a grid of lowest points, and writes"
        " the point cloud anew with their class; nothing else in it changes. Steps between"
        " neighbouring cells are the rims of objects; what such rims enclose is removed, the tall"
        " objects first. It needs heights only, no returns, and is fast.\nLengths are metres and"
        " angles degrees, whatever the unit of the CRS. The terrain model and its hillshade are"
        " GeoTIFFs."
    )
    page = "grid-minimum"
