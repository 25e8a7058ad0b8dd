"""The fields of a delivery, its run, and its layers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Mapping, Sequence

from qgis.core import (
    QgsProcessingContext,
    QgsProcessingOutputHtml,
    QgsProcessingParameterFolderDestination,
)

from ...algorithms.core.parameters import ParameterSet
from ...algorithms.delivery.deliveries import DELIVERIES
from ...algorithms.delivery.folder import DeliveryFolder
from ...algorithms.delivery.parameters import (
    NO_DELIVERY,
    DeliveryChoice,
    DeliveryOptions,
    DeliveryTerrain,
    DeliveryWater,
)
from ...algorithms.engine.options import TileOutput
from ...algorithms.survey.selection import Selection
from ...algorithms.tools.check.accuracy import Accuracy
from .. import compat
from ..i18n import mark
from ..styles import layers
from .area import area_options, given_options
from .base import BareEarthAlgorithm, command_line
from .checkpoints import add_checkpoints, checkpoints_of
from .classified import show_classified
from .feedback import FeedbackProgress, Refusal
from .outputs import given_path, point_cloud_formats

if TYPE_CHECKING:
    from ...algorithms.delivery.summary import DeliverySummary

DELIVERY, FOLDER, PAGE = "DELIVERY", "DELIVERY_FOLDER", "PAGE"
# The parameters of deliveries alone.
SETS = DeliveryOptions, DeliveryWater, Accuracy
# Cell size of rasters that are not a delivery, in metres.
_USUAL_CELL = 1.0


def add_delivery(algorithm: BareEarthAlgorithm) -> None:
    """Add the fields of the checkpoints and the folder of a delivery, and its page."""
    add_checkpoints(algorithm, advanced=True)
    algorithm.addParameter(
        QgsProcessingParameterFolderDestination(
            FOLDER, "Folder of the delivery", None, True, False
        ),
        "The folder for all outputs of a delivery: an empty or new one, or that of an earlier"
        " delivery, which is replaced.",
    )
    algorithm.addOutput(QgsProcessingOutputHtml(PAGE, "Page of the delivery"))


def delivery_of(chosen: Sequence[ParameterSet]) -> str:
    """Return the name of the delivery; empty for the user's own choice of outputs."""
    name = DeliveryChoice.among(chosen).delivery
    return "" if name in (None, NO_DELIVERY) else name


def run_name_of(chosen: Sequence[ParameterSet]) -> str:
    """Return what the group of layers is called, in English: the delivery, or the terrain."""
    name = delivery_of(chosen)
    return DELIVERIES[name].label if name else mark("terrain")


def without_delivery(chosen: Sequence[ParameterSet]) -> list[ParameterSet]:
    """Return the parameters of single outputs."""
    return [
        values.with_cells(_USUAL_CELL) if isinstance(values, DeliveryTerrain) else values
        for values in chosen
        if not isinstance(values, (DeliveryChoice, *SETS))
    ]


def check_folder(
    algorithm: BareEarthAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
) -> None:
    """Refuse a delivery without a folder, or into one that is unsuitable."""
    if not delivery_of(algorithm.chosen(parameters, context)):
        return
    if compat.is_empty(parameters.get(FOLDER)):
        raise Refusal(mark("Choose a folder for the delivery."))
    path = given_path(parameters.get(FOLDER), context)
    if path is not None:
        DeliveryFolder(path).check(algorithm.inputs)


def tell_of_ignored(
    algorithm: BareEarthAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    progress: FeedbackProgress,
) -> None:
    """Warn of values that a delivery, or a run without one, does not use."""
    chosen = algorithm.chosen(parameters, context)
    if delivery_of(chosen):
        outputs = (field.name() for field in algorithm.destinationParameterDefinitions())
        names = [
            name
            for name in outputs
            if name != FOLDER and given_path(parameters.get(name), context) is not None
        ]
        why = "a delivery names its outputs itself, in its folder"
    else:
        names = [
            declared.name.upper()
            for values in chosen
            if isinstance(values, SETS)
            for declared in values.declarations()
            if getattr(values, declared.name) != declared.default
        ]
        fields = "CHECKPOINTS", FOLDER
        names += [name for name in fields if not compat.is_empty(parameters.get(name))]
        why = "only deliveries use them, and none is chosen"
    if names:
        progress.warning(f"Not used: {', '.join(names)}; {why}.")


def make_delivery(
    algorithm: BareEarthAlgorithm,
    parameters: dict[str, Any],
    context: QgsProcessingContext,
    limits: Mapping[str, Any],
    progress: FeedbackProgress,
) -> dict[str, Any]:
    """Make a delivery, and let QGIS load its layers; return the outputs of the algorithm."""
    from ...algorithms.delivery.running import deliver

    chosen = algorithm.chosen(parameters, context)
    name = delivery_of(chosen)
    sets = [values for values in chosen if not isinstance(values, DeliveryChoice)]
    sets.append(TileOutput(format=point_cloud_formats()[0], overview=True))
    folder = algorithm.parameterAsString(parameters, FOLDER, context)
    words = [name, *map(str, algorithm.inputs), folder]
    crs = algorithm.crs_of(*algorithm.inputs)
    points, flags = checkpoints_of(algorithm, parameters, context, crs, progress)
    command = command_line("deliver", words, sets, {**given_options(**limits), **flags})
    area = area_options(limits["area"], progress)
    progress.command(" ".join([command, *area]))
    inputs = {**limits, "checkpoints": points}
    done = deliver(algorithm.inputs, folder, name, sets, inputs, progress)
    progress.share(done.ground_count, done.point_count, bool(limits["area"]))
    progress.info("\n".join(f"{title}: {value}" for title, value in done.accuracy()))
    _show(algorithm, done, DELIVERIES[name].pictures[0], context)
    if not done.cloud.endswith(".vpc") and compat.can_load(done.cloud):
        compat.load_point_cloud(done.cloud, context)
    ground, terrain = Selection.among(chosen).to_class, DeliveryTerrain.among(chosen)
    cells = done.cell_size, terrain.dtm_cell_unit == "crs"
    below = layers.BELOW_TERRAIN
    show_classified(
        algorithm, done.cloud, done.class_counts, ground, cells, context, progress, below
    )
    algorithm.class_counts = done.class_counts
    return {
        FOLDER: folder, PAGE: done.page,
        "POINT_COUNT": done.point_count, "GROUND_COUNT": done.ground_count,
    }  # fmt: skip


def _show(
    algorithm: BareEarthAlgorithm,
    done: DeliverySummary,
    first: str,
    context: QgsProcessingContext,
) -> None:
    """Let QGIS load rasters, lines and polygons; `first` is visible at first."""
    looks = {"water": layers.WATER, "breaklines": layers.BREAKLINES}
    if done.interval is not None:
        looks["contours"] = layers.contours(done.interval)
    if done.check is not None:
        looks["checkpoints"] = layers.residuals(done.check.scale)
    for name, path in done.layers.items():
        if name in looks:
            compat.load_vector(path, context)
        else:
            compat.load_raster(path, context)
        look = looks.get(name) or layers.raster_looks()[name.upper()]
        algorithm.show(path, layers.first(look) if name == first else look)
