"""Measures what `bare-earth fetch` downloads of a large COPC file: `python -m benchmarks.remote`.

A cloud of 2 x 2 km is generated (50 million points take two minutes, 2 GB of disk for a while, and
4 GB of memory) and served on this computer, with a latency of 10 ms for each request. A window of
250 x 250 m is fetched from there and cut out of the file on the disk, in turn.
"""

from __future__ import annotations

import argparse
import contextlib
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import Callable, Iterator

import laspy
import numpy as np

import bare_earth
from bare_earth.algorithms.las.copc_nodes import find_nodes, read_hierarchy
from bare_earth.algorithms.las.edits import Edits
from bare_earth.algorithms.las.opening import open_las
from bare_earth.algorithms.las.writing import write_changed

_TESTS = Path(__file__).parents[1] / "tests" / "helpers"
_STRIPS, _SIDE, _WINDOW, _LATENCY, _RUNS = 20, 2000.0, 250.0, 0.01, 3
# Serves a file until its input ends; for each line, it tells the requests and bytes since the last.
_SERVER = """
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from remote_server import Server
server = Server()
server.latency = float(sys.argv[3])
server.add("whole.copc.laz", Path(sys.argv[2]).read_bytes())
print(server.port, flush=True)
for line in sys.stdin:
    print(len(server.asked), server.sent, flush=True)
    server.asked.clear()
    server.sent = 0
"""


def make_cloud(path: Path, count: int) -> None:
    """Write a COPC file of hills with vegetation, flown in strips."""
    header = laspy.LasHeader(version="1.4", point_format=6)
    header.scales, header.offsets = [0.001] * 3, [650_000, 6_860_000, 0]
    random, width, plain = np.random.default_rng(0), _SIDE / _STRIPS, path.with_suffix(".las")
    with laspy.open(plain, "w", header=header) as file:
        for strip in range(_STRIPS):
            number = count // _STRIPS
            along, across = np.sort(random.random(number)), random.random(number)
            is_plant = random.random(number) < 0.45
            x, y = (strip + across) * width, along * _SIDE
            above = np.where(is_plant, random.random(number) * 15, random.normal(0, 0.03, number))
            points = laspy.ScaleAwarePointRecord.zeros(number, header=header)
            points.x, points.y = 650_000 + x, 6_860_000 + y
            points.z = 50 + 20 * np.sin(x / 150) * np.cos(y / 200) + above
            points.intensity = random.integers(100, 2000, number)
            points.return_number = 1 + is_plant * random.integers(0, 2, number)
            points.number_of_returns = 1 + is_plant
            points.classification = np.where(is_plant, 5, 2)
            points.gps_time = 3e8 + strip * 100 + along * 40
            points.scan_angle = ((across - 0.5) * 4000).astype(int)
            points.point_source_id = np.full(number, strip)
            file.write_points(points)
    write_changed(plain, path, Edits(), memory=3_000_000_000)
    plain.unlink()


@contextlib.contextmanager
def serving(path: Path) -> Iterator[tuple[str, Callable[[], tuple[int, int]]]]:
    """Serve a COPC file; yield its address, and what tells requests and bytes since the last."""
    words = [sys.executable, "-c", _SERVER, str(_TESTS), str(path), str(_LATENCY)]
    pipe = subprocess.PIPE
    with subprocess.Popen(words, stdin=pipe, stdout=pipe, text=True) as server:

        def asked() -> tuple[int, int]:
            server.stdin.write("\n")
            server.stdin.flush()
            requests, sent = map(int, server.stdout.readline().split())
            return requests, sent

        try:
            yield f"http://127.0.0.1:{server.stdout.readline().strip()}/whole.copc.laz", asked
        finally:
            server.kill()


def main() -> None:
    """Measure, and print what was found."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--points", type=float, default=50.0, help="millions")
    parser.add_argument("--corner", type=float, nargs=2, default=(800.0, 900.0), help="metres")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name, contextlib.ExitStack() as ending:
        folder = Path(name)
        whole, local, remote = (folder / f"{each}.copc.laz" for each in ("whole", "disk", "web"))
        make_cloud(whole, int(options.points * 1e6))
        west, south = 650_000 + options.corner[0], 6_860_000 + options.corner[1]
        box = (west, south, west + _WINDOW, south + _WINDOW)
        nodes = find_nodes(read_hierarchy(open_las(whole)), box)
        needed, size = int(nodes["size"].sum()), whole.stat().st_size
        print(f"{size:,} bytes; {len(nodes)} nodes touch the window, with {needed:,} bytes")
        address, asked = ending.enter_context(serving(whole))
        for _ in range(_RUNS):
            begun = time.perf_counter()
            bare_earth.fetch(whole, local, extent=box)
            middle = time.perf_counter()
            bare_earth.fetch(address, remote, extent=box)
            end = time.perf_counter()
            requests, sent = asked()
            is_same = "the same" if local.read_bytes() == remote.read_bytes() else "OTHER"
            print(
                f"{requests} requests, {sent:,} bytes: {sent / needed:.3f} times those of the"
                f" nodes, {sent / size:.2%} of the file; {end - middle:.2f} s, from the disk"
                f" {middle - begun:.2f} s; {is_same} bytes",
                flush=True,
            )


if __name__ == "__main__":
    main()
