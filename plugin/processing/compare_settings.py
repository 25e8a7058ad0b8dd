"""Comparison of methods and presets on a window of a survey, in the toolbox."""

from __future__ import annotations

from pathlib import Path

from qgis.core import QgsProcessingParameterExtent as Extent
from qgis.core import QgsProcessingParameterFileDestination as File

from ...algorithms.engine.memory import Resources
from ...algorithms.tools.compare_settings.settings import TrialOptions
from ..i18n import tr
from .area import area_of
from .base import BareEarthAlgorithm, command_line
from .inputs import ANY_CLOUD_HELP, SurveyInput, add_crs, name_of, source_path

_EXTENT_HELP = (
    "The window to classify, such as the map's extent: at most 1,000 m wide, and quick up to about"
    " 250 x 250 m. It is transformed to the CRS of the points. Empty: 250 x 250 m in the middle of"
    " the points; the log says where."
)


class CompareSettingsAlgorithm(BareEarthAlgorithm):
    """Compare settings on a window."""

    identifier, page, section = "comparesettings", "compare-settings", "Quality"
    title = "Compare settings on a window"
    summary = "Tries methods and presets on a part of a point cloud, and shows them side by side."
    about = (
        "Classifies the points in a window with each of the settings, and makes a web page, which"
        " opens from the Results Viewer. It shows the terrain of each setting, a profile, the"
        " share of ground, where the settings differ, and how to run each of them on all points."
        " No point cloud is written. Of a COPC file only the window is read, which takes seconds;"
        " a LAS or LAZ file is read as a whole."
    )

    def parameter_sets(self):
        """Return the settings, and resources."""
        return TrialOptions, Resources

    def initAlgorithm(self, configuration=None):
        """Declare the fields of the dialog and the results."""
        self.addParameter(SurveyInput("INPUT", "Point cloud"), ANY_CLOUD_HELP)
        self.addParameter(Extent("EXTENT", "Window", None, True), _EXTENT_HELP)
        add_crs(self)
        self.add_declared()
        self.addParameter(
            File("OUTPUT", "Comparison of settings", tr("HTML files (*.html)")),
            "A web page, which the Results Viewer opens.",
        )

    def find_inputs(self, parameters, context):
        """Find the input."""
        self._source = source_path(self, parameters, "INPUT", context)
        self.inputs, self.subject = [self._source], name_of(self._source)

    def prepare(self, parameters, context, progress):
        """Find the input, and read the window in the CRS of the points."""
        super().prepare(parameters, context, progress)
        area = area_of(self, parameters, context, self.crs_of(self._source))
        self._window = area.box if area else None

    def compute(self, parameters, context, progress):
        """Make the page."""
        # Imported here, so that QGIS starts faster.
        from ...algorithms.tools.compare_settings import compare_settings

        chosen = self.chosen(parameters, context)
        page = self.parameterAsFileOutput(parameters, "OUTPUT", context)
        words = [str(self._source), page]
        command = command_line("compare-settings", words, chosen, {"crs": self.stated})
        window = ["--extent", *map(repr, self._window)] if self._window else []
        progress.command(" ".join([command, *window]))
        options, resources = TrialOptions.among(chosen), Resources.among(chosen)
        files = [self._source], Path(page)
        summary = compare_settings(*files, self._window, options, resources, progress, self.stated)
        progress.info("\n".join(summary.lines()))
        return {"OUTPUT": page}
