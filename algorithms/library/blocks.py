"""A survey of many files as blocks: tasks that can be pickled, and that run anywhere."""

from __future__ import annotations

import contextlib
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Iterator, NamedTuple, Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet
from ..core.points import Box, box_round
from ..core.progress import SILENT, Progress
from ..core.threads import SharedThreads
from ..crs.matching import described, is_same_crs
from ..crs.measurable import require_measurable
from ..crs.stated import how_to_state, stated_wkt
from ..crs.system import Crs
from ..engine.block_grid import BlockGrid, BlockIndex, places_of
from ..engine.memory import Resources
from ..engine.options import TileInput
from ..engine.step import steps_in_crs
from ..engine.visits import values_of
from ..las.cloud import PointCloud, survey_frame
from ..las.lasfile import LasFile
from ..las.opening import open_las
from ..remote.addresses import shown
from ..remote.cache import AreaAround, cache_of, download, look
from ..remote.fetching import Wanted
from ..survey.area import Area
from ..survey.files import Inputs, open_survey
from ..survey.shapes import Outside, Place
from ..survey.window import may_touch, read_window
from ..tools import map_tool
from .given import GivenProgress, corrections_of, progress_of
from .remote_points import is_remote, most_bytes, several, stated_crs

# A task works in one thread, since others work at the same time.
ONE_THREAD = Resources(threads=1)
_COLUMNS = {
    "Classification": "classification", "ReturnNumber": "return_number",
    "NumberOfReturns": "number_of_returns", "Withheld": "withheld", "Overlap": "overlap",
}  # fmt: skip
# The columns of a block.
_KINDS: dict[str, type] = {
    **dict.fromkeys("XYZ", np.float64), **dict.fromkeys(_COLUMNS, np.uint8),
    "Withheld": np.bool_, "Overlap": np.bool_, "Source": np.int32, "Index": np.int64,
}  # fmt: skip


class _CloudSource(NamedTuple):
    """A point cloud."""

    name: str  # path or address
    box: Box
    outer: Box  # the box with a margin for rounding errors


class _BlockReading(NamedTuple):
    """How the points of a block are read and classified."""

    grid: BlockGrid  # of the step that classifies
    place: BlockIndex
    is_classified: bool
    box: Box  # extent of the points in the block, from the headers, in units of the CRS
    crs: Crs
    cache: Path | None  # None for the usual folder
    most: float  # bytes that may be downloaded
    sources: tuple[str, ...]  # with signatures, which are never shown

    def __repr__(self) -> str:
        return "_BlockReading(...)"


@dataclass(frozen=True, eq=False, repr=False)
class Block:
    """A block of a survey, as a task: a call reads its points, and classifies them.

    A block holds no points and can be pickled. So Dask, joblib, Ray and others can call it wherever
    the files have the same names.

    Attributes
    ----------
    extent : tuple of float
        Smallest x and y, largest x and y, in units of the CRS: of the points that a call returns.
        Those on the eastern and northern border belong to the next blocks.
    window : tuple of float
        The same with the margin whose points help to classify: what a call reads.
    sources : tuple of str
        The files, and the addresses without their signatures, that may have points in the window.
    crs : str or None
        The CRS as well-known text (WKT), None if it is not known.
    """

    extent: Box
    window: Box
    sources: tuple[str, ...]
    crs: str | None
    work: _BlockReading

    def __repr__(self) -> str:
        west, south, east, north = self.extent
        return f"Block(x {west:.10g} to {east:.10g}, y {south:.10g} to {north:.10g})"

    def __call__(self, progress: GivenProgress = None) -> dict[str, np.ndarray]:
        """Return the points in the block, as a table that functions on arrays take.

        Parameters
        ----------
        progress : Progress, bar of tqdm, or callable that takes a float, optional
            Receives the share of the work that is done.

        Returns
        -------
        dict of numpy.ndarray
            X, Y, Z, Classification, ReturnNumber, NumberOfReturns, Withheld and Overlap, each of
            shape (n,), where n can be 0. All blocks together have the points of all files. Source
            is the place of the file of each point in `sources` and `paths()`, Index that of the
            point in the file, from 0 on.

        Raises
        ------
        BareEarthError
            If a file cannot be read.
        """
        clouds = points_of(self, progress_of(progress), numbers=True)
        table: dict[str, list[np.ndarray]] = {name: [] for name in _KINDS}
        for source, cloud in clouds:
            x, y = cloud.coordinates()
            for name, axis in zip("XYZ", (x, y, cloud.z * cloud.scale[2] + cloud.offset[2])):
                table[name].append(axis)
            for name, field in _COLUMNS.items():
                values = getattr(cloud, field)
                table[name].append(np.zeros(cloud.count, bool) if values is None else values)
            table["Source"].append(np.full(cloud.count, source))
            table["Index"].append(np.asarray(cloud.number))
        return {
            name: np.concatenate([np.zeros(0, kind), *table[name]]).astype(kind, copy=False)
            for name, kind in _KINDS.items()
        }

    def paths(self) -> list[Path | None]:
        """Return the files on this computer that hold the points of the window.

        Returns
        -------
        list of pathlib.Path or None
            One for each of `sources`: the same file, or that of the cache, which holds a part of an
            address and is fetched if it is not there. None for an address without such points.

        Raises
        ------
        BareEarthError
            If points cannot be fetched.
        """
        files = _files_of(self, SILENT)
        return [files.get(number) for number in range(len(self.sources))]


def are_blocks(points: object) -> bool:
    """Return whether points are blocks."""
    return isinstance(points, (list, tuple)) and any(isinstance(point, Block) for point in points)


def blocks_of(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> list[Block]:
    """Return the blocks of files and addresses, from south to north."""
    progress = progress_of(values.progress)
    inputs = {"corrections": corrections_of(values)}
    (step,) = map_tool("classify").steps(sets, inputs, {})
    stated, cache = stated_wkt(values.crs), values.cache and cache_of(values.cache)
    sources = several(values.sources)
    remote = [str(source) for source in sources if is_remote(source)]
    local = [source for source in sources if not is_remote(source)]
    clouds = list(_local(local, sets, stated, progress))
    for cloud in look(remote, cache_of(cache), progress):
        clouds.append((cloud.address, stated_crs(values.crs) or cloud.crs, cloud.box, None))
    crs, box = clouds[0][1], box_round(np.array([box for _, _, box, _ in clouds]))
    for name, crs_of_cloud, _, _ in clouds:
        _check_same(name, crs_of_cloud, crs)
    require_measurable("The survey", crs, box)
    here = Place("the files", crs, box)
    (step,) = steps_in_crs([step], here, progress)
    grid = BlockGrid(survey_frame(crs), step, stated)
    inside: dict[BlockIndex, list[_CloudSource]] = {}
    for name, _, box, tile in clouds:
        source = _CloudSource(name, box, tile.outer_box if tile else box)
        for place in places_of(grid, tile) if tile else grid.touching(box):
            inside.setdefault(place, []).append(source)
    wanted = set(inside)
    if values.extent is not None:
        wanted &= {*grid.touching(Area(tuple(values.extent)).located(here, progress).bounds)}
        if not wanted:
            raise BareEarthError(
                "No block lies in the extent. Give the extent in the CRS of the points."
            )
    blocks = []
    for place in sorted(wanted, key=lambda place: (place.row, place.column)):
        extent = grid.in_crs(grid.blocks.block(*place).box)
        window = extent if values.classified else grid.window([place])
        near = {source for around in grid.touching(window) for source in inside.get(around, ())}
        names = sorted(source.name for source in near if Area(window).may_touch(source.outer))
        whole = box_round(np.array([source.box for source in inside[place]]))
        work = _BlockReading(
            grid, place, values.classified, shared_by(extent, whole), crs, cache,
            most_bytes(values), tuple(names),
        )  # fmt: skip
        blocks.append(Block(extent, window, tuple(map(shown, names)), crs.wkt, work))
    return blocks


def _local(
    paths: Sequence[str | Path],
    sets: Sequence[ParameterSet],
    stated: str | None,
    progress: Progress,
) -> Iterator[tuple[str, Crs, Box, LasFile | None]]:
    """Yield path, CRS, extent and header of each file; all must be readable."""
    if not paths:
        return
    recursive = TileInput.among(sets).recursive
    survey = open_survey(Inputs(paths).read_as(stated, recursive), progress)
    if survey.broken:  # a missing file would look like a void
        raise BareEarthError(survey.broken[0].reason)
    for tile in survey.tiles:
        yield str(tile.path), survey.crs, tile.box, tile


def _check_same(name: str, crs: Crs, common: Crs) -> None:
    """Refuse a point cloud in another CRS than the others."""
    if not is_same_crs(crs, common):
        raise BareEarthError(
            f"{shown(name)} is in another CRS ({described(crs)}) than others"
            f" ({described(common)}). Reproject them to one CRS. If they are in one CRS all the"
            f" same, give it: {how_to_state()}."
        )


def shared_by(first: Box, second: Box) -> Box:
    """Return the intersection of two boxes."""
    west, south = max(first[0], second[0]), max(first[1], second[1])
    return west, south, min(first[2], second[2]), min(first[3], second[3])


def points_of(
    block: Block, progress: Progress, numbers: bool = False
) -> list[tuple[int, PointCloud]]:
    """Return the points in a block with their classes, one cloud for each file, with the
    place of the file among the sources of the block.
    """
    grid, places = block.work.grid, [block.work.place]
    if block.work.is_classified:
        return [
            (source, cloud.take(np.flatnonzero(grid.numbers(cloud, places))))
            for source, cloud in _read(block, progress, numbers)
        ]
    with SharedThreads(1).used():
        read = list(_read(block, progress.part(0.0, 0.3), numbers))
        clouds = [cloud for _, cloud in read]
        work = values_of(grid, clouds, ONE_THREAD, progress.part(0.3, 1.0), places)
    if work.failure:
        progress.warning(str(work.failure))
    classified = []
    for part, (source, cloud) in enumerate(read):
        inside = np.flatnonzero(work.parts[part][1])
        inner = grid.step.applied(cloud.take(inside), work.values(part)[inside])
        classified.append((source, inner))
    return classified


def _files_of(block: Block, progress: Progress) -> dict[int, Path]:
    """Return the files of a block by the numbers of its sources, after downloading remote ones."""
    work, files = block.work, {}
    remote: dict[str, int] = {}
    for number, name in enumerate(work.sources):
        if is_remote(name):
            remote[name] = number
        else:
            files[number] = Path(name)
    if remote:
        wanted = Wanted(AreaAround(block.window), most=work.most)
        advice = "Allow more, by the argument limit"
        with contextlib.suppress(Outside):
            fetched = download([*remote], wanted, cache_of(work.cache), advice, progress)
            numbers = {shown(name): number for name, number in remote.items()}
            files.update((numbers[name], path) for path, name in fetched.paths.items())
    return files


def _read(block: Block, progress: Progress, numbers: bool) -> Iterator[tuple[int, PointCloud]]:
    """Yield the number of each source, and its points in the window of a block."""
    work, files = block.work, _files_of(block, progress.quiet())
    for (number, path), part in zip(files.items(), progress.shares(*[1.0] * len(files))):
        las = open_las(path, work.grid.stated)
        if not may_touch(las, block.window):
            continue
        cloud = read_window(las, block.window, part, trust_header=True, numbers=numbers)
        if is_remote(work.sources[number]):
            # The CRS that a list of files states can be wrong.
            _check_same(block.sources[number], cloud.crs, work.crs)
        if cloud.count:
            yield number, cloud
