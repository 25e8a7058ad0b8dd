"""Options and messages of the commands for many files."""

from __future__ import annotations

import argparse
import contextlib
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator

from ..core.errors import BareEarthError, Cancelled
from .command import DONE, FAILED
from .options import UsageError, add_extent
from .terminal import tell

if TYPE_CHECKING:
    from ..engine.constraints import Constraints
    from ..engine.many_files import SurveySummary
    from ..engine.memory import Resources
    from ..engine.raster_files import RasterFiles
    from ..engine.workers import Workers
    from ..survey.area import Area


_CONSTRAINTS = {
    "breaklines": "lines that no triangle of the terrain crosses; a line without z gets the height"
    " of the nearest ground point on each side",
    "water": "polygons of water; each is flattened to one level",
    "rivers": "lines along which the level of the water polygons falls",
    "no-ground": "polygons in which the terrain uses no ground points, such as bridges and roofs",
}


def add_rasters(parser: argparse.ArgumentParser) -> None:
    """Add the options for rasters."""
    from ..engine.raster_files import RASTERS

    for name, each in RASTERS.items():
        parser.add_argument(
            f"--{name}", metavar="FILE", type=Path, help=f"GeoTIFF (.tif). {each.help}"
        )


def rasters_of(options: argparse.Namespace) -> RasterFiles:
    """Return the rasters of the options."""
    from ..engine.raster_files import RASTERS, RasterFiles

    return RasterFiles(**{name: getattr(options, name) for name in RASTERS})


def add_area(parser: argparse.ArgumentParser, what: str, more: str = "") -> None:
    """Add the options for a rectangle and for polygons; `what` and `more` are of their help."""
    add_extent(parser, f"{what} this rectangle", more)
    parser.add_argument(
        "--boundary", metavar="FILE", type=Path,
        help=f"{what} these polygons (.geojson, .json, .wkt), in the CRS of the points; as --extent"
        " otherwise, and with it only what lies in both",
    )  # fmt: skip


def area_of(options: argparse.Namespace) -> Area | None:
    """Return the area of the options, or None if there is none."""
    from ..survey.area import Area
    from ..survey.vector_files import read_boundary

    if options.extent is None and options.boundary is None:
        return None
    try:
        box = None if options.extent is None else Area(tuple(options.extent)).box
    except BareEarthError as error:
        raise UsageError(str(error)) from error
    return Area(box, () if options.boundary is None else read_boundary(options.boundary))


def add_constraints(parser: argparse.ArgumentParser, note: str = "") -> None:
    """Add the options for breaklines, water and such; `note` starts their help."""
    for name, what in _CONSTRAINTS.items():
        parser.add_argument(
            f"--{name}", metavar="FILE", type=Path,
            help=f"{note}{what} (.geojson, .json, .wkt), in the CRS of the points",
        )  # fmt: skip


def constraints_of(options: argparse.Namespace) -> Constraints:
    """Return the lines and polygons of the options."""
    from ..engine.constraints import Constraints
    from ..survey.vector_files import read_boundary, read_lines

    found: dict[str, Any] = {}
    for name in _CONSTRAINTS:
        attribute = name.replace("-", "_")
        path = getattr(options, attribute)
        if path is not None:
            read = read_lines if attribute in ("breaklines", "rivers") else read_boundary
            found[attribute] = read(path)
    return Constraints(**found)


def add_scheduler(parser: argparse.ArgumentParser) -> None:
    """Add the option for a cluster."""
    parser.add_argument(
        "--scheduler", metavar="ADDRESS",
        help="with many files: the address of a Dask scheduler, such as tcp://host:8786, whose"
        " workers do the work; without it, processes of this computer do it",
    )  # fmt: skip


def workers_of(options: argparse.Namespace, resources: Resources) -> Workers:
    """Return the workers for many files: a cluster, or this computer."""
    from ..engine.cluster import Cluster
    from ..engine.workers import Local

    return Cluster(options.scheduler, resources) if options.scheduler else Local(resources)


@contextlib.contextmanager
def finished_files_stay() -> Iterator[None]:
    """Tell after a cancel that the run can be continued."""
    try:
        yield
    except (Cancelled, KeyboardInterrupt) as error:
        raise BareEarthError(
            "Cancelled. The finished files stay. Continue with --resume."
        ) from error


def tell_of_survey(options: argparse.Namespace, summary: SurveySummary) -> int:
    """Print the result for many files; return the exit code."""
    tell(options, summary, f"{options.output}: {summary.text}")
    return FAILED if summary.failures else DONE
