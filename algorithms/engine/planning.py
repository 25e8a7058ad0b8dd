"""Divides the blocks of a survey into jobs."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Mapping, Sequence

from ..survey.files import Survey
from .block_grid import BlockGrid, BlockIndex, grouped, least_memory, points_in
from .jobs import BlockJob
from .workers import Workers


def block_jobs(
    kind: type[BlockJob],
    grid: BlockGrid,
    survey: Survey,
    files: Mapping[BlockIndex, Path],
    sources: Mapping[BlockIndex, Sequence[Path]],
    folder: Path,
    tile_count: int,
    workers: Workers,
    **more: Any,
) -> list[BlockJob]:
    """Return the jobs of some blocks, and start the workers.

    Parameters
    ----------
    kind : type
        Type of the jobs.
    grid, survey
        The blocks, and the files.
    files : mapping of BlockIndex to Path
        The file for the result of each block.
    sources : mapping of BlockIndex to sequence of Path
        The input files that each block needs.
    folder : Path
        Folder of the outputs, which all workers see.
    tile_count : int
        How many files will be written with the results.
    workers : Workers
        The workers.
    **more
        Further attributes of the jobs.
    """
    least = max((least_memory(grid, survey, each) for each in files), default=0)
    workers.start(folder, least, len(files), tile_count)
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
