"""Runs tools of each kind, and shows what they made."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterable, Mapping, Sequence

from qgis.core import QgsProcessingContext, QgsProcessingUtils

from ...algorithms.classes.ground_classes import GroundClasses
from ...algorithms.classes.kept_classes import GROUND
from ...algorithms.classes.selection import Selection
from ...algorithms.core.errors import BareEarthError, Cancelled
from ...algorithms.core.files import split_name
from ...algorithms.rasters.virtual import virtual_of
from ...algorithms.tools.declaration import Composition, FileTool, MapTool, Output, PointTool
from ...algorithms.tools.heights import HEIGHT_DIMENSION
from ...algorithms.tools.rasters.parameters import RasterOutput, TerrainModel
from .. import compat
from ..i18n import mark
from ..styles import clouds, layers
from ..styles.rasters import is_class_raster
from .commands import command_of
from .feedback import FeedbackProgress
from .outputs import CLOUDS, cannot_show, class_raster_of, do_not_load, path_of
from .request import Request, Resolved

# Titles of the layers of classes, by what a tool for points shows.
_TITLES = {"classes": layers.CLASSES, "key points": mark("key points")}
# Functions that combine the numbers of many files; all others are added up.
_TOGETHER = {"MINIMUM": min, "MAXIMUM": max}
# Side of a cell of a raster of classes in metres, unless the run has rasters of its own.
_USUAL_CELL = 1.0
Results = dict[str, Any]


@dataclass
class ToolRun:
    """A run of a tool, and what it shows."""

    tool: Any
    outputs: Sequence[Output]  # with fields
    request: Request
    resolved: Resolved
    looks: dict[str, layers.LayerLook] = field(default_factory=dict)  # by path
    class_counts: Mapping[int, int] = field(default_factory=dict)  # for the end of the log

    @property
    def context(self) -> QgsProcessingContext:
        """Where QGIS finds the layers to load."""
        return self.request.context

    @property
    def progress(self) -> FeedbackProgress:
        """The progress and the log."""
        return self.request.progress

    @property
    def stays(self) -> bool:
        """Whether finished files stay after a cancel."""
        is_run_in_tiles = self.tool.writes_points or isinstance(self.tool, Composition)
        return is_run_in_tiles and self.resolved.points.is_survey

    def path(self, output: Output) -> str:
        """Return the path of an output, empty if it is left out; for points of many files a folder
        of this name without its ending.
        """
        # Asked only in the thread of the work: QGIS loads the layers of its context.
        path = path_of(self.request, output)
        is_folder = output.kind in CLOUDS and self.resolved.points.is_survey
        if is_folder and not isinstance(self.tool, Composition):
            do_not_load(self.context, [path])
            return str(Path(path).with_name(split_name(Path(path))[0]))
        if path and output.needs and self.resolved.given[output.needs].value is None:
            do_not_load(self.context, [path])
            return ""
        return path

    def work(self) -> Results:
        """Run the tool, show what it made, and return the results."""
        # Imported here, so that QGIS starts faster.
        from ...algorithms.tools.running import run

        paths = {output.name: self.path(output) for output in self.outputs}
        resolved = self.resolved
        self.progress.commands += [command_of(self.tool, self.outputs, paths, resolved)]
        inputs = resolved.values
        if not isinstance(self.tool, FileTool):
            inputs.update(input=resolved.points, crs=resolved.stated)
            for one in self.tool.inputs:
                if one.kind == "raster" and inputs.get(one.name) is not None:
                    inputs[one.name] = one.of(inputs[one.name], self.progress.part(0.0, 0.0))
        done = run(self.tool, inputs, paths, resolved.sets, self.progress)
        return _SHOWS[type(self.tool)](self, done, paths)


def _show_files(run: ToolRun, done: Any, paths: dict[str, str]) -> Results:
    """Show what a tool for files made, and return the results."""
    tool, results = run.tool, Results()
    if tool.json is not None:
        lines = done.lines() if hasattr(done, "lines") else [done.text]
        run.progress.info("\n".join(lines))
    for output in run.outputs:
        if path := paths[output.name]:
            results[output.field_name] = path
            if output.kind in CLOUDS and not compat.can_load(path):
                run.progress.info(cannot_show(path))
            if output.look:
                run.looks[path] = layers.look_of(output.look, done)
            files = {} if output.files is None else output.files(Path(path), run.resolved.sets)
            for name, file in files.items():
                compat.load_raster(str(file), run.context)
                run.looks[str(file)] = layers.look_of(name)
                if name in output.layers:
                    results[name.upper()] = str(file)
    told = (*tool.numbers, *tool.texts)
    results.update((name, getattr(done, name.lower())) for name, _ in told)
    # Figures that could not be measured are None, or NaN, which differs from itself, and a
    # verdict that is not given is empty.
    return {
        name: int(value) if isinstance(value, bool) else value
        for name, value in results.items()
        if value is not None and value == value and value != ""
    }


def _show_points(run: ToolRun, done: Any, paths: dict[str, str]) -> Results:
    """Show the points that a tool wrote, and return the results."""
    output, sets = done.vpc or paths["output"], run.resolved.sets
    run.progress.info(done.text)
    numbers = {
        name: _TOGETHER.get(name, sum)(getattr(file, name.lower()) for file in done.tiles)
        for name, _ in run.tool.numbers
    }
    run.class_counts = done.class_counts
    if run.tool.shows == "heights":
        is_z = any(getattr(values, "output_as", "") == "z" for values in sets)
        unit, attribute = done.tiles[0].unit_size, "Z" if is_z else HEIGHT_DIMENSION
        look = layers.heights(attribute, numbers["MAXIMUM"], unit)
    else:
        look = layers.classes(done.class_counts, _TITLES[run.tool.shows])
    first = (*GroundClasses.among(sets).ground_classes, GROUND)[0]
    _show_cloud(run, output, look, done.class_counts, first)
    return {"OUTPUT": output, **numbers}


def _show_maps(run: ToolRun, done: Any, paths: dict[str, str]) -> Results:
    """Show points, rasters and lines that a tool made, and return the results."""
    tool, sets = run.tool, run.resolved.sets
    if tool.points.kind == "files":
        run.progress.info(f"{done.text}.")
        paths["vpc"] = done.vpc
    elif tool.classifies:
        counts = done.area_ground_count, done.area_count
        run.progress.share(*counts, in_area=bool(run.resolved.given["area"].value))
    else:
        run.progress.info(f"The rasters have {done.columns:,} x {done.rows:,} cells.")
    results: Results = {one.field_name: paths[one.name] for one in run.outputs if paths[one.name]}
    if run.resolved.points.is_survey and RasterOutput.among(sets).raster_per_file:
        rasters = [one.field_name for one in run.outputs if one.kind == "raster"]
        results.update(
            _load_virtual(run, {name: results[name] for name in rasters if name in results})
        )
    if tool.classifies:
        run.class_counts, model = done.class_counts, TerrainModel.among(sets)
        cells = model.dtm_cell_size, model.dtm_cell_unit == "crs"
        ground = Selection.among(sets).to_class
        show_classified(run, done.vpc or paths["output"], done.class_counts, ground, cells)
    return {**results, **{name: getattr(done, name.lower()) for name, _ in tool.numbers}}


def _load_virtual(run: ToolRun, paths: dict[str, str]) -> dict[str, str]:
    """Let QGIS load virtual rasters in place of those of many files, and return their paths."""
    loaded = run.context.layersToLoadOnCompletion()
    found = {name: str(virtual_of(Path(path))) for name, path in paths.items()}
    for name, path in paths.items():
        if path in loaded:
            loaded[found[name]] = loaded.pop(path)
    run.context.setLayersToLoadOnCompletion(loaded)
    return found


_SHOWS = {FileTool: _show_files, PointTool: _show_points, MapTool: _show_maps}


def show_classified(
    run: ToolRun,
    cloud: str,
    classes: Iterable[int],
    ground_class: int,
    cells: tuple[float, bool],
    hides: int = layers.CLOUD,
) -> None:
    """Show a classified point cloud, which may be virtual, with its classes, or the usual ones if
    none are given; the other arguments are those of `_show_cloud`.
    """
    classes = list(classes) or clouds.usual_classes(ground_class)
    is_virtual = cloud.endswith(".vpc")
    # At small scales QGIS shows outlines, and the terrain must be visible through these.
    is_hiding = not (is_virtual and hides == layers.CLOUD)
    look = layers.classes(classes, hides=hides if is_hiding else 0)
    _show_cloud(run, cloud, look, [] if is_virtual else classes, ground_class, cells, hides)


def _show_cloud(
    run: ToolRun,
    cloud: str,
    look: layers.LayerLook,
    classes: Iterable[int],
    ground_class: int,
    cells: tuple[float, bool] = (_USUAL_CELL, False),
    hides: int = layers.CLOUD,
) -> None:
    """Show a point cloud, or where QGIS cannot, a raster of its classes, with cells of a size in
    metres, or in units of the CRS.
    """
    run.looks[cloud] = look
    if compat.can_load(cloud):
        if cloud.endswith(".vpc"):
            compat.load_point_cloud(cloud, run.context)
        return
    run.progress.info(cannot_show(cloud))
    # It is made only if QGIS will load other layers, or a dialog shows the run: else nobody sees
    # it.
    if not (run.context.layersToLoadOnCompletion() or run.progress.is_of_dialog):
        return
    # Imported here, since it needs packages that QGIS may lack when it starts.
    from ...algorithms.tools.rasters.class_raster import write_class_raster

    path, (size, in_units) = class_raster_of(Path(cloud)), cells
    if path.exists() and not is_class_raster(path):  # it belongs to the user
        path = Path(QgsProcessingUtils.generateTempFilename("classes.tif"))
    try:
        how = run.progress.beyond(), run.resolved.stated, in_units
        found = write_class_raster(Path(cloud), path, size, ground_class, *how)
    except Cancelled:
        # All outputs of the run are complete.
        return
    except BareEarthError as error:
        run.progress.warning(str(error))
        return
    compat.load_raster(str(path), run.context)
    run.looks[str(path)] = layers.class_raster(list(classes) or found, hides)
