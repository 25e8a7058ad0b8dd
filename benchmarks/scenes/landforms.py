"""Kinds of land that are steep, stepped or rough by themselves."""

from __future__ import annotations

import numpy as np

from .landscape import Landscape, Plants
from .planting import meadow, single_trees, undergrowth, wood
from .relief import bank, smooth, steps, waves
from .scene import Kind, Site, kind


@kind(height=8.0)
def hills(site: Site) -> Landscape:
    """Rolling land with meadows, shrubs and single trees."""
    roll, rough = waves(site.random, site.settings.height / 2, 90.0), waves(site.random, 0.1, 9.0)
    return Landscape(
        lambda x, y: 300.0 + site.settings.slope * x + roll(x, y) + rough(x, y),
        trees=(single_trees(site, 60),),
        plants=(meadow(site), undergrowth(site, 1.5, 0.6, 0.12)),
    )


@kind(height=18.0)
def quarry(site: Site) -> Landscape:
    """A quarry: a pit of three benches with faces of 70 to 80 degrees, heaps on its floor."""
    roll, rough = waves(site.random, 1.5, 80.0), waves(site.random, 0.15, 5.0)
    bend = waves(site.random, 6.0, 70.0)
    east, north = site.random.uniform(-20, 20, 2)
    radius, bench = site.half * site.between(0.6, 0.7), site.between(10.0, 14.0)
    rise = site.settings.height / 3
    heaps = np.array((east, north)) + site.random.uniform(-18, 18, (6, 2))
    sizes = site.random.uniform(1.5, 4.0, 6)

    def terrain(x, y):
        inward = radius - np.hypot(x - east, y - north) + bend(x, y)
        depth = np.clip(steps(inward, bench, rise, 1.6), 0.0, site.settings.height)
        floor = 250.0 + 0.03 * x + roll(x, y) - depth + rough(x, y)
        for (a, b), tall in zip(heaps, sizes):
            cone = tall - 0.65 * np.hypot(x - a, y - b)
            floor = floor + np.maximum(cone, 0.0)
        return floor

    return Landscape(
        terrain, trees=(single_trees(site, 50, 9.0, lambda x, y: np.hypot(x, y) < radius),),
        plants=(undergrowth(site, 1.2, 0.5, 0.12),),
    )  # fmt: skip


@kind(height=6.0, size=240.0)
def open_cast(site: Site) -> Landscape:
    """Benches of an open-cast mine, one above the other, straight and 20 to 30 m wide."""
    width, bend = site.between(20.0, 30.0), waves(site.random, 4.0, 120.0)
    rough = waves(site.random, 0.12, 6.0)
    phase, face = site.between(0.0, 30.0), site.between(1.0, 3.0)

    def terrain(x, y):
        along, across = site.axes(x, y)
        climb = across + phase + bend(x, y)
        return 180.0 + steps(climb, width, site.settings.height, face) + rough(x, y) + 0.01 * along

    return Landscape(terrain, trees=(single_trees(site, 60, 6.0),))


@kind(height=30.0, size=160.0, density=8.0)
def sea_cliff(site: Site) -> Landscape:
    """A sea cliff with a stack before it, and water."""
    bend, rough = waves(site.random, 5.0, 45.0), waves(site.random, 0.35, 5.0)
    roll, run = waves(site.random, 1.0, 60.0), site.between(3.0, 8.0)
    stack, off = site.place(site.between(-30, 30), -site.between(26, 36)), site.between(7.0, 11.0)
    tall = site.settings.height

    def terrain(x, y):
        _, across = site.axes(x, y)
        inland = across + bend(x, y) + 10.0
        z = (
            1.0
            - 3.0 * smooth(-inland / 30.0)
            + (tall + 0.08 * np.maximum(inland, 0)) * bank(inland, run)
        )
        out = off - np.hypot(x - stack[0], y - stack[1]) + 0.4 * bend(y, x)
        z = np.maximum(z, -2.0 + 0.75 * tall * bank(out, 3.5))
        return z + rough(x, y) + roll(x, y) * smooth(inland / 20.0)

    def low(x, y):
        return terrain(x, y) < 0.5 * tall

    return Landscape(
        terrain, trees=(single_trees(site, 60, 6.0, low),),
        plants=(undergrowth(site, 0.9, 0.4, 0.15),), water=lambda x, y: terrain(x, y) < 0.0,
    )  # fmt: skip


@kind(height=25.0)
def gorge(site: Site) -> Landscape:
    """A gorge with walls of 65 to 80 degrees and a stream, trees on its rims."""
    bend, rough = waves(site.random, 7.0, 110.0), waves(site.random, 0.3, 6.0)
    floor, run = site.between(5.0, 10.0), site.settings.height * site.between(0.2, 0.45)
    roll = waves(site.random, 1.5, 70.0)

    def terrain(x, y):
        along, across = site.axes(x, y)
        out = np.abs(across + bend(x, y)) - floor - run / 2
        z = 400.0 + site.settings.height * bank(out, run) + 0.06 * np.maximum(out, 0)
        return z + 0.02 * along + rough(x, y) + roll(x, y) * smooth(out / 20.0)

    def deep(x, y):
        return np.abs(site.axes(x, y)[1] + bend(x, y)) < floor + run

    return Landscape(
        terrain, trees=(single_trees(site, 120, 12.0, deep),),
        plants=(undergrowth(site, 1.0, 0.4, 0.2),),
        water=lambda x, y: np.abs(site.axes(x, y)[1] + bend(x, y)) < 0.4 * floor,
    )  # fmt: skip


@kind(slope=1.0)
def sharp_ridge(site: Site) -> Landscape:
    """A sharp ridge whose sides fall at 45 degrees."""
    bend, rough = waves(site.random, 5.0, 80.0), waves(site.random, 0.2, 5.0)

    def terrain(x, y):
        along, across = site.axes(x, y)
        fall = np.abs(across + bend(x, y))
        return 900.0 - site.settings.slope * fall + 0.05 * along + rough(x, y)

    trees = single_trees(site, 90, 9.0)
    return Landscape(terrain, trees=(trees,), plants=(undergrowth(site, 0.8, 0.4, 0.1),))


@kind(height=20.0)
def mesa(site: Site) -> Landscape:
    """A table mountain of 60 to 90 m with steep sides, and a scree below them."""
    bend, rough = waves(site.random, 5.0, 50.0), waves(site.random, 0.15, 6.0)
    radius, tall = site.half * site.between(0.35, 0.45), site.settings.height
    roll = waves(site.random, 1.0, 80.0)

    def terrain(x, y):
        out = np.hypot(x, 1.2 * y) - radius + bend(x, y)
        scree = 0.35 * tall * np.clip(1.0 - out / (0.6 * tall), 0.0, 1.0)
        return 500.0 + np.maximum(tall * bank(-out, 3.0), scree) + rough(x, y) + roll(x, y)

    trees = single_trees(site, 60, 7.0)
    return Landscape(terrain, trees=(trees,), plants=(undergrowth(site, 1.0, 0.4, 0.1),))


@kind(height=5.0)
def dunes(site: Site) -> Landscape:
    """Dunes with a gentle and a steep side, grass on them."""
    bend, length = waves(site.random, 5.0, 90.0), site.between(28.0, 45.0)
    rough, tall = waves(site.random, 0.05, 4.0), waves(site.random, 0.25, 100.0)

    def terrain(x, y):
        _, across = site.axes(x, y)
        share = np.mod((across + bend(x, y)) / length, 1.0)
        shape = np.where(share < 0.78, smooth(share / 0.78), smooth((1.0 - share) / 0.22))
        return 8.0 + site.settings.height * shape * (1.0 + tall(x, y)) + rough(x, y)

    trees = single_trees(site, 30, 6.0)
    return Landscape(terrain, trees=(trees,), plants=(undergrowth(site, 0.8, 0.35, 0.2, 12.0),))


@kind(height=2.0, slope=0.15)
def boulders(site: Site) -> Landscape:
    """A slope with boulders of 1 to 5 m; they are ground."""
    count = 150
    places = site.random.uniform(-site.half, site.half, (count, 2))
    radius = site.random.gamma(3.0, 0.35, count) * site.settings.height / 2 + 0.4
    rough, roll = waves(site.random, 0.15, 5.0), waves(site.random, 2.0, 80.0)

    def terrain(x, y):
        z = 700.0 + site.settings.slope * site.axes(x, y)[0] + roll(x, y) + rough(x, y)
        top = np.full(np.shape(x), -np.inf)
        for (a, b), size in zip(places, radius):
            near = np.flatnonzero((np.abs(x - a) < size) & (np.abs(y - b) < size))
            squared = size**2 - (x[near] - a) ** 2 - (y[near] - b) ** 2
            top[near] = np.maximum(top[near], 0.8 * np.sqrt(np.maximum(squared, 0.0)))
        return z + np.maximum(top, 0.0)

    def flat(x, y):
        shape = np.shape(x)
        return terrain(np.ravel(x), np.ravel(y)).reshape(shape)

    return Landscape(flat, trees=(single_trees(site, 80, 10.0),), plants=(meadow(site),))


@kind(height=0.9)
def field_banks(site: Site) -> Landscape:
    """Meadows between earth banks 0.5 to 1.3 m high, bent as the borders of fields are."""
    apart, bend = site.between(25.0, 40.0), waves(site.random, 3.0, 90.0)
    tall = waves(site.random, 0.3, 60.0)
    roll, rough = waves(site.random, 1.5, 90.0), waves(site.random, 0.04, 4.0)

    def terrain(x, y):
        height = site.settings.height * np.clip(1.0 + tall(x, y), 0.55, 1.45)
        off = np.abs(np.mod(site.axes(x, y)[1] + bend(x, y), apart) - apart / 2)
        ridge = height * 0.5 * (1.0 + np.cos(np.pi * np.clip(off / (1.8 * height), 0.0, 1.0)))
        return 90.0 + site.settings.slope * x + roll(x, y) + rough(x, y) + ridge

    return Landscape(
        terrain, trees=(single_trees(site, 40, 8.0),),
        plants=(meadow(site), undergrowth(site, 0.8, 0.4, 0.05)),
    )  # fmt: skip


def _terraced(site: Site, width: float, face: float, wild: float, vines: float) -> Landscape:
    """Return stairs of bent terraces, with a row of vines of a height on each tread."""
    bend, rough = waves(site.random, wild, 90.0), waves(site.random, 0.05, 4.0)
    phase = site.between(0.0, width)

    def climb(x, y):
        return site.axes(x, y)[1] + phase + bend(x, y)

    def terrain(x, y):
        stairs = steps(climb(x, y), width, site.settings.height, face)
        return 300.0 + stairs + 0.01 * site.axes(x, y)[0] + rough(x, y)

    def rows(x, y):
        return vines * (np.abs(np.mod(climb(x, y), width) - 0.45 * width) < 0.3)

    plants = undergrowth(site, 0.7, 0.35, 0.15), Plants(rows, 0.8 if vines else 0.0)
    return Landscape(terrain, trees=(single_trees(site, 25, 6.0),), plants=plants)


@kind(height=4.0)
def terraces(site: Site) -> Landscape:
    """Terraces 4 m high and 15 m wide, with walls or steep banks."""
    width = 15.0 * site.between(0.9, 1.1)
    return _terraced(site, width, site.between(0.3, 1.2), 5.0, 0.0)


@kind(height=2.0, density=6.0)
def vineyard_terraces(site: Site) -> Landscape:
    """Terraces 2 m high and 5 m wide with a row of vines on each."""
    width = 5.0 * site.between(0.9, 1.15)
    return _terraced(site, width, site.between(0.25, 0.6), 4.0, 1.3)


@kind(height=1.2)
def paddy_fields(site: Site) -> Landscape:
    """Level paddy fields of irregular shape, small bunds, steps of a metre between them."""
    bend, width = waves(site.random, 12.0, 80.0), site.between(12.0, 20.0)
    rough = waves(site.random, 0.02, 4.0)
    phase = site.between(0.0, 20.0)

    def terrain(x, y):
        climb = site.axes(x, y)[1] + phase + bend(x, y)
        z = steps(climb, width, site.settings.height, 0.5)
        edge = np.mod(climb, width)
        bund = 0.35 * ((edge > 0.0) & (edge < 0.6))
        return 60.0 + z + bund + rough(x, y)

    def wet(x, y):
        climb = site.axes(x, y)[1] + phase + bend(x, y)
        number = np.floor(climb / width)
        edge = np.mod(climb, width)
        return (np.mod(number, 4) == 1) & (edge > 1.0) & (edge < width - 1.5)

    trees = single_trees(site, 40, 7.0, wet)
    crops = undergrowth(site, 0.6, 0.3, 0.15)
    return Landscape(terrain, trees=(trees,), plants=(crops,), water=wet)


@kind(height=15.0, slope=1.0, penetration=0.12)
def steep_forest(site: Site) -> Landscape:
    """A valley whose sides rise at 45 degrees under dense forest."""
    bend, rough = waves(site.random, 8.0, 110.0), waves(site.random, 0.3, 7.0)

    def terrain(x, y):
        along, across = site.axes(x, y)
        out = np.sqrt((across + bend(x, y)) ** 2 + 36.0)
        return 600.0 + site.settings.slope * out + 0.05 * along + rough(x, y)

    trees = wood(site, 5.5, site.settings.height, conifer=False)
    return Landscape(terrain, trees=(trees,), plants=(undergrowth(site, 1.2, 0.35, 0.3),))


KINDS: tuple[Kind, ...] = (
    hills, quarry, open_cast, sea_cliff, gorge, sharp_ridge, mesa, dunes, boulders, field_banks,
    terraces, vineyard_terraces, paddy_fields, steep_forest,
)  # fmt: skip
