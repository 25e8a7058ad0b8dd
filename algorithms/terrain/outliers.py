"""Points far below everything round them: multipath, birds under bridges, sensor faults."""

from __future__ import annotations

import numpy as np

from .inpaint import inpaint
from .morphology import within_square


def low_outliers(grid: np.ndarray, size: float, slope: float) -> np.ndarray:
    """Return which cells of a minimum grid lie in a narrow pit that terrain does not have.

    The grid is closed by 3 x 3 cells (the opening of -z); what the closing fills deeper than
    `slope` times the cell size is an outlier.

    Parameters
    ----------
    grid : numpy.ndarray of float, shape (rows, columns)
        Lowest height of each cell in metres; NaN where there is none.
    size : float
        Side of a cell in metres.
    slope : float
        Rise over run, far above that of any terrain.

    Returns
    -------
    numpy.ndarray of bool, shape (rows, columns)

    References
    ----------
    Pingel, T., Clarke, K., McBride, W. (2013): An improved simple morphological filter for the
    terrain classification of airborne LIDAR data. ISPRS Journal 77, section 2.2.
    """
    filled = inpaint(grid)
    closed = within_square(np.minimum, within_square(np.maximum, filled, 1), 1)
    return np.isfinite(grid) & (closed - filled > slope * size)
