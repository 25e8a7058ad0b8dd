"""The quality of a survey, compared with a specification, in the toolbox."""

from __future__ import annotations

from pathlib import Path

from qgis.core import QgsProcessingParameterFileDestination as File
from qgis.core import QgsProcessingParameterFolderDestination as Folder

from ...algorithms.survey.ground_classes import GroundClasses
from ...algorithms.tools.quality import QualityOptions, QualityRequest, survey_quality
from ...algorithms.tools.quality.rasters import raster_paths
from .. import compat
from ..i18n import mark, tr
from ..styles import layers
from .base import command_line
from .inputs import ANY_CLOUD_HELP, SurveyInput
from .products import ProductAlgorithm
from .stated_crs import add_crs


class QualityAlgorithm(ProductAlgorithm):
    """Quality of a survey."""

    identifier, page, section = "quality", "quality", "Quality"
    title, run_name = "Quality of a survey", mark("quality")
    summary = "Measures densities, voids and strips, and compares them with a specification."
    about = (
        "Measures a classified survey, of one file or many: densities of first returns and of"
        " ground points, voids, low vegetation, overlap of flight strips and differences between"
        " them, classes and file formats. It compares the figures with a specification, and makes a"
        " web page, which opens from the Results Viewer, and rasters."
    )
    shown = ("specification", "cell_size")
    numbers = (
        ("PULSE_DENSITY", "First returns per m²"),
        ("GROUND_DENSITY", "Ground points per m²"),
        ("STRIP_RMS", "Differences between strips [m]"),
    )

    def parameter_sets(self):
        """Return the options, and the ground classes."""
        return QualityOptions, GroundClasses

    def initAlgorithm(self, configuration=None):
        """Declare the fields of the dialog and the results."""
        self.addParameter(SurveyInput("INPUT", "Classified point cloud"), ANY_CLOUD_HELP)
        add_crs(self)
        self.add_declared()
        self.addParameter(
            File("PAGE", "Page about the quality", tr("HTML files (*.html)")),
            "A web page, which the Results Viewer opens.",
        )
        self.addParameter(
            Folder("FOLDER", "Folder of the rasters", None, True, False),
            "The folder for the rasters of densities, voids and strips, which are shown as layers.",
        )
        self.add_numbers(dict(self.numbers))

    def compute(self, parameters, context, progress):
        """Measure the survey."""
        chosen = self.chosen(parameters, context)
        page = self.parameterAsFileOutput(parameters, "PAGE", context)
        folder = self.parameterAsFileOutput(parameters, "FOLDER", context)
        flags = {"crs": self.stated, "page": page, "folder": folder}
        progress.command(command_line("quality", [str(self.source)], chosen, flags))
        request = QualityRequest.of(
            chosen, page=Path(page), folder=Path(folder) if folder else None, crs=self.stated
        )
        found = survey_quality([self.source], request, progress)
        progress.info("\n".join(found.text()))
        for name, path in raster_paths(Path(folder)).items() if folder else ():
            compat.load_raster(str(path), context)
            self.show(str(path), layers.look_of(name))
        results = {"PAGE": page, "FOLDER": folder, **self.numbers_of(found)}
        return {name: it for name, it in results.items() if it not in (None, "")}
