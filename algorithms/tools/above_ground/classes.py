"""Classes of the points above the ground: vegetation by height, buildings, bridges, high noise."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...core.errors import BareEarthError
from ...core.parameters import ParameterSet, parameter, parameter_of
from ...core.points import Points
from ...core.progress import SILENT, Progress
from ...grids.bridge_decks import bridge_decks
from ...grids.high_groups import HighGroups
from ...tin.height_above_ground import height_above_ground
from .buildings import Buildings

# Classes of the LAS specification.
OTHER = 1
LOW_VEGETATION = 3
MEDIUM_VEGETATION = 4
HIGH_VEGETATION = 5
BUILDING = 6
BRIDGE_DECK = 17
HIGH_NOISE = 18
# Schemes beside those of specifications.
NONE = "none"
OWN = "own"
# Heights in metres at which medium and high vegetation begin.
_LIMITS = {"asprs": (0.5, 2.0), "ign": (0.5, 1.5)}
_SCHEMES = {
    "asprs": "Vegetation low below 0.5 m, medium to 2 m, high above",
    "ign": "Vegetation low below 0.5 m, medium to 1.5 m, high above (IGN)",
    OWN: "Vegetation by limits of your own",
}
# Metres below its lower limit at which a point still counts as above ground: rounding.
_ROUNDING = 1e-6


def _limit(default: float, kind: str, help: str) -> Any:
    """Declare a height at which vegetation begins."""
    return parameter(
        default,
        label=f"Height at which {kind} vegetation begins",
        unit="m",
        minimum=0.0,
        maximum=100.0,
        advanced=True,
        help=help,
    )


@dataclass(frozen=True)
class AboveGround(ParameterSet):
    """Which classes the points above the ground get."""

    above_ground: str = parameter(
        "asprs",
        label="Heights of vegetation",
        choices=_SCHEMES,
        help="What is no building, no bridge and no noise becomes low (3), medium (4) or high (5)"
        " vegetation by its height above ground. The LAS specification has these classes, but no"
        " limits: 0.5 and 2 m are usual. IGN's LiDAR HD has 0.5 and 1.5 m.",
    )
    medium_height: float = _limit(0.5, "medium", "Used only with limits of your own.")
    high_height: float = _limit(2.0, "high", "Used only with limits of your own.")
    low_height: float = _limit(
        0.0, "low", "Points below this height above ground, and points below the ground, become"
        " class 1.",
    )  # fmt: skip
    buildings: bool = parameter(
        True,
        label="Find buildings (6)",
        help="Roofs are planes of some size that a laser pulse meets once. Walls below their edges,"
        " and chimneys and dormers, belong to them.",
    )
    building_area: float = parameter(
        10.0,
        label="Least area of a roof",
        unit="m2",
        minimum=1.0,
        maximum=10_000.0,
        advanced=True,
        help="A building has a plane of at least this area. Smaller planes are found only within"
        " 5 m of a larger one. If this is half as large, tops of conifers become buildings.",
    )
    building_height: float = parameter(
        2.0,
        label="Least height of a roof",
        unit="m",
        minimum=0.5,
        maximum=100.0,
        advanced=True,
        help="Roofs are at least this high above the ground. Lower ones are cars and hedges too.",
    )
    mark_bridges: bool = parameter(
        True,
        label="Find bridges (17)",
        advanced=True,
        help="Decks of bridges, found by their cross-sections. Otherwise they become buildings or"
        " vegetation. Points that have class 17 already keep it.",
    )
    mark_high_noise: bool = parameter(
        True,
        label="Find high noise (18)",
        advanced=True,
        help="Small groups of points that hang at least 10 m above all others of their place:"
        " birds, clouds.",
    )
    reclassify: bool = parameter(
        False,
        label="Classify vegetation and buildings anew",
        help="If this is off, only points of class 0 and 1 change. If it is on, points of class 3"
        " to 6 are decided anew as well. All others keep their class, such as water (9) and wires.",
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        low, medium, high = self.limits
        if not low <= medium <= high:
            raise BareEarthError(
                f"Low vegetation begins at {low:g} m, medium at {medium:g} m and high at {high:g}"
                " m. Give heights that do not decrease."
            )

    @property
    def wanted(self) -> bool:
        """Whether the points above the ground are to be classified at all."""
        return self.above_ground != NONE

    @property
    def limits(self) -> tuple[float, float, float]:
        """The heights in metres at which low, medium and high vegetation begin."""
        own = self.medium_height, self.high_height
        return self.low_height, *_LIMITS.get(self.above_ground, own)

    @property
    def changing(self) -> tuple[int, ...]:
        """The classes that are decided anew."""
        return (0, 1, 3, 4, 5, 6) if self.reclassify else (0, 1)


@dataclass(frozen=True)
class ThenAboveGround(AboveGround):
    """Whether a run that finds the ground also classifies the points above it, and how."""

    above_ground: str = parameter_of(
        AboveGround,
        "above_ground",
        default=NONE,
        label="Classes above the ground",
        choices={NONE: "None: what is not ground has no further class", **_SCHEMES},
        advanced=True,
        help="Classifies the points above the ground as well: low, medium and high vegetation (3,"
        " 4, 5) by height above ground, buildings (6), bridges (17) and high noise (18).",
    )


def classes_above_ground(
    points: Points,
    ground: np.ndarray,  # bool (n,)
    several: np.ndarray,  # bool (n,), points of pulses with several returns
    parameters: AboveGround = AboveGround(),
    progress: Progress = SILENT,
) -> np.ndarray:
    """Return the class of each point, uint8 (n,): 2 for ground, at least one point,
    else 1, 3, 4, 5, 6, 17 or 18.
    """
    heights = height_above_ground(points, ground, progress.part(0.0, 0.4))
    classes = by_height(heights, parameters)
    undecided = ~ground
    if parameters.mark_high_noise:
        high = HighGroups().find(points) & undecided
        classes[high] = HIGH_NOISE
        undecided &= ~high
    progress(0.45)
    if parameters.mark_bridges:
        decks = bridge_decks(points, ground, is_cleared=True) & undecided
        classes[decks] = BRIDGE_DECK
        undecided &= ~decks
    progress(0.6)
    if parameters.buildings:
        rule = Buildings(parameters.building_height, parameters.building_area)
        part = progress.part(0.6, 1.0)
        classes[rule.find(points, heights, undecided, several, part)] = BUILDING
    classes[ground] = 2
    return classes


def by_height(heights: np.ndarray, parameters: AboveGround) -> np.ndarray:
    """Return the classes of vegetation of some heights above ground in metres; uint8, (n,)."""
    limits = np.array(parameters.limits) - _ROUNDING
    classes = np.array([OTHER, LOW_VEGETATION, MEDIUM_VEGETATION, HIGH_VEGETATION], dtype=np.uint8)
    return classes[np.searchsorted(limits, heights, side="right")]
