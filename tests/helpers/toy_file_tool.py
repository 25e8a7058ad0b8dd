"""A tool for files as somebody would add it: all that it is stands here."""

import sys
import types
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bare_earth import Progress
from bare_earth.algorithms.core.parameters import ParameterSet, parameter
from bare_earth.algorithms.rasters.geotiff import NODATA, read_raster
from bare_earth.algorithms.rasters.writing import write_geotiff
from bare_earth.algorithms.tools.declaration import TERRAIN, FileTool, Input, Output
from bare_earth.algorithms.tools.listing import FILE_TOOLS, Listed


@dataclass(frozen=True)
class Lift(ParameterSet):
    """How high land is lifted."""

    lift: float = parameter(2.0, label="Lift", unit="m", help="How much higher all land gets.")


@dataclass(frozen=True)
class Lifted:
    """What was lifted."""

    cell_count: int

    @property
    def text(self):
        return f"{self.cell_count:,} cells are higher"


def lift_raster(source, output, table, lift=Lift(), progress=Progress()):
    raster = read_raster(source, progress=progress)
    known = ~np.isnan(raster.heights)
    if table is not None:
        Path(table).write_text(f"cells\n{known.sum()}\n", encoding="utf-8")
    heights = np.where(known, raster.heights + lift.lift, NODATA).astype(np.float32)
    write_geotiff(output, heights, raster, NODATA, progress, "Height, {unit}")
    return Lifted(int(known.sum()))


TOOL = FileTool(
    work=lift_raster,
    sets=(Lift,),
    inputs=(Input("source", "raster", help="A raster of heights.", label="Land", named="INPUT"),),
    outputs=(
        Output("output", "raster", "The higher land.", "Higher land", look="dtm", is_main=True),
        Output("table", "table", "The number of cells."),
    ),
    command="lift",
    identifier="lift",
    title="Lift land",
    about="All cells get higher. Nothing else changes.",
    page="index",
    words=(TERRAIN, "toy"),
    numbers=(("CELL_COUNT", "Cells"),),
)


def add_toy(monkeypatch):
    """Do what a file in `algorithms/tools/` and its line in the list of tools do."""
    module = types.ModuleType("bare_earth.algorithms.tools.lift")
    module.TOOL = TOOL
    monkeypatch.setitem(sys.modules, module.__name__, module)
    monkeypatch.setitem(FILE_TOOLS, TOOL.command, Listed("lift", "Makes land higher."))
