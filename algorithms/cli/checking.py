"""The commands that check points: against checkpoints, and against a specification."""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Sequence

from .command import DONE, Command
from .options import UsageError, add_crs, add_inputs, add_json, add_parameters, chosen
from .surveys import add_checkpoints, checkpoints_of
from .terminal import Terminal


def _add_check(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    from ..survey.feature_files import FORMATS as LAYERS
    from ..survey.ground_classes import GroundClasses
    from ..tools.check.accuracy import Accuracy
    from ..tools.check.checking import CheckOptions
    from ..tools.check.reading import FORMATS

    add_inputs(parser, "a classified file, or ")
    add_crs(parser)
    add_checkpoints(parser, f"points that were surveyed on the ground ({FORMATS})")
    parser.add_argument(
        "--vegetated", metavar="WORD", nargs="+", default=(),
        help="land covers with one of these words are vegetated, and no others (default: words such"
        " as forest, crops and brush in several languages)",
    )  # fmt: skip
    parser.add_argument(
        "--dtm", metavar="RASTER", help="check this terrain model as well, in the CRS of the points"
    )
    parser.add_argument(
        "--confidence", metavar="RASTER",
        help="the confidence of the terrain model, 0 to 1, as 'terrain --confidence' makes it;"
        " checkpoints where it is low are not counted",
    )  # fmt: skip
    parser.add_argument("--report", metavar="FILE", type=Path, help="write a page (.html)")
    parser.add_argument(
        "--table", metavar="FILE", type=Path, help="write the checkpoints and their errors (.csv)"
    )
    parser.add_argument(
        "--residuals", metavar="FILE", type=Path,
        help=f"write the checkpoints and their errors as points ({', '.join(LAYERS)}); all but"
        " .geojson need pyogrio",
    )  # fmt: skip
    add_json(parser, "the figures ")
    add_parameters(
        parser, Accuracy, CheckOptions, GroundClasses,
        titles=("Accuracy", "What is compared", "Ground points"),
    )  # fmt: skip


def _check(options: argparse.Namespace) -> int:
    from ..tools.check.checking import CheckOptions, CheckOutputs, CheckRequest, check_files

    sets = chosen(options)
    if options.checkpoints is None and CheckOptions.among(sets).hold_out is None:
        raise UsageError("Give --checkpoints, or a share of the ground points with --hold-out.")
    request = CheckRequest.of(
        sets, checkpoints=checkpoints_of(options), dtm=options.dtm, confidence=options.confidence,
        vegetated=tuple(options.vegetated), crs=options.crs,
        outputs=CheckOutputs(options.report, options.table, options.residuals),
    )  # fmt: skip
    with Terminal(options.verbose) as progress:
        check = check_files(options.input, request, progress)
    print(json.dumps(check.as_dict()) if options.json else "\n".join(check.lines()))
    return DONE


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
        "check",
        "compare the ground with checkpoints, or with points that are held out",
        "Compares the TIN of the ground points, and a terrain model, with checkpoints: RMSE and"
        " other figures, on land with and without vegetation, and the statement of the ASPRS"
        " Positional Accuracy Standards, edition 2. With --hold-out, it needs no checkpoints.",
        _add_check,
        _check,
    ),
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
