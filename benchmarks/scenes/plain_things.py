"""How plain things are made: a piece of land, what is on it, and where pulses end."""

from __future__ import annotations

import zlib
from dataclasses import replace
from typing import TYPE_CHECKING, Callable, NamedTuple

import numpy as np

from bare_earth.algorithms.core.points import Points

from . import plain_shapes as shapes
from .classes import BUILDING, GROUND, HIGH_NOISE, HIGH_VEGETATION, LOW_NOISE, LOW_VEGETATION
from .relief import waves
from .scene import SCALE, Scene
from .settings import Settings

if TYPE_CHECKING:
    from .plain import Row

# Metres of land round a thing, and the least side of a scene.
_ROUND, _LEAST = 22.0, 60.0
_NOISE = 0.025
# Metres that pulses slant per metre of height, to both sides, at the two places.
_SLANTS = {"a": 0.02, "b": 0.18}
# Share of the pulses that strike a crown, and of these, that end on the ground below.
_CROWNS, _THROUGH = 0.7, 0.4
# Share of the pulses that strike leaves where there are any, and of those that strike plants, that
# have a second return from the ground.
_LEAVES, _SECOND = 0.85, 0.4
_COLUMNS = "classes", "return_number", "number_of_returns"
# Above this, points of an object can be told from the ground.
_TOLD, _TOLD_OF_PLANTS = 0.3, 0.2
# A house that stands beside earth: its sides, its height, and how far its middle is from the thing.
_HOUSE, _BESIDE = (12.0, 10.0, 6.0), 8.0


class Plain(NamedTuple):
    """The scene of a row, which points are the thing, and the direction of its length."""

    scene: Scene
    thing: np.ndarray
    angle: float


def _turned(x, y, angle):
    cos, sin = np.cos(angle), np.sin(angle)
    return x * cos + y * sin, y * cos - x * sin


class _Site:
    """The land of a row, its dice, and the places of its pulses."""

    def __init__(self, row: Row, side: float) -> None:
        self.random = random = np.random.default_rng(zlib.crc32(row.name.encode()))
        self.row, self.side, is_rough = row, side, row.place == "b"
        slope, density = map(float, row.text.split("/")[1:])
        self.angle = random.uniform(0.1, 1.4) if is_rough else random.integers(2) * np.pi / 2
        up = random.uniform(0.0, 2 * np.pi)
        self._up = slope / 100.0 * np.array((np.cos(up), np.sin(up)))
        self._roll = waves(random, 0.12 if is_rough else 0.03, 22.0)
        self._bumps = waves(random, 0.03 if is_rough else 0.0, 3.0)
        self.x, self.y = random.uniform(-side / 2, side / 2, (2, int(density * side**2)))
        if is_rough:
            step = density**-0.5
            across = np.arange(-0.75 * side, 0.75 * side, step)
            lattice = np.array(np.meshgrid(across * 1.3, across / 1.3)).reshape(2, -1)
            lattice += random.uniform(-0.4, 0.4, lattice.shape) * step
            x, y = _turned(*lattice, random.uniform(0.1, 1.4))
            inside = np.maximum(np.abs(x), np.abs(y)) < side / 2
            self.x, self.y = x[inside], y[inside]
        self.count = len(self.x)

    def land(self, x, y):
        """Return the height of the land without the thing."""
        rolling = self._roll(x, y) + self._bumps(x, y)
        return 100.0 + self._up[0] * x + self._up[1] * y + rolling

    def rise(self, x, y):
        """Return how far the thing rises above what it stands on."""
        return self.row.kind.shape(*_turned(x, y, self.angle), *self.row.sizes)

    def plain(self, x, y, z, classes, thing, terrain, number=None, count=None) -> Plain:
        """Return the scene of some points, with noise and a few birds."""
        one, random, side = np.ones(len(x)), self.random, self.side / 2
        birds = random.uniform(-side, side, (2, 4))
        high = self.land(*birds) + random.uniform(15.0, 60.0, 4)
        corner = tuple(np.round(random.uniform(200.0, 900.0, 2), 2).tolist())
        z = z + random.normal(0.0, _NOISE, len(z))
        xyz = np.column_stack((np.array((x, y, z)), (*birds, high))) + np.array([[*corner, 0.0]]).T
        columns = (
            np.append(column, [value] * 4).astype(np.uint8)
            for column, value in (
                (classes, HIGH_NOISE),
                (one if number is None else number, 1),
                (one if count is None else count, 1),
            )
        )
        points = Points(*(np.rint(xyz / SCALE) * SCALE))
        scene = Scene(points, *columns, self.row.name, 0, Settings(), corner, terrain)
        return Plain(scene, np.append(thing, [False] * 4), self.angle)


class _Terraces(_Site):
    """Land in terraces, one for each hall of a row."""

    def land(self, x, y):
        """Return the height of the land without the halls."""
        _, width, _, *rest = self.row.sizes
        return super().land(x, y) + shapes.steps(_turned(x, y, self.angle)[1], width, *rest)


def _extent(shape: Callable[..., np.ndarray], sizes: tuple[float, ...]) -> float:
    """Return how wide an object is, whatever its direction."""
    axis = np.arange(-150.0, 150.5, 1.5)
    u, v = np.meshgrid(axis, axis)
    return 1.8 * float(np.hypot(u, v)[np.isfinite(shape(u, v, *sizes))].max(initial=3.0))


def _breadth(row: Row, of: Callable = min) -> float:
    """Return how wide earth is, across what is long; 0 for what has no other side."""
    axis, zero = np.arange(-100.0, 100.5, 0.5), np.zeros(401)
    rises = (np.abs(row.kind.shape(*places, *row.sizes)) for places in ((axis, zero), (zero, axis)))
    sides = (float(np.ptp(axis[rise > 0.1 * rise.max()])) for rise in rises if rise.any())
    side = of(sides)
    return side if side < 150.0 else 0.0


def _struck(site: _Site, floor: Callable, top: Callable) -> tuple[np.ndarray, ...]:
    """Return x, y, z and what is solid of pulses from two sides, some of which strike walls."""
    x, y, land = site.x, site.y, floor(site.x, site.y)
    slant = _SLANTS[site.row.place] * site.random.choice((-1.0, 1.0), site.count)
    highest = max(float((top(x, y) - land).max()), 0.0) + 0.01
    z, is_solid, before = land.copy(), np.zeros(site.count, dtype=bool), highest
    for above in np.linspace(highest, 0.0, 11):
        roof = top(x + slant * above, y) - land
        hit = ~is_solid & (roof >= above)
        met = np.where(roof > before, site.random.uniform(above, before, site.count), roof)
        z[hit] += met[hit]
        is_solid, before = is_solid | hit, above
    return np.where(is_solid, x + slant * (z - land), x), y, z, is_solid


def earth(row: Row, has_house: bool = False, of: Callable = min) -> Plain:
    """Return earth in the open."""
    site = _Site(row, max(_LEAST, _breadth(row, of) + 2 * _ROUND))

    def terrain(x, y):
        return site.land(x, y) + site.rise(x, y)

    x, y, solid = site.x, site.y, np.zeros(site.count, dtype=bool)
    z = terrain(x, y)
    if has_house:
        place = _turned(0.0, _BESIDE, -site.angle)
        base = float(terrain(*(np.array([axis]) for axis in place))[0])

        def house(x, y):
            u, v = _turned(x, y, site.angle)
            return base + shapes.flat(u, v - _BESIDE, *_HOUSE)

        x, y, z, solid = _struck(site, terrain, house)
    rise = np.abs(site.rise(x, y))
    if has_house:  # what is raised near it
        near = np.hypot(*(a - b for a, b in zip((x, y), place))) < 2.0 * _HOUSE[0]
        rise = rise * near
    thing = ~solid & (rise > 0.1 * rise.max())
    return site.plain(x, y, z, np.where(solid, BUILDING, GROUND), thing, terrain)


def whole(row: Row) -> Plain:
    """Return earth in the open, with both of its ends."""
    return earth(row, of=max)


def cut_off(row: Row) -> Plain:
    """Return land behind gaps in it."""
    plain = earth(row)
    (x, y, _), (west, south) = plain.scene.points, plain.scene.corner
    places = _turned(x - west, y - south, plain.angle)
    is_land = row.kind.shape(*places, *row.sizes, is_land=True)
    return plain._replace(thing=is_land & (plain.scene.classes == GROUND))


def by_house(row: Row) -> Plain:
    """Return earth with a house on it."""
    return earth(row, has_house=True)


def wooded(row: Row, below: Callable[[Row], Plain] = earth) -> Plain:
    """Return earth below trees: at the second place without return numbers."""
    plain = below(row)
    scene, random = plain.scene, np.random.default_rng(zlib.crc32(row.name.encode()) + 1)
    x, y, z = scene.points
    crown = (_patches(random, x, y, 5.0) < _CROWNS) & (scene.classes != HIGH_NOISE)
    kept, top = ~crown | (random.random(len(x)) < _THROUGH), np.flatnonzero(crown)
    leaves = Points(x[top], y[top], z[top] + random.uniform(5.0, 14.0, len(top)))
    is_numbered = row.place == "a" and below is earth
    counted, several = np.where(crown & is_numbered, 2, 1)[kept], kept[top] & is_numbered
    columns = (
        np.append(scene.classes[kept], np.full(len(top), HIGH_VEGETATION)),
        np.append(counted, np.ones(len(top))),
        np.append(counted, np.where(several, 2, 1)),
    )
    points = Points(*(np.append(axis[kept], more) for axis, more in zip(scene.points, leaves)))
    classes, number, count = (column.astype(np.uint8) for column in columns)
    scene = Scene(
        points, classes, number, count, scene.kind, 0, scene.settings, scene.corner,
        scene.bare_earth,
    )  # fmt: skip
    return Plain(scene, np.append(plain.thing[kept], np.zeros(len(top), bool)), plain.angle)


def _patches(random: np.random.Generator, x, y, length: float) -> np.ndarray:
    """Return numbers from 0 to 1, evenly spread, that are alike within some metres."""
    field = waves(random, 1.0, 2.0 * length, 9)(x, y)
    return np.argsort(np.argsort(field)) / max(len(field) - 1, 1)


def solid(row: Row, is_level: bool = True, land: type[_Site] = _Site) -> Plain:
    """Return what stands on a level floor, with its eaves above the highest ground below it."""
    shape, sizes = row.kind.shape, row.sizes
    site = land(row, max(_LEAST, _extent(shape, sizes) + 2 * _ROUND))
    rise = site.rise(site.x, site.y)
    on = np.isfinite(rise)
    highest = float(site.land(site.x, site.y)[on].max())
    lowest = float(rise[on].min())
    floor = max(float(site.land(*np.zeros((2, 1)))[0]), highest + min(2.2, lowest) - lowest)

    def top(x, y):
        return site.rise(x, y) + (floor if is_level else site.land(x, y))

    x, y, z, is_solid = _struck(site, site.land, top)
    thing = is_solid & (z > site.land(x, y) + _TOLD)
    return site.plain(x, y, z, np.where(is_solid, BUILDING, GROUND), thing, site.land)


def terraced(row: Row) -> Plain:
    """Return halls on terraces."""
    return solid(row, False, _Terraces)


def afloat(row: Row) -> Plain:
    """Return a ship at a quay; the water sends no pulse back."""
    plain = solid(row)
    scene, (west, south) = plain.scene, plain.scene.corner
    x, y, _ = scene.points
    dry = plain.thing | (_turned(x - west, y - south, plain.angle)[1] > 0.0)
    columns = scene.classes, scene.return_number, scene.number_of_returns
    scene = replace(
        scene,
        points=scene.points.take(dry),
        **dict(zip(_COLUMNS, (column[dry] for column in columns))),
    )
    return Plain(scene, plain.thing[dry], plain.angle)


def loose(row: Row) -> Plain:
    """Return what stands on the land as it is: rows of things, and small ones."""
    return solid(row, is_level=False)


def plants(row: Row, is_numbered: bool = False) -> Plain:
    """Return plants all over the land: of a height, and a cover in percent."""
    tall, cover = row.sizes[:2]
    site = _Site(row, _LEAST if float(row.text.split("/")[2]) < 100 else _LEAST / 2)
    random, count, land = site.random, site.count, site.land(site.x, site.y)
    dice = random.random(count)
    if row.place == "b":  # in tufts
        dice = np.argsort(np.argsort(dice + _patches(random, site.x, site.y, 1.0))) / count
    plant = dice < cover / 100.0
    if row.kind.shape is not None:
        plant = np.isfinite(site.rise(site.x, site.y)) & (dice < 0.95)
    height = np.where(plant, tall * random.uniform(0.5, 1.0, count), 0.0)
    below = np.flatnonzero(plant & is_numbered & (random.random(count) < _SECOND))
    counts, twos = np.ones(count), np.full(len(below), 2)
    counts[below] = 2
    return site.plain(
        np.append(site.x, site.x[below]), np.append(site.y, site.y[below]),
        np.append(land + height, land[below]),
        np.append(np.where(plant, LOW_VEGETATION, GROUND), np.full(len(below), GROUND)),
        np.append(height > _TOLD_OF_PLANTS, below < 0), site.land,
        np.append(np.ones(count), twos), np.append(counts, twos),
    )  # fmt: skip


def numbered(row: Row) -> Plain:
    """Return plants of which some pulses have two returns."""
    return plants(row, is_numbered=True)


def understory(row: Row) -> Plain:
    """Return plants below trees, without return numbers."""
    return wooded(row, plants)


def leafy(row: Row) -> Plain:
    """Return bushes and hedges, through which some pulses see the ground."""
    site = _Site(row, max(_LEAST, _extent(row.kind.shape, row.sizes) + 2 * _ROUND))
    rise = site.rise(site.x, site.y)
    leaf = np.isfinite(rise) & (site.random.random(site.count) < _LEAVES)
    height = np.where(leaf, rise, 0.0) * site.random.uniform(0.4, 1.0, site.count)
    z, classes = site.land(site.x, site.y) + height, np.where(leaf, LOW_VEGETATION, GROUND)
    return site.plain(site.x, site.y, z, classes, height > _TOLD, site.land)


def layers(row: Row) -> Plain:
    """Return a layer below the land: its side, its depth, its density in percent of the land's."""
    side, depth, share = row.sizes
    site = _Site(row, side + 2 * _ROUND)
    random = site.random
    x, y = random.uniform(
        -side / 2, side / 2, (2, int(side**2 * share / 100.0 * site.count / site.side**2))
    )
    low = site.land(x, y) - depth + random.normal(0.0, 0.02 * depth, len(x))
    return _with_noise(site, x, y, low)


def outliers(row: Row) -> Plain:
    """Return 16 groups of points, which are below the ground if the second size is positive."""
    width, depth, many = row.sizes
    site = _Site(row, 80.0)
    random, several = site.random, int(many)
    middles = np.array(np.meshgrid(*[np.linspace(-28.0, 28.0, 4)] * 2)).reshape(2, -1)
    middles += random.uniform(-4.0, 4.0, middles.shape)
    x, y = np.repeat(middles, several, axis=1)
    x, y = np.array((x, y)) + width * random.uniform(-0.5, 0.5, (2, len(x)))
    deep = np.repeat(depth * random.uniform(0.8, 1.2, 16), several)
    low = site.land(x, y) - deep + random.normal(0.0, 0.05 * width, len(x))
    return _with_noise(site, x, y, low)


def _with_noise(site: _Site, x: np.ndarray, y: np.ndarray, low: np.ndarray) -> Plain:
    """Return the land with some points off it, which are the thing."""
    classes = np.append(np.full(site.count, GROUND), np.full(len(x), LOW_NOISE))
    x, y = np.append(site.x, x), np.append(site.y, y)
    z = np.append(site.land(site.x, site.y), low)
    return site.plain(x, y, z, classes, classes == LOW_NOISE, site.land)
