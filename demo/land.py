"""The real land of the demo: labelled tiles that are in the repository."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

import laspy

_FOLDER = Path(__file__).parents[1] / "tests" / "data" / "real"


class Land(NamedTuple):
    """A tile with its true classes."""

    title: str
    path: Path
    unlabelled: tuple[int, ...] = ()  # classes of points that nobody has labelled


LANDS = {
    "mountain": Land("A mountain with outcrops of rock", _FOLDER / "rock_mountain.laz"),
    "campus": Land("A building with terraces", _FOLDER / "campus_terraces.laz"),
    "court": Land("A city block with a court", _FOLDER / "city_court.laz", (0,)),
}


def write_unclassified(source: Path, target: Path) -> int:
    """Write a cloud with all classes set to 0, and return the number of its points."""
    cloud = laspy.read(source)
    cloud.classification[:] = 0
    cloud.write(str(target))
    return len(cloud.points)
