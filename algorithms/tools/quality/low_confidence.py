"""Low confidence areas: where so few points reach the ground that a terrain model may be wrong.

They are those of ASPRS (2014): Positional Accuracy Standards for Digital Geospatial Data, edition
1, Photogrammetric Engineering & Remote Sensing 81(3), which GeoCue (2015), Generating Low
Confidence Polygons, explains. The USGS has no criterion of its own: the parties agree on one
(Elevation-Derived Hydrography, READ Rules: Low-Confidence Area, Sparse Bare Earth).
"""

from __future__ import annotations

import math
from functools import partial
from pathlib import Path
from typing import Iterator, NamedTuple

import numpy as np

from ...core.points import Frame
from ...core.progress import Progress
from ...crs.system import Crs
from ...grids.isolines import rings_of
from ...survey.feature_files import Feature, FeatureLayer, feature_writer
from .cells import BUILT, ROUGH, Make, QualityCells, Rectangle, twice

# Share of the density of pulses: where the density of ground points is lower, confidence is low.
_SHARE = 0.25
# Radius in which the density of ground points is counted, in nominal distances between pulses.
_RADIUS = 3.0
# Most cells that are kept while areas are found, of some 20 bytes each; of more they are larger.
_MOST_CELLS = 1 << 24
# Share of the cells of an area with pulses of several returns, below which it hardly has plants.
_FEW_RETURNS = 0.1
_FIELDS: dict[str, type] = {"AREA": float, "DENSITY": float, "RETURNS": float}


class LowConfidenceArea(NamedTuple):
    """A connected area of low confidence."""

    rings: tuple[np.ndarray, ...]  # float64 (n, 2): outline and holes, metres from (0, 0)
    area: float  # m2
    density: float  # ground points in 1/m2
    returns: float  # share of its cells with pulses of several returns

    @property
    def has_plants(self) -> bool:
        """Whether pulses have several returns there, as they have under plants."""
        return self.returns >= _FEW_RETURNS


class LowConfidence(NamedTuple):
    """The low confidence areas of a survey."""

    limit: float  # ground points in 1/m2, below which confidence is low
    least_area: float  # m2
    share: float  # of the land of the survey
    areas: tuple[LowConfidenceArea, ...]  # the largest first
    low: np.ndarray  # bool (rows, columns), from south to north: the cells of these areas
    cell: float  # side of these cells in metres


def low_confidence_of(
    cells: QualityCells, pulse_density: float | None, least_area: float
) -> LowConfidence | None:
    """Return the low confidence areas of a survey, given its density of pulses in 1/m2, measured or
    demanded; None without any.
    """
    from scipy import ndimage

    if not pulse_density:
        return None
    fine = cells.grids.fine
    radius = _RADIUS / math.sqrt(pulse_density)
    by_memory = math.sqrt(fine.window.rows * fine.window.columns / _MOST_CELLS)
    step = max(int(radius / fine.size), math.ceil(by_memory), 1)
    cell = step * fine.size
    density, has_pulses, returns = (
        cells.reduced(make, step).astype(np.float32)
        for make in (_ground_density, _has_pulses, _has_several)
    )
    land = ~np.isnan(density)
    mean = partial(_mean_around, known=land, disk=_disk(radius / cell))
    low = land & (mean(density) < _SHARE * pulse_density) & (mean(has_pulses) > 0.0)
    # The density of single cells varies by chance, so a cell is low where most cells around are.
    low = land & (mean(low.astype(np.float32)) >= 0.5)
    labels, _ = ndimage.label(low, np.ones((3, 3)))
    sizes = np.bincount(labels.ravel())
    is_large = sizes * cell**2 >= least_area
    is_large[0] = False
    windows = ndimage.find_objects(labels)
    areas = []
    for number in np.flatnonzero(is_large).tolist():
        window = windows[number - 1]
        own = labels[window] == number
        values = (float(grid[window][own].mean(dtype=np.float64)) for grid in (density, returns))
        piece = fine.pieces[int(fine.piece_at(window[0].start * step))]
        row, column = fine.window.row - piece.up, fine.window.column - piece.right
        rings = tuple(_rings(own, window, cell, (column * fine.size, row * fine.size)))
        areas.append(LowConfidenceArea(rings, float(sizes[number]) * cell**2, *values))
    areas.sort(key=lambda area: -area.area)
    low = is_large[labels]
    share = float(np.count_nonzero(low)) / max(int(np.count_nonzero(land)), 1)
    return LowConfidence(_SHARE * pulse_density, least_area, share, tuple(areas), low, cell)


def _rings(
    own: np.ndarray, window: tuple[slice, ...], cell: float, corner: tuple[float, float]
) -> Iterator[np.ndarray]:
    """Yield the rings of cells in a window as x and y in metres, from the corner of the grid."""
    start = np.array([side.start for side in window]) + 0.5
    for ring in rings_of(own):
        yield ((ring + start) * cell)[:, ::-1] + corner


def _of_land(make: Make) -> Make:
    """Return a function that computes values where there is no water and no building, else NaN."""

    def of_land(cells: QualityCells, there: Rectangle) -> np.ndarray:
        is_land = twice(cells.extent.dry, there) & (twice(cells.marks, there) & BUILT == 0)
        return np.where(is_land, make(cells, there), np.nan)

    return of_land


_ground_density = _of_land(
    lambda cells, there: cells.ground_points[there] / cells.grids.fine.size**2
)
_has_pulses = _of_land(lambda cells, there: cells.first[there] > 0)
_has_several = _of_land(lambda cells, there: twice(cells.marks, there) & ROUGH > 0)


def _disk(radius: float) -> np.ndarray:
    """Return 1 for the cells within a radius in cells, at least one, and 0 for the others."""
    reach = max(int(radius), 1)
    row, column = np.ogrid[-reach : reach + 1, -reach : reach + 1]
    return (row**2 + column**2 <= max(radius, 1.0) ** 2).astype(np.float32)


def _mean_around(values: np.ndarray, known: np.ndarray, disk: np.ndarray) -> np.ndarray:
    """Return the mean of the known values within a disk round each cell; float32."""
    from scipy import ndimage

    total = ndimage.convolve(np.where(known, values, np.float32(0)), disk, mode="constant")
    count = ndimage.convolve(known.astype(np.float32), disk, mode="constant")
    return total / np.maximum(count, 1.0)


def write_areas(
    path: Path, found: LowConfidence | None, frame: Frame, crs: Crs, progress: Progress
) -> None:
    """Write low confidence areas as polygons."""
    layer = FeatureLayer("low_confidence", "Polygon", _FIELDS, frame.wkt, crs.epsg)

    def features() -> Iterator[Feature]:
        for area in found.areas if found else ():
            rings = tuple(ring / frame.horizontal_unit for ring in area.rings)
            values = round(area.area, 1), round(area.density, 3), round(area.returns, 3)
            yield Feature(values, rings)

    feature_writer(path)(path, features(), layer, progress)
