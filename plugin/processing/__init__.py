"""The Processing algorithms, each a thin wrapper of the classifier."""

from .assess import AssessAlgorithm
from .classify_tiles import ClassifyTilesAlgorithm
from .compare_settings import CompareSettingsAlgorithm
from .grid_minimum import GridMinimumAlgorithm
from .height_above_ground import HeightAboveGroundAlgorithm
from .model_key_points import ModelKeyPointsAlgorithm
from .point_cloud_to_terrain import PointCloudToTerrainAlgorithm
from .remove_off_terrain_objects import RemoveOffTerrainObjectsAlgorithm
from .slope_filter import SlopeFilterAlgorithm
from .terrain_model import TerrainModelAlgorithm
from .tin_densification import TinDensificationAlgorithm

ALGORITHMS = (
    PointCloudToTerrainAlgorithm,
    TinDensificationAlgorithm,
    GridMinimumAlgorithm,
    SlopeFilterAlgorithm,
    ClassifyTilesAlgorithm,
    TerrainModelAlgorithm,
    HeightAboveGroundAlgorithm,
    ModelKeyPointsAlgorithm,
    CompareSettingsAlgorithm,
    AssessAlgorithm,
    RemoveOffTerrainObjectsAlgorithm,
)
