"""How evenly the progress of a run moves: what a user sees who waits for a bar.

    python -m benchmarks.progress tile.laz               # in memory
    python -m benchmarks.progress tile.laz --memory 0.3  # read part by part
    python -m benchmarks.progress tile.laz --steps       # and where in time each figure was

A bar should move every two seconds, and never show one figure for more than a fifth of a run.
"""

from __future__ import annotations

import argparse
import importlib.util
import tempfile
import time
from itertools import groupby
from pathlib import Path
from typing import Any, Callable, NamedTuple

from bare_earth.algorithms.core.parameters import ParameterSet
from bare_earth.algorithms.core.progress import Progress
from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.tools import any_tool
from bare_earth.algorithms.tools.assess import assess_files
from bare_earth.algorithms.tools.ground.output import PointOutput
from bare_earth.algorithms.tools.rasters.parameters import MapTerrain
from bare_earth.algorithms.tools.running import run as work

_RASTERS = ("dtm", "dsm", "chm", "hillshade", "expected_error")


class Recorder(Progress):
    """Keeps when which figure was reported.

    Parameters
    ----------
    clock : callable
        Returns seconds: those on the wall, or of the processor, to which other work is nothing.
    """

    def __init__(self, clock: Callable[[], float] = time.perf_counter) -> None:
        self._clock, self._begun = clock, clock()
        self.moments: list[tuple[float, float]] = []

    def report(self, fraction: float) -> None:
        """Keep it."""
        self.moments.append((self._clock() - self._begun, fraction))

    def pace(self) -> Pace:
        """Return how even it was, once the run is over."""
        end = self._clock() - self._begun
        return pace_of([(0.0, 0.0), *self.moments], end)


class Pace(NamedTuple):
    """How evenly a progress moved.

    Attributes
    ----------
    seconds : float
        Length of the run.
    silence : float
        Longest time without a call, in seconds: a cancel waits for it.
    rest : float
        Longest time in which the fraction did not grow, in seconds.
    stay : float
        Largest share of the run at one whole percent.
    figure : int
        That percent.
    falls : int
        How many times the fraction became smaller.
    """

    seconds: float
    silence: float
    rest: float
    stay: float
    figure: int
    falls: int


def pace_of(moments: list[tuple[float, float]], end: float) -> Pace:
    """Return how evenly a progress moved.

    Parameters
    ----------
    moments : list of (float, float)
        Seconds since the start, and the fraction then.
    end : float
        When the run ended.
    """
    times = [moment for moment, _ in moments] + [end]
    silence = max(later - sooner for sooner, later in zip(times, times[1:]))
    highest, grown = -1.0, []
    for moment, fraction in moments:
        if fraction > highest:
            highest = fraction
            grown.append(moment)
    rest = max(later - sooner for sooner, later in zip(grown, [*grown[1:], end]))
    figures = [(figure, next(reached)[0]) for figure, reached in groupby(moments, _percent)]
    starts = [start for _, start in figures] + [end]
    stays = [(later - start, figure) for (figure, start), later in zip(figures, starts[1:])]
    longest, figure = max(stays)
    falls = sum(later < sooner for (_, sooner), (_, later) in zip(moments, moments[1:]))
    return Pace(end, silence, rest, longest / end, figure, falls)


def _percent(moment: tuple[float, float]) -> int:
    return int(100 * moment[1])


def runs(source: Path, folder: Path, resources: Resources) -> dict[str, Callable[[Progress], Any]]:
    """Return what is measured, by name; the first of them makes what others read."""

    def doing(
        command: str, points: Path, outputs: dict[str, Path], *sets: ParameterSet
    ) -> Callable[[Progress], Any]:
        inputs, sets = {"input": points}, (*sets, resources)
        return lambda progress: work(any_tool(command), inputs, outputs, sets, progress)

    ground = folder / "ground.las"
    rasters = {name: folder / f"{name}.tif" for name in _RASTERS}
    two = {name: rasters[name] for name in ("dtm", "hillshade")}
    found = {
        "TIN densification": doing("classify", source, {"output": ground}),
        "TIN, DTM, hillshade, heights": doing(
            "classify",
            source,
            {"output": folder / "a.laz", **two},
            PointOutput(height_above_ground=True),
        ),
    }
    for name in list(METHODS)[1:]:
        parameters = METHODS[name].parameters()
        found[METHODS[name].label] = doing(
            "classify", source, {"output": folder / "b.laz"}, parameters
        )
    found["Terrain model alone"] = doing("terrain", ground, {"dtm": rasters["dtm"]})
    found["All rasters"] = doing("terrain", ground, rasters)
    found["Height above ground"] = doing("height", ground, {"output": folder / "h.laz"})
    found["Model key points"] = doing("key-points", ground, {"output": folder / "k.laz"})
    pages = folder / "report.html", folder / "errors.tif"
    found["Assess"] = lambda progress: assess_files(ground, ground, *pages, progress=progress)
    maps = {"output": folder / "maps.laz", **rasters, "relief": folder / "relief.tif"}
    if importlib.util.find_spec("osgeo"):
        maps["contours"] = folder / "lines.gpkg"
    found["Point cloud to terrain"] = doing("classify", source, maps, MapTerrain())
    return found


def main() -> None:
    """Measure, and print a table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("source", type=Path)
    parser.add_argument("--memory", type=float, help="in GB")
    parser.add_argument("--only", default="", help="names of runs that hold this")
    parser.add_argument("--steps", action="store_true", help="when each figure was reached, too")
    given = parser.parse_args()
    print("run | seconds | longest silence | longest rest | longest at one figure | falls")
    with tempfile.TemporaryDirectory() as name:
        resources = Resources(memory=given.memory)
        for number, (label, run) in enumerate(runs(given.source, Path(name), resources).items()):
            if number and given.only not in label:
                continue
            recorder = Recorder()
            run(recorder)
            pace = recorder.pace()
            print(
                f"{label} | {pace.seconds:.1f} | {pace.silence:.1f} | {pace.rest:.1f} |"
                f" {pace.stay:.0%} at {pace.figure} % | {pace.falls}",
                flush=True,
            )
            if given.steps:
                firsts = [next(reached) for _, reached in groupby(recorder.moments, _percent)]
                print("  " + "  ".join(f"{100 * f:.0f}%:{t:.1f}s" for t, f in firsts))


if __name__ == "__main__":
    main()
