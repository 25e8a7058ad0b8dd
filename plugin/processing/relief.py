"""Pictures of the relief of a terrain model, in the toolbox."""

from __future__ import annotations

from pathlib import Path

from qgis.core import (
    QgsProcessingOutputRasterLayer,
    QgsProcessingParameterFolderDestination,
    QgsProcessingParameterRasterLayer,
)

from ...algorithms.tools.rasters.rows import RASTERS
from ...algorithms.tools.relief import KINDS, ReliefKinds, ReliefPictures, write_reliefs
from .. import compat
from ..i18n import mark
from ..styles import layers
from .base import BareEarthAlgorithm, command_line
from .inputs import raster_of


class ReliefAlgorithm(BareEarthAlgorithm):
    """Relief of a terrain model."""

    identifier = page = "relief"
    title = "Relief of a terrain model"
    section, run_name = "Products", mark("relief")
    summary = "Shows mounds, walls, ditches and old paths: sky view, openness, local relief, VAT."
    about = (
        "Makes pictures of the relief of any elevation raster, on the same grid: sky-view factor,"
        " openness, local dominance, local relief, slope, hillshade, archaeological topography"
        " (VAT) and red relief. They show small features that a hillshade of one light hides.\n"
        "For walls and banks make the terrain model in cells of 0.25 to 0.5 m."
    )

    def parameter_sets(self):
        """Return what to make, and how."""
        return ReliefKinds, ReliefPictures

    def initAlgorithm(self, configuration=None):
        """Declare the fields of the dialog and the results."""
        self.addParameter(
            QgsProcessingParameterRasterLayer("INPUT", "Terrain model"),
            "A raster file with a band of heights.",
        )
        self.add_declared()
        self.addParameter(
            QgsProcessingParameterFolderDestination("OUTPUT_FOLDER", "Folder of the rasters"),
            "The folder for the rasters (GeoTIFF). They are named after what they show, such as"
            " vat.tif and sky-view.tif.",
        )
        for name in KINDS.values():
            self.addOutput(QgsProcessingOutputRasterLayer(name.upper(), RASTERS[name].title))

    def find_inputs(self, parameters, context):
        """Find the input file."""
        text = mark("The elevation raster is not a file. Export it as GeoTIFF first.")
        layer = raster_of(self, parameters, "INPUT", context, text)
        self._source, self.subject = layer.source(), layer.name()
        self.inputs = [Path(self._source)]

    def compute(self, parameters, context, progress):
        """Make the rasters of the wanted kinds."""
        sets = self.chosen(parameters, context)
        kinds, how = ReliefKinds.among(sets).kinds, ReliefPictures.among(sets)
        folder = Path(self.parameterAsFileOutput(parameters, "OUTPUT_FOLDER", context))
        for kind in kinds:
            words = [self._source, str(folder / f"{kind}.tif")]
            progress.command(command_line("relief", words, [how], {"kind": kind}))
        made = write_reliefs(self._source, folder, kinds, how, progress)
        results = {KINDS[kind].upper(): str(path) for kind, path in made.items()}
        looks = layers.raster_looks()
        for name, path in results.items():
            compat.load_raster(path, context)
            self.show(path, looks[name])
        return {"OUTPUT_FOLDER": str(folder), **results}
