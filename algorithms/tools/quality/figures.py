"""Figures about the quality of a survey, and whether they meet a specification."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field
from typing import Any, Callable, Iterator, Mapping, NamedTuple

from ...core.words import counted
from ...las.class_names import named_class
from .specifications import Specification

PASSED = "pass"
FAILED = "fail"
LOOK = "look"
_GROUND = 2
# Fewest cells with which differences between strips pass.
_FEWEST_CELLS = 30


class ComparisonLine(NamedTuple):
    """A line of the comparison with a specification."""

    name: str  # what is compared
    found: str
    asked: str  # what is asked for
    state: str  # `PASSED`, `FAILED` or `LOOK` (a person must decide)
    source: str  # where the specification says it


@dataclass(frozen=True)
class Quality:
    """The figures of a survey, without withheld points, and densities also without noise."""

    specification: str
    points: int  # also withheld ones
    withheld: int  # excluded by the producer
    shared: int  # points that another file contains as well
    duplicates: int  # points that repeat one of their file
    synthetic: int  # points that were not measured, by their flag
    infilled: int  # other points that were not measured, infilled or virtual
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
    # ground points in 1/m2, below which confidence is low; the areas, and their share of the land
    low_confidence_density: float | None = None
    low_confidence_least_area: float | None = None  # m2
    low_confidence_count: int = 0
    low_confidence_share: float | None = None
    # areas where few pulses have several returns, such as roofs without class 6 and crops
    low_confidence_without_plants: int = 0
    overlap_share: float | None = None  # of cells of twice the size, with several strips
    overlapping: int = 0  # these cells
    compared: int = 0  # those on even, open land, in which strips are compared
    strip_rms: float | None = None  # of differences between strips there, in metres
    strip_largest: float | None = None  # in metres
    # of cells with several strips: below 8, below 16, over 16 cm
    strip_shares: list[float] | None = None
    # name, points, version, format, CRS, extent
    files: list[dict[str, Any]] = field(default_factory=list)
    comparison: list[ComparisonLine] = field(default_factory=list)  # with the specification

    @property
    def passes(self) -> bool | None:
        """Whether all comparisons pass; None if none fails, but some could not be decided."""
        if any(line.state == FAILED for line in self.comparison):
            return False
        return None if self.left else True

    @property
    def meets_specification(self) -> bool | None:
        """Whether all comparisons pass; None also if there is no specification to compare with."""
        return self.passes if self.comparison else None

    @property
    def verdict(self) -> str:
        """How many comparisons pass, and which do not; empty without a specification."""
        if not self.comparison:
            return ""
        passed = f"{len(self.comparison) - len(self.left)} of {len(self.comparison)} pass"
        names = ", ".join(f"{line.name} ({line.state})" for line in self.left)
        return f"{passed}; not: {names}" if names else passed

    @property
    def left(self) -> list[ComparisonLine]:
        """The comparisons that fail, and the ones that a person must look at."""
        return [line for line in self.comparison if line.state != PASSED]

    @property
    def strip_count(self) -> int:
        """The number of flight strips."""
        return len(self.strips)

    @property
    def no_pulses(self) -> str:
        """The points and the area that densities leave out, besides withheld points and noise."""
        counts = {
            "shared by files": self.shared, "duplicates": self.duplicates,
            "synthetic": self.synthetic, "infilled": self.infilled,
            "flag of overlap": self.flagged,
        }  # fmt: skip
        area = f", {self.flagged_area:,.0f} m2 have only points with this flag"
        return _counts(counts) + area * bool(self.flagged_area)

    @property
    def low_confidence_areas(self) -> str | None:
        """The low confidence areas; None if they were not measured."""
        if self.low_confidence_density is None or self.low_confidence_share is None:
            return None
        areas = counted(self.low_confidence_count, "area")
        single = self.low_confidence_without_plants
        roofs = f"; {counted(single, 'area')} with single returns, as roofs have" * (single > 0)
        return (
            f"{areas} of {self.low_confidence_least_area:,.0f} m2 and more,"
            f" {_share(self.low_confidence_share)} of the land, with fewer than"
            f" {_ground(self.low_confidence_density)}{roofs}"
        )

    @property
    def compared_cells(self) -> str:
        """The number of cells in which strips are compared, of those with several strips."""
        return f"{self.compared:,} of {counted(self.overlapping, 'cell')}"

    def as_dict(self) -> dict[str, object]:
        """Return the figures as plain values."""
        plain = asdict(self)
        del plain["comparison"]
        lines = [line._asdict() for line in self.comparison]
        return {**plain, "lines": lines, "passes": self.passes}

    def lines(self) -> list[str]:
        """Return the figures and the comparison as lines of text."""
        lines = [f"{figure.name:<13} {figure.text(self)}" for figure in FIGURES]
        for line in self.comparison:
            lines.append(f"{line.state:<5} {line.name}: {line.found}; asked: {line.asked}")
        return lines


# Values as text.
_metres = "{:.3f} m".format
_points = "{:.2f} points/m2".format
_pulses = "{:.2f} first returns/m2".format
_ground = "{:.2f} ground points/m2".format


def _share(value: float) -> str:
    return f"{100 * value:.2f} %"


def _counts(values: Mapping[int, int] | Mapping[str, int]) -> str:
    return ", ".join(f"{name}: {count:,}" for name, count in values.items())


def _shown(value: Any, form: Callable[[Any], str]) -> str:
    return "not measured" if value is None else form(value)


class Figure(NamedTuple):
    """A figure as users see it."""

    name: str  # in the terminal
    title: str  # on the page
    attribute: str  # of `Quality`; None if it was not measured
    form: Callable[[Any], str] = "{:,}".format  # returns the value as text

    def text(self, quality: Quality) -> str:
        """Return the figure of a survey."""
        return _shown(getattr(quality, self.attribute), self.form)


FIGURES = (
    Figure("points", "Points", "points"),
    Figure("withheld", "Withheld points", "withheld"),
    Figure("no pulses", "Points that do not count as pulses", "no_pulses", str),
    Figure("classes", "Classes", "classes", _counts),
    Figure("returns", "Returns", "returns", _counts),
    Figure("strips", "Flight strips (point source ids)", "strip_count"),
    Figure("area", "Area of the figures below", "area", "{:,.0f} m2".format),
    Figure("pulses", "Density of first returns", "pulse_density", _pulses),
    Figure("density", "Density of all returns", "point_density", _points),
    Figure("ground", "Density of ground points", "ground_density", _ground),
    Figure("dense cells", "Cells that reach the demanded density", "dense_share", _share),
    Figure(
        "filled cells", "Cells of twice the pulse spacing that hold a first return",
        "filled_share", _share,
    ),
    Figure(
        "void squares",
        "Squares of four times the pulse spacing without a first return, outside water",
        "void_count",
    ),
    Figure(
        "ground voids", "Cells that are far from a ground point, outside water",
        "ground_void_share", _share,
    ),
    Figure(
        "low conf.",
        "Low confidence areas: fewer ground points than a quarter of the pulses, outside water and"
        " buildings",
        "low_confidence_areas", str,
    ),
    Figure("overlap", "Cells with several strips", "overlap_share", _share),
    Figure(
        "compared",
        "Cells on even, open land whose strips are compared, of those with several strips",
        "compared_cells", str,
    ),
    Figure(
        "strips RMSDz", "Differences between strips, RMSDz on even, open land", "strip_rms",
        _metres,
    ),
    Figure("largest", "Largest difference there", "strip_largest", _metres),
    Figure(
        "below 8 cm", "Cells of all land whose strips differ by less than 8 cm", "strip_shares",
        lambda shares: _share(shares[0]),
    ),
    Figure("8 to 16 cm", "By 8 to 16 cm", "strip_shares", lambda shares: _share(shares[1])),
    Figure("over 16 cm", "By more than 16 cm", "strip_shares", lambda shares: _share(shares[2])),
)  # fmt: skip


def lines_of(found: Quality, asked: Specification) -> list[ComparisonLine]:
    """Return the comparison of a survey with a specification."""
    lines = []
    for compare in (_densities, _strips, _classes, _formats):
        for key, name, value, wanted, passes in compare(found, asked):
            state = {True: PASSED, False: FAILED, None: LOOK}[passes]
            place = asked.places.get(key)
            source = f"{asked.source}: {place}" if place else ""
            lines.append(ComparisonLine(name, value, wanted, state, source))
    return lines


# For each comparison: the key of its section in the specification, its name, the value, the wanted
# value, and whether it passes, None if a person must decide.
_Comparisons = Iterator["tuple[str, str, str, str, bool | None]"]


def _at_least(value: float | None, least: float) -> bool | None:
    return None if value is None else value >= least


def _densities(found: Quality, asked: Specification) -> _Comparisons:
    for key, density, least, form in (
        ("pulses", found.pulse_density, asked.pulses, _pulses),
        ("points", found.point_density, asked.points, _points),
    ):
        if least is not None:
            wanted, passes = f"at least {least:g}", _at_least(density, least)
            yield key, "Density", _shown(density, form), wanted, passes
    if asked.spacing is not None and asked.filled is not None:
        share, least = found.filled_share, asked.filled
        wanted = f"at least {100 * least:g} % of cells of {2 * asked.spacing:g} m"
        name = "Cells with a first return"
        yield "filled", name, _shown(share, _share), wanted, _at_least(share, least)
    if asked.spacing is not None:
        side, count = 4 * asked.spacing, found.void_count
        squares = _shown(count, lambda count: counted(count, "square"))
        wanted = f"none of {side:g} x {side:g} m, outside water"
        yield "voids", "Voids of first returns", squares, wanted, count == 0 or None


def _strips(found: Quality, asked: Specification) -> _Comparisons:
    if asked.strips is None:
        return
    rms, passes, value = found.strip_rms, None, _shown(found.strip_rms, _metres)
    if rms is not None:
        value += f" in {found.compared_cells}"
        enough = found.compared >= _FEWEST_CELLS or None
        passes = enough if rms <= asked.strips else False
    wanted = f"RMSDz at most {asked.strips:g} m, on even, open land"
    yield "strips", "Differences between strips", value, wanted, passes


def _classes(found: Quality, asked: Specification) -> _Comparisons:
    def row(value: int, wanted: str, passes: bool | None) -> tuple[str, str, str, str, bool | None]:
        points = counted(found.classes.get(value, 0), "point")
        return "classes", named_class(value).capitalize(), points, wanted, passes

    for value in asked.refused:
        yield row(value, "none", value not in found.classes)
    if asked.classes is not None:
        others = sorted({*found.classes} - {*asked.classes, *asked.refused})
        names = ", ".join(map(named_class, others)) or "none"
        yield "classes", "Classes that are not listed", names, "none", not others
    for value in asked.needed:
        # Land without buildings has no class of buildings: a person must decide.
        missing = False if value == _GROUND else None
        yield row(value, "used", value in found.classes or missing)


def _formats(found: Quality, asked: Specification) -> _Comparisons:
    if not asked.is_modern:
        return
    count = len(found.files)
    modern = sum(file["version"] >= "1.4" and file["format"] >= 6 for file in found.files)
    for key, name, number, wanted in (
        ("format", "Files", modern, "LAS 1.4, point format 6 or higher"),
        ("crs", "CRS", sum(file["wkt"] for file in found.files), "stated as WKT"),
    ):
        yield key, name, f"so in {number:,} of {counted(count, 'file')}", wanted, number == count
