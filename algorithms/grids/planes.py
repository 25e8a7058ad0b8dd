"""Planes of least squares."""

from __future__ import annotations

import numpy as np


def means_and_moments(total: np.ndarray, *sums: np.ndarray) -> tuple[np.ndarray, ...]:
    """Return the means of x, y and z, and the central second moments xx, xy, yy, xz and yz, given
    the number of points and their sums of x, y, z, xx, xy, yy, xz and yz.
    """
    x, y, z, xx, xy, yy, xz, yz = (column / total for column in sums)
    return x, y, z, xx - x * x, xy - x * y, yy - y * y, xz - x * z, yz - y * z


def plane_slopes(
    xx: np.ndarray, xy: np.ndarray, yy: np.ndarray, xz: np.ndarray, yz: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return how planes rise along x and along y, given the central second moments of their points;
    not finite where these lie on a line.
    """
    determinant = xx * yy - xy * xy
    with np.errstate(divide="ignore", invalid="ignore"):
        return (yy * xz - xy * yz) / determinant, (xx * yz - xy * xz) / determinant
