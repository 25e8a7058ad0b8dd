"""Arguments of functions beside declared parameters: points, files, areas, a CRS."""

from __future__ import annotations

import inspect
from dataclasses import dataclass, replace
from typing import Iterable, NamedTuple

from ..survey.feature_files import FORMATS as WRITTEN_FORMATS
from ..survey.feature_files import OWN_FORMATS
from ..survey.vector_files import FORMATS
from ..tools.check.reading import FORMATS as POINT_FORMATS
from ..tools.declaration import CLOUD_OUTPUT, LIST_OUTPUT, Output, help_of_area, with_note
from ..tools.declaration import CRS as DECLARED_CRS
from ..tools.input_groups import GROUPS

MOST = 2.0  # gigabytes: default of the limit for downloads of remote point clouds
LIMIT_HELP = (
    "Gigabytes that may be downloaded of a remote point cloud. The log tells how many it takes"
    " before the download begins; more are refused."
)
REQUIRED = inspect.Parameter.empty
_PATH = "str | PathLike[str]"
_LITERAL = "Literal[{}]"
# Last sentence of the help of an output, by its kind.
_WRITTEN = {
    "raster": "Written as .tif.",
    "features": f"Written as {', '.join(WRITTEN_FORMATS)}; all but"
    f" {' and '.join(OWN_FORMATS)} need pyogrio.",
    "page": "Written as .html.",
    "table": "Written as .csv.",
    "cloud": "Written as .las, .laz or .copc.laz, or into a folder if there are many inputs.",
}


class Kind(NamedTuple):
    """A kind of values of arguments."""

    type: str  # the annotation
    words: str  # the type in the documentation
    note: str = ""  # last sentence of the help of all arguments of this kind


KINDS = {
    "clouds": Kind(
        f"{_PATH} | Iterable[{_PATH}]",
        "path, address, or iterable of them",
        "Files, folders, virtual point clouds (.vpc), lists of files (.txt), or addresses (https,"
        " s3, gs, az) of remote point clouds. All of them together are one survey.",
    ),
    "cloud": Kind(_PATH, "path or address"),
    "path": Kind(_PATH, "path"),
    "number": Kind("float", "float"),
    "raster": Kind("Any", "path, Raster or xarray.DataArray"),
    "terrain": Kind("Any", "path of a raster or of points, Raster or xarray.DataArray"),
    "polygons": Kind("Any", "path or polygons", f"Files are {FORMATS}."),
    "lines": Kind("Any", "path or lines", f"Files are {FORMATS}."),
    "points": Kind(
        "Any",
        "path, points, or array of shape (n, 3) in the CRS of the points",
        f"Files are {POINT_FORMATS}.",
    ),
    "crs": Kind(
        "Any",
        "str, int or pyproj.CRS",
        "An EPSG code, such as EPSG:2230 or EPSG:2230+6360 (with heights), or WKT.",
    ),
    "extent": Kind(
        "Sequence[float]", "four floats (xmin, ymin, xmax, ymax)", "It is in the CRS of the points."
    ),
    "text": Kind("str", "str"),
    "words": Kind("Sequence[str]", "sequence of str"),
    "progress": Kind(
        "Progress | Bar | Callable[[float], object]",
        "Progress, bar of tqdm, or callable that takes a float",
    ),
}


@dataclass(frozen=True)
class Argument:
    """An argument of a function that is no declared parameter."""

    name: str  # also of the option, where underscores become hyphens
    kind: Kind
    help: str
    default: object = None
    choices: tuple[str, ...] = ()  # the allowed words; empty for any value

    @classmethod
    def of(cls, name: str, kind: str, help: str, default: object = None) -> Argument:
        """Return an argument of one of the `KINDS`."""
        return cls(name, KINDS[kind], with_note(help, KINDS[kind].note), default)

    @classmethod
    def choice(cls, name: str, choices: Iterable[str], default: str, help: str) -> Argument:
        """Return an argument with a few allowed words."""
        words = ", ".join(f'"{choice}"' for choice in choices)
        kind = Kind(_LITERAL.format(words), f"{{{words}}}")
        return cls(name, kind, help, default, tuple(choices))


def path(name: str, help: str, default: object = None) -> Argument:
    """Return an argument that is a path."""
    return Argument.of(name, "path", help, default)


def of_output(output: Output) -> Argument:
    """Return the argument for an output."""
    help = with_note(output.help, _WRITTEN.get(output.kind, ""))
    name = output.option.replace("-", "_")
    return path(name, help, REQUIRED if output.is_main else None)


SOURCES = Argument.of("sources", "clouds", "", REQUIRED)
OUTPUT = of_output(CLOUD_OUTPUT)
CRS = Argument.of(DECLARED_CRS.name, DECLARED_CRS.kind, DECLARED_CRS.help)
PROGRESS = Argument.of(
    "progress",
    "progress",
    "Receives the share of the work that is done, 0 to 1, and may raise `Cancelled`. A `Progress`"
    " receives messages, too.",
)
SCHEDULER = Argument.of(
    "scheduler",
    "text",
    "With many files: the address of a Dask scheduler, such as tcp://host:8786, whose workers do"
    " the work. Empty: this computer does it, a command in processes, and a function in threads,"
    " or with the word processes in processes.",
)
# For points that may be on the web.
REMOTE = (
    path(
        "cache",
        "The folder that keeps what is fetched of remote point clouds. Empty: that of"
        " BARE_EARTH_CACHE, or one of the user.",
    ),
    Argument.of("limit", "number", f"{LIMIT_HELP} Empty: {MOST:g}."),
)
VPC = of_output(LIST_OUTPUT)


def of_group(kind: str) -> tuple[Argument, ...]:
    """Return the arguments of a group of inputs."""
    return tuple(
        Argument.of(part.name, part.kind, part.help)
        for part in GROUPS[kind]
        if part.kind != "attribute"
    )


# Constraints of functions that can find the water.
WITH_AUTOMATIC_WATER = tuple(
    replace(argument, help=f"{argument.help} The word automatic: the water is found first.")
    if argument.name == "water"
    else argument
    for argument in of_group("constraints")
)


def area(help: str) -> tuple[Argument, Argument]:
    """Return the arguments for the rectangle and the polygons of an area, from its help."""
    extent, boundary = help_of_area(help)
    return Argument.of("extent", "extent", extent), Argument.of("boundary", "polygons", boundary)
