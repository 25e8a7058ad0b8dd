"""What stands in a landscape: boxes with roofs, decks, wires, trees and low plants."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Callable, NamedTuple, Sequence

import numpy as np

from .classes import BRIDGE, BUILDING

Surface = Callable[[np.ndarray, np.ndarray], np.ndarray]
FLAT, GABLE, VAULT, SHED = range(4)
_CELL = 0.5


class Box(NamedTuple):
    """A rectangle with walls and a roof; a courtyard may be cut out of it.

    Attributes
    ----------
    x, y : float
        Centre.
    length, width, angle : float
        Sides, and the direction of the length in radians.
    base, eaves : float
        Height of the floor, and of the walls above it.
    roof : int
        `FLAT` (with a parapet and machine rooms), `GABLE`, `VAULT` or `SHED` (one slope).
    pitch : float
        Rise over run of the roof; of a vault its rise.
    code : int
        Class of its points.
    court : float
        Share of both sides that a courtyard takes.
    """

    x: float
    y: float
    length: float
    width: float
    angle: float
    base: float
    eaves: float
    roof: int = FLAT
    pitch: float = 0.6
    code: int = BUILDING
    court: float = 0.0


class Boxes:
    """Many boxes that do not overlap, asked for all points at once."""

    def __init__(self, boxes: Sequence[Box]) -> None:
        self._columns = Box(*np.array(boxes, dtype=float).T)
        # The number of the box that a cell of a raster may belong to, -1 for none.
        reach = np.hypot(self._columns.length, self._columns.width) / 2 + 1.0
        places = np.array([self._columns.x, self._columns.y])
        self._low = (places - reach).min(axis=1)
        shape = np.ceil(((places + reach).max(axis=1) - self._low) / _CELL).astype(int) + 1
        self._number = np.full(shape, -1, dtype=np.int32)
        for number, box in enumerate(boxes):
            first = ((places[:, number] - reach[number] - self._low) / _CELL).astype(int)
            last = ((places[:, number] + reach[number] - self._low) / _CELL).astype(int) + 1
            window = tuple(slice(a, b) for a, b in zip(first, last))
            x, y = np.meshgrid(*(np.arange(a, b) for a, b in zip(first, last)), indexing="ij")
            x, y = (x + 0.5) * _CELL + self._low[0], (y + 0.5) * _CELL + self._low[1]
            along, across = _turned(x - box.x, y - box.y, box.angle)
            covered = (np.abs(along) < box.length / 2 + _CELL) & (
                np.abs(across) < box.width / 2 + _CELL
            )
            self._number[window][covered] = number

    def surface(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the height of the roof, minus infinity beside, and the class."""
        heights, codes = np.full(len(x), -np.inf), np.zeros(len(x), dtype=np.uint8)
        column = np.floor((x - self._low[0]) / _CELL).astype(int)
        row = np.floor((y - self._low[1]) / _CELL).astype(int)
        shape = self._number.shape
        near = np.flatnonzero((column >= 0) & (row >= 0) & (column < shape[0]) & (row < shape[1]))
        number = self._number[column[near], row[near]]
        near, number = near[number >= 0], number[number >= 0]
        if not len(near):
            return heights, codes
        box = Box(*(column[number] for column in self._columns))
        along, across = _turned(x[near] - box.x, y[near] - box.y, box.angle)
        heights[near] = _roof(box, along, across)
        codes[near] = box.code
        return heights, codes


def _roof(box: Box, along: np.ndarray, across: np.ndarray) -> np.ndarray:
    half_length, half_width = box.length / 2, box.width / 2
    inside = (np.abs(along) <= half_length) & (np.abs(across) <= half_width)
    inside &= (np.abs(along) > half_length * box.court) | (np.abs(across) > half_width * box.court)
    edge = np.minimum(half_length - np.abs(along), half_width - np.abs(across))
    rooms = (np.abs(np.mod(along, 24.0) - 12.0) < 2.5) & (np.abs(across - box.width / 5) < 2.0)
    flat = 0.5 * (edge < 0.35) + 2.4 * (rooms & (box.width > 14.0))
    gable = box.pitch * (half_width - np.abs(across))
    vault = box.pitch * np.sqrt(np.clip(1.0 - (across / half_width) ** 2, 0.0, 1.0))
    shapes = [box.roof == FLAT, box.roof == GABLE, box.roof == VAULT]
    top = box.base + box.eaves + np.select(shapes, [flat, gable, vault], box.pitch * across)
    return np.where(inside, top, -np.inf)


@dataclass(frozen=True)
class Deck:
    """A bridge: light comes in below it.

    Attributes
    ----------
    x, y, angle : float
        Middle of the deck and its direction.
    length, width : float
        Its sides.
    height : callable
        Height of the deck at distances along it from its middle.
    """

    x: float
    y: float
    angle: float
    length: float
    width: float
    height: Surface
    code: int = BRIDGE

    def covers(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return which places lie on the deck, and the height of its upper side."""
        along, across = _turned(x - self.x, y - self.y, self.angle)
        on = (np.abs(along) <= self.length / 2) & (np.abs(across) <= self.width / 2)
        parapet = 0.9 * (self.width / 2 - np.abs(across) < 0.25)
        return on, self.height(along, across) + parapet


@dataclass(frozen=True)
class Wire:
    """A conductor that sags between two points x, y, z."""

    start: tuple[float, float, float]
    end: tuple[float, float, float]
    sag: float

    def hangs(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the share of the way along the wire, and the distance beside it in metres."""
        start, end = np.array(self.start[:2]), np.array(self.end[:2])
        span = np.hypot(*(end - start))
        east, north = (end - start) / span
        share = ((x - start[0]) * east + (y - start[1]) * north) / span
        return share, np.abs((y - start[1]) * east - (x - start[0]) * north)

    def height(self, share: np.ndarray) -> np.ndarray:
        """Return the height at a share of the way."""
        line = self.start[2] + (self.end[2] - self.start[2]) * share
        return line - 4.0 * self.sag * share * (1.0 - share)


@dataclass(frozen=True)
class Trees:
    """Crowns, as arrays of equal length: place, top above ground, radius, height of the stem.

    Attributes
    ----------
    conifer : bool
        Cones instead of ellipsoids.
    """

    x: np.ndarray
    y: np.ndarray
    height: np.ndarray
    radius: np.ndarray
    stem: np.ndarray
    conifer: bool = False

    def crown(
        self, number: np.ndarray, distance: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return top and bottom above the foot, and thickness as a share of the thickest."""
        height, stem = self.height[number], self.stem[number]
        share = np.clip(distance / self.radius[number], 0.0, 1.0)
        if self.conifer:
            return height - (height - stem) * share, stem, 1.0 - share
        half = (height - stem) / 2 * np.sqrt(1.0 - share**2)
        middle = (height + stem) / 2
        return middle + half, middle - half, np.sqrt(1.0 - share**2)


@dataclass(frozen=True)
class Plants:
    """Low plants: grass, shrubs, crops, understorey.

    Attributes
    ----------
    top : callable
        Height of the plants above ground at each place; 0 where there are none.
    share : float
        Share of the pulses that the plants stop.
    least : float
        Lowest echo, as a share of the height.
    """

    top: Surface
    share: float
    least: float = 0.3


@dataclass(frozen=True)
class Landscape:
    """A terrain and all that stands on it, as functions of the place.

    Attributes
    ----------
    terrain : callable
        Height of the bare earth.
    boxes, decks, wires, trees, plants : tuple
        What stands on it. Boxes of one group do not overlap.
    water : callable, optional
        Where water is: it swallows most pulses.
    missing : callable, optional
        Where the survey has no points.
    stray : tuple of (x, y, z)
        Points far from all others; class 7 or 18.
    echoes : tuple of (x, y, radius, depth)
        Clusters of points below the ground, as multiple reflections make them.
    landform : callable, optional
        Number of the landform at each place, 0 for none, for figures by landform.
    """

    terrain: Surface
    boxes: tuple[Boxes, ...] = ()
    decks: tuple[Deck, ...] = ()
    wires: tuple[Wire, ...] = ()
    trees: tuple[Trees, ...] = ()
    plants: tuple[Plants, ...] = ()
    water: Surface | None = None
    missing: Surface | None = None
    stray: tuple[tuple[float, float, float], ...] = ()
    echoes: tuple[tuple[float, float, float, float], ...] = ()
    landform: Surface | None = None

    def surface(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return height and class (0 for the terrain) of what is solid down to the ground."""
        z, codes = self.terrain(x, y), np.zeros(len(x), dtype=np.uint8)
        for boxes in self.boxes:
            roof, code = boxes.surface(x, y)
            higher = roof > z
            z, codes = np.where(higher, roof, z), np.where(higher, code, codes)
        return z, codes


def _turned(x: np.ndarray, y: np.ndarray, angle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    cos, sin = np.cos(angle), np.sin(angle)
    return x * cos + y * sin, y * cos - x * sin
