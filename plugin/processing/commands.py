"""The commands that do without QGIS what takes more than one of them."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Iterator, Mapping, Sequence

from ...algorithms.core.parameters import ParameterSet
from ...algorithms.engine.memory import Resources
from ...algorithms.engine.options import TileMethod
from ...algorithms.products.surface_model import SurfaceModel
from ...algorithms.products.terrain_model import TerrainModel
from ...algorithms.survey.selection import GROUND, Selection
from .base import command_line


def terrain_commands(
    sources: Sequence[Path], cloud: str, rasters: Mapping[str, str], chosen: Sequence[ParameterSet]
) -> Iterator[str]:
    """Yield the commands for a classified cloud and its rasters; local relief is QGIS's alone.

    Parameters
    ----------
    sources : sequence of Path
        The raw files.
    cloud : str
        The classified file, or the virtual point cloud of many; empty if none is kept.
    rasters : mapping of str to str
        Their files, by the names of their fields.
    chosen : sequence of ParameterSet
        The parameters, each where one of its type belongs.
    """
    of_type: dict[type, Any] = {type(each): each for each in chosen}
    made = cloud or "classified.laz"
    # Of many files, the folder that their virtual point cloud lies in.
    target = str(Path(made).parent) if made.endswith(".vpc") else made
    finding = [of_type[each] for each in (TileMethod, Selection, Resources)]
    yield command_line("classify", [*map(str, sources), target], finding, {})
    models = {name: path for name, path in rasters.items() if name != "RELIEF"}
    if models:
        ground = of_type[Selection].to_class
        options = {"ground-classes": "" if ground == GROUND else str(ground), **models}
        drawing = [of_type[each] for each in (TerrainModel, SurfaceModel, Resources)]
        yield command_line("terrain", [made], drawing, options)
