"""Kinds of sites where earth is moved: heaps, banks and roads stay, machines and containers go."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .classes import BUILDING, OTHER
from .landscape import FLAT, GABLE, Box, Boxes, Landscape, Surface
from .planting import single_trees, undergrowth
from .relief import bank, smooth, steps, waves
from .scene import Kind, Site, kind

# Numbers of the landforms, as `Landscape.landform` returns them.
STOCKPILE, BERM, ROAD, FACE = 1, 2, 3, 4
LANDFORMS = {STOCKPILE: "stockpiles", BERM: "berms", ROAD: "haul roads", FACE: "faces"}
# Sides of the largest object, and of those of which there are many, in metres: length, width and
# height.
_HALL = (22.0, 13.0, 6.0)
_CONTAINERS = ((6.06, 2.44, 2.6), (12.19, 2.44, 2.6))
_CABIN, _DUMPER, _CAR = (6.0, 2.5, 2.8), (9.0, 3.6, 3.6), (4.5, 1.9, 1.5)
_UNDERCARRIAGE, _BOOM = (5.0, 3.0, 3.0), (5.5, 0.9, 3.4)
_PERSON, _PALLET = (0.5, 0.5, 1.75), (1.2, 1.2, 1.0)


def _heaps(site: Site, count: int) -> Surface:
    """Return heights of heaps of 2 to 12 m, some flat on top; those of the upper part are long."""
    places = [
        site.place(along, across)
        for along in np.linspace(-0.72, 0.72, count) * site.half
        for across in (site.half * site.between(0.34, 0.56),)
    ]
    tall = np.clip(site.random.gamma(3.0, 1.8, count), 2.0, 12.0)
    flank = np.tan(np.radians(site.random.uniform(33.0, 38.0, count)))
    top = np.where(site.random.random(count) < 0.5, site.random.uniform(2.0, 6.0, count), 0.0)
    half = site.random.uniform(0.0, 6.0, count)

    def height(x, y):
        total = np.zeros(np.shape(x))
        for number, (east, north) in enumerate(places):
            along, across = site.axes(x - east, y - north)
            out = np.hypot(np.maximum(np.abs(across) - half[number], 0.0), along)
            cone = tall[number] - flank[number] * np.maximum(out - top[number], 0.0)
            total = np.maximum(total, np.maximum(cone, 0.0))
        return total

    return height


def _box(
    terrain: Surface, place: tuple[float, float], sides: tuple[float, float, float],
    turn: float, code: int = OTHER, roof: int = FLAT,
) -> Box:  # fmt: skip
    base = float(terrain(np.array([place[0]]), np.array([place[1]]))[0])
    pitch = 0.1 if roof == GABLE else 0.0
    return Box(*place, sides[0], sides[1], turn, base, sides[2], roof, pitch, code)


def _machine(site: Site, terrain: Surface, along: float, across: float) -> list[Box]:
    """Return an excavator with its boom, or a dumper."""
    place, turn = site.place(along, across), site.between(0.0, np.pi)
    if site.random.random() < 0.5:
        return [_box(terrain, place, _DUMPER, turn)]
    x, y = place
    ahead = (_UNDERCARRIAGE[0] + _BOOM[0]) / 2
    boom = x + ahead * np.cos(turn), y + ahead * np.sin(turn)
    under, arm = (_box(terrain, place, sides, turn) for sides in (_UNDERCARRIAGE, _BOOM))
    return [under, arm._replace(x=boom[0], y=boom[1])]


def _plant(site: Site, terrain: Surface) -> tuple[Boxes, ...]:
    """Return what stands on the site: containers, cabins, a hall, machines, cars, people."""
    half, code = site.half, BUILDING
    yard = -0.62 * half
    boxes = [_box(terrain, site.place(-0.5 * half, yard), _HALL, site.angle, code, GABLE)]
    along = -0.22 * half
    for _ in range(8):  # a row of containers, of which some stand two or three high
        sides = _CONTAINERS[int(site.random.random() < 0.4)]
        high = int(site.random.choice((1, 1, 2, 3)))
        sides = sides[0], sides[1], sides[2] * high
        place = site.place(along, yard + site.between(-1.0, 1.0))
        boxes.append(_box(terrain, place, sides, site.angle + np.pi / 2, code))
        along += sides[1] + float(site.random.choice((0.1, 0.3, 1.5, 4.0)))
    along += 5.0
    for _ in range(3):
        high = _CABIN[2] * int(site.random.choice((1, 2)))
        place = site.place(along, yard + 3.0)
        boxes.append(_box(terrain, place, (*_CABIN[:2], high), site.angle, code))
        along += _CABIN[0] + 0.4
    for number in range(7):
        place = site.place(-0.7 * half + 2.8 * number, yard + 14.0)
        boxes.append(_box(terrain, place, _CAR, site.angle + np.pi / 2))
    machines = []
    for place in np.linspace(-0.75, 0.75, 6) * half:  # on the haul road
        machines += _machine(site, terrain, place, site.between(-3.0, 3.0))
    for place in np.linspace(-0.64, 0.64, 4) * half:  # beside the heaps, or on their flanks
        off = site.between(-3, 3), site.between(0.15, 0.3) * half
        machines += _machine(site, terrain, place + off[0], off[1])
    small = []
    for sides, count in ((_PERSON, 12), (_PALLET, 16)):
        for _ in range(count):
            place = site.place(site.between(-0.9, 0.9) * half, site.between(-0.42, -0.15) * half)
            small.append(_box(terrain, place, sides, site.between(0.0, np.pi)))
    return tuple(Boxes(group) for group in (boxes, machines, small))


def _earthworks(site: Site) -> Landscape:
    """Return a site between a face with benches and a yard, with a haul road and heaps."""
    rough, roll = waves(site.random, 0.06, 4.0), waves(site.random, 0.5, 70.0)
    bend = waves(site.random, 1.5, 60.0)
    heaps, tall = _heaps(site, 5), site.between(0.6, 1.8)
    face, rise = site.half * site.between(0.72, 0.8), site.settings.height * site.between(0.8, 1.3)
    pit, depth = site.half * site.between(0.1, 0.4), site.between(2.0, 3.5)
    road, foot, flank = site.between(5.0, 7.0), 0.3, np.tan(np.radians(36.0))

    def off_road(x, y):
        return np.abs(site.axes(x, y)[1] + 0.3 * bend(x, y))

    def berm(x, y):
        """A bank on both sides of the road, with gaps through which machines drive."""
        along = site.axes(x, y)[0]
        middle = road + foot + tall / flank
        ridge = tall - flank * np.maximum(np.abs(off_road(x, y) - middle) - foot, 0.0)
        gaps = smooth((np.abs(np.mod(along + 9.0, 34.0) - 17.0) - 5.0) / 2.0)
        return np.maximum(ridge, 0.0) * gaps

    def benches(x, y):
        inward = site.axes(x, y)[1] - face + bend(x, y)
        return np.clip(steps(inward + 14.0, 14.0, rise, 1.8), 0.0, 3.0 * rise)

    def dug(x, y):
        along, across = site.axes(x, y)
        inside = np.minimum(14.0 - np.abs(along - pit), 6.0 - np.abs(across + 0.32 * site.half))
        return depth * bank(inside, depth * 0.8)

    def terrain(x, y):
        along, _ = site.axes(x, y)
        land = 210.0 + site.settings.slope * along + roll(x, y) + benches(x, y) - dug(x, y)
        return land + np.maximum(heaps(x, y), berm(x, y)) + rough(x, y)

    def landform(x, y):
        east = benches(x + 1, y) - benches(x - 1, y)
        north = benches(x, y + 1) - benches(x, y - 1)
        step = np.hypot(east, north)
        forms = [heaps(x, y) > 0.3, berm(x, y) > 0.2, off_road(x, y) < road, step > 1.0]
        return np.select(forms, [STOCKPILE, BERM, ROAD, FACE], 0)

    def built(x, y):
        return site.axes(x, y)[1] < 0.8 * site.half

    return Landscape(
        terrain, _plant(site, terrain), trees=(single_trees(site, 60, 8.0, built),),
        plants=(undergrowth(site, 0.9, 0.5, 0.06),), landform=landform,
    )  # fmt: skip


@kind(size=110.0, density=40.0, noise=0.03, slope=0.03, height=5.0, low_outliers=2e-5)
def earthworks(site: Site) -> Landscape:
    """A site of heaps, a haul road with berms, benches, a pit, machines and containers; laser."""
    return _earthworks(site)


@kind(
    size=110.0, density=60.0, noise=0.05, slope=0.03, height=5.0, low_outliers=4e-4,
    photogrammetric=True, blur=0.25, low_tail=0.01,
)  # fmt: skip
def earthworks_images(site: Site) -> Landscape:
    """The same from images: rounded edges, a foot round each object, low points, holes."""
    land = _earthworks(site)
    field = waves(site.random, 1.0, 9.0)
    return replace(land, missing=lambda x, y: field(x, y) > 1.9)


KINDS: tuple[Kind, ...] = (earthworks, earthworks_images)
