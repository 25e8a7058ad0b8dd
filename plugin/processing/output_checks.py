"""Refuses, before a run, outputs that the run could not write at its end."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Callable, Sequence

from qgis.core import (
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterFolderDestination,
)

from ...algorithms.core.errors import OutputInUse
from ...algorithms.core.files import check_output
from ...algorithms.las.writing import check_cloud
from ...algorithms.rasters.writing import check_raster_output
from ...algorithms.report.page import check_page
from ...algorithms.survey.feature_files import FORMATS as LINE_FORMATS
from ...algorithms.survey.feature_files import check_features
from ...algorithms.survey.files import is_one_file
from ...algorithms.survey.vpc import SUFFIX, check_vpc
from ..styles import loaded
from .outputs import given_path

Check = Callable[[Path, "tuple[Path, ...]"], None]


def check_outputs(
    algorithm: QgsProcessingAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    sources: Sequence[Path],
) -> None:
    """Refuse, as the run would, files in missing folders or with unsuitable names or endings."""
    for output in algorithm.destinationParameterDefinitions():
        path = given_path(parameters.get(output.name()), context)
        if path is None:
            continue
        try:
            _check_of(output)(path, tuple(sources))
        except OutputInUse:
            # Layers let go of their files before the run, which asks again.
            is_main = loaded.in_main_thread()
            if not is_main or not loaded.sources_of(context.project(), [path]):
                raise


def _check_of(output: QgsProcessingParameterDefinition) -> Check:
    """Return the check for the kind of an output."""
    if isinstance(output, QgsProcessingParameterFolderDestination):
        return _check_folder
    ending = f".{output.defaultFileExtension()}"
    if ending in LINE_FORMATS:
        return check_features
    checks: dict[str, Check] = {
        ".html": check_page,
        ".tif": check_raster_output,
        SUFFIX: _check_list,
    }
    return checks.get(ending, _check_points)


def _check_points(path: Path, sources: tuple[Path, ...]) -> None:
    """Check a point cloud; for many files, it is a folder, or gets another name."""
    if is_one_file(sources):
        check_cloud(sources[0], path)
    else:
        _check_folder(path, sources)


def _check_folder(path: Path, sources: tuple[Path, ...]) -> None:
    """Check a folder, which is made if its own folder exists."""
    if not path.exists():
        check_output(path)


def _check_list(path: Path, sources: tuple[Path, ...]) -> None:
    """Check a virtual point cloud, which may be in the folder that the run makes."""
    check_vpc(path)
    if path.parent.parent.is_dir() and not path.parent.exists():
        return
    check_output(path, sources)
