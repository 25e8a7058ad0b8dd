"""The pair of the tutorial on change: one real tile in two halves, and changes put into one.

`make demo JOB=change` writes `demo-output/change/`: the halves `old.laz` and `same.laz`, and
`new.laz`, which is `same.laz` with the changes of `PUT`.
"""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import laspy
import numpy as np
from scipy.spatial import cKDTree

from benchmarks.change import shape
from benchmarks.scenes.classes import GROUND

from .land import LANDS

_SEED = 7
_NOISE = 0.02  # metres, of points that get a new height
_STEP = 0.25  # metres between the places at which volumes are summed
_CUT_LEVEL, _CUT_FACE, _FACE = 620.6, 68.0, 1.5  # height, easting and rise over run of the cut bank


class Put(NamedTuple):
    """A change: what it is, the middle in metres from the south-west, and half of its sides."""

    name: str
    x: float
    y: float
    along: float
    across: float

    def offsets(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return how far places lie from the middle."""
        return x - self.x, y - self.y

    def holds(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return which places lie in its rectangle."""
        dx, dy = self.offsets(x, y)
        return (np.abs(dx) <= self.along) & (np.abs(dy) <= self.across)


PIT, HEAP, BANK, SOIL, GRASS, ROOF = PUT = (
    Put("pit", 9.0, 28.0, 4.0, 4.0),
    Put("heap", 14.0, 47.0, 6.0, 6.0),
    Put("cut bank", 64.5, 36.5, 5.5, 5.5),
    Put("thin soil", 62.0, 8.0, 5.0, 4.0),
    Put("grass", 76.0, 9.5, 6.0, 4.5),
    Put("roof", 46.0, 44.0, 4.5, 3.0),
)


def earth(x: np.ndarray, y: np.ndarray, ground: np.ndarray) -> np.ndarray:
    """Return by how much earth was put on places or taken away, given the height of the ground."""
    change = shape("pit", PIT.along, 1.2)(*PIT.offsets(x, y))
    change = change + shape("heap", HEAP.along, 1.8)(*HEAP.offsets(x, y))
    cut = _CUT_LEVEL + _FACE * np.clip(x - _CUT_FACE, 0.0, None)
    change = change + np.where(BANK.holds(x, y), np.minimum(cut - ground, 0.0), 0.0)
    return change + 0.08 * SOIL.holds(x, y)


def write_change(folder: Path) -> list[str]:
    """Write the pair into a folder, which is made if it is missing; return the true volumes."""
    folder.mkdir(parents=True, exist_ok=True)
    las = laspy.read(LANDS["campus"].path)
    xyz = np.asarray(las.xyz) - (*las.header.mins[:2], 0.0)
    known = xyz[np.asarray(las.classification) == GROUND]
    las.classification[:] = 0
    # The file has no GPS times: a pulse begins with its first return.
    pulse = np.cumsum(np.asarray(las.return_number) == 1)
    random = np.random.default_rng(_SEED)
    is_old = (random.random(pulse[-1] + 1) < 0.5)[pulse]
    for name, which in (("old", is_old), ("same", ~is_old)):
        laspy.LasData(las.header, las.points[which].copy()).write(folder / f"{name}.laz")
    new = laspy.LasData(las.header, las.points[~is_old].copy())
    x, y, z = xyz[~is_old].T
    ground = _nearest(known, x, y)
    new.z = _changed(x, y, z, ground, random)
    new.write(folder / "new.laz")
    return _told(known)


def _nearest(known: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the heights of the points that lie nearest to places."""
    return known[cKDTree(known[:, :2]).query(np.column_stack((x, y)))[1], 2]


def _changed(
    x: np.ndarray, y: np.ndarray, z: np.ndarray, ground: np.ndarray, random: np.random.Generator
) -> np.ndarray:
    """Return the heights of points after the changes."""
    after = z + earth(x, y, ground)
    # The excavator takes trees along.
    is_cut = BANK.holds(x, y)
    after[is_cut] -= np.maximum(z - ground, 0.0)[is_cut]
    grass, roof = GRASS.holds(x, y), ROOF.holds(x, y)
    blades = random.uniform(0.1, 0.5, len(x)) * (random.random(len(x)) < 0.8)
    after[grass] += blades[grass]
    ridge = ground[roof].min() + 3.0 + 0.4 * (ROOF.across - np.abs(y[roof] - ROOF.y))
    after[roof] = ridge + random.normal(0.0, _NOISE, len(ridge))
    return after


def _told(known: np.ndarray) -> list[str]:
    """Return the true volume of each change of the earth in words, given points of the ground."""
    told = []
    for put in (PIT, HEAP, BANK, SOIL):
        sides = (
            np.arange(middle - half, middle + half, _STEP) + _STEP / 2
            for middle, half in ((put.x, put.along), (put.y, put.across))
        )
        x, y = map(np.ravel, np.meshgrid(*sides))
        ground = _nearest(known, x, y)
        told.append(f"{put.name:<10}{earth(x, y, ground).sum() * _STEP**2:+7.1f} m3")
    return told
