"""Canopy that was lost, gained or grew between two canopy height models."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Iterator

import numpy as np

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet, parameter
from ..core.progress import SILENT, Progress
from ..core.words import counted
from ..rasters.content import NO_CELLS, Source
from ..rasters.geotiff import NODATA, HeightBand, read_raster
from ..rasters.writing import write_geotiff
from ..survey.area import Polygon
from ..survey.feature_files import Feature, FeatureLayer, feature_writer
from .canopy import HeightBlock, TwoHeights
from .change.places import ChangePlace, connected
from .contours import corners_of
from .declaration import CANOPY, RASTER, FileTool, Input, Output

LOST, GAINED = "canopy lost", "canopy gained"
# No tree is higher: a raster whose cells are so high in the mean has heights above the sea.
_HIGHEST = 130.0
_FIELDS = {"RANK": int, "KIND": str, "AREA": float, "MEAN": float, "LARGEST": float}


@dataclass(frozen=True)
class CanopyChanges(ParameterSet):
    """What canopy is, and which places are told."""

    least_height: float = parameter(
        2.0,
        label="Least height of canopy",
        unit="m",
        minimum=0.1,
        maximum=100.0,
        help="Cells that are lower are no canopy.",
    )
    least_width: float = parameter(
        5.0,
        label="Least width",
        unit="m",
        minimum=0.0,
        maximum=1000.0,
        help="Places that hold no square of this width are left out: at the edges of crowns, and in"
        " crowns without leaves, two flights differ by chance.",
    )


@dataclass(frozen=True)
class CanopyChange:
    """The canopy of two surveys, in the cells that both know; metres and square metres."""

    known_area: float
    area_before: float  # of canopy
    area_after: float
    place_count: int
    lost_area: float  # of the places
    gained_area: float
    growth: float | None  # mean, where canopy stays

    @property
    def text(self) -> str:
        """The result in sentences."""
        before, after = (area / self.known_area for area in (self.area_before, self.area_after))
        stays = "" if self.growth is None else f" Where it stays: {self.growth:+.2f} m."
        return (
            f"Canopy on {self.area_before:,.0f} m² ({before:.1%}) before and"
            f" {self.area_after:,.0f} m² ({after:.1%}) after. In"
            f" {counted(self.place_count, 'place')}: {self.lost_area:,.0f} m² lost,"
            f" {self.gained_area:,.0f} m² gained.{stays}"
        )


def canopy_change(
    old: Source,
    new: Source,
    difference: Path,
    places: Path | None = None,
    how: CanopyChanges = CanopyChanges(),
    progress: Progress = SILENT,
) -> CanopyChange:
    """Write the difference of two canopy height models, on the grid of the old one, and where
    canopy was lost and gained.
    """
    raster = read_raster(old, window=NO_CELLS, progress=progress)
    found = _ChangedCells(raster, how)
    heights = TwoHeights(raster, new, progress)
    cells = heights.cells(found.margin, found.change_in, progress.part(0.0, 0.9))
    shows = "Change of the canopy, {unit}"
    write_geotiff(difference, cells, raster, NODATA, progress.part(0.9, 1.0), shows)
    found.check(old, new)
    places_found = found.places()
    if places is not None:
        layer = FeatureLayer("canopy", "Polygon", _FIELDS, raster.frame.wkt, raster.crs.epsg)
        feature_writer(places)(places, _features(places_found, raster), layer, progress)
    return found.summary(places_found)


class _ChangedCells:
    """What was found in the cells so far."""

    def __init__(self, raster: HeightBand, how: CanopyChanges) -> None:
        self._raster, self._how = raster, how
        self._side = math.sqrt(math.prod(raster.cell_metres))
        self._width = tuple(max(round(how.least_width / side), 1) for side in raster.cell_metres)
        self._known = self._before = self._after = self._stays = 0
        self._old, self._new, self._grown = 0.0, 0.0, 0.0  # sums of heights and of growth
        self._changed: dict[str, list[np.ndarray]] = {LOST: [], GAINED: []}

    @property
    def margin(self) -> int:
        """The cells round a block that its places need."""
        return 2 * max(self._width)

    def change_in(self, block: HeightBlock) -> np.ndarray:
        """Return the change in a block, and add what is found there."""
        old, new, inner = block.first, block.second, block.inner
        change = new - old
        known = ~np.isnan(change)
        was, is_now = (known & (of >= self._how.least_height) for of in (old, new))
        for kind, changed in ((LOST, was & ~is_now), (GAINED, is_now & ~was)):
            wide = np.zeros_like(changed)
            wide[inner] = _wide(changed, self._width)[inner]
            row, column = np.nonzero(wide)
            place = (row + block.row).astype(np.int64) * self._raster.whole[1]
            self._changed[kind].append(np.stack((place + column + block.column, change[wide])))
        known, was, is_now, change = (of[inner] for of in (known, was, is_now, change))
        stays = was & is_now
        self._known += int(np.count_nonzero(known))
        self._before += int(np.count_nonzero(was))
        self._after += int(np.count_nonzero(is_now))
        self._stays += int(np.count_nonzero(stays))
        self._old += float(old[inner][known].sum())
        self._new += float(new[inner][known].sum())
        self._grown += float(change[stays].sum())
        return change

    def check(self, old: Source, new: Source) -> None:
        """Refuse rasters that do not overlap, and those of heights above the sea."""
        if not self._known:
            raise BareEarthError(
                f"No cell has a value in both {old} and {new}. Give two rasters of the same place."
            )
        for name, total in ((old, self._old), (new, self._new)):
            if total / self._known > _HIGHEST:
                raise BareEarthError(
                    f"{name} is {total / self._known:,.0f} m high in the mean, so it is no canopy"
                    " height model. Subtract the terrain model first."
                )

    def places(self) -> list[ChangePlace]:
        """Return the places, the largest first."""
        found, none = list[ChangePlace](), np.empty(0)
        for kind, parts in self._changed.items():
            cells, change = np.concatenate(parts, axis=1) if parts else np.empty((2, 0))
            order = np.argsort(cells)
            cells, change = cells[order].astype(np.int64), change[order]
            for some in connected(cells, self._raster.whole[1]):
                rows, columns = np.divmod(cells[some], self._raster.whole[1])
                values = none, change[some], none, none
                found.append(ChangePlace(rows, columns, *values, self._side, 0.0, kind))
        return sorted(found, key=lambda place: (-len(place.rows), place.rows[0], place.columns[0]))

    def summary(self, places: list[ChangePlace]) -> CanopyChange:
        """Return the figures, given the places."""
        cell = self._side**2
        lost, gained = (
            sum((place.area for place in places if place.kind == kind), 0.0)
            for kind in (LOST, GAINED)
        )
        growth = round(self._grown / self._stays, 4) if self._stays else None
        known, before, after = (
            round(float(count * cell), 1) for count in (self._known, self._before, self._after)
        )
        return CanopyChange(
            known, before, after, len(places), round(lost, 1), round(gained, 1), growth
        )


def _wide(changed: np.ndarray, width: tuple[int, ...]) -> np.ndarray:
    """Return the cells of rectangles so wide (columns, rows), and their neighbours."""
    from scipy import ndimage

    core = ndimage.binary_opening(changed, np.ones(width[::-1], dtype=bool))
    return ndimage.binary_dilation(core, np.ones((3, 3), dtype=bool), mask=changed)


def _features(places: list[ChangePlace], raster: HeightBand) -> Iterator[Feature]:
    """Yield the places as polygons, in the units of the raster."""
    across, up = raster.frame.horizontal_unit, raster.frame.vertical_unit
    for rank, place in enumerate(places, start=1):
        rings: Polygon = tuple(corners_of(ring, raster) for ring in place.rings)
        heights = round(place.mean / up, 3), round(place.largest / up, 3)
        yield Feature((rank, place.kind, round(place.area / across**2, 2), *heights), rings)


TOOL = FileTool(
    work=canopy_change,
    sets=(CanopyChanges,),
    inputs=(
        Input(
            "old",
            "raster",
            help="The canopy height model of the older survey, as `terrain()` or `canopy()` makes"
            " it. Its grid is used.",
            label="Old canopy height (CHM)",
        ),
        Input(
            "new",
            "raster",
            help="That of the newer survey. On another grid, its heights are interpolated.",
            label="New canopy height (CHM)",
        ),
    ),
    outputs=(
        Output(
            "difference",
            "raster",
            help="New minus old canopy height in each cell.",
            label="Change of the canopy",
            named="OUTPUT",
            is_main=True,
            look="canopy change",
        ),
        Output(
            "places",
            "features",
            help="Where canopy was lost or gained, as polygons: area, mean and largest change.",
            label="Places of change",
            look="places of change",
        ),
    ),
    always_reports=True,
    command="canopy-change",
    identifier="canopychange",
    title="Canopy change",
    section="Products",
    about="Cells are canopy from the least height on. Canopy is lost where the old model has it and"
    " the new one does not, and gained in the reverse case. Where it stays, the result has its mean"
    " growth.\n"
    "Give canopy height models with the same cells, made in the same way from points of similar"
    " density: more points in a cell find higher tops. Buildings count as canopy.",
    page="change#canopy",
    words=(CANOPY, RASTER, "change,difference,forest,growth,loss,logging,windthrow,gaps,cover"),
    run_name="canopy change",
    shown=(),
    numbers=(
        ("AREA_BEFORE", "Area of canopy before, m2"),
        ("AREA_AFTER", "Area of canopy after, m2"),
        ("PLACE_COUNT", "Places"),
        ("LOST_AREA", "Canopy lost, m2"),
        ("GAINED_AREA", "Canopy gained, m2"),
        ("GROWTH", "Mean growth where canopy stays, m"),
    ),
)
