"""The Processing algorithms: thin wrappers of the classifier.

Those of tools are made of the declarations of `algorithms/tools/`.
"""

from .classify_tiles import ClassifyTilesAlgorithm
from .ground_filters import GROUND_FILTERS
from .point_cloud_to_terrain import PointCloudToTerrainAlgorithm
from .terrain_model import TerrainModelAlgorithm

ALGORITHMS = (
    PointCloudToTerrainAlgorithm,
    *GROUND_FILTERS,
    ClassifyTilesAlgorithm,
    TerrainModelAlgorithm,
)
