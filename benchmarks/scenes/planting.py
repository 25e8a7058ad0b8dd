"""Plants trees and low growth on a site."""

from __future__ import annotations

from typing import Callable

import numpy as np

from .landscape import Plants, Trees
from .relief import patches, waves
from .scene import Site


def wood(
    site: Site,
    apart: float,
    height: float,
    conifer: bool = False,
    where: Callable[[np.ndarray, np.ndarray], np.ndarray] | None = None,
    stem: float = 0.35,
    radius: float = 0.55,
) -> Trees:
    """Return trees about `apart` metres from each other, in the whole site or where told.

    Parameters
    ----------
    height : float
        Of the trees, about.
    stem : float
        Share of the height below the crown.
    radius : float
        Of the crowns, as a share of the distance.
    """
    side = np.arange(-site.half - 5.0, site.half + 5.0, apart)
    x, y = (axis.ravel() for axis in np.meshgrid(side, side))
    x, y = (axis + site.random.uniform(-0.45, 0.45, len(x)) * apart for axis in (x, y))
    if where is not None:
        kept = where(x, y)
        x, y = x[kept], y[kept]
    count = len(x)
    tall = height * site.random.uniform(0.7, 1.2, count)
    wide = apart * radius * site.random.uniform(0.75, 1.35, count)
    return Trees(x, y, tall, wide, tall * stem * site.random.uniform(0.6, 1.4, count), conifer)


def single_trees(site: Site, count: int, height: float = 10.0, clear: object = None) -> Trees:
    """Return trees that stand alone, `count` on 2 ha; none where `clear` says so."""
    count = max(round(count * site.settings.size**2 / 20_000.0), 4)
    x, y = site.random.uniform(-site.half, site.half, (2, count))
    kept = np.ones(count, dtype=bool) if clear is None else ~clear(x, y)
    if not kept.any():
        kept[0] = True
    x, y = x[kept], y[kept]
    tall = height * site.random.uniform(0.5, 1.4, len(x))
    return Trees(x, y, tall, 0.28 * tall, 0.25 * tall)


def undergrowth(
    site: Site, height: float, share: float, covered: float = 0.5, length: float = 25.0
) -> Plants:
    """Return patches of shrubs or tall grass.

    Parameters
    ----------
    height : float
        Of the plants, at most.
    share : float
        Share of the pulses that they stop.
    covered : float
        Share of the land that they cover.
    """
    where = patches(site.random, length, covered)
    grain = waves(site.random, 0.25, 3.0)
    return Plants(lambda x, y: where(x, y) * height * np.clip(0.65 + grain(x, y), 0.2, 1.0), share)


def meadow(site: Site) -> Plants:
    """Return grass here and there."""
    return undergrowth(site, 0.6, 0.08, 0.3)
