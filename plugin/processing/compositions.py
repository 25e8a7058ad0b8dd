"""From a point cloud to all maps of its terrain in one step: a delivery, or single outputs."""

from __future__ import annotations

from pathlib import Path
from typing import Iterator

from ...algorithms.classes.kept_classes import GROUND
from ...algorithms.classes.selection import Selection
from ...algorithms.core.files import split_name
from ...algorithms.core.parameters import Declaration
from ...algorithms.delivery.deliveries import DELIVERIES, names_of_values
from ...algorithms.delivery.folder import DeliveryFolder
from ...algorithms.delivery.parameters import NO_DELIVERY, DeliveryChoice, DeliveryTerrain
from ...algorithms.delivery.summary import DeliverySummary
from ...algorithms.delivery.tool import OF_DELIVERIES, TOOL
from ...algorithms.engine.memory import Resources
from ...algorithms.engine.options import TileOutput
from ...algorithms.tools import map_tool
from ...algorithms.tools.contours import Contours
from ...algorithms.tools.ground.method import TileMethod
from ...algorithms.tools.ground.output import PointOutput as Written
from ...algorithms.tools.rasters.parameters import MapTerrain, SurfaceModel, TerrainModel
from .. import compat
from ..i18n import mark
from ..styles import layers
from .algorithm import ToolAlgorithm
from .commands import command_line
from .feedback import Refusal
from .outputs import do_not_load, given_path, point_cloud_formats
from .request import Request, Resolved
from .showing import Results, ToolRun, show_classified

DELIVERY = TOOL.chosen.upper()
FOLDER = "DELIVERY_FOLDER"
# Cell size of rasters that are not a delivery, in metres.
_USUAL_CELL = 1.0


class CompositionAlgorithm(ToolAlgorithm):
    """Tools that work one after another: a delivery, or single outputs."""

    def no_choice(self, declaration: Declaration) -> str:
        """Return the label of no value, of parameters that deliveries set."""
        is_open = declaration.name in names_of_values() and declaration.default is not None
        is_open &= declaration.kind in ("boolean", "choice")
        return mark("From the delivery") if is_open else ""

    def run_name(self, resolved: Resolved) -> str:
        """Return the name of the group of layers, after that of the input."""
        name = _delivery(resolved)
        return DELIVERIES[name].label if name else mark("terrain")

    def check(self, request: Request) -> Resolved:
        """Check the values, and refuse a delivery without a folder, or into an unsuitable one."""
        found = super().check(request)
        if _delivery(found):
            if request.is_empty(FOLDER):
                raise Refusal(mark("Choose a folder for the delivery."))
            path = given_path(request, FOLDER)
            if path is not None:
                DeliveryFolder(path).check(found.points)
        return found

    def makes_page(self, request: Request, resolved: Resolved) -> bool:
        """Return whether a delivery is chosen, which has a page."""
        return bool(_delivery(resolved))

    def work(self, run: ToolRun) -> Results:
        """Make a delivery, or the wanted outputs."""
        name = _delivery(run.resolved)
        if ignored := [*_ignored(run)]:
            why = "a delivery names its outputs itself, in its folder"
            if not name:
                why = "only deliveries use them, and none is chosen"
            run.progress.warning(f"Not used: {', '.join(ignored)}; {why}.")
        return _deliver(run, name) if name else _make_own(run)


def _delivery(resolved: Resolved) -> str:
    """Return the name of the delivery; empty for the user's own choice of outputs."""
    name = DeliveryChoice.among(resolved.sets).delivery
    return "" if name in (None, NO_DELIVERY) else name


def _ignored(run: ToolRun) -> Iterator[str]:
    """Yield the fields that this run does not use, with or without a delivery."""
    if _delivery(run.resolved):
        for field in run.request.algorithm.destinationParameterDefinitions():
            if field.name() != FOLDER and given_path(run.request, field.name()) is not None:
                yield field.name()
        return
    for values in run.resolved.sets:
        for declared in values.declarations() if isinstance(values, OF_DELIVERIES) else ():
            if getattr(values, declared.name) != declared.default:
                yield declared.name.upper()
    yield from (name for name in ("CHECKPOINTS", FOLDER) if not run.request.is_empty(name))


def _deliver(run: ToolRun, name: str) -> Results:
    """Make a delivery, and let QGIS load its layers."""
    resolved, progress = run.resolved, run.progress
    sets = [values for values in resolved.sets if not isinstance(values, DeliveryChoice)]
    sets.append(TileOutput(format=point_cloud_formats()[0]))
    folder = run.request.read("String", FOLDER)
    words = [name, *resolved.arguments, folder]
    named = {one for one in names_of_values() if not run.request.is_empty(one.upper())}
    progress.commands.append(command_line("deliver", words, sets, resolved.options, named))
    inputs = resolved.values
    work = run.tool.work
    done = work(resolved.points, folder, name, sets, inputs, progress, None, named)
    progress.share(done.ground_count, done.point_count, bool(inputs["area"]))
    progress.info("\n".join(f"{title}: {value}" for title, value in done.accuracy()))
    _show_layers(run, done, DELIVERIES[name].pictures[0])
    if not done.cloud.endswith(".vpc") and compat.can_load(done.cloud):
        compat.load_point_cloud(done.cloud, run.context)
    _show_cloud(run, done.cloud, done.class_counts, done.cell_size)
    # The files have the names of the outputs that are chosen without a delivery.
    made = {"OUTPUT": done.cloud, **{name.upper(): file for name, file in done.layers.items()}}
    fields = {output.field_name for output in run.outputs}
    results = {name: file for name, file in made.items() if name in fields}
    results.update({"VERDICT": done.verdict} if done.verdict else {})
    return {
        **results, FOLDER: folder, "PAGE": done.page,
        "POINT_COUNT": done.point_count, "GROUND_COUNT": done.ground_count,
    }  # fmt: skip


def _show_cloud(run: ToolRun, cloud: str, counts: dict[int, int], cell_size: float) -> None:
    """Show the classes of the points, below which the terrain must be visible."""
    run.class_counts, sets = counts, run.resolved.sets
    cells = cell_size, MapTerrain.among(sets).dtm_cell_unit == "crs"
    ground = Selection.among(sets).to_class
    show_classified(run, cloud, counts, ground, cells, layers.BELOW_TERRAIN)


def _show_layers(run: ToolRun, done: DeliverySummary, first: str) -> None:
    """Let QGIS load rasters, lines and polygons; only `first` is visible."""
    looks = {
        "water": layers.WATER, "breaklines": layers.BREAKLINES, "places": layers.PLACES,
        "low_confidence": layers.LOW_CONFIDENCE,
    }  # fmt: skip
    if done.interval is not None:
        looks["contours"] = layers.contours(done.interval)
    if done.check is not None:
        looks["checkpoints"] = layers.residuals(done.check.scale)
    for name, path in done.layers.items():
        (compat.load_vector if name in looks else compat.load_raster)(path, run.context)
        look = looks.get(name) or layers.raster_looks()[name.upper()]
        run.looks[path] = layers.first(look) if name == first else look


def _make_own(run: ToolRun) -> Results:
    """Make the outputs that the user chose, and set the looks of their layers."""
    # Imported here, so that QGIS starts faster.
    from ...algorithms.tools.running import run as run_tool

    resolved, progress = run.resolved, run.progress
    given = {**resolved.values, "input": resolved.points}
    sets = [
        values.with_cells(_USUAL_CELL) if isinstance(values, DeliveryTerrain) else values
        for values in resolved.sets
        if not isinstance(values, (DeliveryChoice, *OF_DELIVERIES))
    ]
    paths = {one.name: run.path(one) for one in run.outputs if one.kind != "folder"}
    cloud = paths.pop("cloud")
    target, tiles = cloud, TileOutput()
    if cloud and resolved.points.is_survey:  # a folder of this name without its ending
        name, ending = split_name(Path(cloud))
        target, tiles = str(Path(cloud).with_name(name)), TileOutput(ending[1:].lower() or "same")
    sets += [Written(area_only=given["area"] is not None), tiles]
    run.resolved = resolved = resolved._replace(sets=sets)
    drawn = {name.upper(): path for name, path in paths.items() if path}
    done = run_tool(map_tool("classify"), given, {**paths, "output": target}, sets, progress)
    written = cloud and str(done.vpc or cloud)
    progress.commands += _commands(resolved, written, drawn)
    point_count = sum(done.class_counts.values())
    progress.share(done.ground_count, point_count, bool(given["area"]))
    if interval := done.drawn.get("contours"):
        run.looks[paths["contours"]] = layers.contours(interval)
    if paths.get("places"):
        run.looks[paths["places"]] = layers.PLACES
    results: Results = {**drawn}
    if cloud:
        results["OUTPUT"] = written
        do_not_load(run.context, {cloud} - {written})
        _show_cloud(run, written, done.class_counts, MapTerrain.among(sets).dtm_cell_size)
    return {**results, "POINT_COUNT": point_count, "GROUND_COUNT": done.ground_count}


def _commands(resolved: Resolved, cloud: str, layers: dict[str, str]) -> Iterator[str]:
    """Yield the commands for a classified cloud, empty if none is kept, and for its rasters and
    contour lines, by the names of their fields.
    """
    of_type = {type(values): values for values in resolved.sets}
    cloud = cloud or "classified.laz"
    # For many files, the folder of their virtual point cloud.
    target = str(Path(cloud).parent) if cloud.endswith(".vpc") else cloud
    options = resolved.options
    finding = [of_type[kind] for kind in (TileMethod, Selection, Resources)]
    has_area = bool(resolved.given["area"].value)
    words = [*resolved.arguments, target, *["--area-only"] * has_area]
    of_points = {name: options.get(name) for name in ("crs", "extent", "boundary")}
    corrections = {"corrections": options.pop("corrections", None)}
    yield command_line("classify", words, finding, {**of_points, **corrections})
    if layers:
        ground = Selection.among(resolved.sets).to_class
        classes = {"ground-classes": "" if ground == GROUND else str(ground)}
        # The command has other defaults.
        model = TerrainModel(**vars(of_type[MapTerrain]))
        drawing = [model, *(of_type[kind] for kind in (SurfaceModel, Contours, Resources))]
        yield command_line("terrain", [cloud], drawing, {**classes, **options, **layers})
