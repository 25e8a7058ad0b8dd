"""Finds the places of a terrain model that a person should look at first."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Iterator

import numpy as np

from ...classes.corrections import NO_CORRECTIONS, Corrections
from ...core.errors import BareEarthError
from ...core.progress import SILENT, Progress
from ...core.words import counted
from ...grids.expected_error import expected_rmse
from ...rasters.content import Source
from ...rasters.geotiff import Raster, read_raster
from ...report.units import Units
from ...survey.area import Area, Polygon
from ...survey.feature_files import Feature, Layer, feature_writer
from ...survey.shapes import Place
from ...survey.vector_files import CLASS_FIELD
from ..contours import corners_of
from ..declaration import RASTER, TERRAIN, FileTool, Input, Output
from .page import review_html
from .places import CAUSES, PlaceToReview, Rasters, Review, places_of

# Heights are in the unit of the raster, errors and areas in metres and square metres.
FIELDS: dict[str, type] = {
    "RANK": int, "REASON": str, "ERROR": float, "AREA": float, "SHARE": float, "LOW": float,
    "HIGH": float, CLASS_FIELD: int,
}  # fmt: skip


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
    answered: int  # places with an answer in the corrections
    share: float  # of the sum of error times area over the limit that is in the written places

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
            ("Places with an answer", f"{self.answered:,}"),
        ]

    @property
    def text(self) -> str:
        """The result in a sentence."""
        counts = {"of less weight": self.left_out, "too small": self.small_count}
        left = ", ".join(f"{counted(n, 'place')} {why}" for why, n in counts.items() if n)
        more = f" Left out: {left}." if left else ""
        done = f" {counted(self.answered, 'place')} had an answer." * (self.answered > 0)
        return (
            f"{counted(self.place_count, 'place')} to review. The expected RMSE of the terrain"
            f" model is {self.expected_rmse:.2f} m; {self.over_count / self.cell_count:.1%} of its"
            f" cells have an expected error over {self.limit:.2f} m.{more}{done}"
        )


def review(
    source: Source,
    places: Path | None = None,
    page: Path | None = None,
    dtm: Source | None = None,
    cause: Source | None = None,
    corrections: Corrections | None = None,
    how: Review = Review(),
    progress: Progress = SILENT,
) -> ReviewSummary:
    """Write the places of a terrain model with a large expected error, which is a raster, as
    polygons and on a page.
    """
    raster = read_raster(source)
    raster.tell(progress)
    rasters = _rasters(raster, dtm, cause)
    units = Units(raster.frame.horizontal_unit, raster.frame.vertical_unit)
    known = np.isfinite(rasters.error)
    if not known.any():
        raise BareEarthError(f"{source} has no expected error. Give the raster of one.")
    progress(0.3)
    where = Place(str(source), raster.crs)
    answered = (corrections or NO_CORRECTIONS).located(where, progress).polygons
    limit = how.limit(rasters.error)
    found, small = places_of(rasters, how, limit, units)
    is_done = _are_answered(found, raster, answered)
    unanswered = [place for place, done in zip(found, is_done) if not done]
    chosen = unanswered[: how.most_places]
    progress(0.7)
    total = sum(place.weight for place in unanswered)
    summary = ReviewSummary(
        int(np.count_nonzero(known)),
        round(expected_rmse(rasters.error), 4),
        round(limit, 4),
        int(np.count_nonzero(rasters.error[known] > limit)),
        len(chosen),
        len(unanswered) - len(chosen),
        small,
        len(found) - len(unanswered),
        round(sum(place.weight for place in chosen) / total, 6) if total else 1.0,
    )
    if places is not None:
        layer = Layer("places", "Polygon", FIELDS, raster.frame.wkt, raster.crs.epsg)
        features = _features(chosen, raster, total)
        feature_writer(places)(places, features, layer, progress.part(0.7, 0.9))
    if page is not None:
        name = Path(str(source)).name
        html = review_html(name, rasters, chosen, summary.figures(units), units)
        page.write_text(html, encoding="utf-8")
    progress(1.0)
    return summary


def _rasters(raster: Raster, dtm: Source | None, cause: Source | None) -> Rasters:
    """Return the values of rasters that must have the same cells."""
    width, height = raster.cell_metres
    if not np.isclose(width, height):
        raise BareEarthError(f"{raster.source} has cells that are no squares. Resample it.")
    values = [None if one is None else read_raster(one) for one in (dtm, cause)]
    for name, one in zip((dtm, cause), values):
        if one is not None and (one.whole, one.geotransform) != (raster.whole, raster.geotransform):
            raise BareEarthError(
                f"{name} has other cells than {raster.source}. Make both in one run of the same"
                " tool."
            )
    terrain, causes = values
    numbers = None if causes is None else np.nan_to_num(causes.heights)
    if numbers is not None and ((numbers < 0) | (numbers > CAUSES) | (numbers % 1 > 0)).any():
        raise BareEarthError(f"{cause} holds no causes of an expected error. Give such a raster.")
    return Rasters(
        raster.heights * np.float32(raster.frame.vertical_unit),
        None if terrain is None else terrain.heights * np.float32(terrain.frame.vertical_unit),
        numbers,
        width,
    )


def _are_answered(
    places: list[PlaceToReview], raster: Raster, answered: tuple[Polygon, ...]
) -> np.ndarray:
    """Return of which places the worst cell lies in a polygon with an answer; bool, (n,)."""
    if not answered or not places:
        return np.zeros(len(places), dtype=bool)
    x, y = corners_of(np.array([place.worst for place in places]), raster).T
    return Area(None, answered).contains(x, y)


def _features(places: list[PlaceToReview], raster: Raster, total: float) -> Iterator[Feature]:
    """Yield the places as polygons."""
    up = raster.frame.vertical_unit
    for rank, place in enumerate(places, start=1):
        rings: Polygon = tuple(corners_of(ring, raster) for ring in place.rings)
        yield Feature(
            (
                rank, place.reason, round(place.error, 3), round(place.area, 2),
                round(place.weight / total, 5), place.low / up, place.high / up, None,
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
        ),
        Input(
            "dtm",
            "raster",
            help="The terrain model of the same run: for heights, pictures and profiles.",
            label="Terrain model",
            optional=True,
        ),
        Input(
            "cause",
            "raster",
            help="The cause of the expected error, of the same run: for the reason of each place.",
            label="Cause of the expected error",
            optional=True,
        ),
        Input("corrections", "corrections", label="Corrections", is_last=True),
    ),
    outputs=(
        Output(
            "places",
            "features",
            help="The places as polygons, with rank, reason, largest expected error, area and"
            " heights, and the attribute class to fill in.",
            label="Places to review",
            named="OUTPUT",
            is_main=True,
            look="places",
        ),
        Output(
            "page",
            "page",
            help="A page with the ten places to look at first, their relief and a profile.",
            label="Page",
            named="REPORT",
        ),
    ),
    command="review",
    identifier="review",
    title="Places to review",
    section="Quality",
    about="The places are where the expected error is large, those with the largest product of"
    " error and area first, with the reason. Fill in their attribute 'class' (2 is ground, 1 is"
    " not), and give them to `classify()` as corrections. Places that corrections answer are left"
    " out.",
    page="check#places-to-review",
    words=(RASTER, TERRAIN, "review,error,uncertainty,confidence,quality"),
    run_name="places to review",
    numbers=(("PLACE_COUNT", "Places"), ("EXPECTED_RMSE", "Expected RMSE, m")),
)
