"""Large arrays that exist during a run: in memory, or in files of a temporary folder."""

from __future__ import annotations

import math
import mmap
import shutil
from pathlib import Path

import numpy as np


class ScratchArrays:
    """Creates arrays of zeros, in memory or, with a folder, on disk."""

    def __init__(self, folder: Path | None) -> None:
        self._folder = folder

    def has_room(self, size: int) -> bool:
        """Return whether the bytes are free on the disk, or not needed there."""
        return self._folder is None or shutil.disk_usage(self._folder).free >= size

    def array(self, name: str, shape: tuple[int, ...], kind: str) -> np.ndarray:
        """Return an array of zeros."""
        if self._folder is None:
            # In arrays of NumPy, a cell would take a page of 2 MB.
            size = max(math.prod(shape) * np.dtype(kind).itemsize, 1)
            return np.ndarray(shape, dtype=kind, buffer=mmap.mmap(-1, size))
        return np.memmap(self._folder / f"{name}.cells", dtype=kind, mode="w+", shape=shape)
