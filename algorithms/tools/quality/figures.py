"""Figures about the quality of a survey, and whether they meet a specification."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field
from typing import Any, NamedTuple, Sequence

import numpy as np

from ...core.words import counted
from ...grids.cells import cells_at
from ...las.class_names import named_class
from ...survey.files import Survey
from ...survey.point_counts import by_class
from .cells import FLAGGED, PULSE, ROUGH, WET, Counts, QualityCells, twice
from .rasters import (
    LIMITS,
    QUALITY_RASTERS,
    differences,
    overlap,
    rows_of,
    strip_differences,
)
from .specifications import Specification

PASS, FAIL, LOOK = "pass", "fail", "look"
# Side in metres of the squares by which the area of the survey is told.
_SQUARE = 10.0
_GROUND = 2
# Steepest land in degrees on which strips are judged, and fewest cells of it.
_STEEPEST, _FEWEST_CELLS = 10.0, 30


class Line(NamedTuple):
    """A line of the comparison with a specification."""

    name: str  # what is compared
    found: str
    asked: str  # what is asked for
    state: str  # `PASS`, `FAIL` or `LOOK` (a person must decide)
    source: str  # where the specification says it


@dataclass(frozen=True)
class Quality:
    """The figures of a survey; withheld points are left out, and noise is left out of densities."""

    specification: str
    points: int  # all, also those withheld
    withheld: int  # excluded by the producer
    shared: int  # points that another file holds as well
    duplicates: int  # points that repeat one of their file
    synthetic: int  # points that were not measured
    flagged: int  # points with the flag of overlap
    classes: dict[int, int]
    returns: dict[int, int]
    strips: list[int]  # point source ids
    area: float  # m2 to which the figures refer
    # m2 in which all first returns have the flag of overlap; densities leave it out
    flagged_area: float = 0.0
    pulse_density: float | None = None  # first returns in 1/m2; None without such an area
    point_density: float | None = None  # all returns in 1/m2
    ground_density: float | None = None  # ground points in 1/m2
    dense_share: float | None = None  # of cells of twice the size with the density asked for
    filled_share: float | None = None  # of cells of twice the pulse spacing with a first return
    # squares of four times the spacing without first returns, outside water; they overlap
    void_count: int | None = None
    # of cells farther from the ground than the given distance
    ground_void_share: float | None = None
    overlap_share: float | None = None  # of cells of twice the size, with several strips
    overlapping: int = 0  # these cells
    compared: int = 0  # those on even, open land, in which strips are compared
    strip_rms: float | None = None  # of differences between strips there, in metres
    strip_largest: float | None = None  # in metres
    # of cells with several strips: below 8, below 16, over 16 cm
    strip_shares: list[float] | None = None
    # name, points, version, format, CRS, extent
    files: list[dict[str, Any]] = field(default_factory=list)
    lines: list[Line] = field(default_factory=list)

    @property
    def passes(self) -> bool | None:
        """Whether all lines pass; None if none fails, but some could not be decided."""
        if any(each.state == FAIL for each in self.lines):
            return False
        return None if self.left else True

    @property
    def left(self) -> list[Line]:
        """The lines that do not pass: those that fail, and those that a person must look at."""
        return [each for each in self.lines if each.state != PASS]

    def as_dict(self) -> dict[str, Any]:
        """Return the figures as plain values."""
        found = asdict(self)
        found["lines"] = [each._asdict() for each in self.lines]
        return {**found, "passes": self.passes}

    def rows(self) -> list[tuple[str, str]]:
        """Return titles and values of all figures as text."""
        shares: Sequence[float | None] = self.strip_shares or (None, None, None)
        return [
            ("points", f"{self.points:,}"),
            ("withheld", f"{self.withheld:,}"),
            ("no pulses", self._no_pulses),
            ("classes", ", ".join(f"{name}: {count:,}" for name, count in self.classes.items())),
            ("returns", ", ".join(f"{name}: {count:,}" for name, count in self.returns.items())),
            ("strips", f"{len(self.strips):,}"),
            ("area", f"{self.area:,.0f} m2"),
            ("pulses", _number(self.pulse_density, " first returns/m2")),
            ("density", _number(self.point_density, " points/m2")),
            ("ground", _number(self.ground_density, " ground points/m2")),
            ("dense cells", _share(self.dense_share)),
            ("filled cells", _share(self.filled_share)),
            ("void squares", "not measured" if self.void_count is None else f"{self.void_count:,}"),
            ("ground voids", _share(self.ground_void_share)),
            ("overlap", _share(self.overlap_share)),
            ("compared", f"{self.compared:,} of {counted(self.overlapping, 'cell')}"),
            ("strips RMSDz", _metres(self.strip_rms)),
            ("largest", _metres(self.strip_largest)),
            ("below 8 cm", _share(shares[0])),
            ("8 to 16 cm", _share(shares[1])),
            ("over 16 cm", _share(shares[2])),
        ]

    @property
    def _no_pulses(self) -> str:
        """The points and the area that densities leave out, beside withheld points and noise."""
        words = [
            f"{named}: {count:,}"
            for named, count in (
                ("shared by files", self.shared), ("duplicates", self.duplicates),
                ("synthetic", self.synthetic), ("flag of overlap", self.flagged),
            )
        ]  # fmt: skip
        if self.flagged_area:
            words.append(f"{self.flagged_area:,.0f} m2 have only points with this flag")
        return ", ".join(words)

    def text(self) -> list[str]:
        """Return the figures and the comparison as lines of text."""
        lines = [f"{title:<13} {value}" for title, value in self.rows()]
        for each in self.lines:
            lines.append(f"{each.state:<5} {each.name}: {each.found}; asked: {each.asked}")
        return lines


def _number(value: float | None, unit: str) -> str:
    return "not measured" if value is None else f"{value:.2f}{unit}"


def _share(value: float | None) -> str:
    return "not measured" if value is None else f"{100 * value:.2f} %"


def _metres(value: float | None) -> str:
    return "not measured" if value is None else f"{value:.3f} m"


class Extent(NamedTuple):
    """Where the survey lies, in its coarse cells; boolean."""

    inside: np.ndarray  # all cells of the survey, with gaps that it encloses
    inner: np.ndarray  # those for figures: without squares of 10 m along the edge, partly filled
    dry: np.ndarray  # those of `inner` in squares of 10 m without points of water
    # those of `inner` without squares in which all first returns have the flag of overlap. Where
    # this flag marks all points of an overlap, not only those of one strip, nothing would be left
    # to count.
    pulses: np.ndarray

    @classmethod
    def of(cls, cells: QualityCells) -> Extent:
        """Return where the survey lies."""
        from scipy import ndimage

        side = max(round(_SQUARE / (2 * cells.sizes.cell)), 1)
        some = _any(cells.highest > -np.inf, side)
        wet, flagged, pulses = (_any(cells.marks & bit > 0, side) for bit in (WET, FLAGGED, PULSE))
        inside = ndimage.binary_fill_holes(some)
        inner = ndimage.binary_erosion(inside, np.ones((3, 3)))
        if not inner.any():
            inner = inside
        shape = cells.sizes.coarse.shape
        kinds = (inside, inner, inner & ~wet, inner & ~(flagged & ~pulses))
        return cls(*(_spread(each, side, shape) for each in kinds))


def _any(values: np.ndarray, side: int) -> np.ndarray:
    """Return whether any value in squares of cells is true."""
    rows, columns = values.shape
    padded = np.pad(values, ((0, -rows % side), (0, -columns % side)))
    height, width = padded.shape
    squares = padded.reshape(height // side, side, width // side, side)
    return np.logical_or.reduce(squares, axis=(1, 3))


def _spread(squares: np.ndarray, side: int, shape: tuple[int, int]) -> np.ndarray:
    """Return values of squares for each of their cells."""
    return squares.repeat(side, axis=0).repeat(side, axis=1)[: shape[0], : shape[1]]


def figures_of(
    cells: QualityCells, extent: Extent, asked: Specification, void: float
) -> dict[str, Any]:
    """Return figures of cells, by names of `Quality`; ground is missing from `void` metres on."""
    side = 2 * cells.sizes.cell
    sums, far, dry, dense = np.zeros(3), 0.0, 0, 0
    names = {"first": extent.pulses, "points": extent.pulses, "ground_points": extent.inner}
    for rows in rows_of(cells.sizes.fine):
        there = slice(rows.start // 2, rows.stop // 2)
        if not extent.inner[there].any():
            continue
        sums += [
            getattr(cells, name)[rows][twice(where, rows)].sum(dtype=np.float64)
            for name, where in names.items()
        ]
        on_land = twice(extent.dry, rows)
        voids = QUALITY_RASTERS["voids"].make(cells, rows, extent.inside, void)
        far, dry = far + float(voids[on_land].sum()), dry + int(np.count_nonzero(on_land))
        pulses = cells.first[rows].astype(np.int64)
        four = pulses.reshape(len(pulses) // 2, 2, -1, 2).sum(axis=(1, 3))
        enough = four[extent.pulses[there]] >= (asked.pulses or 0) * side**2
        dense += int(np.count_nonzero(enough))
    inner, counted_cells = (int(np.count_nonzero(each)) for each in (extent.inner, extent.pulses))
    found: dict[str, Any] = {
        "area": inner * side**2, "flagged_area": (inner - counted_cells) * side**2,
        "ground_void_share": far / dry if dry else None,
    }  # fmt: skip
    if inner:
        found["ground_density"] = float(sums[2]) / found["area"]
    if counted_cells:
        densities = (sums[:2] / (counted_cells * side**2)).tolist()
        found["pulse_density"], found["point_density"] = densities
        found["dense_share"] = dense / counted_cells if asked.pulses else None
    return {**found, **_filled(cells, extent, asked), **_strips(cells, extent)}


def _filled(cells: QualityCells, extent: Extent, asked: Specification) -> dict[str, Any]:
    """Return where first returns are missing, outside water."""
    if asked.spacing is None:
        return {}
    window, coarse, size = cells.sizes.filled, cells.sizes.coarse, cells.sizes.spacing
    x, y = window.centres(size)
    row, column = cells_at(x, y, 2 * cells.sizes.cell)
    column = np.clip(column - coarse.column, 0, coarse.columns - 1)
    row = np.clip(row - coarse.row, 0, coarse.rows - 1)
    land, every, holding, voids = extent.dry & extent.pulses, 0, 0, 0
    for rows in rows_of(window):
        # With one row more, for the squares of two rows.
        own = slice(0, rows.stop - rows.start)
        rows = slice(rows.start, min(rows.stop + 1, window.rows))
        values = cells.filled[rows]
        there = land[np.ix_(row[rows], column)] & (values & WET == 0)
        missing = there & (values & PULSE == 0)
        squares = missing[:-1, :-1] & missing[1:, :-1] & missing[:-1, 1:] & missing[1:, 1:]
        voids += int(np.count_nonzero(squares))
        every += int(np.count_nonzero(there[own]))
        holding += int(np.count_nonzero(there[own] & ~missing[own]))
    if not every:
        return {}
    return {"filled_share": holding / every, "void_count": voids}


def _strips(cells: QualityCells, extent: Extent) -> dict[str, Any]:
    """Return how strips overlap and differ."""
    several, total, squares, compared, largest = 0, 0, 0.0, 0, 0.0
    kinds = np.zeros(3, dtype=np.int64)
    for rows in rows_of(cells.sizes.coarse):
        number = overlap(cells, rows, extent.inner, 0.0)
        several += int(np.count_nonzero(number > 1))
        total += int(np.count_nonzero(~np.isnan(number)))
        every = differences(cells, rows, extent.inner, 0.0)
        known = every[~np.isnan(every) & extent.inner[rows]]
        kinds += np.bincount(np.searchsorted(LIMITS, known, side="right"), minlength=3)
        open_land = extent.inner[rows] & (cells.marks[rows] & (ROUGH | WET) == 0)
        even = strip_differences(cells, rows, _STEEPEST)[open_land]
        even = even[~np.isnan(even)]
        squares, compared = squares + float((even**2).sum()), compared + len(even)
        largest = max(largest, float(even.max(initial=0.0)))
    found: dict[str, Any] = {
        "overlap_share": several / total if total else None, "overlapping": several,
        "compared": compared,
    }  # fmt: skip
    if kinds.any():
        found["strip_shares"] = (kinds / kinds.sum()).tolist()
    if compared:
        found.update(strip_rms=math.sqrt(squares / compared), strip_largest=largest)
    return found


def totals_of(counts: Counts) -> dict[str, Any]:
    """Return the counts of points, by the names of `Quality`."""
    return {
        "points": counts.points,
        "withheld": counts.withheld,
        "shared": counts.shared,
        "duplicates": counts.duplicates,
        "synthetic": counts.synthetic,
        "flagged": counts.flagged,
        "classes": by_class(counts.classes),
        "returns": by_class(counts.returns),
        "strips": sorted(counts.strips),
    }


def lines_of(found: Quality, survey: Survey, asked: Specification) -> list[Line]:
    """Return the comparison of a survey with a specification."""
    lines: list[Line] = []

    def add(key: str, name: str, value: str, wanted: str, state: str | bool) -> None:
        if not isinstance(state, str):
            state = PASS if state else FAIL
        place = asked.places.get(key)
        lines.append(Line(name, value, wanted, state, f"{asked.source}: {place}" * bool(place)))

    def judged(value: float | None, is_enough: bool) -> str | bool:
        """Return what could not be measured as something to look at."""
        return LOOK if value is None else is_enough

    for key, density, least, what in (
        ("pulses", found.pulse_density, asked.pulses, "first returns/m2"),
        ("points", found.point_density, asked.points, "points/m2"),
    ):
        if least is not None:
            state = judged(density, (density or 0.0) >= least)
            add(key, "Density", _number(density, f" {what}"), f"at least {least:g}", state)
    if asked.filled is not None:
        share, least = found.filled_share, asked.filled
        wanted = f"at least {100 * least:g} % of cells of {2 * (asked.spacing or 0):g} m"
        state = judged(share, (share or 0.0) >= least)
        add("filled", "Cells with a first return", _share(share), wanted, state)
    if asked.spacing is not None:
        wanted = f"none of {4 * asked.spacing:g} x {4 * asked.spacing:g} m, outside water"
        count = found.void_count
        squares = "not measured" if count is None else counted(count, "square")
        state = PASS if found.void_count == 0 else LOOK
        add("voids", "Voids of first returns", squares, wanted, state)
    if asked.strips is not None:
        rms, wanted = found.strip_rms, f"RMSDz at most {asked.strips:g} m, on even, open land"
        value = _metres(rms)
        if rms is not None:
            value += f" in {found.compared:,} of {counted(found.overlapping, 'cell')}"
        enough = PASS if found.compared >= _FEWEST_CELLS else LOOK
        state = judged(rms, False) if rms is None or rms > asked.strips else enough
        add("strips", "Differences between strips", value, wanted, state)
    _add_classes(add, found, asked)
    if asked.is_modern:
        count = len(found.files)
        modern = sum(each["version"] >= "1.4" and each["format"] >= 6 for each in found.files)
        for key, name, number, wanted in (
            ("format", "Files", modern, "LAS 1.4, point format 6 or higher"),
            ("crs", "CRS", sum(each["wkt"] for each in found.files), "stated as WKT"),
        ):
            words = f"so in {number:,} of {counted(count, 'file')}"
            add(key, name, words, wanted, number == count)
    return lines


def _add_classes(add: Any, found: Quality, asked: Specification) -> None:
    """Add the comparison of classes."""
    for each in asked.refused:
        value = counted(found.classes.get(each, 0), "point")
        add("classes", named_class(each).capitalize(), value, "none", each not in found.classes)
    if asked.classes is not None:
        others = [each for each in found.classes if each not in asked.classes]
        others = [each for each in others if each not in asked.refused]
        value = ", ".join(map(named_class, others)) or "none"
        add("classes", "Classes that are not listed", value, "none", not others)
    for each in asked.needed:
        count = found.classes.get(each, 0)
        # Land without buildings has no class of buildings: a person must decide.
        state: str | bool = count > 0 if each == _GROUND or count else LOOK
        name = named_class(each).capitalize()
        add("classes", name, counted(count, "point"), "used", state)
