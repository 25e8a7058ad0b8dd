"""Kinds of land with roads, railways, dykes, bridges and lines."""

from __future__ import annotations

import numpy as np

from .classes import TOWER
from .landscape import FLAT, Box, Boxes, Deck, Landscape, Wire
from .planting import meadow, single_trees, undergrowth
from .relief import bank, smooth, waves
from .scene import Kind, Site, kind


def _land(site: Site, roll: float = 0.6):
    shape, rough = waves(site.random, roll, 100.0), waves(site.random, 0.04, 6.0)
    slope = site.settings.slope
    return lambda x, y: 80.0 + slope * site.axes(x, y)[0] + shape(x, y) + rough(x, y)


@kind(height=5.0)
def dyke_and_ditch(site: Site) -> Landscape:
    """A narrow dyke of 4 to 6 m and ditches of 1 to 2 m, some with water."""
    plain, bend = _land(site, 0.2), waves(site.random, 6.0, 130.0)
    crown, side = site.between(1.2, 2.5), site.between(1.3, 2.0)
    ditches = site.random.uniform(20.0, 75.0, 3) * site.random.choice((-1.0, 1.0), 3)
    deep = site.random.uniform(1.0, 2.0, 3)
    tall = site.settings.height * site.between(0.8, 1.2)

    def terrain(x, y):
        across = site.axes(x, y)[1] + bend(x, y)
        z = plain(x, y) + np.clip((crown + side * tall - np.abs(across)) / side, 0.0, tall)
        for off, depth in zip(ditches, deep):
            z = z - np.clip((0.5 + depth - np.abs(across - off)), 0.0, depth)
        return z

    def wet(x, y):
        return np.abs(site.axes(x, y)[1] + bend(x, y) - ditches[0]) < 0.5

    return Landscape(
        terrain, trees=(single_trees(site, 15),), water=wet,
        plants=(meadow(site), undergrowth(site, 1.0, 0.5, 0.08)),
    )  # fmt: skip


@kind(height=8.0)
def embankment_and_cutting(site: Site) -> Landscape:
    """A railway that runs from an embankment of 8 m into a cutting as deep."""
    rise, run = site.settings.height, site.between(1.2, 1.8)
    flat, phase = site.between(4.0, 6.0), site.between(-15.0, 15.0)
    rough, roll = waves(site.random, 0.05, 5.0), waves(site.random, 0.8, 90.0)

    def terrain(x, y):
        along, across = site.axes(x, y)
        land = rise * np.tanh((along - phase) / 45.0) + roll(x, y)
        # The slopes of the cutting and of the embankment begin at the track's side.
        reach = np.maximum(np.abs(across) - flat, 0.0) / run
        return 140.0 + np.clip(land, -reach, reach) + rough(x, y)

    def track(x, y):
        return np.abs(site.axes(x, y)[1]) < flat + 1.0

    return Landscape(
        terrain, trees=(single_trees(site, 70, 9.0, track),),
        plants=(undergrowth(site, 1.2, 0.5, 0.2), meadow(site)),
    )  # fmt: skip


def _crossing(
    site: Site, plain, valley_half: float, bed: float, side: float, deck_width: float,
    is_wet: bool, ramp: float = 0.0,
) -> Landscape:  # fmt: skip
    """Return a road along the site's axis that crosses something on a bridge.

    `bed` is how deep what is crossed lies below the land, `ramp` how high the deck lies above the
    land; an embankment leads up to it then.
    """
    skew = site.between(-0.35, 0.35)
    top = _mean(plain, site)
    half = valley_half + side * bed
    # The deck reaches from one abutment to the other.
    length = 2.0 * (half + 1.0) / np.cos(skew)
    foot = half + 1.0

    def terrain(x, y):
        along, across = site.axes(x, y)
        out = np.abs(along * np.cos(skew) + across * np.sin(skew))
        z = plain(x, y) - np.clip((half - out) / max(side, 0.05), 0.0, bed)
        level = top + ramp * np.clip(1.0 - (out - foot) / 75.0, 0.0, 1.0)
        shoulder = np.clip(
            (np.abs(across) - deck_width / 2 - 1.0) / (1.6 * max(ramp, 0.6)), 0.0, 1.0
        )
        share = (1.0 - shoulder) * (out > foot - 1.0)
        return z + (level - z) * share

    def height(along, across):
        return np.full(np.shape(along), top + ramp) + 0.15 * (1 - (2 * along / length) ** 2)

    deck = Deck(0.0, 0.0, site.angle, length, deck_width, height)

    def wet(x, y):
        along, across = site.axes(x, y)
        return np.abs(along * np.cos(skew) + across * np.sin(skew)) < valley_half

    def road(x, y):
        return (np.abs(site.axes(x, y)[1]) < deck_width / 2 + 2.0) | wet(x, y)

    return Landscape(
        terrain, decks=(deck,), trees=(single_trees(site, 60, 9.0, road),),
        plants=(undergrowth(site, 1.0, 0.5, 0.1), meadow(site)), water=wet if is_wet else None,
    )  # fmt: skip


def _mean(plain, site: Site) -> float:
    x, y = site.random.uniform(-site.half, site.half, (2, 500))
    return float(np.mean(plain(x, y)))


@kind(height=5.0)
def bridge_over_river(site: Site) -> Landscape:
    """A road at the level of the land on a bridge over a river 15 to 30 m wide."""
    wide, tall = site.between(7.0, 15.0), site.settings.height * site.between(0.8, 1.2)
    return _crossing(site, _land(site, 0.2), wide, tall, 1.5, site.between(6, 12), True)


@kind(height=6.0)
def bridge_over_road(site: Site) -> Landscape:
    """A road that rises on ramps to a bridge over another."""
    wide = site.between(7.0, 14.0)
    tall = site.settings.height * site.between(0.9, 1.1)
    return _crossing(site, _land(site, 0.2), wide, 0.4, 1.0, site.between(7, 12), False, tall)


@kind(height=6.5)
def bridge_over_railway(site: Site) -> Landscape:
    """A road at the level of the land on a bridge over a railway in a cutting."""
    tall = site.settings.height * site.between(0.9, 1.2)
    wide = site.between(4.5, 8.0)
    return _crossing(
        site, _land(site, 0.2), wide, tall, site.between(0.05, 1.3), site.between(5, 10), False
    )


@kind(height=20.0, size=240.0)
def viaduct(site: Site) -> Landscape:
    """A viaduct of 150 m over a valley, on pillars; trees below it."""
    rough, roll = waves(site.random, 0.08, 6.0), waves(site.random, 0.6, 80.0)
    half, tall = site.between(65.0, 85.0), site.settings.height
    width, curve = site.between(8.0, 13.0), site.between(1.0, 1.6)

    def terrain(x, y):
        along, across = site.axes(x, y)
        share = np.clip(np.abs(along) / half, 0.0, 1.0)
        z = 220.0 - tall * (1.0 - share**curve)
        on_road = (np.abs(across) < width / 2 + 1.0) & (np.abs(along) > half - 1.0)
        return z + np.where(on_road, 0.0, rough(x, y) + roll(x, y) * smooth(share * 2 - 0.2))

    deck = Deck(0.0, 0.0, site.angle, 2 * half, width, lambda u, v: np.full(np.shape(u), 220.0))

    def road(x, y):
        return np.abs(site.axes(x, y)[1]) < width / 2 + 1.0

    def stream(x, y):
        return np.abs(site.axes(x, y)[0]) < 3.0

    return Landscape(
        terrain, decks=(deck,), trees=(single_trees(site, 130, 10.0, road),), water=stream,
        plants=(undergrowth(site, 1.2, 0.5, 0.2),),
    )  # fmt: skip


@kind(height=25.0, slope=0.1, density=6.0)
def power_lines(site: Site) -> Landscape:
    """Power lines on masts over a slope with shrubs and young trees below them."""
    plain, span = _land(site, 4.0), site.between(90.0, 120.0)
    wires, masts, start = [], [], site.between(-60.0, -30.0)
    for number in range(-1, 2):
        ends = []
        for along in (start + span * number, start + span * (number + 1)):
            x, y = site.place(along, 0.0)
            base = float(plain(np.array([x]), np.array([y]))[0])
            ends.append((along, base))
        for off, drop in ((-6.0, 0.0), (0.0, 0.0), (6.0, 0.0), (-4.0, 6.0), (4.0, 6.0)):
            points = [
                (*site.place(along, off), base + site.settings.height - drop)
                for along, base in ends
            ]
            wires.append(Wire(*points, site.between(3.0, 6.0)))
        x, y = site.place(ends[0][0], 0.0)
        masts.append(
            Box(x, y, 2.5, 2.5, site.angle, ends[0][1], site.settings.height, FLAT, 0.0, TOWER)
        )

    def lane(x, y):
        return np.abs(site.axes(x, y)[1]) < 15.0

    return Landscape(
        plain, (Boxes(masts),), wires=tuple(wires), trees=(single_trees(site, 180, 14.0, lane),),
        plants=(undergrowth(site, 2.2, 0.5, 0.35, 12.0),),
    )  # fmt: skip


@kind(height=6.0)
def ramps(site: Site) -> Landscape:
    """A junction: roads that climb on walled ramps beside one another, and a low bridge."""
    plain, tall = _land(site, 0.2), site.settings.height
    length, width = site.between(60.0, 80.0), site.between(6.0, 9.0)
    offs = (-28.0, 0.0, 28.0)
    shifts = site.random.uniform(-15.0, 15.0, 3)

    def terrain(x, y):
        along, across = site.axes(x, y)
        z = plain(x, y)
        for off, shift, way in zip(offs, shifts, (1.0, -1.0, 1.0)):
            up = np.clip((way * (along - shift) + length / 2) / length, 0.0, 1.0)
            z = z + tall * up * bank(width / 2 - np.abs(across - off), 0.3) * (
                np.abs(along - shift) < length / 2 + 12.0
            )
        return z

    return Landscape(terrain, trees=(single_trees(site, 20, 6.0),), plants=(meadow(site),))


KINDS: tuple[Kind, ...] = (
    dyke_and_ditch, embankment_and_cutting, bridge_over_river, bridge_over_road,
    bridge_over_railway, viaduct, power_lines, ramps,
)  # fmt: skip
