"""Kinds of land with large buildings, or with many."""

from __future__ import annotations

import numpy as np

from .classes import OTHER
from .landscape import FLAT, GABLE, SHED, VAULT, Box, Boxes, Landscape, Surface
from .planting import meadow, single_trees, undergrowth
from .relief import bank, blend, smooth, steps, waves, yard
from .scene import Kind, Site, kind


def _at(surface: Surface, x: float, y: float) -> float:
    return float(surface(np.array([x]), np.array([y]))[0])


def _plain(site: Site, roll: float = 0.3) -> Surface:
    """Return a slope along the site's axis, rolling a little."""
    shape, rough = waves(site.random, roll, 90.0), waves(site.random, 0.03, 5.0)
    slope = site.settings.slope
    return lambda x, y: 120.0 + slope * site.axes(x, y)[0] + shape(x, y) + rough(x, y)


def _cars(site: Site, terrain: Surface, along: float, across: float, count: int = 40) -> Boxes:
    """Return cars parked in two rows."""
    cars = []
    for row in (0.0, 12.0):
        for number in range(count // 2):
            if site.random.random() < 0.6:
                x, y = site.place(along + 2.8 * number, across + row)
                base, tall = _at(terrain, x, y), site.between(1.4, 2.0)
                turn = site.angle + np.pi / 2
                cars.append(Box(x, y, 4.5, 1.9, turn, base, tall, VAULT, 0.1, OTHER))
    return Boxes(cars)


def _hall(site: Site, terrain: Surface, court: float = 0.0, scale: float = 1.0) -> Landscape:
    """Return a hall of about 120 x 80 m, not parallel with the slope, with cars beside it."""
    east, north = site.random.uniform(-15.0, 15.0, 2)
    length, width = 120.0 * scale * site.between(0.9, 1.1), 80.0 * scale * site.between(0.9, 1.1)
    turn = site.angle + site.between(-0.5, 0.5)
    base = _at(terrain, east, north)
    hall = Box(east, north, length, width, turn, base, site.settings.height, FLAT, court=court)
    cars = _cars(site, terrain, -50.0, site.half - 32.0)
    clear = max(length, width) * 0.62

    def near(x, y):
        return np.hypot(x - east, y - north) < clear

    trees = single_trees(site, 40, 9.0, near)
    return Landscape(terrain, (Boxes([hall]), cars), trees=(trees,), plants=(meadow(site),))


@kind(size=260.0, height=9.0, density=3.0)
def hall_flat(site: Site) -> Landscape:
    """A hall of 120 x 80 m on flat land."""
    return _hall(site, _plain(site))


@kind(size=260.0, height=9.0, density=3.0, slope=0.05)
def hall_slope_5(site: Site) -> Landscape:
    """A hall of 120 x 80 m on a slope of 5 %: on its upper side it stands 6 m lower."""
    return _hall(site, _plain(site))


@kind(size=260.0, height=10.0, density=3.0, slope=0.1)
def hall_slope_10(site: Site) -> Landscape:
    """A hall of 120 x 80 m on a slope of 10 %: on its upper side it stands 4 m high at most."""
    return _hall(site, _plain(site))


@kind(size=260.0, height=10.0, density=3.0)
def hall_stepped(site: Site) -> Landscape:
    """A hall on stepped ground: two levels 3 to 4 m apart, the edge of which runs below it."""
    plain, step, shift = _plain(site), site.between(3.0, 4.0), site.between(-15.0, 15.0)
    run = site.between(0.4, 4.0)

    def terrain(x, y):
        return plain(x, y) + step * (bank(site.axes(x, y)[0] - shift, run) - 0.5)

    return _hall(site, terrain)


@kind(size=260.0, height=12.0, density=3.0, slope=0.03)
def hall_courtyard(site: Site) -> Landscape:
    """A building of 120 x 80 m round a courtyard, on a slope of 3 %."""
    return _hall(site, _plain(site), court=site.between(0.35, 0.55))


@kind(size=280.0, height=6.0, density=3.0, slope=0.05)
def complex_on_slope(site: Site) -> Landscape:
    """A complex of 1 to 2 ha on a slope: halls wall to wall, 5 to 9 m high, on a levelled yard."""
    natural = _plain(site, 0.8)
    level = _at(natural, 0.0, 0.0)
    length, width = site.between(150.0, 175.0), site.between(105.0, 135.0)
    is_levelled = site.random.random() < 0.5

    def terrain(x, y):
        along, across = site.axes(x, y)
        inside = np.minimum(length / 2 + 10 - np.abs(along), width / 2 + 10 - np.abs(across))
        return yard(natural(x, y), level, inside, 8.0) if is_levelled else natural(x, y)

    halls, position = [], -length / 2
    while position < length / 2 - 15.0:
        part = min(site.between(30.0, 60.0), length / 2 - position)
        wide = width * site.between(0.7, 1.0)
        x, y = site.place(position + part / 2, (width - wide) / 2 * site.random.choice((-1.0, 1.0)))
        tall = site.settings.height * site.between(0.85, 1.5)
        roof, pitch = (FLAT, 0.0) if site.random.random() < 0.6 else (GABLE, 0.08)
        halls.append(Box(x, y, part, wide, site.angle, level, tall, roof, pitch))
        position += part
    cars = _cars(site, terrain, -40.0, site.half - 30.0)
    return Landscape(terrain, (Boxes(halls), cars), plants=(meadow(site),))


def _houses(
    site: Site, terrain: Surface, apart: float, share: float, tall: float = 4.0
) -> tuple[Boxes, ...]:
    """Return houses along streets, with wings, sheds and cars."""
    houses, wings, sheds = [], [], []
    side = np.arange(-site.half + 12.0, site.half - 10.0, apart)
    for along in side:
        for across in side:
            if site.random.random() > share:
                continue
            u, v = along + site.between(-2, 2), across + site.between(-2, 2)
            x, y = site.place(u, v)
            if max(abs(x), abs(y)) > site.half - 8.0:
                continue
            length, width = site.between(9.0, 14.0), site.between(7.0, 10.0)
            turn = site.angle + site.between(-0.15, 0.15) + site.random.choice((0.0, np.pi / 2))
            base, eaves = _at(terrain, x, y), tall * site.between(0.7, 1.5)
            houses.append(
                Box(x, y, length, width, turn, base, eaves, GABLE, site.between(0.4, 0.9))
            )
            if site.random.random() < 0.4:
                wing = x + 5 * np.cos(turn + 1.57), y + 5 * np.sin(turn + 1.57)
                wings.append(Box(*wing, 5.0, 6.0, turn, base, 2.8, FLAT))
            if site.random.random() < 0.6:
                x, y = (
                    x + site.between(8, 10) * site.random.choice((-1, 1)),
                    y + site.between(-8, 8),
                )
                base = _at(terrain, x, y)
                sheds.append(Box(x, y, 4.0, 3.0, turn, base, site.between(2.0, 2.6), SHED, 0.15))
    return tuple(Boxes(group) for group in (houses, wings, sheds) if group)


@kind(slope=0.3, height=4.0)
def hillside_village(site: Site) -> Landscape:
    """A village on a slope of 30 %: houses whose roofs begin at the level of the upper garden."""
    plain, rough = _plain(site, 3.0), waves(site.random, 0.1, 6.0)

    def terrain(x, y):
        return plain(x, y) + rough(x, y)

    return Landscape(
        terrain, _houses(site, terrain, 22.0, 0.65), trees=(single_trees(site, 80, 7.0),),
        plants=(undergrowth(site, 1.5, 0.6, 0.12, 8.0), meadow(site)),
    )  # fmt: skip


@kind(slope=0.0, height=3.5)
def stepped_city(site: Site) -> Landscape:
    """A city on levels with retaining walls of 3 to 4 m, ramps and stairs between them."""
    width, bend = site.between(26.0, 36.0), waves(site.random, 3.0, 120.0)
    phase, ramps = site.between(0.0, 30.0), site.between(60.0, 90.0)
    rough, tall = waves(site.random, 0.03, 6.0), site.settings.height

    def climb(x, y):
        return site.axes(x, y)[1] + phase + bend(x, y)

    def terrain(x, y):
        along, _ = site.axes(x, y)
        on_ramp = np.abs(np.mod(along, ramps) - ramps / 2) < 3.5
        walls = steps(climb(x, y), width, tall, 0.25)
        return 200.0 + np.where(on_ramp, steps(climb(x, y), width, tall, 22.0), walls) + rough(x, y)

    blocks = []
    for level in np.arange(-6, 7):
        for number in np.arange(-6, 7):
            along, across = ramps / 2 * number + ramps / 4, width * (level + 0.45) - phase
            x, y = site.place(along, across)
            across -= bend(np.array([x]), np.array([y]))[0]
            x, y = site.place(along, across)
            if max(abs(x), abs(y)) < site.half and site.random.random() < 0.75:
                size = site.between(12.0, 0.7 * ramps / 2), site.between(9.0, width * 0.5)
                base, eaves = _at(terrain, x, y), site.between(4.0, 14.0)
                roof, pitch = (FLAT, 0.0) if site.random.random() < 0.5 else (GABLE, 0.5)
                blocks.append(Box(x, y, *size, site.angle, base, eaves, roof, pitch))
    return Landscape(terrain, (Boxes(blocks),), trees=(single_trees(site, 40, 6.0),))


@kind(height=9.0, slope=0.02)
def car_park(site: Site) -> Landscape:
    """A multi-storey car park of 70 x 45 m whose ramp joins its roof with the street."""
    terrain = _plain(site)
    length, width, tall = site.between(60, 80), site.between(38, 50), site.settings.height
    base = _at(terrain, 0.0, 0.0)
    park = Box(0.0, 0.0, length, width, site.angle, base, tall, SHED, 0.0)
    run = tall / site.between(0.13, 0.16)
    x, y = site.place(-length / 2 - run / 2, -width / 4)
    # A box whose roof slopes across itself: its width lies along the ramp.
    foot = _at(terrain, *site.place(-length / 2 - run, -width / 4))
    pitch = (base + tall - foot) / run
    ramp = Box(x, y, 6.5, run, site.angle - np.pi / 2, foot, (base + tall - foot) / 2, SHED, pitch)
    on_top = []
    for _ in range(45):
        u, v = (
            site.between(-length / 2 + 4, length / 2 - 4),
            site.between(-width / 2 + 4, width / 2 - 4),
        )
        on_top.append(Box(*site.place(u, v), 4.5, 1.9, site.angle, base + tall, 1.5, VAULT, 0.1))
    houses = Boxes([
        Box(*site.place(a, b), 25.0, 14.0, site.angle, _at(terrain, *site.place(a, b)),
            site.between(7, 15))
        for a, b in ((-40.0, 62.0), (5.0, 65.0), (50.0, 60.0), (20.0, -65.0))
    ])  # fmt: skip
    groups = (Boxes([park]), Boxes([ramp]), Boxes(on_top), houses)
    return Landscape(terrain, groups, trees=(single_trees(site, 25, 8.0),), plants=(meadow(site),))


@kind(size=240.0, height=16.0)
def city_blocks(site: Site) -> Landscape:
    """Blocks of closed buildings round courtyards, towers, cars in the streets."""
    terrain, pitch = _plain(site, 0.6), site.between(55.0, 70.0)
    blocks, towers, groups = [], [], []
    for along in np.arange(-pitch * 3, pitch * 3.5, pitch):
        for across in np.arange(-pitch * 3, pitch * 3.5, pitch):
            x, y = site.place(along, across)
            if max(abs(x), abs(y)) > site.half + 5.0:
                continue
            base, tall = _at(terrain, x, y), site.settings.height * site.between(0.6, 1.3)
            side, court = pitch - site.between(12.0, 18.0), site.between(0.4, 0.7)
            blocks.append(Box(x, y, side, side * 0.95, site.angle, base, tall, FLAT, court=court))
            if site.random.random() < 0.3:
                towers.append(Box(x, y, 12.0, 12.0, site.angle, base, 3 * tall, FLAT))
            groups.append(_cars(site, terrain, along - side / 2, across + pitch / 2 - 6.0, 26))
    layers = (Boxes(blocks), *([Boxes(towers)] if towers else []), *groups[:6])
    return Landscape(terrain, layers, trees=(single_trees(site, 60, 8.0),))


@kind(height=4.0)
def plaza(site: Site) -> Landscape:
    """A plaza raised by 3 to 5 m behind walls, with ramps and stairs, buildings round it."""
    plain = _plain(site)
    length, width = site.between(60.0, 90.0), site.between(45.0, 60.0)
    ramp, tall = site.between(20.0, 35.0), site.settings.height * site.between(0.8, 1.2)

    def terrain(x, y):
        along, across = site.axes(x, y)
        wall = bank(np.minimum(length / 2 - np.abs(along), width / 2 - np.abs(across)), 0.25)
        up = np.clip((length / 2 + ramp - along) / ramp, 0.0, 1.0)
        stairs = np.clip((width / 2 + 8.0 - across) / 8.0, 0.0, 1.0)
        ways = np.where((np.abs(across) < 5.0) & (along > 0), up, 0.0)
        ways = np.where((np.abs(along + 10.0) < 8.0) & (across > 0), stairs, ways)
        return plain(x, y) + tall * np.maximum(wall, ways)

    houses = []
    for side in (-1.0, 1.0):
        for number in range(-2, 3):
            x, y = site.place(36.0 * number + site.between(-3, 3), side * (width / 2 + 30.0))
            sides, eaves = (site.between(20, 28), site.between(10, 14)), site.between(8, 18)
            houses.append(Box(x, y, *sides, site.angle, _at(plain, x, y), eaves, FLAT))
    return Landscape(terrain, (Boxes(houses),), trees=(single_trees(site, 25, 6.0),))


@kind(height=4.5, density=5.0, slope=0.02)
def greenhouses(site: Site) -> Landscape:
    """Rows of greenhouses with vaulted roofs, some wall to wall over 60 x 60 m."""
    terrain, span = _plain(site), site.between(8.0, 10.0)
    base, houses = _at(terrain, 0.0, 0.0), []
    for number in range(int(site.between(5, 8))):  # wall to wall
        x, y = site.place(-40.0, -20.0 + span * number)
        sides = site.between(62.0, 62.5), span
        houses.append(Box(x, y, *sides, site.angle, base, site.settings.height, VAULT, 1.5))
    for number in range(6):  # tunnels on their own
        x, y = site.place(45.0, -45.0 + 14.0 * number)
        houses.append(Box(x, y, 45.0, 7.0, site.angle, _at(terrain, x, y), 0.8, VAULT, 2.4))
    crops = undergrowth(site, 0.6, 0.4, 0.3, 40.0)
    return Landscape(terrain, (Boxes(houses),), plants=(crops,), trees=(single_trees(site, 20),))


def _village(site: Site) -> Landscape:
    roll = waves(site.random, 2.0, 120.0)
    plain, street = _plain(site, 0.5), site.between(-20.0, 20.0)

    def terrain(x, y):
        z = plain(x, y) + roll(x, y)
        sunk = smooth((5.0 - np.abs(site.axes(x, y)[1] - street)) / 2.0)
        return blend(z, z - 0.3, sunk)

    return Landscape(
        terrain, _houses(site, terrain, 24.0, 0.6, site.settings.height),
        trees=(single_trees(site, 80, 9.0),),
        plants=(meadow(site), undergrowth(site, 1.8, 0.7, 0.08, 7.0)),
    )  # fmt: skip


@kind(height=4.0, slope=0.05)
def village(site: Site) -> Landscape:
    """A village with gardens, hedges and trees."""
    return _village(site)


@kind(density=0.1, size=600.0, height=5.0, slope=0.04)
def sparse_village(site: Site) -> Landscape:
    """A village at 0.1 pulses/m2."""
    return _village(site)


@kind(density=100.0, size=60.0, height=4.0, slope=0.05, noise=0.02)
def dense_village(site: Site) -> Landscape:
    """Some houses with gardens at 100 pulses/m2."""
    return _village(site)


KINDS: tuple[Kind, ...] = (
    hall_flat, hall_slope_5, hall_slope_10, hall_stepped, hall_courtyard, complex_on_slope,
    hillside_village, stepped_city, car_park, city_blocks, plaza, greenhouses, village,
    sparse_village, dense_village,
)  # fmt: skip
