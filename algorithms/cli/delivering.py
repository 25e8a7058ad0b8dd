"""The command that makes a delivery: everything that a job hands over."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Sequence

from .classifying import add_method
from .command import DONE, FAILED, Command
from .options import KEPT, add_crs, add_inputs, add_json, add_parameters, chosen
from .surveys import (
    add_area,
    add_checkpoints,
    add_constraints,
    add_raster_target,
    add_scheduler,
    area_of,
    checkpoints_of,
    constraints_of,
    raster_target_of,
    workers_of,
)
from .terminal import Terminal


def _add(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..delivery.deliveries import DELIVERIES
    from ..delivery.request import DeliveryOptions, DeliveryTerrain, DeliveryWater
    from ..engine.memory import Resources
    from ..runs.options import TileInput, TileOutput
    from ..survey.selection import Selection
    from ..tools.check.accuracy import Accuracy
    from ..tools.check.reading import FORMATS
    from ..tools.contours import Contours
    from ..tools.rasters.parameters import SurfaceModel

    kinds = " ".join(f"{name}: {each.about}" for name, each in DELIVERIES.items())
    parser.add_argument("delivery", choices=list(DELIVERIES), help=f"what to deliver. {kinds}")
    add_inputs(parser, "raw ")
    add_crs(parser, KEPT)
    parser.add_argument(
        "output", metavar="FOLDER", type=Path,
        help="the folder for all outputs: a new or empty one, or that of an earlier delivery, which"
        " is replaced",
    )  # fmt: skip
    add_checkpoints(
        parser, f"points that were surveyed on the ground ({FORMATS}); see 'bare-earth check'"
    )
    parser.add_argument(
        "--corrections", metavar="FILE", type=Path,
        help="polygons in which you know the class; see 'bare-earth classify'",
    )  # fmt: skip
    add_area(parser, "deliver only", "; points nearby help to judge")
    add_constraints(parser, "for the terrain model, ")
    add_raster_target(parser)
    add_scheduler(parser)
    method = add_method(parser, arguments)
    add_json(parser, "the figures ")
    add_parameters(
        parser, method.parameters, DeliveryOptions, Selection, DeliveryTerrain, SurfaceModel,
        Contours, DeliveryWater, Accuracy, TileInput, TileOutput, Resources,
        titles=(
            f"{method.label} parameters", "Delivery", "Which points, which classes",
            "Terrain model", "Surface model and gaps", "Contour lines", "Water",
            "Checkpoints", "Files", "Output of many files", "Threads and memory",
        ),
    )  # fmt: skip


def _deliver(options: argparse.Namespace) -> int:
    from ..delivery.delivering import deliver
    from ..delivery.request import DeliveryRequest
    from ..survey.corrections import NO_CORRECTIONS
    from ..survey.vector_files import read_corrections

    corrections = options.corrections and read_corrections(options.corrections)
    request = DeliveryRequest.of(
        chosen(options), delivery=options.delivery, checkpoints=checkpoints_of(options),
        corrections=corrections or NO_CORRECTIONS, area=area_of(options), crs=options.crs,
        constraints=constraints_of(options, finds_water=True),
        raster_target=raster_target_of(options),
    )  # fmt: skip
    workers = workers_of(options, request.resources)
    with Terminal(options.verbose) as progress:
        done = deliver(options.input, options.output, request, progress, workers)
    if options.json:
        print(json.dumps(done.as_dict()))
    else:
        print("\n".join([f"{options.output}: {done.text}", *done.lines()]))
    return FAILED if done.failures else DONE


COMMANDS = (
    Command(
        "deliver",
        "make everything that a job hands over, in one run",
        "Classifies raw points and makes all outputs that a job hands over, in one folder: points,"
        " rasters, lines, figures of quality and accuracy, and a page that lists them (index.html)."
        " Each delivery has settings of its own. The options replace them.",
        _add,
        _deliver,
    ),
)
