"""Measures functions on arrays and blocks of a survey: `python -m benchmarks.blocks TILE.laz`.

- What arrays cost more than files: whole processes that read a tile and find its ground, in turn.
- What a block costs: processor time in one thread and memory, without products and with all.
- What a block asks of a server: requests and bytes for a generated COPC file of 2 x 2 km.
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

from .remote import make_cloud, serving

# All run in a folder of their own; {0} is the path of the tile.
_WRITES = "import bare_earth; bare_earth.classify({0!r}, 'out.laz', threads=1)"
_READS = "import laspy; from bare_earth import arrays; las = laspy.read({0!r})\n"
_LABELS = f"{_READS}las.classification = arrays.classify(las, threads=1)\n"
_BLOCKS = "from bare_earth import arrays; import dask; blocks = arrays.blocks({0!r})\n"
_PRODUCTS = ("dtm", "dsm", "chm", "hillshade", "expected_error")
_RUNS = {
    "laspy reads and writes": f"{_READS}las.write('out.laz')",
    "files: classify()": _WRITES,
    "arrays: laspy reads, classify()": _LABELS,
    "arrays: laspy reads, classify(), laspy writes": f"{_LABELS}las.write('out.laz')",
    "blocks: labels": f"{_BLOCKS}[block() for block in blocks]",
    "blocks: labels and 5 rasters": f"{_BLOCKS}made = arrays.terrain(blocks, rasters={_PRODUCTS})\n"
    "dask.compute(*(one.values for one in made.values()), scheduler='synchronous')",
}
_ASKS = (
    "import sys; from bare_earth import arrays; blocks = arrays.blocks(sys.argv[1])\n"
    "print(len(blocks), flush=True); input()\n"
    "print(sum(len(block()['X']) for block in blocks), flush=True)"
)


class Cost(NamedTuple):
    """What a process took."""

    cpu: float  # seconds, in user and system
    memory: float  # GB, resident


def run(code: str, folder: str) -> Cost:
    """Run code in a process."""
    process = subprocess.Popen([sys.executable, "-c", code], cwd=folder)
    _, status, usage = os.wait4(process.pid, 0)
    if status:
        raise SystemExit(f"This failed:\n{code}")
    return Cost(usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1e6)


def main() -> None:
    """Measure, and print."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tile", type=Path)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--points", type=int, default=16_000_000, help="of the generated cloud")
    options = parser.parse_args()
    costs: dict[str, list[Cost]] = {name: [] for name in _RUNS}
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(options.rounds):
            for name, code in _RUNS.items():
                costs[name].append(run(code.format(str(options.tile.resolve())), folder))
        for name, some in costs.items():
            times = [cost.cpu for cost in some]
            print(
                f"{name:46} CPU {statistics.median(times):6.2f} s ({min(times):.2f} to"
                f" {max(times):.2f}), {max(cost.memory for cost in some):.2f} GB"
            )
        whole = Path(folder) / "whole.copc.laz"
        make_cloud(whole, options.points)
        with serving(whole) as (address, asked):
            command = [sys.executable, "-c", _ASKS, address]
            environment = {**os.environ, "BARE_EARTH_CACHE": str(Path(folder) / "cache")}
            with subprocess.Popen(
                command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment
            ) as process:
                blocks, planned = process.stdout.readline(), asked()
                points, _ = process.communicate("\n")
            requests, size = asked()
        print(f"{int(blocks)} blocks planned by {planned[0]} requests and {planned[1]:,} bytes;")
        print(
            f"{int(points):,} points of 4 km2 by {requests} requests and {size:,} bytes, of a file"
            f" of {whole.stat().st_size:,}"
        )


if __name__ == "__main__":
    main()
