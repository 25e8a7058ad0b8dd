"""Values of the arguments of a function, as runs need them."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Callable, Protocol, Union

from ..classes.corrections import NO_CORRECTIONS, Corrections, read_corrections
from ..core.errors import BareEarthError
from ..core.progress import SILENT, Progress
from ..survey.area import Area, Polygon
from ..survey.files import Inputs

if TYPE_CHECKING:
    import numpy as np

    from ..core.points import Box
    from ..engine.memory import Resources
    from ..engine.workers import Workers
    from ..rasters.cell_grid import RasterTarget
    from ..tools.check.checkpoints import Checkpoints
    from ..tools.rasters.constraints import Constraints

AUTOMATIC = "automatic"  # the word for water that is found
PROCESSES = "processes"  # the word for those of this computer


class Bar(Protocol):
    """A progress bar as tqdm has it."""

    n: Any
    total: Any

    def update(self, n: float) -> object:
        """Add to what is done."""


# What a user gives as `progress`.
GivenProgress = Union[Progress, Bar, Callable[[float], object], None]


class BarProgress(Progress):
    """Moves a bar of tqdm, whose total is 1 unless the user gave another."""

    def __init__(self, bar: Bar) -> None:
        self._bar, bar.total = bar, bar.total or 1.0

    def report(self, fraction: float) -> None:
        self._bar.update(fraction * self._bar.total - self._bar.n)


class CallingProgress(Progress):
    """Calls a function with the share of the work that is done."""

    def __init__(self, called: Callable[[float], object]) -> None:
        self._called = called

    def report(self, fraction: float) -> None:
        """Call the function, which may raise `Cancelled`."""
        self._called(fraction)


def progress_of(given: Any) -> Progress:
    """Return the progress that a user gives, or a silent one."""
    if given is None or isinstance(given, Progress):
        return given or SILENT
    if hasattr(given, "update") and hasattr(given, "n"):
        return BarProgress(given)
    return CallingProgress(given)


def path_of(given: str | PathLike[str] | None) -> Path | None:
    """Return a path, or None where none is given."""
    return None if given is None else Path(given)


def polygons_of(given: object, may_be_empty: bool = False) -> tuple[Polygon, ...]:
    """Return polygons, given as a file, as geometries in memory, or as arrays of corners."""
    from ..survey.vector_files import shapes_of

    return shapes_of(given, "Polygon", may_be_empty)


def lines_of(given: object) -> tuple[np.ndarray, ...]:
    """Return lines, whatever they are given as."""
    from ..survey.vector_files import shapes_of

    return shapes_of(given, "LineString")


def extent_of(given: Any) -> Box | None:
    """Return a rectangle, given as four numbers or as a geometry that lies in it."""
    if given is None:
        return None
    try:
        west, south, east, north = map(float, getattr(given, "bounds", given))
    except (TypeError, ValueError):
        raise BareEarthError(
            f"An extent is smallest x and y, then largest x and y, not {given!r}."
        ) from None
    return west, south, east, north


def area_of(values: SimpleNamespace) -> Area | None:
    """Return the area that extent and boundary give, or None."""
    if values.extent is None and values.boundary is None:
        return None
    # An invalid extent is refused before the boundary is read.
    box = extent_of(values.extent)
    if box is not None:
        Area(box)
    return Area(box, polygons_of(values.boundary))


def corrections_of(values: SimpleNamespace) -> Corrections:
    """Return the polygons whose class is known."""
    given = values.corrections
    if given is None or isinstance(given, Corrections):
        return given or NO_CORRECTIONS
    return read_corrections(given)


def is_automatic(given: object) -> bool:
    """Return whether polygons are to be found, and not read."""
    return isinstance(given, (str, Path)) and str(given).lower() == AUTOMATIC


def constraints_of(values: SimpleNamespace) -> Constraints:
    """Return the lines and polygons that the terrain must respect."""
    from ..tools.rasters.constraints import Constraints

    return Constraints(
        breaklines=lines_of(values.breaklines),
        water=() if is_automatic(values.water) else polygons_of(values.water),
        rivers=lines_of(values.rivers),
        no_ground=polygons_of(values.no_ground),
    )


def target_of(values: SimpleNamespace) -> RasterTarget:
    """Return the grid and the extent of the rasters."""
    from ..rasters.cell_grid import RasterTarget
    from .raster_inputs import raster_of

    extent, like = values.raster_extent, values.like
    like = None if like is None else raster_of(like, with_cells=False)
    return RasterTarget(like, None if extent is None else tuple(extent))


def checkpoints_of(values: SimpleNamespace) -> Checkpoints | None:
    """Return the checkpoints of a file, or of x, y and z in the CRS of the points; or None."""
    from ..survey.vector_files import is_source
    from ..tools.check.checkpoints import Checkpoints
    from ..tools.check.reading import read_checkpoints

    given = values.checkpoints
    if is_source(given):
        return read_checkpoints(given, values.columns, values.checkpoints_crs)
    return None if given is None else Checkpoints.of(given)


def inputs_of(values: SimpleNamespace, into_folder: bool = False) -> Inputs:
    """Return the files; written into a folder, or by a cluster, one file is a survey as well."""
    return Inputs(values.sources, True if into_folder or values.scheduler else None)


def workers_of(values: SimpleNamespace, resources: Resources) -> Workers | None:
    """Return the workers for many files: None for threads of this process; the command line works
    in processes.
    """
    scheduler = values.scheduler
    if scheduler is None and getattr(values, "in_processes", False):
        scheduler = PROCESSES
    if scheduler is None:
        return None
    if scheduler == PROCESSES:
        from ..engine.workers import Local

        return Local(resources)
    from ..engine.cluster import Cluster

    return Cluster(scheduler, resources)
