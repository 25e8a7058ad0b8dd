"""The dialogs of the tool that classifies the ground: one for each filter, one for many files."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

from ...classes.selection import Selection
from ...engine.memory import Resources
from ...engine.options import TileInput, TileOutput
from ...filters import METHODS
from ..above_ground.classes import ThenAboveGround
from ..declaration import (
    CLOUD,
    CLOUD_OUTPUT,
    GROUND,
    LIST_OUTPUT,
    RASTER,
    TERRAIN,
    TILES,
    TIN,
    Input,
    Output,
)
from ..rasters.parameters import Gaps, RasterOutput, TerrainModel
from ..rasters.tool import maps
from .method import TileMethod
from .output import PointOutput as Written
from .tool import TOOL


class _Filter(NamedTuple):
    """The texts of the dialog of a filter."""

    identifier: str
    title: str
    line: str
    about: str
    page: str
    words: tuple[str, ...]


_FILTERS = {
    "tin-densification": _Filter(
        "tindensification",
        "Classify ground (TIN densification)",
        "Finds the ground points of a lidar point cloud, and makes a terrain model of them.",
        "Progressive TIN densification starts from a sparse triangulation (TIN) of points that are"
        " surely ground. Round by round it adds points that lie close to the TIN.",
        "tin-densification",
        (TIN, "ptd,axelsson,densification"),
    ),
    "grid-minimum": _Filter(
        "gridminimum",
        "Classify ground (grid minimum)",
        "Finds the ground points of a lidar point cloud by rules on the lowest points of cells.",
        "Steps between neighbouring cells are the rims of objects. What such rims enclose is"
        " removed, tall objects first. The method is fast, and needs only heights, no return"
        " numbers.",
        "grid-minimum",
        (RASTER, "lowest,minimum"),
    ),
    "slope": _Filter(
        "slopefilter",
        "Classify ground (slope filter)",
        "Finds the ground points of a lidar point cloud by the slopes between neighbouring points.",
        "A point is not ground if it stands higher above a neighbour than terrain can. The preset"
        " Automatic compares points on many scales and follows the terrain; the preset Whitebox"
        " repeats WhiteboxTools' LidarGroundPointFilter.",
        "slope-filter",
        ("slope,vosselman,whitebox,top-hat",),
    ),
}
_ABOUT = (
    "A new point cloud gets the classes, and nothing else in it changes. Lengths are metres and"
    " angles degrees, whatever the unit of the CRS. The terrain model and its hillshade are"
    " GeoTIFFs."
)
_FOLDER = Output(
    "output",
    "folder",
    "The folder for the classified files. Each keeps its name.",
    label="Folder of the classified point clouds",
    named="OUTPUT_FOLDER",
    is_main=True,
)


def _usual_maps() -> list[Output]:
    named = {output.name: output for output in maps()}
    errors = (
        replace(named[name], by_default=False, advanced=True)
        for name in ("expected_error", "error_cause")
    )
    return [named["dtm"], named["hillshade"], *errors]


METHOD_TOOLS = tuple(
    replace(
        TOOL,
        method=name,
        points=Input("input", "cloud", label="Point cloud"),
        dialog_outputs=lambda: (CLOUD_OUTPUT, *_usual_maps()),
        dialog_sets=(
            METHODS[name].parameters, Selection, TerrainModel, Gaps, Written, ThenAboveGround,
            Resources,
        ),
        section="Ground classification",
        identifier=shown.identifier,
        title=shown.title,
        own_line=shown.line,
        about=f"{shown.about}\n{_ABOUT}",
        page=shown.page,
        run_name=METHODS[name].label,
        words=(CLOUD, GROUND, TERRAIN, *shown.words),
        shown=("preset", METHODS[name].size_parameter, "dtm_cell_size"),
        numbers=(
            ("POINT_COUNT", "Points"),
            ("AREA_COUNT", "Points in the area"),
            ("SELECTED_COUNT", "Points that took part"),
            ("GROUND_COUNT", "Ground points"),
        ),
    )
    for name, shown in _FILTERS.items()
)  # fmt: skip
TILES_TOOL = replace(
    TOOL,
    points=Input("input", "files", label="Point clouds"),
    dialog_inputs=tuple(
        replace(declared, advanced=True) if declared.kind == "area" else declared
        for declared in TOOL.dialog_inputs
    ),
    dialog_outputs=lambda: (_FOLDER, LIST_OUTPUT, *_usual_maps()),
    dialog_sets=(
        TileMethod, Selection, TileInput, TileOutput, Written, ThenAboveGround, TerrainModel, Gaps,
        RasterOutput, Resources,
    ),
    identifier="classifytiles",
    title="Classify ground (many files)",
    section="Ground classification",
    own_line="Finds the ground points of the many files of a survey, without seams between them.",
    about="The files are classified as if they were one, and each is written under its name into"
    " the output folder. A virtual point cloud (.vpc) lists the results.",
    page="many-files",
    run_name="classified files",
    words=(CLOUD, GROUND, TERRAIN, TILES),
    shown=("method", "preset"),
    numbers=(
        ("TILE_COUNT", "Tiles"),
        ("DONE_COUNT", "Classified tiles"),
        ("KEPT_COUNT", "Tiles kept"),
        ("POINT_COUNT", "Points"),
        ("GROUND_COUNT", "Ground points"),
    ),
)  # fmt: skip
