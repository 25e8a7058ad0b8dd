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

import numpy as np

from ..core.parameters import ParameterSet, parameter
from ..core.progress import SILENT, Progress
from ..grids.plane import plane_through
from ..rasters.geotiff import NODATA, read_raster
from ..rasters.writing import write_geotiff


@dataclass(frozen=True)
class LocalRelief(ParameterSet):
    """The size of the features that local relief shows."""

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
        In the unit of the heights; NaN where these are NaN.
    """
    from scipy.ndimage import gaussian_filter

    known = np.isfinite(heights)
    if not known.any():
        return heights.astype(np.float32)
    sigma = radius / 2 / cell_metres[1], radius / 2 / cell_metres[0]
    # Relative to a plane, because a slope would be visible at the edge, where surroundings lie on
    # one side only. Also, small numbers keep their millimetres as float32.
    filled = np.where(known, heights - plane_through(heights, known), 0).astype(np.float32)
    # Cells without a height have no weight.
    total = gaussian_filter(filled, sigma, mode="constant")
    weight = gaussian_filter(known.astype(np.float32), sigma, mode="constant")
    mean = total / np.where(known, weight, 1)
    return np.where(known, filled - mean, np.nan).astype(np.float32)


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
    # Without progress: messages on units were given for the points.
    raster = read_raster(source)
    progress(0.3)
    relief = local_relief(raster.heights, raster.cell_metres, parameters.relief_radius)
    progress(0.9)
    values = np.where(np.isnan(relief), np.float32(nodata), relief)
    write_geotiff(target, values, raster, nodata, progress, "Local relief, {unit}")
    progress(1.0)
