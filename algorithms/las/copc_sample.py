"""A few points from everywhere in a COPC file."""

from __future__ import annotations

from pathlib import Path

import numpy as np


def sample_of(path: Path, dimension: str) -> np.ndarray:
    """Return a dimension of the points in the uppermost node of the octree.

    Parameters
    ----------
    path : Path
        A COPC file that this package wrote. It is not checked.
    dimension : str
        Its name in laspy: "z" for heights in units of the CRS, or that of an extra dimension.

    Returns
    -------
    numpy.ndarray of float, shape (n,)
    """
    import laspy

    with laspy.CopcReader.open(str(path)) as reader:
        return np.asarray(reader.query(level=0)[dimension], dtype=float)
