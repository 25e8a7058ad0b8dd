"""Finds the places of a terrain model that a person should look at first."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Iterator

import numpy as np

from ...classes.corrections import NO_CORRECTIONS, SKIP, Corrections
from ...core.errors import BareEarthError
from ...core.progress import SILENT, Progress
from ...core.words import counted
from ...grids.expected_error import ExpectedAccuracy
from ...rasters.content import NO_CELLS, Source
from ...rasters.geotiff import HeightBand, read_raster
from ...rasters.windows import RasterWindows, Windows, parts_of
from ...report.units import Units
from ...survey.area import Polygon
from ...survey.feature_files import Feature, FeatureLayer, feature_writer
from ...survey.files import Inputs
from ...survey.shapes import Place
from ..contours import corners_of
from ..declaration import RASTER, TERRAIN, FileTool, Input, Output
from .answered import FIELDS, carried_over, changes_of, sorted_by_answers
from .page import SHOWN, review_html
from .places import PlaceToReview, Rasters, Review, places_of
from .profile import ProfilePoints, line_of, points_along
from .reasons import CAUSES


@dataclass(frozen=True)
class ReviewSummary:
    """The places to review."""

    cell_count: int  # with an expected error
    expected_rmse: float  # metres, of all these cells
    limit: float  # metres, the least expected error of places
    over_count: int  # cells over it
    place_count: int  # that were written
    left_out: int  # further places, which weigh less
    small_count: int  # places that are smaller than the least area
    answered: int  # places with an answer in the corrections, which are left out
    share: float  # of the sum of error times area over the limit that is in the written places
    carried: int = 0  # places of the corrections that were written with their answers
    changed: str = ""  # what changed in the terrain model since the run before, as a sentence

    def figures(self, units: Units) -> list[tuple[str, str]]:
        """Return the figures of the page, with their titles."""
        cells = f"{self.over_count:,} of {self.cell_count:,}"
        return [
            ("Expected RMSE", units.height(self.expected_rmse)),
            (f"Cells over {units.height(self.limit)}", cells),
            (
                "Places",
                f"{self.place_count:,} written, {self.left_out:,} of less weight and"
                f" {self.small_count:,} too small left out",
            ),
            ("Places with an answer", f"{self.answered:,} left out, {self.carried:,} carried over"),
        ]

    @property
    def text(self) -> str:
        """The result in a sentence."""
        counts = {"of less weight": self.left_out, "too small": self.small_count}
        left = ", ".join(f"{counted(n, 'place')} {why}" for why, n in counts.items() if n)
        more = f" Left out: {left}." if left else ""
        done = f" {counted(self.answered, 'place')} had an answer." * (self.answered > 0)
        kept = f" {counted(self.carried, 'answer')} carried over." * (self.carried > 0)
        since = f" {self.changed}" * bool(self.changed)
        return (
            f"{counted(self.place_count, 'place')} to review. The expected RMSE of the terrain"
            f" model is {self.expected_rmse:.2f} m; {self.over_count / self.cell_count:.1%} of its"
            f" cells have an expected error over {self.limit:.2f} m.{more}{done}{kept}{since}"
        )


def review(
    source: Source,
    places: Path | None = None,
    page: Path | None = None,
    dtm: Source | None = None,
    cause: Source | None = None,
    earlier: Source | None = None,
    points: Path | None = None,
    corrections: Corrections | None = None,
    how: Review = Review(),
    progress: Progress = SILENT,
) -> ReviewSummary:
    """Write the places of a terrain model with a large expected error, which is a raster, as
    polygons and on a page.
    """
    raster = read_raster(source, window=NO_CELLS)
    rasters, before = _rasters(raster, dtm, cause, earlier)
    units = Units(raster.frame.horizontal_unit, raster.frame.vertical_unit)
    limit = how.limit(rasters.error)
    expected, over = ExpectedAccuracy(), 0
    for window in parts_of(rasters.error):
        error = rasters.error[window]
        expected.add(error)
        over += int(np.count_nonzero(error > limit))
    raster.report(progress)
    if not expected.count:
        raise BareEarthError(f"{source} has no expected error. Give the raster of one.")
    progress(0.2)
    answered = (corrections or NO_CORRECTIONS).located(Place(str(source), raster.crs), progress)
    found, small = places_of(rasters, how, limit, units)
    unanswered, is_answered = sorted_by_answers(found, raster, answered)
    chosen = unanswered[: how.most_places]
    changes = [] if before is None else changes_of(rasters, before, raster, answered)
    progress(0.5)
    total = sum(place.weight for place in unanswered)
    summary = ReviewSummary(
        expected.count,
        round(expected.rmse, 4),
        round(limit, 4),
        over,
        len(chosen),
        len(unanswered) - len(chosen),
        small,
        is_answered,
        round(sum(place.weight for place in chosen) / total, 6) if total else 1.0,
        sum(answer != SKIP for answer in answered.answers),
        changes[0].text if changes else "",
    )
    lines = np.array([corners_of(line_of(rasters, place), raster).ravel() for place in chosen])
    if places is not None:
        layer = FeatureLayer("places", "Polygon", FIELDS, raster.frame.wkt, raster.crs.epsg)
        features = chain(
            _features(chosen, lines, raster, total), carried_over(answered, len(chosen))
        )
        feature_writer(places)(places, features, layer, progress.part(0.5, 0.6))
    if page is not None:
        some = lines[:SHOWN]
        profiles: list[ProfilePoints | None] = [None] * len(some)
        if points is not None:
            profiles = [*points_along(Inputs(points), some, progress=progress.part(0.6, 0.95))]
        name = Path(str(source)).name
        figures = summary.figures(units)
        html = review_html(name, rasters, (chosen, profiles), (figures, changes), units)
        page.write_text(html, encoding="utf-8")
    progress(1.0)
    return summary


def _rasters(
    raster: HeightBand, dtm: Source | None, cause: Source | None, earlier: Source | None
) -> tuple[Rasters, Windows | None]:
    """Return the values of rasters that must have the same cells, and the earlier terrain."""
    width, height = raster.cell_metres
    if not np.isclose(width, height):
        raise BareEarthError(f"{raster.source} has cells that are no squares. Resample it.")
    terrain, causes, before = (
        None if one is None else read_raster(one, window=NO_CELLS) for one in (dtm, cause, earlier)
    )
    for one in (terrain, causes, before):
        if one is not None and (one.whole, one.geotransform) != (raster.whole, raster.geotransform):
            raise BareEarthError(
                f"{one.source} has other cells than {raster.source}. Make both in one run of the"
                " same tool."
            )
    if before is not None and terrain is None:
        raise BareEarthError("Give the terrain model too, which is compared with the earlier one.")
    numbers = None if causes is None else RasterWindows(causes)
    checked = () if numbers is None else (numbers[window] for window in parts_of(numbers))
    for some in checked:
        if ((some < 0) | (some > CAUSES) | (some % 1 > 0)).any():
            raise BareEarthError(
                f"{cause} holds no causes of an expected error. Give such a raster."
            )
    in_metres = (
        None if one is None else RasterWindows(one, one.frame.vertical_unit)
        for one in (terrain, before)
    )
    of_terrain, of_before = in_metres
    error = RasterWindows(raster, raster.frame.vertical_unit)
    return Rasters(error, of_terrain, numbers, width), of_before


def _features(
    places: list[PlaceToReview], lines: np.ndarray, raster: HeightBand, total: float
) -> Iterator[Feature]:
    """Yield the places as polygons, with their profile lines."""
    up = raster.frame.vertical_unit
    for rank, (place, line) in enumerate(zip(places, lines), start=1):
        rings: Polygon = tuple(corners_of(ring, raster) for ring in place.rings)
        yield Feature(
            (
                rank, place.reason, round(place.error, 2), round(place.area, 1),
                round(place.weight / total, 4), round(place.low / up, 2),
                round(place.high / up, 2), None, None, *(round(end, 2) for end in line.tolist()),
            ),
            rings,
        )  # fmt: skip


TOOL = FileTool(
    work=review,
    sets=(Review,),
    inputs=(
        Input(
            "source",
            "raster",
            help="The raster of the expected error of a terrain model, as `terrain()` makes it.",
            label="Expected error",
            named="INPUT",
            made_as="EXPECTED_ERROR",
        ),
        Input(
            "dtm",
            "raster",
            help="The terrain model of the same run: for heights, pictures and profiles.",
            label="Terrain model",
            optional=True,
            made_as="DTM",
        ),
        Input(
            "cause",
            "raster",
            help="The cause of the expected error, of the same run: for the reason of each place.",
            label="Cause of the expected error",
            optional=True,
            made_as="ERROR_CAUSE",
        ),
        Input(
            "points",
            "cloud",
            help="The classified points of the same run, a file, a folder or a .vpc: the page shows"
            " them in the profiles.",
            label="Classified points",
            optional=True,
            advanced=True,
            made_as="OUTPUT",
        ),
        Input(
            "earlier",
            "raster",
            help="The terrain model of the run before the corrections, with the same cells: the"
            " page says what the answers changed.",
            label="Terrain model of the run before",
            optional=True,
            advanced=True,
        ),
        Input("corrections", "corrections", label="Corrections", is_last=True),
    ),
    outputs=(
        Output(
            "places",
            "features",
            help="The places as polygons, with rank, reason, largest expected error, area, heights"
            " and the ends of a profile, and the attribute answer to fill in. Behind them come the"
            " places that the corrections answer, so that the newest layer holds all answers.",
            label="Places to review",
            named="OUTPUT",
            is_main=True,
            look="places",
        ),
        Output(
            "page",
            "page",
            help="A page with the ten places to look at first, their relief and a profile, and what"
            " answers changed.",
            label="Page",
            named="REPORT",
        ),
    ),
    command="review",
    identifier="review",
    title="Places to review",
    section="Quality",
    about="The places are where the expected error is large, those with the largest product of"
    " error and area first, with the reason. Fill in their attribute 'answer': 'right', 'not"
    " ground', 'ground', which continues the ground round the place into it, or 'skip'. Give the"
    " layer to `classify()` as corrections, and to the next `review()`: places with an answer are"
    " left out, and skipped places come last.",
    page="expected-error#places-to-review",
    words=(RASTER, TERRAIN, "review,error,uncertainty,confidence,quality"),
    run_name="places to review",
    numbers=(("PLACE_COUNT", "Places"), ("EXPECTED_RMSE", "Expected RMSE, m")),
)
