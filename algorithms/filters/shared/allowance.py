"""How high something may stand out of its surroundings and still be terrain."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np


@dataclass(frozen=True)
class Allowance:
    """How high something may stand out of an opening's window and still be terrain.

    Attributes
    ----------
    base : float
        Height in metres, whatever the window.
    per_radius : float
        What each metre of the window's radius adds, in metres.
    per_slope : float
        What each metre of the radius adds on a slope of 45 degrees (in proportion on others).
    largest : float
        No allowance is larger, in metres.
    gentle_step : float
        A step between cells of up to a metre that is not an edge, in metres, on top of the
        terrain's own rise; in proportion between larger cells.
    gentle_share : float
        Share of the border of a region that must be gentle for it to be terrain.
    gentle_area : float
        Smallest region, in square metres, that may be terrain for that reason.
    wide_share, wide_area : float
        The share level with the ground that suffices for regions of so many square metres or more:
        a plateau that a ramp joins with the ground. From the area of a house on, the share falls
        to this one with the logarithm of the area.
    usual_window : float
        Radius in metres of windows up to which all of this holds; larger ones are for halls.
    hall_height : float
        Larger windows cut off only what is higher by so many metres.
    hall_per_slope : float
        What each metre of their radius adds on a slope of 45 degrees, in metres: where the
        contours of a steep slope bend, a wide window cuts off the slope.
    rise_counts : bool
        Whether a border that rises to the ground counts as a gentle one: the tread of a terrace.
    border_area : float
        A region of so many square metres or more is terrain as well where much of its border is
        that of the survey: too little is known of it.
    border_height : float
        But not if it stands so many metres above the ground, on average: the border of the survey
        cuts buildings.
    island_area : float
        What is left within a region, level with it and no larger in square metres, is part of it:
        an opening cuts off most of a wide roof on a slope, but not all.
    rock_area, ramp_area, link_area : float
        A region of so many square metres or more is terrain as well if it has the shape of a rock,
        of a long ramp, or of a ramp between two levels.
    follows_slopes : bool
        Whether a step between cells is no edge where those before or after it are as high: a
        steep slope, or a cliff, of which points lie on the face; or where the terrain at large
        rises as much.
    slopes_taken : int
        How often the slope of the terrain is taken, each time from what was not cut off before.
    judges_gaps : bool
        Whether cells without a point are told apart as well: they are raised where what fills them
        is, and beyond the survey they are no border.
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
    island_area: float = 200.0
    rock_area: float = 200.0
    ramp_area: float = 100.0
    link_area: float = 40.0
    rise_counts: bool = True
    follows_slopes: bool = True
    slopes_taken: int = 2
    judges_gaps: bool = True

    def for_cells(self, size: float) -> Allowance:
        """Return what is allowed between cells whose side is `size` metres."""
        return replace(self, gentle_step=self.gentle_step * max(size, 1.0))


# For presets of other programs: large windows and slopes are treated as all others.
CLASSIC = Allowance(
    gentle_share=0.5,
    wide_share=0.5,
    usual_window=1e9,
    border_area=np.inf,
    island_area=0.0,
    rock_area=np.inf,
    ramp_area=np.inf,
    link_area=np.inf,
    rise_counts=False,
    follows_slopes=False,
    slopes_taken=1,
    judges_gaps=False,
)
