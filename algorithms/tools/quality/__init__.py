"""Quality: measures a classified survey, and compares it with a specification."""

from __future__ import annotations

import contextlib
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Iterable

from ...core.errors import BareEarthError
from ...core.files import Outputs, new_folder
from ...core.parameters import HasSets, ParameterSet, parameter
from ...core.progress import SILENT, Progress
from ...las.cloud import survey_frame
from ...las.reading import read_parts
from ...rasters.writing import check_raster_output
from ...report.page import check_page
from ...survey.files import Survey, open_survey
from ...survey.ground_classes import GroundClasses
from ...survey.repeated_points import RepeatedPoints
from .cells import Grids, QualityCells, Store
from .figures import Quality
from .measuring import quality_of
from .page import quality_html
from .rasters import raster_paths, write_rasters
from .specifications import SPECIFICATIONS

# Side of the cells in which first returns are looked for, if no specification says it.
_SPACING = 1.0


@dataclass(frozen=True)
class QualityOptions(ParameterSet):
    """How the quality of a survey is measured."""

    specification: str = parameter(
        "none",
        label="Specification",
        choices={name: asked.label for name, asked in SPECIFICATIONS.items()},
        help="The specification with which the survey is compared.",
    )
    cell_size: float = parameter(
        1.0,
        label="Cell size",
        unit="m",
        minimum=0.05,
        maximum=1000.0,
        help="Side of the cells of densities and voids. Strips and maximum heights have cells of"
        " twice this size.",
    )
    void_distance: float = parameter(
        3.0,
        label="Distance of voids",
        unit="m",
        minimum=0.1,
        maximum=100.0,
        advanced=True,
        help="Cells that are farther from a ground point are voids of the ground.",
    )


@dataclass(frozen=True)
class QualityRequest(HasSets):
    """A request to measure the quality of a survey."""

    options: QualityOptions = field(default_factory=QualityOptions)  # specification and cell size
    ground: GroundClasses = field(default_factory=GroundClasses)  # which points are ground
    page: Path | None = None  # the page to write (.html)
    folder: Path | None = None  # A folder for the rasters; it is made if its parent exists
    # The CRS of the points in place of the one that files state: an EPSG code, such as
    # "EPSG:25832", or "EPSG:2230+6360" with that of the heights, or well-known text
    crs: str | None = None


def survey_quality(
    sources: Iterable[Path],
    request: QualityRequest = QualityRequest(),
    progress: Progress = SILENT,
) -> Quality:
    """Measure the quality of one classified file, or of many as one survey."""
    paths = [Path(source) for source in sources]
    with contextlib.ExitStack() as opened:
        if request.page:
            check_page(request.page, tuple(paths))
        if request.folder:
            opened.enter_context(new_folder(request.folder))
            for raster in raster_paths(request.folder).values():
                check_raster_output(raster, tuple(paths))
        survey = open_survey(paths, progress=progress.part(0.0, 0.02), stated=request.crs)
        if survey.broken:
            raise BareEarthError(survey.broken[0].reason)
        work = opened.enter_context(tempfile.TemporaryDirectory())
        return _measured(survey, request, Path(work), progress)


def _measured(survey: Survey, request: QualityRequest, work: Path, progress: Progress) -> Quality:
    """Measure an opened survey, and write what is asked for."""
    options, asked = request.options, SPECIFICATIONS[request.options.specification]
    frame = survey_frame(survey.crs)
    west, south, east, north = (side * frame.horizontal_unit for side in survey.box)
    spacing = 2 * asked.spacing if asked.spacing else _SPACING
    grids = Grids.over((west, south, east, north), options.cell_size, spacing)
    count = max(grid.window.rows * grid.window.columns for grid in (grids.fine, grids.spaced))
    store = Store(work, count, sum(tile.count for tile in survey.tiles))
    repeated = RepeatedPoints(survey.tiles, store.array)
    from_images = not asked.source and _all_synthetic(survey)
    if from_images:
        progress.info("All points have the flag synthetic, as those of images do: all are counted.")
    void = options.void_distance
    cells = QualityCells(grids, void, store, request.ground, repeated, from_images)
    for add, share in ((cells.add, (0.02, 0.4)), (cells.compare, (0.45, 0.8))):
        if add == cells.compare:
            cells.make_planes(progress.part(0.4, 0.45))
        weights = progress.part(*share).shares(*(max(tile.count, 1) for tile in survey.tiles))
        for tile, part in zip(survey.tiles, weights):
            for points in read_parts(tile, part.quiet(), strips=True, times=repeated.has_times):
                points.require_projected()
                add(points, frame)
    found = quality_of(cells, survey, options.specification)
    with Outputs() as outputs:
        if request.folder:
            write_rasters(request.folder, cells, frame, outputs, progress.part(0.8, 0.98))
        if request.page:
            html = quality_html(found, cells, survey)
            outputs.file(request.page).write_text(html, encoding="utf-8")
        progress(1.0)  # the last moment to cancel
    return found


def _all_synthetic(survey: Survey) -> bool:
    """Return whether all points have the flag synthetic; mostly the first part of them tells."""
    parts = (part for tile in survey.tiles for part in read_parts(tile, strips=True))
    return all(part.synthetic is not None and part.synthetic.all() for part in parts)
