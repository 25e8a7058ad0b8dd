"""What a file remembers of the classes that runs give, so that the next sees what was changed."""

from __future__ import annotations

import dataclasses

import numpy as np

from ..las.cloud import PointCloud
from ..las.edits import Edits
from ..las.extrabytes import REMEMBERED, ExtraDimension
from ..survey.corrections import to_remember
from .steps import Room


class Memory:
    """What is remembered of the classes of the points of a file.

    Parameters
    ----------
    room : callable
        Makes room for a value of each point.
    begins : bool
        Whether it is remembered even if the file does not do so yet.
    """

    def __init__(self, room: Room, begins: bool = False) -> None:
        self._room, self._begins = room, begins
        self._values: np.ndarray | None = None

    def add(self, where: slice, part: PointCloud, classes: np.ndarray) -> None:
        """Take in the classes that some points get."""
        if self._begins or part.remembered is not None:
            if self._values is None:
                self._values = self._room(np.uint8)
            self._values[where] = to_remember(part, classes)

    def added_to(self, edits: Edits) -> Edits:
        """Return edits with what is remembered."""
        if self._values is None:
            return edits
        dimension = ExtraDimension(REMEMBERED, "Before changes by hand", self._values)
        return dataclasses.replace(edits, remembered=dimension)
