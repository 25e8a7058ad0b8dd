"""The scene of the demo as files: a survey whose truth is known for every point."""

from __future__ import annotations

from pathlib import Path

import laspy
import numpy as np
from laspy.vlrs.known import WktCoordinateSystemVlr

from benchmarks.scenes import Scene, make
from benchmarks.scenes.classes import (
    BRIDGE,
    BUILDING,
    GROUND,
    HIGH_VEGETATION,
    LOW_VEGETATION,
    OTHER,
    WATER,
)
from benchmarks.scenes.scene import ORIGIN

KIND, SEED = "mixed_land", 2004
# Checkpoints on open land, and under trees.
_OPEN, _FOREST = 35, 12
# Water counts as ground, as in a terrain model; noise, the bridge and cars do not.
GROUND_CLASSES = (GROUND, WATER)

_WKT = (
    'PROJCS["ETRS89 / UTM zone 32N",GEOGCS["ETRS89",DATUM["European_Terrestrial_Reference_System_'
    '1989",SPHEROID["GRS 1980",6378137,298.257222101,AUTHORITY["EPSG","7019"]],AUTHORITY["EPSG",'
    '"6258"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,'
    'AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4258"]],PROJECTION["Transverse_Mercator"],'
    'PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",9],PARAMETER["scale_factor",'
    '0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1,'
    'AUTHORITY["EPSG","9001"]],AXIS["Easting",EAST],AXIS["Northing",NORTH],AUTHORITY["EPSG",'
    '"25832"]]'
)


def write_scene(
    cloud: Path,
    truth: Path,
    density: float = 8.0,
    seed: int = SEED,
    checkpoints: Path | None = None,
) -> int:
    """Write a survey without classes, and the same points with their true classes.

    Parameters
    ----------
    cloud, truth : Path
        The LAS or LAZ files to write.
    density : float
        Pulses per square metre.
    seed : int
        The same seed gives the same files.
    checkpoints : Path, optional
        A table to write of points surveyed on the ground, with errors of 1.5 cm.

    Returns
    -------
    int
        Number of points.
    """
    scene = make(KIND, seed, density=density)
    if checkpoints is not None:
        checkpoints.write_text(checkpoints_of(scene), encoding="utf-8")
    las = las_of(scene)
    las.write(truth)
    las.classification = np.zeros(len(las.points), dtype=np.uint8)
    las.write(cloud)
    return len(las.points)


def checkpoints_of(
    scene: Scene, open_land: int = _OPEN, forest: int = _FOREST, hard: bool = False
) -> str:
    """Return places that a surveyor can reach, their heights and land cover, as CSV.

    Parameters
    ----------
    scene : Scene
        Of which they are.
    open_land, forest : int
        How many lie on open land and under trees, at most.
    hard : bool
        Only on even, bare land without machines: where targets for drone surveys are put.
    """
    from scipy.spatial import cKDTree

    random = np.random.default_rng(scene.seed)
    x, y = random.uniform(-0.48, 0.48, (2, 400)) * scene.settings.size
    x, y = x + scene.corner[0], y + scene.corner[1]

    def near(distance: float, *classes: int) -> np.ndarray:
        some = scene.points.take(np.isin(scene.classes, classes))
        tree = cKDTree(np.column_stack((some.x, some.y)))
        return tree.query(np.column_stack((x, y)))[0] < distance

    is_free = ~near(3.0, BUILDING, WATER, BRIDGE)
    is_forest = near(1.0, HIGH_VEGETATION)
    if hard:
        step = np.hypot(
            scene.terrain(x + 1.0, y) - scene.terrain(x - 1.0, y),
            scene.terrain(x, y + 1.0) - scene.terrain(x, y - 1.0),
        )
        is_free &= ~near(2.0, OTHER, LOW_VEGETATION) & (step < 0.3)
    z = scene.terrain(x, y) + random.normal(0.0, 0.015, len(x))
    chosen = [
        *np.flatnonzero(is_free & ~is_forest)[:open_land],
        *np.flatnonzero(is_free & is_forest)[:forest],
    ]
    west, south = (middle - scene.settings.size / 2 for middle in scene.corner)
    rows = [
        f"P{number},{x[k] - west + ORIGIN[0]:.3f},{y[k] - south + ORIGIN[1]:.3f},{z[k]:.3f},"
        f"{'forest' if is_forest[k] else 'open'}"
        for number, k in enumerate(chosen, start=1)
    ]
    return "\n".join(["Name,East,North,Height,Land cover", *rows]) + "\n"


def las_of(scene: Scene) -> laspy.LasData:
    """Return the points with their true classes, moved so that the square begins at `ORIGIN`."""
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = np.full(3, 0.001), np.array([*ORIGIN, 0.0])
    header.vlrs.append(WktCoordinateSystemVlr(_WKT))
    header.global_encoding.wkt = True
    header.generating_software = "Bare Earth demo"
    las = laspy.LasData(header)
    # The scene lies anywhere; that of the demo begins at round coordinates.
    west, south = (middle - scene.settings.size / 2 for middle in scene.corner)
    las.x, las.y = scene.points.x - west + ORIGIN[0], scene.points.y - south + ORIGIN[1]
    las.z = scene.points.z
    las.classification = scene.classes
    las.return_number, las.number_of_returns = scene.return_number, scene.number_of_returns
    las.gps_time = 2.0e8 + np.cumsum(scene.return_number == 1) * 5e-6
    strength = {
        GROUND: 900,
        LOW_VEGETATION: 600,
        HIGH_VEGETATION: 400,
        BUILDING: 1300,
        BRIDGE: 1100,
    }
    of_class = np.array([strength.get(value, 300) for value in range(19)])
    las.intensity = (of_class[scene.classes] / scene.number_of_returns).astype(np.uint16)
    return las
