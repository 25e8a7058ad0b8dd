"""Ground classification of lidar points, and terrain models: the public API.

Names are imported when they are first used, so that importing the package is fast and needs no
scipy.

>>> from bare_earth.algorithms import ClassifyRequest, classify
>>> summary = classify("tile.laz", "classified.laz", ClassifyRequest())  # doctest: +SKIP
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from .tools import POINT_TOOLS

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
    from .engine.memory import Resources as Resources
    from .filters.grid_minimum import GridMinimum as GridMinimum
    from .filters.slope import SlopeFilter as SlopeFilter
    from .filters.tin import TinDensification as TinDensification
    from .grids.model_key_points import ModelKeyPoints as ModelKeyPoints
    from .rasters.cell_grid import RasterTarget as RasterTarget
    from .rasters.sampling import HeightRaster as HeightRaster
    from .runs.entry import PointFunction
    from .runs.entry import classify as classify
    from .runs.entry import terrain as terrain
    from .runs.options import RasterOutput as RasterOutput
    from .runs.options import TileInput as TileInput
    from .runs.options import TileOutput as TileOutput
    from .runs.requests import ClassifyRequest as ClassifyRequest
    from .runs.requests import PointRequest as PointRequest
    from .runs.requests import TerrainRequest as TerrainRequest
    from .survey.area import Area as Area
    from .survey.corrections import Corrections as Corrections
    from .survey.ground_classes import GroundClasses as GroundClasses
    from .survey.selection import Selection as Selection
    from .survey.vector_files import read_boundary as read_boundary
    from .survey.vector_files import read_corrections as read_corrections
    from .survey.vector_files import read_lines as read_lines
    from .tools.above_ground import ClassifyAboveGround as ClassifyAboveGround
    from .tools.above_ground.classes import AboveGround as AboveGround
    from .tools.assess import assess_files as assess  # noqa: F401
    from .tools.check.accuracy import Accuracy as Accuracy
    from .tools.check.checking import CheckOptions as CheckOptions
    from .tools.check.checking import CheckOutputs as CheckOutputs
    from .tools.check.checking import CheckRequest as CheckRequest
    from .tools.check.checking import check_files as check  # noqa: F401
    from .tools.check.checkpoints import Checkpoints as Checkpoints
    from .tools.check.reading import read_checkpoints as read_checkpoints
    from .tools.compare_settings import compare_settings as compare_settings
    from .tools.compare_settings.settings import TrialOptions as TrialOptions
    from .tools.contours import Contours as Contours
    from .tools.contours import write_contours as write_contours
    from .tools.ground.output import Output as Output
    from .tools.heights import HeightOutput as HeightOutput
    from .tools.heights import MeasureHeights as MeasureHeights
    from .tools.key_points import FindKeyPoints as FindKeyPoints
    from .tools.key_points import KeyPointMark as KeyPointMark
    from .tools.quality import QualityOptions as QualityOptions
    from .tools.quality import QualityRequest as QualityRequest
    from .tools.quality import survey_quality as quality  # noqa: F401
    from .tools.rasters.constraints import Constraints as Constraints
    from .tools.rasters.parameters import SurfaceModel as SurfaceModel
    from .tools.rasters.parameters import TerrainModel as TerrainModel
    from .tools.rasters.rows import RasterFiles as RasterFiles
    from .tools.relief import ReliefPictures as ReliefPictures
    from .tools.relief import write_relief as write_relief
    from .tools.water.finding import Water as Water
    from .tools.water.tool import WaterRequest as WaterRequest
    from .tools.water.tool import write_water as find_water  # noqa: F401
    from .tools.water_classes import ClassifyWater as ClassifyWater
    from .tools.water_classes import WaterClasses as WaterClasses
    from .tools.water_classes import WaterPolygons as WaterPolygons

    above_ground: PointFunction
    heights: PointFunction
    key_points: PointFunction
    water_classes: PointFunction

# The module of each name; with the name in that module, if it differs.
_MODULES = {
    "BareEarthError": "core.errors",
    "Cancelled": "core.errors",
    "Progress": "core.progress",
    "__version__": "core.version",
    "Constraints": "tools.rasters.constraints",
    "deliver": "delivery.delivering",
    "DeliveryOptions": "delivery.request",
    "DeliveryRequest": "delivery.request",
    "DeliveryTerrain": "delivery.request",
    "DeliveryWater": "delivery.request",
    "ClassifyAboveGround": "tools.above_ground",
    "HeightOutput": "tools.heights",
    "MeasureHeights": "tools.heights",
    "FindKeyPoints": "tools.key_points",
    "KeyPointMark": "tools.key_points",
    "Resources": "engine.memory",
    "RasterOutput": "runs.options",
    "TileInput": "runs.options",
    "TileOutput": "runs.options",
    "Output": "tools.ground.output",
    "QualityOptions": "tools.quality",
    "QualityRequest": "tools.quality",
    "quality": "tools.quality:survey_quality",
    "RasterFiles": "tools.rasters.rows",
    "RasterTarget": "rasters.cell_grid",
    "ClassifyRequest": "runs.requests",
    "PointRequest": "runs.requests",
    "TerrainRequest": "runs.requests",
    "classify": "runs.entry",
    "terrain": "runs.entry",
    "compare_settings": "tools.compare_settings",
    "TrialOptions": "tools.compare_settings.settings",
    "GridMinimum": "filters.grid_minimum",
    "SlopeFilter": "filters.slope",
    "TinDensification": "filters.tin",
    "ModelKeyPoints": "grids.model_key_points",
    "AboveGround": "tools.above_ground.classes",
    "assess": "tools.assess:assess_files",
    "Accuracy": "tools.check.accuracy",
    "CheckOptions": "tools.check.checking",
    "CheckOutputs": "tools.check.checking",
    "CheckRequest": "tools.check.checking",
    "check": "tools.check.checking:check_files",
    "Contours": "tools.contours",
    "write_contours": "tools.contours",
    "ReliefPictures": "tools.relief",
    "write_relief": "tools.relief",
    "SurfaceModel": "tools.rasters.parameters",
    "TerrainModel": "tools.rasters.parameters",
    "Water": "tools.water.finding",
    "ClassifyWater": "tools.water_classes",
    "WaterClasses": "tools.water_classes",
    "WaterPolygons": "tools.water_classes",
    "WaterRequest": "tools.water.tool",
    "find_water": "tools.water.tool:write_water",
    "HeightRaster": "rasters.sampling",
    "Area": "survey.area",
    "Checkpoints": "tools.check.checkpoints",
    "read_checkpoints": "tools.check.reading",
    "Corrections": "survey.corrections",
    "GroundClasses": "survey.ground_classes",
    "Selection": "survey.selection",
    "read_boundary": "survey.vector_files",
    "read_corrections": "survey.vector_files",
    "read_lines": "survey.vector_files",
}

__all__ = [*_MODULES, *(each.file for each in POINT_TOOLS.values())]


def __getattr__(name: str) -> Any:
    for command, listed in POINT_TOOLS.items():
        if name == listed.file:
            return importlib.import_module(".runs.entry", __name__).function_of(command)
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    module, _, there = _MODULES[name].partition(":")
    return getattr(importlib.import_module(f".{module}", __name__), there or name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
