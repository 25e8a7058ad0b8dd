"""A few points from all parts of a COPC file."""

from __future__ import annotations

from pathlib import Path

import numpy as np


def sample_of(path: Path, dimension: str) -> np.ndarray:
    """Return a dimension, named as in laspy, of the points in the uppermost node of a COPC file,
    which must be written by this package, since it is not checked.
    """
    import laspy

    with laspy.CopcReader.open(str(path)) as reader:
        return np.asarray(reader.query(level=0)[dimension], dtype=float)
