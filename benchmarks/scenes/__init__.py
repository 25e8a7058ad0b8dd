"""Generated scenes: land whose terrain and whose every point is known.

`KINDS` names them; `make("quarry", seed=3, density=10.0)` makes one. What a filter is tuned with
are the `TUNING_SEEDS`; what is quoted is measured on the `REPORTING_SEEDS`.
"""

from __future__ import annotations

from . import buildings, earthworks, faults, landforms, mixed, sensors, transport, vegetation
from .scene import Kind, Scene
from .settings import Settings

__all__ = ["KINDS", "REPORTING_SEEDS", "TUNING_SEEDS", "Kind", "Scene", "Settings", "make"]

KINDS: dict[str, Kind] = {
    kind.name: kind
    for module in (landforms, buildings, transport, vegetation, sensors, faults, mixed, earthworks)
    for kind in module.KINDS
}
# Even numbers are for tuning, odd ones for reporting.
TUNING_SEEDS, REPORTING_SEEDS = (0, 2), (1, 3)


def make(kind: str, seed: int, **changes: object) -> Scene:
    """Return the scene of a kind and a seed; `changes` are fields of `Settings`."""
    return KINDS[kind].make(seed, **changes)
