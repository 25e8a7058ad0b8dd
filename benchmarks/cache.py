"""Remembers ground masks that take long to make, outside the repository."""

from __future__ import annotations

import hashlib
import os
from pathlib import Path
from typing import Callable

import numpy as np

from bare_earth.algorithms.las.cloud import PointCloud

FOLDER = Path(
    os.environ.get("BARE_EARTH_CACHE", Path.home() / ".cache" / "bare-earth" / "benchmarks")
)


def remembered(
    name: str, cloud: PointCloud, classify: Callable[[PointCloud], np.ndarray]
) -> np.ndarray:
    """Return `classify(cloud)`, from the cache if `name` was asked for these points before.

    Parameters
    ----------
    name : str
        What tells apart this filter, its version and its parameters from all others.
    """
    path = FOLDER / f"{_digest(name, cloud)}.npz"
    if path.exists():
        with np.load(path) as file:
            return np.unpackbits(file["mask"], count=cloud.count).astype(bool)
    mask = classify(cloud)
    FOLDER.mkdir(parents=True, exist_ok=True)
    np.savez(path, mask=np.packbits(mask), name=name, cloud=cloud.path.name)
    return mask


def _digest(name: str, cloud: PointCloud) -> str:
    digest = hashlib.sha256(name.encode())
    digest.update(repr((cloud.scale, cloud.offset)).encode())
    for column in (cloud.x, cloud.y, cloud.z, cloud.return_number, cloud.number_of_returns):
        digest.update(np.ascontiguousarray(column))
    return digest.hexdigest()[:32]
