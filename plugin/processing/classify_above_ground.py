"""Classes of the points above the ground, in the toolbox."""

from __future__ import annotations

from pathlib import Path

from ...algorithms.engine.memory import Resources
from ...algorithms.products.above_ground import AboveGround
from ...algorithms.survey.ground_classes import GroundClasses
from ..styles import layers
from .base import command_line
from .products import ProductAlgorithm


class ClassifyAboveGroundAlgorithm(ProductAlgorithm):
    """Classify above ground."""

    identifier = "classifyaboveground"
    title = "Classify above ground"
    summary = "Finds vegetation, buildings and bridges in a point cloud whose ground is known."
    about = (
        "Classifies the points above the ground of a classified point cloud: low, medium and high"
        " vegetation (3, 4, 5) by height above ground, buildings (6), bridges (17) and high noise"
        " (18). Buildings are found by planes that laser pulses meet once; without return numbers"
        " the planes alone decide, and smooth crowns can become buildings.\n"
        "Only points of class 0 and 1 change, unless you ask for more. Nothing else in the file"
        " changes. Lengths are metres, whatever the unit of the CRS."
    )
    page = "above-ground"
    cloud_label = "Point cloud with all classes"
    cloud_help = "The same points, with the classes above the ground."
    numbers = (
        ("POINT_COUNT", "Points"),
        ("GROUND_COUNT", "Ground points"),
        ("CHANGED_COUNT", "Points with a new class"),
    )

    def parameter_sets(self):
        """Return the classes and their limits, the ground classes, and resources."""
        return AboveGround, GroundClasses, Resources

    def compute(self, parameters, context, progress):
        """Find the classes and write them."""
        from ...algorithms.runs.entry import above_ground
        from ...algorithms.runs.requests import AboveGroundRequest

        chosen = self.chosen(parameters, context)
        output = self.cloud_output(parameters, context, progress)
        files = [str(self.source), output]
        progress.command(command_line("above-ground", files, chosen, {"crs": self.stated}))
        request = AboveGroundRequest.of(chosen, crs=self.stated)
        summary = above_ground(self.source, Path(output), request, progress)
        look = layers.classes(summary.class_counts)
        return self.done(output, summary, look, context, progress)
