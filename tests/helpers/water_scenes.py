"""Last returns of land with a lake or a river whose levels are known."""

import json
from types import SimpleNamespace

import numpy as np

import bare_earth
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.tools.water.finding import Water, find_water
from bare_earth.algorithms.tools.water.grid import WaterGrid

WIDE, DENSITY, LEVEL = 400.0, 2.0, 100.0


class Scene:
    """Last returns of rolling land that slopes by 3 %."""

    def __init__(self, wide=WIDE, high=WIDE, density=DENSITY, slope=0.03, rolling=1.0, seed=1):
        self.random = np.random.default_rng(seed)
        count = int(wide * high * density)
        self.x, self.y = self.random.uniform(0, wide, count), self.random.uniform(0, high, count)
        self.size = wide, high
        self.z = LEVEL + slope * (self.x - wide / 2) + self.random.normal(0, 0.03, count)
        self.z += rolling * np.sin(self.x / 37.0) * np.cos(self.y / 41.0)
        self.classes = np.full(count, 2)

    def inside(self, shape):
        return shape(self.x, self.y)

    def basin(self, away, level=LEVEL, slope=0.3):
        """Carve land round water, `away` metres from its shore, with banks of some slope."""
        at = level(self.x, self.y) if callable(level) else level
        # A dam holds the water on the low side.
        bank = at + slope * np.clip(away(self.x, self.y), 0, None)
        low = np.minimum(bank, at + 1.0)
        near = away(self.x, self.y) < 25.0
        self.z = np.where(near, np.clip(self.z, low, bank), self.z)
        self.z += self.random.normal(0, 0.03, len(self.z))

    def keep(self, which):
        self.x, self.y, self.z, self.classes = (
            axis[which] for axis in (self.x, self.y, self.z, self.classes)
        )

    def grid(self, cell=1.0):
        grid = WaterGrid((0.0, 0.0, self.size[0] - 1e-6, self.size[1] - 1e-6), cell)
        every = np.ones(len(self.x), dtype=bool)
        marks = (self.classes == 2, self.classes == 9, every, self.classes == 17)
        grid.add(Points(self.x, self.y, self.z), *marks)
        return grid

    def water(self, cell=1.0, **how):
        return find_water(self.grid(cell), Water(**how))


def lake(x, y):
    """Return how far places are from a lake of 1.6 ha with an irregular shore; negative inside."""
    east, north = x - 200.0, y - 210.0
    angle = np.arctan2(north, east)
    return np.hypot(east, north) - 70.0 * (1.0 + 0.25 * np.sin(3 * angle) + 0.1 * np.cos(5 * angle))


def contains(body, x, y):
    """Return which places lie in the rings of water, by counting crossings."""
    inside = np.zeros(np.shape(x), dtype=bool)
    for ring in body.rings:
        for (x0, y0, _), (x1, y1, _) in zip(ring[:-1], ring[1:]):
            if y0 != y1:
                crosses = (y0 > y) != (y1 > y)
                inside ^= crosses & (x < (x1 - x0) * (y - y0) / (y1 - y0) + x0)
    return inside


def written_water(source, folder):
    """Return the bodies of water that are found in a file, as they are written, highest first."""
    files = folder / "water.geojson", folder / "shores.geojson"
    bare_earth.water(source, files[0], breaklines_out=files[1])
    water, shores = (json.loads(path.read_text("utf-8"))["features"] for path in files)
    bodies = []
    for properties in (feature["properties"] for feature in water):
        rings = [
            np.array(feature["geometry"]["coordinates"])
            for feature in shores
            if feature["properties"] == {"ID": properties["ID"], "KIND": "shore"}
        ]
        values = {name.lower(): value for name, value in properties.items()}
        bodies.append(SimpleNamespace(rings=rings, **values))
    return sorted(bodies, key=lambda body: -body.level)


def overlap(bodies, away, size=(WIDE, WIDE), places=250):
    """Return the intersection over union of found and true water, seen at so many places a side."""
    step = size[0] / places
    x, y = np.meshgrid(*(np.arange(step / 2.0, side, step) for side in size))
    true, found = away(x, y) < 0, np.zeros(x.shape, dtype=bool)
    for body in bodies:
        found |= contains(body, x, y)
    return (true & found).sum() / (true | found).sum()


def lake_scene(kind):
    scene = Scene(density=4.0 if kind == "class 9" else DENSITY)
    scene.basin(lake)
    inside = scene.inside(lake) < 0
    scene.z[inside] = LEVEL + scene.random.normal(0, 0.03, inside.sum())
    left = {"empty": 0.0, "sparse": 0.1, "class 9": 0.6}[kind]
    scene.classes[inside] = 9 if kind == "class 9" else 1
    scene.keep(~inside | (scene.random.random(len(inside)) < left))
    return scene


def river(x, y):
    """Return how far places are from a river, 40 m wide, that winds from west to east."""
    return np.abs(y - 150.0 - 30.0 * np.sin(x / 90.0)) - 20.0


def run(*arguments):
    assert main([str(argument) for argument in arguments]) == 0
