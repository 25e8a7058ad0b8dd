"""Files in memory that several jobs of a process need, so that each is decompressed once."""

from __future__ import annotations

import threading
from pathlib import Path
from typing import Any

from ..core.points import Box
from ..core.progress import Progress
from ..las.cloud import PointCloud
from ..las.lasfile import LasFile
from ..las.opening import open_las
from ..las.reading import read_cloud
from ..survey.window import may_touch, read_window

# Bytes of a point in memory.
_BYTES_A_POINT = 19


class CloudCache:
    """The clouds of files, as far as memory allows. Several threads may use it.

    Parameters
    ----------
    limit : int
        Bytes that the clouds may take together.
    """

    def __init__(self, limit: int = 0) -> None:
        self._limit, self._lock = limit, threading.Lock()
        # By path, state and stated CRS of the file; the last used ones at the end.
        self._kept: dict[Any, _CachedCloud] = {}

    def whole(self, las: LasFile, progress: Progress) -> PointCloud | None:
        """Return all points of a file, without its records; None if they take too much memory.

        Raises
        ------
        BareEarthError
            If the file cannot be read.
        """
        size = las.count * _BYTES_A_POINT
        if size > self._limit:
            return None
        key = las.path, las.state, las.stated
        with self._lock:
            kept = self._kept.pop(key) if key in self._kept else _CachedCloud(size)
            self._kept[key] = kept
            while sum(each.size for each in self._kept.values()) > self._limit:
                del self._kept[next(iter(self._kept))]
        # Other threads that need this file wait until it is read.
        with kept.lock:
            if kept.cloud is None:
                kept.cloud = read_cloud(las, progress)
        return kept.cloud

    def window(
        self, path: Path, box: Box, progress: Progress, stated: str | None = None
    ) -> PointCloud:
        """Return the points of a file in a box, as `read_window` with `trust_header` does.

        `stated` is as for `open_las`.
        """
        las, cloud = open_las(path, stated), None
        # The nodes of a COPC file are read by themselves.
        if not las.is_copc and may_touch(las, box):
            cloud = self.whole(las, progress)
        return read_window(las, box, progress, trust_header=True, whole=cloud)


class _CachedCloud:
    """A cloud, once it is read, and the bytes that it takes."""

    def __init__(self, size: int) -> None:
        self.size, self.lock = size, threading.Lock()
        self.cloud: PointCloud | None = None
