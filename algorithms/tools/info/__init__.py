"""Describes point cloud files, and checks them."""

from __future__ import annotations

import contextlib
import tempfile
from pathlib import Path
from typing import Sequence

import numpy as np

from ...core.errors import BareEarthError
from ...core.files import temporary_folder
from ...core.points import Box
from ...core.progress import SILENT, Progress
from ...crs.matching import named_with_heights
from ...crs.measurable import length_scale
from ...crs.system import Crs
from ...las.crs_records import read_crs
from ...las.extrabytes import dimension_names
from ...las.lasfile import Evlr, LasFile, Vlr
from ...las.opening import NoPoints, open_las
from ...las.reading import require_packages
from ...las.records import read_records
from ...las.return_numbers import FROM_ZERO, begin_at_zero
from ...survey.files import Inputs, find_files
from ...survey.pieces import pieces_of, report_strays
from ...survey.scratch import ScratchArrays
from ..declaration import CRS, FileTool, Input
from .checks import CHECKS, counts_of
from .description import Description, SurveyDescription
from .tally import BYTES_A_POINT, Tally

# Most points whose keys are in memory, where they take 1 GB; more are on disk.
_MOST_IN_MEMORY = 32_000_000
_MOST_RECORDS = 500_000
# What can differ between the files of a survey.
_COMPARED = ("version", "point_format", "scale", "offset", "crs", "extra_dimensions")


def describe(source: Inputs, progress: Progress = SILENT) -> Description | SurveyDescription:
    """Return what files hold, and what is wrong with them, after reading all of their points."""
    if not source.is_survey:
        layout = _opened(source[0], source.stated)
        _report_strays([layout], progress)
        return _described(layout, progress)
    paths = find_files(source, source.recursive)
    files, unreadable = [], {}
    layouts: list[LasFile] = []
    for path, share in zip(paths, progress.shares(*(1.0 for _ in paths))):
        try:
            layouts.append(_opened(path, source.stated))
            files.append(_described(layouts[-1], share.quiet()))
        except BareEarthError as error:
            unreadable[str(path)] = str(error)
    _report_strays(layouts, progress)
    return _of_survey(files, unreadable)


def _report_strays(layouts: Sequence[LasFile], progress: Progress) -> None:
    """Warn of points that lie far from all others, if the files have one unit."""
    filled = [layout for layout in layouts if layout.count and layout.states_extent]
    units = {read_crs(layout).horizontal_unit for layout in filled}
    if len(units) == 1:
        report_strays(pieces_of(filled, units.pop()), progress)


def _opened(path: Path, stated: str | None) -> LasFile:
    try:
        return open_las(path, stated)
    except NoPoints as empty:
        (layout,) = empty.layouts
        return layout


def _described(layout: LasFile, progress: Progress) -> Description:
    """Describe a file, after reading all of its points once."""
    require_packages(layout)
    crs = read_crs(layout, progress)
    with temporary_folder(Path(tempfile.gettempdir())) as folder:
        scratch = ScratchArrays(folder if layout.count > _MOST_IN_MEMORY else None)
        size = BYTES_A_POINT * layout.count
        if not scratch.has_room(size):
            raise BareEarthError(
                f"{layout.path} needs {size / 1e9:.0f} GB on the disk of {folder.parent} while its"
                " points are compared. Free some space there."
            )
        done, reading = 0, progress.part(0.0, 0.7)
        with contextlib.closing(Tally(layout, scratch)) as tally:
            for records in read_records(layout, _MOST_RECORDS) if layout.count else ():
                tally.add(records)
                done += len(records)
                reading(done / layout.count)
            checks = counts_of(layout, crs, tally)
    if begin_at_zero(tally.pulses)[0]:
        progress.warning(FROM_ZERO)
    return _description(layout, crs, tally, checks)


def _description(
    layout: LasFile, crs: Crs, tally: Tally, checks: dict[str, int | None]
) -> Description:
    lowest, highest = _corner(layout, tally.lowest), _corner(layout, tally.highest)
    box = (*lowest[:2], *highest[:2]) if lowest and highest else None
    scale = length_scale(crs, box)
    flags = dict(tally.flags)
    return Description(
        path=str(layout.path),
        file_size=layout.size,
        version=f"1.{layout.minor_version}",
        encoding="COPC" if layout.is_copc else "LAZ" if layout.is_compressed else "uncompressed",
        point_format=layout.point_format,
        point_count=layout.count,
        minimum=lowest,
        maximum=highest,
        scale=layout.scale,
        offset=layout.offset,
        density=_density(layout.count, crs, scale, box) if box else None,
        crs=named_with_heights(crs.name, crs.datum),
        epsg=crs.epsg,
        is_geographic=crs.is_geographic,
        horizontal_unit=crs.horizontal_unit,
        vertical_unit=crs.vertical_unit,
        length_scale=scale,
        classes=_by_value(tally.classes),
        returns=_by_value(tally.pulses.sum(axis=1)),
        withheld=flags.pop("withheld"),
        flags=flags,
        strips=_by_value(tally.strips),
        gps_time=tally.times.found(),
        all_zero=tally.zero if layout.count else [],
        checks=checks,
        extra_dimensions=dimension_names(layout),
        records=[*map(_named, layout.vlrs), *map(_named, layout.evlrs)],
        system_identifier=layout.system_identifier,
        software=layout.software,
    )


def _named(record: Vlr | Evlr) -> str:
    return f"{record.key[0]} {record.key[1]} {record.description}".rstrip()


def _corner(layout: LasFile, whole: np.ndarray) -> tuple[float, float, float] | None:
    """Return x, y and z in units of the CRS; None without points."""
    if not layout.count:
        return None
    x, y, z = (
        int(value) * scale + offset
        for value, scale, offset in zip(whole, layout.scale, layout.offset)
    )
    return x, y, z


def _density(count: int, crs: Crs, scale: float, box: Box) -> float | None:
    west, south, east, north = box
    area = (east - west) * (north - south)
    area *= (crs.horizontal_unit / scale) ** 2
    return None if crs.is_geographic or area <= 0 else count / area


def _by_value(counts: np.ndarray) -> dict[int, int]:
    return {int(value): int(counts[value]) for value in np.flatnonzero(counts)}


def _of_survey(files: Sequence[Description], unreadable: dict[str, str]) -> SurveyDescription:
    """Return what many files have in common, and what differs."""
    texts = {name: [str(getattr(file, name)) for file in files] for name in _COMPARED}
    different = {name: sorted(set(values)) for name, values in texts.items()}
    boxes = [
        (*file.minimum[:2], *file.maximum[:2]) for file in files if file.minimum and file.maximum
    ]
    return SurveyDescription(
        tuple(files),
        unreadable,
        sum(file.point_count for file in files),
        {name: sum(file.checks[name] or 0 for file in files) for name in CHECKS},
        {name: values for name, values in different.items() if len(values) > 1},
        _overlapping(np.array(boxes).reshape(-1, 4)),
    )


def _overlapping(boxes: np.ndarray) -> int:
    """Return how many pairs of boxes overlap by more than a side."""
    pairs, boxes = 0, boxes[np.argsort(boxes[:, 0])]
    for number, (_, south, east, north) in enumerate(boxes):
        others = boxes[number + 1 :]
        others = others[: np.searchsorted(others[:, 0], east)]
        pairs += int(np.count_nonzero((others[:, 1] < north) & (others[:, 3] > south)))
    return pairs


TOOL = FileTool(
    work=describe,
    sets=(),
    inputs=(Input("source", "clouds"), CRS),
    json="",
    about="It counts what cannot be right: double points, impossible return numbers, GPS times and"
    " scan angles, reserved classes, and a header whose box or counts are not those of the points.",
    command="info",
)
