"""Point clouds that are given by their addresses: what a run needs of them is fetched first."""

from __future__ import annotations

from os import PathLike
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Sequence

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet
from ..filters import METHODS
from ..remote.addresses import is_address
from ..survey.files import Inputs
from .arguments import KINDS, Argument
from .given import area_of, progress_of

if TYPE_CHECKING:
    from ..survey.area import Area

# Gigabytes that are fetched unless the user allows more.
_MOST = 2.0
# The share of the progress that fetching gets.
_SHARE = 0.5


def bring_points(
    arguments: Sequence[Argument], values: SimpleNamespace, sets: Sequence[ParameterSet]
) -> dict[Path, str]:
    """Put files of the cache in the place of addresses of point clouds; return their paths with the
    addresses as they are shown.
    """
    given = {
        argument.name: _several(getattr(values, argument.name))
        for argument in arguments
        if argument.kind in (KINDS["cloud"], KINDS["clouds"])
    }
    if not any(map(_is_remote, (source for sources in given.values() for source in sources))):
        return {}
    from ..remote.cache import bring_here, cache_of
    from ..remote.fetching import Wanted

    names = [argument.name for argument in arguments]
    most = _MOST if values.limit is None else float(values.limit)
    if not most >= 0.0:
        raise BareEarthError(f"The limit must be a number of gigabytes, not {values.limit}.")
    area = _surroundings(values, sets)
    advice = "Choose a smaller area" if area else "Give an area (--extent or --boundary)"
    if "extent" not in names:
        advice = "Fetch a part of it first, by 'bare-earth fetch' with an area"
    wanted, progress = Wanted(area, most=most * 1e9), progress_of(values.progress)
    found: dict[Path, str] = {}
    parts = progress.part(0.0, _SHARE).shares(*[1.0] * len(given))
    for (name, sources), part in zip(given.items(), parts):
        addresses = [str(source) for source in sources if _is_remote(source)]
        if addresses:
            here = bring_here(addresses, wanted, cache_of(values.cache), advice, part)
            found.update(here.paths)
            paths = [*here.paths, *(source for source in sources if not _is_remote(source))]
            # A list is a survey, however many of its files have points in the area.
            many = Inputs(paths, True if here.is_list else None)
            setattr(values, name, many if len(many) > 1 or many.is_survey else paths[0])
    values.progress = progress.part(_SHARE, 1.0)
    return found


def _several(given: Any) -> list[Any]:
    return [given] if isinstance(given, (str, PathLike)) else list(given)


def _is_remote(source: Any) -> bool:
    return isinstance(source, str) and is_address(source)


def _surroundings(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> Area | None:
    """Return the area with all points that the tools use for it."""
    from ..crs.stated import stated_wkt
    from ..crs.system import crs_of_wkt
    from ..remote.cache import Surroundings
    from ..tools.rasters.output import AROUND_AREA
    from ..tools.rasters.rows import RASTERS

    edges = {name: getattr(values, name, None) for name in ("extent", "boundary")}
    area = area_of(SimpleNamespace(**edges))
    if area is None:
        return None
    wkt = stated_wkt(values.crs)
    # Rasters need the widest surroundings; a method alone needs fewer.
    is_method_alone = hasattr(values, "explain") and not any(
        getattr(values, name, None) for name in (*RASTERS, "contours")
    )
    margin = 0.0 if is_method_alone else AROUND_AREA
    for parameters in sets:
        margin = max(margin, getattr(parameters, "context", None) or 0.0)
        for method in METHODS.values():
            if isinstance(parameters, method.parameters):
                margin = max(margin, method.reach(parameters))
    return Surroundings(area.box, area.polygons, margin, crs_of_wkt(wkt) if wkt else None)
