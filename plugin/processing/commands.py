"""Command lines for an algorithm that needs more than one command outside QGIS."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Iterator, Mapping, Sequence

from ...algorithms.core.parameters import ParameterSet
from ...algorithms.engine.memory import Resources
from ...algorithms.runs.options import TileMethod
from ...algorithms.survey.kept_classes import GROUND
from ...algorithms.survey.selection import Selection
from ...algorithms.tools.contours import Contours
from ...algorithms.tools.rasters.parameters import MapTerrain, SurfaceModel, TerrainModel
from .area import NOTHING_GIVEN
from .base import command_line


def terrain_commands(
    sources: Sequence[Path],
    cloud: str,
    rasters: Mapping[str, str],
    chosen: Sequence[ParameterSet],
    area: Sequence[str] = (),
    given: Mapping[str, Any] = NOTHING_GIVEN,
) -> Iterator[str]:
    """Yield the commands for a classified cloud, empty if none is kept, and for its rasters and
    contour lines, by the names of their fields.
    """
    of_type: dict[type, Any] = {type(each): each for each in chosen}
    made = cloud or "classified.laz"
    # For many files, the folder of their virtual point cloud.
    target = str(Path(made).parent) if made.endswith(".vpc") else made
    finding = [of_type[each] for each in (TileMethod, Selection, Resources)]
    yield command_line(
        "classify", [*map(str, sources), target, *area], finding, {"crs": given["crs"]}
    )
    if rasters:
        ground = of_type[Selection].to_class
        classes = {"ground-classes": "" if ground == GROUND else str(ground)}
        options = {**classes, **given, **rasters}
        # The command has other defaults.
        model = TerrainModel(**vars(of_type[MapTerrain]))
        drawing = [model, *(of_type[each] for each in (SurfaceModel, Contours, Resources))]
        limits = [each for each in area if each != "--area-only"]
        yield command_line("terrain", [made, *limits], drawing, options)
