"""Checkpoints on land whose true heights are known."""

import numpy as np
from surveys import write_points

from bare_earth import Progress
from bare_earth.algorithms.tools.check.checking import TOOL
from bare_earth.algorithms.tools.running import run

EAST, NORTH, SIZE = 500_000.0, 5_600_000.0, 100.0
CORNER = np.array([EAST, NORTH])


def height(x, y):
    """Return the true height of land that is a plane in the west, and rolls in the east."""
    return 50.0 + 0.05 * x + 0.02 * y + np.where(x > 50, 3.0 * np.sin((x - 50) / 9.0), 0.0)


def cloud(count=8_000, seed=1):
    """Return x, y, z and classes: ground with a building of 30 x 20 m, and trees in the north."""
    random = np.random.default_rng(seed)
    x, y = (np.round(random.uniform(0, SIZE, count), 3) for _ in range(2))
    z, classes = height(x, y), np.full(count, 2, np.uint8)
    is_building = (x > 10) & (x < 40) & (y > 40) & (y < 60)
    trees = (y > 80) & (random.random(count) < 0.5)
    z[is_building] += 8.0
    z[trees] += random.uniform(2, 9, trees.sum())
    classes[is_building], classes[trees] = 6, 5
    return x, y, z, classes


def write(path, x, y, z, classes, crs="EPSG:25832", returns=1):
    offset = EAST, NORTH, 0.0
    return write_points(path, x, y, z, classes, offset=offset, crs=crs, number_of_returns=returns)


def places(count=40, seed=2):
    """Return x and y of checkpoints on open ground, away from the edge."""
    random = np.random.default_rng(seed)
    x, y = random.uniform(5, 95, (2, 10 * count))
    free = (x < 5) | (x > 45) | (y < 35) | (y > 65)
    return np.column_stack((x, y))[free][:count]


def check(paths, checkpoints=None, *sets, outputs=None, progress=Progress(), **others):
    inputs = {"sources": paths, "checkpoints": checkpoints, **others}
    return run(TOOL, inputs, outputs or {}, sets, progress)
