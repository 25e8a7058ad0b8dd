"""Plain things: small scenes with one thing on a piece of land, whose truth is known by point.

`KINDS` is the matrix: each kind has rows such as ``5x1.5/20/8``, which are its sizes in metres, the
slope of the land in percent and the pulses per square metre. Each row is made at two places of the
grid: "a" on smooth land with scattered points, "b" on rough land with the pattern of a scanner.
"""

from __future__ import annotations

import zlib
from typing import Callable, NamedTuple

import numpy as np

from bare_earth.algorithms.core.points import Points

from . import plain_shapes as shapes
from .classes import BUILDING, GROUND, HIGH_NOISE, HIGH_VEGETATION, LOW_NOISE, LOW_VEGETATION
from .relief import waves
from .scene import SCALE, Scene
from .settings import Settings

PLACES = "a", "b"
# Metres of land round a thing, and the least side of a scene.
_ROUND, _LEAST = 25.0, 70.0
_NOISE = 0.025
# Metres that pulses slant per metre of height, to both sides.
_SLANT = 0.18
# Share of the pulses that strike a crown, and of these, that end on the ground below.
_CROWNS, _THROUGH = 0.7, 0.4


class Kind(NamedTuple):
    """Things of a kind: what they are, what may be wrong with them, and their rows."""

    name: str
    make: Callable  # of one of the functions below
    shape: Callable | None
    stays: bool
    rows: str
    wrong: float = 5.0  # percent of the points of the thing
    off: float = 0.25  # metres between the terrain models, and a tenth of the height of earth


class Row(NamedTuple):
    """One scene of the matrix."""

    kind: Kind
    sizes: tuple[float, ...]
    slope: float
    density: float
    place: str

    @property
    def name(self) -> str:
        """What it is, as the command prints it."""
        sizes = "x".join(f"{size:g}" for size in self.sizes)
        return f"{self.kind.name}-{sizes}-slope{self.slope:g}-{self.density:g}pm2-{self.place}"


class Plain(NamedTuple):
    """The scene of a row, and which points are the thing: the earth or the objects that count."""

    scene: Scene
    thing: np.ndarray


class _Site:
    """The land of a row, its dice, and the places of its pulses."""

    def __init__(self, row: Row, side: float) -> None:
        self.random = random = np.random.default_rng(zlib.crc32(row.name.encode()))
        self.row, self.side, is_rough = row, side, row.place == "b"
        self.angle, up = random.uniform(0.1, 1.4), random.uniform(0.0, 2 * np.pi)
        self._up = row.slope / 100.0 * np.array((np.cos(up), np.sin(up)))
        self._roll = waves(random, 0.12 if is_rough else 0.03, 22.0)
        self._bumps = waves(random, 0.03 if is_rough else 0.0, 3.0)
        count = int(row.density * side**2)
        if is_rough:
            step = 1.0 / np.sqrt(row.density)
            grid = np.arange(-0.75 * side, 0.75 * side, step)
            lattice = np.array(np.meshgrid(grid * 1.3, grid / 1.3)).reshape(2, -1)
            lattice += random.uniform(-0.4, 0.4, lattice.shape) * step
            self.x, self.y = self._turned(*lattice, random.uniform(0.1, 1.4))
            inside = np.maximum(np.abs(self.x), np.abs(self.y)) < side / 2
            self.x, self.y = self.x[inside], self.y[inside]
        else:
            self.x, self.y = random.uniform(-side / 2, side / 2, (2, count))
        # A step of the scanner leads to one side or to the other.
        self.slant = np.where(random.random(len(self.x)) < 0.5, -_SLANT, _SLANT)

    @staticmethod
    def _turned(x, y, angle):
        return x * np.cos(angle) + y * np.sin(angle), y * np.cos(angle) - x * np.sin(angle)

    def land(self, x, y):
        """Return the height of the land without the thing."""
        rolling = self._roll(x, y) + self._bumps(x, y)
        return 100.0 + self._up[0] * x + self._up[1] * y + rolling

    def rise(self, x, y):
        """Return how far the thing rises above what it stands on."""
        return self.row.kind.shape(*self._turned(x, y, self.angle), *self.row.sizes)

    def scene(self, columns, terrain) -> Plain:
        """Return the scene of some columns: x, y, z, class, thing, number and count of returns."""
        x, y, z, classes, thing, number, count = (np.asarray(column) for column in columns)
        z = z + self.random.normal(0.0, _NOISE, len(z))
        far = self.random.uniform(-0.5, 0.5, (2, 4)) * self.side  # birds
        x, y = np.append(x, far[0]), np.append(y, far[1])
        z = np.append(z, self.land(*far) + self.random.uniform(15.0, 60.0, 4))
        corner = tuple(np.round(self.random.uniform(200.0, 900.0, 2), 2).tolist())
        some = tuple(
            np.append(column, [value] * 4).astype(np.uint8)
            for column, value in ((classes, HIGH_NOISE), (number, 1), (count, 1))
        )
        at = (np.rint(axis / SCALE) * SCALE for axis in (x + corner[0], y + corner[1], z))
        scene = Scene(Points(*at), *some, self.row.name, 0, Settings(), corner, terrain)
        return Plain(scene, np.append(thing, [False] * 4))


def _side(sizes: tuple[float, ...], reach: float = 0.0) -> float:
    return max(_LEAST, reach + 2 * _ROUND)


def earth(row: Row) -> Plain:
    """Return earth, in the open."""
    site = _Site(row, _side(row.sizes, max(row.sizes[0] * 1.5, 20.0)))
    z = site.land(site.x, site.y) + site.rise(site.x, site.y)
    ones = np.ones(len(z))
    rise = np.abs(site.rise(site.x, site.y))
    thing = rise > 0.1 * rise.max()
    columns = site.x, site.y, z, ones * GROUND, thing, ones, ones
    return site.scene(columns, lambda x, y: site.land(x, y) + site.rise(x, y))


def wooded(row: Row) -> Plain:
    """Return earth below trees."""
    plain = earth(row)
    scene, random = plain.scene, np.random.default_rng(zlib.crc32(row.name.encode()) + 1)
    x, y, z = scene.points
    crown = patchy(random, x - scene.corner[0], y - scene.corner[1], 5.0) < _CROWNS
    crown &= scene.classes == GROUND
    through = random.random(len(x)) < _THROUGH
    top = np.flatnonzero(crown)
    leaves = Points(x[top], y[top], z[top] + random.uniform(5.0, 14.0, len(top)))
    kept = ~crown | through
    pairs = through[top]
    points = Points(*(np.append(a[kept], b) for a, b in zip(scene.points, leaves)))
    columns = (
        np.append(scene.classes[kept], np.full(len(top), HIGH_VEGETATION)),
        np.append(np.where(crown, 2, 1)[kept], np.ones(len(top))),
        np.append(np.where(crown, 2, 1)[kept], np.where(pairs, 2, 1)),
    )
    columns = (column.astype(np.uint8) for column in columns)
    scene = Scene(
        points,
        *columns,
        *(getattr(scene, name) for name in ("kind", "seed", "settings", "corner", "bare_earth")),
    )
    return Plain(scene, np.append(plain.thing[kept], np.zeros(len(top), bool)))


def patchy(random, x, y, length):
    """Return numbers from 0 to 1 that are alike within some metres, and evenly spread."""
    field = waves(random, 1.0, 2.0 * length, 9)(x, y)
    return np.argsort(np.argsort(field)) / max(len(field) - 1, 1)


def solid(row: Row, level: bool = True) -> Plain:
    """Return what stands on a level floor: pulses come from two sides, and some strike walls."""
    site = _Site(row, _side(row.sizes, _reach(row)))
    x, y, land = site.x, site.y, site.land(site.x, site.y)
    floor = float(site.land(np.zeros(1), np.zeros(1))[0])
    if level:
        on = np.isfinite(site.rise(x, y))
        rise = site.rise(x, y)[on]
        # Eaves are over the highest ground beside it.
        floor = max(floor, float(land[on].max()) + min(2.2, rise.min()) - rise.min())

    def top(x, y, land):
        return site.rise(x, y) + (floor if level else land)

    highest = np.nanmax(np.where(np.isfinite(site.rise(x, y)), top(x, y, land) - land, 0.0)) + 0.01
    z, is_solid = land.copy(), np.zeros(len(x), dtype=bool)
    before = np.full(len(x), highest)
    for above in np.linspace(highest, 0.0, 16):
        here = x + site.slant * above
        roof = top(here, y, land) - land
        hit = ~is_solid & (roof >= above)
        wall = np.where(roof > before, site.random.uniform(above, before), roof)
        z = np.where(hit, land + wall, z)
        is_solid |= hit
        before = np.where(is_solid, before, above)
    x = np.where(is_solid, x + site.slant * (z - land), x)
    classes = np.where(is_solid, BUILDING, GROUND)
    ones = np.ones(len(x))
    return site.scene((x, y, z, classes, is_solid & (z > land + 0.3), ones, ones), site.land)


def loose(row: Row) -> Plain:
    """Return many solid things that follow the land."""
    return solid(row, level=False)


def _reach(row: Row) -> float:
    """Return how long a thing is, of those that stand on the land."""
    side = np.arange(-250.0, 250.0, 0.5)
    u, v = np.meshgrid(side, side)
    on = np.isfinite(row.kind.shape(u, v, *row.sizes))
    return 2.0 * float(np.hypot(u, v)[on].max()) * 0.9


def grass(row: Row, numbered: bool = False) -> Plain:
    """Return plants all over the land, without return numbers: of a height, and a cover in %."""
    height, cover = row.sizes[:2]
    site = _Site(row, 60.0 if row.density < 100 else 30.0)
    x, y, land = site.x, site.y, site.land(site.x, site.y)
    random, count = site.random, len(site.x)
    share = cover / 100.0 * random.uniform(0.5, 1.5, count)
    plant = patchy(random, x, y, 1.0) * 0.5 + random.random(count) * 0.5 < share * 0.9
    plant = random.random(count) < cover / 100.0 if row.place == "a" else plant
    tall = height * random.uniform(0.5, 1.0, count)
    both = plant & numbered & (random.random(count) < 0.4)
    low = np.flatnonzero(both)
    z = land + np.where(plant, tall, 0.0)
    classes = np.where(plant, LOW_VEGETATION, GROUND)
    counts = np.where(both, 2, 1)
    columns = (
        np.append(x, x[low]), np.append(y, y[low]), np.append(z, land[low]),
        np.append(classes, [GROUND] * len(low)), np.append(plant & (tall > 0.2), low < 0),
        np.append(np.ones(count), [2] * len(low)), np.append(counts, [2] * len(low)),
    )  # fmt: skip
    return site.scene(columns, site.land)


def numbered_grass(row: Row) -> Plain:
    """Return the same with two returns of many pulses."""
    return grass(row, numbered=True)


def leafy(row: Row) -> Plain:
    """Return bushes and hedges, through which some pulses see the ground."""
    site = _Site(row, _side(row.sizes, _reach(row)))
    rise, land = site.rise(site.x, site.y), site.land(site.x, site.y)
    leaf = np.isfinite(rise) & (site.random.random(len(rise)) < 0.85)
    tall = np.where(leaf, rise, 0.0) * site.random.uniform(0.4, 1.0, len(rise))
    classes, ones = np.where(leaf, LOW_VEGETATION, GROUND), np.ones(len(rise))
    columns = site.x, site.y, land + tall, classes, leaf & (tall > 0.3), ones, ones
    return site.scene(columns, site.land)


def outliers(row: Row) -> Plain:
    """Return groups of points below the ground or, if the last size is negative, above it."""
    width, depth, many = row.sizes
    site = _Site(row, 80.0)
    z = site.land(site.x, site.y)
    random = site.random
    middles = np.array(np.meshgrid(*[np.linspace(-28.0, 28.0, 4)] * 2)).reshape(2, -1)
    middles = middles + random.uniform(-4.0, 4.0, middles.shape)
    x, y = (
        np.repeat(middles, int(many), axis=1)
        + random.uniform(-0.5, 0.5, (2, 16 * int(many))) * width
    )
    deep = np.repeat(depth * random.uniform(0.8, 1.2, 16), int(many))
    low = site.land(x, y) - deep + random.normal(0.0, 0.05 * width, len(x))
    classes = np.append(np.full(len(z), GROUND), np.full(len(x), LOW_NOISE))
    ones = np.ones(len(classes))
    columns = np.append(site.x, x), np.append(site.y, y), np.append(z, low), classes
    return site.scene((*columns, classes == LOW_NOISE, ones, ones), site.land)


_STAY, _GO = True, False
KINDS: tuple[Kind, ...] = (
    Kind("bowl", earth, shapes.bowl, _STAY,
        "3x0.5/0/8 4x1/0/8 5x1.5/0/4 5x1.5/20/8 6x2.5/10/8 8x3/0/4 10x4/30/4"),
    Kind("crater", earth, shapes.crater, _STAY,
        "4x1/0/20 5x1.5/0/8 6x2/20/8 8x3/0/4 10x4/10/2"),
    Kind("pit", earth, shapes.pit, _STAY,
        "3x2/0/20 4x3/0/8 6x4/10/8 8x6/0/8 10x5/20/4"),
    Kind("bowl-under-trees", wooded, shapes.bowl, _STAY,
        "5x1.5/0/8 8x2/20/8 6x2/0/20 10x4/10/4"),
    Kind("ramp", earth, shapes.ramp, _STAY,
        "2.5x2/0/8 3x3/0/8 4.4x3.5/0/8 6x4/10/4"),
    Kind("trench", earth, shapes.trench, _STAY,
        "2.5x1.5/0/8 3x3.5/0/8 4x3/10/8 6x4/0/4"),
    Kind("dyke", earth, shapes.dyke, _STAY,
        "2x1.5/0/4 3x3/0/2 5x6/5/4 10x5/0/1"),
    Kind("terraces", earth, shapes.terraces, _STAY,
        "10x1.5/10/4 8x2.5/20/8 15x1/5/2"),
    Kind("flat-roof", solid, shapes.flat, _GO,
        "10x8x3/0/8 20x12x4/5/4 40x25x3/0/2 60x40x3.2/0/2 80x50x3.2/0/4 100x60x4/5/2 "
        "120x80x9/5/2 120x80x8/10/2 150x80x6/0/1 200x100x9/0/2 100x60x3.2/0/2 "
        "125x78x4/0/2", 2.0, 0.35),
    Kind("gable-roof", solid, shapes.gable, _GO,
        "10x8x3/0/8 16x10x3/10/4 40x15x3/5/2 80x20x4/0/2", 2.0, 0.35),
    Kind("a-frame", solid, shapes.a_frame, _GO,
        "16x10x8/0/8 12x8x7/5/4 20x12x8/0/2"),
    Kind("polytunnels", loose, shapes.vaults, _GO,
        "40x8x3.2x1x4/0/8 60x8x3.5x1x8/3/4 50x6x2.5x1x5/0/8"),
    Kind("panels", loose, shapes.panels, _GO,
        "40x4x0.8x0.4x4x6/0/8 50x4x2x0x1.5x6/5/4"),
    Kind("grass", grass, None, _GO,
        "0.3x40/0/20 0.5x60/5/8 0.8x60/0/20 1x70/0/10 1.2x80/0/50 0.6x50/0/400", 5.0, 0.15),
    Kind("numbered-grass", numbered_grass, None, _GO,
        "0.5x60/5/8 0.8x80/0/20 1.2x70/0/10", 5.0, 0.15),
    Kind("low-clump", outliers, None, _GO,
        "0.5x2x8/0/4 1x5x15/0/8 2x10x30/0/8 0.3x1x5/0/20"),
    Kind("low-single", outliers, None, _GO,
        "0.1x1.5x1/0/4 0.1x8x1/10/2 0.1x4x1/0/20", 0.0),
    Kind("cars", loose, shapes.boxes, _GO,
        "4.5x1.8x1.5x1x6/0/8 4.5x1.8x1.5x1.5x5/5/4"),
)  # fmt: skip


def rows() -> list[Row]:
    """Return all rows of the matrix, in the order of the kinds."""
    found = []
    for kind in KINDS:
        for text in kind.rows.split():
            sizes, slope, density = text.split("/")
            numbers = tuple(map(float, sizes.split("x")))
            found += [Row(kind, numbers, float(slope), float(density), place) for place in PLACES]
    return found
