"""Rasters of the terrain and of what stands on it, in the toolbox."""

from __future__ import annotations

from ...algorithms.engine.memory import Resources
from ...algorithms.survey.files import is_one_file
from ...algorithms.survey.ground_classes import GroundClasses
from ...algorithms.tools.declaration import CANOPY, CLOUD, RASTER, TERRAIN, TIN
from ...algorithms.tools.rasters.parameters import RasterOutput, SurfaceModel, TerrainModel
from ..i18n import mark
from .area import OF_RASTERS, add_area, area_of, area_options, given_options
from .base import BareEarthAlgorithm, command_line
from .constraints import add_constraints, constraints_of
from .feedback import Refusal
from .inputs import ANY_CLOUD_HELP, SurveyInput, ignored_filter, name_of, source_path
from .outputs import add_rasters, raster_files, raster_paths, shown_rasters, usual_rasters
from .raster_target import add_raster_target, raster_target_of
from .stated_crs import add_crs

_NUMBERS = {"GROUND_COUNT": "Ground points", "SURFACE_COUNT": "Points of the surface"}


class TerrainModelAlgorithm(BareEarthAlgorithm):
    """Terrain and surface models."""

    identifier, section = "terrainmodel", "Products"
    title = "Terrain, surface and canopy height models"
    summary = "Makes terrain model, surface model, canopy height and hillshade of a point cloud."
    about = (
        "Makes rasters (GeoTIFF) of a classified point cloud: the terrain, interpolated on the"
        " triangulation (TIN) of the ground points; the surface, the highest point of each cell"
        " without noise; canopy height, the difference of the two; and a hillshade of the terrain."
        " All lie on the same grid. Heights are in the vertical unit of the CRS."
    )
    words = CLOUD, TERRAIN, CANOPY, TIN, RASTER
    page, run_name = "terrain-model", "terrain and surface"
    shown, unused = ("dtm_cell_size", "max_edge"), ("relief_radius",)

    def parameter_sets(self):
        """Return ground classes, cells and light, points of the surface, files, and resources."""
        return GroundClasses, TerrainModel, SurfaceModel, RasterOutput, Resources

    def initAlgorithm(self, configuration=None):
        """Declare the fields of the dialog and the results; all outputs are optional."""
        self.addParameter(SurveyInput("INPUT", "Classified point cloud"), ANY_CLOUD_HELP)
        add_crs(self)
        self.add_declared()
        add_area(self, ("EXTENT", "BOUNDARY"), OF_RASTERS)
        add_constraints(self)
        add_raster_target(self)
        add_rasters(self, usual_rasters("hillshade"))
        self.add_numbers(_NUMBERS)

    def find_inputs(self, parameters, context):
        """Find the input file."""
        self.source = source_path(self, parameters, "INPUT", context)
        self.inputs, self.subject = [self.source], name_of(self.source)

    def prepare(self, parameters, context, progress):
        """Find the input, and warn of a filter that is ignored."""
        super().prepare(parameters, context, progress)
        if ignored_filter(self, parameters, "INPUT", context):
            progress.warning("The layer's filter is not applied: all points are read.")

    def compute(self, parameters, context, progress):
        """Make the wanted rasters."""
        from ...algorithms.runs.entry import terrain
        from ...algorithms.runs.requests import TerrainRequest

        chosen = self.chosen(parameters, context)
        paths = raster_paths(self, parameters, context)
        if not paths:
            raise Refusal(mark("Choose at least one raster to make."))
        crs = self.crs_of(self.source)
        target = raster_target_of(self, parameters, context, crs)
        area = area_of(self, parameters, context, crs)
        options = {**given_options(self.stated, target), **paths}
        words = [str(self.source), *area_options(area, progress)]
        progress.command(command_line("terrain", words, chosen, options))
        wanted = {
            "rasters": raster_files(paths), "crs": self.stated, "raster_target": target,
            "constraints": constraints_of(self, parameters, context, crs, progress), "area": area,
        }  # fmt: skip
        request = TerrainRequest.of(chosen, **wanted)
        summary = terrain(self.source, request, progress)
        progress.info(f"The rasters have {summary.columns:,} x {summary.rows:,} cells.")
        if not is_one_file([self.source]):
            paths = shown_rasters(paths, request.raster_output, context)
        return {**paths, **{name: getattr(summary, name.lower()) for name in _NUMBERS}}
