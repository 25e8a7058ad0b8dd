"""Which points of a file are to be classified, and which take part: area and selection together."""

from __future__ import annotations

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud
from .area import Area
from .selection import Selection, Tally


class Scope:
    """The points of one run, seen part by part or all at once.

    Parameters
    ----------
    selection : Selection
        Which points take part.
    area : Area or None
        Where points are to be classified; everywhere if it is None.
    context : float
        Metres round the area from which points take part as well.

    Attributes
    ----------
    tally : Tally
        What was counted in the parts so far.
    inside_count, wanted_count : int
        Points in the area, and those of them that take part.
    lowest, highest : tuple of int
        The smallest and the largest x and y of all points, as integers.
    """

    def __init__(self, selection: Selection, area: Area | None, context: float) -> None:
        self.selection, self.tally = selection, Tally()
        self.inside_count = self.wanted_count = 0
        self.lowest = self.highest = (0, 0)
        self._area, self._context, self._first = area, context, None

    def choose(
        self, part: PointCloud, progress: Progress = SILENT
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return which points of the next part lie in the area, and which take part.

        Raises
        ------
        BareEarthError
            If nothing can be measured in the CRS, or the points cannot hold the class.
        """
        self._see(part)
        return self._counted(part, progress)

    def choose_all(
        self, cloud: PointCloud, progress: Progress = SILENT
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the same as `choose` for all points of a file, some of which it sees at a time."""
        self._see(cloud)
        inside, selected = (np.empty(cloud.count, dtype=bool) for _ in range(2))
        for where, part in cloud.parts():
            share = progress.part(where.start / cloud.count, where.stop / cloud.count)
            inside[where], selected[where] = self._counted(part, share)
            share(1.0)
        return inside, selected

    def choose_again(self, part: PointCloud) -> tuple[np.ndarray, np.ndarray]:
        """Return the same as `choose` for a part that was counted before."""
        return self._choose(part, Tally(), SILENT)

    def _see(self, part: PointCloud) -> None:
        """Take in where points lie; refuse a file that does not do."""
        if self._first is None:
            self.selection.check(part)
            self._first, self.lowest, self.highest = part, part.lowest, part.highest
        self.lowest = tuple(map(min, part.lowest, self.lowest))
        self.highest = tuple(map(max, part.highest, self.highest))

    def _counted(self, part: PointCloud, progress: Progress) -> tuple[np.ndarray, np.ndarray]:
        inside, selected = self._choose(part, self.tally, progress)
        self.inside_count += int(np.count_nonzero(inside))
        self.wanted_count += int(np.count_nonzero(inside & selected))
        return inside, selected

    def _choose(
        self, part: PointCloud, tally: Tally, progress: Progress
    ) -> tuple[np.ndarray, np.ndarray]:
        inside, near = np.ones(part.count, dtype=bool), None
        if self._area is not None:
            inside = self._area.of(part, progress.part(0.0, 0.8))
            box = self._area.buffered_box(self._context / part.crs.horizontal_unit)
            near = Area(box).of(part, progress.part(0.8, 1.0))
        return inside, self.selection.choose(part, tally, near)

    def tell(self, progress: Progress) -> None:
        """Tell what lies in the area and what takes part, once all points are counted.

        Raises
        ------
        BareEarthError
            If no point lies in the area, or none of these takes part.
        """
        if self._area is not None:
            if not self.inside_count:
                wanted, there = _in_words(self._area.bounds), _in_words(self._bounds())
                raise BareEarthError(
                    f"No point of {self._first.path} lies in the area ({wanted}): the points have"
                    f" {there}. Give the area in the CRS of the points."
                )
            progress.info(f"{self.inside_count:,} of {self.tally.points:,} points lie in the area.")
        self.selection.tell(self.tally, self._first.path, progress, self._area is not None)
        if not self.wanted_count:
            raise BareEarthError(
                f"None of the {self.inside_count:,} points in the area takes part. Choose"
                " another area, or other returns or classes."
            )

    def tell_of_special(self, low_count: int, deck_count: int, progress: Progress) -> None:
        """Tell how many low outliers and points on bridges there are in the area."""
        if self.selection.low_noise_class:
            depth = self.selection.low_noise_depth
            progress.info(f"{low_count:,} points lie more than {depth:g} m below the ground.")
        if deck_count:
            progress.info(f"{deck_count:,} points lie on decks of bridges: they are not ground.")

    def _bounds(self) -> tuple[float, ...]:
        scale, offset = self._first.scale, self._first.offset
        return tuple(
            corner[axis] * scale[axis] + offset[axis]
            for corner in (self.lowest, self.highest)
            for axis in (0, 1)
        )


def _in_words(bounds: tuple[float, ...]) -> str:
    west, south, east, north = bounds
    return f"x {west:.10g} to {east:.10g}, y {south:.10g} to {north:.10g}"
