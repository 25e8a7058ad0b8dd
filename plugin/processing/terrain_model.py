"""Rasters of the terrain and of what stands on it, in the toolbox."""

from __future__ import annotations

from ...algorithms.engine.memory import Resources
from ...algorithms.engine.options import RasterOutput
from ...algorithms.products.surface_model import SurfaceModel
from ...algorithms.products.terrain_model import TerrainModel
from ...algorithms.survey.files import is_one_file
from ...algorithms.survey.ground_classes import GroundClasses
from ..i18n import mark
from .base import command_line
from .constraints import add_constraints, constraints_of
from .feedback import Refusal
from .inputs import CloudCrs
from .outputs import add_rasters, raster_files, raster_paths, shown_rasters
from .products import ProductAlgorithm


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
    page, run_name = "terrain-model", mark("terrain and surface")
    shown = "dtm_cell_size", "max_edge"
    numbers = (("GROUND_COUNT", "Ground points"), ("SURFACE_COUNT", "Points of the surface"))

    def parameter_sets(self):
        """Return ground classes, cells and light, points of the surface, files, and resources."""
        return GroundClasses, TerrainModel, SurfaceModel, RasterOutput, Resources

    def add_outputs(self):
        """Add the fields of constraints and rasters; all of them are optional."""
        add_constraints(self)
        add_rasters(self)

    def compute(self, parameters, context, progress):
        """Make the wanted rasters."""
        from ...algorithms.engine.requests import TerrainRequest
        from ...algorithms.engine.runs import terrain

        chosen = self.chosen(parameters, context)
        paths = raster_paths(self, parameters, context)
        if not paths:
            raise Refusal(mark("Choose at least one raster to make."))
        progress.command(command_line("terrain", [str(self.source)], chosen, paths))
        known = constraints_of(self, parameters, context, CloudCrs(self.source), progress)
        request = TerrainRequest.of(chosen, rasters=raster_files(paths), constraints=known)
        summary = terrain(self.source, request, progress)
        progress.info(f"The rasters have {summary.columns:,} x {summary.rows:,} cells.")
        if not is_one_file([self.source]):
            paths = shown_rasters(paths, request.raster_output, context)
        return {**paths, **self.numbers_of(summary)}
