"""Refuses, before a run, outputs that the run could not write at its end."""

from __future__ import annotations

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterFolderDestination,
)

from ...algorithms.core.errors import OutputInUse
from ...algorithms.survey.feature_files import FORMATS
from ...algorithms.survey.files import Inputs
from ...algorithms.survey.outputs import check_kind
from ...algorithms.survey.vpc import SUFFIX
from ..styles import loaded
from .outputs import given_path


def check_outputs(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, object],
    context: QgsProcessingContext,
    sources: Inputs,
) -> None:
    """Refuse, as the run would, files in missing folders or with unsuitable names or endings."""
    for output in algorithm.destinationParameterDefinitions():
        path = given_path(parameters.get(output.name()), context)
        if path is None:
            continue
        try:
            check_kind(_kind_of(output, sources), path, sources)
        except OutputInUse:
            # Layers let go of their files before the run, which asks again.
            is_main = loaded.in_main_thread()
            if not is_main or not loaded.sources_of(context.project(), [path]):
                raise


def _kind_of(output: QgsProcessingParameterDefinition, sources: Inputs) -> str:
    """Return the kind of an output."""
    if isinstance(output, QgsProcessingParameterFolderDestination):
        return "folder"
    ending = f".{output.defaultFileExtension()}"
    kinds = {".html": "page", ".tif": "raster", SUFFIX: "list"}
    return "features" if ending in FORMATS else kinds.get(ending, sources.output_kind)
