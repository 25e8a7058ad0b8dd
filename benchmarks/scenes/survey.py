"""A lidar survey, or one from images, of a landscape.

Two flight lines look at it from two sides: walls and cliffs are hit in their faces, eaves and decks
throw shadows, crowns give several returns and let some of the light through.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.spatial import cKDTree

from .classes import (
    GROUND,
    HIGH_NOISE,
    HIGH_VEGETATION,
    LOW_NOISE,
    LOW_VEGETATION,
    MEDIUM_VEGETATION,
    WATER,
    WIRE,
)
from .landscape import Landscape, Plants, Trees, Wire
from .pulses import Pulses, cross_decks, fly

if TYPE_CHECKING:
    from .settings import Settings

# A scanner cannot tell two returns apart that are nearer than this.
_DEAD_ZONE = 0.7
_MOST_RETURNS = 5
_BEAM = 0.2
# What is lower counts as ground, as those who edit surveys by hand have it.
_LOWEST_PLANT = 0.25
# A blurred height is the mean of so many places. The tail of points below the surface of images
# falls off within so many metres.
_MEAN_OF = 5
_TAIL = 0.35
# Points that lie deeper than this are noise.
_LOW = 0.8


class Returns(NamedTuple):
    """What comes back: coordinates, classes, number of the return and how many there are."""

    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    classes: np.ndarray
    number: np.ndarray
    count: np.ndarray


class _Echoes(NamedTuple):
    """Returns above the end of a pulse."""

    pulse: np.ndarray
    z: np.ndarray
    classes: np.ndarray


def survey(landscape: Landscape, settings: Settings, random: np.random.Generator) -> Returns:
    """Return the points of a square round (0, 0), in the order in which they were measured."""
    pulses = fly(landscape, settings, random)
    pulses = cross_decks(pulses, landscape.decks)
    if settings.photogrammetric:
        return _from_images(pulses, landscape, settings, random)
    pulses = _into_water(pulses, landscape, random)
    ends = np.ones(len(pulses.x), dtype=bool)
    echoes = []
    for trees in landscape.trees:
        found, stopped = _through_crowns(pulses, trees, landscape, settings, random)
        echoes.append(found)
        ends &= ~stopped
    for wire in landscape.wires:
        echoes.append(_meet_wire(pulses, wire, random))
    pulses = _into_plants(pulses, landscape.plants, random)
    pulse = np.concatenate([np.flatnonzero(ends), *(group.pulse for group in echoes)]).astype(int)
    z = np.concatenate([pulses.z[ends], *(group.z for group in echoes)])
    classes = np.concatenate([pulses.classes[ends], *(group.classes for group in echoes)])
    pulse, z, classes = _sorted(pulse, z, classes.astype(np.uint8))
    number, count = _numbers(pulse)
    x, y = pulses.take(pulse).places_at(z)
    returns = Returns(x, y, z, classes, number, count)
    return _finished(returns, landscape, settings, random)


def _into_water(pulses: Pulses, landscape: Landscape, random: np.random.Generator) -> Pulses:
    if landscape.water is None:
        return pulses
    wet = (pulses.classes == GROUND) & landscape.water(pulses.x, pulses.y)
    kept = ~wet | (random.random(len(wet)) < 0.15)
    return pulses._replace(classes=np.where(wet, WATER, pulses.classes)).take(kept)


def _through_crowns(
    pulses: Pulses,
    trees: Trees,
    landscape: Landscape,
    settings: Settings,
    random: np.random.Generator,
) -> tuple[_Echoes, np.ndarray]:
    """Return the echoes of leaves, and which pulses the crowns stop."""
    foot = landscape.terrain(trees.x, trees.y)
    middle = float(np.mean(trees.height + trees.stem)) / 2
    x, y = pulses.places_at(pulses.z + middle)
    index = cKDTree(np.column_stack((trees.x, trees.y)))
    count = min(3, len(trees.x))
    distance, number = index.query(
        np.column_stack((x, y)), k=count, distance_upper_bound=float(trees.radius.max())
    )
    distance, number = distance.reshape(len(x), -1), number.reshape(len(x), -1)
    top, bottom, share = np.full(len(x), -np.inf), np.full(len(x), np.inf), np.zeros(len(x))
    for k in range(count):
        near = np.flatnonzero(number[:, k] < len(trees.x))
        tree = number[near, k]
        near, tree = (places[distance[near, k] < trees.radius[tree]] for places in (near, tree))
        up, down, thick = trees.crown(tree, distance[near, k])
        top[near] = np.maximum(top[near], foot[tree] + up)
        bottom[near] = np.minimum(bottom[near], foot[tree] + down)
        share[near] = np.minimum(share[near] + thick, 1.3)
    met = np.flatnonzero((top > pulses.z + 1.0) & (pulses.classes != WIRE))
    through = random.random(len(met)) < settings.penetration ** share[met]
    # A pulse that is stopped gives an echo in any case, one that gets through often does.
    counts = random.poisson(0.7, len(met)) + (~through | (random.random(len(met)) < 0.5))
    pulse = np.repeat(met, counts)
    depth = random.beta(1.3, 2.2, len(pulse))
    z = top[pulse] - depth * (top - np.maximum(bottom, pulses.z))[pulse]
    free = z > pulses.z[pulse] + _DEAD_ZONE
    stopped = np.zeros(len(x), dtype=bool)
    stopped[met[~through]] = True
    height = z - pulses.z[pulse]
    code = np.where(height > 2.0, HIGH_VEGETATION, MEDIUM_VEGETATION)
    return _Echoes(pulse[free], z[free], code[free]), stopped


def _meet_wire(pulses: Pulses, wire: Wire, random: np.random.Generator) -> _Echoes:
    x, y = pulses.places_at((wire.start[2] + wire.end[2]) / 2 - wire.sag * 0.67)
    share, _ = wire.hangs(x, y)
    z = wire.height(share)
    share, beside = wire.hangs(*pulses.places_at(z))
    met = (share >= 0) & (share <= 1) & (beside < _BEAM) & (z > pulses.z + _DEAD_ZONE)
    pulse = np.flatnonzero(met)
    return _Echoes(pulse, z[pulse], np.full(len(pulse), WIRE))


def _into_plants(pulses: Pulses, plants: tuple[Plants, ...], random: np.random.Generator) -> Pulses:
    """Lift echoes off the ground into low plants, too low for an echo of the ground below."""
    for layer in plants:
        top = layer.top(pulses.x, pulses.y)
        hit = (pulses.classes == GROUND) & (top > 0.05) & (random.random(len(top)) < layer.share)
        rise = top * random.uniform(layer.least, 1.0, len(top))
        hit &= rise > _LOWEST_PLANT
        code = np.select([rise > 2.0, rise > 0.5], [HIGH_VEGETATION, MEDIUM_VEGETATION], 3)
        pulses = pulses._replace(
            z=np.where(hit, pulses.z + rise, pulses.z),
            classes=np.where(hit, code, pulses.classes),
        )
    return pulses


def _from_images(
    pulses: Pulses, landscape: Landscape, settings: Settings, random: np.random.Generator
) -> Returns:
    """Return what dense matching makes: the upper side of everything, edges rounded."""
    x, y, z, classes = pulses.x, pulses.y, pulses.z, pulses.classes
    if landscape.water is not None:  # there is nothing to match on water
        kept = ~((classes == GROUND) & landscape.water(x, y))
        x, y, z, classes = x[kept], y[kept], z[kept], classes[kept]
    # A match is a mean of what lies round about: the height is that of a place near by.
    near_x, near_y = (axis + random.normal(0, 0.12, len(x)) for axis in (x, y))
    near, codes = landscape.surface(near_x, near_y)
    if settings.blur:
        near, codes = _blurred(x, y, landscape, settings.blur, random)
    solid = classes != 17
    z = np.where(solid, near, z)
    classes = np.where(solid, np.where(codes == 0, GROUND, codes), classes)
    for trees in landscape.trees:
        index = cKDTree(np.column_stack((trees.x, trees.y)))
        distance, number = index.query(np.column_stack((x, y)))
        on = distance < trees.radius[number]
        top, *_ = trees.crown(number, distance)
        top = landscape.terrain(trees.x, trees.y)[number] + top - random.gamma(2.0, 0.2, len(x))
        on &= top > z + 0.3
        z, classes = np.where(on, top, z), np.where(on, HIGH_VEGETATION, classes)
    for plants in landscape.plants:
        top = plants.top(x, y) * random.uniform(max(plants.least, 0.5), 1.0, len(x))
        on = (classes == GROUND) & (top > _LOWEST_PLANT) & (random.random(len(x)) < 0.92)
        z, classes = np.where(on, z + top, z), np.where(on, LOW_VEGETATION, classes)
    ones = np.ones(len(x), dtype=np.uint8)
    returns = Returns(x, y, z, classes.astype(np.uint8), ones, ones.copy())
    return _finished(returns, landscape, settings, random)


def _blurred(
    x: np.ndarray, y: np.ndarray, landscape: Landscape, blur: float, random: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Return means of heights round about: walls become slopes, and objects get a foot.

    A point belongs to the object as soon as it stands a step above the ground.
    """
    total, code = np.zeros(len(x)), np.zeros(len(x), dtype=np.uint8)
    side = random.normal(0, 0.5 * blur, (2, len(x)))  # what all places of a mean share
    for _ in range(_MEAN_OF):
        off = side + random.uniform(-blur, blur, (2, len(x)))
        z, its = landscape.surface(x + off[0], y + off[1])
        total += z
        code = np.maximum(code, its)
    z = total / _MEAN_OF
    stands = z > landscape.terrain(x, y) + _LOWEST_PLANT
    return z, np.where(stands, code, 0).astype(np.uint8)


def _sorted(
    pulse: np.ndarray, z: np.ndarray, classes: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Sort echoes by pulse and from top to bottom; drop those that a scanner cannot tell apart."""
    order = np.lexsort((-z, pulse))
    pulse, z, classes = pulse[order], z[order], classes[order]
    close = (np.diff(pulse) == 0) & (-np.diff(z) < _DEAD_ZONE)
    kept = np.append(~(close & (classes[:-1] == HIGH_VEGETATION)), True)
    pulse, z, classes = pulse[kept], z[kept], classes[kept]
    number, count = _numbers(pulse)
    kept = (number < _MOST_RETURNS) | (number == count)
    return pulse[kept], z[kept], classes[kept]


def _numbers(pulse: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return number and count of the returns of pulses that are sorted."""
    first = np.flatnonzero(np.append(True, np.diff(pulse) != 0))
    counts = np.diff(np.append(first, len(pulse)))
    number = np.arange(len(pulse)) - np.repeat(first, counts) + 1
    return number.astype(np.uint8), np.repeat(counts, counts).astype(np.uint8)


def _finished(
    returns: Returns, landscape: Landscape, settings: Settings, random: np.random.Generator
) -> Returns:
    """Add the noise, the outliers and the echoes that come from nowhere."""
    x, y, z, classes = (column.copy() for column in returns[:4])
    count = len(x)
    _throw_down(x, y, z, classes, landscape, settings, random)
    for east, north, radius, depth in landscape.echoes:
        near = np.flatnonzero(np.hypot(x - east, y - north) < radius)
        z[near] = landscape.terrain(x[near], y[near]) - depth + random.normal(0, 0.25, len(near))
        classes[near] = LOW_NOISE
    if settings.photogrammetric:  # what neighbours share, and what they don't
        turn, length = random.uniform(0, np.pi), random.uniform(1.5, 3.0)
        u, v = x * np.cos(turn) + y * np.sin(turn), y * np.cos(turn) - x * np.sin(turn)
        z += settings.noise * np.sin(u / length) * np.sin(v / length + np.sin(u / 5.3))
    if settings.low_tail:
        sunk = np.flatnonzero(random.random(count) < settings.low_tail)
        deep = random.exponential(_TAIL, len(sunk))
        z[sunk] -= deep
        classes[sunk[deep > _LOW]] = LOW_NOISE
    x += random.normal(0, 2 * settings.noise, count)
    y += random.normal(0, 2 * settings.noise, count)
    z += random.normal(0, settings.noise, count)
    columns = [x, y, z, classes, returns.number, returns.count]
    if landscape.stray:
        far = np.array(landscape.stray).T
        ones = np.ones(far.shape[1], dtype=np.uint8)
        is_high = far[2] > landscape.terrain(far[0], far[1])
        code = np.where(is_high, HIGH_NOISE, LOW_NOISE).astype(np.uint8)
        columns = [np.append(a, b) for a, b in zip(columns, (*far, code, ones, ones))]
    return Returns(*columns)


def _throw_down(
    x: np.ndarray,
    y: np.ndarray,
    z: np.ndarray,
    classes: np.ndarray,
    landscape: Landscape,
    settings: Settings,
    random: np.random.Generator,
) -> None:
    """Move single points and small groups far below ground; those of images up as often."""
    candidates = np.flatnonzero(classes != WATER)
    wanted = round(settings.low_outliers * len(candidates))
    if not wanted:
        return
    single = random.choice(candidates, wanted, replace=False)
    depth = random.uniform(1.0, 12.0, wanted)
    groups = single[: wanted // 8]
    if len(groups) and not settings.photogrammetric:  # points measured one after the other
        single = np.concatenate([np.minimum(groups + k, len(x) - 1) for k in range(4)] + [single])
        depth = np.concatenate([depth[: len(groups)]] * 4 + [depth])
        single, first = np.unique(single, return_index=True)
        depth = depth[first]
    up = settings.photogrammetric & (random.random(len(single)) < 0.5)
    ground = landscape.terrain(x[single], y[single])
    z[single] = np.where(up, z[single] + depth, ground - depth)
    classes[single] = np.where(up, HIGH_NOISE, LOW_NOISE)
