"""Runs steps block by block, in parallel as far as threads and memory allow.

Steps with equal blocks work on a block one after another, so that a step can use what an earlier
one has found out about the points of the block.
"""

from __future__ import annotations

import itertools
from collections import defaultdict
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, Callable, Hashable, Iterable, Sequence

import numpy as np

from ..core.errors import NoGround
from ..core.memory import GIGABYTE, GivingBack, give_back
from ..core.progress import SILENT, Progress
from ..las.cloud import PointCloud
from .block_grid import BlockGrid, BlockIndex
from .blocks import PlaneBlock, Visit
from .blockwise import run_jobs
from .memory import Cost, Resources
from .memory_store import MemoryStore
from .step import PointStep, Step
from .store import Store

# Bytes: blocks that take more give their memory back to the system when they are done.
_MUCH = 100_000_000
# Bytes that stay in memory for each point of a block that a step has read, while later steps work
# on the block.
_BYTES_KEPT = 70


class Work:
    """A step, a store with the points that it needs, and what it found."""

    def __init__(self, step: Step, store: Store) -> None:
        self.step, self.store = step, store
        self.counts = step.counts()  # what the step has counted among the points
        self.has_points = False  # whether any point that gets a value takes part
        # For each part that `values_of` adds, the file, and which of its blocks hold the points.
        self.parts: list[tuple[Path, np.ndarray]] = []
        self.arrays: list[tuple[PlaneBlock, Any]] = []  # that a sink has found, by block
        self.failure: NoGround | None = None  # why a point step has no values

    def add(
        self,
        part: PointCloud,
        stored: PointCloud | None = None,
        wanted: np.ndarray | None = None,
    ) -> None:
        """Add the points of the next part that the step needs to the store; `stored` is the same
        part with less memory, and only `wanted` points get a value.
        """
        marks = self.step.marks(part, self.counts)
        if wanted is not None:
            wanted = wanted if marks.wanted is None else wanted & marks.wanted
            marks = marks._replace(wanted=wanted)
        taking_part = marks.selected if wanted is None else marks.selected & wanted
        self.has_points = self.has_points or bool(taking_part.any())
        self.store.append(part if stored is None else stored, marks)

    def values(self, number: int) -> np.ndarray:
        """Return the values of all points of a part; 0 where there is none."""
        values = self.store.values(number)
        return values if self.failure is None else np.zeros_like(values)


def values_of(
    grid: BlockGrid,
    clouds: Iterable[PointCloud],
    resources: Resources,
    progress: Progress = SILENT,
    places: Sequence[BlockIndex] | None = None,
    store: Store | None = None,
) -> Work:
    """Let the step of a grid work on points, in all of its blocks or only at some places; return
    what it found, with the number of the place of each point in `Work.parts`, from 1 on.
    """
    step, has_values = grid.step, isinstance(grid.step, PointStep)
    work = Work(step, store or MemoryStore(grid.frame, grid.blocks, step.kind))
    for cloud in clouds:
        wanted = None
        if places is not None and has_values:
            work.parts.append((cloud.path, grid.numbers(cloud, places)))
            wanted = work.parts[-1][1] > 0
        work.add(cloud, wanted=wanted)
    work.store.finish(progress.part(0.0, 0.1))

    def is_wanted(block: PlaneBlock) -> bool:
        return places is None or grid.holding(block) in places

    if not work.has_points:
        return work
    try:
        (work.arrays,) = visited([work], resources, progress.part(0.1, 1.0), is_wanted)
    except NoGround as failure:
        if not has_values:
            raise
        work.failure = failure
    return work


def visited(
    works: Sequence[Work],
    resources: Resources,
    progress: Progress,
    is_wanted: Callable[[PlaneBlock], bool] | None = None,
) -> list[Any]:
    """Let steps work in their blocks, or only in the wanted ones; return for each step the blocks
    with their arrays, or with the notes of a step that stores values.
    """
    alike = itertools.groupby(
        works, lambda work: (replace(work.step.blocks, cost=Cost()), work.store.frame)
    )
    groups = [list(group) for _, group in alike]
    pairs = zip(groups, progress.shares(*map(_weight, groups)))
    return [result for pair in pairs for result in _visited(*pair, resources, is_wanted)]


def _weight(works: Sequence[Work]) -> float:
    return sum(work.step.weight for work in works)


def _visited(
    works: Sequence[Work],
    progress: Progress,
    resources: Resources,
    is_wanted: Callable[[PlaneBlock], bool] | None,
) -> list[Any]:
    todo: dict[PlaneBlock, dict[int, Visit]] = defaultdict(dict)
    for number, work in enumerate(works):
        blocks, store = work.step.blocks, work.store
        with_points = list(blocks.over(store))
        for block in filter(is_wanted, with_points) if is_wanted else with_points:
            todo[block][number] = Visit(block, blocks, store, len(with_points) == 1, {})
    counts, memory = [], []
    for visits in todo.values():
        points, sizes = zip(*(visit.size for visit in visits.values()))
        counts.append(sum(points))
        memory.append(max(sizes) + _BYTES_KEPT * sum(points[:-1]))
    largest = max(memory, default=0)
    if len(works) > 1 and largest > resources.bytes:
        alone = [[work] for work in works]
        pairs = zip(alone, progress.shares(*map(_weight, alone)))
        return [result for pair in pairs for result in _visited(*pair, resources, is_wanted)]
    if largest > max(resources.bytes, _MUCH):
        progress.info(
            f"The largest block takes about {largest / GIGABYTE:.2f} GB of memory, more than"
            f" the {resources.bytes / GIGABYTE:.2f} GB that may be used."
        )
    at_once = min(len(todo), resources.thread_count, resources.bytes // max(largest, 1))
    is_tight = sum(memory) > resources.bytes
    running = GivingBack(progress) if is_tight else progress
    jobs = [partial(_in_block, works, visits) for visits in todo.values()]
    results: list[dict[PlaneBlock, Any]] = [{} for _ in works]
    order = list(todo)
    for place, of_steps in run_jobs(jobs, counts, at_once, resources.thread_count, running):
        for number, result in of_steps.items():
            work = works[number]
            results[number][order[place]] = _kept(work, result)
        if is_tight and memory[place] > _MUCH:
            give_back()
    # In the order of the blocks, not in the order in which they were done.
    sorted_results = [
        [(block, kept[block]) for block in order if block in kept] for kept in results
    ]
    for work, kept in zip(works, sorted_results):
        if isinstance(work.step, PointStep):
            notes = [note for _, of_block in kept for note in of_block]
            work.step.report_blocks(notes, work.store.has_known, progress)
    return sorted_results


def _kept(work: Work, result: Any) -> Any:
    """Put the values or the large arrays of a block into the store, and return the rest."""
    if isinstance(work.step, PointStep):
        positions, values, *notes = result
        work.store.put(positions, values)
        return notes
    return {
        name: work.store.keep(array) if array.ndim == 2 else array for name, array in result.items()
    }


def _in_block(
    works: Sequence[Work], visits: dict[int, Visit], progress: Progress
) -> dict[int, object]:
    """Let steps work on a block; visits and results are by the number of the step."""
    shares = progress.shares(*(works[number].step.weight for number in visits))
    findings: dict[Hashable, Any] = {}
    return {
        number: works[number].step.in_block(visit._replace(findings=findings), share)
        for (number, visit), share in zip(visits.items(), shares)
    }
