"""What users give to tools beside declared parameters: points, files, areas, a CRS."""

from __future__ import annotations

import inspect
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from ..survey.vector_files import FORMATS
from ..tools.check.reading import FORMATS as POINT_FORMATS
from ..tools.input_groups import GROUPS

REQUIRED = inspect.Parameter.empty
_PATH = "str | PathLike[str]"
_LITERAL = "Literal[{}]"


class Kind(NamedTuple):
    """A kind of values, as editors and as documentation name it."""

    type: str
    words: str


KINDS = {
    "clouds": Kind(f"{_PATH} | Iterable[{_PATH}]", "path, address, or iterable of them"),
    "cloud": Kind(_PATH, "path or address"),
    "path": Kind(_PATH, "path"),
    "number": Kind("float", "float"),
    "raster": Kind("Any", "path, Raster or xarray.DataArray"),
    "polygons": Kind("Any", "path or polygons"),
    "lines": Kind("Any", "path or lines"),
    "points": Kind("Any", "path, points or array of shape (n, 3)"),
    "crs": Kind("Any", "str, int or pyproj.CRS"),
    "extent": Kind("Sequence[float]", "four floats"),
    "text": Kind("str", "str"),
    "words": Kind("Sequence[str]", "sequence of str"),
    "progress": Kind(
        "Progress | Bar | Callable[[float], object]",
        "Progress, bar of tqdm, or callable that takes a float",
    ),
}


@dataclass(frozen=True)
class Argument:
    """Something that a user gives to a tool beside its declared parameters."""

    name: str  # of the keyword; with hyphens, that of the option
    kind: Kind
    help: str  # without a full stop
    default: Any = None
    choices: tuple[str, ...] = ()  # of words

    @classmethod
    def of(cls, name: str, kind: str, help: str, default: Any = None) -> Argument:
        """Return an argument of one of the `KINDS`."""
        return cls(name, KINDS[kind], help, default)

    @classmethod
    def choice(cls, name: str, choices: Any, default: str, help: str) -> Argument:
        """Return an argument that is one of some words."""
        words = ", ".join(f'"{choice}"' for choice in choices)
        kind = Kind(_LITERAL.format(words), f"{{{words}}}")
        return cls(name, kind, help, default, tuple(choices))


def path(name: str, help: str, default: Any = None) -> Argument:
    """Return an argument that is a path."""
    return Argument.of(name, "path", help, default)


SOURCES = Argument.of(
    "sources",
    "clouds",
    "files, folders, virtual point clouds (.vpc), lists of files (.txt), or addresses (https, s3,"
    " gs, az) of remote point clouds; all of them together are one survey",
    REQUIRED,
)
OUTPUT = path(
    "output",
    "the file to write (.las, .laz or .copc.laz), or a folder if there are many inputs",
    REQUIRED,
)
CRS = Argument.of(
    "crs",
    "crs",
    "the CRS of the points, for files that state none or a wrong one: an EPSG code, such as"
    " EPSG:2230 or EPSG:2230+6360 (with heights), or WKT; it replaces what files state",
)
CRS_OF_OUTPUT = replace(
    CRS, help=f"{CRS.help}; written point clouds keep the records that the files have"
)
PROGRESS = Argument.of(
    "progress",
    "progress",
    "receives the share of the work that is done, 0 to 1, and may raise `Cancelled`; a `Progress`"
    " receives messages, too",
)
SCHEDULER = Argument.of(
    "scheduler",
    "text",
    "with many files: the address of a Dask scheduler, such as tcp://host:8786, whose workers do"
    " the work, or the word processes; without it, threads of this process do it",
)
# Where the points may be on the web.
REMOTE = (
    path(
        "cache",
        "the folder that keeps what is fetched of remote point clouds; without it that of"
        " BARE_EARTH_CACHE, or one of the user",
    ),
    Argument.of(
        "limit", "number", "gigabytes that may be fetched of remote point clouds; without it 2"
    ),
)
VPC = path(
    "vpc", "with many files: the virtual point cloud that lists the results, by default in OUTPUT"
)


def of_group(kind: str) -> tuple[Argument, ...]:
    """Return the arguments for an input that has several."""
    formats = {"formats": FORMATS, "point_formats": POINT_FORMATS}
    return tuple(
        Argument.of(part.name, part.kind, part.help.format(**formats))
        for part in GROUPS[kind]
        if part.help
    )


# Constraints of functions that find the water themselves where it is automatic.
WITH_AUTOMATIC_WATER = tuple(
    replace(argument, help=f"{argument.help}; the word automatic: the water is found first")
    if argument.name == "water"
    else argument
    for argument in of_group("constraints")
)


def area(what: str, more: str = "") -> tuple[Argument, Argument]:
    """Return the arguments for a rectangle and for polygons; `what` starts their help."""
    return (
        Argument.of(
            "extent",
            "extent",
            f"xmin, ymin, xmax, ymax: {what} this rectangle, in the CRS of the points{more}",
        ),
        Argument.of(
            "boundary",
            "polygons",
            f"{what} these polygons ({FORMATS}); with an extent only what lies in both",
        ),
    )
