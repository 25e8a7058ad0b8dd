"""How high something may stand out of its surroundings and still be terrain."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np


@dataclass(frozen=True)
class Allowance:
    """How much openings may cut off terrain, and which raised regions are terrain after all.

    Attributes
    ----------
    base : float
        Height in metres for any window.
    per_radius : float
        Metres that each metre of the window's radius adds.
    per_slope : float
        Metres that each metre of the radius adds on a slope of 45 degrees; in proportion on others.
    largest : float
        The largest allowance in metres.
    gentle_step : float
        Largest step between cells, in metres beyond the terrain's own rise, that is not an edge. It
        is for cells of up to 1 m, and in proportion larger for larger cells.
    gentle_share : float
        Share of the border of a region that must be gentle for it to be terrain.
    gentle_area : float
        Least area of such a region in square metres.
    wide_share, wide_area : float
        Regions of at least this area in square metres are terrain if this share of their border is
        level with the ground: a plateau with a ramp. From the area of a house on, the share falls
        to this one with the logarithm of the area.
    usual_window : float
        Largest radius in metres of the windows for which all this holds; larger windows are for
        halls.
    hall_height : float
        Least height in metres that larger windows cut off.
    hall_per_slope : float
        Metres that each metre of their radius adds to it on a slope of 45 degrees: a wide window
        cuts off a steep slope where its contours bend.
    rise_counts : bool
        Whether a border that rises to the ground counts as gentle, as at the tread of a terrace.
    border_area : float
        A region of at least so many square metres is terrain as well if much of its border is the
        border of the survey, because too little is known of it.
    border_height : float
        Such a region is no terrain if its mean height above the ground, in metres, is larger: it
        may be a building cut by the border of the survey.
    rock_area, ramp_area : float
        A region of at least so many square metres is terrain as well if it has the shape of a rock
        or of a long ramp.
    follows_slopes : bool
        Whether a step between cells is no edge if the steps before or after it are as high (a steep
        slope, or a cliff with points on its face).
    knows_ditches : bool
        Whether even land between narrow ditches is terrain, although it drops on all sides.
    judges_gaps : bool
        Whether cells without a point are judged as well. They are raised if their filled height is,
        and outside the survey they are no border.
    """

    base: float = 0.15
    per_radius: float = 0.04
    per_slope: float = 0.2
    largest: float = 1.5
    gentle_step: float = 0.3
    gentle_share: float = 0.3
    gentle_area: float = 20.0
    wide_share: float = 0.05
    wide_area: float = 3000.0
    usual_window: float = 24.0
    hall_height: float = 2.5
    hall_per_slope: float = 0.1
    border_area: float = 800.0
    border_height: float = 4.5
    rock_area: float = 200.0
    ramp_area: float = 100.0
    rise_counts: bool = True
    follows_slopes: bool = True
    knows_ditches: bool = True
    judges_gaps: bool = True

    def for_cells(self, size: float) -> Allowance:
        """Return the allowance for cells of `size` metres."""
        return replace(self, gentle_step=self.gentle_step * max(size, 1.0))


# For presets of other programs, without rules for large windows and steep slopes.
CLASSIC = Allowance(
    gentle_share=0.5,
    wide_share=0.5,
    usual_window=1e9,
    border_area=np.inf,
    rock_area=np.inf,
    ramp_area=np.inf,
    rise_counts=False,
    follows_slopes=False,
    knows_ditches=False,
    judges_gaps=False,
)
