"""A point cloud in memory: the columns that a classification needs, and nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from ..errors import BareEarthError
from ..points import Frame, Points
from ..progress import SILENT
from ..threads import over_parts
from .crs import Crs

_POINTS_A_PART = 1 << 17
# Share of the scale by which offsets may differ from a multiple of it: they are rounded numbers.
_WHOLE = 0.01


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
    records : numpy.ndarray of uint8, shape (n, record length), optional
        The points as the file has them, where they were kept to be written again.
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
    records: np.ndarray | None = None

    @property
    def count(self) -> int:
        """Number of points."""
        return len(self.x)

    @cached_property
    def lowest(self) -> tuple[int, int]:
        """The smallest x and y, as integers."""
        return int(self.x.min()), int(self.y.min())

    @cached_property
    def highest(self) -> tuple[int, int]:
        """The largest x and y, as integers."""
        return int(self.x.max()), int(self.y.max())

    @property
    def frame(self) -> Frame:
        """The local metres of `points`: their origin is the smallest x and the smallest y."""
        origin = tuple(
            minimum * scale + offset
            for minimum, scale, offset in zip(self.lowest, self.scale, self.offset)
        )
        return Frame(origin, self.crs.horizontal_unit, self.crs.vertical_unit, self.crs.wkt)

    def points(self, which: np.ndarray | slice, frame: Frame | None = None) -> Points:
        """Return coordinates in metres, relative to the origin of a frame.

        Parameters
        ----------
        which : numpy.ndarray or slice
            Boolean mask or indices of the points to return.
        frame : Frame, optional
            The frame of a survey of which this file is a part; `frame` if none is given. Files of
            one scale give equal numbers for equal places, whatever their offsets.

        Raises
        ------
        BareEarthError
            If the CRS is not a projected one.
        """
        self.require_projected()
        if isinstance(which, np.ndarray) and which.dtype == bool:
            which = np.flatnonzero(which)
        origin = (*(self.frame if frame is None else frame).origin, 0.0)
        units = (self.crs.horizontal_unit, self.crs.horizontal_unit, self.crs.vertical_unit)
        return Points(
            *(
                _metres(values, which, scale, offset - start, unit)
                for values, scale, offset, start, unit in zip(
                    (self.x, self.y, self.z), self.scale, self.offset, origin, units
                )
            )
        )

    def bounds(self, frame: Frame) -> tuple[float, float, float, float]:
        """Return smallest x and y, largest x and y in metres of a frame, as `points` has them."""
        corners = np.array([self.lowest, self.highest])
        west, east, south, north = (
            float(metres)
            for axis in (0, 1)
            for metres in _metres(
                corners[:, axis],
                slice(None),
                self.scale[axis],
                self.offset[axis] - frame.origin[axis],
                self.crs.horizontal_unit,
            )
        )
        return west, south, east, north

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


def _metres(
    integers: np.ndarray, which: np.ndarray | slice, scale: float, offset: float, unit: float
) -> np.ndarray:
    """Return coordinates in metres.

    The offset is added to the integers where it is a multiple of the scale: no digit is lost,
    wherever the survey lies.
    """
    whole = float(np.rint(offset / scale))
    rest = offset - whole * scale
    if isinstance(which, slice):
        integers, which = integers[which], None
    metres = np.empty(len(integers) if which is None else len(which))

    def convert(part: slice) -> None:
        some = metres[part]
        some[:] = integers[part] if which is None else integers[which[part]]
        some += whole
        some *= scale * unit
        if abs(rest) > _WHOLE * scale:
            some += rest * unit

    over_parts(convert, len(metres), _POINTS_A_PART, SILENT)
    return metres
