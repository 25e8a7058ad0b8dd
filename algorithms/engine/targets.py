"""Refuses, before any work, a survey or outputs that would fail at the end."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Sequence

from ..core.errors import BareEarthError
from ..core.files import check_free, check_lengths, check_output, split_name
from ..las.writing import check_writable
from ..survey.files import Survey
from ..survey.outputs import check_outputs
from ..survey.vpc import check_vpc
from .manifest import names_beside


def check_survey(survey: Survey, folder: Path, vpc: Path, searched: Sequence[Path]) -> None:
    """Refuse a survey and a folder that would fail, or overwrite something."""
    if folder.exists() and not folder.is_dir():
        raise BareEarthError(f"Cannot write into {folder}: it is a file. Give a folder.")
    check_outputs([("folder", folder)])
    output_folder = folder.resolve()
    for path in _paths(survey):
        if path.parent.resolve() == output_folder:
            raise BareEarthError(
                f"Input and output are in the same folder, {folder}. Choose another output."
            )
    for source in filter(Path.is_dir, searched):
        if source.resolve() in output_folder.parents:
            raise BareEarthError(
                f"The output {folder} is in the folder {source}, which is searched for inputs with"
                " all its subfolders. Choose another output."
            )
    check_vpc(vpc)
    check_free(vpc)
    if vpc.parent.resolve() != output_folder:
        check_output(vpc)


def check_step_outputs(
    outputs: Sequence[tuple[str, Path]],
    survey: Survey,
    others: Sequence[Path],
    folder: Path | None = None,
) -> None:
    """Refuse outputs of steps, given as kinds and paths, that could not be written, or that are
    among `others`; the folder of the points need not exist yet.
    """
    is_made = folder is not None and not folder.exists()
    wanted = [output for output in outputs if not (is_made and output[1].parent == folder)]
    check_outputs(wanted, others)
    if any(kind == "raster set" for kind, _ in outputs):
        _check_stems(survey)


def _check_stems(survey: Survey) -> None:
    stems: dict[str, Path] = {}
    for tile in survey.tiles:
        stem = split_name(tile.path)[0]
        first = stems.setdefault(os.path.normcase(stem).lower(), tile.path)
        if first is not tile.path:
            raise BareEarthError(
                f"The rasters of {first} and of {tile.path} would both become {stem}.tif. Rename"
                " one of the files, or make one raster of all."
            )


def targets_of(survey: Survey, folder: Path, format: str = "same") -> dict[Path, Path]:
    """Return the output of each input; refuse outputs with the same name."""
    targets: dict[Path, Path] = {}
    inputs: dict[str, Path] = {}
    for path in _paths(survey):
        name = path.name
        if format != "same":
            name = f"{split_name(path)[0]}.{format}"
        first = inputs.setdefault(os.path.normcase(name).lower(), path)
        if first is not path:
            raise BareEarthError(
                f"{first} and {path} would both become {folder / name}. Rename one of them, or"
                " write them into different folders."
            )
        targets[path] = folder / name
        check_writable(targets[path])
        check_free(targets[path])
    longest = max((target.name for target in targets.values()), key=len, default="")
    check_lengths(folder, names_beside(longest))
    return targets


def _paths(survey: Survey) -> list[Path]:
    """Return the paths of all files, also of those without points or that cannot be read."""
    files = [tile.path for tile in (*survey.tiles, *survey.empty)]
    return files + [tile.path for tile in survey.broken]
