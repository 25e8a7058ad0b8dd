"""The Processing algorithms: thin wrappers of the classifier."""

from .assess import AssessAlgorithm
from .check import CheckAlgorithm
from .classify_above_ground import ClassifyAboveGroundAlgorithm
from .classify_tiles import ClassifyTilesAlgorithm
from .compare_settings import CompareSettingsAlgorithm
from .ground_filters import GROUND_FILTERS
from .height_above_ground import HeightAboveGroundAlgorithm
from .model_key_points import ModelKeyPointsAlgorithm
from .point_cloud_to_terrain import PointCloudToTerrainAlgorithm
from .quality import QualityAlgorithm
from .relief import ReliefAlgorithm
from .remove_off_terrain_objects import RemoveOffTerrainObjectsAlgorithm
from .terrain_model import TerrainModelAlgorithm
from .water import WaterAlgorithm
from .water_classes import WaterClassesAlgorithm

ALGORITHMS = (
    PointCloudToTerrainAlgorithm,
    *GROUND_FILTERS,
    ClassifyTilesAlgorithm,
    TerrainModelAlgorithm,
    HeightAboveGroundAlgorithm,
    ClassifyAboveGroundAlgorithm,
    ModelKeyPointsAlgorithm,
    WaterAlgorithm,
    WaterClassesAlgorithm,
    CompareSettingsAlgorithm,
    AssessAlgorithm,
    CheckAlgorithm,
    QualityAlgorithm,
    ReliefAlgorithm,
    RemoveOffTerrainObjectsAlgorithm,
)
