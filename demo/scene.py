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
    WATER,
)
from benchmarks.scenes.scene import ORIGIN

KIND, SEED = "mixed_land", 2004
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


def write_scene(cloud: Path, truth: Path, density: float = 8.0, seed: int = SEED) -> int:
    """Write a survey without classes, and the same points with their true classes.

    Parameters
    ----------
    cloud, truth : Path
        The LAS or LAZ files to write.
    density : float
        Pulses per square metre.
    seed : int
        The same seed gives the same files.

    Returns
    -------
    int
        Number of points.
    """
    las = _las(make(KIND, seed, density=density))
    las.write(truth)
    las.classification = np.zeros(len(las.points), dtype=np.uint8)
    las.write(cloud)
    return len(las.points)


def _las(scene: Scene) -> laspy.LasData:
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
