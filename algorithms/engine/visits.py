"""Visits of steps to blocks, as many at a time as threads and memory allow.

Steps with equal blocks work in one visit to each: what one of them finds out about the points of a
block, those after it need not find again.
"""

from __future__ import annotations

import itertools
from collections import defaultdict
from dataclasses import replace
from functools import partial
from typing import Any, Callable, NamedTuple, Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.points import Frame
from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud
from .blocks import Block, Blocks
from .blockwise import run_jobs
from .memory import GIGABYTE, Cost, GivingBack, Resources, give_back
from .memory_store import MemoryStore
from .store import BlockPoints, Corner, Marks, Store

# Bytes: blocks that take more give their memory back to the system when they are done.
_MUCH = 100_000_000
# Bytes that stay in memory for each point that a step has seen, while others work on its block.
_BYTES_KEPT = 70


class Visit(NamedTuple):
    """A block while a step works on it."""

    block: Block
    blocks: Blocks
    store: Store  # with the points that the step needs
    is_only: bool  # the block has all of these points
    found: dict[Any, Any]  # what a step has found out that those after it may use

    @property
    def corner(self) -> Corner:
        """The place that is (0, 0) of `contents`, as of `Blocks.corner`."""
        return self.blocks.corner(self.block)

    def contents(self, progress: Progress = SILENT, only: str | None = None) -> BlockPoints:
        """Return the points of the block and its buffer; for `only`, see `Store.read`."""
        return self.blocks.contents(self.block, self.store, progress, only)

    def core(self, contents: BlockPoints) -> np.ndarray:
        """Return which points the step is to say something of, bool (n,)."""
        if self.is_only:
            return contents.wanted
        return contents.wanted & self.block.holds(contents.points, self.corner)

    @property
    def size(self) -> tuple[int, int]:
        """How many points the block has with its buffer, and how many bytes it takes."""
        leaves = self.store.leaves
        touched = leaves.within(self.blocks.window(self.block))
        count = int(leaves.counts[touched].sum())
        return count, self.blocks.memory(count, len(touched) * leaves.side**2)


class Work:
    """A step, and the points that it needs, in a store."""

    def __init__(self, step: Any, store: Store) -> None:
        self.step, self.store = step, store
        self.counts = step.counts()  # by the step, among the points
        self.has_points = False  # whether any point that gets a value takes part

    @classmethod
    def in_memory(cls, step: Any, frame: Frame) -> Work:
        """Return a step, and an empty store in memory."""
        return cls(step, MemoryStore(frame, step.blocks, step.kind))

    def add(
        self,
        part: PointCloud,
        stored: PointCloud | None = None,
        wanted: np.ndarray | None = None,
    ) -> Marks:
        """Store the next points that the step needs, and return their marks; `stored` are the same
        points with less memory, and only those that are `wanted` get a value.
        """
        marks = self.step.marks(part, self.counts)
        if wanted is not None:
            wanted = wanted if marks.wanted is None else wanted & marks.wanted
            marks = marks._replace(wanted=wanted)
        taking_part = marks.selected if wanted is None else marks.selected & wanted
        self.has_points = self.has_points or bool(taking_part.any())
        self.store.append(part if stored is None else stored, marks)
        return marks

    def done(
        self,
        resources: Resources,
        progress: Progress = SILENT,
        is_wanted: Callable[[Block], bool] | None = None,
    ) -> Any:
        """Let the step work as `visited` does, when all points are there; return None if none of
        them takes part.
        """
        self.store.finish(progress.part(0.0, 0.1))
        return self._found(resources, progress.part(0.1, 1.0), is_wanted)

    def failure(
        self,
        resources: Resources,
        progress: Progress = SILENT,
        is_wanted: Callable[[Block], bool] | None = None,
    ) -> str:
        """Let a step work that finds a value for each point; return why it found none, or ""."""
        self.store.finish(progress.part(0.0, 0.1))
        try:
            self._found(resources, progress.part(0.1, 1.0), is_wanted)
        except BareEarthError as error:
            return str(error)
        return ""

    def _found(self, resources: Resources, progress: Progress, is_wanted: Any) -> Any:
        if not self.has_points:
            return None
        return visited([self], resources, progress, is_wanted)[0]


def visited(
    works: Sequence[Work],
    resources: Resources,
    progress: Progress,
    is_wanted: Callable[[Block], bool] | None = None,
) -> list[Any]:
    """Let steps work in their blocks, or in those that are wanted; return what `Step.end` returns
    for each.
    """
    alike = itertools.groupby(
        works, lambda work: (replace(work.step.blocks, cost=Cost()), work.store.frame)
    )
    groups = [list(group) for _, group in alike]
    pairs = zip(groups, progress.shares(*map(_weight, groups)))
    return [found for pair in pairs for found in _visited(*pair, resources, is_wanted)]


def _weight(works: Sequence[Work]) -> float:
    return sum(work.step.weight for work in works)


def _visited(
    works: Sequence[Work],
    progress: Progress,
    resources: Resources,
    is_wanted: Callable[[Block], bool] | None,
) -> list[Any]:
    """Let steps with equal blocks work; see `visited`."""
    todo: dict[Block, dict[int, Visit]] = defaultdict(dict)
    for number, work in enumerate(works):
        blocks, store = work.step.blocks, work.store
        over = list(blocks.over(store))
        for block in over if is_wanted is None else filter(is_wanted, over):
            todo[block][number] = Visit(block, blocks, store, len(over) == 1, {})
    counts, memory = [], []
    for visits in todo.values():
        of_steps, bytes_of_steps = zip(*(visit.size for visit in visits.values()))
        counts.append(sum(of_steps))
        memory.append(max(bytes_of_steps) + _BYTES_KEPT * sum(of_steps[:-1]))
    largest = max(memory, default=0)
    if len(works) > 1 and largest > resources.bytes:
        alone = [[work] for work in works]
        pairs = zip(alone, progress.shares(*map(_weight, alone)))
        return [found for pair in pairs for found in _visited(*pair, resources, is_wanted)]
    if largest > max(resources.bytes, _MUCH):
        progress.info(
            f"The largest block takes about {largest / GIGABYTE:.2f} GB of memory, more than"
            f" the {resources.bytes / GIGABYTE:.2f} GB that may be used."
        )
    at_once = min(len(todo), resources.thread_count, resources.bytes // max(largest, 1))
    is_tight = sum(memory) > resources.bytes
    running = GivingBack(progress) if is_tight else progress
    jobs = [partial(_in_block, works, visits) for visits in todo.values()]
    results: list[dict[Block, Any]] = [{} for _ in works]
    order = list(todo)
    for place, found in run_jobs(jobs, counts, at_once, resources.thread_count, running):
        for number, result in found.items():
            work = works[number]
            results[number][order[place]] = work.step.keep(work.store, result)
        if is_tight and memory[place] > _MUCH:
            give_back()
    # In the order of the blocks, whichever was done first.
    return [
        work.step.end(
            work.store, [(block, found[block]) for block in order if block in found], progress
        )
        for work, found in zip(works, results)
    ]


def _in_block(
    works: Sequence[Work], visits: dict[int, Visit], progress: Progress
) -> dict[int, Any]:
    """Let steps work on a block, given the visit of each by its number; return their results."""
    shares = progress.shares(*(works[number].step.weight for number in visits))
    found: dict[Any, Any] = {}
    return {
        number: works[number].step.in_block(visit._replace(found=found), share)
        for (number, visit), share in zip(visits.items(), shares)
    }
