"""Chooses points by area and selection: which take part, and which are classified."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import cast

import numpy as np

from ..core.errors import BareEarthError
from ..core.points import Box
from ..core.progress import Progress
from ..crs.system import Crs
from ..las.cloud import PointCloud
from ..las.records import check_class
from ..survey.area import Area
from ..survey.shapes import outside
from .corrections import NO_CORRECTIONS, ByHand, Corrections
from .point_counts import PointCounts
from .selection import Selection


@dataclass(frozen=True)
class PointChooser:
    """Chooses the points of a run, part by part."""

    selection: Selection
    area: Area | None = None  # where points are classified; None for everywhere
    context: float = 0.0  # metres from the area in which points take part as well
    corrections: Corrections = NO_CORRECTIONS  # in addition to those remembered in the files

    def choose(
        self, part: PointCloud, counts: PointCounts
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return which points lie in the area, which take part, and which are known ground, bool
        (n,), and count them; refuse a geographic CRS and classes that do not fit.
        """
        part.require_projected()
        self.check_classes(part.path, part.point_format)
        inside, near = self.inside(part), None
        if self.area is not None:
            counts.see(part)
            near = self.near(part)
        by_hand = self.by_hand(part)
        selected = self.selection.choose(part, counts, near, by_hand)
        counts.inside += int(np.count_nonzero(inside))
        counts.wanted += int(np.count_nonzero(inside & selected))
        return inside, selected, self.selection.known_ground(part, selected, by_hand)

    def check_classes(self, path: Path, point_format: int) -> None:
        """Refuse a file whose point format cannot hold the classes that the user chose."""
        by_hand = [(value, "a correction") for value in self.corrections.exact]
        ground, bridges = self.selection.to_class, self.selection.bridge_class
        for value, name in ((ground, "the ground"), (bridges, "bridges"), *by_hand):
            if value is not None:
                check_class(path, point_format, value, name)

    def by_hand(self, part: PointCloud) -> ByHand | None:
        """Return the classes set by hand; None without corrections and remembered classes."""
        return self.selection.by_hand(part, self.corrections)

    def inside(self, part: PointCloud) -> np.ndarray:
        """Return which points lie in the area; boolean, shape (n,)."""
        return np.ones(part.count, dtype=bool) if self.area is None else self.area.of(part)

    def near(self, part: PointCloud) -> np.ndarray:
        """Return which points lie in the area or near it, so that they take part; bool (n,)."""
        box = self.box_near(part.crs)
        return np.ones(part.count, dtype=bool) if box is None else Area(box).of(part)

    def box_near(self, crs: Crs) -> Box | None:
        """Return the box round the area in which points take part; None without an area."""
        if self.area is None:
            return None
        return self.area.buffered_box(self.context / crs.horizontal_unit)

    def report(self, counts: PointCounts, path: Path, progress: Progress) -> None:
        """Report how many points lie in the area and take part, after all points were counted;
        refuse a file if no point does.
        """
        if self.area is not None:
            if not counts.inside:
                raise outside("the area", self.area.bounds, str(path), cast(Box, counts.bounds))
            progress.info(f"{counts.inside:,} of {counts.points:,} points lie in the area.")
        self.selection.report(counts, path, progress, self.area is not None)
        if not counts.by_hand:
            self.report_unused_corrections(progress)
        if not counts.wanted:
            raise BareEarthError(
                f"None of the {counts.inside:,} points in the area takes part. Choose"
                " another area, or other returns or classes."
            )

    def report_unused_corrections(self, progress: Progress) -> None:
        """If polygons of corrections set classes, warn that no point gets its class from them."""
        if self.corrections.exact:
            progress.warning(
                "No point gets its class from the polygons of the corrections. Give them in the"
                " CRS of the points."
            )
