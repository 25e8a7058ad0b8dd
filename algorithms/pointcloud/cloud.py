"""A point cloud in memory: the columns that a classification needs, and nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from ..errors import BareEarthError
from ..points import Frame, Points
from .crs import Crs


@dataclass
class PointCloud:
    """The points of one file in file order, 16 bytes each.

    Attributes
    ----------
    path : Path
        Where the points come from.
    x, y, z : numpy.ndarray of int32, shape (n,)
        Coordinates as the file has them.
    scale, offset : tuple of float
        A coordinate in the CRS is the integer times scale plus offset, each for x, y and z.
    classification : numpy.ndarray of uint8, shape (n,)
        Class of each point.
    return_number, number_of_returns : numpy.ndarray of uint8, shape (n,)
        The how manieth of how many returns of its pulse a point is.
    withheld : numpy.ndarray of bool, shape (n,)
        Points that the producer wants left out.
    point_format : int
        LAS point format, 0 to 10.
    crs : Crs
        What is known of the coordinate reference system.
    """

    path: Path
    x: np.ndarray
    y: np.ndarray
    z: np.ndarray
    scale: tuple[float, float, float]
    offset: tuple[float, float, float]
    classification: np.ndarray
    return_number: np.ndarray
    number_of_returns: np.ndarray
    withheld: np.ndarray
    point_format: int
    crs: Crs

    @property
    def count(self) -> int:
        """Number of points."""
        return len(self.x)

    @cached_property
    def _minimum(self) -> tuple[int, int]:
        return int(self.x.min()), int(self.y.min())

    @property
    def frame(self) -> Frame:
        """The local metres of `points`: their origin is the smallest x and the smallest y."""
        origin = tuple(
            minimum * scale + offset
            for minimum, scale, offset in zip(self._minimum, self.scale, self.offset)
        )
        return Frame(origin, self.crs.horizontal_unit, self.crs.vertical_unit, self.crs.wkt)

    def points(self, which: np.ndarray) -> Points:
        """Return coordinates in metres, relative to the origin of `frame`.

        Parameters
        ----------
        which : numpy.ndarray
            Boolean mask or indices of the points to return.

        Raises
        ------
        BareEarthError
            If the CRS is not a projected one.
        """
        self.require_projected()
        # The origin is taken away from the integers: no digit is lost, wherever the survey lies.
        x = self.x[which].astype(np.float64)
        x -= self._minimum[0]
        x *= self.scale[0] * self.crs.horizontal_unit
        y = self.y[which].astype(np.float64)
        y -= self._minimum[1]
        y *= self.scale[1] * self.crs.horizontal_unit
        z = self.z[which] * self.scale[2]
        z += self.offset[2]
        z *= self.crs.vertical_unit
        return Points(x, y, z)

    def require_projected(self) -> None:
        """Refuse coordinates in degrees, on which no distance can be measured.

        Raises
        ------
        BareEarthError
            If the CRS is not a projected one.
        """
        if self.crs.is_geographic:
            raise BareEarthError(
                f"{self.path} is not in a projected CRS ({self.crs.name}), so that nothing can be"
                " measured in it. Reproject it first: in QGIS with 'Reproject' of the group Point"
                " cloud data management, elsewhere with 'pdal translate INPUT OUTPUT reprojection"
                " --filters.reprojection.out_srs=EPSG:...'."
            )
