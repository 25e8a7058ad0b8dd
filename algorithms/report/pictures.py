"""Pictures of points for a page: a relief with marked points."""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from typing import Sequence

import numpy as np

from ..core.points import Points
from ..grids.cells import lower_at
from ..grids.inpaint import inpaint
from ..relief.hillshade import hillshade

LONGEST_SIDE = 900
# Side of a pixel in mean distances between points, so that most pixels have a point.
_SPACINGS = 1.2
_GAP = 3  # distance in pixels from one with points up to which empty pixels are shaded
_FAINTEST = 0.55  # least weight of the colour of a mark, so that single marked points are visible
_DARKEST = 120  # darkest grey, on which the colours are still visible
# Colours of heights, from the lowest to the highest, and where there is no value.
HEIGHTS = ("#33664d", "#9ab87a", "#e8dfa8", "#b9855a", "#f4f4f4")
NOWHERE = "#ffffff"


@dataclass(frozen=True)
class Picture:
    """A map."""

    pixels: np.ndarray  # uint8, (rows, columns, 3): red, green and blue, from north to south
    cell_size: float  # metres


@dataclass(frozen=True)
class Relief:
    """The shaded relief of the highest points."""

    place: np.ndarray  # int64, (n,): pixel of each point, counted row by row from the northwest
    shade: np.ndarray  # float64, (rows, columns): grey, 0 to 255; white far from points
    cell_size: float  # metres

    @classmethod
    def of(cls, points: Points, longest_side: int = LONGEST_SIDE) -> Relief:
        """Return the relief of points, at least one, at most `longest_side` pixels long."""
        width, height = points.sides
        spacing = _SPACINGS * np.sqrt(width * height / points.count)
        cell = max(spacing, max(width, height) / longest_side) or 1.0
        shape = int(height / cell) + 1, int(width / cell) + 1
        column = ((points.x - points.box[0]) / cell).astype(np.int64)
        row = ((points.box[3] - points.y) / cell).astype(np.int64)
        place = row * shape[1] + column
        return cls(place, _shade(place, points.z, shape, cell), float(cell))

    def marked(
        self,
        first: np.ndarray,
        second: np.ndarray,
        colours: tuple[str, str],
        counted: np.ndarray | None = None,
    ) -> Picture:
        """Return the relief with points marked in two colours, such as ``#d1157f``; a pixel has the
        colour of the more frequent mark, stronger for a larger share of the counted points.
        """
        of_first, of_second = self._counts(first), self._counts(second)
        every = self._counts(np.ones(len(first), dtype=bool) if counted is None else counted)
        share = (of_first + of_second) / np.maximum(every, 1)
        weight = np.where(share > 0, _FAINTEST + (1 - _FAINTEST) * share, 0)[..., None]
        colour = np.where((of_first >= of_second)[..., None], *map(rgb, colours))
        pixels = weight * colour + (1 - weight) * self.shade[..., None]
        return Picture(np.rint(pixels).astype(np.uint8), self.cell_size)

    def _counts(self, points: np.ndarray) -> np.ndarray:
        counts = np.bincount(self.place[points], minlength=self.shade.size)
        return counts.reshape(self.shade.shape)


def _shade(place: np.ndarray, z: np.ndarray, shape: tuple[int, int], cell: float) -> np.ndarray:
    from scipy import ndimage

    lowest = np.full(shape[0] * shape[1], np.inf)
    lower_at(lowest, place, -z)  # negative, for the highest points
    heights = np.where(np.isinf(lowest), np.nan, -lowest).reshape(shape)
    near = ndimage.binary_dilation(np.isfinite(heights), np.ones((3, 3)), _GAP)
    light = _DARKEST + (255 - _DARKEST) * (hillshade(inpaint(heights), cell) / 255.0)
    return np.where(near, light, 255.0)


def ramped(values: np.ndarray, colours: Sequence[str], low: float, high: float) -> np.ndarray:
    """Return the pixels of values, uint8 (rows, columns, 3), coloured by a ramp of colours such as
    ``#d1157f`` from `low` to `high`; NaN for none.
    """
    ramp = np.array([rgb(colour) for colour in colours], dtype=np.float64)
    share = np.clip((np.nan_to_num(values, nan=low) - low) / (high - low), 0.0, 1.0)
    places = np.linspace(0.0, 1.0, len(ramp))
    pixels = np.stack([np.interp(share, places, ramp[:, band]) for band in range(3)], axis=-1)
    pixels[np.isnan(values)] = rgb(NOWHERE)
    return np.rint(pixels).astype(np.uint8)


def reduced(values: np.ndarray, step: int, is_worst: bool = False) -> np.ndarray:
    """Return the mean, or the greatest value if `is_worst`, of squares of `step` x `step` cells,
    without NaN.
    """
    rows, columns = values.shape
    padded = np.pad(values, ((0, -rows % step), (0, -columns % step)), constant_values=np.nan)
    height, width = padded.shape
    squares = padded.reshape(height // step, step, width // step, step)
    known = ~np.isnan(squares)
    count = known.sum(axis=(1, 3))
    if is_worst:
        found = np.where(known, squares, -np.inf).max(axis=(1, 3))
    else:
        found = np.where(known, squares, 0.0).sum(axis=(1, 3)) / np.maximum(count, 1)
    return np.where(count > 0, found, np.nan)


def rgb(colour: str) -> tuple[int, ...]:
    """Return red, green and blue of a colour such as ``#d1157f``."""
    return tuple(bytes.fromhex(colour[1:]))


def png(pixels: np.ndarray) -> bytes:
    """Return a picture, uint8 (rows, columns, 3) in red, green and blue, as PNG."""
    # ISO/IEC 15948:2004: Portable Network Graphics, sections 5.3, 11.2.2 and 12.8.
    rows, columns, _ = pixels.shape

    def chunk(kind: bytes, data: bytes) -> bytes:
        check = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)

    # Each row begins with the number of its filter, 0 for none.
    lines = np.zeros((rows, 1 + 3 * columns), np.uint8)
    lines[:, 1:] = pixels.reshape(rows, -1)
    # Eight bits, RGB (2); the zeros are the only methods of compression, filtering and interlacing.
    header = struct.pack(">IIBBBBB", columns, rows, 8, 2, 0, 0, 0)
    data = zlib.compress(lines.tobytes(), 6)
    signature = b"\x89PNG\r\n\x1a\n"
    return signature + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")
