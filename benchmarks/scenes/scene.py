"""What a generated scene is, how kinds of scenes are declared, and how they are made."""

from __future__ import annotations

import zlib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Callable, NamedTuple

import numpy as np

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.crs.system import Crs
from bare_earth.algorithms.las.cloud import PointCloud

from .classes import GROUND
from .landscape import Landscape
from .settings import Settings
from .survey import survey

# Where the scenes lie in a projected CRS, and the step of their coordinates, as surveys have it.
ORIGIN = (568_000.0, 5_931_000.0)
SCALE = 0.001


@dataclass(frozen=True)
class Site:
    """What a kind builds from: its settings, its dice, and axes turned at random.

    Coordinates of a site are metres from its middle.
    """

    settings: Settings
    random: np.random.Generator
    angle: float

    @property
    def half(self) -> float:
        """Half the side of the square."""
        return self.settings.size / 2

    def between(self, low: float, high: float) -> float:
        """Return a number drawn evenly."""
        return float(self.random.uniform(low, high))

    def axes(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return coordinates along and across the site's axis."""
        cos, sin = np.cos(self.angle), np.sin(self.angle)
        return x * cos + y * sin, y * cos - x * sin

    def place(self, along: float, across: float) -> tuple[float, float]:
        """Return x and y of what is known along and across."""
        cos, sin = np.cos(self.angle), np.sin(self.angle)
        return along * cos - across * sin, along * sin + across * cos


@dataclass(frozen=True)
class Scene:
    """A survey whose truth is known.

    Attributes
    ----------
    points : Points
        Metres from `ORIGIN`; the square lies somewhere to the north-east of it.
    classes : numpy.ndarray of uint8, shape (n,)
        The true class of every point. Only class 2 is ground; water is 9.
    return_number, number_of_returns : numpy.ndarray of uint8, shape (n,)
        Of the pulse that a point belongs to.
    kind : str
        Name of the kind.
    seed : int
        What it was made from.
    settings : Settings
        What it was made with.
    corner : tuple of float
        x and y of the middle of the square.
    bare_earth : callable
        The true height at x and y, in metres from that middle.
    """

    points: Points
    classes: np.ndarray
    return_number: np.ndarray
    number_of_returns: np.ndarray
    kind: str
    seed: int
    settings: Settings
    corner: tuple[float, float]
    bare_earth: Callable[[np.ndarray, np.ndarray], np.ndarray]

    @property
    def ground(self) -> np.ndarray:
        """Which points are ground, bool of shape (n,)."""
        return self.classes == GROUND

    def terrain(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the true height of the bare earth: below houses, bridges and trees as well."""
        return self.bare_earth(np.asarray(x) - self.corner[0], np.asarray(y) - self.corner[1])

    def cloud(self) -> PointCloud:
        """Return the points as if they had been read from a file, all classes 0."""
        integers = [np.rint(axis / SCALE).astype(np.int32) for axis in self.points]
        count = self.points.count
        return PointCloud(
            Path(f"{self.kind}-{self.seed}.las"), *integers,
            scale=(SCALE,) * 3, offset=(*ORIGIN, 0.0),
            classification=np.zeros(count, dtype=np.uint8),
            return_number=self.return_number, number_of_returns=self.number_of_returns,
            withheld=np.zeros(count, dtype=bool), point_format=6, crs=Crs(),
        )  # fmt: skip


class Kind(NamedTuple):
    """A kind of land, of which every seed makes another piece."""

    name: str
    description: str
    build: Callable[[Site], Landscape]
    defaults: Settings

    def make(self, seed: int, **changes: object) -> Scene:
        """Return the scene of a seed.

        Parameters
        ----------
        seed : int
            Draws where everything lies, how large it is, how the land rolls, and the noise.
        **changes
            Fields of `Settings` that differ from the defaults of the kind.
        """
        settings = replace(self.defaults, **changes)
        landscape, random = self.landscape(seed, settings)
        returns = survey(landscape, settings, random)
        corner = tuple(np.round(random.uniform(200.0, 900.0, 2) + settings.size / 2, 3).tolist())
        moved = (returns.x + corner[0], returns.y + corner[1], returns.z)
        points = Points(*(np.rint(axis / SCALE) * SCALE for axis in moved))
        return Scene(
            points, returns.classes, returns.number, returns.count, self.name, seed, settings,
            corner, landscape.terrain,
        )  # fmt: skip

    def landscape(self, seed: int, settings: Settings) -> tuple[Landscape, np.random.Generator]:
        """Return the land of a seed, which costs little, and the dice to survey it with."""
        random = np.random.default_rng((zlib.crc32(self.name.encode()), seed))
        site = Site(settings, random, float(random.uniform(0, 2 * np.pi)))
        return self.build(site), random


def kind(**defaults: object) -> Callable[[Callable[[Site], Landscape]], Kind]:
    """Make a kind of a function: its name, the first line of its docstring, and the defaults."""

    def declare(build: Callable[[Site], Landscape]) -> Kind:
        description = build.__doc__.splitlines()[0].rstrip(".")
        return Kind(build.__name__, description, build, Settings(**defaults))

    return declare
