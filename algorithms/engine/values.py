"""The values of steps for the points of a file, in a store or in files of blocks.

Each step of a run sees the points with the values of the steps before it.
"""

from __future__ import annotations

import os
from collections import defaultdict
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Iterable, Iterator, Mapping, Sequence

import numpy as np

from ..core.disk_arrays import RowsOnDisk, rows_in
from ..core.errors import BareEarthError
from ..core.files import replacing
from ..core.points import Box
from ..las.cloud import PointCloud
from ..las.lasfile import LasFile
from .block_grid import BlockGrid, BlockIndex, code
from .step import PointStep
from .store import Store

_FAILURE = "no ground"


class PointValues:
    """The values of a step for the points of a file, in a store with all parts of the file."""

    failure = ""  # why a block has no ground; empty if all have some
    # bool, (k,): which points of the last call of `of` lie in blocks that failed; None for no point
    lost: np.ndarray | None = None

    def __init__(self, step: PointStep, store: Store) -> None:
        self.step, self._store = step, store

    def of(self, where: slice, part: PointCloud) -> np.ndarray:
        """Return the values of the next part, given its indices in the file."""
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
    """Return a part of a file as the next step sees it; points of failed blocks are withheld."""
    for of_step in values:
        if of_step.step.gives_classes:
            part = of_step.step.applied(part, of_step.of(where, part))
            if of_step.lost is not None:
                part = replace(part, withheld=part.withheld | of_step.lost)
    return part


@dataclass(frozen=True, eq=False)
class BlockFiles:
    """The files with the values of a step in some blocks."""

    grid: BlockGrid  # of the step
    files: Mapping[BlockIndex, Path]

    def within(self, box: Box) -> BlockFiles:
        """Return the files of the blocks that a box in units of the CRS touches."""
        places = self.grid.among(self.files, box)
        return replace(self, files={place: self.files[place] for place in places})

    def write(self, place: BlockIndex, of_files: Mapping[Path, np.ndarray], failure: str) -> None:
        """Write the values of a block: for each input, the values of its points in file order."""
        content: dict[str, Any] = {_key(path): values for path, values in of_files.items()}
        if failure:
            content[_FAILURE] = np.frombuffer(failure.encode(), dtype=np.uint8)
        with replacing(self.files[place]) as temporary:
            np.savez(temporary, **content)


def write_arrays(file: Path, parts: Sequence[Mapping[str, Any]]) -> None:
    """Write the arrays of the parts of a block, which a sink has returned."""
    content = {
        f"{number}.{name}": array
        for number, part in enumerate(parts)
        for name, array in part.items()
    }
    with replacing(file) as temporary, temporary.open("wb") as stream:
        np.savez(stream, **content)


def arrays_in(file: Path) -> list[dict[str, Any]]:
    """Return what `write_arrays` wrote; arrays of two dimensions stay in the file."""
    parts: dict[str, dict[str, Any]] = defaultdict(dict)
    for key, array in rows_in(file).items():
        number, _, name = key.partition(".")
        parts[number][name] = array if len(array.shape) == 2 else array[:]
    return list(parts.values())


class BlockValues(PointValues):
    """The values of a step for the points of a file, from files of blocks; points in other blocks
    are refused if the files must be of all blocks (`are_all`), and otherwise have the value 0.
    """

    def __init__(self, blocks: BlockFiles, las: LasFile, are_all: bool = True) -> None:
        self.step, self._grid = blocks.grid.step, blocks.grid
        self._las, self._are_all = las, are_all
        # The values in each block, and how many of them were used.
        self._values: dict[int, RowsOnDisk] = {}
        self._used: dict[int, int] = {}
        self._not_done: list[int] = []
        for place, file in blocks.files.items():
            if not are_all and not file.exists():
                self._not_done.append(code(place))
                continue
            content = rows_in(file)
            if _key(las.path) in content:
                self._values[code(place)] = content[_key(las.path)]
                if _FAILURE in content:
                    self.failure = self.failure or content[_FAILURE][:].tobytes().decode()

    def of(self, where: slice, part: PointCloud) -> np.ndarray:
        """Return the values of the next part; refuse points outside the extent in the header."""
        if where.stop > self._las.count:
            raise self._changed()
        codes = self._grid.codes(part)
        self.lost = np.isin(codes, self._not_done) if self._not_done else None
        values: np.ndarray = np.zeros(part.count, dtype=self.step.kind)
        # Most parts lie in one block; to test this is faster than to sort the codes.
        is_one = bool(part.count) and codes.min() == codes.max()
        for number in (codes[:1] if is_one else np.unique(codes)).tolist():
            indices, of_block = np.flatnonzero(codes == number), self._values.get(number)
            if of_block is None:
                if self._are_all:
                    raise BareEarthError(
                        f"The header of {self._las.path} states a smaller extent than its points"
                        " have. Write the file again with a program that corrects the header."
                    )
                continue
            start = self._used.get(number, 0)
            self._used[number] = end = start + len(indices)
            if end > of_block.shape[0]:
                raise self._changed()
            values[indices] = of_block[start:end]
        return values

    def check(self) -> None:
        if any(self._used.get(block, 0) < rows.shape[0] for block, rows in self._values.items()):
            raise self._changed()

    def _changed(self) -> BareEarthError:
        return BareEarthError(
            f"{self._las.path} changed while it was worked on. Classify it again."
        )


def _key(path: Path) -> str:
    """Return the name of an array for a file; the name of the file can have any characters."""
    return os.fsencode(path.name).hex()
