"""Options and messages of the commands for many files."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ..core.errors import BareEarthError
from .options import UsageError, add_extent

if TYPE_CHECKING:
    from ..engine.memory import Resources
    from ..engine.workers import Workers
    from ..survey.area import Area
    from ..tools.check.checkpoints import Checkpoints


# The word for water that is found.
AUTOMATIC = "automatic"


def add_area(parser: argparse.ArgumentParser, what: str, more: str = "") -> None:
    """Add the options for a rectangle and for polygons; `what` and `more` are of their help."""
    from ..survey.vector_files import FORMATS

    add_extent(parser, f"{what} this rectangle", more)
    parser.add_argument(
        "--boundary", metavar="FILE", type=Path,
        help=f"{what} these polygons ({FORMATS}); as --extent otherwise, and with it only what"
        " lies in both",
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


def add_checkpoints(parser: argparse.ArgumentParser, text: str) -> None:
    """Add the options for checkpoints; `text` is the help of the first one."""
    parser.add_argument("--checkpoints", metavar="FILE", help=text)
    parser.add_argument(
        "--columns", metavar="x=E,y=N,z=H,cover=Class,type=Use,name=ID",
        help="the columns or attributes of the checkpoints, by name or by number from 1 on; those"
        " that are not given are recognised by their names",
    )  # fmt: skip
    parser.add_argument(
        "--checkpoints-crs", metavar="CRS",
        help="the CRS of x and y of the checkpoints, such as EPSG:4326; without it, what the file"
        " states, or the CRS of the points",
    )  # fmt: skip


def checkpoints_of(options: argparse.Namespace) -> Checkpoints | None:
    """Return the checkpoints of the options, or None if there are none."""
    from ..tools.check.reading import read_checkpoints

    if options.checkpoints is None:
        return None
    return read_checkpoints(options.checkpoints, options.columns, options.checkpoints_crs)


def add_scheduler(parser: argparse.ArgumentParser) -> None:
    """Add the option for a cluster."""
    parser.add_argument(
        "--scheduler", metavar="ADDRESS",
        help="with many files: the address of a Dask scheduler, such as tcp://host:8786, whose"
        " workers do the work; without it, processes of this computer do it",
    )  # fmt: skip


def workers_of(options: argparse.Namespace, resources: Resources) -> Workers:
    """Return the workers for many files: a cluster, or this computer."""
    if options.scheduler:
        from ..engine.cluster import Cluster

        return Cluster(options.scheduler, resources)
    from ..engine.workers import Local

    return Local(resources)
