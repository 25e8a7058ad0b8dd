"""Synthetic surveys whose truth is known."""

from __future__ import annotations

import numpy as np

from bare_earth.algorithms.core.points import Points


def scatter(
    size: float = 80.0, density: float = 4.0, seed: int = 0
) -> tuple[np.ndarray, np.ndarray]:
    """Return places of points spread evenly at random over a square."""
    random = np.random.default_rng(seed)
    return tuple(random.uniform(0.0, size, (2, int(size * size * density))))


def surveyed(x: np.ndarray, y: np.ndarray, ground: np.ndarray, seed: int = 1) -> np.ndarray:
    """Return heights with the noise of a scanner."""
    return ground + np.random.default_rng(seed).normal(0.0, 0.03, len(x))


def village(
    slope: float = 0.1, size: float = 80.0, density: float = 4.0
) -> tuple[Points, np.ndarray]:
    """Return a slope with two houses, a shed, trees and low noise, and which points are ground."""
    x, y = scatter(size, density)
    random = np.random.default_rng(5)
    z = surveyed(x, y, 100.0 + slope * x + 0.8 * np.sin(y / 15.0))
    ground = np.ones(len(x), dtype=bool)
    for east, north, width, depth, height in (
        (20, 20, 12, 9, 6.0),
        (55, 50, 18, 14, 9.0),
        (25, 60, 5, 4, 2.6),
    ):
        inside = (np.abs(x - east) < width / 2) & (np.abs(y - north) < depth / 2)
        z[inside] = 100.0 + slope * east + height + 0.3 * np.abs(x[inside] - east)
        ground &= ~inside
    for east, north in random.uniform(5.0, size - 5.0, (12, 2)):
        crown = (np.hypot(x - east, y - north) < 3.0) & (random.random(len(x)) < 0.7) & ground
        z[crown] += random.uniform(2.0, 9.0, int(crown.sum()))
        ground &= ~crown
    low = random.choice(np.flatnonzero(ground), 6, replace=False)
    z[low] -= random.uniform(5.0, 40.0, 6)
    ground[low] = False
    return Points(x, y, z), ground


def large_hall(slope: float) -> tuple[Points, np.ndarray]:
    """Return a slope with a hall of 120 x 80 m, level on top, and which points are ground."""
    x, y = scatter(220.0, 4.0)
    hall = (np.abs(x - 110.0) < 60.0) & (np.abs(y - 110.0) < 40.0)
    z = surveyed(x, y, np.where(hall, 170.0 * slope + 9.0, slope * x))
    return Points(x, y, z), ~hall


def terraces(height: float = 1.5, width: float = 12.0) -> Points:
    """Return terraces with upright walls, which are ground throughout."""
    x, y = scatter(100.0, 4.0)
    return Points(x, y, surveyed(x, y, height * np.floor(x / width)))


def dense_canopy(share: float = 0.03) -> tuple[Points, np.ndarray]:
    """Return a closed canopy through which a few points see the ground, and which these are."""
    x, y = scatter(100.0, 4.0)
    random = np.random.default_rng(11)
    ground = random.random(len(x)) < share
    z = surveyed(x, y, 0.15 * x) + np.where(ground, 0.0, random.uniform(12.0, 20.0, len(x)))
    return Points(x, y, z), ground


def error(found: np.ndarray, truth: np.ndarray) -> float:
    """Return the total error in percent."""
    return 100.0 * float(np.mean(found != truth))
