"""Model key points, in the toolbox."""

from __future__ import annotations

from pathlib import Path

from ...algorithms.engine.memory import Resources
from ...algorithms.grids.model_key_points import ModelKeyPoints
from ...algorithms.steps.key_points import KeyPointMark
from ...algorithms.survey.ground_classes import GroundClasses
from ..i18n import mark
from ..styles import layers
from .base import command_line
from .products import ProductAlgorithm


class ModelKeyPointsAlgorithm(ProductAlgorithm):
    """Classify model key points."""

    identifier = "modelkeypoints"
    title = "Classify model key points"
    summary = "Finds the few ground points that make as good a terrain model as all of them."
    about = (
        "Finds the few ground points of a classified point cloud that a terrain model needs. Of"
        " all other ground points, none lies farther above or below the triangulation (TIN) of"
        " these key points than the tolerances. Key points get a class of their own, or the"
        " key-point flag; nothing else in the file changes.\n"
        "Lengths are metres, whatever the unit of the CRS."
    )
    page = "model-key-points"
    cloud_label = "Point cloud with key points"
    cloud_help = "The same points, with the key points marked."
    numbers = (
        ("POINT_COUNT", "Points"),
        ("GROUND_COUNT", "Ground points"),
        ("KEY_POINT_COUNT", "Key points"),
    )

    def parameter_sets(self):
        """Return tolerances, ground classes, the mark of key points, and resources."""
        return ModelKeyPoints, GroundClasses, KeyPointMark, Resources

    def compute(self, parameters, context, progress):
        """Find and mark them."""
        from ...algorithms.runs.entry import key_points
        from ...algorithms.runs.requests import KeyPointRequest

        chosen = self.chosen(parameters, context)
        output = self.cloud_output(parameters, context, progress)
        files = [str(self.source), output]
        progress.command(command_line("key-points", files, chosen, {"crs": self.stated}))
        request = KeyPointRequest.of(chosen, crs=self.stated)
        summary = key_points(self.source, Path(output), request, progress)
        look = layers.classes(summary.class_counts, mark("key points"))
        return self.done(output, summary, look, context, progress)
