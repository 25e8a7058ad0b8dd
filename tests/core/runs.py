"""Runs of the engine, called with what a test is about and nothing else."""

from __future__ import annotations

import contextlib
import io
import os
import sys
from pathlib import Path

import bare_earth
from bare_earth import Cancelled, Progress
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.core.progress import SILENT
from bare_earth.algorithms.core.temporary import is_temporary
from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.engine.memory_store import MemoryStore
from bare_earth.algorithms.engine.options import TileInput, TileOutput
from bare_earth.algorithms.engine.store import Marks
from bare_earth.algorithms.runs import many_files
from bare_earth.algorithms.runs.entry import classify, terrain
from bare_earth.algorithms.runs.requests import ClassifyRequest, TerrainRequest
from bare_earth.algorithms.survey.ground_classes import GroundClasses
from bare_earth.algorithms.survey.selection import Selection
from bare_earth.algorithms.tools import file_tool
from bare_earth.algorithms.tools.ground.output import Output
from bare_earth.algorithms.tools.rasters.parameters import RasterOutput, SurfaceModel, TerrainModel
from bare_earth.algorithms.tools.rasters.step import RasterFiles
from bare_earth.algorithms.tools.running import run


class CancelAt(Progress):
    """Cancels from a share of the work on, and knows how far it came."""

    def __init__(self, fraction=0.0):
        self.fraction, self.last = fraction, 0.0

    def report(self, fraction):
        self.last = max(self.last, fraction)
        if fraction >= self.fraction:
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


def classify_file(
    source, target, parameters, selection=Selection(), terrain=TerrainModel(),
    dtm=None, hillshade=None, progress=SILENT, area=None, resources=Resources(), output=Output(),
):  # fmt: skip
    request = ClassifyRequest(
        parameters=parameters, selection=selection, area=area, output=output, terrain=terrain,
        rasters=RasterFiles(dtm=dtm, hillshade=hillshade), resources=resources,
    )  # fmt: skip
    return classify(source, target, request, progress)


def classify_tiles(
    sources, folder, parameters, selection=Selection(), files=TileInput(), output=TileOutput(),
    vpc=None, progress=SILENT, workers=None, blocks=None, rasters=RasterFiles(),
    terrain=TerrainModel(), points=Output(), per_file=False,
):  # fmt: skip
    request = ClassifyRequest(
        parameters=parameters, selection=selection, files=files, tiles=output, rasters=rasters,
        terrain=terrain, output=points, raster_output=RasterOutput(per_file),
    )  # fmt: skip
    return many_files.classify_files(sources, folder, request, progress, workers, vpc, blocks)


def write_terrain_models(
    sources, files, ground=GroundClasses(), model=TerrainModel(), surface=SurfaceModel(),
    resources=Resources(), progress=SILENT, workers=None, per_file=False,
):  # fmt: skip
    request = TerrainRequest(
        rasters=files, ground=ground, terrain=model, surface=surface, resources=resources,
        raster_output=RasterOutput(per_file),
    )  # fmt: skip
    return terrain(sources, request, progress, workers)


def memory_store(parts, frame, blocks):
    """Return a store of clouds in memory, each given with its marks."""
    store = MemoryStore(frame, blocks)
    for cloud, *marks in parts:
        store.append(cloud, Marks(*marks))
    store.finish()
    return store


def assess_files(classified, reference, *sets, progress=SILENT, **outputs):
    """Assess a file; return the figures."""
    inputs = {"classified": classified, "reference": reference}
    return run(file_tool("assess"), inputs, outputs, sets, progress)
