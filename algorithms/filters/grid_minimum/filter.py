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

import numpy as np

from ...core.errors import BareEarthError
from ...core.parameters import ParameterSet, parameter
from ...core.points import Points
from ...core.progress import SILENT, Progress
from ...grids.cell_blocks import CellBlocks
from ...grids.cells import Cells, usual_count
from ...grids.gradient import steepness
from ...grids.inpaint import inpaint
from ..shared.doubts import tell_of_outliers
from ..shared.ground_cells import ground_cells
from ..shared.ground_limits import Tolerance
from ..shared.height_steps import HeightSteps
from ..shared.near_ground import Candidates, near_ground
from ..shared.near_surface import near_surface
from ..shared.objects import PLATEAU_HEIGHT, Objects, covered, raised_objects
from ..shared.outliers import low_outliers, supported, under_canopy

# Points that a cell should hold on average: with fewer, gaps break the rims.
_POINTS_PER_CELL = 1.0
# Where points are sparse, the side of a cell is a multiple of this, in metres.
_CELL_STEP = 0.5
# Cells are not enlarged if they are too small by less than this share of their side.
_NEARLY = 0.05
# Least side in metres of the blocks in which the density is measured.
_DENSITY_BLOCK = 10.0
# Side in metres of the blocks in which tall objects are searched; a block has at least 2 x 2 cells.
_BLOCK = 1.0
# Passes over low objects: the first removal uncovers more.
_FINAL_PASSES = 2
# The unevenness of the terrain is added so many times to the height of rims that are removed.
_RIM_ROUGHNESS = 2.0
# Low noise is narrower than this, and so far below the usual lowest points round it, in metres.
_NOISE_WIDTH = 10.0
_NOISE_DEPTH = 2.0
# A pit of one cell with steeper sides (rise over run) is a low outlier.
_OUTLIER_SLOPE = 5.0
# Largest slope (rise over run) of the surface that counts, and relaxations across its gaps.
_STEEPEST = 5.0
_RELAXATIONS = 2
# From so many points per square metre on, pits with this gentler slope are noise, too: in dense
# points, a real pit would hold other points as well.
_DENSE, _OUTLIER_SLOPE_WHERE_DENSE = 3.0, 2.0
# The lowest point of a fine cell may lie off the surface by this share of the rise over a wide
# cell.
_UNEVENNESS = 0.6
# Side in metres of the cells of the final surface, unless the cells of the filter are smaller.
_FINE_CELL = 1.0
# Points affect each other within so many times the largest object, and within at least so many
# metres.
_REACH_OBJECTS, _LEAST_REACH = 2.0, 100.0

# The preset with the rules of the paper.
CLASSIC = "paper"


class Preset(NamedTuple):
    """The values of a preset.

    Attributes
    ----------
    label : str
        As in the dialog.
    cell_size : float
        Least cell size in metres. It grows where points are sparse, except in the paper's preset.
    height_thresholds : tuple of float
        In metres.
    final_height, max_object_size : float
        In metres.
    ground_tolerance, slope_tolerance : float
        In metres, and as a share of the rise.
    """

    label: str
    cell_size: float
    height_thresholds: tuple[float, ...]
    final_height: float
    max_object_size: float
    ground_tolerance: float = 0.18
    slope_tolerance: float = 1.4


PRESETS = {
    "automatic": Preset("Automatic", 1.0, (5.0, 4.5, 2.0), 0.3, 100.0),
    "flat": Preset("Flat land, fields", 1.0, (5.0, 4.5, 2.0), 0.25, 40.0),
    "hilly": Preset("Hilly land, forest", 2.0, (5.0, 4.5, 2.0), 0.3, 25.0),
    "steep": Preset("Steep or rugged terrain", 1.0, (5.0, 4.5, 2.0), 0.5, 25.0),
    "town": Preset("Town", 1.0, (5.0, 4.5, 2.0), 0.3, 60.0),
    "city": Preset("City, large halls", 1.0, (5.0, 4.5, 2.0), 0.3, 120.0),
    CLASSIC: Preset("The paper's values", 0.5, (5.0, 4.5, 2.0), 0.3, 40.0, 0.4, 0.6),
}


@dataclass(frozen=True)
class GridMinimum(ParameterSet):
    """Parameters of the minimum-Z grid filter.

    `resolve` fills empty ones from the preset.
    """

    preset: str = parameter(
        "automatic",
        label="Preset",
        choices={name: preset.label for name, preset in PRESETS.items()},
        help="Sets the fields that are left empty, to values that suit most land (automatic) or a"
        " kind of terrain. The log says which values were used.",
    )
    cell_size: float | None = parameter(
        None,
        label="Cell size",
        unit="m",
        minimum=0.01,
        maximum=100.0,
        kind="number",
        empty="automatic",
        help="Side of the square cells whose lowest points are compared. Smaller cells follow"
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
    final_height: float | None = parameter(
        None,
        label="Final height",
        unit="m",
        minimum=0.01,
        maximum=100.0,
        kind="number",
        empty="automatic",
        help="The last pass removes whatever stands this far above the ground beside it: bushes,"
        " cars, walls. A larger value keeps more of rough ground. Empty: from the preset.",
    )
    max_object_size: float | None = parameter(
        None,
        label="Maximum object size",
        unit="m",
        minimum=0.1,
        maximum=1000.0,
        kind="number",
        empty="automatic",
        help="Shorter side of the largest building. Anything wider is terrain. Empty: from the"
        " preset.",
    )
    ground_tolerance: float | None = parameter(
        None,
        label="Ground tolerance",
        unit="m",
        minimum=0.0,
        maximum=10.0,
        kind="number",
        empty="automatic",
        advanced=True,
        help="In level terrain, points up to this height above the surface of the ground are"
        " ground. Empty: from the preset.",
    )
    slope_tolerance: float | None = parameter(
        None,
        label="Ground tolerance on slopes",
        minimum=0.0,
        maximum=10.0,
        kind="number",
        empty="automatic",
        advanced=True,
        help="This share of the rise of the ground from point to point, over at most a metre, is"
        " added to the ground tolerance. In the paper's preset it is a share of the rise over one"
        " cell. Empty: from the preset.",
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        heights = self.height_thresholds
        if heights is None:
            return
        if not heights or any(low > high for high, low in zip(heights, heights[1:])):
            given = ", ".join(f"{each:g}" for each in heights) or "nothing"
            raise BareEarthError(
                f"Height thresholds must be a list from the largest to the smallest, not {given}."
            )

    def resolve(self, points: Points) -> GridMinimum:
        """Return the parameters with values in place of empty ones.

        Parameters
        ----------
        points : Points
            All points of the survey, because all its blocks must be classified with the same
            values.

        Returns
        -------
        GridMinimum
            Equal to this one if nothing was empty.
        """
        return self._resolved(_counting_cells(points, self))

    def _resolved(self, cells: Cells) -> GridMinimum:
        preset = PRESETS[self.preset]
        if self.cell_size is None and self.preset != CLASSIC:
            large_enough = _CELL_STEP * _multiple(_density(cells), _CELL_STEP)
            preset = preset._replace(cell_size=max(preset.cell_size, large_enough))
        return self.filled(preset._asdict())


def largest_object(parameters: GridMinimum) -> float:
    """Return the width in metres of the largest building that is searched."""
    return parameters.max_object_size or PRESETS[parameters.preset].max_object_size


def reach(parameters: GridMinimum) -> float:
    """Return the distance in metres within which points affect each other."""
    return max(_LEAST_REACH, _REACH_OBJECTS * largest_object(parameters))


def classify(points: Points, parameters: GridMinimum, progress: Progress = SILENT) -> np.ndarray:
    """Return which points are ground.

    First noise is removed from the grid of lowest points. Then objects are removed, the tall ones
    first, and last the rims that are left. Removed cells grow back if they are level with the
    ground beside them. Openings find objects without a rim on all sides, and regions that continue
    gently into the ground come back. Every point close to the surface through the remaining lowest
    points is ground.

    Parameters
    ----------
    points : Points
        All points that take part.
    parameters : GridMinimum
        Lengths in metres.
    progress : Progress
        Receives progress and messages.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
        True for ground.

    Raises
    ------
    BareEarthError
        If the points spread too far for a grid.
    Cancelled
        If the user asked to stop.
    """
    cells = _counting_cells(points, parameters)
    resolved = parameters._resolved(cells)
    if resolved != parameters:
        progress.choice(_in_words(resolved))
    if parameters.cell_size is not None or parameters.preset == CLASSIC:
        _tell_of_gaps(_density(cells), resolved, progress)
    if cells.size != resolved.cell_size:
        cells = Cells.over(points, resolved.cell_size)
    progress(0.1)
    grids = _by_rims(points, cells, resolved, progress.part(0.1, 0.6))
    if resolved.preset == CLASSIC:
        limits = _limits(inpaint(grids.ground, _RELAXATIONS, cells.first), resolved)
        return near_surface(points, cells, limits, progress.part(0.6, 1.0))
    candidates, cells = _candidates(points, cells, grids, resolved, progress.part(0.6, 0.8))
    tolerance = Tolerance(resolved.ground_tolerance, resolved.slope_tolerance)
    return near_ground(points, cells, candidates, tolerance, progress.part(0.8, 1.0))


def _limits(surface: np.ndarray, parameters: GridMinimum) -> np.ndarray:
    """Return the lowest and the highest height of ground points, shape (rows, columns, 2)."""
    tolerance = np.minimum(steepness(surface, parameters.cell_size), _STEEPEST)
    tolerance *= parameters.slope_tolerance * parameters.cell_size
    tolerance += parameters.ground_tolerance
    return np.stack((surface - tolerance, surface + tolerance), axis=-1)


class _Grids(NamedTuple):
    """Results from the rims of objects; grids of shape (rows, columns).

    Attributes
    ----------
    heights, ground : numpy.ndarray of float64
        Lowest heights without noise, and only those of the ground; NaN elsewhere.
    objects : Objects
        What the passes of the height thresholds find.
    """

    heights: np.ndarray
    ground: np.ndarray
    objects: Objects


def _by_rims(points: Points, cells: Cells, parameters: GridMinimum, progress: Progress) -> _Grids:
    """Tell ground from objects by the rims round them."""
    heights = cells.minimum(points.z)
    blocks = CellBlocks.over(cells, _BLOCK)
    count, classic = np.count_nonzero(np.isfinite(heights)), parameters.preset == CLASSIC
    heights[_noise(points, heights, cells, blocks, classic)] = np.nan
    if not classic and _density(cells) >= _DENSE:
        # After the clusters are removed, because they would lose their rims.
        slope = _OUTLIER_SLOPE_WHERE_DENSE
        pits = low_outliers(heights, cells.size, slope, cells.first)
        heights[pits & ~under_canopy(pits, points, cells)] = np.nan
    tell_of_outliers(count, heights, progress)
    progress(0.2)
    objects = _tall_objects(heights, blocks, parameters, progress.part(0.2, 0.6))
    ground = np.where(objects.raised, np.nan, heights)
    ground = _without_low_objects(ground, heights, cells, parameters, progress.part(0.6, 1.0))
    return _Grids(heights, ground, objects)


def _candidates(
    points: Points, cells: Cells, grids: _Grids, parameters: GridMinimum, progress: Progress
) -> tuple[Candidates, Cells]:
    """Return the lowest points of fine cells that may be ground, and these cells.

    Rims need cells without gaps, but the surface can have finer cells. The lowest point of a fine
    cell is ground if its wide cell is ground and the point is near the surface of the wide cells.
    """
    heights, widest = grids.heights, parameters.max_object_size
    ground = ground_cells(
        heights,
        cells.size,
        grids.objects,
        widest / 2.0,
        progress=progress,
        first=cells.first,
        suspects=np.isnan(grids.ground),
    )
    known = np.isfinite(heights)
    if cells.size <= _FINE_CELL:
        lowest = cells.lowest_points(points)
        return Candidates.of_cells(lowest, cells.index[lowest], ground, known), cells
    fine = Cells.over(points, _FINE_CELL)
    lowest = fine.lowest_points(points)
    x, y, z = points.take(lowest)
    surface = inpaint(np.where(ground, heights, np.nan), _RELAXATIONS, cells.first)
    rise = cells.size * np.minimum(steepness(surface, cells.size), _STEEPEST)
    allowed = parameters.final_height + _UNEVENNESS * cells.at(rise, x, y)
    low = np.abs(z - cells.at(surface, x, y)) <= allowed
    candidates = Candidates.of_cells(lowest, cells.index[lowest], ground, known)
    return candidates._replace(ground=candidates.ground & low), fine


def _in_words(parameters: GridMinimum) -> str:
    names = "preset", "cell_size", "height_thresholds", "final_height", "max_object_size"
    return f"Grid minimum: {parameters.in_words(*names)}."


def _tell_of_gaps(density: float, parameters: GridMinimum, progress: Progress) -> None:
    """Warn if cells are too small for the number of points per square metre."""
    size = parameters.cell_size
    multiple = _multiple(density, size)
    if multiple > 1:
        progress.warning(
            f"{density:.2g} points/m2 are too few for cells of {size:g} m: the rims of objects"
            f" have gaps. Give a cell size of {multiple * size:g} m, or choose another preset."
        )


def _multiple(density: float, size: float) -> int:
    """Return by how many times cells must be enlarged to hold about one point."""
    return max(math.ceil(math.sqrt(_POINTS_PER_CELL / density) / size - _NEARLY), 1)


def _counting_cells(points: Points, parameters: GridMinimum) -> Cells:
    """Return cells to count the points in: those of the filter, unless they are far too small."""
    size = parameters.cell_size or PRESETS[parameters.preset].cell_size
    if math.prod(points.sides) > size**2 * points.count:
        size = max(_DENSITY_BLOCK, 4.0 * size)
    return Cells.over(points, size)


def _density(cells: Cells) -> float:
    """Return the median number of points per square metre, of blocks within the survey."""
    blocks = CellBlocks.over(cells, _DENSITY_BLOCK, least=1)
    return usual_count(blocks.total(cells.counts())) / blocks.size**2


def _noise(
    points: Points, heights: np.ndarray, cells: Cells, blocks: CellBlocks, classic: bool
) -> np.ndarray:
    """Return the cells of narrow pits far below the usual lowest points around.

    A gap in the canopy, a yard or a street between roofs is a pit too, but others near it are as
    low. Noise is alone.
    """

    from scipy import ndimage

    noise = np.zeros(heights.shape, dtype=bool)
    if not classic:
        noise = low_outliers(heights, cells.size, _OUTLIER_SLOPE, cells.first)
        noise &= ~under_canopy(noise, points, cells)
        heights = np.where(noise, np.nan, heights)
    around = CellBlocks.over(cells, _NOISE_WIDTH)
    usual = inpaint(around.lowest(heights), first=around.first_block)
    usual = ndimage.median_filter(usual, 5, mode="nearest")
    below = heights < around.interpolated(usual, heights.shape) - _NOISE_DEPTH
    if not below.any():
        return noise
    lowest = blocks.lowest(heights)
    candidates = np.isfinite(blocks.lowest(np.where(below, heights, np.nan)))
    steps = HeightSteps(lowest, blocks.size, covered(np.isfinite(lowest)), blocks.first_block)
    pits = steps.pits(candidates, _NOISE_DEPTH, _NOISE_WIDTH)
    if not classic:
        depth = blocks.lowest(around.interpolated(usual, heights.shape)) - lowest
        pits &= ~supported(lowest, blocks.size, pits, depth, blocks.first_block)
    return noise | (below & blocks.repeated(pits, heights.shape))


def _tall_objects(
    heights: np.ndarray, blocks: CellBlocks, parameters: GridMinimum, progress: Progress
) -> Objects:
    """Return the objects that the passes of the height thresholds find.

    The passes use the lowest points of blocks, so that gaps in a tree's crown and points half-way
    down a wall hide no rim. Single cells far above the ground of their block are objects as well.
    """
    lowest = blocks.lowest(heights)
    thresholds, size, first = parameters.height_thresholds, blocks.size, blocks.first_block
    objects = raised_objects(
        lowest,
        size,
        thresholds,
        parameters.max_object_size,
        progress,
        first,
        parameters.preset == CLASSIC,
        PLATEAU_HEIGHT,
    )
    surface = inpaint(np.where(objects.raised, np.nan, lowest), _RELAXATIONS, first)
    rise = size * np.minimum(steepness(surface, size), _STEEPEST)
    highest = surface + min(thresholds) + rise
    above = heights > blocks.interpolated(highest, heights.shape)
    objects = Objects(*(blocks.repeated(each, heights.shape) for each in objects))
    return objects._replace(raised=above | objects.raised)


def _without_low_objects(
    ground: np.ndarray,
    heights: np.ndarray,
    cells: Cells,
    parameters: GridMinimum,
    progress: Progress,
) -> np.ndarray:
    """Return the heights of the ground, NaN elsewhere.

    Objects of the final height are removed, with the rims that are left of larger objects. Removed
    cells grow back if they are level with the rest.
    """
    inside = covered(np.isfinite(heights))
    for done in range(_FINAL_PASSES):
        steps = HeightSteps(ground, cells.size, inside, cells.first)
        regions, rims = steps.regions_and_rims(parameters.final_height, _RIM_ROUGHNESS)
        raised = regions.raised(parameters.max_object_size, parameters.preset == CLASSIC)
        ground[raised | rims] = np.nan
        progress((done + 1) / (_FINAL_PASSES + 1))
    kept = steps.regrown(np.isfinite(ground), heights, parameters.final_height)
    progress(1.0)
    return np.where(kept, heights, np.nan)
