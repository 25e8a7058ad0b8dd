"""Tell low banks from plants, walls and cars by their cross-section, measured in strips."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

# Width in metres of a cross-section on each side, and of the ground that is measured beside a bank.
_HALF, _BESIDE = 6.0, 2.0
# Least share of a step's points that stand out, on a bank and at its crest.
_RAISED, _CREST = 0.5, 0.7
# In metres: the largest height of a bank, the height above the ground at which its width is
# measured, and the least and largest width.
_HIGHEST, _FOOT_HEIGHT, _NARROWEST, _WIDEST = 1.6, 0.1, 1.0, 6.0
# Largest standard deviation of the points from the cross-section: in metres, or for each metre of
# the bank's height, whichever is more. The last is added for each unit of slope (rise over run),
# because the middle line is not exact.
_SCATTER, _SCATTER_HEIGHT, _SCATTER_SLOPE = 0.06, 0.1, 0.12
# The same at the crest: in metres, or as a multiple of that of the ground beside the bank.
_CREST_SCATTER, _CREST_FACTOR = 0.05, 2.0
# Points more than so many metres above the cross-section are plants; how often these are removed;
# and the most plants for each other point.
_PLANT, _TRIMS, _MOST_PLANTS = 0.25, 2, 0.2
# On its gentler side a bank rises by at most so many metres within half a metre.
_RISE, _RISE_LENGTH = 0.6, 0.5
# Points within so many metres of the cross-section belong to the bank.
_NEAR = 0.15


class Strip(NamedTuple):
    """Points of squares, along and across the middle line of each; arrays of shape (n,).

    Attributes
    ----------
    square : numpy.ndarray of int
        The square of each point, numbered from 0.
    along, across, z : numpy.ndarray of float64
        Metres.
    stands_out : numpy.ndarray of bool
        Which points stand out of the ground.
    number : int
        Number of squares.
    """

    square: np.ndarray
    along: np.ndarray
    across: np.ndarray
    z: np.ndarray
    stands_out: np.ndarray
    number: int

    def take(self, which: np.ndarray) -> Strip:
        """Return the selected points of the same squares."""
        square, along, across, z, stands_out = (each[which] for each in self[:5])
        return Strip(square, along, across, z, stands_out, self.number)

    def total(self, weights: np.ndarray) -> np.ndarray:
        """Return the sum of weights over each square."""
        return np.bincount(self.square, weights, self.number)


def on_banks(strip: Strip, length: float) -> np.ndarray:
    """Return which points of squares lie on a bank.

    Parameters
    ----------
    strip : Strip
        The points.
    length : float
        Length in metres of a step of a cross-section.

    Returns
    -------
    numpy.ndarray of bool, shape (n,)
        Only points that stand out are on a bank.
    """
    kept = np.ones(len(strip.square), dtype=bool)
    for _ in range(_TRIMS):
        kept &= ~strip.stands_out | (_sections(strip, kept, length).rest <= _PLANT)
    sections = _sections(strip, kept, length)
    raised = sections.share >= _RAISED
    body = raised.copy()
    body[:, 1:] |= raised[:, :-1]
    body[:, :-1] |= raised[:, 1:]
    with np.errstate(invalid="ignore", divide="ignore"):
        is_bank = _is_bank(sections, raised, body, length)
    step, square = sections.step, strip.square
    near = _NEAR + _SCATTER_SLOPE * np.abs(sections.slope.ravel()[step])
    on_body = strip.stands_out & body.ravel()[step] & (np.abs(sections.rest) <= near)
    return is_bank[square] & on_body


class _Sections(NamedTuple):
    """Cross-sections of squares.

    Attributes
    ----------
    step : numpy.ndarray of int, shape (n,)
        The step of each point, in the flattened grids.
    rest : numpy.ndarray of float64, shape (n,)
        Height of each point above the cross-section in metres.
    points, plants : numpy.ndarray of float64, shape (squares, steps)
        Numbers of points that were kept, and of plants.
    across, height, slope, scatter : numpy.ndarray of float64, shape (squares, steps)
        Mean place and mean height in metres, slope (rise over run), and the sum of the squares of
        `rest`.
    share : numpy.ndarray of float64, shape (squares, steps)
        Share of the points that stand out.
    """

    step: np.ndarray
    rest: np.ndarray
    points: np.ndarray
    plants: np.ndarray
    across: np.ndarray
    height: np.ndarray
    slope: np.ndarray
    scatter: np.ndarray
    share: np.ndarray


def _sections(strip: Strip, kept: np.ndarray, length: float) -> _Sections:
    """Return the cross-section of each square from the points that are kept; NaN at empty steps."""
    half = int(_HALF / length)
    steps = 2 * half + 1
    step = np.clip(np.rint(strip.across / length).astype(np.int64) + half, 0, steps - 1)
    step += strip.square * steps

    def total(weights: np.ndarray) -> np.ndarray:
        return np.bincount(step, weights, strip.number * steps)

    count = total(kept)
    with np.errstate(invalid="ignore", divide="ignore"):
        along, across, z = (total(np.where(kept, each, 0.0)) / count for each in strip[1:4])
        # The fall of the land along the line is removed.
        beyond = np.where(kept, strip.along - along[step], 0.0)
        fall = strip.total(beyond * strip.z) / strip.total(beyond * beyond)
        height = (z - np.repeat(fall, steps) * along).reshape(-1, steps)
        across = across.reshape(-1, steps)
        slope = np.zeros(height.shape)
        slope[:, 1:-1] = (height[:, 2:] - height[:, :-2]) / (across[:, 2:] - across[:, :-2])
        slope = np.nan_to_num(slope)
        share = (total(kept & strip.stands_out) / count).reshape(height.shape)
    rest = strip.z - fall[strip.square] * strip.along - height.ravel()[step]
    rest -= slope.ravel()[step] * (strip.across - across.ravel()[step])
    scatter = total(np.where(kept, rest * rest, 0.0)).reshape(height.shape)
    count, plants = (each.reshape(height.shape) for each in (count, total(~kept)))
    return _Sections(step, rest, count, plants, across, height, slope, scatter, share)


def _is_bank(
    sections: _Sections, raised: np.ndarray, body: np.ndarray, length: float
) -> np.ndarray:
    """Return which cross-sections are banks."""
    steps = np.arange(raised.shape[1])
    first = np.argmax(raised, axis=1)[:, None]
    last = steps[-1] - np.argmax(raised[:, ::-1], axis=1)[:, None]
    beside, known = round(_BESIDE / length), sections.points > 0
    left = known & (steps < first) & (steps >= first - beside)
    right = known & (steps > last) & (steps <= last + beside)
    ground = sections.points * (1.0 - np.nan_to_num(sections.share))
    left_height, right_height = (
        np.sum(np.where(side, sections.height * ground, 0.0), axis=1)
        / np.sum(np.where(side, ground, 0.0), axis=1)
        for side in (left, right)
    )
    left_across, right_across = (
        np.sum(np.where(side, sections.across, 0.0), axis=1) / np.count_nonzero(side, axis=1)
        for side in (left, right)
    )
    fall = (right_height - left_height) / (right_across - left_across)
    line = left_height[:, None] + fall[:, None] * (sections.across - left_across[:, None])
    within = left | right | ((steps >= first) & (steps <= last))
    foot = np.count_nonzero(within & (sections.height - line > _FOOT_HEIGHT), axis=1) * length
    heights = np.where(raised, sections.height, -np.inf)
    top = heights.max(axis=1) - np.minimum(left_height, right_height)
    crest_share = np.where(raised & (sections.points >= 3), sections.share, 0.0).max(axis=1)
    has_shape = (foot >= _NARROWEST) & (foot <= _WIDEST) & (top <= _HIGHEST)
    has_shape &= (crest_share >= _CREST) & raised.any(axis=1)
    has_shape &= _gentler_rise(sections, body, heights, length) <= _RISE / _RISE_LENGTH
    return has_shape & _is_smooth(sections, body, heights, left | right, top)


def _gentler_rise(
    sections: _Sections, body: np.ndarray, heights: np.ndarray, length: float
) -> np.ndarray:
    """Return the steepest rise over run on the gentler side of the crest."""
    apart = max(1, round(_RISE_LENGTH / length))
    crest = np.argmax(heights, axis=1)[:, None]
    start = np.arange(body.shape[1] - apart)
    rise = sections.height[:, apart:] - sections.height[:, :-apart]
    slope = np.abs(rise) / (sections.across[:, apart:] - sections.across[:, :-apart])
    slope = np.where(body[:, apart:] & body[:, :-apart], np.nan_to_num(slope), 0.0)
    before, beyond = start + apart - apart // 2 <= crest, start + apart // 2 >= crest
    return np.minimum(
        np.where(before, slope, 0).max(axis=1), np.where(beyond, slope, 0).max(axis=1)
    )


def _is_smooth(
    sections: _Sections, body: np.ndarray, heights: np.ndarray, beside: np.ndarray, top: np.ndarray
) -> np.ndarray:
    """Return which cross-sections have points that scatter no more than points of the ground."""
    count, scatter = sections.points, sections.scatter
    total = np.sum(np.where(body, count, 0), axis=1)
    is_bare = np.sum(np.where(body, sections.plants, 0), axis=1) <= _MOST_PLANTS * total
    slope = np.sum(np.where(body, np.abs(sections.slope) * count, 0.0), axis=1) / total
    # A step with one point has no scatter.
    freedom = np.sum(np.where(body, np.maximum(count - 1, 0), 0), axis=1)
    whole = np.sqrt(np.sum(np.where(body, scatter, 0.0), axis=1) / freedom)
    is_smooth = whole <= np.maximum(_SCATTER, _SCATTER_HEIGHT * top) + _SCATTER_SLOPE * slope
    crest = np.argmax(np.where(count >= 3, heights, -np.inf), axis=1)[:, None]
    at_crest = (np.take_along_axis(each, crest, axis=1)[:, 0] for each in (scatter, count))
    squares, number = at_crest
    bare = beside & (sections.share < 0.2)
    ground = np.sqrt(
        np.sum(np.where(bare, scatter, 0.0), axis=1) / np.sum(np.where(bare, count, 0), axis=1)
    )
    most = np.fmax(_CREST_SCATTER, _CREST_FACTOR * ground)
    return is_smooth & is_bare & (np.sqrt(squares / (number - 1)) <= most)
