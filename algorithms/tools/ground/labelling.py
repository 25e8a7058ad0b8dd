"""Finds the ground in a block of a survey."""

from __future__ import annotations

import collections
from enum import IntEnum
from functools import partial
from typing import Callable

import numpy as np

from ...classes.selection import Selection
from ...core.errors import BareEarthError
from ...core.parameters import ParameterSet
from ...core.points import Box, Points
from ...core.progress import Notes, Progress
from ...core.words import counted
from ...engine.blocks import Blocks, Visit
from ...engine.store import BlockPoints
from ...filters import method_of
from ...filters.method import warn_of_extent, warn_of_little_ground
from ...filters.stages.noise import UNTHINNED
from ...filters.stages.outliers import below_ground
from ...grids.bridge_decks import bridge_decks
from ...grids.cells import Cells, keep_spacing
from ...grids.continued_ground import CONTINUED, continued_ground
from ...grids.high_groups import HighGroups
from ...grids.parts import apart
from ...las.return_numbers import MULTI_RETURN

# Shares of the time of a block for finding bridges, and low outliers.
_BRIDGES_SHARE = 0.15
_LOW_SHARE = 0.1
# A box that contains all points.
_EVERYWHERE = (-np.inf, -np.inf, np.inf, np.inf)
# Metres from a block up to which all points are used: no rule counts points that are farther away.
# Points beyond only show the surface, for which the lowest of them are enough. This saves time and
# memory where points are dense.
_NEAR = 40.0
# The flag of points in places where a person saw ground.
TO_CONTINUE = "to continue"
# Side in metres of the cells of whose points only the lowest is used farther away. The cells of the
# filters are made of such cells, so that their lowest points stay.
_CELL = 0.5


class Label(IntEnum):
    """The result for a point; 0 is anything else."""

    GROUND = 1
    LOW = 2
    BRIDGE = 3
    HIGH = 4


def reach_of(parameters: ParameterSet, continues: bool = False) -> float:
    """Return how far points matter to a method in metres, if it then `continues` its ground."""
    return method_of(parameters).reach(parameters) + (CONTINUED if continues else 0.0)


def blocks_of(parameters: ParameterSet, continues: bool = False) -> Blocks:
    """Return the blocks in which a method filters a survey, and perhaps `continues` its ground."""
    return Blocks.of(reach_of(parameters, continues))


def labelled(
    visit: Visit,
    parameters: ParameterSet,
    selection: Selection,
    progress: Progress,
) -> tuple[np.ndarray, np.ndarray, BlockMessages]:
    """Return the positions of the points of a block, their `Label` or 0, and the messages."""
    west, south, east, north = (
        side - start for side, start in zip(visit.block.box, visit.corner * 2)
    )
    # Classic presets do what another program does with all points.
    is_classic = method_of(parameters).is_classic(parameters)
    box = _EVERYWHERE if is_classic else near((west, south, east, north))
    contents = thinned(visit.contents(progress.part(0.0, 0.15)), box)
    core = visit.core(contents)
    positions = contents.positions if core.all() else contents.positions[core]
    notes = BlockMessages(progress.part(0.15, 1.0), len(positions), visit.is_only)
    labels = np.zeros(len(positions), dtype=np.uint8)
    if notes.count:
        label = partial(_label, parameters, selection, box)
        try:
            found = _labels(contents, core, label, visit.blocks.buffer, notes)
            if TO_CONTINUE in contents.flags:
                report_spacing(contents.points, box)
                notes.continued = _continue(contents, core, found)
            labels = found if core.all() else found[core]
        except BareEarthError as error:
            notes.failure = error
    return positions, labels, notes


def _label(
    parameters: ParameterSet,
    selection: Selection,
    box: Box,
    contents: BlockPoints,
    progress: Progress,
) -> np.ndarray:
    """Return the label of each point; `contents` are all points in the box and some round it."""
    method, finds_low = method_of(parameters), selection.low_noise_class
    end = 1.0 - _LOW_SHARE if finds_low else 1.0
    finds_bridges = selection.bridges == "find" or (
        selection.bridges == "automatic" and not method.is_classic(parameters)
    )
    part = progress.part(0.0, end - _BRIDGES_SHARE if finds_bridges else end)
    points, known = contents.points, contents.known
    if points.count == 1:
        # A single point cannot be compared with others, and there can be many such groups.
        return np.array([Label.GROUND], dtype=np.uint8)
    report_spacing(points, box)
    warn_of_extent(points, *method.largest(parameters), progress)
    ground, outliers, _ = method.ground(
        points, parameters, part, known, contents.flags[MULTI_RETURN]
    )
    ground |= known
    warn_of_little_ground(points, ground, progress)
    labels = ground.astype(np.uint8)
    if finds_bridges:
        decks = bridge_decks(points, ground) & ~known
        labels[decks] = Label.BRIDGE
        ground &= ~decks
        progress(end)
    if finds_low:
        low = below_ground(points, ground, selection.low_noise_depth, progress.part(end, 1.0))
        if outliers is not None:
            low |= outliers
        labels[low & (labels == 0)] = Label.LOW
    if selection.high_noise_class:
        high = HighGroups(height=selection.high_noise_height).find(points)
        labels[high & (labels == 0)] = Label.HIGH
    return labels


def _continue(contents: BlockPoints, core: np.ndarray, labels: np.ndarray) -> int:
    """Label the points that continue the ground in places where a person saw ground; return how
    many of them lie in the core.
    """
    inside = contents.flags[TO_CONTINUE] & contents.wanted & (labels == 0)
    more = continued_ground(contents.points, labels == Label.GROUND, inside)
    labels[more] = Label.GROUND
    return int(np.count_nonzero(more & core))


def _labels(
    contents: BlockPoints,
    wanted: np.ndarray,
    label: Callable[[BlockPoints, Progress], np.ndarray],
    reach: float,
    progress: Progress,
) -> np.ndarray:
    """Return the label of each wanted point of a window."""
    # Groups of points that are farther apart than the reach of the filter do not affect each other,
    # and are filtered separately. Otherwise a stray point would extend the grid of all others.
    groups, count = apart(contents.points, reach)
    progress(0.1)
    progress = progress.part(0.1, 1.0)
    if count == 1:
        return label(contents, progress)
    sizes = np.bincount(groups, minlength=count)
    labels, failures, done = np.zeros(len(groups), dtype=np.uint8), [], 0
    needed = np.flatnonzero(np.bincount(groups[wanted], minlength=count))
    for group in needed[np.argsort(-sizes[needed], kind="stable")].tolist():
        members, end = np.flatnonzero(groups == group), done + int(sizes[group])
        part = progress.part(done / len(groups), end / len(groups))
        try:
            # Messages are those of the largest group.
            labels[members] = label(contents.take(members), part.quiet() if done else part)
        except BareEarthError as error:
            failures.append(error)
        done = end
    if len(failures) == len(needed):
        raise failures[0]
    return labels


class BlockMessages(Notes):
    """Passes on the progress of a block, and collects its messages until all blocks are done."""

    def __init__(self, whole: Progress, count: int, is_only: bool) -> None:
        super().__init__(whole)
        self._is_only, self.count = is_only, count  # points to label in the block
        self.failure: BareEarthError | None = None  # why the block has no ground
        self.continued = 0  # points that became ground by the answers of a person

    def keep(self, kind: str, text: str) -> None:
        """Keep a message, or pass it on at once if there is only one block."""
        if self._is_only:
            getattr(self._whole, kind)(text)
        else:
            super().keep(kind, text)


def report_notes(progress: Progress, blocks: list[BlockMessages]) -> None:
    """Report each message of the blocks once, and the number of blocks that failed."""
    failed = [block for block in blocks if block.failure is not None]
    failures = [block.failure for block in blocks if block.failure is not None]
    if failures and len(failures) == len(blocks):
        raise failures[0]
    messages = collections.Counter(m for block in blocks for m in dict.fromkeys(block.messages))
    for block in blocks:
        for stage, seconds in block.seconds.items():
            progress.took(stage, seconds)
    for (kind, text), count in messages.items():
        if count < len(blocks):
            text = f"{text.rstrip('.')} (in {count} of {len(blocks)} blocks)."
        getattr(progress, kind)(text)
    if failed:
        progress.warning(
            f"No ground was found in {len(failed)} of {len(blocks)} blocks: their"
            f" {sum(block.count for block in failed):,} points are not ground. {failed[0].failure}"
        )


def report_continued(count: int, progress: Progress) -> None:
    """Report how many points became ground by answers, or warn if no point did."""
    if count:
        words = "point continues the ground", "points continue the ground"
        progress.info(f"{counted(count, *words)} in places with the answer 'ground'.")
    else:
        progress.warning(
            "The answer 'ground' changes nothing: no point in these places continues the ground"
            " without a step. Where all points of a place are ground, give it the class 2 instead."
        )


def near(box: Box) -> Box:
    """Return the box round a block in which all points are used."""
    west, south, east, north = box
    return west - _NEAR, south - _NEAR, east + _NEAR, north + _NEAR


def thinned(contents: BlockPoints, box: Box) -> BlockPoints:
    """Return the points of a block and its buffer, without most of those far from a `near` box."""
    if not contents.points.count or contents.points.are_within(box):
        return contents
    stays = contents.points.within(box)
    # One side after the other, since a grid of all sides would have many empty cells in the middle.
    west, south, east, north = box
    x, y = contents.points.x, contents.points.y
    beside = (y >= south) & (y < north)
    for side in (y < south, y >= north, beside & (x < west), beside & (x >= east)):
        far = np.flatnonzero(side)
        if len(far):
            strip = contents.points.take(far)
            stays[far[Cells.over(strip, _CELL).lowest_points(strip)]] = True
    stays |= contents.known
    return contents.take(stays)


def report_spacing(points: Points, box: Box) -> None:
    """Give points the spacing and the noise of those in a box, which are not thinned."""
    if points.are_within(box):
        return
    inside = points.within(box)
    if inside.any():
        keep_spacing(points, points.take(inside))
        points.found[UNTHINNED] = box
