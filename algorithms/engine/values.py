"""The values that steps have found for the points of a file: in a store, or in files of blocks.

Each step of a run sees the points with what the steps before it have found.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Iterable, Iterator, Mapping, Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.files import replacing
from ..core.points import Box
from ..las.cloud import PointCloud
from ..las.lasfile import LasFile
from .block_grid import BlockGrid, BlockIndex, code
from .disk_store import RowsOnDisk, rows_in
from .step import PointStep
from .store import Store

_FAILURE = "no ground"


class PointValues:
    """The value that a step found for each point of a file, in a store of all of its parts."""

    failure = ""  # why some points have none; empty if all have
    # bool, (k,): which points that `of` was last asked for lie in blocks that failed
    lost: np.ndarray | None = None

    def __init__(self, step: PointStep, store: Store) -> None:
        self.step, self._store = step, store

    def of(self, where: slice, part: PointCloud) -> np.ndarray:
        """Return the values of the next points, given their indices in the file."""
        return self._store.values(self._store.starts.index(where.start))

    def check(self) -> None:
        """Refuse a file if some values were not used."""


def numbered(parts: Iterable[PointCloud]) -> Iterator[tuple[slice, PointCloud]]:
    """Yield the parts of a file with their indices in it."""
    start = 0
    for part in parts:
        yield slice(start, start + part.count), part
        start += part.count


def with_values(
    parts: Iterable[tuple[slice, PointCloud]], values: Sequence[PointValues]
) -> Iterator[tuple[slice, PointCloud]]:
    """Yield the parts of a file, with their indices in it, as the next step sees them."""
    for where, part in parts:
        yield where, applied(values, where, part)


def applied(values: Sequence[PointValues], where: slice, part: PointCloud) -> PointCloud:
    """Return a part of a file as the next step sees it; it leaves out what could not be done."""
    for found in values:
        if found.step.gives_classes:
            part = found.step.applied(part, found.of(where, part))
            if found.lost is not None:
                part = replace(part, withheld=part.withheld | found.lost)
    return part


@dataclass(frozen=True, eq=False)
class BlockFiles:
    """The files with the values that a step has found in some blocks."""

    grid: BlockGrid  # of the step
    files: Mapping[BlockIndex, Path]

    def within(self, box: Box) -> BlockFiles:
        """Return the files of the blocks that a box in units of the CRS touches."""
        places = self.grid.among(self.files, box)
        return replace(self, files={place: self.files[place] for place in places})

    def write(self, place: BlockIndex, of_files: Mapping[Path, np.ndarray], failure: str) -> None:
        """Write the values of a block: for each input those of its points in it, in file order."""
        content: dict[str, Any] = {_key(path): values for path, values in of_files.items()}
        if failure:
            content[_FAILURE] = np.array(failure)
        with replacing(self.files[place]) as temporary:
            np.savez(temporary, **content)


class BlockValues(PointValues):
    """The values of a file as the blocks stored them; points in blocks that are not there, unless
    `are_all`, have the value 0.
    """

    def __init__(self, found: BlockFiles, las: LasFile, are_all: bool = True) -> None:
        self.step, self._grid, self._las, self._are_all = found.grid.step, found.grid, las, are_all
        # The values that each block has, and how many of them were used.
        self._values: dict[int, RowsOnDisk] = {}
        self._used: dict[int, int] = {}
        self._not_done: list[int] = []
        for place, file in found.files.items():
            if not are_all and not file.exists():
                self._not_done.append(code(place))
                continue
            with np.load(file, allow_pickle=False) as kept:
                if _key(las.path) in kept:
                    self._values[code(place)] = rows_in(file)[_key(las.path)]
                    self.failure = self.failure or str(kept.get(_FAILURE, ""))

    def of(self, where: slice, part: PointCloud) -> np.ndarray:
        """Return the values of the next points; refuse points outside the extent in the header."""
        if where.stop > self._las.count:
            raise self._changed()
        codes = self._grid.codes(part)
        self.lost = np.isin(codes, self._not_done) if self._not_done else None
        values: np.ndarray = np.zeros(part.count, dtype=self.step.kind)
        # Most parts lie in one block, which is seen faster than codes are sorted.
        is_one = bool(part.count) and codes.min() == codes.max()
        for number in (codes[:1] if is_one else np.unique(codes)).tolist():
            here, left = np.flatnonzero(codes == number), self._values.get(number)
            if left is None:
                if self._are_all:
                    raise BareEarthError(
                        f"The header of {self._las.path} states a smaller extent than its points"
                        " have. Write the file again with a program that corrects the header."
                    )
                continue
            start = self._used.get(number, 0)
            self._used[number] = end = start + len(here)
            if end > left.shape[0]:
                raise self._changed()
            values[here] = left[start:end]
        return values

    def check(self) -> None:
        """Refuse a file if some values were not used."""
        if any(self._used.get(block, 0) < left.shape[0] for block, left in self._values.items()):
            raise self._changed()

    def _changed(self) -> BareEarthError:
        """Return the error for a file that has changed."""
        return BareEarthError(
            f"{self._las.path} changed while it was worked on. Classify it again."
        )


def _key(path: Path) -> str:
    """Return a name for the values of a file, whose own name may have unsuitable characters."""
    return os.fsencode(path.name).hex()
