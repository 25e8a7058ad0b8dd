"""Finds the files of a survey, reads their headers, and checks that they fit together."""

from __future__ import annotations

import os
import re
from collections import Counter
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Iterable, Iterator, Tuple, Union

import numpy as np

from ..core.errors import BareEarthError
from ..core.points import Box, box_round
from ..core.progress import SILENT, Notes, Progress
from ..crs.stated import stated_wkt
from ..crs.system import Crs
from ..las.cloud import PointCloud
from ..las.crs_records import read_crs
from ..las.lasfile import LasFile
from ..las.opening import NoPoints, open_las
from ..las.reading import read_parts
from ..las.sources import read_text
from .common_crs import common_crs, names_of
from .copies import copies_in, report_twins
from .pieces import FilePiece, pieces_of, report_strays
from .shapes import Place
from .vpc import SUFFIX as VPC_SUFFIX
from .vpc import is_overview, no_extent, read_vpc

# What users give: a path, or several.
Sources = Union[str, Path, Iterable[Union[str, Path]]]
_CLOUDS = (".las", ".laz")
_LISTS = (".txt", ".lst", ".list")
# Tables that may hold points.
_TABLES = (
    ".csv", ".tsv", ".tab", ".xyz", ".pts", ".ptx", ".asc", ".dat", ".xlsx", ".xlsm", ".xls", ".ods"
)  # fmt: skip
_NUMBER = re.compile(r"(?<![^\s,;])[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?(?![^\s,;])")


class Inputs(Tuple[Path, ...]):
    """The files, folders and lists that a user gives, and how they are read."""

    is_survey: bool  # whether a run works on them as on many files
    recursive: bool = False  # whether folders are searched with all their subfolders
    stated: str | None = None  # the CRS in place of that of the files, as for `open_las`
    opened: Survey | None = None  # the opened files, if they were opened before

    def __new__(cls, sources: Sources, is_survey: bool | None = None) -> Inputs:
        """Return inputs, which are a survey if `is_survey`, by default unless they are one file."""
        if isinstance(sources, Inputs) and is_survey is None:
            return sources
        new = super().__new__(cls, map(Path, _several(sources)))
        if is_survey is None:
            is_survey = len(new) != 1 or new[0].is_dir() or not is_cloud(new[0])
        new.is_survey = is_survey and bool(new)
        return new

    def read_as(self, stated: str | None, recursive: bool = False) -> Inputs:
        """Return the same inputs, read in another way."""
        return self._with(stated=stated, recursive=recursive)

    def holding(self, survey: Survey) -> Inputs:
        """Return the same inputs with their opened files, which need not be opened again."""
        return self._with(opened=survey)

    def _with(self, **changed: object) -> Inputs:
        new = super().__new__(Inputs, self)
        vars(new).update({**vars(self), **changed})
        return new

    @property
    def output_kind(self) -> str:
        """The kind of output for the points: a folder for a survey, a file for one file."""
        return "folder" if self.is_survey else "cloud"

    def open(self, progress: Progress = SILENT) -> Survey:
        """Open the files; one file is a survey of one tile, whose header can be wrong."""
        if self.is_survey or self.opened is not None:
            return open_survey(self, progress)
        las = open_las(self[0], self.stated)
        survey = Survey((las,), (), read_crs(las), self.stated)
        las.report_limits(progress)
        report_strays(survey.pieces, progress)
        return survey


@dataclass(frozen=True)
class BrokenTile:
    """A file that cannot be used, with the reason as a sentence."""

    path: Path
    reason: str


@dataclass(frozen=True)
class Survey:
    """The files of a survey, sorted by their paths."""

    tiles: tuple[LasFile, ...]  # at least one, all in the same CRS
    broken: tuple[BrokenTile, ...]  # files that cannot be read
    crs: Crs
    stated: str | None = None  # the CRS that the user states in place of the records, as WKT
    empty: tuple[LasFile, ...] = ()  # valid files without points, which are not among the tiles

    @classmethod
    def of_cloud(cls, cloud: PointCloud) -> Survey:
        """Return points in memory as a survey of one file, which has what is asked of its tile."""
        tile: Any = cloud
        return cls((tile,), (), cloud.crs)

    @property
    def count(self) -> int:
        """Number of points."""
        return sum(tile.count for tile in self.tiles)

    @property
    def box(self) -> Box:
        """Smallest x and y, largest x and y of all tiles, in units of the CRS."""
        return box_round(self._boxes)

    @property
    def place(self) -> Place:
        """Where the points lie."""
        return Place("the files", self.crs, self.box)

    @cached_property
    def _boxes(self) -> np.ndarray:
        return np.array([tile.outer_box for tile in self.tiles])

    @cached_property
    def pieces(self) -> list[FilePiece]:
        """The parts of the survey that lie far apart, the one with the most points first."""
        return pieces_of(self.tiles, self.crs.horizontal_unit)

    def touching(self, box: Box) -> list[LasFile]:
        """Return the tiles whose extents touch a box, including borders."""
        west, south, east, north = self._boxes.T
        touches = (west <= box[2]) & (east >= box[0]) & (south <= box[3]) & (north >= box[1])
        return [self.tiles[number] for number in np.flatnonzero(touches)]

    def parts(
        self, progress: Progress = SILENT, strips: bool = False, times: bool = False
    ) -> Iterator[PointCloud]:
        """Yield the points of all files part by part, as `read_parts` does."""
        shares = progress.shares(*(max(tile.count, 1) for tile in self.tiles))
        for tile, share in zip(self.tiles, shares):
            yield from read_parts(tile, share.quiet(), strips, times)


def open_survey(sources: Sources, progress: Progress = SILENT) -> Survey:
    """Find the files of a survey, as `find_files` does, and read their headers; refuse files of
    which none can be read, or that differ in CRS or units.
    """
    inputs = Inputs(sources)
    if inputs.opened is not None:
        return inputs.opened
    stated = stated_wkt(inputs.stated)
    paths = find_files(inputs, inputs.recursive, progress)
    files = [path for path in inputs if not path.is_dir()]
    named = set(map(_key, find_files(files, may_be_none=True)))
    notes, tiles, systems, broken = Notes(), [], [], []
    empty: list[LasFile] = []
    for number, path in enumerate(paths, start=1):
        try:
            tile = open_las(path, stated)
            _check_extent(tile)
            systems.append(_crs_of(tile, notes))
            tiles.append(tile)
        except NoPoints as error:
            empty += error.layouts
        except BareEarthError as error:
            broken.append(BrokenTile(path, str(error)))
        progress(number / len(paths))
    if empty:
        hold = "holds" if len(empty) == 1 else "hold"
        progress.warning(f"{names_of(empty)} {hold} no points.")
    if not tiles and not broken:
        raise NoPoints("None of the files holds a point. Give files that have some.", tuple(empty))
    if not tiles:
        raise BareEarthError(
            broken[0].reason
            if len(broken) == 1
            else f"None of the {len(broken)} files can be read. The first: {broken[0].reason}"
        )
    _report(notes, progress)
    copies = copies_in(tiles, [_key(tile.path) in named for tile in tiles], progress)
    pairs = [pair for pair in zip(tiles, systems) if pair[0].path not in copies]
    tiles, systems = (list(column) for column in zip(*pairs))
    crs = common_crs(tiles, systems, progress)
    report_twins(tiles, progress)
    survey = Survey(tuple(tiles), tuple(broken), crs, stated, tuple(empty))
    for tile in tiles:
        tile.report_limits(progress)
    report_strays(survey.pieces, progress)
    return survey


def find_files(
    sources: Sources,
    recursive: bool = False,
    progress: Progress = SILENT,
    may_be_none: bool = False,
) -> list[Path]:
    """Return the paths of all point clouds in files, folders (with subfolders if recursive), .vpc
    files, and .txt files with one relative path in each line; sorted, without duplicates.
    """
    paths: dict[str, Path] = {}
    for source in _several(sources):
        for path in _expand(Path(source), recursive, progress):
            paths.setdefault(_key(path), path)
    if not paths and not may_be_none:
        names = ", ".join(map(str, _several(sources))) or "what was given"
        raise BareEarthError(f"No .las, .laz or .copc.laz file is found in {names}.")
    return sorted(paths.values(), key=lambda path: path.as_posix())


def _several(sources: Sources) -> Iterable[str | Path]:
    return (sources,) if isinstance(sources, (str, Path)) else sources


def _key(path: Path) -> str:
    """Return a text that is the same for all paths of a file."""
    return os.path.normcase(path.resolve())


def _expand(source: Path, recursive: bool, progress: Progress) -> Iterator[Path]:
    suffix = source.suffix.lower()
    if source.is_dir():
        for path in source.rglob("*") if recursive else source.iterdir():
            # Hidden files belong to other programs, or are not finished yet.
            is_hidden = path.name.startswith(".")
            # An overview repeats points of other files.
            if is_cloud(path) and not is_hidden and path.is_file() and not is_overview(path):
                yield path
    elif suffix == VPC_SUFFIX:
        paths = read_vpc(source)
        _report_files_elsewhere(source, paths, progress)
        yield from paths
    elif suffix in _LISTS:
        for path in _listed(source):
            if path.suffix.lower() in _LISTS:
                raise BareEarthError(
                    f"{source} lists another list, {path}. List its files instead."
                )
            if not path.exists():
                if any(len(_NUMBER.findall(path.name)) > 2 for path in _listed(source)[:10]):
                    raise _table(source)
                raise BareEarthError(
                    f"{source} lists {path}, which does not exist. A list has the path of a point"
                    " cloud in each line."
                )
            yield from _expand(path, recursive, progress)
    elif is_cloud(source):
        yield source
    elif not source.exists():
        raise BareEarthError(f"{source} does not exist. Check the path.")
    elif suffix in _TABLES:
        raise _table(source)
    else:
        raise BareEarthError(
            f"{source} is neither a point cloud (.las, .laz, .copc.laz) nor a folder, a virtual"
            " point cloud (.vpc) or a list of files (.txt)."
        )


def _table(source: Path) -> BareEarthError:
    return BareEarthError(
        f"{source} is a table, not a point cloud. Convert its points to LAS, such as with txt2las"
        " or CloudCompare (a spreadsheet: save it as CSV first)."
    )


def _report_files_elsewhere(source: Path, paths: list[Path], progress: Progress) -> None:
    """Warn if a virtual point cloud lists files outside its folder and the subfolders."""
    folder = source.parent.resolve()
    elsewhere = [path for path in paths if folder not in path.resolve().parents]
    if elsewhere:
        progress.warning(
            f"{source.name} lists {len(elsewhere)} of its {len(paths)} files outside of its own"
            f" folder. The first is {elsewhere[0].resolve()}."
        )


def is_cloud(path: Path) -> bool:
    """Return whether a path has the suffix of a point cloud."""
    return path.suffix.lower() in _CLOUDS


def _listed(source: Path) -> list[Path]:
    """Return the paths in a text file, without empty lines and lines that begin with #."""
    try:
        lines = read_text(source).splitlines()
    except UnicodeDecodeError:
        raise BareEarthError(f"{source} is not a text file in UTF-8. Save it as one.") from None
    names = [line.strip().strip('"') for line in lines]
    return [source.parent / name for name in names if name and not name.startswith("#")]


def _crs_of(layout: LasFile, notes: Notes) -> Crs:
    """Return the CRS of a file, and note what is wrong with a stated one."""
    # `common_crs` warns of files that state none.
    crs = read_crs(layout)
    if crs != Crs():
        read_crs(layout, notes)
    return crs


def _check_extent(layout: LasFile) -> None:
    """Refuse a header without the extent of the points."""
    lowest, highest = layout.minimum[:2], layout.maximum[:2]
    is_one = layout.states_extent and lowest[0] <= highest[0] and lowest[1] <= highest[1]
    if not is_one or (lowest == highest and layout.count > 1):
        raise no_extent(layout)


def _report(notes: Notes, progress: Progress) -> None:
    """Report equal messages of many files once, with the number of files."""
    for (kind, text), count in Counter(notes.messages).items():
        text = f"{text} (in {count} files)" if count > 1 else text
        (progress.warning if kind == "warning" else progress.info)(text)
