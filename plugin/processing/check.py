"""Comparison of ground points and a terrain model with checkpoints, in the toolbox."""

from __future__ import annotations

from pathlib import Path

from ...algorithms.survey.ground_classes import GroundClasses
from ...algorithms.tools.check.accuracy import Accuracy
from ...algorithms.tools.check.checking import CheckOptions, CheckOutputs, CheckRequest, check_files
from ..styles import layers
from . import checkpoints as fields
from .base import command_line
from .given_terrain import DTM, add_terrain, terrain_of
from .inputs import ANY_CLOUD_HELP, SurveyInput
from .products import ProductAlgorithm
from .stated_crs import add_crs


class CheckAlgorithm(ProductAlgorithm):
    """Check against checkpoints."""

    identifier, page, section = "check", "check", "Quality"
    title = "Check against checkpoints"
    summary = "Compares ground points and a terrain model with points surveyed on the ground."
    about = (
        "Compares the triangulation (TIN) of the ground points of a classified point cloud, and a"
        " terrain model, with checkpoints: points that were surveyed on the ground. It gives the"
        " figures and the statement of the ASPRS Positional Accuracy Standards, edition 2, on land"
        " without vegetation (NVA) and with it (VVA). Nothing is shifted.\n"
        "Without checkpoints, it can leave out a share of the ground points and measure how well"
        " the others predict them."
    )
    shown = ("accuracy_class",)
    numbers = (
        ("CHECKPOINT_COUNT", "Checkpoints"), ("COUNTED", "Counted checkpoints"),
        ("NVA_RMSE", "RMSE without vegetation [m]"), ("VVA_RMSE", "RMSE with vegetation [m]"),
        ("SHIFT", "Mean difference [m]"), ("HOLD_OUT_RMSE", "RMSE of held-out points [m]"),
    )  # fmt: skip

    def parameter_sets(self):
        """Return the class to meet, the options, and the ground classes."""
        return Accuracy, CheckOptions, GroundClasses

    def initAlgorithm(self, configuration=None):
        """Declare the fields of the dialog and the results."""
        self.addParameter(SurveyInput("INPUT", "Classified point cloud"), ANY_CLOUD_HELP)
        fields.add_checkpoints(self)
        text = "The heights of this raster are compared with the checkpoints as well."
        add_terrain(self, DTM, "Terrain model", text)
        add_crs(self)
        self.add_declared()
        fields.add_judgement(self)
        fields.add_residuals(self)
        self.add_numbers(dict(self.numbers))

    def prepare(self, parameters, context, progress):
        """Find the rasters."""
        super().prepare(parameters, context, progress)
        self._dtm = terrain_of(self, parameters, context)
        self._judgement = fields.judgement_of(self, parameters, context)

    def compute(self, parameters, context, progress):
        """Compare them."""
        crs = self.crs_of(self.source)
        given, flags = fields.checkpoints_of(self, parameters, context, crs, progress)
        layer = fields.residuals_path(self, parameters, context, given)
        page = self.parameterAsFileOutput(parameters, "REPORT", context)
        chosen, rest = self.chosen(parameters, context), {"dtm": self._dtm, "crs": self.stated}
        rest.update(self._judgement)
        flags = {**flags, **rest, "report": page, "residuals": layer}
        progress.command(command_line("check", [str(self.source)], chosen, flags))
        outputs = CheckOutputs(Path(page) if page else None, None, Path(layer) if layer else None)
        request = CheckRequest.of(chosen, checkpoints=given, outputs=outputs, **rest)
        check = check_files([self.source], request, progress)
        progress.info("\n".join(check.lines()))
        self.show(layer, layers.residuals(check.scale))
        results = {"OUTPUT": layer, "REPORT": page, **self.numbers_of(check)}
        return {name: it for name, it in results.items() if it not in (None, "")}
