"""Measures what OpenDroneMap would get in place of SMRF: `python -m benchmarks.odm`.

Points from images: the one real tile that is labelled, and generated scenes, as they are and
without outliers, most of which OpenDroneMap removes before (`--pc-filter`). Prints type I, type II
and total error in percent and the seconds that it took. The peers are those of `benchmarks.peers`
that are installed: SMRF in Python with the window of OpenDroneMap, and CSF.
"""

from __future__ import annotations

import time
from typing import Iterator, NamedTuple

import numpy as np

from bare_earth.algorithms.filters.smrf import SmrfValues
from bare_earth.algorithms.las.cloud import PointCloud

from . import data
from .measure import Filter, GroundFilter
from .peers import Cloth, WideMorphological
from .scenes import REPORTING_SEEDS, make

_TILE = "yard_photogrammetry.laz"
_SCENES = ("earthworks_images", "photogrammetry", "drone_images")
_CLEAN = {"low_outliers": 0.0, "low_tail": 0.0}


class Cloud(NamedTuple):
    """A cloud and which of its points are ground."""

    name: str
    cloud: PointCloud
    truth: np.ndarray


class Odm(Filter):
    """What `bare-earth odm` does with the defaults of OpenDroneMap."""

    def __init__(self, preset: str) -> None:
        super().__init__("tin-densification", **vars(SmrfValues(preset=preset).as_tin()))
        self.name = f"odm, preset {preset}"


def clouds() -> Iterator[Cloud]:
    """Yield the real tile, if it is here, and the scenes."""
    if data.real(_TILE).exists():
        cloud, reference = data.load(data.real(_TILE))
        yield Cloud("yard_photogrammetry", cloud, reference == 2)
    for kind in _SCENES:
        for words, changes in (("", {}), (", no outliers", _CLEAN)):
            for seed in REPORTING_SEEDS:
                scene = make(kind, seed, **changes)
                yield Cloud(f"{kind} {seed}{words}", scene.cloud(), scene.ground)


def main() -> None:
    """Print the table."""
    peers = [peer for peer in (WideMorphological(), Cloth()) if peer.is_installed]
    filters: list[GroundFilter] = [Odm("automatic"), Odm("site"), *peers]
    print("| Cloud | Points | Filter | Type I | Type II | Total | Seconds |\n|" + "---|" * 7)
    for name, cloud, truth in clouds():
        for tried in filters:
            begun = time.perf_counter()
            found = tried.ground(cloud)
            seconds = time.perf_counter() - begun
            shares = (~found[truth], found[~truth], found != truth)
            figures = " | ".join(f"{100.0 * wrong.mean():.2f}" for wrong in shares)
            print(
                f"| {name} | {cloud.count:,} | {tried.name} | {figures} | {seconds:.1f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
