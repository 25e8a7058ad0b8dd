"""Compares the ground of a survey, and a terrain model, with checkpoints.

The method is that of ASPRS (2023): Positional Accuracy Standards for Digital Geospatial Data,
edition 2, version 1.0.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, Mapping, Sequence

import numpy as np

from ...classes.ground_classes import GroundClasses
from ...core.errors import BareEarthError
from ...core.parameters import ParameterSet, parameter
from ...core.progress import SILENT, Progress
from ...core.words import option
from ...report.units import round_length
from ...survey.area import Polygon
from ...survey.feature_files import feature_writer
from ...survey.files import Inputs
from ...survey.vector_files import shapes_of
from ..declaration import CLASSIFIED, CLOUD, CRS, TERRAIN, TIN, FileTool, Input, Output
from .accuracy import Accuracy, Figures, statement
from .checkpoints import Checkpoints
from .hold_out import HoldOut, hold_out
from .land_covers import VVA
from .page import checkpoint_html
from .residuals import Residuals, layer_of, residuals_of, write_table
from .results import COUNTED, LOW_CONFIDENCE, NOT_STATED, REASONS, Check, Expectation
from .survey_ground import SurveyGround

# Number of the largest errors that the result names.
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
    hold_out: float | None = parameter(
        None,
        kind="number",
        label="Share of ground points to hold out",
        minimum=0.0001,
        maximum=0.5,
        advanced=True,
        help="Leaves out this share of the ground points, such as 0.02, and measures how well the"
        " others predict them, on open land, under trees and on steep land. This needs no"
        " checkpoints, but it does not show whether the heights are right.",
    )


@dataclass(frozen=True)
class CheckInputs:
    """What is compared, how, and what is written of it."""

    accuracy: Accuracy
    options: CheckOptions
    ground: GroundClasses
    sources: Inputs | SurveyGround
    checkpoints: Checkpoints | None = None
    dtm: str | None = None
    vegetated: Sequence[str] | None = None  # words of land covers; None: the known words
    expected_error: str | None = None
    low_confidence: Sequence[Polygon] | None = None
    report: Path | None = None
    table: Path | None = None
    residuals: Path | None = None

    def validate(self) -> None:
        """Refuse to compare nothing, and a table or a layer without checkpoints."""
        if self.checkpoints is None and self.options.hold_out is None:
            raise BareEarthError(_nothing_to_compare())
        if self.checkpoints is None and (self.table or self.residuals):
            raise BareEarthError(
                "Points that are held out have no table and no layer, only a page. Give"
                " checkpoints."
            )


def check_points(inputs: CheckInputs, progress: Progress = SILENT) -> Check:
    """Compare the ground points of classified files, and a terrain model, with checkpoints or with
    held-out points, and write page, table and layer.
    """
    inputs.validate()
    points, share = inputs.sources, inputs.options.hold_out
    if not isinstance(points, SurveyGround):
        points = SurveyGround.of(points, inputs.ground, progress.part(0.0, 0.05))
    middle, errors, held_out = 0.95 if share is None else 0.5, None, None
    if inputs.checkpoints is not None:
        errors = residuals_of(
            points, inputs.checkpoints, (inputs.dtm, inputs.expected_error),
            inputs.low_confidence or (), tuple(inputs.vegetated or ()), inputs.options.max_edge,
            progress.part(0.05, middle),
        )  # fmt: skip
    if share is not None:
        part = progress.part(0.05 if inputs.checkpoints is None else middle, 0.95)
        held_out = hold_out(points, share, inputs.options.max_edge, part)
    check = _check_of(errors, inputs.accuracy, held_out)
    if check.doubt:
        progress.warning(f"{check.doubt} {NOT_STATED}")
    if inputs.residuals and errors is not None:
        layer, features = layer_of(errors, points.survey.crs)
        feature_writer(inputs.residuals)(inputs.residuals, features, layer, progress)
    if inputs.table and errors is not None:
        write_table(inputs.table, errors)
    if inputs.report:
        html = checkpoint_html(check, errors, points.survey)
        inputs.report.write_text(html, encoding="utf-8")
    return check


def _work(
    accuracy: Accuracy = Accuracy(),
    options: CheckOptions = CheckOptions(),
    ground: GroundClasses = GroundClasses(),
    progress: Progress = SILENT,
    **given: Any,
) -> Check:
    return check_points(CheckInputs(accuracy, options, ground, **given), progress)


def _check_of(found: Residuals | None, accuracy: Accuracy, held_out: HoldOut | None) -> Check:
    """Return the figures of the errors at checkpoints and at held-out points."""
    goal = accuracy.accuracy_class
    if found is None:
        return Check(accuracy_class=goal, hold_out=held_out)
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
    is_vegetated, is_low = (
        np.array(values) == value
        for values, value in ((found.kinds, VVA), (found.states, LOW_CONFIDENCE))
    )
    nva, vva, dtm_nva, dtm_vva = (
        Figures.of(errors[counted & land & ~np.isnan(errors)], accuracy.survey_error)
        for errors in (found.errors, found.dtm_errors)
        for land in (~is_vegetated, is_vegetated)
    )
    low, dtm_low = (
        Figures.of(errors[is_low & ~np.isnan(errors)], accuracy.survey_error)
        for errors in (found.errors, found.dtm_errors)
    )
    doubt, dtm_doubt = map(found.doubt, (found.errors, found.dtm_errors))
    order = np.argsort(np.where(counted, -np.abs(found.errors), np.inf), kind="stable")
    dtm = None if np.isnan(found.dtm_errors).all() else found.dtm_errors
    of_dtm = NOT_STATED if dtm_doubt else statement(dtm_nva, dtm_vva, goal)
    # The colours of maps end at twice the error that 95 % do not exceed.
    most = float(np.percentile(np.abs(found.errors[counted]), 95.0))
    return Check(
        checkpoint_count=count,
        counted=int(np.count_nonzero(counted)),
        nva=nva, vva=vva, dtm_nva=dtm_nva, dtm_vva=dtm_vva,
        low_confidence=low, dtm_low_confidence=dtm_low,
        not_counted=others,
        unknown_covers=found.unknown_covers,
        doubt=doubt or (f"Terrain model: {dtm_doubt}" if dtm_doubt else ""),
        largest=[
            {"name": found.names[number], "error": round(float(found.errors[number]), 6)}
            for number in order[:_LARGEST].tolist()
            if counted[number]
        ],
        shift=None if nva is None or doubt else -nva.mean,
        accuracy_class=goal,
        meets_class=None if goal is None or nva is None or doubt else nva.total_rmse <= goal,
        scale=round_length(2.0 * max(most, 0.001)),
        statement=NOT_STATED if doubt else statement(nva, vva, goal),
        dtm_statement=of_dtm if dtm_nva is not None or dtm_vva is not None else "",
        expected=None if doubt or dtm_doubt else Expectation.of(
            np.where(counted, found.errors if dtm is None else dtm, np.nan), found.expected
        ),
        hold_out=held_out,
    )  # fmt: skip


def _lacks(inputs: Mapping[str, object], sets: Sequence[ParameterSet]) -> str:
    if inputs["checkpoints"] is None and CheckOptions.among(sets).hold_out is None:
        return _nothing_to_compare()
    return ""


def _nothing_to_compare() -> str:
    return f"Give {option('checkpoints')}, or a share of points with {option('hold_out')}."


TOOL = FileTool(
    work=_work,
    sets=(Accuracy, CheckOptions, GroundClasses),
    titles=("Accuracy", "What is compared", "Ground points"),
    shown=("accuracy_class",),
    lacks=_lacks,
    inputs=(
        CLASSIFIED,
        Input(
            "checkpoints",
            "checkpoints",
            label="Checkpoints",
            optional=True,
        ),
        Input(
            "dtm",
            "raster",
            help="The heights of this raster, in the CRS of the points, are compared with the"
            " checkpoints as well.",
            label="Terrain model",
            optional=True,
        ),
        CRS,
        Input(
            "vegetated",
            "words",
            help="Only land covers with one of these words are vegetated. Empty: words such as"
            " forest, crops and brush in eight languages.",
            label="Vegetated land covers",
            optional=True,
            advanced=True,
            is_last=True,
        ),
        Input(
            "expected_error",
            "raster",
            help="The expected error of the terrain model, as `terrain()` makes it. Reports how"
            " many errors at checkpoints fall within it, and the factor with which 95 % would.",
            label="Expected error",
            optional=True,
            advanced=True,
            is_last=True,
        ),
        Input(
            "low_confidence",
            "polygons",
            # A delivery gives the file that it has written.
            of=partial(shapes_of, kind="Polygon", may_be_empty=True),
            help="Low confidence areas, as `quality()` finds them. Checkpoints in them have figures"
            " of their own, and are not counted for the accuracy elsewhere.",
            label="Low confidence areas",
            optional=True,
            advanced=True,
            is_last=True,
            may_be_empty=True,
        ),
    ),
    outputs=(
        Output(
            "residuals",
            "features",
            help="The checkpoints with their errors (ERROR, in metres): ground minus checkpoint.",
            label="Errors at checkpoints",
            named="OUTPUT",
            look="residuals",
            needs="checkpoints",
        ),
        Output(
            "report",
            "page",
            help="A web page with the figures, the statement, and a map of the errors.",
            label="Report",
        ),
        Output(
            "table",
            "table",
            help="A table of the checkpoints and their errors.",
            needs="checkpoints",
        ),
    ),
    numbers=(
        ("CHECKPOINT_COUNT", "Checkpoints"), ("COUNTED", "Counted checkpoints"),
        ("NVA_RMSE", "RMSE without vegetation [m]"), ("VVA_RMSE", "RMSE with vegetation [m]"),
        ("SHIFT", "Shift that would remove the mean difference [m]"),
        ("HOLD_OUT_RMSE", "RMSE of held-out points [m]"),
        ("MEETS_CLASS", "Meets the accuracy class (1 or 0)"),
    ),
    texts=(("VERDICT", "Verdict"),),
    json="the figures",
    command="check",
    identifier="check",
    title="Check against checkpoints",
    section="Quality",
    about="The height of the ground is that of the triangulation (TIN) of the ground points. The"
    " figures, such as the RMSE, and the statement of the ASPRS Positional Accuracy Standards,"
    " edition 2, are given for land without vegetation (NVA) and with it (VVA). Nothing is"
    " shifted.\n"
    "Without checkpoints, a share of the ground points can be left out, to measure how well the"
    " others predict them.",
    page="check",
    words=(
        CLOUD,
        TERRAIN,
        TIN,
        "checkpoints,check points,control points,gcp,accuracy,quality,rmse,rmsez,vertical"
        " accuracy,nva,vva,asprs,validation,lascontrol,hold-out",
    ),
)  # fmt: skip
