"""The command that compares a classified file with a reference: `assess`."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Sequence

from .command import DONE, Command
from .commands import tool_command
from .options import add_crs, add_json, add_parameters, chosen
from .terminal import Terminal


def _add_assess(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..tools.assess import AssessmentOptions

    parser.add_argument("classified", metavar="CLASSIFIED", type=Path, help="the file to check")
    parser.add_argument(
        "reference",
        metavar="REFERENCE",
        type=Path,
        help="a file with the same points and their true classes; one can be a part of the other",
    )
    add_crs(parser)
    add_json(parser, "")
    parser.add_argument("--report", metavar="FILE", type=Path, help="write a report (.html)")
    parser.add_argument(
        "--error-map", metavar="FILE", type=Path,
        help="write the share of wrong points in each cell, 0 to 1 (.tif)",
    )  # fmt: skip
    add_parameters(parser, AssessmentOptions)


def _assess(options: argparse.Namespace) -> int:
    from ..tools.assess import AssessmentOptions, assess_files

    what = AssessmentOptions.among(chosen(options))
    with Terminal(options.verbose) as progress:
        assessment = assess_files(
            options.classified, options.reference, what, options.report, options.error_map,
            progress, options.crs,
        )  # fmt: skip
    print(json.dumps(assessment.as_dict()) if options.json else "\n".join(assessment.lines()))
    return DONE


COMMANDS = (
    tool_command("info"),
    Command(
        "assess",
        "compare a classified file with a reference",
        "Compares the ground (class 2) of a classified file with a reference that holds"
        " the same points, or a part of them: type I error (ground rejected), type II error"
        " (other accepted), total error and kappa, in percent.",
        _add_assess,
        _assess,
    ),
)
