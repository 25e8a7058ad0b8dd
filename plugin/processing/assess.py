"""Comparison of a classification with a reference, in the toolbox."""

from __future__ import annotations

from pathlib import Path

from qgis.core import QgsProcessingParameterFileDestination as File
from qgis.core import QgsProcessingParameterRasterDestination as Raster

from ...algorithms.tools.assess import AssessmentOptions, assess_files
from ..i18n import tr
from .base import BareEarthAlgorithm, command_line
from .inputs import PointCloudInput, add_crs, name_of, source_path

_INPUTS = {
    "CLASSIFIED": (
        "Classified point cloud",
        "The point cloud to check. Its class 2 counts as ground, all other classes do not.",
    ),
    "REFERENCE": ("Reference", "The same points, or some of them, with their true classes."),
}
_NUMBERS = {
    "POINT_COUNT": "Points", "TYPE_1_ERROR": "Type I error [%]", "KAPPA": "Kappa [%]",
    "TYPE_2_ERROR": "Type II error [%]", "TOTAL_ERROR": "Total error [%]",
    "CLASSIFIED_ONLY": "Classified points only", "REFERENCE_ONLY": "Reference points only",
}  # fmt: skip


class AssessAlgorithm(BareEarthAlgorithm):
    """Assess a ground classification."""

    identifier, page, section = "assess", "assess", "Quality"
    title = "Assess a ground classification"
    summary = "Compares a classified point cloud with a reference: type I and II error, kappa."
    about = (
        "Compares the ground of a classified point cloud with a reference that holds the same"
        " points, or a part of them. Type I error: the share of the reference's ground that was"
        " rejected. Type II error: the share of all other points that was accepted as ground. The"
        " report is a web page with a map."
    )

    def parameter_sets(self):
        """Return the options."""
        return (AssessmentOptions,)

    def initAlgorithm(self, configuration=None):
        """Declare the fields of the dialog and the results."""
        for name, (label, text) in _INPUTS.items():
            self.addParameter(PointCloudInput(name, label), text)
        add_crs(self)
        self.add_declared()
        self.addParameter(
            File("REPORT", "Report", tr("HTML files (*.html)"), None, True, True),
            "A web page with the figures, and a map of where the errors are.",
        )
        self.addParameter(
            Raster("ERROR_MAP", "Error map", None, True, False),
            "The share of wrong points in each cell of a raster, 0 to 1.",
        )
        self.add_numbers(_NUMBERS)

    def find_inputs(self, parameters, context):
        """Find the input files."""
        self.inputs = [source_path(self, parameters, name, context) for name in _INPUTS]
        self.subject = name_of(self.inputs[0])

    def compute(self, parameters, context, progress):
        """Compare them."""
        (options,) = self.chosen(parameters, context)
        report = self.parameterAsFileOutput(parameters, "REPORT", context)
        error_map = self.parameterAsOutputLayer(parameters, "ERROR_MAP", context)
        paths = {"REPORT": report, "ERROR_MAP": error_map}
        flags = dict(zip(("report", "error-map", "crs"), (*paths.values(), self.stated)))
        progress.command(command_line("assess", [*map(str, self.inputs)], [options], flags))
        outputs = [Path(path) if path else None for path in paths.values()]
        assessment = assess_files(*self.inputs, options, *outputs, progress, self.stated)
        progress.info("\n".join(assessment.lines()))
        results = {**paths, **{name: assessment.as_dict()[name.lower()] for name in _NUMBERS}}
        return {name: it for name, it in results.items() if it not in (None, "")}
