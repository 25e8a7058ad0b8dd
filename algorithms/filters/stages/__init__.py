"""The rules of the ground filters by stages, and the pipeline that all methods share."""

from __future__ import annotations

from ..pipeline import Pipeline, Rule
from .accept import NearSurface
from .below_land import BelowLand
from .breaks import Edges, LevelSeeds, Plants
from .bunds import Bunds
from .low_noise import BelowWater, LowGroups
from .objects import RaisedObjects
from .opening import ProgressiveOpening
from .outliers import DenseOutliers, IsolatedLowPoints, NarrowPits
from .seeds import LowestPoints, Woods
from .shrubs import Shrubs
from .terrain import SITE, GentleRegions
from .tolerance import ToleranceSurface


def shared_pipeline(
    lowest: LowestPoints,
    size: float,  # metres, of the largest object
    tolerance: ToleranceSurface,
    seeds: tuple[Rule, ...],
    plants: Plants,
    is_site: bool,
    regions: GentleRegions = GentleRegions(),
    objects: Rule | None = None,
    opening: tuple[Rule, ...] = (),
    surface: tuple[Rule, ...] = (),
    accepted: tuple[Rule, ...] = (),
) -> Pipeline:
    """Return the rules that all methods share, with those of one method among them."""
    return Pipeline(
        (
            lowest,
            Woods(),
            DenseOutliers(),
            BelowWater(),
            LowGroups(),
            BelowLand(),
            NarrowPits(),
            IsolatedLowPoints(),
            objects or RaisedObjects(size),
            ProgressiveOpening(size / 2.0),
            *opening,
            SITE if is_site else regions,
            *seeds,
            plants,
            # Heaps of a site are as wide as shrubs, and as high.
            *(() if is_site else (Shrubs(),)),
            *(() if is_site else (Bunds(),)),
            LevelSeeds(),
            *surface,
            tolerance,
            NearSurface(),
            Edges(),
            *accepted,
        )
    )
