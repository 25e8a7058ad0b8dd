"""Kinds of data that are hard whatever the land: outliers, gaps, narrow strips, drones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .buildings import village
from .landscape import SHED, Box, Boxes, Landscape, Plants
from .planting import meadow, single_trees, undergrowth
from .relief import waves
from .scene import Kind, Site, kind
from .transport import embankment_and_cutting


@kind(photogrammetric=True, low_outliers=0.005, noise=0.06, density=5.0, slope=0.06)
def photogrammetry(site: Site) -> Landscape:
    """A village from images: 0.5 % of the points scattered above and below, rounded edges."""
    return village.build(site)


@kind(slope=0.05, low_outliers=5e-4)
def multipath(site: Site) -> Landscape:
    """A village with clusters of 5 to 40 points 2 to 8 m below the ground."""
    land = village.build(site)
    count = 12
    echoes = zip(
        *site.random.uniform(-site.half, site.half, (2, count)),
        site.random.uniform(0.7, 1.8, count), site.random.uniform(2.0, 8.0, count),
    )  # fmt: skip
    return replace(land, echoes=tuple(tuple(map(float, echo)) for echo in echoes))


@kind(height=4.0, slope=0.02)
def water_gaps(site: Site) -> Landscape:
    """Ponds and a river without points, gaps between strips, buildings at the shore."""
    plain, bend = waves(site.random, 1.5, 90.0), waves(site.random, 10.0, 90.0)
    ponds = site.random.uniform(-0.7, 0.7, (3, 2)) * site.half
    sizes = site.random.uniform(12.0, 30.0, 3)
    gap = site.between(30.0, 60.0) * site.random.choice((-1.0, 1.0))

    def shore(x, y):
        out = np.abs(site.axes(x, y)[1] + bend(x, y)) - 12.0
        for (east, north), size in zip(ponds, sizes):
            out = np.minimum(out, np.hypot(x - east, y - north) - size + 0.2 * bend(y, x))
        return out

    def terrain(x, y):
        return 30.0 + 0.02 * x + plain(x, y) + np.clip(0.3 * shore(x, y), -1.5, 1.5)

    def missing(x, y):
        return (shore(x, y) < 0.0) | (np.abs(site.axes(x, y)[0] - gap) < 6.0)

    houses = []
    for _ in range(40):
        x, y = site.random.uniform(-site.half + 10, site.half - 10, 2)
        apart = [np.hypot(x - house.x, y - house.y) for house in houses]
        if shore(np.array([x]), np.array([y]))[0] > 3.0 and min(apart, default=99.0) > 26.0:
            base = float(terrain(np.array([x]), np.array([y]))[0])
            sides = site.between(10.0, 30.0), site.between(8.0, 16.0)
            houses.append(Box(x, y, *sides, site.between(0, 3.1), base, site.between(4.0, 9.0)))
    return Landscape(
        terrain, (Boxes(houses),), trees=(single_trees(site, 90, 9.0),), missing=missing,
        plants=(meadow(site), undergrowth(site, 1.5, 0.7, 0.15, 10.0)),
    )  # fmt: skip


@kind(size=400.0, height=6.0)
def corridor(site: Site) -> Landscape:
    """A strip 30 m wide and nearly 400 m long, askew, along a railway."""
    land = embankment_and_cutting.build(site)
    off = site.between(-6.0, 6.0)

    def outside(x, y):
        return np.abs(site.axes(x, y)[1] - off) > 15.0

    return replace(land, missing=outside)


@kind(slope=0.05)
def stray_points(site: Site) -> Landscape:
    """A village with a handful of points hundreds of metres away, below and above."""
    far = site.random.uniform(150.0, 900.0, (5, 2)) * site.random.choice((-1.0, 1.0), (5, 2))
    heights = site.random.uniform(-300.0, 900.0, 5)
    stray = tuple((float(x), float(y), float(z)) for (x, y), z in zip(far, heights))
    return replace(village.build(site), stray=stray)


def _plot(site: Site) -> Landscape:
    """Return a meadow with shrubs, a ditch and a shed."""
    roll, rough = waves(site.random, 0.6, 40.0), waves(site.random, 0.03, 3.0)
    bend, slope = waves(site.random, 1.0, 25.0), site.settings.slope
    ditch, depth = site.half * site.between(-0.4, 0.4), site.settings.height
    count = 60
    shrubs = site.random.uniform(-site.half, site.half, (count, 2))
    size = site.random.uniform(0.3, 1.2, count)
    tall = site.random.uniform(0.3, 1.2, count)

    def terrain(x, y):
        along, across = site.axes(x, y)
        out = np.abs(across - ditch + bend(x, y))
        trench = depth * np.clip((1.1 - out) / 0.7, 0.0, 1.0)
        return 55.0 + slope * along + roll(x, y) + rough(x, y) - trench

    def top(x, y):
        height = np.zeros(np.shape(x))
        for (east, north), radius, up in zip(shrubs, size, tall):
            near = np.flatnonzero((np.abs(x - east) < radius) & (np.abs(y - north) < radius))
            share = np.hypot(x[near] - east, y[near] - north) / radius
            dome = up * np.sqrt(np.clip(1.0 - share**2, 0.0, 1.0)) * (share < 1.0)
            height[near] = np.maximum(height[near], dome)
        return height

    x, y = site.place(site.between(-7, 7), ditch - np.copysign(min(9.0, 0.5 * site.half), ditch))
    base = float(terrain(np.array([x]), np.array([y]))[0])
    shed = Box(x, y, 5.0, 3.5, site.angle + 0.3, base, 2.4, SHED, 0.12)
    return Landscape(terrain, (Boxes([shed]),), plants=(Plants(top, 0.85, 0.6),))


_DRONE = {"size": 50.0, "height": 0.5, "slope": 0.04, "low_outliers": 5e-6}


@kind(density=50.0, noise=0.02, **_DRONE)
def drone_50(site: Site) -> Landscape:
    """Drone laser: shrubs of 0.3 to 1.2 m, a ditch of 0.5 m, a shed; 50 pulses/m2, noise 2 cm."""
    return _plot(site)


@kind(density=200.0, noise=0.06, **_DRONE)
def drone_noisy(site: Site) -> Landscape:
    """The same at 200 pulses/m2 with noise of 6 cm."""
    return _plot(site)


@kind(density=500.0, noise=0.03, photogrammetric=True, **_DRONE)
def drone_images(site: Site) -> Landscape:
    """The same from images, 500 points/m2, noise 3 cm."""
    return _plot(site)


@kind(density=2000.0, noise=0.05, **{**_DRONE, "size": 20.0})
def drone_2000(site: Site) -> Landscape:
    """The same on 20 x 20 m at 2,000 pulses/m2 with noise of 5 cm."""
    return _plot(site)


KINDS: tuple[Kind, ...] = (
    photogrammetry, multipath, water_gaps, corridor, stray_points, drone_50, drone_noisy,
    drone_images, drone_2000,
)  # fmt: skip
