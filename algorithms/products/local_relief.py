"""Local relief: the height of the terrain above its surroundings, which shows small features.

Burial mounds, old paths, ditches and field banks of some decimetres cannot be seen in a terrain
model with a range of some hundred metres. They stand out when the trend of the land is removed.

References
----------
Hesse, R. (2010): LiDAR-derived Local Relief Models - a new tool for archaeological prospection.
Archaeological Prospection 17, 67-72. This is its first step: the terrain minus a smoothed one.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Iterator

import numpy as np

from ..core.parameters import ParameterSet, parameter
from ..core.progress import SILENT, Progress
from ..grids.local_trend import local_trend, reach_of
from ..grids.relief_smoothing import smoothing_reach, without_noise
from ..rasters.geotiff import NODATA, Raster, read_raster
from ..rasters.writing import Rows, check_raster_output, write_geotiff

# Cells that are worked on at a time.
_CELLS = 4_000_000


@dataclass(frozen=True)
class LocalRelief(ParameterSet):
    """The size of the features that local relief shows, and the smoothing of such pictures."""

    relief_radius: float = parameter(
        10.0,
        label="Radius of the local relief",
        unit="m",
        minimum=0.1,
        maximum=1000.0,
        advanced=True,
        help="Each place is compared with its surroundings up to this distance. Choose about the"
        " width of the features that you want to see; larger landforms disappear.",
    )
    relief_smoothing: str = parameter(
        "automatic",
        label="Smoothing of hillshade and local relief",
        choices={"automatic": "Automatic", "none": "None"},
        advanced=True,
        help="Automatic: for the pictures, heights are smoothed as much as they are noisy, so that"
        " low plants in a forest do not speckle them. Banks, ditches and walls stay sharp, and so"
        " does open ground. The terrain model does not change.",
    )

    @property
    def smooths(self) -> bool:
        """Whether heights are smoothed for pictures."""
        return self.relief_smoothing == "automatic"


def local_relief(
    heights: np.ndarray, cell_metres: tuple[float, float], radius: float
) -> np.ndarray:
    """Return the height of a surface above the mean of its surroundings.

    Parameters
    ----------
    heights : numpy.ndarray of float, shape (rows, columns)
        Heights in any unit; NaN where there is none.
    cell_metres : tuple of float
        Distance between neighbours in a row, and in a column, in metres.
    radius : float
        Radius of the surroundings in metres. The mean is weighted by a normal distribution whose
        standard deviation is half the radius.

    Returns
    -------
    numpy.ndarray of float32, shape (rows, columns)
        In the unit of the heights; NaN where these are NaN. A cell depends on others up to
        `relief_reach` cells away.
    """
    sigma = radius / 2 / cell_metres[1], radius / 2 / cell_metres[0]
    # At an edge the trend is that of a plane, because otherwise a slope would be visible there.
    return (heights - local_trend(heights, sigma)).astype(np.float32)


def relief_reach(cell_size: float, radius: float, smooths: bool) -> int:
    """Return how many cells away a cell still matters to the local relief."""
    return reach_of(radius / 2 / cell_size) + (smoothing_reach(cell_size) if smooths else 0)


def write_local_relief(
    source: Path,
    target: Path,
    parameters: LocalRelief = LocalRelief(),
    progress: Progress = SILENT,
    nodata: float = NODATA,
) -> None:
    """Write the local relief of a terrain model.

    Parameters
    ----------
    source, target : Path
        The terrain model, and the GeoTIFF to make.
    parameters : LocalRelief
        The size of the features.
    progress : Progress
        Receives progress and messages.
    nodata : float
        The value of cells without data.

    Raises
    ------
    BareEarthError
        If the raster cannot be read, or the output cannot be written.
    """
    check_raster_output(target, (Path(source),))
    # Without progress: messages on units were given for the points.
    raster = read_raster(source)
    progress(0.2)
    rows = Rows(raster.heights.shape, "float32", _strips(raster, parameters, nodata, progress))
    write_geotiff(target, rows, raster, nodata, progress, "Local relief, {unit}")
    progress(1.0)


def _strips(
    raster: Raster, how: LocalRelief, nodata: float, progress: Progress
) -> Iterator[np.ndarray]:
    """Yield the local relief of a raster, some rows at a time."""
    count, columns = raster.heights.shape
    cell, unit = min(raster.cell_metres), raster.frame.vertical_unit
    reach, rows = relief_reach(cell, how.relief_radius, how.smooths), max(_CELLS // columns, 1)
    for start in range(0, count, rows):
        first = max(start - reach, 0)
        heights = raster.heights[first : start + rows + reach].astype(np.float64)
        if how.smooths:
            heights = without_noise(heights * unit, cell) / unit
        relief = local_relief(heights, raster.cell_metres, how.relief_radius)
        relief = relief[start - first :][:rows]
        yield np.where(np.isnan(relief), np.float32(nodata), relief)
        progress(0.2 + 0.7 * min(start + rows, count) / count)
