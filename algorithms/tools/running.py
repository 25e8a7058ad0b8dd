"""Runs a tool that works on files, for the command line, the library and the dialogs."""

from __future__ import annotations

import dataclasses
import inspect
from pathlib import Path
from typing import Any, Mapping, Sequence

from ..core.files import Outputs, new_folder
from ..core.parameters import ParameterSet
from ..core.progress import SILENT, Progress
from ..remote.addresses import is_address
from ..survey.files import Inputs
from ..survey.outputs import check_outputs, place
from .declaration import FileTool

_FILES = ("cloud", "raster", "address")


def run(
    tool: FileTool,
    inputs: Mapping[str, Any],
    outputs: Mapping[str, str | Path | None] = {},
    sets: Sequence[ParameterSet] = (),
    progress: Progress = SILENT,
) -> Any:
    """Check the outputs, which are given by name, and let the tool write them: all of them or none;
    return what it found.
    """
    given: dict[str, Any] = {declared.name: None for declared in tool.inputs}
    given.update({output.name: None for output in tool.outputs}, **inputs)
    for declared in tool.inputs:
        if declared.kind == "clouds":
            given[declared.name] = Inputs(given[declared.name] or ())
    paths = {name: Path(path) for name, path in outputs.items() if path}
    wanted = [
        (output, paths[output.name], output.paths(paths[output.name], sets))
        for output in tool.outputs
        if output.name in paths
    ]
    with Outputs() as pending:
        for _, path, files in wanted:
            if path not in files.values():
                pending.enter_context(new_folder(path))
        kinds = [(one.file_kind, file) for one, _, files in wanted for file in files.values()]
        check_outputs(kinds, _sources(tool, inputs))
        for output, _, files in wanted:
            places = {name: place(pending, output.file_kind, file) for name, file in files.items()}
            given[output.name] = places if output.files else places[output.name]
        found = tool.work(**given, **_by_name(tool, sets), progress=progress)
        progress(1.0)  # the last moment to cancel: after this the files are there
    # What it says of an output is not the temporary path.
    told = {one.name: str(path) for one, path, _ in wanted if hasattr(found, one.name)}
    return dataclasses.replace(found, **told) if told else found


def _sources(tool: FileTool, inputs: Mapping[str, Any]) -> list[Path]:
    """Return the files and folders that are read, which no output may be."""
    sources: list[Path] = []
    for declared in tool.inputs:
        value = inputs.get(declared.name)
        if declared.kind == "clouds":
            sources += value or ()
        elif value and declared.kind in _FILES and not is_address(str(value)):
            sources.append(Path(value))
    return sources


def _by_name(tool: FileTool, sets: Sequence[ParameterSet]) -> dict[str, ParameterSet]:
    """Return the sets that the work takes, by the names of its arguments."""
    arguments = inspect.signature(tool.work).parameters.values()
    return {
        argument.name: values
        for argument in arguments
        for values in sets
        if isinstance(values, type(argument.default))
    }
