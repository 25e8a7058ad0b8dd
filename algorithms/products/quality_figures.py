"""Figures about the quality of a survey, and whether they meet a specification."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass, field
from typing import Any, NamedTuple, Sequence

import numpy as np

from ..las.class_names import named_class
from ..survey.files import Survey
from ..survey.point_counts import by_class
from .quality_cells import FIRST, WET, Counts, QualityCells
from .quality_rasters import QUALITY_RASTERS, differences, overlap, rows_of, twice
from .specifications import Specification

PASS, FAIL, LOOK = "pass", "fail", "look"
# Limits of the classes of differences between strips, in metres.
LIMITS = (0.08, 0.16)
# Side in metres of the squares by which the area of the survey is told.
_SQUARE = 10.0
_GROUND = 2


class Line(NamedTuple):
    """A line of the comparison with a specification.

    Attributes
    ----------
    name, found, asked : str
        What is compared, what was found, and what is asked for.
    state : str
        `PASS`, `FAIL` or `LOOK` (a person must decide).
    source : str
        Where the specification says it.
    """

    name: str
    found: str
    asked: str
    state: str
    source: str


@dataclass(frozen=True)
class Quality:
    """The figures of a survey; withheld points are left out, and noise is left out of densities.

    Attributes
    ----------
    specification : str
        Name of the specification.
    points, withheld : int
        All points, and those that the producer excluded.
    classes, returns : dict of int to int
        Number of points of each class, and of each return number.
    strips : list of int
        Point source ids.
    area : float
        Area in m2 to which the figures refer.
    pulse_density, point_density, ground_density : float or None
        First returns, all returns and ground points in 1/m2; None without such an area.
    dense_share : float or None
        Share of cells of twice the cell size that reach the demanded density.
    filled_share : float or None
        Share of cells of twice the pulse spacing that hold a first return.
    void_count : int or None
        Squares of four times the pulse spacing without first returns, outside water. They overlap.
    ground_void_share : float or None
        Share of cells that are farther from the ground than the given distance.
    overlap_share : float or None
        Share of cells of twice the cell size in which several strips lie.
    compared : int
        Cells on even, open land in which strips are compared.
    strip_rms, strip_largest : float or None
        Root mean square and largest difference between strips there, in metres.
    strip_shares : list of float, or None
        Shares of all cells with several strips whose difference is below 8, below 16, and over
        16 cm.
    files : list of dict
        Name, points, version, point format, CRS and extent of each file.
    lines : list of Line
        The comparison with the specification.
    """

    specification: str
    points: int
    withheld: int
    classes: dict[int, int]
    returns: dict[int, int]
    strips: list[int]
    area: float
    pulse_density: float | None = None
    point_density: float | None = None
    ground_density: float | None = None
    dense_share: float | None = None
    filled_share: float | None = None
    void_count: int | None = None
    ground_void_share: float | None = None
    overlap_share: float | None = None
    compared: int = 0
    strip_rms: float | None = None
    strip_largest: float | None = None
    strip_shares: list[float] | None = None
    files: list[dict[str, Any]] = field(default_factory=list)
    lines: list[Line] = field(default_factory=list)

    @property
    def passes(self) -> bool:
        """Whether no line fails."""
        return all(each.state != FAIL for each in self.lines)

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
            ("classes", ", ".join(f"{name}: {count:,}" for name, count in self.classes.items())),
            ("returns", ", ".join(f"{name}: {count:,}" for name, count in self.returns.items())),
            ("strips", f"{len(self.strips):,}"),
            ("area", f"{self.area:,.0f} m2"),
            ("pulses", _number(self.pulse_density, " first returns/m2")),
            ("density", _number(self.point_density, " points/m2")),
            ("ground", _number(self.ground_density, " ground points/m2")),
            ("dense cells", _share(self.dense_share)),
            ("filled cells", _share(self.filled_share)),
            ("void squares", "none" if self.void_count is None else f"{self.void_count:,}"),
            ("ground voids", _share(self.ground_void_share)),
            ("overlap", _share(self.overlap_share)),
            ("strips RMSDz", _metres(self.strip_rms)),
            ("largest", _metres(self.strip_largest)),
            ("below 8 cm", _share(shares[0])),
            ("8 to 16 cm", _share(shares[1])),
            ("over 16 cm", _share(shares[2])),
        ]

    def text(self) -> list[str]:
        """Return the figures and the comparison as lines of text."""
        lines = [f"{title:<13} {value}" for title, value in self.rows()]
        for each in self.lines:
            lines.append(f"{each.state:<5} {each.name}: {each.found}; asked: {each.asked}")
        return lines


def _number(value: float | None, unit: str) -> str:
    return "none" if value is None else f"{value:.2f}{unit}"


def _share(value: float | None) -> str:
    return "none" if value is None else f"{100 * value:.2f} %"


def _metres(value: float | None) -> str:
    return "none" if value is None else f"{value:.3f} m"


class Extent(NamedTuple):
    """Where the survey lies, in its coarse cells.

    Attributes
    ----------
    inside : numpy.ndarray of bool
        All cells of the survey, with gaps that it encloses.
    inner : numpy.ndarray of bool
        Those of which figures are made: without the squares of 10 m along the edge, which points
        fill in part only.
    dry : numpy.ndarray of bool
        Those of `inner` in squares of 10 m without points of water.
    """

    inside: np.ndarray
    inner: np.ndarray
    dry: np.ndarray

    @classmethod
    def of(cls, cells: QualityCells) -> Extent:
        """Return where the survey lies."""
        from scipy import ndimage

        side = max(round(_SQUARE / (2 * cells.sizes.cell)), 1)
        held, wet = (_any(each, side) for each in (cells.highest > -np.inf, cells.wet > 0))
        inside = ndimage.binary_fill_holes(held)
        inner = ndimage.binary_erosion(inside, np.ones((3, 3)))
        if not inner.any():
            inner = inside
        shape = cells.sizes.coarse.shape
        return cls(*(_spread(each, side, shape) for each in (inside, inner, inner & ~wet)))


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
    """Return the figures of cells, by the names of `Quality`.

    Parameters
    ----------
    cells : QualityCells
        The counted cells.
    extent : Extent
        Where the survey lies.
    asked : Specification
        The spacing and density that it asks for.
    void : float
        Distance in metres from which on ground is missing.
    """
    inner, side = extent.inner, 2 * cells.sizes.cell
    area = float(np.count_nonzero(inner)) * side**2
    sums, far, dry, dense = np.zeros(3), 0.0, 0, 0
    names = ("first", "points", "ground_points")
    for rows in rows_of(cells.sizes.fine):
        within, on_land = twice(inner, rows), twice(extent.dry, rows)
        sums += [getattr(cells, name)[rows][within].sum(dtype=np.float64) for name in names]
        voids = QUALITY_RASTERS["voids"].make(cells, rows, extent.inside, void)
        far, dry = far + float(voids[on_land].sum()), dry + int(np.count_nonzero(on_land))
        pulses = cells.first[rows].astype(np.int64)
        four = pulses.reshape(len(pulses) // 2, 2, -1, 2).sum(axis=(1, 3))
        there = inner[rows.start // 2 : rows.stop // 2]
        dense += int(np.count_nonzero(four[there] >= (asked.pulses or 0) * side**2))
    every = int(np.count_nonzero(inner))
    found: dict[str, Any] = {"area": area, "ground_void_share": far / dry if dry else None}
    if area:
        density = ("pulse_density", "point_density", "ground_density")
        found.update(zip(density, (sums / area).tolist()))
        found["dense_share"] = dense / every if asked.pulses else None
    return {**found, **_filled(cells, extent, asked), **_strips(cells, extent)}


def _filled(cells: QualityCells, extent: Extent, asked: Specification) -> dict[str, Any]:
    """Return where first returns are missing, outside water."""
    if asked.spacing is None:
        return {}
    window, coarse, size = cells.sizes.filled, cells.sizes.coarse, cells.sizes.spacing
    x, y = window.centres(size)
    column = np.floor(x / (2 * cells.sizes.cell)).astype(np.int64) - coarse.column
    row = np.floor(y / (2 * cells.sizes.cell)).astype(np.int64) - coarse.row
    column, row = np.clip(column, 0, coarse.columns - 1), np.clip(row, 0, coarse.rows - 1)
    every = holding = voids = 0
    for rows in rows_of(window):
        # With one row more, for the squares of two rows.
        own = slice(0, rows.stop - rows.start)
        rows = slice(rows.start, min(rows.stop + 1, window.rows))
        values = cells.filled[rows]
        there = extent.dry[np.ix_(row[rows], column)] & (values & WET == 0)
        missing = there & (values & FIRST == 0)
        squares = missing[:-1, :-1] & missing[1:, :-1] & missing[:-1, 1:] & missing[1:, 1:]
        voids += int(np.count_nonzero(squares))
        every += int(np.count_nonzero(there[own]))
        holding += int(np.count_nonzero(there[own] & ~missing[own]))
    return {"filled_share": holding / every if every else None, "void_count": voids}


def _strips(cells: QualityCells, extent: Extent) -> dict[str, Any]:
    """Return how strips overlap and differ."""
    several, total, squares, compared, largest = 0, 0, 0.0, 0, 0.0
    kinds = np.zeros(3, dtype=np.int64)
    for rows in rows_of(cells.sizes.coarse):
        number = overlap(cells, rows, extent.inner, 0.0)
        several += int(np.count_nonzero(number > 1))
        total += int(np.count_nonzero(~np.isnan(number)))
        every = differences(cells, rows, extent.inner, 0.0)
        known = every[~np.isnan(every)]
        kinds += np.bincount(np.searchsorted(LIMITS, known, side="right"), minlength=3)
        even = every[~np.isnan(every) & (cells.rough[rows] == 0)]
        squares, compared = squares + float((even**2).sum()), compared + len(even)
        largest = max(largest, float(even.max(initial=0.0)))
    found: dict[str, Any] = {
        "overlap_share": several / total if total else None, "compared": compared,
    }  # fmt: skip
    if kinds.any():
        found["strip_shares"] = (kinds / kinds.sum()).tolist()
    if compared:
        found.update(strip_rms=math.sqrt(squares / compared), strip_largest=largest)
    return found


def counted(counts: Counts) -> dict[str, Any]:
    """Return the counts of points, by the names of `Quality`."""
    return {
        "points": counts.points,
        "withheld": counts.withheld,
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

    for key, value, least, what in (
        ("pulses", found.pulse_density, asked.pulses, "first returns/m2"),
        ("points", found.point_density, asked.points, "points/m2"),
    ):
        if least is not None:
            enough = value is not None and value >= least
            add(key, "Density", _number(value, f" {what}"), f"at least {least:g}", enough)
    if asked.filled is not None:
        share, least = found.filled_share, asked.filled
        wanted = f"at least {100 * least:g} % of cells of {2 * (asked.spacing or 0):g} m"
        enough = share is not None and share >= least
        add("filled", "Cells with a first return", _share(share), wanted, enough)
    if asked.spacing is not None and found.void_count is not None:
        wanted = f"none of {4 * asked.spacing:g} x {4 * asked.spacing:g} m, outside water"
        state = PASS if found.void_count == 0 else LOOK
        add("voids", "Voids of first returns", f"{found.void_count:,} squares", wanted, state)
    if asked.strips is not None:
        state = LOOK if found.strip_rms is None else PASS
        if found.strip_rms is not None and found.strip_rms > asked.strips:
            state = FAIL
        wanted = f"RMSDz at most {asked.strips:g} m, on even, open land"
        add("strips", "Differences between strips", _metres(found.strip_rms), wanted, state)
    _add_classes(add, found, asked)
    if asked.is_modern:
        old = [each for each in found.files if each["version"] < "1.4" or each["format"] < 6]
        words = f"{len(old):,} of {len(found.files):,} files are older"
        add("format", "Files", words, "LAS 1.4, point format 6 or higher", not old)
        vague = [each for each in found.files if not each["wkt"]]
        words = f"{len(vague):,} of {len(found.files):,} files do not state it so"
        add("crs", "CRS", words, "stated as WKT", not vague)
    return lines


def _add_classes(add: Any, found: Quality, asked: Specification) -> None:
    """Add the comparison of classes."""
    for each in asked.refused:
        value = f"{found.classes.get(each, 0):,} points"
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
        add("classes", name, f"{count:,} points", "used", state)
