"""Kinds of land with groups of points far below and above it, as sensors and birds make them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from .buildings import village
from .landscape import Landscape
from .planting import meadow, undergrowth
from .relief import waves
from .scene import Kind, Site, kind
from .transport import embankment_and_cutting

# Points of a group, and least distance in metres between the middles of two groups.
_MOST_POINTS, _APART = 20, 12.0
# A place is open if nothing stands within so many metres.
_OPEN = 4.0


def _middles(site: Site, land: Landscape, count: int, along_road: bool = False) -> np.ndarray:
    """Return places in the open, shape (n, 2); along the axis of the site if that is asked for."""
    places: list[tuple[float, float]] = []
    for _ in range(40 * count):
        x, y = site.random.uniform(-site.half + 8.0, site.half - 8.0, 2)
        if along_road:
            x, y = site.place(x, site.between(-3.0, 3.0))
        far = all(np.hypot(x - east, y - north) > _APART for east, north in places)
        if far and max(abs(x), abs(y)) < site.half - 8.0 and _is_open(land, x, y):
            places.append((x, y))
        if len(places) == count:
            break
    return np.array(places)


def _is_open(land: Landscape, x: float, y: float) -> bool:
    step = np.arange(-_OPEN, _OPEN + 0.1, 0.5)
    east, north = (axis.ravel() + by for axis, by in zip(np.meshgrid(step, step), (x, y)))
    return not land.surface(east, north)[1].any()


def _groups(
    site: Site, land: Landscape, middles: np.ndarray, least: float, most: float, up: bool = False
) -> Landscape:
    """Return the land with groups of 1 to 20 points, up to 2 m wide, below it or above."""
    points = []
    for x, y in middles:
        count = int(np.exp(site.between(0.0, np.log(_MOST_POINTS + 1))))
        radius = site.between(0.0, 1.0) * np.sqrt(site.random.uniform(0.0, 1.0, count))
        turn = site.random.uniform(0.0, 2.0 * np.pi, count)
        east, north = x + radius * np.cos(turn), y + radius * np.sin(turn)
        off = site.between(least, most) + np.abs(site.random.normal(0.0, 0.1, count))
        z = land.terrain(east, north) + (off if up else -off)
        points += list(zip(east.tolist(), north.tolist(), z.tolist()))
    return replace(land, stray=tuple(points))


def _even_land(site: Site) -> Landscape:
    roll, rough, slope = waves(site.random, 0.5, 50.0), waves(site.random, 0.03, 3.0), site.settings

    def terrain(x, y):
        return 80.0 + slope.slope * site.axes(x, y)[0] + roll(x, y) + rough(x, y)

    return Landscape(terrain, plants=(meadow(site), undergrowth(site, 1.0, 0.5, 0.05)))


@kind(size=100.0, low_outliers=0.0)
def low_groups_meadow(site: Site) -> Landscape:
    """A meadow with groups of 1 to 20 points 0.5 to 8 m below it."""
    land = _even_land(site)
    return _groups(site, land, _middles(site, land, 30), 0.5, 8.0)


@kind(size=100.0, slope=0.5, low_outliers=0.0)
def low_groups_slope(site: Site) -> Landscape:
    """The same on a slope of 27 degrees."""
    land = _even_land(site)
    return _groups(site, land, _middles(site, land, 30), 0.5, 8.0)


@kind(size=120.0, height=4.0, slope=0.03, low_outliers=0.0)
def low_groups_town(site: Site) -> Landscape:
    """The same below the streets and gardens of a village."""
    land = village.build(site)
    return _groups(site, land, _middles(site, land, 30), 0.5, 8.0)


@kind(size=160.0, height=5.0, low_outliers=0.0)
def low_groups_road(site: Site) -> Landscape:
    """Groups of reflections along a road on an embankment and in a cutting."""
    land = embankment_and_cutting.build(site)
    return _groups(site, land, _middles(site, land, 12, along_road=True), 0.5, 8.0)


@kind(size=120.0, height=5.0, slope=0.05)
def birds(site: Site) -> Landscape:
    """A village with groups of 1 to 20 points 25 to 200 m above it."""
    land = village.build(site)
    middles = site.random.uniform(-site.half + 8.0, site.half - 8.0, (25, 2))
    return _groups(site, land, middles, 25.0, 200.0, up=True)


KINDS: tuple[Kind, ...] = (
    low_groups_meadow, low_groups_slope, low_groups_town, low_groups_road, birds,
)  # fmt: skip
