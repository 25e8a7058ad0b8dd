"""Shaded relief, and slope."""

from __future__ import annotations

from typing import Union

import numpy as np

# Azimuths of the lights of a multidirectional hillshade, in degrees.
_LIGHTS = (225.0, 270.0, 315.0, 360.0)


# Side of a cell in metres, or both sides: along a row, and along a column.
CellSize = Union[float, tuple[float, float]]


def hillshade(
    heights: np.ndarray, cell_size: CellSize, azimuth: float = 315.0, altitude: float = 45.0
) -> np.ndarray:
    """Return the hillshade of a surface in metres, rows from north: uint8, 1 (dark) to 255, 0 for
    NaN; azimuth is clockwise from north, altitude above the horizon.
    """
    # Horn, B. K. P. (1981): Hill shading and the reflectance map. Proceedings of the IEEE 69.
    dx, dy = _gradient(heights, cell_size)
    return as_bytes(heights, _lit(dx, dy, azimuth, altitude))


def multidirectional_hillshade(
    heights: np.ndarray, cell_size: CellSize, altitude: float = 45.0
) -> np.ndarray:
    """Return the hillshade of a surface with lights in the southwest, west, northwest and north, as
    `hillshade` for one light.
    """
    # Each light has most weight on slopes that face it or turn away from it, so that ridges and
    # valleys of any direction stand out.
    # Mark, R. K. (1992): A multidirectional, oblique-weighted, shaded-relief image of the Island of
    # Hawaii. U.S. Geological Survey Open-File Report 92-422. The four lights are his. He weights
    # them by the squared sine of the angle between light and aspect, with the aspect of a smoothed
    # surface: the aspect of each cell would leave little contrast. The weights here (squared
    # cosines) and the altitude are those of ``gdaldem hillshade -multidirectional``.
    dx, dy = _gradient(heights, cell_size)
    # Level land has no aspect, and is equally bright from all sides.
    aspect = np.arctan2(dx, dy)
    # The angles are 45 degrees apart, so that the sum of the weights is 2.
    lit = sum(
        np.cos(aspect - np.radians(azimuth)) ** 2 * _lit(dx, dy, azimuth, altitude) / 2.0
        for azimuth in _LIGHTS
    )
    return as_bytes(heights, lit)


def slope(heights: np.ndarray, cell_size: CellSize) -> np.ndarray:
    """Return the slope of a surface as ``gdaldem slope`` does: float32, 0 (level) to 90 degrees,
    NaN without a height.
    """
    return np.degrees(np.arctan(np.hypot(*_gradient(heights, cell_size)))).astype(np.float32)


def brightness(
    heights: np.ndarray, cell_size: CellSize, azimuth: float, altitude: float
) -> np.ndarray:
    """Return a `hillshade` as numbers from 0 (dark) to 1 (bright); NaN where there is no height."""
    return _lit(*_gradient(heights, cell_size), azimuth, altitude)


def _lit(dx: np.ndarray, dy: np.ndarray, azimuth: float, altitude: float) -> np.ndarray:
    """Return the brightness of slopes in one light, 0 to 1."""
    azimuth, altitude = np.radians(azimuth), np.radians(altitude)
    # The product of the direction of the light and the normal of the surface, without angles.
    lit = np.sin(altitude) - np.cos(altitude) * (dx * np.sin(azimuth) + dy * np.cos(azimuth))
    return np.clip(lit / np.sqrt(1.0 + dx**2 + dy**2), 0.0, 1.0)


def as_bytes(heights: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return values from 0 to 1 as bytes from 1 to 255; 0 where there is no height or value."""
    known = ~np.isnan(heights) & ~np.isnan(values)
    return np.where(known, np.rint(1 + 254 * np.nan_to_num(values)), 0).astype(np.uint8)


def _gradient(heights: np.ndarray, cell_size: CellSize) -> tuple[np.ndarray, np.ndarray]:
    """Return the rise to the east and to the north by Horn's 3 x 3 weights."""
    # A neighbour that is missing lies on the line through the cell and the neighbour opposite, so
    # that the edge of the data is as steep as its inside. If both are missing, they are as high as
    # the cell.
    width, height = cell_size if isinstance(cell_size, tuple) else (cell_size, cell_size)
    padded = np.pad(heights, 1, constant_values=np.nan)
    rows, columns = heights.shape

    def beside(row: int, column: int) -> np.ndarray:
        values, opposite = (
            padded[i : i + rows, k : k + columns] for i, k in ((row, column), (2 - row, 2 - column))
        )
        missing = np.isnan(values)
        if not missing.any():
            return values
        opposite = np.where(np.isnan(opposite), heights, opposite)
        return np.where(missing, 2 * heights - opposite, values)

    northwest, north, northeast = (beside(0, column) for column in range(3))
    west, east = beside(1, 0), beside(1, 2)
    southwest, south, southeast = (beside(2, column) for column in range(3))
    eastward = (northeast + 2 * east + southeast) - (northwest + 2 * west + southwest)
    northward = (northwest + 2 * north + northeast) - (southwest + 2 * south + southeast)
    return eastward / (8 * width), northward / (8 * height)
