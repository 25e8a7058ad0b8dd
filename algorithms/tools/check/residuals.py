"""Errors of the ground points and of a terrain model at checkpoints, and common offsets."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any, Iterator, NamedTuple, Sequence

import numpy as np

from ...core.errors import BareEarthError, printable
from ...core.progress import Progress
from ...crs.system import Crs
from ...crs.unit_names import FOOT
from ...rasters.sampling import FAR_BELOW, HeightRaster, HeightSampler
from ...survey.area import Area, Polygon
from ...survey.feature_files import Feature, FeatureLayer
from ...survey.files import Survey
from ...survey.shapes import located
from .checkpoints import Checkpoints, has_height
from .land_covers import CONTROL, LandCovers, kinds_of
from .results import COUNTED, LOW_CONFIDENCE, NO_HEIGHT, REPEATED, SEVERAL_HEIGHTS, listed
from .same_points import contradict, first_at_place
from .survey_ground import SurveyGround

# Fields of the layer. Heights are in the unit of the points, errors in metres.
FIELDS: dict[str, type] = {
    "NAME": str, "COVER": str, "KIND": str, "STATE": str, "Z": float, "GROUND": float,
    "ERROR": float, "DTM": float, "DTM_ERROR": float,
}  # fmt: skip
# An offset is reported if it is larger than this, in metres, and than a multiple of its spread.
_LEAST = 1.0
_TIMES_SPREAD = 5.0
# With one or two checkpoints, which have no spread, it is larger than this, in metres.
_LEAST_OF_FEW = 5.0
_FEW = 3
# Offsets in metres that look like the distance between ellipsoid and geoid.
_UNDULATIONS = (8.0, 110.0)
# A standard deviation in median absolute deviations of normal errors.
_DEVIATION = 1.4826


class Residuals(NamedTuple):
    """The checkpoints, in the CRS of the points, with their errors, one value for each."""

    xyz: np.ndarray  # float64, (n, 3)
    names: tuple[str, ...]
    covers: list[str]  # their land cover, or else their use
    kinds: list[str]  # NVA, VVA or control
    states: list[str]  # "counted", or a key of `REASONS`
    ground: np.ndarray  # float64, (n,): heights of the TIN in the unit of the points; NaN for none
    dtm: np.ndarray  # as `ground`, of the terrain model
    errors: np.ndarray  # float64, (n,): heights of the TIN minus those of checkpoints, metres
    dtm_errors: np.ndarray  # as `errors`, of the terrain model
    expected: np.ndarray  # float64, (n,): the expected error in metres; NaN for none
    unit: float  # metres in a unit of the heights
    unknown_covers: dict[str, int]  # land covers, and how many checkpoints have them

    @property
    def counted(self) -> np.ndarray:
        """Which checkpoints are counted; boolean, shape (n,)."""
        return np.array(self.states) == COUNTED

    def rows(self) -> Iterator[tuple[Any, ...]]:
        """Yield x, y, and the values of `FIELDS` of each checkpoint."""
        x, y, z = self.xyz.T.tolist()
        heights = (self.ground, self.errors, self.dtm, self.dtm_errors)
        rounded = (np.round(values, 4).tolist() for values in heights)
        yield from zip(x, y, self.names, self.covers, self.kinds, self.states, z, *rounded)

    def doubt(self, errors: np.ndarray) -> str:
        """Return a sentence on a common offset of all counted checkpoints, or an empty text."""
        known = self.counted & ~np.isnan(errors)
        points = self.xyz[known, 2] * self.unit
        return offset_in_words(points + errors[known], points)


def residuals_of(
    ground: SurveyGround,
    checkpoints: Checkpoints,
    rasters: Sequence[str | None],  # a terrain model and its expected error
    low_confidence: Sequence[Polygon],
    vegetated: tuple[str, ...],  # words
    max_edge: float,  # metres
    progress: Progress,
) -> Residuals:
    """Return the errors at checkpoints."""
    survey, crs, up = ground.survey, ground.survey.crs, ground.survey.crs.vertical_unit
    checkpoints = checkpoints.located(ground.place, progress, max_edge)
    x, y, _ = checkpoints.xyz.T
    model, error = (_raster(source, ground) for source in rasters)
    dtm = np.full(len(x), np.nan)
    if model is not None:
        dtm = HeightSampler(model).heights(x, y) * (model.unit or up) / up
    expected = np.full(len(x), np.nan)
    if error is not None:
        expected = HeightSampler(error).heights(x, y) * (error.unit or up)
    if model is not None:
        _report_gaps(checkpoints, np.isnan(dtm), progress)
    places = np.column_stack((x, y)) * crs.horizontal_unit
    heights = ground.heights(places, max_edge, progress).heights
    if model is not None:
        model.report(crs, progress)
        model.report_heights(heights - dtm * up, 1.0, FAR_BELOW, progress)
    if ground.counts.classes.any():  # else no file is near, and all checkpoints are outside
        ground.check()
    kinds, unknown = kinds_of(checkpoints, LandCovers(vegetated), progress)
    is_void = np.isnan(heights)
    areas = located(low_confidence, "the low confidence areas", ground.place, progress)
    is_low = Area(None, areas).contains(x, y) if areas else np.zeros(len(x), dtype=bool)
    known = has_height(checkpoints.xyz[:, 2], heights, up)
    reasons = {
        **_of_lists(checkpoints, np.array(kinds) == CONTROL, known, places, up),
        "outside": is_void & ~_touches(survey, x, y),
        "void": is_void,
        LOW_CONFIDENCE: is_low,
    }
    states = np.select(list(reasons.values()), list(reasons), COUNTED)
    checkpoints = _with_fitting_heights(checkpoints, heights, states == COUNTED, up, progress)
    z, uses = (
        np.where(known, checkpoints.xyz[:, 2], np.nan),
        checkpoints.types or checkpoints.covers,
    )
    return Residuals(
        np.column_stack((x, y, z)), checkpoints.names,
        [cover or use for cover, use in zip(checkpoints.covers, uses)], kinds, states.tolist(),
        heights / up, dtm, heights - z * up, (dtm - z) * up, expected, up, unknown,
    )  # fmt: skip


def _of_lists(
    checkpoints: Checkpoints,
    is_control: np.ndarray,
    known: np.ndarray,
    places: np.ndarray,
    up: float,
) -> dict[str, np.ndarray]:
    """Return the reasons that lists of checkpoints give not to count them: control, missing heights
    and points that come several times.
    """
    # Of the same points, the first with a height counts, and none if one of them is control.
    order = np.lexsort((~known, ~is_control))
    first = np.empty(len(order), dtype=np.int64)
    first[order] = order[first_at_place(places[order])]
    is_control = is_control[first]
    heights = np.where(known, checkpoints.xyz[:, 2] * up, np.nan)
    return {
        CONTROL: is_control,
        NO_HEIGHT: ~known,
        SEVERAL_HEIGHTS: contradict(first, heights),
        REPEATED: first != np.arange(len(first)),
    }


def _with_fitting_heights(
    checkpoints: Checkpoints,
    heights: np.ndarray,
    counted: np.ndarray,
    up: float,
    progress: Progress,
) -> Checkpoints:
    """Return checkpoints with the heights of another column, if only these fit the ground."""
    # If the heights of one column have a common offset of metres and those of another one have not,
    # the first column is in another unit or above the ellipsoid.
    columns = [("", checkpoints.xyz[:, 2], None), *checkpoints.others]
    doubts = [offset_in_words(heights[counted], z[counted] * up) for _, z, _ in columns]
    if not doubts[0] or all(doubts):
        return checkpoints
    name, z, _ = columns[doubts.index("")]
    progress.warning(f"{doubts[0]} The heights in {name} fit, and are used instead.")
    return checkpoints.with_heights(z)


def _raster(source: str | None, ground: SurveyGround) -> HeightRaster | None:
    """Return a raster in the CRS of the points."""
    if not source:
        return None
    raster = HeightRaster.of(source)
    raster.check(ground.survey.crs, ground.place.name)
    return raster


def _report_gaps(checkpoints: Checkpoints, gaps: np.ndarray, progress: Progress) -> None:
    """Warn of checkpoints at which the terrain model has no value, or refuse it."""
    if gaps.all():
        raise BareEarthError(
            "The terrain model has no value at any checkpoint. Give one that covers them."
        )
    if gaps.any():
        names = [checkpoints.names[number] for number in np.flatnonzero(gaps)]
        progress.warning(f"The terrain model has no value at checkpoints {listed(names)}.")


def _touches(survey: Survey, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return which places lie in the extent of a file."""
    inside = np.zeros(len(x), dtype=bool)
    for tile in survey.tiles:
        west, south, east, north = tile.outer_box
        inside |= (x >= west) & (x <= east) & (y >= south) & (y <= north)
    return inside


def offset_in_words(heights: np.ndarray, checkpoints: np.ndarray) -> str:
    """Return a sentence on a common offset of heights from those of checkpoints, in metres, such as
    by another unit or vertical datum; empty if there is none.
    """
    errors, count = heights - checkpoints, len(heights)
    if not count:
        return ""
    offset, spread = _middle(errors)
    if abs(offset) <= (_LEAST if count >= _FEW else _LEAST_OF_FEW):
        return ""
    for factor, who, others in (
        (FOOT, "checkpoints", "data"), (1.0 / FOOT, "data", "checkpoints")
    ):  # fmt: skip
        rest, rest_spread = _middle(heights - checkpoints * factor)
        # On high land, a rest could be that of a geoid. On flat land, the spread does not shrink.
        if abs(rest) < min(0.03 * abs(offset), _LEAST) and rest_spread <= spread + 0.05:
            return (
                f"The heights of the {who} are feet where those of the {others} are metres: they"
                f" are {1.0 / FOOT:.3f} times as high. US survey feet and international feet look"
                " the same here. State the unit, as in a column named 'Elevation (ft)', or the CRS"
                " of the points."
            )
    if abs(offset) <= _TIMES_SPREAD * spread:
        return ""
    who = "The checkpoint lies" if count == 1 else f"The {count:,} checkpoints lie"
    alike = f", all alike (spread {spread:.2f} m)" if count >= _FEW else ""
    side = "above" if offset < 0 else "below"
    return f"{who} {abs(offset):.2f} m {side} the data{alike}. {_cause(abs(offset))}"


def _middle(errors: np.ndarray) -> tuple[float, float]:
    """Return the median, and the spread round it as a standard deviation."""
    middle = float(np.median(errors))
    return middle, _DEVIATION * float(np.median(np.abs(errors - middle)))


def _cause(offset: float) -> str:
    least, most = _UNDULATIONS
    if offset > most:
        return "Another unit or another height looks like this. Check the column of the heights."
    if offset >= least:
        return (
            "Heights above the ellipsoid and above the geoid differ like this. Give both in one"
            " vertical datum."
        )
    return (
        "Another vertical datum looks like this, or the height of an antenna or a pole that was"
        " not taken off. Give both in one vertical datum."
    )


def layer_of(found: Residuals, crs: Crs) -> tuple[FeatureLayer, Iterator[Feature]]:
    """Return the checkpoints with their errors as a layer of points."""
    layer = FeatureLayer("checkpoints", "Point Z", FIELDS, crs.wkt, crs.epsg)
    places = np.nan_to_num(found.xyz)[:, None]  # formats refuse NaN; the field Z is empty there
    return layer, (Feature(row[2:], place) for row, place in zip(found.rows(), places))


def write_table(target: Path, found: Residuals) -> None:
    """Write the checkpoints with their errors as CSV, with empty cells where there is no value."""
    # Excel knows by the byte order mark that it is UTF-8.
    with open(target, "w", encoding="utf-8-sig", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["x", "y", *map(str.lower, FIELDS)])
        for row in found.rows():
            writer.writerow(["" if cell != cell else _cell(cell) for cell in row])


def _cell(value: object) -> object:
    """Return the value of a cell, without names that spreadsheets take for formulas."""
    if not isinstance(value, str):
        return value
    value = printable(value)
    return f"'{value}" if value[:1] in ("=", "+", "-", "@") else value
