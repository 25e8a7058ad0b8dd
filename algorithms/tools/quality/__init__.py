"""Quality: measures a classified survey, and compares it with a specification."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Mapping

from ...classes.ground_classes import GroundClasses
from ...core.errors import BareEarthError
from ...core.parameters import ParameterSet, parameter
from ...core.points import Frame
from ...core.progress import SILENT, Progress
from ...las.cloud import survey_frame
from ...survey.files import Inputs, Survey, open_survey
from ...survey.repeated_points import RepeatedPoints
from ..declaration import CLASSIFIED, CLOUD, CRS, TERRAIN, FileTool, Output
from .cells import QualityArrays, QualityCells
from .figures import Quality
from .grids import Grids
from .low_confidence import write_areas
from .made_points import MadePoints
from .measuring import quality_of
from .page import quality_html
from .rasters import QUALITY_RASTERS, write_rasters
from .specifications import SPECIFICATIONS

# Side in metres of the cells for first returns, without a specification.
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
    low_confidence_area: float = parameter(
        2000.0,
        label="Least low confidence area",
        unit="m2",
        minimum=0.0,
        maximum=500_000.0,
        advanced=True,
        help="Areas in which fewer points reach the ground than a quarter of the pulses have low"
        " confidence if they are as large as this. ASPRS states from half an acre (2000 m2) on, the"
        " more the coarser the survey; agree on it with your client.",
    )


def measure_quality(
    sources: Inputs,
    page: Path | None = None,
    folder: Mapping[str, Path] | None = None,
    low_confidence: Path | None = None,
    options: QualityOptions = QualityOptions(),
    ground: GroundClasses = GroundClasses(),
    progress: Progress = SILENT,
) -> Quality:
    """Measure the quality of one classified file, or of many as one survey, and write a page,
    rasters, given by their names, and low confidence areas.
    """
    # The files are read twice, part by part. Cells are in memory, or on disk if there are many.
    survey = open_survey(sources, progress.part(0.0, 0.02))
    if survey.broken:
        raise BareEarthError(survey.broken[0].reason)
    frame = survey_frame(survey.crs)
    with tempfile.TemporaryDirectory() as work:
        cells = _filled_cells(survey, frame, options, ground, Path(work), progress)
        quality, low = quality_of(cells, survey, options.specification, options.low_confidence_area)
        if folder:
            write_rasters(folder, cells, frame, progress.part(0.8, 0.98))
        if page:
            page.write_text(quality_html(quality, cells, survey, low), encoding="utf-8")
        if low_confidence:
            write_areas(low_confidence, low, frame, survey.crs, progress.part(0.98, 1.0))
    return quality


def _filled_cells(
    survey: Survey,
    frame: Frame,
    options: QualityOptions,
    ground: GroundClasses,
    work: Path,
    progress: Progress,
) -> QualityCells:
    """Return the cells of a survey with all of its points; `work` is a temporary folder."""
    asked = SPECIFICATIONS[options.specification]
    spacing = 2 * asked.spacing if asked.spacing else _SPACING
    boxes = [piece.box_in_metres for piece in survey.pieces]
    grids = Grids.over(boxes, options.cell_size, spacing, options.void_distance)
    count = max(grid.window.rows * grid.window.columns for grid in (grids.fine, grids.spaced))
    store = QualityArrays(work, count, sum(tile.count for tile in survey.tiles))
    repeated = RepeatedPoints(survey.tiles, store.array)
    made = MadePoints(survey, repeated.has_times, progress.part(0.02, 0.05))
    if made.all_synthetic and not asked.source:
        made.count_all_synthetic()
        progress.info("All points have the flag synthetic, as those of images do: all are counted.")
    cells = QualityCells(grids, options.void_distance, store, ground, repeated, made)
    for add, share in ((cells.add, (0.05, 0.4)), (cells.compare, (0.45, 0.8))):
        if add == cells.compare:
            cells.make_planes(progress.part(0.4, 0.45))
        for points in survey.parts(progress.part(*share), True, repeated.has_times):
            points.require_projected()
            add(points, frame)
    return cells


TOOL = FileTool(
    work=measure_quality,
    sets=(QualityOptions, GroundClasses),
    titles=("What is measured", "Ground points"),
    inputs=(CLASSIFIED, CRS),
    outputs=(
        Output(
            "page",
            "page",
            help="A web page with all figures, and maps of them.",
            label="Page about the quality",
            optional=False,
        ),
        Output(
            "folder",
            "folder",
            help="The folder for rasters (.tif), which is made if need be: densities, voids, low"
            " vegetation, overlap of strips, differences between strips, maximum surface height.",
            label="Folder of the rasters",
            by_default=False,
            files=lambda folder, sets: {name: folder / f"{name}.tif" for name in QUALITY_RASTERS},
        ),
        Output(
            "low_confidence",
            "features",
            help="Areas as polygons in which fewer points reach the ground than a quarter of"
            " the pulses, outside water and buildings, with their area, the density of ground"
            " points, and the share of cells with several returns.",
            label="Low confidence areas",
            by_default=False,
            look="low confidence",
        ),
    ),
    json="the figures",
    command="quality",
    identifier="quality",
    title="Quality of a survey",
    section="Quality",
    about="The figures of a classified survey, of one file or many, are densities of first returns"
    " and of ground points, voids, low vegetation, overlap of flight strips and differences between"
    " them, classes and file formats. A web page and rasters show them, and polygons show where too"
    " few points reach the ground (low confidence areas).",
    page="quality",
    run_name="quality",
    words=(
        CLOUD,
        TERRAIN,
        "quality,qc,density,pulse density,voids,low confidence,swath,strips,overlap,usgs,lbs,linz,"
        "ign,specification,lasoverlap,lasgrid",
    ),
    shown=("specification", "cell_size"),
    numbers=(
        ("PULSE_DENSITY", "First returns per m²"),
        ("GROUND_DENSITY", "Ground points per m²"),
        ("LOW_CONFIDENCE_SHARE", "Share of low confidence areas"),
        ("STRIP_RMS", "Differences between strips [m]"),
        ("MEETS_SPECIFICATION", "Meets the specification (1 or 0)"),
    ),
    texts=(("VERDICT", "Verdict"),),
)
