"""Turns the fields of a dialog into plain values, and downloads what is remote among them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Iterable, Sequence

from qgis.core import (
    QgsProcessingParameterRasterDestination,
    QgsProcessingParameterRasterLayer,
)

from ...algorithms.core.parameters import ParameterSet
from ...algorithms.survey.files import Inputs
from ...algorithms.tools.declaration import Input, Tool
from ...algorithms.tools.ground.output import PointOutput
from ..i18n import mark
from ..styles.loaded import in_main_thread
from .cloud_crs import CloudCrs, text_of
from .feedback import Refusal
from .one_run import refuse_two_runs
from .remote import LIMIT
from .request import Request, Resolved
from .shapes import area_of, has_area
from .tool_inputs import BEFORE, FILES, KINDS, LATE

# Advice in the error for a download over the limit.
_ADVICE = "Choose a smaller extent"
_MANY = mark(
    "{} lists {} point clouds that have points there, and this algorithm reads one. Choose 'Point"
    " cloud to terrain', or download them first."
)
# Inputs of these kinds say which part of remote points is needed.
PARTS = {"area", "extent"}
# Whether a run on the first input of this kind is one on many files; else it is if there are many.
_IS_SURVEY = {"cloud": False, "address": False, "files": True}


def resolve_files(
    request: Request, declared: Sequence[Input], sets: Sequence[ParameterSet]
) -> Resolved:
    """Find the files of a run, which must exist; other inputs are not read."""
    found = _read(request, Resolved(declared, sets, request.stated_crs), FILES)
    remotes = [remote for one in found.given.values() for remote in one.remotes]
    is_address = _kind_of(found) == "address"
    if remotes and not is_address and not has_area(request):
        text = mark("{} is not on this computer: give the extent to download.")
        raise Refusal(text, remotes[0].name)
    made = [str(found.given[one.name].value or "") for one in declared if one.made_as]
    if made and request.context.project() is not None and in_main_thread():
        refuse_two_runs(made, request.context.project())
    if remotes:
        # Points round the area are downloaded to judge those in it, and nobody asked for them.
        sets = [
            replace(values, area_only=True) if isinstance(values, PointOutput) else values
            for values in sets
        ]
    points, crs = _points_of(found), next((remote.crs for remote in remotes if remote.crs), None)
    here = () if remotes or is_address else points
    far = () if is_address else [name for name, one in found.given.items() if one.remotes]
    found = found._replace(sets=sets, points=points, far=far)
    return found._replace(crs=_crs_of(request, here, found.stated or crs))


def resolve(request: Request, declared: Sequence[Input], sets: Sequence[ParameterSet]) -> Resolved:
    """Return what a run works with; in the main thread, since layers of the project are read."""
    found = resolve_files(request, declared, sets)
    # The CRS of remote points is not known before the download.
    return found if found.far else _read(request, found, BEFORE)


def resolve_rest(request: Request, resolved: Resolved) -> Resolved:
    """Return what a run works with, after a download, with all inputs that were not read yet."""
    return _read(request, resolved, LATE)


def _read(request: Request, resolved: Resolved, latest: int) -> Resolved:
    """Read the inputs that are due by a time, unless they are read already."""
    given = dict(resolved.given)
    for one in resolved.declared:
        kind = KINDS[one.kind]
        if one.name not in given and kind.when <= latest:
            given[one.name] = kind.read(request, one, resolved)
    ordered = {one.name: given[one.name] for one in resolved.declared if one.name in given}
    return resolved._replace(given=ordered)


def _kind_of(resolved: Resolved) -> str:
    """Return the kind of the main input."""
    return next((one.kind for one in resolved.declared if KINDS[one.kind].when == FILES), "")


def _points_of(resolved: Resolved, is_list: bool = False) -> Inputs:
    """Return the files on this computer; a list of files is a survey."""
    paths = [path for one in resolved.given.values() for path in one.paths]
    return Inputs(paths, _IS_SURVEY.get(_kind_of(resolved), is_list or None))


def _crs_of(request: Request, points: Iterable[Path], stated: str | None) -> CloudCrs:
    """Return the CRS of points, also in subfolders if the user asks for these, or of a raster."""
    field = request.algorithm.parameterDefinition
    if isinstance(field("INPUT"), QgsProcessingParameterRasterLayer):
        # Without a CRS nothing is transformed.
        return CloudCrs(stated=text_of(request.read("RasterLayer", "INPUT").crs()) or "WKT:")
    recursive = field("RECURSIVE") is not None and request.read("Bool", "RECURSIVE")
    return CloudCrs(*points, recursive=recursive, stated=stated)


def download(request: Request, resolved: Resolved, tool: Tool) -> Resolved:
    """Download the needed part of remote points; in any thread."""
    area = area_of(request, resolved.crs) if resolved.far else None
    if area is None:
        return resolved
    # Imported here, so that QGIS starts faster.
    from ...algorithms.library.remote_points import SHARE, margin_of, stated_crs
    from ...algorithms.remote.cache import AreaAround, cache_of, download_all
    from ...algorithms.remote.fetching import Wanted

    kinds = {one.name: one.kind for one in resolved.declared}
    margin = 0.0
    # Without a field for an area, only the downloaded part is used.
    if tool.looks_around and not PARTS.isdisjoint(kinds.values()):
        fields = request.algorithm.destinationParameterDefinitions()
        rasters = [
            one.name() for one in fields if isinstance(one, QgsProcessingParameterRasterDestination)
        ]
        is_alone = getattr(tool, "classifies", False) and all(map(request.is_empty, rasters))
        margin = margin_of(resolved.sets, is_alone)
    crs = stated_crs(resolved.stated)
    part, limit = AreaAround(area.box, area.polygons, margin, crs), request.read("Double", LIMIT)
    wanted = Wanted(part, most=limit * 1e9, crs=crs, is_measured=tool.looks_around)
    sources: dict[str, list[str | Path]] = {}
    for name in resolved.far:
        found = resolved.given[name]
        sources[name] = [*(remote.address for remote in found.remotes), *found.paths]
    place = cache_of(None), _ADVICE, request.progress.before(SHARE)
    here, brought = download_all(sources, wanted, *place)
    given = dict(resolved.given)
    for name, paths in here.items():
        is_one = kinds[name] == "cloud"
        if is_one and len(paths) > 1:
            raise Refusal(_MANY, given[name].name, len(paths))
        value = paths[0] if is_one else paths
        given[name] = given[name]._replace(value=value, paths=tuple(paths))
    resolved = resolved._replace(given=given, brought=brought)
    points = _points_of(resolved, any(paths.is_survey for paths in here.values()))
    return resolved._replace(points=points, crs=_crs_of(request, points, resolved.crs.stated))
