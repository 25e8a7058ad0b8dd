"""The loop of a thread that starts jobs, looks at them ten times a second, and takes results."""

from __future__ import annotations

from concurrent.futures import FIRST_COMPLETED, Future, wait
from typing import Any, Callable, Collection, Iterator

# Seconds between two looks.
_POLL = 0.1


def ended(
    start: Callable[[], Collection[Future[Any]]], look: Callable[[], None]
) -> Iterator[Future[Any]]:
    """Yield jobs as they end until none runs; `start` begins what may run and returns what runs,
    `look` is called ten times a second and ends the loop if it raises.
    """
    # Threads, processes and the workers of a cluster all have such futures. `look` is called in the
    # calling thread, also when a job ends, before it is yielded.
    while running := start():
        done, _ = wait(running, _POLL, FIRST_COMPLETED)
        look()
        yield from (future for future in running if future in done)
