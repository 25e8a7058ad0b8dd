"""Lakes and rivers of a classified point cloud, in the toolbox."""

from __future__ import annotations

from pathlib import Path

from qgis.core import QgsProcessingOutputNumber, QgsProcessingParameterVectorDestination

from ...algorithms.survey.ground_classes import GroundClasses
from ...algorithms.tools.water.finding import Water
from ...algorithms.tools.water.tool import WaterRequest, write_water
from ..styles import layers
from .base import command_line
from .inputs import ANY_CLOUD_HELP, SurveyInput
from .products import ProductAlgorithm
from .stated_crs import add_crs


class WaterAlgorithm(ProductAlgorithm):
    """Find water."""

    identifier, page = "water", "water"
    title = "Find water"
    summary = "Finds lakes and rivers as polygons with their levels, and as breaklines."
    about = (
        "Finds water in a classified point cloud: where hardly any last return is, and the ground"
        " along the shore is level or falls steadily, or where points have class 9. Gaps between"
        " strips, roofs and woods are told from it. Each polygon has the level, the spread of the"
        " shore, and a grade of certainty. The terrain model takes the polygons as water."
    )
    shown = ("min_area", "min_width")
    numbers = (("LAKES", "Lakes"), ("RIVERS", "Parts of rivers"), ("AREA", "Area [m²]"))

    def parameter_sets(self):
        """Return the options, and the ground classes."""
        return Water, GroundClasses

    def initAlgorithm(self, configuration=None):
        """Declare the fields of the dialog and the results."""
        self.addParameter(SurveyInput("INPUT", "Classified point cloud"), ANY_CLOUD_HELP)
        add_crs(self)
        self.add_declared()
        self.addParameter(
            QgsProcessingParameterVectorDestination("OUTPUT", "Water"),
            "Polygons with the level (LEVEL), the spread of the shore in metres (SPREAD) and a"
            " grade of certainty (GRADE).",
        )
        self.addParameter(
            QgsProcessingParameterVectorDestination(
                "BREAKLINES", "Breaklines", optional=True, createByDefault=False
            ),
            "Shores, islands and the middles of rivers as lines with heights.",
        )
        for name, label in self.numbers:
            self.addOutput(QgsProcessingOutputNumber(name, label))

    def compute(self, parameters, context, progress):
        """Find the water."""
        output = self.parameterAsOutputLayer(parameters, "OUTPUT", context)
        lines = self.parameterAsOutputLayer(parameters, "BREAKLINES", context)
        chosen, files = self.chosen(parameters, context), [str(self.source), output]
        flags = {"crs": self.stated, "breaklines-out": lines}
        progress.command(command_line("water", files, chosen, flags))
        request = WaterRequest.of(
            chosen, crs=self.stated, breaklines=Path(lines) if lines else None
        )
        summary = write_water([self.source], Path(output), request, progress)
        progress.info(summary.text)
        self.show(output, layers.WATER)
        if lines:
            self.show(lines, layers.BREAKLINES)
        results = {"OUTPUT": output, "BREAKLINES": lines, **self.numbers_of(summary)}
        return {name: it for name, it in results.items() if it not in (None, "")}
