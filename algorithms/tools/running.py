"""Runs a tool of any kind, for the command line, the library, the dialogs and deliveries."""

from __future__ import annotations

import contextlib
import dataclasses
import inspect
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator, Mapping, Sequence

from ..classes.ground_classes import GroundClasses
from ..core.files import Outputs, new_folder, temporary_folder
from ..core.parameters import ParameterSet
from ..core.progress import SILENT, Progress
from ..engine.memory import Resources
from ..engine.options import TileInput, TileOutput
from ..engine.run import Run
from ..rasters.content import MemoryRaster
from ..rasters.virtual import virtual_of
from ..remote.addresses import is_address
from ..survey.files import Inputs
from ..survey.outputs import check_outputs, place
from . import file_tool
from .declaration import FileTool, MapTool, PointTool, ToFind, Tool

if TYPE_CHECKING:
    from ..engine.workers import Workers

_FILES = ("cloud", "raster", "address")


def run(
    tool: Tool,
    inputs: Mapping[str, Any],
    outputs: Mapping[str, str | Path | None] = {},
    sets: Sequence[ParameterSet] = (),
    progress: Progress = SILENT,
    workers: Workers | None = None,
) -> Any:
    """Let a tool work, given inputs and outputs by their names, and return what it found; `workers`
    are those of many files.
    """
    paths = {name: Path(path) for name, path in outputs.items() if path}
    if isinstance(tool, FileTool):
        return _run_on_files(tool, inputs, paths, sets, progress)
    if isinstance(tool, (PointTool, MapTool)):
        return _run_on_points(tool, inputs, paths, sets, progress, workers)
    raise TypeError(f"{tool.command} has no run of its own.")


def _run_on_points(
    tool: PointTool | MapTool,
    inputs: Mapping[str, Any],
    outputs: dict[str, Path],
    sets: Sequence[ParameterSet],
    progress: Progress,
    workers: Workers | None,
) -> Any:
    """Let the steps of a tool work, and then the tools that draw further outputs of theirs; all but
    the folder of many files are written, or none.
    """
    points = Inputs(inputs["input"]).read_as(inputs.get("crs"), TileInput.among(sets).recursive)
    sets = [values for values in sets if points.is_survey or not values.only_for_many]
    check_outputs(_kinds(tool, points, outputs), points)
    given, progress = _with_found(tool, {**inputs, "input": points}, sets, progress)
    drawn = [output for output in tool.all_outputs if output.drawn_by and output.name in outputs]
    working, *drawing = progress.shares(9.0, *(1.0 for _ in drawn)) if drawn else [progress]
    with contextlib.ExitStack() as opened:
        own, told = dict(outputs), {}
        # What nobody asks for, but others need, is a temporary file.
        needed = {output.drawn_of: f"{output.drawn_of}.tif" for output in drawn}
        if tool.writes_points:
            needed["output"] = "cloud.las"
        for name in needed.keys() - own.keys():
            folder = opened.enter_context(temporary_folder(_folder_among(outputs)))
            own[name] = folder / needed[name]
        for output in drawn:
            del own[output.name]
        steps = tool.steps(sets, given, own)
        work = Run(steps, TileOutput.among(sets), Resources.among(sets))
        target = own.get("output")
        vpc = own.get("vpc") or (target and target / tool.list_name)
        # A virtual raster can only be read when its rasters have their names.
        written = [output for step in steps for output in step.outputs]
        virtual = {path: virtual_of(path) for kind, path in written if kind == "raster set"}
        pending = None if virtual else opened.enter_context(Outputs())
        done = work.work(points, target, working, workers, vpc, pending)
        for output, part in zip(drawn, drawing):
            path, lines = own[output.drawn_of], {"output": outputs[output.name]}
            source = virtual[path] if pending is None else pending.waiting(path)
            drawing_tool = file_tool(output.drawn_by)
            told[output.name] = _run_on_files(
                drawing_tool, {"source": source}, lines, sets, part, pending
            )
    if told:
        object.__setattr__(done, "drawn", told)  # it is a frozen dataclass
    return done


def _folder_among(outputs: Mapping[str, Path]) -> Path:
    """Return the first folder of outputs that is there."""
    folders = (path.parent for path in outputs.values())
    return next((folder for folder in folders if folder.is_dir()), Path(tempfile.gettempdir()))


def _kinds(tool: Tool, points: Inputs, outputs: Mapping[str, Path]) -> Iterator[tuple[str, Path]]:
    """Yield the kinds and paths of the outputs, but for those in a folder that the run makes."""
    kinds = {output.name: output.kind for output in tool.all_outputs}
    kinds.update(output=points.output_kind, vpc="list")
    folder = outputs.get("output") if points.output_kind == "folder" else None
    for name, path in outputs.items():
        if name == "vpc" and folder is None:
            continue  # one file has no list
        if folder is None or path.parent != folder or folder.exists():
            yield kinds[name], path


def _with_found(
    tool: Tool, inputs: dict[str, Any], sets: Sequence[ParameterSet], progress: Progress
) -> tuple[dict[str, Any], Progress]:
    """Return the inputs with those that are found first, and what is left of the progress."""
    # To find them can take minutes.
    for declared in tool.inputs:
        value = inputs.get(declared.name)
        if isinstance(value, ToFind) and declared.found is not None:
            ground, part = GroundClasses.among(sets), progress.part(0.0, 0.4)
            found = declared.found(inputs["input"], ground, part)
            if value.given is not None:
                found = value.given.with_water(found, part)
            inputs, progress = {**inputs, declared.name: found}, progress.part(0.4, 1.0)
    return inputs, progress


def _run_on_files(
    tool: FileTool,
    inputs: Mapping[str, Any],
    paths: Mapping[str, Path],
    sets: Sequence[ParameterSet],
    progress: Progress,
    pending: Outputs | None = None,
) -> Any:
    """Check the outputs, and let the tool write them: all of them or none, together with those that
    are `pending`; return what it found.
    """
    given: dict[str, Any] = {declared.name: None for declared in tool.inputs}
    given.update({output.name: None for output in tool.outputs}, **inputs)
    for declared in tool.inputs:
        if declared.kind == "clouds":
            points = Inputs(given[declared.name] or ())
            given[declared.name] = points.read_as(given.pop("crs", None))
    wanted = [
        (output, paths[output.name], output.paths(paths[output.name], sets))
        for output in tool.outputs
        if output.name in paths
    ]
    with contextlib.ExitStack() as opened:
        pending = pending or opened.enter_context(Outputs())
        for _, path, files in wanted:
            if path not in files.values():
                pending.enter_context(new_folder(path))
        kinds = [(output.file_kind, file) for output, _, files in wanted for file in files.values()]
        check_outputs(kinds, _sources(tool, inputs))
        for output, _, files in wanted:
            places = {name: place(pending, output.file_kind, file) for name, file in files.items()}
            given[output.name] = places if output.files else places[output.name]
        found = tool.work(**given, **_by_name(tool, sets), progress=progress)
        progress(1.0)  # the last moment to cancel: after this the files are there
    # What it says of an output is not the temporary path.
    told = {output.name: str(path) for output, path, _ in wanted if hasattr(found, output.name)}
    return dataclasses.replace(found, **told) if told else found


def _sources(tool: FileTool, inputs: Mapping[str, Any]) -> list[Path]:
    """Return the files and folders that are read, which no output may be."""
    sources: list[Path] = []
    for declared in tool.inputs:
        value = inputs.get(declared.name)
        if declared.kind == "clouds":
            sources += value or ()
        elif isinstance(value, MemoryRaster):
            continue
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
