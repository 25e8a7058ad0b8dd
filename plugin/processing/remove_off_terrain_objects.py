"""Removal of buildings and trees from a surface raster, in the toolbox."""

from __future__ import annotations

from pathlib import Path

from qgis.core import (
    QgsProcessingOutputNumber,
    QgsProcessingParameterRasterDestination,
    QgsProcessingParameterRasterLayer,
)

from ...algorithms.tools.off_terrain import OffTerrain, remove_objects_file
from ..i18n import mark
from ..styles import layers
from .base import BareEarthAlgorithm, command_line
from .inputs import raster_of


class RemoveOffTerrainObjectsAlgorithm(BareEarthAlgorithm):
    """Remove off-terrain objects."""

    identifier = "removeoffterrainobjects"
    title = "Remove off-terrain objects"
    section = "Products"
    summary = "Removes buildings, trees and other steep-sided objects from an elevation raster."
    about = (
        "Makes a terrain model from a surface model, if there is no point cloud. Removes what"
        " stands above the terrain around it, has steep edges on all sides and is not wider than"
        " the maximum object size. Fills the gaps smoothly. Hills and slopes stay.\n"
        "The output has the same grid, CRS and unit. Lengths are metres, whatever the unit of the"
        " CRS."
    )
    page = "remove-off-terrain-objects"

    def parameter_sets(self):
        """Return the parameters."""
        return (OffTerrain,)

    def initAlgorithm(self, configuration=None):
        """Declare the fields of the dialog and the results."""
        self.addParameter(
            QgsProcessingParameterRasterLayer("INPUT", "Elevation raster"),
            "A surface model: a raster file with a band of heights.",
        )
        self.add_declared()
        self.addParameter(
            QgsProcessingParameterRasterDestination("OUTPUT", "Without objects"),
            "The same raster, with the terrain in place of the objects.",
        )
        self.addOutput(QgsProcessingOutputNumber("CELL_COUNT", "Cells with a height"))
        self.addOutput(QgsProcessingOutputNumber("REMOVED_COUNT", "Cells of objects"))

    def find_inputs(self, parameters, context):
        """Find the input file."""
        text = mark("The elevation raster is not a file. Export it as GeoTIFF first.")
        layer = raster_of(self, parameters, "INPUT", context, text)
        self._source, self.subject = layer.source(), layer.name()
        self.inputs = [Path(self._source)]

    def compute(self, parameters, context, progress):
        """Remove the objects."""
        (chosen,) = self.chosen(parameters, context)
        output = self.parameterAsOutputLayer(parameters, "OUTPUT", context)
        files = [self._source, output]
        progress.command(command_line("remove-off-terrain-objects", files, [chosen], {}))
        removal = remove_objects_file(self._source, Path(output), chosen, progress)
        progress.info(removal.text)
        self.show(output, layers.BARE)
        counts = {"CELL_COUNT": removal.cell_count, "REMOVED_COUNT": removal.removed_count}
        return {"OUTPUT": output, **counts}
