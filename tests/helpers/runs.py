"""Runs of the engine, called with what a test is about and nothing else."""

from __future__ import annotations

import contextlib
import io
import os
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

import bare_earth
from bare_earth import Cancelled, Progress
from bare_earth.algorithms.classes.ground_classes import ROADS_FLAG
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.core.temporary import is_temporary
from bare_earth.algorithms.engine.memory_store import MemoryStore
from bare_earth.algorithms.engine.options import TileOutput
from bare_earth.algorithms.engine.run import Run
from bare_earth.algorithms.engine.store import Marks
from bare_earth.algorithms.las.return_numbers import MULTI_RETURN, SeveralReturns
from bare_earth.algorithms.survey.files import Inputs
from bare_earth.algorithms.tools import map_tool
from bare_earth.algorithms.tools.ground.output import PointOutput

# The fastest filter, for tests that are not about what is ground: for functions and for commands.
FAST = {"method": "slope", "preset": "whitebox"}
FAST_WORDS = ("--method", "slope", "--preset", "whitebox")


class Heard(Progress):
    """Keeps what it is told."""

    def __init__(self):
        self.fractions, self.infos, self.warnings = [], [], []

    def report(self, fraction):
        self.fractions.append(fraction)

    def info(self, text):
        self.infos.append(text)

    def warning(self, text):
        self.warnings.append(text)


class CancelAt(Heard):
    """Cancels from a share of the work on, and knows how far it came."""

    def __init__(self, fraction=0.0):
        super().__init__()
        self.fraction, self.last = fraction, 0.0

    def report(self, fraction):
        self.last = max(self.last, fraction)
        if fraction >= self.fraction:
            raise Cancelled


class CancelAtFirstFile(Progress):
    """Cancels when the first file of a survey is done."""

    is_asked = False

    def info(self, text):
        self.is_asked = self.is_asked or ".laz:" in text

    def report(self, fraction):
        if self.is_asked:
            raise Cancelled


def temporary_in(folder):
    """Return the temporary files and folders that are left in a folder."""
    return [path for path in Path(folder).rglob("*") if is_temporary(path)]


def said(*words):
    """Run the command here; return its exit code, what it says, and what of what went wrong."""
    out, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(out):
        code = main([*map(str, words)])
    return code, out.getvalue(), errors.getvalue()


def command(*words):
    """Return the command as a process of its own takes it."""
    return [sys.executable, "-m", "bare_earth.algorithms", *map(str, words)]


def environment():
    """Return the environment of such a process, which finds the package."""
    path = [str(Path(bare_earth.__file__).parents[1]), os.environ.get("PYTHONPATH", "")]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, path))}


def classify_tiles(
    sources, folder, parameters, progress=Progress(), workers=None, blocks=None,
    output=TileOutput(), points=PointOutput(),
):  # fmt: skip
    """Classify many files with workers and blocks that users cannot choose."""
    inputs = Inputs(sources, is_survey=True)
    ground, *others = map_tool("classify").steps([parameters, points], {"input": inputs}, {})
    run = Run((replace(ground, cut=blocks), *others), output)
    return run.work(inputs, folder, progress, workers, folder / "classified.vpc")


def memory_store(parts, frame, blocks):
    """Return a store of clouds in memory, each given with its marks."""
    store = MemoryStore(frame, blocks)
    for cloud, *marks in parts:
        none = np.zeros(cloud.count, dtype=bool)
        flags = {MULTI_RETURN: SeveralReturns(cloud), ROADS_FLAG: none}
        store.append(cloud, Marks(*marks)._replace(flags=flags))
    store.finish()
    return store
