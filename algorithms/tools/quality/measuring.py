"""Measures the figures of a survey from its cells."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from ...classes.point_counts import by_class
from ...grids.cells import cells_at
from ...las.crs_records import WKT_RECORD
from ...survey.files import Survey
from .cells import PULSE, ROUGH, WET, QualityCells, twice
from .figures import Quality, lines_of
from .low_confidence import LowConfidence, low_confidence_of
from .rasters import LIMITS, overlap, strip_differences, voids
from .specifications import SPECIFICATIONS, Specification

# Steepest land in degrees on which strips are judged.
_STEEPEST = 10.0
_TOGETHER = 1 << 21  # cells that are looked at together


def quality_of(
    cells: QualityCells, survey: Survey, specification: str, least_area: float
) -> tuple[Quality, LowConfidence | None]:
    """Return the figures of a survey with the comparison, from its filled cells, and the low
    confidence areas of `least_area` m2 and more.
    """
    counts, asked = cells.counts, SPECIFICATIONS[specification]
    files = [
        {
            "name": tile.path.name, "points": tile.count, "version": f"1.{tile.minor_version}",
            "format": tile.point_format, "wkt": tile.vlr(WKT_RECORD) is not None,
            "extent": list(tile.outer_box),
        }
        for tile in survey.tiles
    ]  # fmt: skip
    of_points = {
        **vars(counts), "classes": by_class(counts.classes), "returns": by_class(counts.returns),
        "strips": sorted(counts.strips),
    }  # fmt: skip
    of_cells = {**_densities(cells, asked), **_filled(cells, asked), **_strips(cells)}
    low = low_confidence_of(cells, asked.pulses or of_cells["pulse_density"], least_area)
    if low is not None:
        of_cells |= {
            "low_confidence_density": low.limit, "low_confidence_least_area": least_area,
            "low_confidence_count": len(low.areas), "low_confidence_share": low.share,
            "low_confidence_without_plants": sum(not area.has_plants for area in low.areas),
        }  # fmt: skip
    found = Quality(specification=specification, files=files, **of_points, **of_cells)
    return replace(found, comparison=lines_of(found, asked)), low


def _share(part: float, whole: float) -> float | None:
    return part / whole if whole else None


def _densities(cells: QualityCells, asked: Specification) -> dict[str, Any]:
    """Return densities, and the shares of dense cells and of voids of the ground."""
    extent, square = cells.extent, cells.grids.coarse.size**2
    sums = np.zeros(6)
    for rows in cells.grids.fine.parts():
        for there in cells.surveyed(rows, is_coarse=False):
            inner, pulses, dry = (
                twice(where, there) for where in (extent.inner, extent.pulses, extent.dry)
            )
            returns = cells.first[there].astype(np.int64)
            of_four = returns.reshape(len(returns) // 2, 2, -1, 2).sum(axis=(1, 3))
            is_dense = of_four >= (asked.pulses or 0) * square
            sums += (
                returns[pulses].sum(), cells.points[there][pulses].sum(dtype=np.int64),
                cells.ground_points[there][inner].sum(dtype=np.int64),
                np.count_nonzero(is_dense & pulses[::2, ::2]),
                np.count_nonzero(voids(cells, there) & dry), np.count_nonzero(dry),
            )  # fmt: skip
    first, points, ground, dense, far, land = sums.tolist()
    every, counted = (int(np.count_nonzero(where)) for where in (extent.inner, extent.pulses))
    return {
        "area": every * square, "flagged_area": (every - counted) * square,
        "pulse_density": _share(first, counted * square),
        "point_density": _share(points, counted * square),
        "ground_density": _share(ground, every * square),
        "dense_share": _share(dense, counted) if asked.pulses else None,
        "ground_void_share": _share(far, land),
    }  # fmt: skip


def _filled(cells: QualityCells, asked: Specification) -> dict[str, Any]:
    """Return how many cells have first returns, and the voids without any, outside water."""
    if asked.spacing is None:
        return {}
    spaced, coarse = cells.grids.spaced, cells.grids.coarse
    land = cells.extent.dry & cells.extent.pulses
    count = filled = void_count = 0
    for of_spaced, of_coarse in zip(spaced.pieces, coarse.pieces):
        row, column = cells_at(*of_spaced.window.centres(spaced.size), coarse.size)
        column += of_coarse.right - coarse.window.column
        column = np.clip(column, 0, coarse.window.columns - 1)
        row = np.clip(row + of_coarse.up - coarse.window.row, 0, coarse.window.rows - 1)
        rows, columns = spaced.window.slices(of_spaced.moved)
        own, step = cells.filled[rows, columns], max(_TOGETHER // len(column), 1)
        for start in range(0, len(row), step):
            # With one row more, for the squares of two rows.
            values = own[start : start + step + 1]
            there = land[np.ix_(row[start : start + step + 1], column)] & (values & WET == 0)
            missing = there & (values & PULSE == 0)
            squares = missing[:-1, :-1] & missing[1:, :-1] & missing[:-1, 1:] & missing[1:, 1:]
            void_count += int(np.count_nonzero(squares))
            count += int(np.count_nonzero(there[:step]))
            filled += int(np.count_nonzero(there[:step] & ~missing[:step]))
    return {"filled_share": filled / count, "void_count": void_count} if count else {}


def _strips(cells: QualityCells) -> dict[str, Any]:
    """Return the figures of overlap and of differences between strips."""
    overlapping, compared, squares, largest = 0, 0, 0.0, 0.0
    kinds = np.zeros(3, dtype=np.int64)
    on_flat_land = partial(strip_differences, steepest=_STEEPEST)
    for rows in cells.grids.coarse.parts():
        inner = cells.extent.inner[rows]
        are_several = (cells.rows_of(overlap, rows, is_coarse=True) > 1) & inner
        if not are_several.any():
            continue
        overlapping += int(np.count_nonzero(are_several))
        apart = cells.rows_of(strip_differences, rows, is_coarse=True)[inner]
        apart = apart[~np.isnan(apart)]
        kinds += np.bincount(np.searchsorted(LIMITS, apart, side="right"), minlength=3)
        open_land = inner & (cells.marks[rows] & (ROUGH | WET) == 0)
        even = cells.rows_of(on_flat_land, rows, is_coarse=True)[open_land]
        even = even[~np.isnan(even)]
        squares, compared = squares + float((even**2).sum()), compared + len(even)
        largest = max(largest, float(even.max(initial=0.0)))
    return {
        "overlap_share": _share(overlapping, int(np.count_nonzero(cells.extent.inner))),
        "overlapping": overlapping, "compared": compared,
        "strip_shares": (kinds / kinds.sum()).tolist() if kinds.any() else None,
        "strip_rms": math.sqrt(squares / compared) if compared else None,
        "strip_largest": largest if compared else None,
    }  # fmt: skip
