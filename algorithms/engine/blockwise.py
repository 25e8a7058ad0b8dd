"""Runs a function on the blocks of a store, as many at a time as threads and memory allow."""

from __future__ import annotations

import time
from functools import partial
from typing import Any, Callable, Iterator

import numpy as np

from ..core.progress import Progress
from .blocks import Block, Blocks
from .memory import Resources, give_back
from .scheduling import run_jobs
from .store import BlockPoints, Corner, Store

# Blocks that take so many bytes give their memory back to the system when they are done, and all
# do every so many seconds if memory is short.
_MUCH, _SECONDS = 100_000_000, 0.3


def over_blocks(
    store: Store,
    blocks: Blocks,
    work: Callable[[Block, bool, Progress], Any],
    resources: Resources,
    progress: Progress,
    is_wanted: Callable[[Block], bool] | None = None,
) -> Iterator[tuple[int, Any]]:
    """Yield the number and the result of each block, in the order in which they finish.

    Parameters
    ----------
    store : Store
        The points.
    blocks : Blocks
        How they are cut.
    work : callable
        Returns the result, given a block, whether it is the only one, and a `Progress`.
    resources : Resources
        Threads, and the memory for the blocks.
    progress : Progress
        Used in the calling thread only.
    is_wanted : callable, optional
        Returns whether a block is to be computed. By default all are.
    """
    todo = [each for each in blocks.over(store) if is_wanted is None or is_wanted(each)]
    if not todo:
        return
    leaves = [store.leaves.within(blocks.window(each)) for each in todo]
    counts = [int(store.leaves.counts[each].sum()) for each in leaves]
    memory = [
        blocks.memory(count, len(each) * store.leaves.side**2)
        for count, each in zip(counts, leaves)
    ]
    at_once = _at_once(len(todo), max(memory), resources)
    jobs = [partial(work, each, len(todo) == 1) for each in todo]
    is_tight = sum(memory) > resources.bytes
    if is_tight:
        progress = _GivingBack(progress)
    for number, result in run_jobs(jobs, counts, at_once, resources.thread_count, progress):
        if is_tight and memory[number] > _MUCH:
            give_back()
        yield number, result


class _GivingBack(Progress):
    """Passes on progress, and gives freed memory back to the system now and then."""

    def __init__(self, whole: Progress) -> None:
        self._whole, self._given = whole, time.monotonic()

    def report(self, fraction: float) -> None:
        self._whole(fraction)
        if time.monotonic() - self._given > _SECONDS:
            give_back()
            self._given = time.monotonic()

    def info(self, text: str) -> None:
        self._whole.info(text)

    def choice(self, text: str) -> None:
        self._whole.choice(text)

    def warning(self, text: str) -> None:
        self._whole.warning(text)

    def took(self, stage: str, seconds: float) -> None:
        self._whole.took(stage, seconds)


def fill(
    store: Store,
    blocks: Blocks,
    values_of: Callable[[BlockPoints, np.ndarray, Corner, Progress], np.ndarray],
    resources: Resources,
    progress: Progress,
) -> None:
    """Store a value for each wanted point.

    Parameters
    ----------
    store, blocks, resources, progress
        As for `over_blocks`.
    values_of : callable
        Takes the points of a block and its buffer, which of them are wanted, the corner and a
        `Progress`. Returns the values of the wanted points, in their order.
    """

    def found(block: Block, is_only: bool, progress: Progress) -> tuple[np.ndarray, np.ndarray]:
        contents = blocks.contents(block, store, progress.part(0.0, 0.1))
        core = blocks.core(block, contents, is_only)
        part = progress.part(0.1, 1.0)
        return contents.positions[core], values_of(contents, core, blocks.corner(block), part)

    for _, (positions, values) in over_blocks(store, blocks, found, resources, progress):
        store.put(positions, values)


def _at_once(number: int, largest: int, resources: Resources) -> int:
    """Return how many blocks can be computed at once; the largest takes `largest` bytes."""
    fitting = resources.bytes // max(largest, 1)
    return int(max(1, min(number, resources.thread_count, fitting)))
