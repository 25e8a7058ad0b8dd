"""What a classified file holds beside the new classes, and which of its points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet, parameter
from ..core.progress import SILENT, Progress
from ..crs.system import unit_name
from ..las.cloud import PointCloud
from ..las.edits import Edits
from ..las.extrabytes import ExtraDimension

HEIGHT_DIMENSION = "HeightAboveGround"
_INTEGERS = np.iinfo(np.int32)


@dataclass(frozen=True)
class Output(ParameterSet):
    """What is written of a classified cloud."""

    ground_only: bool = parameter(
        False,
        label="Write ground points only",
        help="Writes only the points that have the class of the ground. The log says how many"
        " points are left out.",
    )
    area_only: bool = parameter(
        False,
        label="Write points of the area only",
        advanced=True,
        help="Writes only the points inside the extent and the boundary, and makes the rasters"
        " from them. Files without such points are not written. If this is off, all files are"
        " written with all their points, and points outside keep their class.",
    )
    height_above_ground: bool = parameter(
        False,
        label="Add the height above ground",
        help=f"Adds the extra dimension {HEIGHT_DIMENSION}, the height of each point above the"
        " ground, in the vertical unit of the CRS.",
    )

    @property
    def needs_ground(self) -> bool:
        """Whether there is nothing to write without ground."""
        return self.ground_only or self.height_above_ground

    @property
    def changes_points(self) -> bool:
        """Whether points change in more than their classes."""
        return self.needs_ground or self.area_only

    def check_area(self, is_given: bool) -> None:
        """Refuse to write an area alone where none is given."""
        if self.area_only and not is_given:
            raise BareEarthError(
                "Give an extent or a boundary to write the points of the area only, or write all."
            )

    def edits(
        self,
        cloud: PointCloud,
        classification: np.ndarray,
        ground: np.ndarray | None,
        inside: np.ndarray | None,
        heights: np.ndarray | None = None,
        progress: Progress = SILENT,
    ) -> Edits:
        """Return what is to become other in a cloud.

        Parameters
        ----------
        cloud : PointCloud
            The points as they are.
        classification : numpy.ndarray of uint8, shape (n,)
            Their new classes.
        ground : numpy.ndarray of bool, shape (n,), or None
            Which of them are ground; needed where there is nothing to write without.
        inside : numpy.ndarray of bool, shape (n,), or None
            Which of them lie in the area; needed if only they are written.
        heights : numpy.ndarray of float, shape (n,), optional
            Their heights above ground, if they are wanted.
        progress : Progress
            Receives messages.

        Raises
        ------
        BareEarthError
            If nothing would be left to write, or no height can be measured.
        """
        extra, kept = None, inside if self.area_only else None
        if kept is not None:
            count = np.count_nonzero(~kept)
            progress.info(f"{count:,} points outside of the area are left out of the output.")
        if self.needs_ground and not (ground if kept is None else ground & kept).any():
            raise BareEarthError(
                f"{cloud.path} has no ground points, so there are no ground points to write, and"
                " no heights above ground. Check the parameters and the selection of points."
            )
        if heights is not None:
            extra = height_dimension(cloud, heights)
        if self.ground_only:
            count = np.count_nonzero(~ground if kept is None else kept & ~ground)
            kept = ground if kept is None else kept & ground
            progress.info(f"{count:,} points that are not ground are left out of the output.")
        return Edits(classification=classification, extra=extra, kept=kept)


def height_dimension(cloud: PointCloud, heights: np.ndarray) -> ExtraDimension:
    """Return heights above ground as the dimension that keeps them."""
    unit = unit_name(cloud.crs.vertical_unit)
    return ExtraDimension(
        HEIGHT_DIMENSION, f"Above ground, {unit}", heights.astype(np.float32, copy=False)
    )


def _z_of(cloud: PointCloud, heights: np.ndarray) -> np.ndarray:
    """Return heights as integers of the file's scale and offset.

    Raises
    ------
    BareEarthError
        If they do not fit, or some are not known.
    """
    if np.isnan(heights).any():
        raise BareEarthError(
            f"Some points of {cloud.path} are kilometres from any ground, so that they have no"
            " height above ground. Write the heights as an extra dimension."
        )
    values = np.rint((heights - cloud.offset[2]) / cloud.scale[2])
    if values.min() < _INTEGERS.min or values.max() > _INTEGERS.max:
        raise BareEarthError(
            f"Heights above ground do not fit the scale {cloud.scale[2]:g} and offset"
            f" {cloud.offset[2]:g} of z in {cloud.path}. Write them as an extra dimension."
        )
    return values.astype(np.int32)


def height_edits(cloud: PointCloud, heights: np.ndarray, as_z: bool) -> Edits:
    """Return what becomes other where heights above ground are written.

    Parameters
    ----------
    cloud : PointCloud
        The points, or some of them.
    heights : numpy.ndarray of float, shape (n,)
        In the vertical unit of the CRS, in the order of the file.
    as_z : bool
        Whether they replace z; else they are an extra dimension.

    Raises
    ------
    BareEarthError
        If they do not fit into z.
    """
    if as_z:
        return Edits(z=_z_of(cloud, heights))
    return Edits(extra=height_dimension(cloud, heights))
