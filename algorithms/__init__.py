"""Ground classification of lidar points, and terrain models: the public API.

Names are imported when they are first used, so that importing the package is fast and needs no
scipy.

>>> from bare_earth.algorithms import ClassifyRequest, classify
>>> summary = classify("tile.laz", "classified.laz", ClassifyRequest())  # doctest: +SKIP
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .core.errors import BareEarthError as BareEarthError
    from .core.errors import Cancelled as Cancelled
    from .core.progress import Progress as Progress
    from .core.version import __version__ as __version__
    from .delivery.delivering import deliver as deliver
    from .delivery.request import DeliveryOptions as DeliveryOptions
    from .delivery.request import DeliveryRequest as DeliveryRequest
    from .delivery.request import DeliveryTerrain as DeliveryTerrain
    from .delivery.request import DeliveryWater as DeliveryWater
    from .engine.heights import HeightOutput as HeightOutput
    from .engine.key_points import KeyPointMark as KeyPointMark
    from .engine.memory import Resources as Resources
    from .engine.options import RasterOutput as RasterOutput
    from .engine.options import TileInput as TileInput
    from .engine.options import TileOutput as TileOutput
    from .engine.output import Output as Output
    from .engine.requests import AboveGroundRequest as AboveGroundRequest
    from .engine.requests import ClassifyRequest as ClassifyRequest
    from .engine.requests import HeightRequest as HeightRequest
    from .engine.requests import KeyPointRequest as KeyPointRequest
    from .engine.requests import TerrainRequest as TerrainRequest
    from .engine.requests import WaterClassRequest as WaterClassRequest
    from .engine.runs import above_ground as above_ground
    from .engine.runs import classify as classify
    from .engine.runs import heights as heights
    from .engine.runs import key_points as key_points
    from .engine.runs import terrain as terrain
    from .engine.runs import water_classes as water_classes
    from .filters.grid_minimum import GridMinimum as GridMinimum
    from .filters.slope import SlopeFilter as SlopeFilter
    from .filters.tin import TinDensification as TinDensification
    from .grids.model_key_points import ModelKeyPoints as ModelKeyPoints
    from .products.above_ground import AboveGround as AboveGround
    from .products.accuracy import Accuracy as Accuracy
    from .products.assessment import assess_files as assess  # noqa: F401
    from .products.checkpoint_outputs import CheckOutputs as CheckOutputs
    from .products.checkpoints import CheckOptions as CheckOptions
    from .products.checkpoints import CheckRequest as CheckRequest
    from .products.checkpoints import check_files as check  # noqa: F401
    from .products.constraints import Constraints as Constraints
    from .products.contours import Contours as Contours
    from .products.contours import write_contours as write_contours
    from .products.quality import QualityOptions as QualityOptions
    from .products.quality import QualityRequest as QualityRequest
    from .products.quality import survey_quality as quality  # noqa: F401
    from .products.raster_files import RasterFiles as RasterFiles
    from .products.raster_grid import RasterTarget as RasterTarget
    from .products.relief import ReliefPictures as ReliefPictures
    from .products.relief import write_relief as write_relief
    from .products.surface_model import SurfaceModel as SurfaceModel
    from .products.terrain_model import TerrainModel as TerrainModel
    from .products.water import Water as Water
    from .products.water_classes import WaterClasses as WaterClasses
    from .products.water_classes import WaterPolygons as WaterPolygons
    from .products.water_files import WaterRequest as WaterRequest
    from .products.water_files import write_water as find_water  # noqa: F401
    from .rasters.sampling import HeightRaster as HeightRaster
    from .survey.area import Area as Area
    from .survey.checkpoint_files import Checkpoints as Checkpoints
    from .survey.checkpoint_files import read_checkpoints as read_checkpoints
    from .survey.corrections import Corrections as Corrections
    from .survey.ground_classes import GroundClasses as GroundClasses
    from .survey.selection import Selection as Selection
    from .survey.vector_files import read_boundary as read_boundary
    from .survey.vector_files import read_corrections as read_corrections
    from .survey.vector_files import read_lines as read_lines
    from .trial.comparing import compare_settings as compare_settings
    from .trial.options import TrialOptions as TrialOptions

# The module of each name; with the name in that module, if it differs.
_MODULES = {
    "BareEarthError": "core.errors",
    "Cancelled": "core.errors",
    "Progress": "core.progress",
    "__version__": "core.version",
    "Constraints": "products.constraints",
    "deliver": "delivery.delivering",
    "DeliveryOptions": "delivery.request",
    "DeliveryRequest": "delivery.request",
    "DeliveryTerrain": "delivery.request",
    "DeliveryWater": "delivery.request",
    "HeightOutput": "engine.heights",
    "KeyPointMark": "engine.key_points",
    "Resources": "engine.memory",
    "RasterOutput": "engine.options",
    "TileInput": "engine.options",
    "TileOutput": "engine.options",
    "Output": "engine.output",
    "QualityOptions": "products.quality",
    "QualityRequest": "products.quality",
    "quality": "products.quality:survey_quality",
    "RasterFiles": "products.raster_files",
    "RasterTarget": "products.raster_grid",
    "AboveGroundRequest": "engine.requests",
    "ClassifyRequest": "engine.requests",
    "HeightRequest": "engine.requests",
    "KeyPointRequest": "engine.requests",
    "TerrainRequest": "engine.requests",
    "WaterClassRequest": "engine.requests",
    "above_ground": "engine.runs",
    "classify": "engine.runs",
    "heights": "engine.runs",
    "key_points": "engine.runs",
    "terrain": "engine.runs",
    "water_classes": "engine.runs",
    "compare_settings": "trial.comparing",
    "TrialOptions": "trial.options",
    "GridMinimum": "filters.grid_minimum",
    "SlopeFilter": "filters.slope",
    "TinDensification": "filters.tin",
    "ModelKeyPoints": "grids.model_key_points",
    "AboveGround": "products.above_ground",
    "assess": "products.assessment:assess_files",
    "Accuracy": "products.accuracy",
    "CheckOptions": "products.checkpoints",
    "CheckOutputs": "products.checkpoint_outputs",
    "CheckRequest": "products.checkpoints",
    "check": "products.checkpoints:check_files",
    "Contours": "products.contours",
    "write_contours": "products.contours",
    "ReliefPictures": "products.relief",
    "write_relief": "products.relief",
    "SurfaceModel": "products.surface_model",
    "TerrainModel": "products.terrain_model",
    "Water": "products.water",
    "WaterClasses": "products.water_classes",
    "WaterPolygons": "products.water_classes",
    "WaterRequest": "products.water_files",
    "find_water": "products.water_files:write_water",
    "HeightRaster": "rasters.sampling",
    "Area": "survey.area",
    "Checkpoints": "survey.checkpoint_files",
    "read_checkpoints": "survey.checkpoint_files",
    "Corrections": "survey.corrections",
    "GroundClasses": "survey.ground_classes",
    "Selection": "survey.selection",
    "read_boundary": "survey.vector_files",
    "read_corrections": "survey.vector_files",
    "read_lines": "survey.vector_files",
}

__all__ = list(_MODULES)


def __getattr__(name: str) -> Any:
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module, _, there = _MODULES[name].partition(":")
    return getattr(importlib.import_module(f".{module}", __name__), there or name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
