"""Survey tiles of any size, written piece by piece: `python -m benchmarks.speed.tiles N FILE`.

Flight lines lie side by side over hills, fields, woods and villages of about 8 points/m². The
points come in the order in which they were measured, with up to four returns of a pulse. Terrain
and objects are functions of the place, so that a piece needs to know nothing of the others.
"""

from __future__ import annotations

import itertools
import os
import sys
from pathlib import Path
from typing import Iterator, NamedTuple

import numpy as np

from .. import cache

DENSITY = 8.0
SEED = 2004

_LINE_WIDTH = 400.0
_FLYING_HEIGHT = 900.0
_PIECE = 250_000
# Places at which the returns of a pulse are counted, to know the size of the square.
_PLACES = 60_000
_ORIGIN = (568_000.0, 5_931_000.0)
# Terrain: wavelength and height in metres of each octave.
_OCTAVES = ((1500.0, 90.0), (400.0, 22.0), (110.0, 4.5), (30.0, 0.8), (7.0, 0.15))
_PLOT, _TREE = 36.0, 6.5
_TABLE = 256


class Tile(NamedTuple):
    """A tile to measure on.

    Attributes
    ----------
    name : str
        As in the tables.
    path : Path
        The file.
    count : int
        Points.
    area : float
        Of its bounding box, in square units of its CRS.
    is_generated : bool
        Whether it belongs to the series of one density.
    """

    name: str
    path: Path
    count: int
    area: float
    is_generated: bool = False

    @property
    def density(self) -> float:
        """Points to a square unit."""
        return self.count / self.area


def tile(path: Path, name: str = "") -> Tile:
    """Return what the header of a file says."""
    import laspy

    with laspy.open(path) as file:
        width, depth = (file.header.maxs - file.header.mins)[:2]
        return Tile(
            name or path.stem, path, file.header.point_count, float(width * depth), bool(name)
        )


def path_of(count: int) -> Path:
    """Return where the generated tile of so many points is kept."""
    return cache.FOLDER / f"speed-{count}-{SEED}.laz"


def title(count: int) -> str:
    """Return how a generated tile is called."""
    return f"{count / 1e6:g} million"


def write(count: int, path: Path, corner: tuple[float, float] = (0.0, 0.0)) -> None:
    """Write a survey of exactly so many points in bounded memory.

    Parameters
    ----------
    count : int
        Number of points.
    path : Path
        The LAZ file; it gets its name when it is complete.
    corner : tuple of float
        Metres by which it lies farther east and north: other land, and a tile of a larger survey.
    """
    import laspy

    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = np.full(3, 0.001), np.array([*_ORIGIN, 0.0])
    header.generating_software = "Bare Earth benchmark"
    path.parent.mkdir(parents=True, exist_ok=True)
    unfinished = path.with_name(f"unfinished-{os.getpid()}-{path.name}")
    missing = count
    with laspy.open(
        unfinished, "w", header=header, laz_backend=laspy.LazBackend.LazrsParallel
    ) as file:
        pieces = survey(count, corner)
        while missing:
            columns = next(pieces)
            kept = min(len(columns["x"]), missing)
            record = laspy.ScaleAwarePointRecord.zeros(kept, header=header)
            for name, values in columns.items():
                record[name] = values[:kept]
            file.write_points(record)
            missing -= kept
    unfinished.replace(path)


def survey(count: int, corner: tuple[float, float] = (0.0, 0.0)) -> Iterator[dict[str, np.ndarray]]:
    """Yield pieces of a survey of a square, as columns of a LAS file, without an end.

    The square holds about so many points; after it, the last flight line goes on.
    """
    landscape = Landscape(np.random.default_rng(SEED))
    side = np.sqrt(count / DENSITY)
    lines = max(round(side / _LINE_WIDTH), 1)
    spacing = np.sqrt(_returns(landscape, side) / DENSITY)
    width, across, length = side / lines, round(side / lines / spacing), round(side / spacing)
    rows = max(_PIECE // across, 1)
    for line in range(lines):
        is_last = line == lines - 1
        for start in itertools.count(0, rows) if is_last else range(0, length, rows):
            random = np.random.default_rng((SEED, line, start))
            end = start + rows if is_last else min(start + rows, length)
            row = np.repeat(np.arange(start, end), across)
            column = np.tile(np.arange(across), end - start)
            x = (column + random.uniform(0.1, 0.9, len(row))) * width / across + line * width
            y = (row + random.uniform(0.1, 0.9, len(row))) * spacing + corner[1]
            pulse = row.astype(np.float64) * across + column
            slant = (x - (line + 0.5) * width) / _FLYING_HEIGHT
            x += corner[0]
            yield _columns(landscape.echoes(x, y, random), x, y, pulse, slant, line, random)


def _returns(landscape: Landscape, side: float) -> float:
    """Return how many returns a pulse has on average over a square."""
    random = np.random.default_rng(SEED)
    x, y = random.uniform(0.0, side, (2, _PLACES))
    return len(landscape.echoes(x, y, random)[0]) / _PLACES


def _columns(echoes, x, y, pulse, slant, line, random) -> dict[str, np.ndarray]:
    """Return the returns of pulses as columns, in the order of time."""
    owner, z = echoes
    order = np.lexsort((-z, owner))
    owner, z = owner[order], z[order]
    first = np.flatnonzero(np.diff(owner, prepend=-1))
    counts = np.diff(first, append=len(owner))
    number = np.arange(len(owner)) - np.repeat(first, counts) + 1
    total = np.repeat(counts, counts)
    return {
        # What stands higher is met earlier, which slanting pulses do farther inwards.
        "x": _ORIGIN[0] + x[owner] - slant[owner] * (z - 100.0) * 0.1,
        "y": _ORIGIN[1] + y[owner],
        "z": z + random.normal(0.0, 0.025, len(z)),
        "return_number": number.astype(np.uint8),
        "number_of_returns": total.astype(np.uint8),
        "intensity": (random.gamma(9.0, 90.0, len(z)) / total).astype(np.uint16),
        "gps_time": 2.0e8 + line * 300.0 + pulse[owner] * 2e-6,
        "point_source_id": np.full(len(z), line + 1, dtype=np.uint16),
        "scan_angle": np.rint(np.degrees(np.arctan(slant[owner])) / 0.006).astype(np.int16),
        "classification": np.ones(len(z), dtype=np.uint8),
    }


class Landscape:
    """Terrain, houses and trees as functions of the place, from tables that repeat."""

    def __init__(self, random: np.random.Generator) -> None:
        self._noise = random.uniform(-1.0, 1.0, (_TABLE, _TABLE))
        self._plots = random.random((_TABLE, _TABLE, 5))
        self._trees = random.random((_TABLE, _TABLE, 5))

    def echoes(
        self, x: np.ndarray, y: np.ndarray, random: np.random.Generator
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return pulse and height of each return."""
        solid = self.solid(x, y)
        top, bottom = self.crown(x, y, solid)
        high = np.flatnonzero(top - bottom > 0.5)
        owners, heights = [], []
        for share in (0.0, 0.45, 0.8):
            met = high[random.random(len(high)) < (0.9 - share)]
            depth = share + random.uniform(0.0, 0.2, len(met))
            owners.append(met)
            heights.append(top[met] - depth * (top - bottom)[met])
        through = np.ones(len(x), dtype=bool)
        through[owners[0]] = random.random(len(owners[0])) < 0.6
        through[np.concatenate(owners[1:])] |= random.random(sum(map(len, owners[1:]))) < 0.3
        through[np.setdiff1d(high, np.concatenate(owners))] = True
        # Grass and shrubs, and now and then an echo far below or above.
        wild = np.clip(self._value(x, y, 60.0) * 1.5, 0.0, 0.6)
        lifted = random.random(len(x)) < wild
        solid = solid + lifted * random.gamma(2.0, 0.12, len(x))
        odd = random.random(len(x))
        solid = solid - (odd < 1e-5) * 6.0 + (odd > 1.0 - 1e-5) * 60.0
        owners.append(np.flatnonzero(through))
        heights.append(solid[through])
        return np.concatenate(owners), np.concatenate(heights)

    def terrain(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the height of the bare earth."""
        z = np.full(len(x), 200.0)
        for length, height in _OCTAVES:
            z += height * self._value(x, y, length)
        return z

    def solid(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """Return the height of what no leaf stops: the terrain, or a gable roof over it."""
        i, j = np.floor(x / _PLOT).astype(int), np.floor(y / _PLOT).astype(int)
        chance, length, width, height, turned = np.moveaxis(
            self._plots[i % _TABLE, j % _TABLE], -1, 0
        )
        east, north = (i + 0.5) * _PLOT, (j + 0.5) * _PLOT
        along, across = np.abs(x - east), np.abs(y - north)
        along, across = np.where(turned < 0.5, (along, across), (across, along))
        half_length, half_width = 5.0 + 10.0 * length, 4.0 + 5.0 * width
        is_village = self._value(east, north, 700.0) > 0.15
        is_house = is_village & (chance < 0.7) & (along < half_length) & (across < half_width)
        z = self.terrain(x, y)
        roof = 3.0 + 6.0 * height + 0.6 * (half_width - across)
        z[is_house] = self.terrain(east[is_house], north[is_house]) + roof[is_house]
        return z

    def crown(
        self, x: np.ndarray, y: np.ndarray, solid: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return top and bottom of the crown over each place, equal where there is none."""
        i, j = np.floor(x / _TREE).astype(int), np.floor(y / _TREE).astype(int)
        chance, size, tall, dx, dy = np.moveaxis(self._trees[i % _TABLE, j % _TABLE], -1, 0)
        radius = 1.4 + 1.8 * size
        east = (i + 0.5) * _TREE + (dx - 0.5) * (_TREE - 2.0 * radius)
        north = (j + 0.5) * _TREE + (dy - 0.5) * (_TREE - 2.0 * radius)
        share = np.hypot(x - east, y - north) / radius
        wood = self._value(east, north, 350.0)
        is_tree = (chance < np.where(wood > 0.1, 0.9, 0.05)) & (share < 1.0)
        height = 6.0 + 16.0 * tall
        half = 0.35 * height * np.sqrt(np.clip(1.0 - share**2, 0.0, 1.0)) * is_tree
        middle = solid + 0.65 * height
        return middle + half, middle - half

    def _value(self, x: np.ndarray, y: np.ndarray, length: float) -> np.ndarray:
        """Return smooth noise from -1 to 1 of one wavelength."""
        x, y = x / length + 0.37 * length, y / length + 0.61 * length
        i, j = np.floor(x).astype(int), np.floor(y).astype(int)
        u, v = x - i, y - j
        u, v = u * u * (3.0 - 2.0 * u), v * v * (3.0 - 2.0 * v)
        i, j, right, up = i % _TABLE, j % _TABLE, (i + 1) % _TABLE, (j + 1) % _TABLE
        low = self._noise[i, j] * (1 - u) + self._noise[right, j] * u
        high = self._noise[i, up] * (1 - u) + self._noise[right, up] * u
        return low * (1 - v) + high * v


if __name__ == "__main__":
    write(int(sys.argv[1]), Path(sys.argv[2]))
