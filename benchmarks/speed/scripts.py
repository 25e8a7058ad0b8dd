"""What the benchmark runs beside our own command, each as `python -m benchmarks.speed.scripts`.

Every script reads a LAS or LAZ file by laspy with lazrs in parallel and writes all of it, as our
command does; only Whitebox reads and writes by itself.
"""

from __future__ import annotations

import sys

import numpy as np


def floor(source: str, target: str) -> None:
    """Read a file and write it back unchanged: all of it decompressed and compressed."""
    _write(_read(source), target)


def cloth(source: str, target: str) -> None:
    """Classify by the cloth simulation filter with its defaults, in all its threads."""
    import CSF

    las = _read(source)
    filter_ = CSF.CSF()
    filter_.setPointCloud(_coordinates(las))
    inside, outside = CSF.VecInt(), CSF.VecInt()
    filter_.do_filtering(inside, outside, False)  # False: no file of the cloth
    ground = np.zeros(len(las), dtype=bool)
    ground[np.array(inside, dtype=np.intp)] = True
    _write_classified(las, ground, target)


def morphological(source: str, target: str) -> None:
    """Classify by pysmrf with its defaults."""
    import pysmrf

    las = _read(source)
    objects = pysmrf.smrf(*_coordinates(las).T)[3]
    _write_classified(las, ~np.asarray(objects, dtype=bool), target)


def whitebox(source: str, target: str, radius: str = "2") -> None:
    """Classify by Whitebox's slope filter with its defaults but for the radius in metres."""
    import whitebox_workflows

    environment = whitebox_workflows.WbEnvironment()
    environment.verbose = False
    lidar = environment.read_lidar(source)
    result = environment.lidar_ground_point_filter(
        lidar, search_radius=float(radius), classify=True
    )
    environment.write_lidar(result, target)


def whitebox_tin(source: str, target: str) -> None:
    """Make a raster of 1 m of the TIN of the ground points of a classified file by Whitebox."""
    import whitebox_workflows

    environment = whitebox_workflows.WbEnvironment()
    environment.verbose = False
    others = [code for code in range(256) if code != 2]
    raster = environment.lidar_tin_gridding(
        environment.read_lidar(source), returns_included="all", cell_size=1.0,
        excluded_classes=others,
    )  # fmt: skip
    environment.write_raster(raster, f"{target}.tif")


def whitebox_height(source: str, target: str) -> None:
    """Replace z by heights above the ground of a classified file by Whitebox."""
    import whitebox_workflows

    environment = whitebox_workflows.WbEnvironment()
    environment.verbose = False
    environment.write_lidar(environment.height_above_ground(environment.read_lidar(source)), target)


_ALL = (floor, cloth, morphological, whitebox, whitebox_tin, whitebox_height)
SCRIPTS = {script.__name__: script for script in _ALL}


def _read(source: str):
    import laspy

    return laspy.read(source, laz_backend=laspy.LazBackend.LazrsParallel)


def _write(las, target: str) -> None:
    import laspy

    las.write(target, laz_backend=laspy.LazBackend.LazrsParallel)


def _coordinates(las) -> np.ndarray:
    """Return x, y and z beside a local origin, shape (n, 3)."""
    columns = zip((las.X, las.Y, las.Z), las.header.scales)
    return np.column_stack([(column - column.min()) * scale for column, scale in columns])


def _write_classified(las, ground: np.ndarray, target: str) -> None:
    las.classification = np.where(ground, 2, 1).astype(np.uint8)
    _write(las, target)


if __name__ == "__main__":
    SCRIPTS[sys.argv[1]](*sys.argv[2:])
