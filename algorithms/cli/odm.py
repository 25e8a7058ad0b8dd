"""The command that OpenDroneMap can call in place of PDAL's SMRF."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Sequence

from .options import DONE, KEPT, Command, add_crs, add_json, add_parameters, chosen
from .terminal import Terminal, tell


def _add_odm(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..engine.memory import Resources
    from ..filters.smrf import SmrfValues

    parser.add_argument("input", metavar="INPUT", type=Path, help="a .las or .laz file")
    parser.add_argument(
        "output", metavar="OUTPUT", type=Path,
        help="the file to write (.las or .laz); it may be the input, which is then replaced at the"
        " end",
    )  # fmt: skip
    add_crs(parser, KEPT)
    add_json(parser, "the counts ")
    add_parameters(parser, SmrfValues, Resources)


def _odm(options: argparse.Namespace) -> int:
    from ..core.files import replacing
    from ..engine.memory import Resources
    from ..filters.smrf import SmrfValues
    from ..survey.kept_classes import ALL_CLASSES
    from ..survey.outputs import check_outputs
    from ..survey.selection import Selection
    from ..tools import map_tool
    from ..tools.running import run

    given = chosen(options)
    # As SMRF: 1 and 2 replace whatever class a point has; only noise stays.
    selection = Selection(from_classes=ALL_CLASSES, others="unclassified")
    sets = [SmrfValues.among(given).as_tin(), selection, Resources.among(given)]
    inputs = {"input": options.input, "crs": options.crs}
    check_outputs([("cloud", options.output)])
    with Terminal(options.verbose) as progress, replacing(options.output) as temporary:
        done = run(map_tool("classify"), inputs, {"output": temporary}, sets, progress)
    ground = f"{done.ground_count:,} of {done.point_count:,} points are ground"
    tell(options, done, f"{options.output}: {ground}")
    return DONE


COMMANDS = (
    Command(
        "odm",
        "classify the ground as OpenDroneMap asks PDAL's SMRF to do",
        "Classifies the ground points of one file by TIN densification, with the inputs and outputs"
        " of the step of OpenDroneMap that calls PDAL's SMRF: ground points get class 2, all others"
        " 1, but noise (7 and 18) stays.",
        _add_odm,
        _odm,
    ),
)
