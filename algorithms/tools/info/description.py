"""What `bare-earth info` says of a file, and of many."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from ...core.errors import printable
from ...core.words import counted, first_of
from ...crs.measurable import wrong_lengths
from ...crs.system import unit_name
from .checks import CHECKS
from .times import GpsTimes


@dataclass(frozen=True)
class Description:
    """The description of a file, for `bare-earth info`."""

    path: str
    file_size: int
    version: str
    encoding: str
    point_format: int
    point_count: int
    minimum: tuple[float, float, float] | None  # in units of the CRS; None without points
    maximum: tuple[float, float, float] | None  # in units of the CRS; None without points
    scale: tuple[float, float, float]
    offset: tuple[float, float, float]
    density: float | None  # points per square metre of the extent; None if it cannot be measured
    crs: str
    epsg: int | None
    is_geographic: bool
    horizontal_unit: float
    vertical_unit: float
    length_scale: float  # metres of the CRS in a true metre; not 1 for Mercator projections
    classes: dict[int, int]  # number of points by class
    returns: dict[int, int]  # number of points by return number
    withheld: int
    flags: dict[str, int]  # number of points by the other flags of the point format
    strips: dict[int, int]  # number of points by point source id
    gps_time: GpsTimes | None  # None if no point has one
    all_zero: list[str]  # attributes that are 0 everywhere
    checks: dict[str, int | None]  # what each check counts; None if it cannot be checked
    extra_dimensions: list[str]
    records: list[str]  # user id, number and description of each VLR and EVLR
    system_identifier: str
    software: str

    def as_dict(self) -> dict[str, Any]:
        """Return the description as plain values."""
        return asdict(self)

    def lines(self) -> list[str]:
        """Return the description as lines of text for a terminal or a log."""
        code = f" (EPSG:{self.epsg})" if self.epsg else ""
        strips = [f"{number} ({count:,})" for number, count in self.strips.items()]
        rows = {
            "file": f"{self.path} ({self.file_size:,} bytes)",
            "format": self.format,
            "points": f"{self.point_count:,}",
            "density": "unknown" if self.density is None else f"{self.density:.2f} points/m2",
            "minimum": _coordinates(self.minimum),
            "maximum": _coordinates(self.maximum),
            "scale": _coordinates(self.scale),
            "offset": _coordinates(self.offset),
            "CRS": f"{self.crs or 'not stated'}{code}",
            "units": self._units,
            "classes": _counts(self.classes),
            "returns": _counts(self.returns),
            "withheld": f"{self.withheld:,}",
            "flags": _counts(self.flags),
            "strips": f"{len(strips):,}: {first_of(strips)}" if strips else "none",
            "GPS time": "none" if self.gps_time is None else self.gps_time.line,
            "all zero": ", ".join(self.all_zero) or "none",
            "extra dims": ", ".join(self.extra_dimensions) or "none",
            "system": self.system_identifier,
            "software": self.software,
        }
        lines = [f"{title:<10} {text}".rstrip() for title, text in rows.items()]
        lines += [f"{'record':<10} {record}" for record in self.records]
        return list(map(printable, [*lines, *self.check_lines()]))

    @property
    def format(self) -> str:
        """Version, encoding and point format in words."""
        return f"LAS {self.version}, {self.encoding}, point format {self.point_format}"

    @property
    def failed(self) -> dict[str, int]:
        """What the checks count that are not passed, by their names."""
        return {name: count for name, count in self.checks.items() if count}

    def check_lines(self) -> list[str]:
        """Return how many checks are passed, and what the others count."""
        done = [name for name, count in self.checks.items() if count is not None]
        passed = f"{len(done) - len(self.failed)} of {len(done)} passed"
        return [f"{'checks':<10} {passed}", *_failed("failed", self.failed)]

    @property
    def _units(self) -> str:
        if self.is_geographic:
            units = "degree or geocentric: reproject before classifying"
        else:
            units = f"{unit_name(self.horizontal_unit)}, height {unit_name(self.vertical_unit)}"
        wrong = wrong_lengths(self.length_scale)
        return f"{units}; {wrong}: reproject before classifying" if wrong else units


@dataclass(frozen=True)
class SurveyDescription:
    """The descriptions of many files, and what differs between them."""

    files: tuple[Description, ...]
    unreadable: dict[str, str]  # reasons by path
    point_count: int
    checks: dict[str, int]  # the sums over all files
    differences: dict[str, list[str]]  # values that are not the same in all files, by name
    overlapping: int  # pairs of files whose boxes overlap

    def as_dict(self) -> dict[str, Any]:
        """Return the descriptions as plain values."""
        return asdict(self)

    def lines(self) -> list[str]:
        """Return a few lines on each file, and on the survey."""
        lines = []
        for file in self.files:
            lines.append(f"{file.path}: {counted(file.point_count, 'point')}, {file.format}")
            lines += file.check_lines()
        lines += [f"{path}: {reason}" for path, reason in self.unreadable.items()]
        lines.append(f"{counted(len(self.files), 'file')}, {counted(self.point_count, 'point')}")
        for name, values in self.differences.items():
            lines.append(f"{'differ':<10} {name}: {first_of(values)}")
        pairs = counted(self.overlapping, "pair")
        lines.append(f"{'overlap':<10} {pairs} of files whose boxes overlap")
        lines += _failed("in all", {name: count for name, count in self.checks.items() if count})
        return list(map(printable, lines))


def _failed(title: str, counts: dict[str, int]) -> list[str]:
    return [f"{title:<10} {name}: {count:,} ({CHECKS[name]})" for name, count in counts.items()]


def _counts(counts: dict[Any, int]) -> str:
    return ", ".join(f"{value}: {count:,}" for value, count in counts.items())


def _coordinates(values: tuple[float, ...] | None) -> str:
    return "none" if values is None else "  ".join(f"{value:.10g}" for value in values)
