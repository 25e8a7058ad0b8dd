"""Measures the quality of a classified survey, and compares it with a specification."""

from __future__ import annotations

import contextlib
import tempfile
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Iterable

from ...core.errors import BareEarthError
from ...core.files import Outputs, new_folder
from ...core.parameters import HasSets, ParameterSet, parameter
from ...core.progress import SILENT, Progress
from ...las.cloud import survey_frame
from ...las.crs_records import WKT_RECORD
from ...las.reading import read_parts
from ...report.page import check_page
from ...survey.files import Survey, open_survey
from ...survey.ground_classes import GroundClasses
from ...survey.repeated_points import RepeatedPoints
from .cells import QualityCells, Sizes, Store
from .figures import Extent, Quality, figures_of, lines_of, totals_of
from .page import quality_html
from .rasters import check_rasters, write_rasters
from .specifications import SPECIFICATIONS

# Side of the cells in which first returns are looked for, if no specification says it.
_SPACING = 1.0


@dataclass(frozen=True)
class QualityOptions(ParameterSet):
    """How the quality of a survey is measured."""

    specification: str = parameter(
        "none",
        label="Specification",
        choices={name: each.label for name, each in SPECIFICATIONS.items()},
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
    """A request to measure the quality of a survey.

    Attributes
    ----------
    options : QualityOptions
        Specification and cell size.
    ground : GroundClasses
        Which points are ground.
    page : Path or None
        The page to write (.html).
    folder : Path or None
        A folder for the rasters; it is made if its parent exists.
    crs : str or None
        The CRS of the points in place of the one that files state: an EPSG code, such as
        "EPSG:25832", or "EPSG:2230+6360" with that of the heights, or well-known text.
    """

    options: QualityOptions = field(default_factory=QualityOptions)
    ground: GroundClasses = field(default_factory=GroundClasses)
    page: Path | None = None
    folder: Path | None = None
    crs: str | None = None


def survey_quality(
    sources: Iterable[Path],
    request: QualityRequest = QualityRequest(),
    progress: Progress = SILENT,
) -> Quality:
    """Measure the quality of one classified file, or of many as one survey.

    The files are read twice, part by part. Cells are held in memory, or on disk if there are many.

    Parameters
    ----------
    sources : iterable of Path
        LAS, LAZ and COPC files, folders of them, virtual point clouds and lists.
    request : QualityRequest
        What is measured and written.
    progress : Progress
        Receives progress and messages.

    Returns
    -------
    Quality

    Raises
    ------
    BareEarthError
        If an input cannot be read or an output cannot be written, or there are too many cells.
    Cancelled
        If the user asked to stop; no output is left behind.

    Examples
    --------
    >>> from bare_earth.algorithms import QualityRequest, quality
    >>> quality(["ground.laz"]).pulse_density  # doctest: +SKIP
    8.72
    """
    paths = [Path(each) for each in sources]
    with contextlib.ExitStack() as opened:
        if request.page:
            check_page(request.page, tuple(paths))
        if request.folder:
            opened.enter_context(new_folder(request.folder))
            check_rasters(request.folder, tuple(paths))
        survey = open_survey(paths, progress=progress.part(0.0, 0.02), stated=request.crs)
        if survey.broken:
            raise BareEarthError(survey.broken[0].reason)
        work = opened.enter_context(tempfile.TemporaryDirectory())
        return _measured(survey, request, Path(work), progress)


def _measured(survey: Survey, request: QualityRequest, work: Path, progress: Progress) -> Quality:
    """Measure an opened survey, and write what is asked for."""
    options, asked = request.options, SPECIFICATIONS[request.options.specification]
    frame = survey_frame(survey.crs)
    west, south, east, north = (each * frame.horizontal_unit for each in survey.box)
    spacing = 2 * asked.spacing if asked.spacing else _SPACING
    sizes = Sizes.over((west, south, east, north), options.cell_size, spacing)
    fine, filled = (window.rows * window.columns for window in (sizes.fine, sizes.filled))
    store = Store(work, max(fine, filled), sum(tile.count for tile in survey.tiles))
    repeated = RepeatedPoints(survey.tiles, store.array)
    from_images = not asked.source and _all_synthetic(survey)
    if from_images:
        progress.info("All points have the flag synthetic, as those of images do: all are counted.")
    cells = QualityCells(sizes, store, request.ground, repeated, from_images)
    for add, share in ((cells.add, (0.02, 0.4)), (cells.compare, (0.45, 0.8))):
        if add == cells.compare:
            cells.make_planes(progress.part(0.4, 0.45))
        weights = progress.part(*share).shares(*(max(each.count, 1) for each in survey.tiles))
        for tile, part in zip(survey.tiles, weights):
            for points in read_parts(tile, part.quiet(), strips=True, times=repeated.has_times):
                points.require_projected()
                add(points, frame)
    extent, void = Extent.of(cells), options.void_distance
    found = Quality(
        **totals_of(cells.counts), **figures_of(cells, extent, asked, void),
        specification=options.specification, files=_files(survey),
    )  # fmt: skip
    found = replace(found, lines=lines_of(found, survey, asked))
    with Outputs() as outputs:
        if request.folder:
            drawn, part = (cells, extent.inside, void, frame), progress.part(0.8, 0.98)
            write_rasters(request.folder, *drawn, outputs, part)
        if request.page:
            html = quality_html(found, cells, extent, asked, void, survey)
            page = outputs.file(request.page)
            page.write_text(html, encoding="utf-8")
        progress(1.0)  # the last moment to cancel
    return found


def _all_synthetic(survey: Survey) -> bool:
    """Return whether all points have the flag synthetic; mostly the first part of them tells."""
    parts = (part for tile in survey.tiles for part in read_parts(tile, strips=True))
    return all(part.synthetic is not None and part.synthetic.all() for part in parts)


def _files(survey: Survey) -> list[dict[str, Any]]:
    """Return what the headers of the files say."""
    return [
        {
            "name": each.path.name, "points": each.count, "version": f"1.{each.minor_version}",
            "format": each.point_format, "wkt": each.vlr(WKT_RECORD) is not None,
            "extent": list(each.outer_box),
        }
        for each in survey.tiles
    ]  # fmt: skip
