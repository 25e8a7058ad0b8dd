"""Commands that run a compared setting on all points."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Sequence

from ..core.commands import shell_line
from ..core.files import split_name
from ..runs.options import TileMethod
from ..survey.files import is_one_file
from .options import Setting
from .page import Commands

_MANY_FILES = "bareearth:classifytiles"


def commands_for(paths: Sequence[Path], setting: Setting, crs: str | None = None) -> Commands:
    """Return the commands that run a setting on all points of a file, or inputs of a survey."""
    method, preset, is_one = setting.method.name, setting.preset, is_one_file(paths)
    output, options = _output(paths[0], setting, is_one), ["--method", method, "--preset", preset]
    options += ["--crs", crs] if crs else []
    shell = shell_line(["bare-earth", "classify", *map(str, paths), str(output), *options])
    # QGIS has another current folder.
    *sources, target = (str(path.absolute()) for path in (*paths, output))
    call: tuple[str, dict[str, Any]]
    if is_one:
        algorithm = f"bareearth:{setting.method.toolbox.identifier}"
        call = algorithm, {"INPUT": sources[0], "PRESET": preset, "OUTPUT": target}
    else:
        choices = {each.name: each.choices for each in TileMethod.declarations()}
        if preset not in choices["preset"]:
            return Commands(shell, "")
        call = _MANY_FILES, {
            "INPUT": sources, "METHOD": method, "PRESET": preset, "OUTPUT_FOLDER": target,
        }  # fmt: skip
    if crs:
        call[1]["CRS"] = crs
    return Commands(shell, "processing.run({!r}, {!r})".format(*call))


def _output(first: Path, setting: Setting, is_one: bool) -> Path:
    """Return an output beside the input: a file for one file, a folder for many."""
    name, suffix = split_name(first)
    added = setting.name.replace(":", "_")
    return first.with_name(f"{name}_{added}{suffix if is_one else ''}")
