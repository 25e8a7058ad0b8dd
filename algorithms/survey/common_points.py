"""Finds the points that two files have in common."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple, Sequence

import numpy as np

from ..core.errors import BareEarthError
from ..core.progress import Progress
from ..las.cloud import PointCloud
from ..las.lasfile import LasFile
from ..las.opening import open_las
from ..las.reading import read_cloud
from .window import read_window

# Points of a strip: to limit memory, points are compared in strips from west to east.
_STRIP = 1 << 22
# The least share of common points of two files of the same survey.
_LEAST_SHARE = 0.01
# The least share of points at equal places with equal times; if fewer are, times are not compared.
_TRUSTED = 0.5
# Every place that coordinates can have, as a finite box: west, south, east, north.
_EVERYWHERE = (-1e300, -1e300, 1e300, 1e300)


class Matched(NamedTuple):
    """The points that two files have in common, in the same order."""

    clouds: tuple[PointCloud, PointCloud]  # of both files, perhaps without points that one lacks
    # The indices of the common points in each cloud, int64 (n,).
    orders: tuple[slice | np.ndarray, slice | np.ndarray]
    alone: tuple[int, int]  # numbers of points that only the first, or only the second file has


def match_files(first: Path, second: Path, progress: Progress, crs: str | None = None) -> Matched:
    """Find the points that two files have in common, in any order; refuse files with hardly any."""
    # Points are the same if their coordinates, return numbers and GPS times are equal. Times are
    # not compared if a file has none, or if they differ for most points. A point has at most one
    # partner. If the scales of the files differ, coordinates are compared in steps of the coarser
    # scale. One file can be a part of the other, or both can overlap: of the file with more points,
    # only points in the extent of the other file are kept.
    files = open_las(first, crs), open_las(second, crs)
    reading = progress
    # Points of COPC are in another order than those of other files.
    if files[0].count == files[1].count and files[0].is_copc == files[1].is_copc:
        clouds = (
            read_cloud(files[0], progress.part(0.0, 0.2)),
            read_cloud(files[1], progress.part(0.2, 0.4)),
        )
        if _is_same_order(*clouds):
            return Matched(clouds, (slice(None), slice(None)), (0, 0))
        del clouds
        # The messages of reading were reported already.
        reading = progress.part(0.4, 1.0).quiet()
    clouds = _read(files, reading)
    orders = _pairs(clouds, reading.part(0.6, 1.0))
    count = len(orders[0])
    if count < _LEAST_SHARE * min(file.count for file in files) or not count:
        raise BareEarthError(
            f"{first} and {second} do not hold the same points: of {files[0].count:,} and"
            f" {files[1].count:,} points {count:,} are in both. Compare a classified file with its"
            " own reference."
        )
    alone = files[0].count - count, files[1].count - count
    if any(alone):
        progress.info(
            f"{count:,} points are in both files and are compared. {alone[0]:,} points of"
            f" {first.name} and {alone[1]:,} of {second.name} have no partner."
        )
    return Matched(clouds, orders, alone)


def _is_same_order(first: PointCloud, second: PointCloud) -> bool:
    if not (np.allclose(first.scale, second.scale) and np.allclose(first.offset, second.offset)):
        return False
    names = ("x", "y", "z", "return_number")
    return all(np.array_equal(getattr(first, name), getattr(second, name)) for name in names)


def _read(files: tuple[LasFile, LasFile], progress: Progress) -> tuple[PointCloud, PointCloud]:
    """Read the smaller file, and the points of the other file in its extent."""
    small, large = sorted(range(2), key=lambda number: files[number].count)
    has_times = all(file.has_gps_times for file in files)
    first = read_window(files[small], _EVERYWHERE, progress.part(0.0, 0.3), times=has_times)
    scale, offset = np.array(first.scale[:2]), np.array(first.offset[:2])
    more = max(*files[large].scale, *first.scale[:2])
    west, south = (first.lowest * scale + offset - more).tolist()
    east, north = (first.highest * scale + offset + more).tolist()
    box = west, south, east, north
    second = read_window(files[large], box, progress.part(0.3, 0.6), times=has_times)
    return (first, second) if small == 0 else (second, first)


def _pairs(
    clouds: tuple[PointCloud, PointCloud], progress: Progress
) -> tuple[np.ndarray, np.ndarray]:
    """Return the indices of the common points of two clouds, in the order of the first one."""
    origin, scales = clouds[0].offset, zip(*(cloud.scale for cloud in clouds))
    steps = [max(pair) for pair in scales]

    def integers(cloud: PointCloud, axis: int, selected: np.ndarray | slice) -> np.ndarray:
        """Return coordinates of points in whole steps from the origin."""
        metres = (cloud.x, cloud.y, cloud.z)[axis][selected] * cloud.scale[axis]
        start = cloud.offset[axis] - origin[axis]
        return np.rint((metres + start) / steps[axis]).astype(np.int64)

    columns = [integers(cloud, 0, slice(None)) for cloud in clouds]
    most = max(columns, key=len)
    count = max(-(-len(most) // _STRIP), 1)
    inner = np.quantile(most[:: max(len(most) // 100_000, 1)], np.arange(1, count) / count)
    edges = [-np.inf, *inner.tolist(), np.inf]
    times = [cloud.gps_time for cloud in clouds if cloud.gps_time is not None]
    timed, untimed = [], []
    for number, (west, east) in enumerate(zip(edges, edges[1:]), start=1):
        strips = [np.flatnonzero((x >= west) & (x < east)) for x in columns]
        keys = [
            [*(integers(cloud, axis, strip) for axis in range(3)), cloud.return_number[strip]]
            for cloud, strip in zip(clouds, strips)
        ]
        untimed.append(_equal(strips, keys))
        if len(times) == 2:
            for key, time, strip in zip(keys, times, strips):
                key.append(time[strip].view(np.int64))
            timed.append(_equal(strips, keys))
        progress(number / count)
    # If the times of a file were changed, few points have equal times.
    with_times, without = (sum(len(first) for first, _ in pairs) for pairs in (timed, untimed))
    use_times = timed and with_times >= _TRUSTED * without
    first, second = map(np.concatenate, zip(*(timed if use_times else untimed)))
    order = np.argsort(first, kind="stable")
    return first[order], second[order]


def _equal(
    numbers: Sequence[np.ndarray], keys: Sequence[Sequence[np.ndarray]]
) -> tuple[np.ndarray, np.ndarray]:
    """Return the numbers of equal rows of two tables, (k,) each, given the columns of the tables;
    several equal rows are paired in order, and no row is used twice.
    """
    columns = [np.concatenate(pair) for pair in zip(*keys)]
    if not len(columns[0]):
        return numbers[0], numbers[1]
    # A stable sort keeps equal rows in order, rows of the first table before those of the second.
    order = np.lexsort(columns[::-1])
    is_new = np.ones(len(order), dtype=bool)
    is_new[1:] = np.any([column[order][1:] != column[order][:-1] for column in columns], axis=0)
    group, is_first = np.cumsum(is_new) - 1, order < len(numbers[0])
    counts = [np.bincount(group[side], minlength=group[-1] + 1) for side in (is_first, ~is_first)]
    rank = np.arange(len(order)) - np.flatnonzero(is_new)[group]
    rank[~is_first] -= counts[0][group[~is_first]]
    used = rank < np.minimum(*counts)[group]
    of_all = np.concatenate(numbers)[order]
    return of_all[used & is_first], of_all[used & ~is_first]
