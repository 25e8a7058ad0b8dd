"""Which jobs do the blocks of a survey."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ..survey.files import Survey
from .block_grid import BlockGrid, BlockIndex, grouped, memory_of, points_in, sources_of
from .jobs import BlockJob
from .workers import Workers


def block_jobs(
    kind: type[BlockJob],
    grid: BlockGrid,
    survey: Survey,
    files: dict[BlockIndex, Path],
    folder: Path,
    tile_count: int,
    workers: Workers,
    **more: Any,
) -> list[BlockJob]:
    """Return the jobs of some blocks, and let the workers begin.

    Parameters
    ----------
    kind : type
        Of the jobs.
    grid, survey
        The blocks, and the files.
    files : dict of BlockIndex to Path
        Where what is made of each block goes.
    folder : Path
        Of the output; all workers see it.
    tile_count : int
        How many files are to be written with what the blocks give.
    workers : Workers
        Who does the jobs.
    **more
        What jobs of this kind know besides.
    """
    least = max((memory_of(grid, survey, [each]) for each in files), default=0)
    workers.start(folder, least, len(files), tile_count)
    sources = {each: sources_of(grid, survey, each) for each in files}
    groups = grouped(grid, survey, list(files), workers.at_once, workers.share.bytes)
    return [
        kind(
            grid,
            tuple(group),
            tuple(files[each] for each in group),
            tuple(sorted(set().union(*(sources[each] for each in group)))),
            points_in(survey, grid.window(group)),
            **more,
        )
        for group in groups
    ]
