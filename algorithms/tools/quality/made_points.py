"""Finds points that were not measured but made: synthetic, infilled and virtual ones.

Producers add such points on water and under buildings and bridges. They are no pulses and belong to
no flight strip.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from ...core.progress import Progress
from ...las.cloud import PointCloud
from ...las.reading import read_parts
from ...survey.files import Survey

WATER = 9
# Classes that the LAS specification leaves to producers, such as 26 of infilled ground in North
# Rhine-Westphalia and 66 of virtual points of the IGN. Others give measured points the same
# classes, such as 26 for bridges in the Netherlands, so a class alone does not tell.
PRODUCERS_CLASSES = np.zeros(256, dtype=bool)
PRODUCERS_CLASSES[23:40] = PRODUCERS_CLASSES[46:] = True


class MadePoints:
    """Finds made points: synthetic ones, unless all are; those with return number 0 if others count
    returns; and those of producers' classes without a GPS time.
    """

    def __init__(self, survey: Survey, has_times: bool, progress: Progress) -> None:
        self.all_synthetic = True
        self._counts_synthetic = False
        self._has_times = False  # whether any point has a GPS time
        self._zeros: set[Path] = set()  # files whose points with return number 0 are infilled
        # By source id: whether it has points of producers' classes, and measured points.
        self._of_producers, self._measured = np.zeros((2, 1 << 16), dtype=bool)
        self._look_at(survey, has_times, progress)

    def _look_at(self, survey: Survey, has_times: bool, progress: Progress) -> None:
        """Read files, usually only their first parts, to learn how they count returns and whether
        all points are synthetic.
        """
        counting: set[Path] = set()
        infill: set[Path] = set()
        shares = progress.shares(*(max(tile.count, 1) for tile in survey.tiles))
        for tile, share in zip(survey.tiles, shares):
            counts = has_land = False
            for part in read_parts(tile, share.quiet(), True, has_times):
                self.all_synthetic &= bool(np.all(part.synthetic))
                self._has_times |= part.gps_time is not None and bool(part.gps_time.any())
                has_land |= not _may_be_infill(part).all()
                if part.return_number.any() and not counts:
                    counts = True
                    # In files that count from 0, single returns of a part may still have 0.
                    counting.update(() if part.from_zero else (tile.path,))
                if counts and not self.all_synthetic:
                    break
            # A file without return numbers was measured if it contains land.
            if not counts and not has_land:
                infill.add(tile.path)
        self._zeros = counting | infill if counting else set()

    def count_all_synthetic(self) -> None:
        """Take synthetic points as measured, as those of images."""
        self._counts_synthetic = True

    def add(self, part: PointCloud, used: np.ndarray) -> None:
        """Look at the source ids of a part of the points; some points are used."""
        used = used & ~self.infilled(part)
        own = PRODUCERS_CLASSES[part.classification]
        strip = np.asarray(part.strip)
        self._of_producers[strip[used & own]] = True
        is_measured = ~_may_be_infill(part) | (part.number_of_returns > 1)
        self._measured[strip[used & is_measured]] = True

    def sources(self) -> np.ndarray:
        """Return the source ids that are no flight strips, when all parts are added."""
        no_strips = self._of_producers & ~self._measured
        return np.flatnonzero(no_strips & self._measured.any())

    def infilled(self, part: PointCloud) -> np.ndarray:
        """Return which points are infilled, by return number, time and class; boolean, (n,)."""
        infilled = np.zeros(part.count, dtype=bool)
        if part.path in self._zeros:
            infilled |= part.return_number == 0
        if self._has_times and part.gps_time is not None:
            infilled |= (part.gps_time == 0) & PRODUCERS_CLASSES[part.classification]
        return infilled

    def made(self, part: PointCloud) -> np.ndarray:
        """Return which points were not measured, synthetic ones included; boolean, (n,)."""
        made = self.infilled(part)
        return made if self._counts_synthetic else made | np.asarray(part.synthetic)


def _may_be_infill(part: PointCloud) -> np.ndarray:
    return (part.classification == WATER) | PRODUCERS_CLASSES[part.classification]
