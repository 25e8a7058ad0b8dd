"""Compares the ground of a survey, and a terrain model, with checkpoints.

The method is that of ASPRS (2023): Positional Accuracy Standards for Digital Geospatial Data,
edition 2, version 1.0.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Iterable, NamedTuple

import numpy as np

from ...core.errors import BareEarthError
from ...core.files import Outputs, check_distinct, check_output
from ...core.parameters import HasSets, ParameterSet, parameter
from ...core.progress import SILENT, Progress
from ...products.survey_ground import SurveyGround
from ...report.page import check_page
from ...report.units import round_length
from ...survey.feature_files import check_features, files_beside
from ...survey.ground_classes import GroundClasses
from .accuracy import Accuracy, Figures, statement
from .checkpoints import Checkpoints
from .hold_out import HoldOut, hold_out
from .land_covers import VVA
from .page import checkpoint_html
from .residuals import Residuals, residuals_of, write_layer, write_table
from .results import COUNTED, NOT_STATED, REASONS, Check

# How many of the largest errors are named.
_LARGEST = 5


@dataclass(frozen=True)
class CheckOptions(ParameterSet):
    """Where heights are compared."""

    max_edge: float = parameter(
        20.0,
        label="Longest edge of a triangle",
        unit="m",
        minimum=0.1,
        maximum=1000.0,
        advanced=True,
        help="Checkpoints in triangles with a longer edge lie in a void of the ground, such as a"
        " building, and are not counted.",
    )
    min_confidence: float = parameter(
        0.5,
        label="Least confidence",
        minimum=0.0,
        maximum=1.0,
        advanced=True,
        help="Checkpoints where the raster of confidence has less are not counted.",
    )
    hold_out: float | None = parameter(
        None,
        kind="number",
        label="Share of ground points to hold out",
        minimum=0.0001,
        maximum=0.5,
        advanced=True,
        help="Leaves out so large a share of the ground points, such as 0.02, and measures how well"
        " the others predict them, on open land, under trees and on steep land. This needs no"
        " checkpoints, but it does not tell how right the heights are.",
    )


class CheckOutputs(NamedTuple):
    """The files to write, each of which can be None."""

    report: Path | None = None  # A web page (.html)
    table: Path | None = None  # A table of all checkpoints (.csv)
    # The checkpoints with their errors as points (.gpkg, .geojson, .shp or .fgb)
    residuals: Path | None = None

    def check(self, sources: tuple[Path, ...], checkpoints: Checkpoints | None) -> None:
        """Refuse, before any work is done, files that could not be written at the end."""
        check_distinct(self)
        if checkpoints is None and (self.table or self.residuals):
            raise BareEarthError(
                "Points that are held out have no table and no layer, only a page. Give"
                " checkpoints."
            )
        if self.report:
            check_page(self.report, sources)
        if self.table:
            check_output(self.table, sources)
            if self.table.suffix.lower() != ".csv":
                raise BareEarthError(f"Cannot write {self.table}: the table is CSV, name it .csv.")
        if self.residuals:
            check_features(self.residuals, sources)

    def write(
        self, check: Check, found: Residuals | None, ground: SurveyGround, progress: Progress
    ) -> None:
        """Write the files: all of them or none."""
        with Outputs() as outputs:
            if self.residuals and found is not None:
                layer = outputs.files(self.residuals, files_beside(self.residuals))
                write_layer(layer, found, ground.survey, progress)
            if self.table and found is not None:
                write_table(outputs.file(self.table), found)
            if self.report:
                page = outputs.file(self.report)
                page.write_text(checkpoint_html(check, found, ground.survey), encoding="utf-8")
            progress(1.0)  # the last moment to cancel


@dataclass(frozen=True)
class CheckRequest(HasSets):
    """A request to compare points with checkpoints, or with points that are held out."""

    # The checkpoints; they can be left out if points are held out
    checkpoints: Checkpoints | None = None
    options: CheckOptions = field(default_factory=CheckOptions)  # where heights are compared
    # The class to meet, and the error of the checkpoints
    accuracy: Accuracy = field(default_factory=Accuracy)
    ground: GroundClasses = field(default_factory=GroundClasses)  # which points are ground
    dtm: str | None = None  # A terrain model that is compared as well
    confidence: str | None = None  # A raster of its confidence, 0 to 1
    # Land covers with one of these words are vegetated, and no others. Empty: those with words that
    # are known in several languages.
    vegetated: tuple[str, ...] = ()
    outputs: CheckOutputs = field(default_factory=CheckOutputs)  # the files to write
    # The CRS of the points in place of the one that files state: an EPSG code, such as
    # "EPSG:25832", or "EPSG:2230+6360" with that of the heights, or well-known text
    crs: str | None = None


def check_files(
    sources: Iterable[Path],
    request: CheckRequest = CheckRequest(),
    progress: Progress = SILENT,
) -> Check:
    """Compare the ground points of one file or many, and a terrain model, with checkpoints."""
    paths = [Path(source) for source in sources]
    given, share = request.checkpoints, request.options.hold_out
    if given is None and share is None:
        raise BareEarthError("Give checkpoints, or a share of the ground points to hold out.")
    request.outputs.check(tuple(paths), given)
    ground = SurveyGround.of(paths, request.ground, progress.part(0.0, 0.05), request.crs)
    middle, found, left = 0.95 if share is None else 0.5, None, None
    if given is not None:
        found = residuals_of(
            ground, given, (request.dtm, request.confidence), request.vegetated,
            request.options.max_edge, request.options.min_confidence, progress.part(0.05, middle),
        )  # fmt: skip
    if share is not None:
        part = progress.part(0.05 if given is None else middle, 0.95)
        left = hold_out(ground, share, request.options.max_edge, part)
    check = _check_of(found, request.accuracy, left)
    if check.doubt:
        progress.warning(f"{check.doubt} {NOT_STATED}")
    request.outputs.write(check, found, ground, progress)
    return check


def _check_of(found: Residuals | None, accuracy: Accuracy, left: HoldOut | None) -> Check:
    """Return the figures of residuals."""
    goal = accuracy.accuracy_class
    if found is None:
        return Check(accuracy_class=goal, hold_out=left)
    counted, count = found.counted, len(found.names)
    others: dict[str, list[str]] = {}
    for name, state in zip(found.names, found.states):
        if state != COUNTED:
            others.setdefault(state, []).append(name)
    if not counted.any():
        why = "; ".join(f"{len(names):,} {REASONS[state]}" for state, names in others.items())
        raise BareEarthError(
            f"None of the {count:,} checkpoints can be compared: {why}. Check their CRS, and"
            " which classes are ground."
        )
    is_vegetated = np.array(found.kinds) == VVA
    nva, vva, dtm_nva, dtm_vva = (
        Figures.of(errors[counted & land & ~np.isnan(errors)], accuracy.survey_error)
        for errors in (found.errors, found.dtm_errors)
        for land in (~is_vegetated, is_vegetated)
    )
    doubt, dtm_doubt = map(found.doubt, (found.errors, found.dtm_errors))
    order = np.argsort(np.where(counted, -np.abs(found.errors), np.inf), kind="stable")
    of_dtm = NOT_STATED if dtm_doubt else statement(dtm_nva, dtm_vva, goal)
    # Most errors lie well within the colours.
    most = float(np.percentile(np.abs(found.errors[counted]), 95.0))
    return Check(
        checkpoint_count=count,
        counted=int(np.count_nonzero(counted)),
        nva=nva, vva=vva, dtm_nva=dtm_nva, dtm_vva=dtm_vva,
        not_counted=others,
        unknown_covers=found.unknown_covers,
        doubt=doubt or (f"Terrain model: {dtm_doubt}" if dtm_doubt else ""),
        largest=[
            {"name": found.names[number], "error": round(float(found.errors[number]), 6)}
            for number in order[:_LARGEST].tolist()
            if counted[number]
        ],
        shift=None if nva is None or doubt else nva.mean,
        accuracy_class=goal,
        meets_class=None if goal is None or nva is None or doubt else nva.total_rmse <= goal,
        scale=round_length(2.0 * max(most, 0.001)),
        statement=NOT_STATED if doubt else statement(nva, vva, goal),
        dtm_statement=of_dtm if dtm_nva is not None or dtm_vva is not None else "",
        hold_out=left,
    )  # fmt: skip
