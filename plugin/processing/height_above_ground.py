"""Heights above ground, in the toolbox."""

from __future__ import annotations

from pathlib import Path

from ...algorithms.engine.memory import Resources
from ...algorithms.rasters.sampling import HeightRaster
from ...algorithms.steps.heights import HeightOutput
from ...algorithms.steps.output import HEIGHT_DIMENSION
from ...algorithms.survey.ground_classes import GroundClasses
from ..styles import layers
from .base import command_line
from .given_terrain import add_terrain, terrain_of
from .products import ProductAlgorithm


class HeightAboveGroundAlgorithm(ProductAlgorithm):
    """Height above ground."""

    identifier = "heightaboveground"
    title = "Height above ground"
    summary = "Adds the height of every point above the ground points of a point cloud."
    about = (
        "Adds the height above ground to every point of a classified point cloud: its height above"
        " the triangulation (TIN) of the ground points or, outside of it, above the nearest ground"
        " point. Heights are in the vertical unit of the CRS. They become an extra dimension,"
        " HeightAboveGround, or replace z; nothing else in the file changes.\n"
        "With a terrain model, heights are measured above that raster, and the points need no"
        " classes."
    )
    page = "height-above-ground"
    cloud_label = "Point cloud with heights"
    cloud_help = "The same points with their heights above ground."
    numbers = (
        ("POINT_COUNT", "Points"),
        ("GROUND_COUNT", "Ground points"),
        ("MINIMUM", "Lowest height"),
        ("MAXIMUM", "Highest height"),
    )

    def parameter_sets(self):
        """Return the ground classes, the output of heights, and resources."""
        return GroundClasses, HeightOutput, Resources

    def initAlgorithm(self, configuration=None):
        """Declare the fields of the dialog and the results."""
        super().initAlgorithm(configuration)
        add_terrain(self)

    def prepare(self, parameters, context, progress):
        """Find the inputs."""
        super().prepare(parameters, context, progress)
        self._dtm = terrain_of(self, parameters, context)

    def compute(self, parameters, context, progress):
        """Write the heights."""
        from ...algorithms.runs.entry import heights
        from ...algorithms.runs.requests import HeightRequest

        chosen = self.chosen(parameters, context)
        output = self.cloud_output(parameters, context, progress)
        options = {"DTM": self._dtm, "crs": self.stated}
        progress.command(command_line("height", [str(self.source), output], chosen, options))
        dtm = HeightRaster.of(self._dtm, progress) if self._dtm else None
        request = HeightRequest.of(chosen, dtm=dtm, crs=self.stated)
        summary = heights(self.source, Path(output), request, progress)
        attribute = "Z" if request.output.output_as == "z" else HEIGHT_DIMENSION
        unit = getattr(summary, "tiles", (summary,))[0].unit_size
        look = layers.heights(attribute, self.numbers_of(summary)["MAXIMUM"], unit)
        return self.done(output, summary, look, context, progress)
