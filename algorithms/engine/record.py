"""What a classified tile was made of, so that a later run knows whether it is done."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Any, Iterable

from ..core.errors import BareEarthError
from ..core.files import replacing
from .options import as_plain
from .survey import BlockIndex, Survey

_FOLDER, _LABELS = ".bare-earth", "labels"

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


def made_of(survey: Survey, tile: Path, sources: Iterable[State], target: Path) -> Record:
    """Return all that the classification of a tile depends on.

    Parameters
    ----------
    survey : Survey
        Parameters, frame and blocks.
    tile : Path
        The input.
    sources : iterable of State
        The files whose points matter for it.
    target : Path
        The output.
    """
    return {
        **_settings(survey),
        "input": tile.name,
        "output": target.name,
        "files": list(sources),
    }


def label_file(survey: Survey, folder: Path, place: BlockIndex, sources: Iterable[State]) -> Path:
    """Return where the labels of a block are kept; the name tells all that they depend on."""
    content = {
        **_settings(survey),
        "place": list(place),
        "files": list(sources),
    }
    digest = hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()
    return folder / f"{place.column}_{place.row}_{digest[:20]}.npz"


def _settings(survey: Survey) -> dict[str, Any]:
    from ..core.version import __version__
    from ..filters import method_of

    blocks = survey.blocks
    return {
        "version": __version__,
        "method": method_of(survey.parameters).name,
        "parameters": as_plain(survey.parameters),
        "selection": as_plain(survey.selection),
        "origin": list(survey.frame.origin),
        "units": [survey.frame.horizontal_unit, survey.frame.vertical_unit],
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
    return target.parent / _FOLDER / f"{target.name}.json"
