"""Rasters of the terrain and of what stands on it, in the toolbox."""

from __future__ import annotations

from pathlib import Path

from qgis.core import QgsProcessingParameterRasterDestination as Raster

from ...algorithms.core.errors import BareEarthError
from ...algorithms.engine.products import GroundClasses, write_terrain_models
from ...algorithms.engine.rasters import RasterFiles
from ...algorithms.products.surface_model import SurfaceModel
from ...algorithms.products.terrain_model import TerrainModel
from .base import command_line
from .outputs import ElevationStyle, style
from .products import ProductAlgorithm

_RASTERS = {
    "DTM": "Terrain model (DTM)",
    "DSM": "Surface model (DSM)",
    "CHM": "Canopy height (CHM)",
    "HILLSHADE": "Hillshade",
}


class TerrainModelAlgorithm(ProductAlgorithm):
    """Terrain and surface models."""

    identifier = "terrainmodel"
    title = "Terrain, surface and canopy height models"
    summary = "Makes terrain model, surface model, canopy height and hillshade of a point cloud."
    about = (
        "Makes rasters (GeoTIFF) of a classified point cloud: the terrain, interpolated on the"
        " triangulation (TIN) of the ground points; the surface, the highest point of each cell"
        " without noise; canopy height, the difference of the two; and a hillshade of the terrain."
        " All lie on the same grid. Heights are in the vertical unit of the CRS."
    )
    keywords = (
        "lidar", "point cloud", "las", "laz", "copc", "dtm", "dem", "dsm", "chm", "ndsm", "canopy",
        "hillshade", "relief", "raster", "rasterize", "interpolate", "tin", "elevation",
    )  # fmt: skip
    page = "terrain-model"
    numbers = (("GROUND_COUNT", "Ground points"), ("SURFACE_COUNT", "Points of the surface"))

    def parameter_sets(self):
        """Return ground classes, cells and light, and what makes the surface."""
        return GroundClasses, TerrainModel, SurfaceModel

    def add_outputs(self):
        """Add the rasters; none of them has to be made."""
        for name, label in _RASTERS.items():
            self.addParameter(Raster(name, label, None, True, name == "DTM"))

    def compute(self, parameters, context, progress):
        """Make those that are wanted."""
        chosen = self.chosen(parameters, context)
        paths = {name: self.parameterAsOutputLayer(parameters, name, context) for name in _RASTERS}
        if not any(paths.values()):
            raise BareEarthError("Choose at least one raster to make.")
        options = {name.lower(): path for name, path in paths.items()}
        progress.command(command_line("terrain", [str(self.source)], chosen, options))
        files = RasterFiles(*(Path(path) if path else None for path in paths.values()))
        summary = write_terrain_models(self.source, files, *chosen, progress)
        progress.info(f"The rasters have {summary.columns:,} x {summary.rows:,} cells.")
        for name in ("DTM", "DSM"):
            style(context, paths[name], ElevationStyle())
        made = {name: path for name, path in paths.items() if path}
        return {**made, **self.numbers_of(summary)}

    def createInstance(self):
        """Return another instance."""
        return TerrainModelAlgorithm()
