"""Stores the classes of a run in the file, so that the next run finds later changes by hand."""

from __future__ import annotations

import dataclasses

import numpy as np

from ..las.cloud import PointCloud
from ..las.edits import Edits
from ..las.extrabytes import REMEMBERED, ExtraDimension
from ..survey.corrections import to_remember
from .steps import Room


class Memory:
    """The classes of a file that are to be remembered.

    Parameters
    ----------
    room : callable
        Returns an array of one value for each point.
    begins : bool
        Whether classes are remembered even if the file has none remembered yet.
    """

    def __init__(self, room: Room, begins: bool = False) -> None:
        self._room, self._begins = room, begins
        self._values: np.ndarray | None = None

    def add(self, where: slice, part: PointCloud, classes: np.ndarray) -> None:
        """Add the new classes of some points."""
        if self._begins or part.remembered is not None:
            if self._values is None:
                self._values = self._room(np.uint8)
            self._values[where] = to_remember(part, classes)

    def part(self, where: slice, part: PointCloud) -> PointCloud:
        """Return points as they will be read back."""
        if self._values is None:
            return part
        return dataclasses.replace(part, remembered=self._values[where])

    def added_to(self, edits: Edits) -> Edits:
        """Return edits with the remembered classes."""
        if self._values is None:
            return edits
        dimension = ExtraDimension(REMEMBERED, "Before changes by hand", self._values)
        return dataclasses.replace(edits, remembered=dimension)
