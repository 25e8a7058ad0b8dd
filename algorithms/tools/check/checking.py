"""Compares the ground of a survey, and a terrain model, with checkpoints.

The method is that of ASPRS (2023): Positional Accuracy Standards for Digital Geospatial Data,
edition 2, version 1.0.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterable

import numpy as np

from ...core.errors import BareEarthError
from ...core.parameters import ParameterSet, parameter
from ...core.progress import SILENT, Progress
from ...products.survey_ground import SurveyGround
from ...rasters.sampling import FAR_BELOW, HeightRaster, HeightSampler
from ...report.units import round_length
from ...survey.files import Survey
from ...survey.ground_classes import GroundClasses
from .accuracy import Accuracy, Figures, statement
from .checkpoints import Checkpoints
from .height_offsets import offset_in_words
from .hold_out import HoldOut, hold_out
from .land_covers import CONTROL, VVA, LandCovers, kinds_of
from .outputs import CheckOutputs
from .results import COUNTED, NOT_STATED, REASONS, Check, Residuals, listed

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


@dataclass(frozen=True)
class CheckRequest:
    """A request to compare points with checkpoints, or with points that are held out.

    Attributes
    ----------
    checkpoints : Checkpoints or None
        The checkpoints; they can be left out if points are held out.
    options : CheckOptions
        Where heights are compared.
    accuracy : Accuracy
        The class to meet, and the error of the checkpoints.
    ground : GroundClasses
        Which points are ground.
    dtm : str or None
        A terrain model that is compared as well.
    confidence : str or None
        A raster of its confidence, 0 to 1.
    vegetated : tuple of str
        Land covers with one of these words are vegetated, and no others. Empty: those with words
        that are known in several languages.
    outputs : CheckOutputs
        The files to write.
    crs : str or None
        The CRS of the points in place of the one that files state: an EPSG code, such as
        "EPSG:25832", or "EPSG:2230+6360" with that of the heights, or well-known text.
    """

    checkpoints: Checkpoints | None = None
    options: CheckOptions = field(default_factory=CheckOptions)
    accuracy: Accuracy = field(default_factory=Accuracy)
    ground: GroundClasses = field(default_factory=GroundClasses)
    dtm: str | None = None
    confidence: str | None = None
    vegetated: tuple[str, ...] = ()
    outputs: CheckOutputs = field(default_factory=CheckOutputs)
    crs: str | None = None

    @classmethod
    def of(cls, sets: Iterable[ParameterSet], **others: Any) -> CheckRequest:
        """Return a request with parameter sets, given in any order, and other attributes."""
        names = {type(value): name for name, value in vars(cls()).items()}
        others.update((names[type(each)], each) for each in sets)
        return cls(**others)


def check_files(
    sources: Iterable[Path],
    request: CheckRequest = CheckRequest(),
    progress: Progress = SILENT,
) -> Check:
    """Compare the ground points of one file or many, and a terrain model, with checkpoints.

    Each checkpoint is compared with the Delaunay triangle of the ground points that holds it, and
    with the terrain model between the centres of its cells. Points are read in parts, and only
    those near checkpoints are kept.

    Parameters
    ----------
    sources : iterable of Path
        Classified LAS, LAZ and COPC files, folders of them, virtual point clouds and lists.
    request : CheckRequest
        What they are compared with, and what is written.
    progress : Progress
        Receives progress and messages.

    Returns
    -------
    Check

    Raises
    ------
    BareEarthError
        If an input cannot be read or an output cannot be written, there is no ground, no checkpoint
        can be compared, or there are neither checkpoints nor points to hold out.
    Cancelled
        If the user asked to stop; no output is left behind.

    Examples
    --------
    >>> from bare_earth.algorithms import CheckRequest, check, read_checkpoints
    >>> points = read_checkpoints("checkpoints.csv")  # doctest: +SKIP
    >>> check(["ground.laz"], CheckRequest(points)).nva.rmse  # doctest: +SKIP
    0.043
    """
    paths = [Path(each) for each in sources]
    given, share = request.checkpoints, request.options.hold_out
    if given is None and share is None:
        raise BareEarthError("Give checkpoints, or a share of the ground points to hold out.")
    request.outputs.check(tuple(paths), given)
    ground = SurveyGround.of(paths, request.ground, progress.part(0.0, 0.05), request.crs)
    middle, found, held = 0.95 if share is None else 0.5, None, None
    if given is not None:
        found = _residuals(ground, given, request, progress.part(0.05, middle))
    if share is not None:
        part = progress.part(0.05 if given is None else middle, 0.95)
        held = hold_out(ground, share, request.options.max_edge, part)
    check = _check_of(found, request.accuracy, held)
    if check.doubt:
        progress.warning(f"{check.doubt} {NOT_STATED}")
    request.outputs.write(check, found, ground.survey, progress)
    return check


def _residuals(
    ground: SurveyGround, checkpoints: Checkpoints, request: CheckRequest, progress: Progress
) -> Residuals:
    """Return the errors at checkpoints."""
    survey, reach = ground.survey, request.options.max_edge
    checkpoints = checkpoints.located(ground.place, progress, reach)
    x, y, _ = checkpoints.xyz.T
    across, up = survey.crs.horizontal_unit, survey.crs.vertical_unit
    model, confidence = (_raster(each, ground) for each in (request.dtm, request.confidence))
    dtm, sure = _sampled(model, x, y, up), _sampled(confidence, x, y)
    if dtm is not None:
        _tell_of_gaps(checkpoints, np.isnan(dtm), progress)
    heights = ground.heights(np.column_stack((x, y)) * across, reach, progress).heights
    if model is not None and dtm is not None:
        model.tell(survey.crs, progress)
        model.tell_of_heights(heights - dtm * up, 1.0, FAR_BELOW, progress)
    if ground.counts.classes.any():  # else no file is near, and all checkpoints are outside
        ground.check()
    states = np.full(len(x), COUNTED, dtype=object)
    if sure is not None:
        states[~(sure >= request.options.min_confidence)] = "doubtful"
    states[np.isnan(heights)] = "void"
    states[np.isnan(heights) & ~_touches(survey, x, y)] = "outside"
    kinds, unknown = kinds_of(checkpoints, LandCovers(request.vegetated), progress)
    states[[each == CONTROL for each in kinds]] = CONTROL
    dtm = np.full(len(x), np.nan) if dtm is None else dtm
    checkpoints = _with_fitting_heights(checkpoints, heights, states == COUNTED, up, progress)
    z = checkpoints.xyz[:, 2]
    return Residuals(
        checkpoints, np.array([each == VVA for each in kinds]), unknown, tuple(states),
        heights / up, dtm, heights - z * up, (dtm - z) * up, up,
    )  # fmt: skip


def _with_fitting_heights(
    checkpoints: Checkpoints,
    heights: np.ndarray,
    counted: np.ndarray,
    up: float,
    progress: Progress,
) -> Checkpoints:
    """Return checkpoints with the heights of another column, if only these can be meant."""
    # Those of one column are metres off, all alike, and those of the other are not: one of both is
    # in another unit or above the ellipsoid.

    def offset_of(z: np.ndarray) -> str:
        return offset_in_words(heights[counted], z[counted] * up)

    doubt = offset_of(checkpoints.xyz[:, 2])
    if not doubt:
        return checkpoints
    for name, z, _ in checkpoints.others:
        if not offset_of(z):
            progress.warning(f"{doubt} The heights in {name} fit: these are taken instead.")
            return checkpoints.with_heights(z)
    return checkpoints


def _raster(source: str | None, ground: SurveyGround) -> HeightRaster | None:
    """Return a raster in the CRS of the points."""
    if not source:
        return None
    raster = HeightRaster.of(source)
    raster.check(ground.survey.crs, ground.place.name)
    return raster


def _sampled(
    raster: HeightRaster | None, x: np.ndarray, y: np.ndarray, up: float | None = None
) -> np.ndarray | None:
    """Return values of a raster, if any, at places, or heights in units of `up` metres."""
    if raster is None:
        return None
    values = HeightSampler(raster).heights(x, y)
    return values if up is None else values * (raster.unit or up) / up


def _tell_of_gaps(checkpoints: Checkpoints, gaps: np.ndarray, progress: Progress) -> None:
    """Warn of checkpoints at which the terrain model has no value, or refuse it."""
    names = [checkpoints.names[each] for each in np.flatnonzero(gaps)]
    if len(names) == checkpoints.count:
        raise BareEarthError(
            "The terrain model has no value at any checkpoint. Give one that covers them."
        )
    if names:
        progress.warning(f"The terrain model has no value at checkpoints {listed(names)}.")


def _touches(survey: Survey, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return which places lie in the extent of a file."""
    inside = np.zeros(len(x), dtype=bool)
    for tile in survey.tiles:
        west, south, east, north = tile.outer_box
        inside |= (x >= west) & (x <= east) & (y >= south) & (y <= north)
    return inside


def _scale_of(found: Residuals) -> float:
    """Return the error in metres at which colours end: most lie well within it."""
    most = float(np.percentile(np.abs(found.errors[found.counted]), 95.0))
    return round_length(2.0 * max(most, 0.001))


def _check_of(found: Residuals | None, accuracy: Accuracy, held: HoldOut | None) -> Check:
    """Return the figures of residuals."""
    if found is None:
        return Check(accuracy_class=accuracy.accuracy_class, hold_out=held)
    counted, names = found.counted, found.checkpoints.names
    others: dict[str, list[str]] = {}
    for name, state in zip(names, found.states):
        if state != COUNTED:
            others.setdefault(state, []).append(name)
    if not counted.any():
        why = "; ".join(f"{len(each):,} {REASONS[state]}" for state, each in others.items())
        raise BareEarthError(
            f"None of the {len(names):,} checkpoints can be compared: {why}. Check their CRS, and"
            " which classes are ground."
        )
    lands = counted & ~found.vegetated, counted & found.vegetated
    nva, vva, dtm_nva, dtm_vva = (
        Figures.of(errors[land], accuracy.survey_error)
        for errors in (found.errors, found.dtm_errors)
        for land in (each & ~np.isnan(errors) for each in lands)
    )
    doubt, dtm_doubt = (_doubt_of(found, errors) for errors in (found.errors, found.dtm_errors))
    worst = np.argsort(np.where(counted, -np.abs(found.errors), 0.0), kind="stable")[:_LARGEST]
    goal = accuracy.accuracy_class
    of_dtm = NOT_STATED if dtm_doubt else statement(dtm_nva, dtm_vva, goal)
    return Check(
        checkpoint_count=len(names),
        counted=int(np.count_nonzero(counted)),
        nva=nva, vva=vva, dtm_nva=dtm_nva, dtm_vva=dtm_vva,
        not_counted=others,
        unknown_covers=found.unknown_covers,
        doubt=doubt or (f"Terrain model: {dtm_doubt}" if dtm_doubt else ""),
        largest=[
            {"name": names[each], "error": round(float(found.errors[each]), 6)}
            for each in worst.tolist()
            if counted[each]
        ],
        shift=None if nva is None or doubt else nva.mean,
        accuracy_class=goal,
        meets_class=None if goal is None or nva is None or doubt else nva.total_rmse <= goal,
        scale=_scale_of(found),
        statement=NOT_STATED if doubt else statement(nva, vva, goal),
        dtm_statement=of_dtm if dtm_nva is not None or dtm_vva is not None else "",
        hold_out=held,
    )  # fmt: skip


def _doubt_of(found: Residuals, errors: np.ndarray) -> str:
    """Return what makes the errors alike at all checkpoints that are counted."""
    known = found.counted & ~np.isnan(errors)
    points = found.checkpoints.xyz[known, 2] * found.unit
    return offset_in_words(points + errors[known], points)
