"""Classes of ground points in water and beside its shore, in the toolbox."""

from __future__ import annotations

from pathlib import Path

from ...algorithms.engine.memory import Resources
from ...algorithms.las.writing import check_cloud
from ...algorithms.products.water_classes import WaterClasses
from ...algorithms.survey.files import is_one_file
from ...algorithms.survey.ground_classes import GroundClasses
from ..styles import layers
from .base import command_line
from .constraints import add_water, water_of, water_option
from .products import ProductAlgorithm


class WaterClassesAlgorithm(ProductAlgorithm):
    """Classify water."""

    identifier, page = "waterclasses", "water"
    title = "Classify water"
    summary = "Gives class 9 to ground points in water, and class 20 to those beside its shore."
    about = (
        "Ground points in polygons of water become water (9), and those within a distance of the"
        " shore ignored ground (20), as the Lidar Base Specification asks for. Nothing else in the"
        " file changes: points with other classes keep them."
    )
    cloud_label = "Point cloud with water"
    cloud_help = "The same points, with the classes of water and of ignored ground."
    numbers = (
        ("POINT_COUNT", "Points"),
        ("WATER_COUNT", "Points that became water"),
        ("IGNORED_COUNT", "Points that became ignored ground"),
    )

    def parameter_sets(self):
        """Return the classes, the ground classes, and resources."""
        return WaterClasses, GroundClasses, Resources

    def add_inputs(self):
        """Add the fields of the points and of the water."""
        super().add_inputs()
        add_water(self)

    def compute(self, parameters, context, progress):
        """Find the classes and write them."""
        from ...algorithms.runs.entry import water_classes
        from ...algorithms.runs.requests import WaterClassRequest

        chosen = self.chosen(parameters, context)
        output = self.cloud_output(parameters, context, progress)
        flags = {"water": water_option(parameters), "crs": self.stated}
        progress.command(command_line("water-classes", [str(self.source), output], chosen, flags))
        if is_one_file(self.inputs):
            check_cloud(self.source, Path(output))  # to find the water can take minutes
        given = parameters, context, GroundClasses.among(chosen)
        water = water_of(self, *given, progress.part(0.0, 0.4))
        request = WaterClassRequest.of(chosen, water=water, crs=self.stated)
        summary = water_classes(self.source, Path(output), request, progress.part(0.4, 1.0))
        look = layers.classes(summary.class_counts)
        return self.done(output, summary, look, context, progress)
