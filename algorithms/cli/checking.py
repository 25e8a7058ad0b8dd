"""The command that compares a survey with a specification."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Sequence

from .command import DONE, Command
from .options import add_crs, add_inputs, add_json, add_parameters, chosen
from .terminal import Terminal


def _add_quality(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..survey.ground_classes import GroundClasses
    from ..tools.quality import QualityOptions

    add_inputs(parser, "a classified file, or ")
    add_crs(parser)
    parser.add_argument("--page", metavar="FILE", type=Path, help="write a page (.html)")
    parser.add_argument(
        "--folder", metavar="FOLDER", type=Path,
        help="write rasters (.tif) into this folder, which is made if need be: densities, voids,"
        " low vegetation, overlap of strips, differences between strips, maximum surface height",
    )  # fmt: skip
    add_json(parser, "the figures ")
    add_parameters(
        parser, QualityOptions, GroundClasses, titles=("What is measured", "Ground points")
    )


def _quality(options: argparse.Namespace) -> int:
    from ..tools.quality import QualityRequest, survey_quality

    request = QualityRequest.of(
        chosen(options), page=options.page, folder=options.folder, crs=options.crs
    )
    with Terminal(options.verbose) as progress:
        found = survey_quality(options.input, request, progress)
    print(json.dumps(found.as_dict()) if options.json else "\n".join(found.text()))
    return DONE


COMMANDS = (
    Command(
        "quality",
        "measure density, voids and overlap of a survey, and compare it with a specification",
        "Measures the quality of a classified survey: densities, voids, overlap of strips and"
        " differences between them, classes and formats. Compares it with what a specification"
        " asks for.",
        _add_quality,
        _quality,
    ),
)
