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
from .declaration import Automatic, FileTool, MapTool, Output, PointTool, Tool

if TYPE_CHECKING:
    from ..engine.workers import Workers

_FILES = ("cloud", "raster", "terrain", "address")


def run(
    tool: Tool,
    inputs: Mapping[str, Any],
    outputs: Mapping[str, str | Path | None] = {},
    sets: Sequence[ParameterSet] = (),
    progress: Progress = SILENT,
    workers: Workers | None = None,
) -> Any:
    """Run a tool with inputs and outputs by name, and return its summary; `workers` do the work on
    many files.
    """
    paths = {name: Path(path) for name, path in outputs.items() if path}
    if isinstance(tool, FileTool):
        return _run_on_files(tool, inputs, paths, sets, progress)
    if isinstance(tool, (PointTool, MapTool)):
        return _run_on_points(tool, inputs, paths, sets, progress, workers)
    raise TypeError(f"{tool.command} cannot be run by itself: it runs other tools.")


def _run_on_points(
    tool: PointTool | MapTool,
    inputs: Mapping[str, Any],
    outputs: dict[str, Path],
    sets: Sequence[ParameterSet],
    progress: Progress,
    workers: Workers | None,
) -> Any:
    """Run the steps of a tool, and then the tools that draw more outputs from its rasters; either
    all outputs are written, except the folder of many files, or none.
    """
    points = Inputs(inputs["input"]).read_as(inputs.get("crs"), TileInput.among(sets).recursive)
    sets = [values for values in sets if points.is_survey or not values.only_for_many]
    check_outputs(_kinds(tool, points, outputs), points)
    inputs, progress = _resolve_automatic_inputs(tool, {**inputs, "input": points}, sets, progress)
    drawings = [output for output in tool.all_outputs if output.drawn_by and output.name in outputs]
    working, *drawing = progress.shares(9.0, *(1.0 for _ in drawings)) if drawings else [progress]
    with contextlib.ExitStack() as opened:
        paths, summaries = dict(outputs), {}
        # Files that the user does not ask for, but steps or drawings need, are temporary.
        needed = {name: f"{name}.tif" for one in drawings for name in one.drawn_of.values()}
        if tool.writes_points:
            needed["output"] = "cloud.las"
        folders = [path.parent for path in outputs.values() if path.parent.is_dir()]
        beside = (*folders, Path(tempfile.gettempdir()))[0]
        for name in needed.keys() - paths.keys():
            paths[name] = opened.enter_context(temporary_folder(beside)) / needed[name]
        for output in drawings:
            del paths[output.name]
        steps = tool.steps(sets, inputs, paths)
        run_of_steps = Run(steps, TileOutput.among(sets), Resources.among(sets))
        target = paths.get("output")
        vpc = paths.get("vpc") or (target and target / tool.list_name)
        # A virtual raster can be read only after its rasters have been moved to their places.
        written = [output for step in steps for output in step.outputs]
        virtual = {path: virtual_of(path) for kind, path in written if kind == "raster set"}
        pending = None if virtual else opened.enter_context(Outputs())
        summary = run_of_steps.work(points, target, working, workers, vpc, pending)
        for output, part in zip(drawings, drawing):
            reads = {
                name: virtual[paths[of]] if pending is None else pending.waiting(paths[of])
                for name, of in output.drawn_of.items()
            }
            if not all(path.exists() for path in reads.values()):
                continue  # of files without points there is no raster
            drawn = _draw(output, {**inputs, **reads}, outputs[output.name], sets, part, pending)
            summaries[output.name] = drawn
    if summaries:
        object.__setattr__(summary, "drawn", summaries)  # it is a frozen dataclass
    return summary


def _draw(
    output: Output,
    inputs: Mapping[str, Any],
    path: Path,
    sets: Sequence[ParameterSet],
    progress: Progress,
    pending: Outputs | None,
) -> Any:
    """Let a tool draw an output from rasters, with those inputs of the run that it has too."""
    tool = file_tool(output.drawn_by)
    main = next(one.name for one in tool.outputs if one.is_main)
    given = {one.name: inputs[one.name] for one in tool.inputs if one.name in inputs}
    summary = _run_on_files(tool, given, {main: path}, sets, progress, pending)
    progress.info(f"{output.name}: {summary.text}")
    return summary


def _kinds(tool: Tool, points: Inputs, outputs: Mapping[str, Path]) -> Iterator[tuple[str, Path]]:
    """Yield the kinds and paths of the outputs, except of those in a folder that the run makes."""
    kinds = {output.name: output.kind for output in tool.all_outputs}
    kinds.update(output=points.output_kind, vpc="list")
    folder = outputs.get("output") if points.output_kind == "folder" else None
    for name, path in outputs.items():
        if name == "vpc" and folder is None:
            continue  # one file has no list
        if folder is None or path.parent != folder or folder.exists():
            yield kinds[name], path


def _resolve_automatic_inputs(
    tool: Tool, inputs: dict[str, Any], sets: Sequence[ParameterSet], progress: Progress
) -> tuple[dict[str, Any], Progress]:
    """Return the inputs with the values in place of `Automatic`, and the rest of the progress."""
    progress = progress.once()  # the points are opened to find something, and for the run
    for declared in tool.inputs:
        value = inputs.get(declared.name)
        if isinstance(value, Automatic) and declared.found is not None:
            ground, part = GroundClasses.among(sets), progress.part(0.0, 0.4)
            found = declared.found(inputs["input"], ground, part)  # this can take minutes
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
    """Check the outputs, run the tool, and return its summary; either all outputs are written,
    together with the `pending` ones, or none.
    """
    arguments: dict[str, Any] = {declared.name: None for declared in tool.inputs}
    arguments.update({output.name: None for output in tool.outputs}, **inputs)
    for declared in tool.inputs:
        if declared.kind == "clouds":
            points = Inputs(arguments[declared.name] or ())
            arguments[declared.name] = points.read_as(arguments.pop("crs", None))
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
            arguments[output.name] = places if output.files else places[output.name]
        summary = tool.work(**arguments, **_by_argument(tool, sets), progress=progress)
        progress(1.0)  # the last moment to cancel: after this the files get their names
    # The summary names the outputs of the user, not the temporary files.
    named = {output.name: str(path) for output, path, _ in wanted if hasattr(summary, output.name)}
    return dataclasses.replace(summary, **named) if named else summary


def _sources(tool: FileTool, inputs: Mapping[str, Any]) -> list[Path]:
    """Return the files and folders that the tool reads, which no output may replace."""
    sources: list[Path] = []
    for declared in tool.inputs:
        value = inputs.get(declared.name)
        if declared.kind == "clouds":
            sources += value or ()
        elif not value or declared.kind not in _FILES or isinstance(value, MemoryRaster):
            continue
        elif not is_address(str(value)):
            sources.append(Path(value))
    return sources


def _by_argument(tool: FileTool, sets: Sequence[ParameterSet]) -> dict[str, ParameterSet]:
    """Return the sets that are arguments of `work`, by the names of these arguments."""
    arguments = inspect.signature(tool.work).parameters.values()
    return {
        argument.name: values
        for argument in arguments
        for values in sets
        if isinstance(values, type(argument.default))
    }
