"""Local relief: how high the terrain lies above its surroundings, which shows small features.

Burial mounds, old paths, ditches and field banks of some decimetres are lost in a terrain model of
some hundred metres of range. Without the trend of the land they stand out.

References
----------
Hesse, R. (2010): LiDAR-derived Local Relief Models - a new tool for archaeological prospection.
Archaeological Prospection 17, 67-72. Here is its first step: the terrain less a smooth one.
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
    """How large the features are that local relief shows."""

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
    """Return how high a surface lies above the mean of its surroundings.

    Parameters
    ----------
    heights : numpy.ndarray of float, shape (rows, columns)
        Any unit; NaN where there is none.
    cell_metres : tuple of float
        Distance between neighbours in a row, and in a column.
    radius : float
        Of the surroundings, in metres: the mean is weighted by a normal distribution whose
        standard deviation is half of it.

    Returns
    -------
    numpy.ndarray of float32, shape (rows, columns)
        In the unit of the heights; NaN where they are.
    """
    from scipy.ndimage import gaussian_filter

    known = np.isfinite(heights)
    if not known.any():
        return heights.astype(np.float32)
    sigma = radius / 2 / cell_metres[1], radius / 2 / cell_metres[0]
    # Above their plane: at the edge, where surroundings lie on one side only, a slope would show;
    # and numbers near 0 keep their millimetres as float32.
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
) -> None:
    """Write the local relief of a terrain model.

    Parameters
    ----------
    source, target : Path
        The terrain model, and the GeoTIFF to make.
    parameters : LocalRelief
        How large the features are.
    progress : Progress
        Receives progress and messages.

    Raises
    ------
    BareEarthError
        If the raster cannot be read, or the output cannot be written.
    """
    # Silent: the units were told of the points.
    raster = read_raster(source)
    progress(0.3)
    relief = local_relief(raster.heights, raster.cell_metres, parameters.relief_radius)
    progress(0.9)
    values = np.where(np.isnan(relief), np.float32(NODATA), relief)
    write_geotiff(target, values, raster, NODATA, progress, "Local relief, {unit}")
    progress(1.0)
