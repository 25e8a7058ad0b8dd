"""From a point cloud to all maps of its terrain in one step, in the toolbox."""

from __future__ import annotations

from ...algorithms.delivery.parameters import DeliveryChoice, DeliveryTerrain
from ...algorithms.engine.memory import Resources
from ...algorithms.survey.selection import Selection
from ...algorithms.tools.contours import Contours
from ...algorithms.tools.declaration import CANOPY, CLOUD, GROUND, TERRAIN, TILES
from ...algorithms.tools.ground.method import TileMethod
from ...algorithms.tools.rasters.parameters import SurfaceModel
from . import delivery, outputs
from .area import MAPPED, add_area, add_limits, limits_of
from .base import BareEarthAlgorithm
from .inputs import add_survey, names_of, survey_of
from .own_outputs import make_own


class PointCloudToTerrainAlgorithm(BareEarthAlgorithm):
    """Point cloud to terrain."""

    identifier, page = "pointcloudtoterrain", "point-cloud-to-terrain"
    title, section = "Point cloud to terrain", "All in one"
    summary = "Makes a map of the terrain of a raw point cloud: classes, models, contours."
    about = (
        "Finds the ground of a raw lidar point cloud and makes maps of it. Each output is"
        " optional. A delivery makes all that a job hands over, in one folder: for a survey,"
        " archaeology, forestry, floods or a drone site. Lengths are metres."
    )
    words = (
        CLOUD, GROUND, TERRAIN, CANOPY, TILES, "contours,workflow",
        "deliverables,archaeology,forestry,flood,drone",
    )  # fmt: skip
    shown = "delivery", "method", "preset", "dtm_cell_size", "contour_interval"

    def parameter_sets(self):
        """Return method, cell size and contours, then parameters that rarely need a change."""
        sets = DeliveryChoice, TileMethod, DeliveryTerrain, Contours, Selection, SurfaceModel
        return *sets, Resources, *delivery.SETS

    def initAlgorithm(self, configuration=None):
        """Declare the fields of the dialog and the results."""
        add_survey(self)
        add_area(self, helps=MAPPED)
        self.add_declared()
        add_limits(self)
        delivery.add_delivery(self)
        outputs.add_cloud(self)
        rasters = outputs.usual_rasters("hillshade", "relief")
        outputs.add_rasters(self, rasters, ("dtm", "hillshade", "dsm", "chm"))
        outputs.add_contours(self)
        self.add_numbers({"POINT_COUNT": "Points", "GROUND_COUNT": "Ground points"})

    def find_inputs(self, parameters, context):
        """Find the input files."""
        self.inputs = sources = survey_of(self, parameters, context)
        self.subject, self.cancelled = names_of(sources), outputs.after_cancel(sources)
        self.run_name = delivery.run_name_of(self.chosen(parameters, context))

    def check(self, parameters, context):
        """Check the values, and the folder of a delivery."""
        super().check(parameters, context)
        delivery.check_folder(self, parameters, context)

    def makes_page(self, parameters, context):
        """Return whether a delivery is chosen, which has a page."""
        return bool(delivery.delivery_of(self.chosen(parameters, context)))

    def compute(self, parameters, context, progress):
        """Make a delivery, or the wanted outputs."""
        delivery.tell_of_ignored(self, parameters, context, progress)
        limits = limits_of(self, parameters, context, self.crs_of(*self.inputs), progress)
        is_delivery = delivery.delivery_of(self.chosen(parameters, context))
        make = delivery.make_delivery if is_delivery else make_own
        return make(self, parameters, context, limits, progress)
