"""The labelled point clouds that the benchmarks measure with, where they are."""

from __future__ import annotations

import os
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bare_earth.algorithms.las.cloud import PointCloud
from bare_earth.algorithms.las.reading import read_cloud

from ..cache import FOLDER as CACHE

_ROOT = Path(__file__).parents[2]
_BESIDE = _ROOT.parent / "shared" / "data"
# Where they are, and where `python -m benchmarks.data fetch` brings them.
FOLDER = Path(
    os.environ.get("BARE_EARTH_DATA") or (_BESIDE if _BESIDE.is_dir() else CACHE.parent / "data")
)
# The clouds that are in the repository, by the same names.
COMMITTED = _ROOT / "tests" / "data"


class RealTile(NamedTuple):
    """How far the labels of a real tile are to be trusted.

    Attributes
    ----------
    name : str
        File name.
    is_trusted : bool
        Whether every label counts. Elsewhere the ground is thinned, and only a terrain model made
        from it is a fair reference.
    left_out : tuple of int
        Classes of the reference of which it is open whether they are ground.
    watched : tuple of int
        Classes that count as other, and of which it is told how many are taken for ground.
    """

    name: str
    is_trusted: bool = False
    left_out: tuple[int, ...] = ()
    watched: tuple[int, ...] = ()

    @property
    def title(self) -> str:
        """The name without the file's ending."""
        return self.name.split(".")[0]

    @property
    def told(self) -> tuple[int, ...]:
        """Classes of which the share that is taken for ground is told."""
        return (*self.left_out, *self.watched)


REAL = (
    RealTile("ahn3_urban.laz", True),
    RealTile("ign_sparse_urban.laz", True),
    RealTile("nrw_rural.laz", True, (17, 26)),
    RealTile("corse_cliff.laz", True, (65,)),
    RealTile("ign_bridge.laz", True, (66, 67), (17,)),
    RealTile("megaplot.laz"),
    RealTile("forest_topography.laz"),
    RealTile("mixed_conifer.laz"),
    RealTile("oregon_conifer.laz"),
    RealTile("ign_pf8.las"),
    RealTile("hawaii_forest.laz"),
    RealTile("wires_single_return.laz"),
    RealTile("conifer_1.laz"),
    RealTile("conifer_2.laz"),
    RealTile("mountain_forest.laz"),
    RealTile("rainforest_ridge.laz"),
    RealTile("yard_photogrammetry.laz", True),
    RealTile("roofs_photogrammetry.laz", True),
    RealTile("broadleaf_sparse.laz", True),
    RealTile("house_slope.laz", True),
    RealTile("tall_crops.laz", True, (65,), (3,)),
    RealTile("pond_powerline.laz", True, (5, 9, 26)),
    RealTile("savanna_grass.laz"),
    RealTile("hillside_images.laz", True),
    RealTile("city_court.laz", True, (0,)),
    RealTile("rock_mountain.laz", True),
    RealTile("campus_terraces.laz", True),
)


def find(name: str) -> Path:
    """Return where a file of the data folder is, or would be."""
    committed = COMMITTED / name
    return committed if committed.exists() and not (FOLDER / name).exists() else FOLDER / name


def isprs() -> list[Path]:
    """Return the samples of the ISPRS filter test (Sithole & Vosselman 2004) that are here."""
    return sorted((FOLDER / "isprs").glob("samp*.laz"))


def real(name: str) -> Path:
    """Return the path of a real tile."""
    return find(f"real/{name}")


def load(path: Path) -> tuple[PointCloud, np.ndarray]:
    """Return a cloud whose classes are all 0, and the reference classes it came with."""
    cloud = read_cloud(path)
    reference = cloud.classification.copy()
    cloud.classification[:] = 0
    return cloud, reference
