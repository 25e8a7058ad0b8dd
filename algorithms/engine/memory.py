"""How much memory and how many threads a run may use."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from ..core.memory import GIGABYTE, free_memory
from ..core.parameters import ParameterSet, parameter
from ..core.threads import available_cpus

_SHARE = 0.5


@dataclass(frozen=True)
class Resources(ParameterSet):
    """The threads and memory that a run may use."""

    threads: int | None = parameter(
        None,
        kind="integer",
        label="Threads",
        minimum=1,
        maximum=1024,
        empty="all processors",
        advanced=True,
        help="How many threads compute at the same time. The result does not depend on it. Empty:"
        " one for each processor.",
    )
    memory: float | None = parameter(
        None,
        kind="number",
        label="Memory",
        unit="GB",
        minimum=0.001,
        maximum=100_000.0,
        empty="half of what is free",
        advanced=True,
        help="About how much memory a run may use. A file that needs more is read twice, and its"
        " points wait in a temporary file in the output folder. With many files, fewer are worked"
        " on at the same time. The result does not depend on it. Empty: half of the free memory.",
    )

    @property
    def thread_count(self) -> int:
        return self.threads or available_cpus()

    @classmethod
    def of(cls, threads: int | None, memory: float) -> Resources:
        """Return resources with threads and bytes of memory; at least the minimum of memory."""
        return cls(threads, max(memory / GIGABYTE, 0.001))

    def now(self) -> Resources:
        """Return the resources with half of the memory that is free now, if none was given."""
        return Resources.of(self.thread_count, self.bytes)

    @property
    def bytes(self) -> int:
        return int(free_memory() * _SHARE if self.memory is None else self.memory * GIGABYTE)


class Cost(NamedTuple):
    """Bytes of memory that a step takes per point and per square metre of a block with its buffer;
    by default those of the filters.
    """

    a_point: float = 80.0
    a_square_metre: float = 80.0
