"""Point clouds that are given by their addresses: what a run needs of them is fetched first."""

from __future__ import annotations

import contextlib
from os import PathLike
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, ContextManager, Iterable, Sequence

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet
from ..core.words import option, tool
from ..filters import METHODS
from ..remote.addresses import is_address
from ..tools.ground.method import TileMethod
from .arguments import KINDS, MOST, Argument
from .given import area_of, progress_of

if TYPE_CHECKING:
    from ..crs.system import Crs

# Metres round an area, all points in which are fetched for rasters. A file on this computer is read
# farther out (`AROUND_AREA`), which costs little. In 18 windows of 7 real clouds, 200 m give the
# same labels, and 400 m the same rasters. It decides whether a gap without points, such as a lake,
# ends inside the survey.
AROUND = 400.0
# The share of the progress that fetching gets.
SHARE = 0.5


def with_downloaded_points(
    arguments: Sequence[Argument],
    values: SimpleNamespace,
    sets: Sequence[ParameterSet],
    looks_around: bool = True,
    classifies: bool = False,
) -> ContextManager[None]:
    """Put files of the cache in the place of addresses of point clouds; with what is returned,
    errors name the addresses.
    """
    given = {
        argument.name: several(getattr(values, argument.name))
        for argument in arguments
        if argument.kind in (KINDS["cloud"], KINDS["clouds"])
    }
    if not any(map(is_remote, (source for sources in given.values() for source in sources))):
        return contextlib.nullcontext()
    from ..remote.cache import AreaAround, addresses_named, cache_of, download_all
    from ..remote.fetching import Wanted
    from ..tools.rasters.rows import RASTERS

    names = [argument.name for argument in arguments]
    edges = {name: getattr(values, name, None) for name in ("extent", "boundary")}
    area, crs = area_of(SimpleNamespace(**edges)), stated_crs(getattr(values, "crs", None))
    if area is not None:
        makes_rasters = any(getattr(values, name, None) for name in (*RASTERS, "contours"))
        margin = margin_of(sets, classifies and not makes_rasters) if looks_around else 0.0
        area = AreaAround(area.box, area.polygons, margin, crs)
    advice = "Choose a smaller area"
    if not area:
        advice = f"Give an area with {option('extent')} or {option('boundary')}"
    if "extent" not in names:
        advice = f"Download a part of it first, with {tool('fetch')}"
    # A tool without parameters only describes the points.
    wanted = Wanted(area, most=most_bytes(values), crs=crs, is_measured=bool(sets) and looks_around)
    progress = progress_of(values.progress)
    place = cache_of(values.cache), advice, progress.part(0.0, SHARE)
    inputs, found = download_all(given, wanted, *place)
    for name, here in inputs.items():
        setattr(values, name, here if here.is_survey else here[0])
    values.progress = progress.part(SHARE, 1.0)
    return addresses_named(found)


def most_bytes(values: SimpleNamespace) -> float:
    """Return how many bytes may be fetched."""
    most = MOST if values.limit is None else float(values.limit)
    if not most >= 0.0:
        raise BareEarthError(f"The limit must be a number of gigabytes, not {values.limit}.")
    return most * 1e9


def several(given: str | Path | Iterable[str | Path]) -> list[str | Path]:
    """Return sources, given as one or as several."""
    return [given] if isinstance(given, (str, PathLike)) else list(given)


def is_remote(source: object) -> bool:
    """Return whether a source is given by its address."""
    return isinstance(source, str) and is_address(source)


def stated_crs(text: str | None) -> Crs | None:
    """Return the CRS that a user states; None if nothing is stated."""
    from ..crs.stated import stated_wkt
    from ..crs.system import crs_of_wkt

    wkt = stated_wkt(text)
    return crs_of_wkt(wkt) if wkt else None


def margin_of(sets: Sequence[ParameterSet], is_method_alone: bool) -> float:
    """Return how far round the area points matter, in metres."""
    # Rasters need the widest surroundings; a method alone needs fewer.
    margin = 0.0 if is_method_alone else AROUND
    for values in sets:
        parameters = values.parameters if isinstance(values, TileMethod) else values
        margin = max(margin, getattr(parameters, "context", None) or 0.0)
        for method in METHODS.values():
            if isinstance(parameters, method.parameters):
                margin = max(margin, method.reach(parameters))
    return margin
