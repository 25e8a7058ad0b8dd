"""Runs commands and functions in this process, and digests all that they write and say."""

from __future__ import annotations

import contextlib
import dataclasses
import io
import json
import os
import re
from pathlib import Path
from typing import Any, Iterator, Mapping
from unittest import mock

import numpy as np

from bare_earth.algorithms import cli
from bare_earth.algorithms.engine import workers

from .commands import COMMANDS
from .digests import Digests, digest, of_fixed_text, of_text
from .functions import FUNCTIONS
from .inputs import write_inputs

METHODS = ("tin-densification", "slope", "grid-minimum")


def of_everything(folder: Path) -> Digests:
    """Return the digests of all commands and functions, run one after the other.

    Parameters
    ----------
    folder : Path
        An empty folder, which keeps what they write.
    """
    write_inputs(folder)
    with working_in(folder):
        return {**of_commands(COMMANDS, folder), **_of_help(folder), **_of_functions(folder)}


def command_names() -> list[str]:
    """Return the names of all commands."""
    return re.findall(r"^    ([a-z][a-z-]*)\b", said_by(["--help"])[1], re.MULTILINE)


def of_folder(folder: Path, name: str) -> Digests:
    """Return the digests of all files that one case wrote, without the records of --resume.

    Beside rasters, QGIS leaves its statistics.
    """
    files = [path for path in sorted((folder / name).rglob("*")) if path.is_file()]
    names = {path.relative_to(folder).as_posix(): path for path in files if path.suffix != ".xml"}
    return {name: digest(path, folder) for name, path in names.items() if "/." not in name}


@contextlib.contextmanager
def working_in(folder: Path) -> Iterator[None]:
    """Work in a folder, with threads in the place of processes, which take long to begin."""
    before = Path.cwd()
    os.chdir(folder)
    try:
        # Help is laid out for the width of the terminal, where there is one.
        with (
            mock.patch.dict(os.environ, COLUMNS="100"),
            mock.patch.object(workers, "Processes", workers.Threads),
        ):
            yield
    finally:
        os.chdir(before)


def said_by(words: list[str]) -> tuple[int, str, str]:
    """Run a command; return its exit code, what it says, and what it says of what went wrong."""
    out, errors = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(errors):
        code = cli.main(words)
    return code, out.getvalue(), errors.getvalue()


def of_commands(commands: Mapping[str, str], folder: Path) -> Digests:
    """Return the digests of commands, by the names of the folders that they write into."""
    found: Digests = {}
    for name, words in commands.items():
        Path(name).mkdir(parents=True)
        code, out, errors = said_by(words.replace("OUT", name).split())
        for key, text in (("out", out), ("errors", f"{code or ''}{errors}")):
            if text:
                found[f"{name}/{key}"] = of_text(text, folder)
        found.update(of_folder(folder, name))
    return found


def _of_help(folder: Path) -> Digests:
    """Return the digests of what --help says, which Python lays out in other ways."""
    found = {}
    asked = [(name, []) for name in command_names()]
    asked += [("classify", ["--method", method]) for method in METHODS[1:]]
    for name, words in asked:
        text = said_by([name, *words, "--help"])[1].partition("\n\n")[2]
        text = text.replace("optional arguments:", "options:")
        text = re.sub(r" \(default: (True|False)\)", "", " ".join(text.split()))
        found["/".join(["help", name, *words[1:]])] = of_fixed_text(text, folder)
    return found


def _of_functions(folder: Path) -> Digests:
    found: Digests = {}
    for name, function in FUNCTIONS.items():
        place = f"library/{name}"
        Path(place).mkdir(parents=True)
        result = function(Path(place))
        found[f"{place}/result"] = of_text(json.dumps(_as_json(result)), folder)
        found.update(of_folder(folder, place))
    return found


def _as_json(value: Any) -> Any:
    """Return a result as what JSON knows, with the names of fields."""
    if dataclasses.is_dataclass(value):
        fields = dataclasses.fields(value)
        return {field.name: _as_json(getattr(value, field.name)) for field in fields}
    if hasattr(value, "_asdict"):
        return _as_json(value._asdict())
    if isinstance(value, dict):
        return {str(key): _as_json(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_as_json(item) for item in value]
    if isinstance(value, (np.ndarray, np.generic)):
        return _as_json(value.tolist())
    return value if isinstance(value, (bool, int, float, str, type(None))) else _shown(value)


def _shown(value: Any) -> str:
    return value.as_posix() if isinstance(value, Path) else type(value).__name__
