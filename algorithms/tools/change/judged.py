"""What a place probably is, by its shape and by the points of both dates."""

from __future__ import annotations

from typing import Sequence

import numpy as np

from ...core.progress import Progress
from ...las.cloud import PointCloud
from ...survey.files import Inputs
from ...survey.window import taken_near
from ..contours import corners_of
from .pair import Pair
from .places import ChangePlace
from .stable import Alignment

EARTH = "earth"
NEW = "building or other object, new"
GONE = "building or other object, gone"
PLANTS = "plants taken for ground"
WATER = "water level"
GAP = "edge of a gap"
SAME = "the same in the points of both dates"  # such places are left out

_NOISE = (7, 18)  # classes of points that are no witnesses
# Below a terrain that rose or has not sunk yet there are no points, unless the filter took plants
# for ground: in this share of the cells is enough. Plants can be where the other date has its
# terrain, so this takes more cells, and points that lie nearer.
_BELOW, _AT = 0.3, 0.7
# The share of a change that a point may lie off a terrain to be part of it, and metres at most.
_OFF, _MOST_OFF = 0.4, (0.5, 0.2)
_AROUND = 4  # cells round a place that its surroundings are taken from
_EMPTY = 0.3  # share of the surroundings without value beside gaps
# Of water: the least area in square metres, and the most that half of the cells lie apart.
_WATER_AREA, _FLAT = 100.0, 0.05
# An object stands out of its surroundings by this share of the change, is as high two cells inside
# its edge, and at least so high, in metres.
_STANDS_OUT, _FULL, _LEAST_HEIGHT = 0.6, 0.7, 1.5
_ROUGH = 0.25  # share of the change by which cells of plants differ from their neighbours


def judged(
    pair: Pair,
    alignment: Alignment,
    places: Sequence[ChangePlace],
    clouds: Sequence[Inputs | None],
    progress: Progress,
) -> list[ChangePlace]:
    """Return the places with what they probably are."""
    kinds = [_by_shape(pair, alignment, place) for place in places]
    if places and any(cloud is not None for cloud in clouds):
        is_same = np.zeros(len(places), dtype=bool)
        for is_new, (cloud, part) in enumerate(zip(clouds, progress.shares(1, 1))):
            if cloud is not None:
                # The points of the date whose terrain is higher reach below it.
                rose = np.array([place.mean > 0 for place in places])
                is_upper = rose == bool(is_new)
                seen = _Witnesses(pair, alignment, places, bool(is_new)).seen(cloud, part)
                is_same |= seen >= np.where(is_upper, _BELOW, _AT)
        kinds = [SAME if same else kind for kind, same in zip(kinds, is_same)]
    return [place._replace(kind=kind) for place, kind in zip(places, kinds)]


class _Witnesses:
    """The points of one date at the terrain of the other."""

    def __init__(
        self, pair: Pair, alignment: Alignment, places: Sequence[ChangePlace], is_new: bool
    ) -> None:
        self._pair, self._alignment, self._places, self._is_new = pair, alignment, places, is_new
        rows, columns, old, change = (
            np.concatenate([getattr(place, name) for place in places])
            for name in ("rows", "columns", "old", "change")
        )
        code = rows * pair.grid.whole[1] + columns
        self._order = np.argsort(code, kind="stable")
        self._code, self._change = code[self._order], change[self._order]
        self._terrain = (old if is_new else old + change)[self._order]  # of the other date
        self._has, self._is_there = np.zeros((2, len(code)), dtype=bool)
        _, a, b, _, c, d = pair.grid.geotransform
        self._inverse = np.linalg.inv([[a, b], [c, d]])

    def seen(self, cloud: Inputs, progress: Progress) -> np.ndarray:
        """Return the share of the cells of each place whose points tell that it was there."""
        survey, boxes = cloud.open(), []
        for place in self._places:
            ends = np.array([(part.start, part.stop) for part in place.window]).T - 0.5
            corners = np.sort(corners_of(ends, self._pair.grid), axis=0)
            boxes.append((*corners[0].tolist(), *corners[1].tolist()))
        shares = progress.shares(*(max(tile.count, 1) for tile in survey.tiles))
        for tile, share in zip(survey.tiles, shares):
            taken_near(tile, boxes, self._look_at, share.quiet())
        number = np.repeat(np.arange(len(boxes)), [len(place.rows) for place in self._places])
        is_there, any_there = (
            np.bincount(number[self._order[values]], minlength=len(boxes))
            for values in (self._is_there, self._has)
        )
        return is_there / np.maximum(any_there, 1)

    def _look_at(self, part: PointCloud) -> None:
        """Note the cells in which points of a part of a file lie at the terrain."""
        (x, y), (rows, columns) = part.coordinates(), self._pair.grid.whole
        unit = self._pair.grid.frame.horizontal_unit
        west, north = self._pair.grid.geotransform[::3]
        if self._is_new and self._alignment.is_moved:
            x, y = x - self._alignment.east / unit, y - self._alignment.north / unit
        column, row = self._inverse @ np.array([x - west, y - north])
        inside = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
        inside &= ~part.withheld & ~np.isin(part.classification, _NOISE)
        code = row[inside].astype(np.int64) * columns + column[inside].astype(np.int64)
        place = np.minimum(np.searchsorted(self._code, code), len(self._code) - 1)
        is_one = self._code[place] == code
        place = place[is_one]
        z = part.z[inside][is_one] * part.scale[2] + part.offset[2]
        z = z * part.crs.vertical_unit
        if self._is_new:
            z = z - self._alignment.at(
                *self._pair.places(*(np.floor(of[inside][is_one]) for of in (row, column)))
            )
        change, above = self._change[place], z - self._terrain[place]
        is_upper = (change > 0) == self._is_new
        off = np.minimum(_OFF * np.abs(change), np.where(is_upper, *_MOST_OFF))
        self._has[place] = True
        self._is_there[place[(above <= off) & ((above >= -off) | is_upper)]] = True


def _by_shape(pair: Pair, alignment: Alignment, place: ChangePlace) -> str:
    """Return what a place probably is, by its surroundings and its edge."""
    from scipy import ndimage

    inside = np.pad(place.mask, _AROUND)
    window = tuple(slice(part.start - _AROUND, part.stop + _AROUND) for part in place.window)
    old, new = (_padded(values, window, pair.grid.whole) for values in (pair.old, pair.new))
    square = np.ones((3, 3), dtype=bool)
    near = ndimage.binary_dilation(inside, square, _AROUND) & ~ndimage.binary_dilation(inside)
    if np.isnan(old[near] + new[near]).mean() > _EMPTY:
        return GAP
    if place.area >= _WATER_AREA and max(_spread(old[inside]), _spread(new[inside])) < _FLAT:
        return WATER
    change = np.zeros(inside.shape)
    change[inside] = place.change[np.lexsort((place.columns, place.rows))]
    depth = ndimage.distance_transform_cdt(inside, "chessboard")
    height = float(np.quantile(np.abs(place.change), 0.8))
    upper = new if place.mean > 0 else old
    out = float(np.nanmedian(upper[depth >= min(3, depth.max())]) - np.nanmedian(upper[near]))
    edge = np.abs(change[depth == 3])
    is_sharp = len(edge) > 0 and float(np.median(edge)) >= _FULL * height
    if is_sharp and height >= _LEAST_HEIGHT and out >= _STANDS_OUT * height:
        return NEW if place.mean > 0 else GONE
    rough = np.abs(change - ndimage.uniform_filter(change, 3))[depth >= 2]
    if len(rough) and float(np.median(rough)) > _ROUGH * abs(place.mean):
        return PLANTS
    return EARTH


def _padded(values: object, window: tuple[slice, ...], whole: tuple[int, int]) -> np.ndarray:
    """Return the cells of a window, NaN beyond the raster."""
    rows, columns = window
    there = values[  # type: ignore[index]
        max(rows.start, 0) : min(rows.stop, whole[0]),
        max(columns.start, 0) : min(columns.stop, whole[1]),
    ]
    beyond = [
        (max(-part.start, 0), max(part.stop - count, 0)) for part, count in zip(window, whole)
    ]
    return np.pad(there.astype(np.float64), beyond, constant_values=np.nan)


def _spread(heights: np.ndarray) -> float:
    """Return how far the middle half of heights lies apart."""
    low, high = np.nanquantile(heights, (0.25, 0.75))
    return float(high - low)
