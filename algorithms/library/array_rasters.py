"""Functions on rasters in memory: contour lines, relief, a surface without objects."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Sequence

from ..core.parameters import ParameterSet
from ..rasters.content import NO_CELLS
from ..rasters.geotiff import read_raster
from ..tools import file_tool
from ..tools.change import Comparison, change
from ..tools.contours import Contours, contours_of
from ..tools.off_terrain import OffTerrain, remove_objects_file
from ..tools.relief import KINDS, ReliefKinds, ReliefPictures, draw_reliefs
from . import arguments
from .arguments import REQUIRED, Argument, Kind
from .features import Features
from .functions import Function
from .given import progress_of
from .raster_inputs import heights_of
from .rasters import Collected, Raster

_RASTER = (
    Argument.of(
        "raster",
        "raster",
        'A raster of heights, such as terrain(points)["dtm"], an xarray.DataArray with x and y, or'
        " a file.",
        REQUIRED,
    ),
)


def _contours(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> Features:
    raster = read_raster(heights_of(values.raster), window=NO_CELLS)
    _, layer, features = contours_of(raster, Contours.among(sets), progress_of(values.progress))
    return Features.of(layer, features)


def of_contours() -> Function:
    """Return the function `contours`."""
    return Function(
        "contours",
        f"{file_tool('contours').help} The lines are as contours() writes them for a file with"
        " the same cells.",
        _RASTER,
        (arguments.PROGRESS,),
        (Contours,),
        _contours,
        flags={"contour_interval": "interval"},
        gives=Kind(
            "Features",
            "The lines: ELEV is the height, INDEX 1 for every fifth line, DEPRESSION 1 for closed"
            " lines round lower land.",
        ),
    )


def _relief(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> dict[str, Raster]:
    names, collected = {kind: KINDS[kind] for kind in ReliefKinds.among(sets).kinds}, Collected()
    paths = {name: Path(name) for name in names.values()}
    draw_reliefs(
        heights_of(values.raster), paths, ReliefPictures.among(sets), progress_of(values.progress),
        collected.add, math.nan,
    )  # fmt: skip
    return {kind: collected.rasters[name] for kind, name in names.items()}


def of_relief() -> Function:
    """Return the function `relief`."""
    return Function(
        "relief",
        f"{file_tool('relief').line}\nThe cells are as relief() writes them for a file with the"
        " same cells; cells without data are NaN, or 0 in pictures.",
        _RASTER,
        (arguments.PROGRESS,),
        (ReliefKinds, ReliefPictures),
        _relief,
        flags={"kinds": "kind"},
        gives=Kind("dict[str, Raster]", "The rasters by their kinds."),
    )


def _bare(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> Raster:
    collected, name = Collected(), Path("without_objects")
    remove_objects_file(
        heights_of(values.raster), name, OffTerrain.among(sets), progress_of(values.progress),
        collected.add, math.nan,
    )  # fmt: skip
    return collected.rasters[name.name]


def of_removal() -> Function:
    """Return the function `remove_off_terrain_objects`."""
    return Function(
        "remove_off_terrain_objects",
        f"{file_tool('remove-off-terrain-objects').line}\nThe cells are as"
        " remove_off_terrain_objects() writes them for a file with the same cells;"
        " cells without data are NaN.",
        _RASTER,
        (arguments.PROGRESS,),
        (OffTerrain,),
        _bare,
        gives=Kind("Raster", "The heights on the same grid."),
    )


_DATES = (
    replace(_RASTER[0], name="old", help=f"The older terrain. {_RASTER[0].help}"),
    replace(_RASTER[0], name="new", help="The newer terrain, in the same way."),
)
_ERRORS = (
    Argument.of("old_error", "raster", "The expected error of the old terrain."),
    Argument.of("new_error", "raster", "The expected error of the new terrain."),
)


def _change(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> dict[str, Raster]:
    """Return the difference of two terrains, and the detection limit."""
    collected, errors = Collected(), (values.old_error, values.new_error)
    old_error, new_error = (one if one is None else heights_of(one) for one in errors)
    change(
        heights_of(values.old), heights_of(values.new), Path("difference"), Path("limit"),
        old_error=old_error, new_error=new_error, comparison=Comparison.among(sets),
        progress=progress_of(values.progress), write=collected.add, no_data=math.nan,
    )  # fmt: skip
    return collected.rasters


def of_change() -> Function:
    """Return the function `change`."""
    return Function(
        "change",
        f"{file_tool('change').line}\nThe cells are those that change() writes for files with the"
        " same cells; cells without data are NaN.",
        _DATES,
        (*_ERRORS, arguments.PROGRESS),
        (Comparison,),
        _change,
        without=("find_ground", "cell_size"),
        gives=Kind("dict[str, Raster]", "The difference and the detection limit (95 %)."),
    )
