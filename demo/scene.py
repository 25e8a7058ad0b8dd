"""A lidar survey of the demo's landscape, whose truth is known for every point.

Two flight strips of slanting pulses meet the landscape: walls are hit from the side, eaves throw
shadows, crowns give several returns and let some of the light through, water swallows most of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import laspy
import numpy as np
from laspy.vlrs.known import WktCoordinateSystemVlr
from scipy.spatial import cKDTree

from benchmarks.scenes.mixed import (
    BRIDGE,
    GROUND,
    SIDE,
    WATER,
    Solid,
    Trees,
    make_solids,
    make_trees,
    solid_surface,
    terrain,
)

LOW_VEGETATION, HIGH_VEGETATION, LOW_NOISE, HIGH_NOISE = 3, 5, 7, 18
# Water counts as ground, as in a terrain model; noise, the bridge and cars do not.
GROUND_CLASSES = (GROUND, WATER)

_ORIGIN = (568_000.0, 5_931_000.0)
_WKT = (
    'PROJCS["ETRS89 / UTM zone 32N",GEOGCS["ETRS89",DATUM["European_Terrestrial_Reference_System_'
    '1989",SPHEROID["GRS 1980",6378137,298.257222101,AUTHORITY["EPSG","7019"]],AUTHORITY["EPSG",'
    '"6258"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,'
    'AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4258"]],PROJECTION["Transverse_Mercator"],'
    'PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",9],PARAMETER["scale_factor",'
    '0.9996],PARAMETER["false_easting",500000],PARAMETER["false_northing",0],UNIT["metre",1,'
    'AUTHORITY["EPSG","9001"]],AXIS["Easting",EAST],AXIS["Northing",NORTH],AUTHORITY["EPSG",'
    '"25832"]]'
)

_FLYING_HEIGHT = 800.0
_REFERENCE = 125.0  # the height at which the pulses are evenly spread
_HIGHEST = 16.0  # no solid thing stands higher above the terrain around it
_MARCH = 0.5
_DEAD_ZONE = 0.8  # metres within which a scanner cannot tell two returns apart
_MOST_RETURNS = 5


@dataclass(frozen=True)
class Pulses:
    """Where pulses cross the reference height, and how far they slant per metre of height."""

    x: np.ndarray
    y: np.ndarray
    slant_x: np.ndarray
    slant_y: np.ndarray
    strip: np.ndarray

    def at(self, z: np.ndarray, which: np.ndarray | slice = slice(None)) -> tuple:
        """Return the place of pulses at a height."""
        fall = z - _REFERENCE
        return (
            self.x[which] - self.slant_x[which] * fall,
            self.y[which] - self.slant_y[which] * fall,
        )


def write_scene(cloud: Path, truth: Path, density: float = 8.0, seed: int = 2004) -> int:
    """Write a survey without classes, and the same points with their true classes.

    Parameters
    ----------
    cloud, truth : Path
        The LAS or LAZ files to write.
    density : float
        First returns per square metre.
    seed : int
        The same seed gives the same files.

    Returns
    -------
    int
        Number of points.
    """
    points = survey(density, seed)
    las = _las(points)
    las.write(truth)
    las.classification = np.zeros(len(las.points), dtype=np.uint8)
    las.write(cloud)
    return len(las.points)


def survey(density: float = 8.0, seed: int = 2004) -> dict[str, np.ndarray]:
    """Return the points in the order in which they were measured.

    Parameters
    ----------
    density, seed
        As for `write_scene`.

    Returns
    -------
    dict of str to numpy.ndarray
        x, y, z (metres), kind (the true class), return_number, number_of_returns, pulse, strip and
        slant.
    """
    random = np.random.default_rng(seed)
    solids = make_solids(random)
    trees = make_trees(random, solids)
    pulses = _fly(density, random)
    z, kind = _meet_solids(pulses, solids)
    pulse = np.arange(len(z))
    leaf_pulse, leaf_z = _meet_trees(pulses, trees, z, random)
    leaf_kind = np.full(len(leaf_z), HIGH_VEGETATION, dtype=np.uint8)
    # Leaves take the light of some pulses altogether; water mirrors most of it away.
    spent = np.zeros(len(z), dtype=bool)
    spent[leaf_pulse] = True
    spent &= random.random(len(z)) < 0.45
    spent |= (kind == WATER) & (random.random(len(z)) < 0.8)
    z, kind = _grow_shrubs(pulses, z, kind, random)
    pulse, z, kind = _with_noise(pulse[~spent], z[~spent], kind[~spent], random)
    pulse, z, kind = _number(
        np.append(pulse, leaf_pulse), np.append(z, leaf_z), np.append(kind, leaf_kind)
    )
    x, y = pulses.at(z, pulse)
    inside = (x >= 0) & (x < SIDE) & (y >= 0) & (y < SIDE)
    # All returns of a pulse or none, so that the return numbers stay complete.
    inside = ~np.isin(pulse, pulse[~inside])
    pulse, kind = pulse[inside], kind[inside]
    number, count = _return_numbers(pulse)
    points = {"x": x[inside], "y": y[inside], "z": z[inside]}
    for name, sigma in (("x", 0.05), ("y", 0.05), ("z", 0.025)):
        points[name] = points[name] + random.normal(0, sigma, len(pulse))
    points.update(kind=kind, return_number=number, number_of_returns=count, pulse=pulse)
    return points | {"strip": pulses.strip[pulse], "slant": pulses.slant_x[pulse]}


def _fly(density: float, random: np.random.Generator) -> Pulses:
    """Return the pulses of two strips side by side, of parallel and slightly skew scan lines."""
    spacing = np.sqrt(2.0 / density)
    margin = 12.0
    steps = np.arange(-SIDE * 0.75, SIDE * 0.75, spacing)
    columns = []
    for strip, (line, turn) in enumerate(((70.0, 0.05), (235.0, -0.04))):
        along, across = (axis.ravel() for axis in np.meshgrid(steps, steps, indexing="ij"))
        along = along + random.normal(0, 0.06 * spacing, along.shape)
        across = across + random.uniform(0, spacing)
        x = SIDE / 2 + across * np.cos(turn) - along * np.sin(turn)
        y = SIDE / 2 + across * np.sin(turn) + along * np.cos(turn)
        kept = (np.abs(x - SIDE / 2) < SIDE / 2 + margin) & (
            np.abs(y - SIDE / 2) < SIDE / 2 + margin
        )
        x, y = x[kept], y[kept]
        slant = (x - line) / _FLYING_HEIGHT
        columns.append((x, y, slant, slant * np.tan(turn), np.full(len(x), strip + 1)))
    return Pulses(*(np.concatenate(each) for each in zip(*columns)))


def _meet_solids(pulses: Pulses, solids: list[Solid]) -> tuple[np.ndarray, np.ndarray]:
    """Return the height and the class of what each pulse meets, leaves apart."""
    z = terrain(pulses.x, pulses.y)
    for _ in range(6):  # the terrain is gentle compared with the rays
        z = terrain(*pulses.at(z))
    x, y = pulses.at(z)
    _, kind = solid_surface(x, y, [])
    # Near a thing that stands up, follow the ray down to the first place inside of it.
    near = np.zeros(len(z), dtype=bool)
    for solid in solids:
        near |= np.hypot(x - solid.x, y - solid.y) < solid.reach + 8.0
    near = np.flatnonzero(near | (kind == BRIDGE) | (kind == WATER) | _is_beside_water(x, y))
    above, below = z[near] + _HIGHEST, z[near] - 1.0
    marching = np.arange(len(near))
    height = above.copy()
    while len(marching):
        height[marching] -= _MARCH
        surface, _ = solid_surface(*pulses.at(height[marching], near[marching]), solids)
        met = height[marching] <= surface
        below[marching[met]] = height[marching[met]]
        above[marching[met]] = height[marching[met]] + _MARCH
        marching = marching[~met & (height[marching] > z[near[marching]] - 1.0)]
    for _ in range(7):
        middle = (above + below) / 2
        surface, _ = solid_surface(*pulses.at(middle, near), solids)
        below = np.where(middle <= surface, middle, below)
        above = np.where(middle <= surface, above, middle)
    # A hair inside, so that a wall is told from the ground in front of it.
    _, kind[near] = solid_surface(*pulses.at(below - 0.02, near), solids)
    z[near] = below
    return z, kind


def _is_beside_water(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    _, kind = solid_surface(x, y + 5.0, [])
    _, other = solid_surface(x, y - 5.0, [])
    return (kind == BRIDGE) | (other == BRIDGE)


def _meet_trees(
    pulses: Pulses, trees: Trees, solid: np.ndarray, random: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Return pulse and height of the echoes from leaves, as Poisson points along the ray."""
    index = cKDTree(np.column_stack([pulses.x, pulses.y]))
    foot = terrain(trees.x, trees.y)
    all_pulses, all_heights = [], []
    for i in range(len(trees.x)):
        height, radius = trees.height[i], trees.radius[i]
        middle = foot[i] + height * (1 + trees.stem[i]) / 2
        which = np.array(index.query_ball_point((trees.x[i], trees.y[i]), radius + 9.0), dtype=int)
        x, y = pulses.at(np.full(len(which), middle), which)
        share = np.hypot(x - trees.x[i], y - trees.y[i]) / radius
        which, share = which[share < 1], share[share < 1]
        stem = height * trees.stem[i]
        if trees.conifer[i]:
            top, bottom = height - (height - stem) * share, np.full(len(share), stem)
        else:
            half = (height - stem) / 2 * np.sqrt(1 - share**2)
            top, bottom = (height + stem) / 2 + half, (height + stem) / 2 - half
        count = random.poisson((0.45 if trees.conifer[i] else 0.3) * (top - bottom))
        owner = np.repeat(np.arange(len(which)), count)
        # Twice as many echoes near the upper side as near the lower one.
        depth = 1 - np.sqrt(random.uniform(0.05, 1, len(owner)))
        heights = foot[i] + top[owner] - depth * (top - bottom)[owner]
        free = heights > solid[which[owner]] + _DEAD_ZONE
        all_pulses.append(which[owner][free])
        all_heights.append(heights[free])
    return np.concatenate(all_pulses), np.concatenate(all_heights)


def _grow_shrubs(
    pulses: Pulses, z: np.ndarray, kind: np.ndarray, random: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Lift the echo off the ground where shrubs and high grass stand, for some of the pulses."""
    x, y = pulses.at(z)
    patches = np.sin(x / 17.0 + 2.0 + 1.3 * np.sin(y / 29.0)) * np.sin(
        y / 21.0 + 1.7 * np.sin(x / 37.0)
    ) + 0.5 * np.sin((x + 1.7 * y) / 13.0)
    wood = (x > 232) & (y > 135)
    thick = 0.6 * (patches > 0.85) + 0.25 * wood
    lifted = (kind == GROUND) & (random.random(len(z)) < thick)
    height = random.gamma(3.0, 0.22, len(z)) + 0.15
    return np.where(lifted, z + height, z), np.where(lifted, LOW_VEGETATION, kind)


def _with_noise(
    pulse: np.ndarray, z: np.ndarray, kind: np.ndarray, random: np.random.Generator
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Move a few echoes below the ground (multipath) and high above it (birds)."""
    z, kind = z.copy(), kind.copy()
    count = max(len(z) // 12_000, 10)
    low = random.choice(np.flatnonzero(kind == GROUND), count, replace=False)
    high = random.choice(np.setdiff1d(np.arange(len(z)), low), count, replace=False)
    z[low] -= random.uniform(1.5, 12.0, len(low))
    z[high] += random.uniform(30.0, 90.0, len(high))
    # Multipath likes company: some low points come in small groups.
    for first in low[:4]:
        group = np.arange(first, min(first + 4, len(z)))
        z[group] = z[first] + random.normal(0, 0.1, len(group))
        kind[group] = LOW_NOISE
    kind[low], kind[high] = LOW_NOISE, HIGH_NOISE
    return pulse, z, kind


def _number(
    pulse: np.ndarray, z: np.ndarray, kind: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Sort echoes by pulse and from top to bottom; drop those that a scanner cannot tell apart."""
    order = np.lexsort((-z, pulse))
    pulse, z, kind = pulse[order], z[order], kind[order]
    # Only echoes from leaves are ever dropped, so that each pulse keeps what lies below them.
    close = (np.diff(pulse) == 0) & (-np.diff(z) < _DEAD_ZONE)
    kept = np.append(~(close & (kind[:-1] == HIGH_VEGETATION)), True)
    pulse, z, kind = pulse[kept], z[kept], kind[kept]
    number, count = _return_numbers(pulse)
    kept = (number < _MOST_RETURNS) | (number == count)
    return pulse[kept], z[kept], kind[kept]


def _return_numbers(pulse: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return number and count of the returns of pulses that are sorted."""
    first = np.flatnonzero(np.append(True, np.diff(pulse) != 0))
    counts = np.diff(np.append(first, len(pulse)))
    return np.arange(len(pulse)) - np.repeat(first, counts) + 1, np.repeat(counts, counts)


def _las(points: dict[str, np.ndarray]) -> laspy.LasData:
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = np.full(3, 0.001), np.array([*_ORIGIN, 0.0])
    header.vlrs.append(WktCoordinateSystemVlr(_WKT))
    header.global_encoding.wkt = True
    header.generating_software = "Bare Earth demo"
    las = laspy.LasData(header)
    las.x, las.y = points["x"] + _ORIGIN[0], points["y"] + _ORIGIN[1]
    las.z = points["z"]
    las.classification = points["kind"].astype(np.uint8)
    las.return_number = points["return_number"].astype(np.uint8)
    las.number_of_returns = points["number_of_returns"].astype(np.uint8)
    las.gps_time = 2.0e8 + points["pulse"] * 5e-6 + points["strip"] * 300.0
    las.point_source_id = points["strip"].astype(np.uint16)
    las.scan_angle = np.rint(np.degrees(np.arctan(points["slant"])) / 0.006).astype(np.int16)
    strength = {GROUND: 900, LOW_VEGETATION: 600, HIGH_VEGETATION: 400, 6: 1300, BRIDGE: 1100}
    of_kind = np.array([strength.get(value, 300) for value in range(19)])
    las.intensity = (of_kind[points["kind"]] / points["number_of_returns"]).astype(np.uint16)
    return las
