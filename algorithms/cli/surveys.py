"""Options and messages of the commands for many files."""

from __future__ import annotations

import argparse
import contextlib
from pathlib import Path
from typing import TYPE_CHECKING, Any, Iterator, Sequence

from ..core.errors import BareEarthError
from .command import DONE, FAILED
from .options import UsageError, add_extent
from .terminal import Terminal, tell

if TYPE_CHECKING:
    from ..core.parameters import ParameterSet
    from ..engine.memory import Resources
    from ..engine.workers import Workers
    from ..rasters.cell_grid import RasterTarget
    from ..runs.many_files import SurveySummary
    from ..survey.area import Area
    from ..tools.check.checkpoints import Checkpoints
    from ..tools.rasters.constraints import Constraints
    from ..tools.rasters.rows import RasterFiles


_CONSTRAINTS = {
    "breaklines": "lines that no triangle of the terrain crosses; z is in the unit of heights of"
    " the points, and a line without z gets the height of the nearest ground point on each side",
    "water": "polygons of water; each is flattened to one level; with the word automatic, 'terrain'"
    " finds the water first, as the command 'water' does",
    "rivers": "lines along which the level of the water polygons falls",
    "no-ground": "polygons in which the terrain uses no ground points, such as bridges and roofs",
}
# The word for water that is found.
AUTOMATIC = "automatic"


def add_rasters(parser: argparse.ArgumentParser) -> None:
    """Add the options for rasters."""
    from ..tools.rasters.rows import RASTERS

    for name, raster in RASTERS.items():
        parser.add_argument(
            f"--{name.replace('_', '-')}", metavar="FILE", type=Path,
            help=f"GeoTIFF (.tif). {raster.help}",
        )  # fmt: skip


def rasters_of(options: argparse.Namespace) -> RasterFiles:
    """Return the rasters of the options."""
    from ..tools.rasters.rows import RASTERS, RasterFiles

    return RasterFiles(**{name: getattr(options, name) for name in RASTERS})


def add_contours(parser: argparse.ArgumentParser) -> None:
    """Add the option for contour lines; their parameters are those of `Contours`."""
    from ..survey.feature_files import FORMATS

    parser.add_argument(
        "--contours", metavar="FILE", type=Path,
        help=f"contour lines of the terrain model ({', '.join(FORMATS)}); the field ELEV has the"
        " height, INDEX is 1 for every fifth line. All but .geojson need pyogrio",
    )  # fmt: skip


@contextlib.contextmanager
def contours_after(
    options: argparse.Namespace, sets: Sequence[ParameterSet]
) -> Iterator[tuple[RasterFiles, list[ParameterSet]]]:
    """Yield the rasters to make, and the parameters of all but the contour lines, then write these
    if they are wanted; without `--dtm`, their terrain model is a temporary file.
    """
    from ..core.files import temporary_folder
    from ..rasters.virtual import virtual_of
    from ..runs.options import RasterOutput
    from ..survey.outputs import check_outputs
    from ..tools.contours import Contours, write_contours
    from ..tools.rasters.rows import RasterFiles

    rasters, how = rasters_of(options), Contours.among(sets)
    rest = [each for each in sets if each is not how]
    if options.contours is None:
        yield rasters, rest
        return
    check_outputs([("features", options.contours)], options.input)
    with temporary_folder(options.contours.parent) as folder:
        dtm = rasters.wanted.get("dtm", folder / "dtm.tif")
        yield RasterFiles(**{**rasters.wanted, "dtm": dtm}), rest
        per_file = RasterOutput.among(sets).raster_per_file
        source = virtual_of(dtm) if per_file and virtual_of(dtm).exists() else dtm
        with Terminal(options.verbose) as progress:
            write_contours(source, options.contours, how, progress)


def add_raster_target(parser: argparse.ArgumentParser) -> None:
    """Add the options for the grid and the extent of the rasters."""
    parser.add_argument(
        "--like", metavar="RASTER",
        help="a raster in the CRS of the points, such as dem.tif: all rasters get its CRS, cell"
        " size, position of the cells, and extent; it replaces --dtm-cell-size",
    )  # fmt: skip
    parser.add_argument(
        "--raster-extent", nargs=4, type=float, metavar=("XMIN", "YMIN", "XMAX", "YMAX"),
        help="the rasters cover this rectangle in the CRS of the points, widened to whole cells,"
        " which stay where they are; all points are used",
    )  # fmt: skip


def raster_target_of(options: argparse.Namespace) -> RasterTarget:
    """Return the grid and the extent of the rasters."""
    from ..rasters.cell_grid import RasterTarget

    extent = options.raster_extent
    try:
        return RasterTarget(options.like, extent and tuple(extent))
    except BareEarthError as error:
        raise UsageError(str(error)) from error


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


def add_constraints(parser: argparse.ArgumentParser, note: str = "") -> None:
    """Add the options for breaklines, water and such; `note` starts their help."""
    from ..survey.vector_files import FORMATS

    for name, what in _CONSTRAINTS.items():
        parser.add_argument(
            f"--{name}", metavar="FILE", type=Path, help=f"{note}{what} ({FORMATS})"
        )


def water_is_automatic(options: argparse.Namespace) -> bool:
    """Return whether water is to be found, and not read."""
    return str(options.water).lower() == AUTOMATIC


def with_found_water(
    options: argparse.Namespace, known: Constraints, sets: Sequence[ParameterSet]
) -> Constraints:
    """Return constraints with the water of the input, if that is to be found."""
    from ..survey.ground_classes import GroundClasses
    from ..tools.water.tool import found_water

    if not water_is_automatic(options):
        return known
    ground = GroundClasses.among(sets)
    with Terminal(options.verbose) as progress:
        water, _ = found_water(options.input, ground, options.crs, progress)
        return known.with_water(water.constraints, progress)


def constraints_of(options: argparse.Namespace, finds_water: bool = False) -> Constraints:
    """Return the lines and polygons of the options; `UsageError` if water is to be found by a
    command that cannot (`finds_water`).
    """
    from ..survey.vector_files import read_boundary, read_lines
    from ..tools.rasters.constraints import Constraints

    if water_is_automatic(options) and not finds_water:
        raise UsageError(
            "Water is found in classified points: make the rasters with 'bare-earth terrain"
            " --water automatic'."
        )
    found: dict[str, Any] = {}
    for name in _CONSTRAINTS:
        attribute = name.replace("-", "_")
        path = getattr(options, attribute)
        if path is not None and not (name == "water" and water_is_automatic(options)):
            read = read_lines if attribute in ("breaklines", "rivers") else read_boundary
            found[attribute] = read(path)
    return Constraints(**found)


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


def tell_of_survey(options: argparse.Namespace, summary: SurveySummary) -> int:
    """Print the result for many files; return the exit code."""
    tell(options, summary, f"{options.output}: {summary.text}")
    return FAILED if summary.failures else DONE
