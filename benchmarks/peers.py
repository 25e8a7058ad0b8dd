"""Other ground filters that pip installs, behind the interface of our own; and figures of others.

Each runs with its own defaults on all points of the cloud, every return, in metres.
"""

from __future__ import annotations

import contextlib
import importlib.metadata
import importlib.util
import os
import sys
import tempfile
from pathlib import Path
from typing import Any, Iterator

import numpy as np

from bare_earth.algorithms.las.cloud import PointCloud

from .cache import remembered


class Peer:
    """A filter of somebody else.

    Attributes
    ----------
    name : str
        As in the tables.
    module, package : str
        What is imported, and what pip installs.
    note : str
        What else there is to know.
    build : str
        What else its answers depend on, beside its version.
    is_for_tiles : bool
        Whether it is measured on the real tiles, too.
    """

    name = module = package = note = build = ""
    is_for_tiles = True

    @property
    def is_installed(self) -> bool:
        """Whether its module is there."""
        return importlib.util.find_spec(self.module) is not None

    @property
    def version(self) -> str:
        """The version of its package."""
        return importlib.metadata.version(self.package.split("==")[0])

    def ground(self, cloud: PointCloud) -> np.ndarray:
        """Return the ground mask of a cloud, from the cache if it was asked before."""
        with _silent():
            asked = f"{self.name} {self.version} {self.build}".strip()
            return remembered(asked, cloud, self.classify)

    def classify(self, cloud: PointCloud) -> np.ndarray:
        """Run the filter."""
        raise NotImplementedError


class Cloth(Peer):
    """The cloth simulation filter, by its authors (Zhang et al. 2016)."""

    name, module, package = "CSF", "CSF", "cloth-simulation-filter"
    note = (
        "cloth resolution 1 m, rigidness 3, slope smoothing on; in one thread, because with more"
        " its labels differ from run to run"
    )
    build = "1 thread"

    def classify(self, cloud: PointCloud) -> np.ndarray:
        os.environ["OMP_NUM_THREADS"] = "1"  # heard when its library is loaded
        import CSF

        cloth = CSF.CSF()
        cloth.setPointCloud(_coordinates(cloud))
        inside, outside = CSF.VecInt(), CSF.VecInt()
        cloth.do_filtering(inside, outside, False)  # False: no file of the cloth
        ground = np.zeros(cloud.count, dtype=bool)
        ground[np.array(inside, dtype=np.intp)] = True
        return ground


class Morphological(Peer):
    """The simple morphological filter (Pingel et al. 2013) in Python."""

    name, module, package = "pysmrf", "pysmrf", "pysmrf"
    note = "windows up to a radius of 5 cells of 1 m"

    def __init__(self, **options: object) -> None:
        self._options = options

    def classify(self, cloud: PointCloud) -> np.ndarray:
        import pysmrf

        return ~np.asarray(pysmrf.smrf(*_coordinates(cloud).T, **self._options)[3], dtype=bool)


class WideMorphological(Morphological):
    """The same with the windows of the paper's one set of parameters."""

    name = "pysmrf, windows=18"
    note = "the radius in the single parameter set of the paper, not the default; samples only"
    is_for_tiles = False

    def __init__(self) -> None:
        super().__init__(windows=18)


class _Whitebox(Peer):
    """A filter of Whitebox Workflows, through temporary LAS files; its versions differ in tools."""

    module = "whitebox_workflows"

    @property
    def is_installed(self) -> bool:
        """Whether it is there in the major version that has the filter."""
        return super().is_installed and self.version.split(".")[0] == self.package.split("==")[1][0]

    def classify(self, cloud: PointCloud) -> np.ndarray:
        import laspy
        import whitebox_workflows

        environment = whitebox_workflows.WbEnvironment()
        environment.verbose = False
        with tempfile.TemporaryDirectory() as folder:
            source, target = Path(folder) / "source.las", Path(folder) / "target.las"
            write_las(cloud, source)
            result = self.filtered(environment, environment.read_lidar(str(source)))
            environment.write_lidar(result, str(target))
            before, after = laspy.read(source), laspy.read(target)
        # Version 2 writes another scale, and version 1 cuts off the last digit now and then.
        if (np.abs(np.subtract(before.xyz, after.xyz)) > 1.5 * before.header.scales).any():
            raise RuntimeError("the points came back in another order")
        return np.asarray(after.classification) == 2

    def filtered(self, environment: Any, lidar: Any) -> Any:
        """Run its tool."""
        raise NotImplementedError


class WhiteboxSlope(_Whitebox):
    """The slope filter of version 1."""

    name, package = "Whitebox slope filter", "whitebox-workflows==1.3.5"
    note = "radius 2 m, 45 degrees, 1 m, slope normalisation on"

    def filtered(self, environment: Any, lidar: Any) -> Any:
        return environment.lidar_ground_point_filter(lidar, classify=True)


class WhiteboxImproved(_Whitebox):
    """The improved ground point filter, which runs without a licence since version 2."""

    name, package = "Whitebox improved ground point filter", "whitebox-workflows==2.0.6"
    note = "block minima of 1 m, buildings up to 150 m, 15 degrees, 0.15 m"

    def filtered(self, environment: Any, lidar: Any) -> Any:
        return environment.lidar.improved_ground_point_filter(input=lidar, classify=True)


PEERS = (Cloth(), Morphological(), WideMorphological(), WhiteboxSlope(), WhiteboxImproved())

# Filters that cannot be run from pip, as the project's notes on its data give them: mean total
# error and kappa on the samples, and total error on tiles whose labels are trusted.
QUOTED = {
    "PDAL SMRF": ("4.54", "86.4", {"ahn3_urban": "2.6", "ign_sparse_urban": "6.5"}),
    "PDAL PMF": ("7.57", "76.1", {"ahn3_urban": "2.4", "ign_sparse_urban": "5.6"}),
    "r-lidar PTD": (
        "10.1",
        "72.6",
        {"ahn3_urban": "6.4 to 6.8", "ign_sparse_urban": "5.0", "nrw_rural": "1.7"},
    ),
    "Whitebox improved ground point filter": ("21.8", "47.6", {"ahn3_urban": "2.8"}),
}
# Likewise: RMSE of the terrain model in metres.
QUOTED_RMSE = {
    "PDAL SMRF": {
        "forest_topography": "0.351",
        "mixed_conifer": "0.098",
        "oregon_conifer": "0.170",
        "ign_pf8": "0.060",
        "ahn3_urban": "0.133",
    },
    "PDAL PMF": {
        "forest_topography": "0.450",
        "mixed_conifer": "0.233",
        "oregon_conifer": "0.122",
        "ign_pf8": "0.079",
        "ahn3_urban": "0.355",
    },
    "PDAL CSF": {
        "forest_topography": "1.132",
        "mixed_conifer": "0.087",
        "oregon_conifer": "0.169",
        "ign_pf8": "0.049",
        "ahn3_urban": "0.093",
    },
}


def installed() -> list[Peer]:
    """Return the peers that can run here."""
    return [peer for peer in PEERS if peer.is_installed]


def missing() -> list[str]:
    """Return the packages of the peers that cannot."""
    return sorted({peer.package for peer in PEERS if not peer.is_installed})


@contextlib.contextmanager
def _silent() -> Iterator[None]:
    """Keep quiet what libraries in C++ print, which Python's own redirection does not reach."""
    sys.stdout.flush()
    saved = os.dup(1)
    try:
        with open(os.devnull, "wb") as nowhere:
            os.dup2(nowhere.fileno(), 1)
        yield
    finally:
        os.dup2(saved, 1)
        os.close(saved)


def _coordinates(cloud: PointCloud) -> np.ndarray:
    """Return x, y and z in metres, shape (n, 3)."""
    return np.column_stack(cloud.points(np.ones(cloud.count, dtype=bool)))


def write_las(cloud: PointCloud, path: Path) -> None:
    """Write coordinates and returns, all of class 0, as LAS 1.2 or, for many returns, 1.4."""
    import laspy

    many = max(cloud.return_number.max(), cloud.number_of_returns.max()) > 7
    header = laspy.LasHeader(version="1.4" if many else "1.2", point_format=6 if many else 0)
    header.scales, header.offsets = np.array(cloud.scale), np.array(cloud.offset)
    las = laspy.LasData(header)
    las.X, las.Y, las.Z = cloud.x, cloud.y, cloud.z
    las.return_number, las.number_of_returns = cloud.return_number, cloud.number_of_returns
    las.write(path)
