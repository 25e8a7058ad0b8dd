"""The values of the simple morphological filter (SMRF), as those of TIN densification.

References
----------
Pingel, T., Clarke, K., McBride, W. (2013): An improved simple morphological filter for the terrain
classification of airborne LIDAR data. ISPRS Journal 77, 21-30.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..core.parameters import ParameterSet, parameter, parameter_of
from .method import TERRAINS
from .tin import PRESETS, TinDensification

# The window of SMRF is a radius.
_OBJECT_OF_WINDOW = 2.0
# Limits of the iteration angle in degrees and of the tolerances in metres.
_LARGEST_ANGLE, _LARGEST_TOLERANCE = 90.0, 10.0


@dataclass(frozen=True)
class SmrfValues(ParameterSet):
    """Values of SMRF, named and with the defaults as in OpenDroneMap."""

    scalar: float = parameter(
        1.25,
        label="Elevation scalar",
        minimum=0.0,
        maximum=100.0,
        help="Metres that a slope of 45 degrees adds to the threshold in SMRF. Half or twice the"
        " default halves or doubles the ground tolerance on slopes.",
    )
    slope: float = parameter(
        0.15,
        label="Slope tolerance",
        minimum=0.01,
        maximum=10.0,
        help="Rise over run above which SMRF takes a cell for an object. Half or twice the default"
        " halves or doubles the iteration angle. The slope of the terrain itself is measured.",
    )
    threshold: float = parameter(
        0.5,
        label="Elevation threshold",
        unit="m",
        minimum=0.01,
        maximum=50.0,
        help="Largest distance of ground points from the surface in SMRF. Half or twice the default"
        " halves or doubles the ground tolerances.",
    )
    window: float = parameter(
        18.0,
        label="Largest window",
        unit="m",
        minimum=0.5,
        maximum=250.0,
        help="Radius of the largest window. The largest object is twice as wide.",
    )
    preset: str = parameter_of(
        TinDensification,
        "preset",
        choices=TERRAINS,
        help="Gives the values that follow from those of SMRF only in part, and the cell size.",
    )

    def as_tin(self) -> TinDensification:
        """Return the parameters of TIN densification that do about the same."""
        # Only the window has an equal. Of others, the ratio to OpenDroneMap's default counts: the
        # parameter that acts alike gets the value of the preset times this ratio, up to its limit.
        usual, ours = SmrfValues(), TinDensification()
        angle = PRESETS[self.preset].iteration_angle * self.slope / usual.slope
        above, below = (
            min(tolerance * self.threshold / usual.threshold, _LARGEST_TOLERANCE)
            for tolerance in (ours.ground_tolerance, ours.ground_tolerance_below)
        )
        on_slopes = ours.slope_tolerance * self.scalar / usual.scalar
        return TinDensification(
            preset=self.preset,
            max_building_size=_OBJECT_OF_WINDOW * self.window,
            iteration_angle=min(angle, _LARGEST_ANGLE),
            ground_tolerance=above,
            ground_tolerance_below=below,
            slope_tolerance=min(on_slopes, _LARGEST_TOLERANCE),
        )
