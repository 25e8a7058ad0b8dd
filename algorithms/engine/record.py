"""What a classified tile was made of, so that a later run knows whether it is done."""

from __future__ import annotations

import hashlib
import json
import os
from pathlib import Path
from typing import Any, Iterable

from ..core.errors import BareEarthError
from ..core.files import replacing
from .block_grid import BlockGrid, BlockIndex
from .steps import Step

_FOLDER, _LABELS = ".bare-earth", "labels"
_LONGEST_NAME = 250

# What `made_of` returns; equal where the output is.
Record = dict


def folders_of(folder: Path) -> tuple[Path, Path, Path]:
    """Return the folder of the output, that of the records, and that of the labels of blocks."""
    return folder, folder / _FOLDER, folder / _FOLDER / _LABELS


# Path, size and time of a file: by them it is seen that it has changed.
State = list


def state_of(path: Path) -> State:
    """Return by what it is seen that a file has changed.

    Raises
    ------
    BareEarthError
        If it is not there.
    """
    try:
        status = path.stat()
    except OSError as error:
        raise BareEarthError(f"Cannot read {path}: {error.strerror or error}.") from error
    return [str(path.resolve()), status.st_size, status.st_mtime_ns]


def made_of(
    grid: BlockGrid, step: Step, tile: Path, sources: Iterable[State], target: Path
) -> Record:
    """Return all that an output depends on.

    Parameters
    ----------
    grid : BlockGrid
        The blocks of the survey.
    step : Step
        What is made.
    tile : Path
        The input.
    sources : iterable of State
        The files whose points matter for it.
    target : Path
        The output.
    """
    return {
        **_settings(grid, step),
        "input": tile.name,
        "output": target.name,
        "files": list(sources),
    }


def label_file(
    grid: BlockGrid, step: Step, folder: Path, place: BlockIndex, sources: Iterable[State]
) -> Path:
    """Return where what is found in a block is kept; the name tells all that it depends on."""
    content = {
        **_settings(grid, step),
        "place": list(place),
        "files": list(sources),
    }
    digest = hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()
    return folder / f"{place.column}_{place.row}_{digest[:20]}.npz"


def _settings(grid: BlockGrid, step: Step) -> dict[str, Any]:
    from ..core.version import __version__

    blocks = grid.blocks
    return {
        "version": __version__,
        **step.settings(),
        "origin": list(grid.frame.origin),
        "units": [grid.frame.horizontal_unit, grid.frame.vertical_unit],
        "blocks": [blocks.side, blocks.buffer, blocks.most_points],
    }


def write_record(target: Path, record: Record, summary: dict[str, Any]) -> None:
    """Keep from what a tile was made, after it was written.

    Parameters
    ----------
    target : Path
        The output.
    record : Record
        What `made_of` returned before the inputs were read.
    summary : dict
        What became of it.
    """
    content = {"made_of": record, "size": target.stat().st_size, "summary": summary}
    with replacing(_place(target)) as temporary:
        temporary.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def read_record(target: Path) -> tuple[Record, dict[str, Any]] | None:
    """Return from what a tile was made, and what became of it; None if it is not done."""
    try:
        content = json.loads(_place(target).read_text(encoding="utf-8"))
        if target.stat().st_size != content["size"]:
            return None
        return content["made_of"], content["summary"]
    except (OSError, ValueError, KeyError, TypeError):
        return None


def remove_record(target: Path) -> None:
    """Say that a tile is not done."""
    _place(target).unlink(missing_ok=True)


def _place(target: Path) -> Path:
    name = os.fsencode(target.name)
    if len(name) > _LONGEST_NAME:  # which leaves no room for what follows it
        return target.parent / _FOLDER / f"{hashlib.sha256(name).hexdigest()}.json"
    return target.parent / _FOLDER / f"{target.name}.json"
