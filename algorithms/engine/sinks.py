"""Runs a sink on a survey: results of blocks are kept in files until outputs are made of them."""

from __future__ import annotations

import contextlib
from collections import Counter
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, Sequence

from ..core.errors import BareEarthError, Cancelled
from ..core.files import Outputs
from ..core.progress import SILENT, Progress
from ..core.temporary import remove
from ..las.cloud import survey_frame
from ..survey.files import Survey
from ..survey.shapes import outside
from .block_grid import BlockGrid, BlockIndex, least_memory, places_of, sources_of
from .job_queue import JobQueue
from .jobs import BlockJob
from .manifest import block_file, stamp_of
from .plan import block_jobs
from .results import Results
from .step import AROUND_AREA, Sink
from .unpacking import Unpacking
from .values import BlockFiles, arrays_in
from .workers import Workers


def run_sink(
    survey: Survey,
    folder: Path,
    step: Sink,
    workers: Workers,
    progress: Progress = SILENT,
    results: Results | None = None,
    unpacking: Unpacking | None = None,
    outputs: Outputs | None = None,
) -> Any:
    """Run a sink on a survey, or on `results` for its points, stop the workers, and return the
    summary of the sink; raise an error if a block fails.
    """
    # The results of blocks are written into `folder`, which exists and which all workers see.
    # Results that a cancelled or killed run left there are used if nothing has changed.
    results = results or Results(survey)
    tiles, survey = survey.tiles, results.survey
    frame = survey_frame(survey.crs, step.blocks.origin)
    reading, progress = progress.part(0.0, 0.05), progress.part(0.05, 1.0)
    step = step.with_all_points(partial(results.parts, unpacking, reading), frame, reading)
    grid = BlockGrid(frame, step, survey.stated)
    places = sorted({place for tile in survey.tiles for place in places_of(grid, tile)})
    if step.area is not None:
        box = step.area.buffered_box(AROUND_AREA / frame.horizontal_unit)
        places = grid.among(places, box)
        if not places:
            raise outside("the area", step.area.bounds, "the files", survey.box)
    sources = {place: sources_of(grid, survey, place) for place in places}
    stamps = {path: stamp_of(source) for path, source in results.read_from.items()}
    grids = [*(earlier.grid for earlier in results.earlier), grid]
    files = {
        place: block_file(grids, folder, place, [stamps[path] for path in paths])
        for place, paths in sources.items()
    }
    is_cancelled = False
    try:
        missing = {place: file for place, file in files.items() if not file.exists()}
        least = max((least_memory(grid, survey, place) for place in missing), default=0)
        workers.start(folder, least, len(missing), 0)

        def before(group: Sequence[BlockIndex]) -> tuple[BlockFiles, ...]:
            return tuple(earlier.within(grid.window(group)) for earlier in results.earlier)

        read = {place: [results.read_from[path] for path in sources[place]] for place in missing}
        jobs = [
            replace(job, finished=results.finished.intersection(job.sources))
            for job in block_jobs(grid, survey, missing, read, before, workers, unpacking)
        ]
        jobs = _reading_once(jobs)
        # The results of earlier steps stay as long as a cancelled run may be continued.
        kept = {file for job in jobs for file in job.needs}
        queue = JobQueue(jobs, [], workers, progress.part(0.0, 0.8), kept)
        queue.work()
        if queue.lost:
            reason = next(iter(queue.lost.values()))
            names = ", ".join(path.name for _, path in step.outputs)
            raise BareEarthError(f"{names} cannot be made. {reason}")
        of_blocks = [arrays for file in files.values() for arrays in arrays_in(file)]
        with contextlib.ExitStack() as opened:
            outputs = outputs or opened.enter_context(Outputs())
            return step.finish(of_blocks, frame, outputs, progress.part(0.8, 1.0), tiles)
    except Cancelled:
        is_cancelled = True
        raise
    finally:
        if not is_cancelled:
            for file in files.values():
                remove(file)


def _reading_once(jobs: list[BlockJob]) -> list[BlockJob]:
    """Return the jobs, changed so that files that only one job reads are not unpacked."""
    uses = Counter(path for job in jobs for path in job.sources)
    once = frozenset(path for path, count in uses.items() if count == 1)
    return [
        job
        if job.unpacking is None
        else replace(job, unpacking=job.unpacking._replace(once=once.intersection(job.sources)))
        for job in jobs
    ]
