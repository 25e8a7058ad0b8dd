"""Ground classification of many files as one survey, in the toolbox."""

from ...algorithms.tools.ground.tool import TILES_TOOL as TOOL
from ...algorithms.tools.ground.tool import as_command
from .area import add_area, add_limits, area_options, given_options, limits_of
from .base import BareEarthAlgorithm, command_line
from .classified import show_classified
from .inputs import add_clouds, clouds_of, names_of
from .outputs import TILES_STAY, add_rasters, add_tiles, raster_files, raster_paths, shown_rasters


class ClassifyTilesAlgorithm(BareEarthAlgorithm):
    """Classify ground (many files)."""

    identifier, page, section, shown = TOOL.identifier, TOOL.page, TOOL.section, TOOL.shown
    title, summary, about, words = TOOL.title, TOOL.summary, TOOL.about, TOOL.words
    run_name, cancelled, unused = "classified files", TILES_STAY, ("relief_radius",)

    def parameter_sets(self):
        """Return method, points and classes, files, outputs, and resources."""
        return TOOL.dialog_sets

    def initAlgorithm(self, configuration=None):
        """Declare the fields of the dialog and the results."""
        add_clouds(self)
        add_area(self, advanced=("EXTENT", "BOUNDARY"))
        self.add_declared()
        add_limits(self)
        add_tiles(self)
        add_rasters(self, ("dtm", "hillshade"))
        self.add_numbers(dict(TOOL.numbers))

    def find_inputs(self, parameters, context):
        """Find the input files."""
        self.inputs = clouds_of(self, parameters, context)
        self.subject = names_of(self.inputs)

    def prepare(self, parameters, context, progress):
        """Find the files, and read area, corrections and constraints."""
        super().prepare(parameters, context, progress)
        recursive = self.parameterAsBool(parameters, "RECURSIVE", context)
        crs = self.crs_of(*self.inputs, recursive=recursive)
        self._limits = limits_of(self, parameters, context, crs, progress)

    def compute(self, parameters, context, progress):
        """Classify the files."""
        from ...algorithms.runs.entry import classify
        from ...algorithms.runs.requests import ClassifyRequest

        chosen = as_command(self.chosen(parameters, context))
        folder = self.parameterAsFileOutput(parameters, "OUTPUT_FOLDER", context)
        vpc = self.parameterAsFileOutput(parameters, "OUTPUT_VPC", context)
        paths = raster_paths(self, parameters, context)
        words = [*map(str, self.inputs), folder, *area_options(self._limits["area"], progress)]
        given = {"VPC": vpc, **given_options(**self._limits), **paths}
        progress.command(command_line("classify-tiles", words, chosen, given))
        request = ClassifyRequest.of(chosen, rasters=raster_files(paths), **self._limits)
        summary = classify(self.inputs, folder, request, progress, None, vpc or None, True)
        progress.info(f"{summary.text}.")
        self.class_counts = summary.class_counts
        paths = shown_rasters(paths, request.raster_output, context)
        show_classified(self, summary.vpc, self.class_counts, request, context, progress)
        counts = {name: getattr(summary, name.lower()) for name, _ in TOOL.numbers}
        return {"OUTPUT_FOLDER": folder, "OUTPUT_VPC": summary.vpc, **paths, **counts}
