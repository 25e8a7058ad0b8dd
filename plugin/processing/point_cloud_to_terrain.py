"""From a point cloud to all maps of its terrain in one step, in the toolbox."""

from __future__ import annotations

from pathlib import Path

from ...algorithms.engine.memory import Resources
from ...algorithms.engine.options import TileMethod
from ...algorithms.products.contours import Contours
from ...algorithms.products.surface_model import SurfaceModel
from ...algorithms.products.terrain_model import MapTerrain
from ...algorithms.survey.selection import Selection
from ..i18n import mark
from ..styles.layers import BELOW_TERRAIN, contours
from . import outputs
from .area import MAPPED, add_area, add_limits, area_options, given_options, limits_of
from .base import BareEarthAlgorithm
from .classified import show_classified
from .commands import terrain_commands
from .inputs import add_survey, names_of, survey_of


class PointCloudToTerrainAlgorithm(BareEarthAlgorithm):
    """Point cloud to terrain."""

    identifier, page = "pointcloudtoterrain", "point-cloud-to-terrain"
    title, section, run_name = "Point cloud to terrain", "All in one", mark("terrain")
    summary = "Makes a map of the terrain of a raw point cloud: classes, models, contours."
    about = (
        "Finds the ground of a raw lidar point cloud and makes maps of it. Each output is"
        " optional. Local relief shows small features. Lengths are metres."
    )
    shown = "method", "preset", "dtm_cell_size", "contour_interval"

    def parameter_sets(self):
        """Return method, cell size and contours, then parameters that rarely need a change."""
        return TileMethod, MapTerrain, Contours, Selection, SurfaceModel, Resources

    def initAlgorithm(self, configuration=None):
        """Declare the fields of the dialog and the results."""
        add_survey(self)
        add_area(self, helps=MAPPED)
        self.add_declared()
        add_limits(self)
        outputs.add_cloud(self, optional=True)
        outputs.add_rasters(self, default=("DTM", "HILLSHADE", "DSM", "CHM"))
        outputs.add_contours(self)
        self.add_numbers({"POINT_COUNT": "Points", "GROUND_COUNT": "Ground points"})

    def find_inputs(self, parameters, context):
        """Find the input files."""
        self.inputs = sources = survey_of(self, parameters, context)
        self.subject, self.cancelled = names_of(sources), outputs.after_cancel(sources)

    def compute(self, parameters, context, progress):
        """Make the wanted outputs."""
        from ...algorithms.engine.terrain_maps import MapFiles, MapRequest, make_maps

        limits = limits_of(self, parameters, context, self.crs_of(*self.inputs), progress)
        chosen = self.chosen(parameters, context)
        request = MapRequest.of(chosen, **limits)
        cloud = self.point_cloud_destination(parameters, "OUTPUT", context)
        results = outputs.raster_paths(self, parameters, context)
        lines, rasters = results.get("CONTOURS"), outputs.raster_files(results)
        files = MapFiles(cloud and Path(cloud), rasters, lines and Path(lines))
        summary = make_maps(self.inputs, files, request, progress)
        made = str(cloud and summary.cloud)
        words = area_options(request.area, progress, is_all=True), given_options(**limits)
        for each in terrain_commands(self.inputs, made, results, chosen, *words):
            progress.command(each)
        progress.share(summary.ground_count, summary.point_count, bool(request.area))
        if "CONTOURS" in results:
            self.show(results["CONTOURS"], contours(summary.contour_interval))
        if cloud:
            results["OUTPUT"], self.class_counts = made, summary.class_counts
            outputs.do_not_load(context, {cloud} - {made})
            look = request, context, progress, BELOW_TERRAIN
            show_classified(self, made, summary.class_counts, *look)
        return {**results, "POINT_COUNT": summary.point_count, "GROUND_COUNT": summary.ground_count}
