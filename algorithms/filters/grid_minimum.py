"""Rule-based minimum-Z grid filter.

References
----------
Prabhath, Perera and Arachchige: a rule-based minimum-Z grid filter. Only its abstract is public.
The rest is ours, see docs/grid-minimum.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet, parameter
from ..core.points import Points
from ..core.progress import Progress
from ..grids.cells import Cells, usual_count
from .cell_blocks import CellBlocks
from .method import TERRAINS, Method, as_given, of_preset
from .pipeline import Pipeline
from .stages import shared_pipeline
from .stages.accept import NearSurface
from .stages.breaks import Plants
from .stages.objects import BlockPits, FineSeeds, RaisedObjects, Rims, TallObjects
from .stages.seeds import LowestPoints, Seeds
from .stages.tolerance import PaperSurface, ToleranceSurface

# Least mean number of points in a cell: with fewer, gaps break the rims.
_POINTS_PER_CELL = 1.0
# Step in metres by which cells are enlarged where points are sparse.
_CELL_STEP = 0.5
# Cells that are too small by less than this share of their side are not enlarged.
_NEARLY = 0.05
# Least side in metres of the blocks in which the density is measured, and of the cells in which
# points are counted if those of the filter are too many.
_DENSITY_BLOCK = 10.0
# The distance within which points affect each other, as a multiple of the largest object, and its
# least value in metres.
_REACH_OBJECTS = 2.0
_LEAST_REACH = 100.0

# The preset with the rules of the paper.
CLASSIC = "paper"


class GridPreset(NamedTuple):
    """The values of a preset; lengths in metres."""

    cell_size: float  # the least; cells are larger where points are sparse
    height_thresholds: tuple[float, ...]
    final_height: float
    max_object_size: float
    slope_tolerance: float = 1.4  # share of the rise of the ground


class PaperPreset(NamedTuple):
    """The values of the paper, named as those of `GridPreset`, and its ground tolerance."""

    cell_size: float = 0.5
    height_thresholds: tuple[float, ...] = (5.0, 4.5, 2.0)
    final_height: float = 0.3
    max_object_size: float = 40.0
    ground_tolerance: float = 0.4  # above the surface of the ground in level terrain
    slope_tolerance: float = 0.6


PRESETS: dict[str, GridPreset | PaperPreset] = {
    "automatic": GridPreset(1.0, (5.0, 2.0), 0.3, 150.0),
    "flat": GridPreset(1.0, (5.0, 2.0), 0.25, 40.0),
    "hilly": GridPreset(2.0, (5.0, 2.0), 0.3, 25.0),
    "steep": GridPreset(1.0, (5.0, 2.0), 0.5, 25.0),
    "town": GridPreset(1.0, (5.0, 2.0), 0.3, 60.0),
    "city": GridPreset(1.0, (5.0, 2.0), 0.3, 120.0),
    "site": GridPreset(0.5, (5.0, 2.0), 0.5, 25.0),
    CLASSIC: PaperPreset(),
}


@dataclass(frozen=True)
class GridMinimum(ParameterSet):
    """Parameters of the minimum-Z grid filter."""

    preset: str = parameter(
        "automatic",
        label="Preset",
        choices={**TERRAINS, CLASSIC: "The paper's values"},
        help="Sets the fields that are left empty, to values that suit most land (automatic) or a"
        " kind of terrain. The log says which values were used.",
    )
    cell_size: float | None = of_preset(
        "Cell size",
        (0.01, 100.0),
        "Side of the square cells whose lowest points are compared. Smaller cells follow"
        " finer terrain if they hold at least one point, but have more rims at low plants. Empty:"
        " from the preset, or larger if points are too sparse for it.",
    )
    height_thresholds: tuple[float, ...] | None = parameter(
        None,
        label="Height thresholds",
        unit="m",
        minimum=0.05,
        maximum=1000.0,
        kind="numbers",
        empty="automatic",
        help="One pass for each threshold, the largest first. If two neighbouring cells differ by"
        " more than the threshold, the higher one is the rim of an object. Empty: from the preset.",
    )
    final_height: float | None = of_preset(
        "Final height",
        (0.01, 100.0),
        "The last pass removes whatever stands this far above the ground beside it: bushes,"
        " cars, walls. A larger value keeps more of rough ground. Empty: from the preset.",
    )
    max_object_size: float | None = of_preset(
        "Maximum object size",
        (0.1, 1000.0),
        "Shorter side of the largest building. Anything wider is terrain. Empty: from the preset.",
    )
    ground_tolerance: float | None = of_preset(
        "Ground tolerance",
        (0.0, 10.0),
        "In level terrain, points up to this height above the surface of the ground are"
        " ground. Empty: 0.18 m, and more where points are sparse or noisy; in the paper's preset"
        " 0.4 m.",
        advanced=True,
    )
    slope_tolerance: float | None = of_preset(
        "Ground tolerance on slopes",
        (0.0, 10.0),
        "This share of the rise of the ground from point to point, over at most a metre, is"
        " added to the ground tolerance. In the paper's preset it is a share of the rise over one"
        " cell. Empty: from the preset.",
        unit="",
        advanced=True,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        heights = self.height_thresholds
        if heights is None:
            return
        if not heights or any(low > high for high, low in zip(heights, heights[1:])):
            given = ", ".join(f"{height:g}" for height in heights) or "nothing"
            raise BareEarthError(
                f"Height thresholds must be a list from the largest to the smallest, not {given}."
            )

    def resolve(self, points: Points) -> GridMinimum:
        """Return the parameters with values in place of empty ones."""
        return self._resolved(_counting_cells(points, self))

    def _resolved(self, cells: Cells) -> GridMinimum:
        values = PRESETS[self.preset]._asdict()
        if self.cell_size is None and self.preset != CLASSIC:
            large_enough = _CELL_STEP * _multiple(_density(cells), _CELL_STEP)
            values["cell_size"] = max(values["cell_size"], large_enough)
        return self.filled(values)


def largest_object(parameters: GridMinimum) -> float:
    """Return the width in metres of the largest building that is removed."""
    return parameters.max_object_size or PRESETS[parameters.preset].max_object_size


def reach(parameters: GridMinimum) -> float:
    """Return the distance in metres within which points affect each other."""
    return max(_LEAST_REACH, _REACH_OBJECTS * largest_object(parameters))


def pipeline(points: Points, parameters: GridMinimum, progress: Progress) -> Pipeline:
    """Return the rules for some points, and tell which values were chosen."""
    # Objects are removed from the grid of lowest points: first tall ones, then the rims that are
    # left. Removed cells that are level with the ground beside them become ground again.
    cells = _counting_cells(points, parameters)
    resolved = parameters._resolved(cells)
    values = as_given(PRESETS[parameters.preset], resolved)
    if resolved != parameters:
        names = "preset", "cell_size", "height_thresholds", "final_height", "max_object_size"
        progress.choice(f"Grid minimum: {resolved.in_words(*names)}.")
    if parameters.cell_size is not None or parameters.preset == CLASSIC:
        _tell_of_gaps(_density(cells), values.cell_size, progress)
    if resolved.preset == CLASSIC:
        return _classic(as_given(PaperPreset(), resolved))
    size, heights = values.max_object_size, values.height_thresholds
    objects = RaisedObjects(size, heights)
    return shared_pipeline(
        LowestPoints(size=values.cell_size),
        size,
        ToleranceSurface(resolved.ground_tolerance, values.slope_tolerance),
        (Seeds(objects_wait=True), FineSeeds(values.final_height)),
        Plants(where_dense=False),
        is_site=parameters.preset == "site",
        objects=TallObjects(objects, min(heights)),
        opening=(Rims(objects, values.final_height),),
    )


def _classic(values: PaperPreset) -> Pipeline:
    """Return the rules of the paper's preset."""
    heights = values.height_thresholds
    objects = RaisedObjects(values.max_object_size, heights, whole_share=0.4, plateau_height=None)
    return Pipeline(
        (
            LowestPoints(size=values.cell_size),
            BlockPits(),
            TallObjects(objects, min(heights)),
            Rims(objects, values.final_height, objects_grow_back=True, width=None),
            PaperSurface(values.ground_tolerance, values.slope_tolerance),
            NearSurface(),
        )
    )


def _density(cells: Cells) -> float:
    """Return the median density of blocks within the survey, in points per square metre."""
    blocks = CellBlocks.over(cells, _DENSITY_BLOCK, least=1)
    return usual_count(blocks.total(cells.counts)) / blocks.size**2


def _tell_of_gaps(density: float, size: float, progress: Progress) -> None:
    """Warn if cells are too small for the number of points per square metre."""
    multiple = _multiple(density, size)
    if multiple > 1:
        progress.warning(
            f"{density:.2g} points/m2 are too few for cells of {size:g} m: the rims of objects"
            f" have gaps. Give a cell size of {multiple * size:g} m, or choose another preset."
        )


def _multiple(density: float, size: float) -> int:
    """Return the least multiple of the size of cells with which they hold about one point."""
    return max(math.ceil(math.sqrt(_POINTS_PER_CELL / density) / size - _NEARLY), 1)


def _counting_cells(points: Points, parameters: GridMinimum) -> Cells:
    """Return cells to count the points in: those of the filter, unless they are far too small."""
    size = parameters.cell_size or PRESETS[parameters.preset].cell_size
    if math.prod(points.sides) > size**2 * points.count:
        size = max(_DENSITY_BLOCK, 4.0 * size)
    return Cells.over(points, size)


METHOD = Method(
    "grid-minimum", "Grid minimum", GridMinimum, pipeline, reach, largest_object,
    "max_object_size", CLASSIC, PRESETS,
)  # fmt: skip
