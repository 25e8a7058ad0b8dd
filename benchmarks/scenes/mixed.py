"""The landscape of the demo: terrain and solid things as functions of the place, and its trees."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

SIDE = 300.0
GROUND, BUILDING, WATER, BRIDGE, OTHER = 2, 6, 9, 17, 1

_ROAD_NORTHING = 90.0
_BANK_HEIGHT, _BANK_WIDTH = 7.0, 8.0
_WATER_HALF_WIDTH, _CHANNEL_HALF_WIDTH, _CHANNEL_DEPTH = 3.0, 7.0, 2.8
# The large building stands on a levelled yard; its roof is what the filter's window has to span.
_YARD = (172.0, 196.0, 92.0, 92.0)


@dataclass(frozen=True)
class Solid:
    """A house, a building or a car: a rectangle with a roof over it.

    Attributes
    ----------
    x, y : float
        Centre.
    length, width : float
        Sides, along and across its own axis.
    angle : float
        Direction of the axis, in radians from east.
    base : float
        Height of the terrain it stands on.
    eaves : float
        Height of its walls above the base.
    kind : str
        ``flat``, ``gable`` or ``car``.
    """

    x: float
    y: float
    length: float
    width: float
    angle: float
    base: float
    eaves: float
    kind: str

    @property
    def reach(self) -> float:
        """Radius of the circle around it."""
        return float(np.hypot(self.length, self.width)) / 2

    def surface(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the height of its upper side, NaN beside it."""
        along = (x - self.x) * np.cos(self.angle) + (y - self.y) * np.sin(self.angle)
        across = (y - self.y) * np.cos(self.angle) - (x - self.x) * np.sin(self.angle)
        inside = (np.abs(along) <= self.length / 2) & (np.abs(across) <= self.width / 2)
        if self.kind == "gable":  # 40 degrees, with a chimney
            roof = self.eaves + 0.84 * (self.width / 2 - np.abs(across))
            chimney = (np.abs(along - self.length / 4) < 0.4) & (np.abs(across - 0.8) < 0.4)
            roof = np.where(chimney, roof + 1.2, roof)
        elif self.kind == "car":
            roof = np.where(np.abs(along) < 1.2, self.eaves, 0.6 * self.eaves)
        else:  # flat: a parapet, and two machine rooms
            edge = np.minimum(self.length / 2 - np.abs(along), self.width / 2 - np.abs(across))
            rooms = (np.abs(np.abs(along) - self.length / 5) < 4) & (np.abs(across - 4) < 3)
            roof = self.eaves + 0.6 * (edge < 0.4) + 2.6 * rooms
        return np.where(inside, self.base + roof, np.nan)


@dataclass(frozen=True)
class Trees:
    """Crowns, as arrays of equal length: place, top above the ground, radius, share of stem."""

    x: np.ndarray
    y: np.ndarray
    height: np.ndarray
    radius: np.ndarray
    stem: np.ndarray
    conifer: np.ndarray


def stream_easting(y: np.ndarray) -> np.ndarray:
    """Return where the stream runs."""
    return 48.0 + 14.0 * np.sin(y / 40.0 + 0.8)


def terrain(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the height of the bare earth (of the water, in the stream)."""
    z = 118.0 + 0.02 * x + 2.4 * np.sin(x / 38.0) * np.cos(y / 52.0 + 0.5)
    z = z + 1.1 * np.sin(x / 17.0 + 1.0) * np.sin(y / 23.0)
    z = z + 0.12 * np.sin(x / 3.1 + y / 7.0) * np.sin(y / 3.7)
    z = z + 5.0 * np.exp(-(((x - 265.0) / 30.0) ** 2) - ((y - 235.0) / 40.0) ** 2)
    # The steep bank: 7 m in 8 m, with sharp edges.
    bank = 100.0 + 10.0 * np.sin(y / 42.0)
    z = z + _BANK_HEIGHT * np.clip((x - bank) / _BANK_WIDTH, 0.0, 1.0)
    # The valley floor is smooth, so that water does not run uphill.
    from_stream = np.abs(x - stream_easting(y))
    z = _blend(z, 117.0 - 0.006 * y, _step((34.0 - from_stream) / 22.0))
    z = _blend(z, _road_height(x), _step((11.0 - np.abs(y - _ROAD_NORTHING)) / 7.0))
    east, north, length, width = _YARD
    outside = np.hypot(
        np.maximum(np.abs(x - east) - length / 2, 0.0),
        np.maximum(np.abs(y - north) - width / 2, 0.0),
    )
    z = _blend(z, 127.5 + 0.01 * (y - north), _step((10.0 - outside) / 10.0))
    slope = _CHANNEL_HALF_WIDTH - _WATER_HALF_WIDTH
    return z - _CHANNEL_DEPTH * np.clip((_CHANNEL_HALF_WIDTH - from_stream) / slope, 0.0, 1.0)


def solid_surface(
    x: np.ndarray, y: np.ndarray, solids: list[Solid]
) -> tuple[np.ndarray, np.ndarray]:
    """Return the height and the class of what a vertical ray meets that no leaf stops."""
    z = terrain(x, y)
    from_stream = np.abs(x - stream_easting(y))
    kind = np.where(from_stream < _WATER_HALF_WIDTH, WATER, GROUND).astype(np.uint8)
    # The deck hangs over the channel where the road would be; its ends are the road itself.
    deck = (np.abs(y - _ROAD_NORTHING) < 4.0) & (from_stream < _CHANNEL_HALF_WIDTH)
    z, kind = np.where(deck, _road_height(x), z), np.where(deck, BRIDGE, kind)
    for solid in solids:
        near = np.flatnonzero(
            (np.abs(x - solid.x) < solid.reach) & (np.abs(y - solid.y) < solid.reach)
        )
        surface = solid.surface(x[near], y[near])
        higher = near[surface > z[near]]
        z[higher] = surface[surface > z[near]]
        kind[higher] = OTHER if solid.kind == "car" else BUILDING
    return z, kind


def make_solids(random: np.random.Generator) -> list[Solid]:
    """Return the large building, a street of houses and a car park."""
    east, north, *_ = _YARD

    def stand(x: float, y: float, *shape: object) -> Solid:
        *sides, eaves, kind = shape
        return Solid(x, y, *sides, float(terrain(np.array(x), np.array(y))), eaves, kind)

    solids = [stand(east, north + 10.0, 64.0, 46.0, 0.0, 9.0, "flat")]
    for x in np.arange(130.0, 290.0, 26.0):
        for y, angle in ((_ROAD_NORTHING - 24.0, 0.1), (_ROAD_NORTHING + 24.0, 0.0)):
            place = x + random.uniform(-3, 3), y + random.uniform(-3, 3)
            sides = random.uniform(11, 16), random.uniform(8, 10)
            turn = angle + random.choice((0.0, np.pi / 2))
            solids.append(stand(*place, *sides, turn, random.uniform(2.8, 5.5), "gable"))
    solids.append(stand(75.0, 250.0, 22.0, 14.0, 0.6, 5.5, "gable"))  # a barn below the bank
    for x in np.arange(east - 36.0, east + 36.0, 3.0):
        for y in (north - 28.0, north - 36.0):
            if random.random() < 0.5:
                turn = np.pi / 2 + random.normal(0, 0.04)
                solids.append(stand(x, y, 4.4, 1.8, turn, random.uniform(1.4, 1.9), "car"))
    return solids


def make_trees(random: np.random.Generator, solids: list[Solid]) -> Trees:
    """Return a wood in the north-east, trees along the stream and single ones."""
    wood = np.column_stack([random.uniform(232, 300, 330), random.uniform(135, 300, 330)])
    along = random.uniform(0, SIDE, 45)
    side = random.choice((-1.0, 1.0), 45) * random.uniform(9, 14, 45)
    row = np.column_stack([stream_easting(along) + side, along])
    single = random.uniform(8, SIDE - 8, (70, 2))
    place = np.vstack([wood, row, single])
    clear = np.abs(place[:, 1] - _ROAD_NORTHING) > 8.0
    for solid in solids:
        clear &= np.hypot(*(place - (solid.x, solid.y)).T) > solid.reach + 1.5
    place = place[clear]
    conifer = (place[:, 0] > 232) & (place[:, 1] > 215)
    height = random.uniform(7, 17, len(place)) + 5.0 * conifer
    radius = np.where(conifer, 0.14, 0.26) * height * random.uniform(0.8, 1.2, len(place))
    stem = np.where(conifer, 0.12, random.uniform(0.2, 0.35, len(place)))
    return Trees(place[:, 0], place[:, 1], height, radius, stem, conifer)


def _road_height(x: np.ndarray) -> np.ndarray:
    return np.interp(x, (0.0, 35.0, 85.0, 160.0, SIDE), (117.6, 118.2, 118.4, 127.0, 129.0))


def _step(share: np.ndarray) -> np.ndarray:
    """Return a smooth step from 0 to 1."""
    share = np.clip(share, 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)


def _blend(one: np.ndarray, other: np.ndarray, share: np.ndarray) -> np.ndarray:
    return one + (other - one) * share
