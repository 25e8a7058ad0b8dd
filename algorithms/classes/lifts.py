"""How far answers lift the terrain of their places, as far as the layer says how high it was."""

from __future__ import annotations

import numpy as np

from ..core.progress import Progress
from ..las.cloud import PointCloud
from ..survey.area import Area
from .corrections import CONTINUED, Corrections

# Fields of the places to review: the highest cell of the terrain, and its largest expected error.
HIGH = "HIGH"
ERROR = "ERROR"
_RANK = "RANK"
_SHARE = 0.95  # of the ground points of a place lie below its new height
_MOST_TOLD = 10


class Lifts:
    """Compares the ground points in corrected places with the terrain that these had before."""

    def __init__(self, corrections: Corrections, ground_class: int) -> None:
        polygons, codes, numbers = corrections.effects
        self._places = [
            (polygon, corrections.values[number])
            for polygon, code, number in zip(polygons, codes, numbers)
            if code in (ground_class, CONTINUED) and HIGH in corrections.values[number]
        ]
        self._tops: dict[int, float] = {}  # units of the CRS, by the number of the place
        self._unit = 1.0

    def see(self, part: PointCloud, ground: np.ndarray) -> None:
        """Note how high the ground points of a part lie in each place."""
        if not self._places:
            return
        self._unit = part.crs.vertical_unit
        chosen = np.flatnonzero(ground)
        some = part.take(chosen)
        numbers = Area(None, tuple(polygon for polygon, _ in self._places)).polygon_of(some)
        heights = some.z * part.scale[2] + part.offset[2]
        for number in np.unique(numbers[numbers > 0]).tolist():
            top = float(np.quantile(heights[numbers == number], _SHARE))
            self._tops[number] = max(self._tops.get(number, top), top)

    def report(self, progress: Progress) -> None:
        """Warn of places that lie higher by more than their expected error."""
        found = []
        for number, top in self._tops.items():
            values = self._places[number - 1][1]
            lift = (top - float(values[HIGH])) * self._unit
            expected = float(values.get(ERROR, 0.0))
            if lift > expected:
                found.append((lift, expected, values.get(_RANK, number)))
        found.sort(key=lambda one: -one[0])
        for lift, expected, rank in found[:_MOST_TOLD]:
            progress.warning(
                f"Place {rank}: as ground it lifts the terrain by {lift:.1f} m, the expected error"
                f" is {expected:.2f} m. Look at it again: roofs and crowns may have become ground."
            )
        if len(found) > _MOST_TOLD:
            progress.warning(f"So do {len(found) - _MOST_TOLD:,} more places, by less.")
