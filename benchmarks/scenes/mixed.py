"""The land of `make demo`: a stream, a steep bank, a road, houses, a large building and a wood."""

from __future__ import annotations

import numpy as np

from .classes import OTHER
from .landscape import FLAT, GABLE, VAULT, Box, Boxes, Deck, Landscape, Trees
from .planting import undergrowth
from .relief import bank, blend, smooth, waves
from .scene import Kind, Site, kind

# Metres from the west and the south of the square.
SIDE = 300.0
_ROAD_NORTHING = 90.0
_BANK_HEIGHT, _BANK_WIDTH = 7.0, 8.0
_WATER_HALF_WIDTH, _CHANNEL_HALF_WIDTH, _CHANNEL_DEPTH = 3.0, 7.0, 2.8
# The large building stands on a levelled yard; its roof is what the filter's window has to span.
_YARD = (172.0, 196.0, 92.0, 92.0)


def _stream_easting(y: np.ndarray) -> np.ndarray:
    return 48.0 + 14.0 * np.sin(y / 40.0 + 0.8)


def _road_height(x: np.ndarray) -> np.ndarray:
    return np.interp(x, (0.0, 35.0, 85.0, 160.0, SIDE), (117.6, 118.2, 118.4, 127.0, 129.0))


def _terrain(roll, rough):
    """Return the bare earth, with hills and roughness of a seed."""

    def terrain(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        z = 118.0 + 0.02 * x + roll(x, y) + rough(x, y)
        z = z + 5.0 * np.exp(-(((x - 265.0) / 30.0) ** 2) - ((y - 235.0) / 40.0) ** 2)
        # The steep bank: 7 m in 8 m, with sharp edges.
        edge = 100.0 + 10.0 * np.sin(y / 42.0) + _BANK_WIDTH / 2
        z = z + _BANK_HEIGHT * bank(x - edge, _BANK_WIDTH)
        # The valley floor is smooth, so that water does not run uphill.
        from_stream = np.abs(x - _stream_easting(y))
        z = blend(z, 117.0 - 0.006 * y, smooth((34.0 - from_stream) / 22.0))
        z = blend(z, _road_height(x), smooth((11.0 - np.abs(y - _ROAD_NORTHING)) / 7.0))
        east, north, length, width = _YARD
        outside = np.hypot(
            np.maximum(np.abs(x - east) - length / 2, 0.0),
            np.maximum(np.abs(y - north) - width / 2, 0.0),
        )
        z = blend(z, 127.5 + 0.01 * (y - north), smooth((10.0 - outside) / 10.0))
        slope = _CHANNEL_HALF_WIDTH - _WATER_HALF_WIDTH
        return z - _CHANNEL_DEPTH * np.clip((_CHANNEL_HALF_WIDTH - from_stream) / slope, 0.0, 1.0)

    return terrain


def _solids(random: np.random.Generator, terrain) -> tuple[list[Box], list[Box]]:
    """Return buildings, the large one first, and cars."""
    east, north, *_ = _YARD

    def stand(x: float, y: float, length: float, width: float, turn: float, *rest: float) -> Box:
        return Box(x, y, length, width, turn, float(terrain(np.array(x), np.array(y))), *rest)

    buildings = [stand(east, north + 10.0, 64.0, 46.0, 0.0, 9.0, FLAT)]
    for x in np.arange(130.0, 290.0, 26.0):
        for y, angle in ((_ROAD_NORTHING - 24.0, 0.1), (_ROAD_NORTHING + 24.0, 0.0)):
            place = x + random.uniform(-3, 3), y + random.uniform(-3, 3)
            sides = random.uniform(11, 16), random.uniform(8, 10)
            turn = angle + random.choice((0.0, np.pi / 2))
            buildings.append(stand(*place, *sides, turn, random.uniform(2.8, 5.5), GABLE, 0.84))
    buildings.append(stand(75.0, 250.0, 22.0, 14.0, 0.6, 5.5, GABLE, 0.84))  # a barn
    cars = []
    for x in np.arange(east - 36.0, east + 36.0, 3.0):
        for y in (north - 28.0, north - 36.0):
            if random.random() < 0.5:
                turn = np.pi / 2 + random.normal(0, 0.04)
                cars.append(
                    stand(x, y, 4.4, 1.8, turn, random.uniform(1.3, 1.8), VAULT, 0.1, OTHER)
                )
    return buildings, cars


def _trees(random: np.random.Generator, buildings: list[Box]) -> tuple[Trees, Trees]:
    """Return the leafy trees and the conifers: a wood, trees along the stream and single ones."""
    wood = np.column_stack([random.uniform(232, 300, 330), random.uniform(135, 300, 330)])
    along = random.uniform(0, SIDE, 45)
    side = random.choice((-1.0, 1.0), 45) * random.uniform(9, 14, 45)
    row = np.column_stack([_stream_easting(along) + side, along])
    place = np.vstack([wood, row, random.uniform(8, SIDE - 8, (70, 2))])
    clear = np.abs(place[:, 1] - _ROAD_NORTHING) > 8.0
    for box in buildings:
        reach = np.hypot(box.length, box.width) / 2 + 1.5
        clear &= np.hypot(*(place - (box.x, box.y)).T) > reach
    place = place[clear]
    conifer = (place[:, 0] > 232) & (place[:, 1] > 215)
    height = random.uniform(7, 17, len(place)) + 5.0 * conifer
    radius = np.where(conifer, 0.14, 0.26) * height * random.uniform(0.8, 1.2, len(place))
    stem = height * np.where(conifer, 0.12, random.uniform(0.2, 0.35, len(place)))
    x, y = place.T - SIDE / 2
    return tuple(
        Trees(*(column[which] for column in (x, y, height, radius, stem)), is_conifer)
        for which, is_conifer in ((~conifer, False), (conifer, True))
    )


@kind(size=SIDE, density=4.0)
def mixed_land(site: Site) -> Landscape:
    """A stream, a steep bank, a road on a bridge, houses, a building of 64 x 46 m and a wood."""
    random, middle = site.random, SIDE / 2
    roll, rough = waves(random, 1.6, 230.0), waves(random, 0.06, 22.0)
    ground = _terrain(roll, rough)
    buildings, cars = _solids(random, ground)
    groups = tuple(
        Boxes([box._replace(x=box.x - middle, y=box.y - middle) for box in boxes])
        for boxes in (buildings, cars)
        if boxes
    )
    stream = float(_stream_easting(np.array(_ROAD_NORTHING)))

    def from_stream(x, y):
        return np.abs(x + middle - _stream_easting(y + middle))

    # The deck hangs over the channel where the road would be; its ends are the road itself.
    deck = Deck(
        stream - middle, _ROAD_NORTHING - middle, 0.0, 2 * _CHANNEL_HALF_WIDTH + 1.0, 8.0,
        lambda along, across: _road_height(along + stream),
    )  # fmt: skip
    birds = random.uniform(-middle, middle, (2, 15))
    return Landscape(
        lambda x, y: ground(x + middle, y + middle),
        groups,
        (deck,),
        trees=_trees(random, buildings),
        plants=(undergrowth(site, 1.4, 0.6, 0.12, 20.0),),
        water=lambda x, y: from_stream(x, y) < _WATER_HALF_WIDTH,
        stray=tuple(zip(*birds, random.uniform(165.0, 220.0, 15))),
    )


KINDS: tuple[Kind, ...] = (mixed_land,)
