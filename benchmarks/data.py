"""The labelled point clouds that the benchmarks measure with, where they are."""

from __future__ import annotations

import os
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bare_earth.algorithms.pointcloud.cloud import PointCloud
from bare_earth.algorithms.pointcloud.reading import read_cloud

FOLDER = Path(
    os.environ.get("BARE_EARTH_DATA", Path(__file__).parents[1] / ".." / "shared" / "data")
)


class RealTile(NamedTuple):
    """How far the labels of a real tile are to be trusted.

    Attributes
    ----------
    ground : tuple of int or None
        The reference classes that count as ground for the total error; None where the labels are
        thinned and only a terrain model made from them is a fair reference.
    """

    name: str
    ground: tuple[int, ...] | None


REAL = (
    RealTile("ahn3_urban.laz", (2,)),
    RealTile("ign_sparse_urban.laz", (2,)),
    RealTile("nrw_rural.laz", (2,)),
    RealTile("forest_topography.laz", None),
    RealTile("mixed_conifer.laz", None),
    RealTile("oregon_conifer.laz", None),
    RealTile("ign_pf8.las", None),
    RealTile("hawaii_forest.laz", None),
    RealTile("wires_single_return.laz", None),
)


def isprs() -> list[Path]:
    """Return the samples of the ISPRS filter test (Sithole & Vosselman 2004) that are here."""
    return sorted((FOLDER / "isprs").glob("samp*.laz"))


def real(name: str) -> Path:
    """Return the path of a real tile."""
    return FOLDER / "real" / name


def load(path: Path) -> tuple[PointCloud, np.ndarray]:
    """Return a cloud whose classes are all 0, and the reference classes it came with."""
    cloud = read_cloud(path)
    reference = cloud.classification.copy()
    cloud.classification[:] = 0
    return cloud, reference
