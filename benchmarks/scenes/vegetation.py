"""Kinds of land that hide below plants."""

from __future__ import annotations

import numpy as np

from .landscape import Landscape, Plants
from .planting import meadow, single_trees, undergrowth, wood
from .relief import waves
from .scene import Kind, Site, kind


def _forest_floor(site: Site, amplitude: float):
    roll, rough = waves(site.random, amplitude, 100.0), waves(site.random, 0.12, 7.0)
    turn = site.settings.slope

    def terrain(x, y):
        return 450.0 + turn * site.axes(x, y)[0] + roll(x, y) + rough(x, y)

    return terrain


@kind(density=1.5, height=22.0, penetration=0.04, slope=0.08, low_outliers=0.0)
def dense_canopy(site: Site) -> Landscape:
    """Closed old forest at 1.5 pulses/m2: most cells have no ground point."""
    trees = wood(site, 6.0, site.settings.height, stem=0.2, radius=0.8)
    return Landscape(
        _forest_floor(site, 3.0), trees=(trees,), plants=(undergrowth(site, 2.0, 0.25, 0.3),)
    )


@kind(density=6.0, height=20.0, penetration=0.015, slope=0.2)
def dense_conifers(site: Site) -> Landscape:
    """A plantation of conifers that 1 to 5 % of the pulses get through, with a few rides."""
    ride = site.between(45.0, 70.0)

    def standing(x, y):
        along, across = site.axes(x, y)
        return (np.abs(np.mod(across, ride) - ride / 2) > 2.5) | (np.abs(along) > 0.8 * site.half)

    trees = wood(site, 3.2, site.settings.height, True, standing, stem=0.1, radius=0.95)
    return Landscape(_forest_floor(site, 3.0), trees=(trees,))


@kind(density=6.0, height=7.0, penetration=0.1)
def mangrove(site: Site) -> Landscape:
    """Mangrove-like: a low canopy, roots and understorey to the ground, channels of water."""
    mud, bend = waves(site.random, 0.25, 40.0), waves(site.random, 8.0, 70.0)
    channel = site.between(2.0, 5.0)

    def terrain(x, y):
        out = np.abs(site.axes(x, y)[1] + bend(x, y))
        return 0.8 + mud(x, y) - 1.5 * np.clip(1.2 - out / channel, 0.0, 1.0)

    def wet(x, y):
        return terrain(x, y) < -0.2

    trees = wood(
        site, 3.5, site.settings.height, stem=0.15, radius=0.8, where=lambda x, y: ~wet(x, y)
    )
    roots = undergrowth(site, 1.6, 0.7, 0.75, 15.0)
    return Landscape(terrain, trees=(trees,), plants=(roots,), water=wet)


@kind(density=5.0, height=1.0, slope=0.12)
def vines(site: Site) -> Landscape:
    """Vines of 1 m in rows, 1.5 to 2.2 m apart, on a slope."""
    apart, wide = site.between(1.5, 2.2), site.between(0.4, 0.7)
    roll, field = waves(site.random, 2.0, 110.0), site.between(50.0, 80.0)
    grain = waves(site.random, 0.12, 2.5)

    def top(x, y):
        along, across = site.axes(x, y)
        row = np.abs(np.mod(across, apart) - apart / 2) < wide / 2
        path = np.mod(along, field) < 4.0
        return site.settings.height * (1.1 + grain(x, y)) * (row & ~path)

    terrain = _forest_floor(site, 0.5)
    return Landscape(
        lambda x, y: terrain(x, y) + roll(x, y),
        trees=(single_trees(site, 12, 7.0),),
        plants=(Plants(top, 0.8, 0.35), undergrowth(site, 0.25, 0.2, 0.3)),
    )


@kind(height=2.5, density=5.0)
def hedges(site: Site) -> Landscape:
    """Fields between hedges, dense from the ground up, and banks below some of them."""
    apart, apart_along = site.between(35.0, 55.0), site.between(45.0, 70.0)
    bend, grain = waves(site.random, 3.0, 90.0), waves(site.random, 0.2, 4.0)
    raised = site.between(0.0, 0.8)
    base = _forest_floor(site, 1.5)

    def beside(x, y):
        along, across = site.axes(x, y)
        return np.minimum(
            np.abs(np.mod(across + bend(x, y), apart) - apart / 2),
            np.abs(np.mod(along + bend(y, x), apart_along) - apart_along / 2),
        )

    def top(x, y):
        return site.settings.height * (1.0 + grain(x, y)) * (beside(x, y) < 1.1)

    return Landscape(
        lambda x, y: base(x, y) + raised * np.exp(-((beside(x, y) / 1.5) ** 2)),
        trees=(single_trees(site, 40, 12.0),),
        plants=(Plants(top, 0.93, 0.25), undergrowth(site, 0.6, 0.5, 0.25, 60.0)),
    )


@kind(slope=0.35, height=14.0, penetration=0.25)
def open_forest(site: Site) -> Landscape:
    """Mixed forest on a slope of 35 %, with bushes below the trees."""
    trees = wood(site, 6.0, site.settings.height)
    return Landscape(
        _forest_floor(site, 4.0), trees=(trees,),
        plants=(undergrowth(site, 1.5, 0.45, 0.4, 12.0), meadow(site)),
    )  # fmt: skip


KINDS: tuple[Kind, ...] = (dense_canopy, dense_conifers, mangrove, vines, hedges, open_forest)
