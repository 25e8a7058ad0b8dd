"""Finds where the ground changed between two surveys, and how sure that is."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Callable, Iterator

import numpy as np

from ...core.files import temporary_folder
from ...core.parameters import ParameterSet, parameter
from ...core.progress import SILENT, Progress
from ...engine.memory import Resources
from ...rasters.content import Source
from ...rasters.geotiff import NODATA
from ...rasters.sparse import RasterPart
from ...rasters.writing import RasterCells, write_geotiff
from ...survey.area import Polygon
from ...survey.feature_files import Feature, FeatureLayer, feature_writer
from ..contours import corners_of
from ..declaration import CLOUD, CRS, RASTER, TERRAIN, FileTool, Input, Output
from ..ground.method import TileMethod
from ..rasters.parameters import TerrainModel
from .judged import SAME, judged
from .page import change_html
from .pair import CellStrip, Pair, given, pair_of
from .places import Places, limits_of, places_of
from .stable import aligned, sample_of, scatter_of
from .summary import ChangeSummary, TerrainChange, summary_of

_FIELDS = {
    "RANK": int, "KIND": str, "AREA": float, "VOLUME": float, "VOLUME_ERR": float, "MEAN": float,
    "LARGEST": float, "LIMIT": float,
}  # fmt: skip
_DIGITS = 1, 2, 2, 3, 3, 3  # of the numbers in the layer, from the area on


@dataclass(frozen=True)
class Comparison(ParameterSet):
    """How two dates are compared."""

    alignment: str = parameter(
        "tilt",
        label="Alignment",
        choices={"tilt": "Shift and tilt", "shift": "Shift only", "none": "None"},
        help="What is taken off the difference: how the new terrain lies above the old one on"
        " stable land, which must be a third of the common area at least.",
    )
    move: bool = parameter(
        False,
        label="Take off the horizontal shift",
        advanced=True,
        help="The horizontal shift between both dates is told in any case. If it is taken off, the"
        " new terrain is interpolated once more.",
    )
    find_ground: bool = parameter(
        True,
        label="Find the ground of point clouds",
        help="Both point clouds are classified by the same method first. Otherwise their class 2 is"
        " ground.",
    )
    cell_size: float = parameter(
        1.0,
        label="Cell size",
        unit="m",
        minimum=0.01,
        maximum=1000.0,
        help="Side of a cell, if both dates are point clouds and no raster gives the grid.",
    )


def change(
    old: Source,
    new: Source,
    difference: Path | None = None,
    limit: Path | None = None,
    places: Path | None = None,
    page: Path | None = None,
    old_error: Source | None = None,
    new_error: Source | None = None,
    like: Source | None = None,
    crs: str | None = None,
    comparison: Comparison = Comparison(),
    how: Places = Places(),
    method: TileMethod = TileMethod(),
    resources: Resources = Resources(),
    progress: Progress = SILENT,
    write: Callable[..., None] = write_geotiff,
    no_data: float = NODATA,
) -> ChangeSummary:
    """Write how the ground changed from an old to a new survey: the difference, what of it can be
    told from errors, the places, and a page.
    """
    opening = progress.part(0.0, 0.0)
    dates = given(old, old_error, crs, opening), given(new, new_error, crs, opening)
    names = str(old), str(new)
    outputs = [path.parent for path in (difference, limit, places, page) if path is not None]
    beside = next((folder for folder in outputs if folder.is_dir()), Path(tempfile.gettempdir()))
    model = TerrainModel(dtm_cell_size=comparison.cell_size)
    made_of = model, method if comparison.find_ground else None, resources
    with temporary_folder(beside) as folder:
        pair = pair_of(dates, like, folder, made_of, progress.part(0.0, 0.6))
        found = _found(pair, names, comparison, how, progress.part(0.6, 0.8))
        clouds = [date.cloud for date in dates]
        every = judged(found.pair, found.alignment, found.places, clouds, progress.part(0.8, 0.9))
        kept = [place for place in every if place.kind != SAME]
        found = found._replace(places=kept)
        summary = summary_of(found, len(every) - len(kept))
        _write_rasters(found, (difference, limit), write, no_data, progress.part(0.9, 0.97))
        if places is not None:
            grid = found.pair.grid
            layer = FeatureLayer("change", "Polygon", _FIELDS, grid.frame.wkt, grid.crs.epsg)
            feature_writer(places)(places, features_of(found), layer, progress)
        if page is not None:
            html = change_html(names, found, summary.figures(found.pair.units), clouds)
            page.write_text(html, encoding="utf-8")
    progress(1.0)
    return summary


def _found(
    pair: Pair, names: tuple[str, str], comparison: Comparison, how: Places, progress: Progress
) -> TerrainChange:
    """Align both terrains, and find the places that changed."""
    sample = sample_of(pair, names, progress.part(0.0, 0.3))
    alignment = aligned(sample, comparison.alignment, names)
    if comparison.move and np.isfinite(alignment.east):
        east, north = alignment.east, alignment.north
        pair = pair.shifted(-east, -north)
        sample = sample_of(pair, names, progress.part(0.3, 0.4))
        alignment = replace(
            aligned(sample, comparison.alignment, names), east=east, north=north, is_moved=True
        )
    scatter = scatter_of(pair, sample, alignment, progress.part(0.4, 0.6))
    places = places_of(pair, alignment, scatter, how, progress.part(0.6, 1.0))
    return TerrainChange(pair, sample, alignment, scatter, places)


def _write_rasters(
    found: TerrainChange,
    paths: tuple[Path | None, Path | None],
    write: Callable[..., None],
    no_data: float,
    progress: Progress,
) -> None:
    """Write the difference and the detection limit."""
    pair, alignment, unit = found.pair, found.alignment, found.pair.grid.frame.vertical_unit

    def change_of(strip: CellStrip) -> np.ndarray:
        return alignment.of_strip(pair, strip)

    def limit_of(strip: CellStrip) -> np.ndarray:
        slope = strip.steepness(pair.cell)
        limits = limits_of(found.scatter, alignment, strip.spread, slope)
        return np.where(np.isnan(strip.change) | ~strip.is_seen, np.nan, limits)

    def parts(of: Callable[[CellStrip], np.ndarray], part: Progress) -> Iterator[RasterPart]:
        for strip in pair.strips(part):
            values = of(strip)[strip.own] / unit
            cells = np.where(np.isnan(values), no_data, values).astype(np.float32)
            yield RasterPart(strip.row + strip.own.start, 0, cells)

    shown = "Change of the ground, {unit}", "Detection limit (95 %), {unit}"
    for path, of, shows, part in zip(paths, (change_of, limit_of), shown, progress.shares(1, 1)):
        if path is not None:
            cells = RasterCells(pair.grid.whole, "float32", parts(of, part))
            write(path, cells, pair.grid, no_data, part, shows)


def features_of(found: TerrainChange) -> Iterator[Feature]:
    """Yield the places as polygons."""
    for rank, place in enumerate(found.places, start=1):
        rings: Polygon = tuple(corners_of(ring, found.pair.grid) for ring in place.rings)
        figures = map(round, place.in_units(found.pair.units), _DIGITS)
        yield Feature((rank, place.kind, *figures), rings)


_DATE = "a terrain model (a raster of heights), or a point cloud (a file, a folder or a .vpc)."
TOOL = FileTool(
    work=change,
    sets=(Comparison, Places, TileMethod, Resources),
    inputs=(
        Input("old", "terrain", help=f"The older survey: {_DATE}", label="Old survey"),
        Input("new", "terrain", help=f"The newer survey: {_DATE}", label="New survey"),
        *(
            Input(
                f"{date}_error",
                "raster",
                help=f"The expected error of the {date} terrain model, as `terrain()` makes it, if"
                " that is a raster.",
                label=f"Expected error of the {date} DTM",
                optional=True,
            )
            for date in ("old", "new")
        ),
        Input(
            "like",
            "raster",
            help="A raster whose grid the results get. Empty: that of the old terrain model, or of"
            " the new one if only that is a raster.",
            label="Raster with the grid to use",
            optional=True,
            advanced=True,
        ),
        CRS,
    ),
    outputs=(
        Output(
            "difference",
            "raster",
            help="New minus old height in each cell, after the alignment.",
            label="Change of the ground",
            named="OUTPUT",
            is_main=True,
            look="change",
        ),
        Output(
            "limit",
            "raster",
            help="The detection limit of each cell: 95 of 100 differences of unchanged cells are"
            " smaller. Empty where a point cloud has no ground within 2 m.",
            label="Detection limit",
            look="detection limit",
        ),
        Output(
            "places",
            "features",
            help="The places of significant change as polygons: what each probably is, area,"
            " volume with its error (95 %), mean and largest change, mean limit.",
            label="Places of change",
            look="places of change",
        ),
        Output(
            "page",
            "page",
            help="A page with a map, what stable land tells, the places, and profiles.",
            label="Page",
            named="REPORT",
        ),
    ),
    command="change",
    identifier="change",
    title="Change between two surveys",
    section="Products",
    about="Both dates are aligned on stable land first. A change counts where it exceeds the"
    " detection limit of its cells, and as a whole what correlated errors let expect. The limit"
    " follows from the expected errors of both terrain models, or for rasters without these from"
    " stable land.\n"
    "Volumes have an error (95 %) that takes errors as correlated over distance. What stands in the"
    " points of both dates alike is no change, whatever the ground filter made of it.",
    page="change",
    words=(CLOUD, TERRAIN, RASTER, "change,difference,dod,volume,erosion,landslide,detection,m3c2"),
    always_reports=True,
    run_name="change",
    shown=(),
    numbers=(
        ("PLACE_COUNT", "Places"),
        ("VOLUME_UP", "Volume up, m3"),
        ("VOLUME_UP_ERROR", "Error of the volume up, m3"),
        ("VOLUME_DOWN", "Volume down, m3"),
        ("VOLUME_DOWN_ERROR", "Error of the volume down, m3"),
        ("SHIFT", "Vertical shift taken off, m"),
    ),
)  # fmt: skip
