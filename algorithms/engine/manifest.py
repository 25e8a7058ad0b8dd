"""Records of what each output was made from, so that `--resume` finds the finished ones."""

from __future__ import annotations

import base64
import contextlib
import hashlib
import json
import os
from pathlib import Path
from typing import Any, Dict, Iterable, List, Mapping, Sequence, Union

from ..core.errors import BareEarthError
from ..core.files import replacing
from ..core.temporary import patiently
from .block_grid import BlockGrid, BlockIndex

_FOLDER = ".bare-earth"
_WORK = "work"
_LONGEST_NAME = 250

# The result of `fingerprint_of`; two outputs are equal if theirs are.
Fingerprint = Dict[str, object]


def folders_of(folder: Path) -> tuple[Path, Path, Path]:
    """Return the folders of the outputs, of their records, and of the results of blocks."""
    return folder, folder / _FOLDER, folder / _FOLDER / _WORK


def names_beside(target: str) -> list[str]:
    """Return the longest names that a run makes in the folder of an output with this name."""
    return [target, f"{_FOLDER}/{target}.json", f"{_FOLDER}/{_WORK}/{'x' * 17}"]


# Path, size and time of a file, which show whether it has changed.
Stamp = List[Union[str, int]]


def stamp_of(path: Path) -> Stamp:
    """Return path, size and time of a file that must be readable."""
    try:
        status = path.stat()
    except OSError as error:
        raise BareEarthError(f"Cannot read {path}: {error.strerror or error}.") from error
    return [str(path.resolve()), status.st_size, status.st_mtime_ns]


def fingerprint_of(
    grids: Sequence[BlockGrid], tile: Path, sources: Iterable[Stamp], target: Path
) -> Fingerprint:
    """Return everything that an output depends on: the steps with their blocks, the input, the
    files that affect it (`sources`), and its name.
    """
    return {
        "steps": _settings(grids),
        "input": tile.name,
        "output": target.name,
        "files": list(sources),
    }


def block_file(
    grids: Sequence[BlockGrid], folder: Path, place: BlockIndex, sources: Iterable[Stamp]
) -> Path:
    """Return the file for the result of a block of the last grid, with a name that depends on
    everything that the result depends on.
    """
    content = {"steps": _settings(grids), "place": list(place), "files": list(sources)}
    return folder / f"{short_name(json.dumps(content, sort_keys=True).encode())}.npz"


def short_name(content: bytes) -> str:
    """Return a name of 12 characters that depends on some content, for a file in a work folder."""
    # Short, since Windows allows most programs 259 characters for a whole path. The name has 60
    # bits: two of a million files have the same name once in two million runs.
    return base64.b32encode(hashlib.sha256(content).digest())[:12].decode().lower()


def _settings(grids: Sequence[BlockGrid]) -> list[dict[str, object]]:
    from ..core.version import __version__

    return [
        {
            "version": __version__,
            **grid.step.settings,
            "origin": list(grid.frame.origin),
            "units": [grid.frame.horizontal_unit, grid.frame.vertical_unit],
            "blocks": [grid.blocks.side, grid.blocks.buffer, grid.blocks.most_points],
        }
        for grid in grids
    ]


def write_record(target: Path, fingerprint: Fingerprint, summary: Mapping[str, object]) -> None:
    """Write the record of an output after the output; the fingerprint is from before its inputs
    were read.
    """
    content = {"made_of": fingerprint, "size": target.stat().st_size, "summary": summary}
    with replacing(_place(target)) as temporary:
        temporary.write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def read_record(target: Path) -> tuple[Fingerprint, dict[str, Any]] | None:
    """Return the record and the summary of an output; None if it is not finished."""
    try:
        content = json.loads(_place(target).read_text(encoding="utf-8"))
        if target.stat().st_size != content["size"]:
            return None
        return content["made_of"], content["summary"]
    except (OSError, ValueError, KeyError, TypeError):
        return None


def remove_record(target: Path) -> None:
    """Remove the record of an output, which is then no longer finished."""
    with contextlib.suppress(FileNotFoundError):
        patiently(os.unlink, _place(target))


def _place(target: Path) -> Path:
    name = os.fsencode(target.name)
    if len(name) > _LONGEST_NAME:  # so long that .json does not fit
        return target.parent / _FOLDER / f"{hashlib.sha256(name).hexdigest()}.json"
    return target.parent / _FOLDER / f"{target.name}.json"
