"""The drawing of a profile on an HTML page: points in classes, a line on a band, and axes."""

from __future__ import annotations

from typing import Callable, Mapping, NamedTuple, Sequence, Tuple

import numpy as np

from .page import Html, text

_WIDTH = 800
_HEIGHT = 240
_LEFT = 64  # for the labels of heights
_BELOW = 46
_TICKS = 5  # on each axis, about
_ROOM = 0.06  # share of the height that is free above and below


# Returns places in the drawing for distances and heights.
_Place = Callable[[np.ndarray, np.ndarray], Tuple[np.ndarray, np.ndarray]]


class ChartLine(NamedTuple):
    """A line with a band round it, in the units of the axes; NaN for gaps."""

    along: np.ndarray
    heights: np.ndarray
    below: np.ndarray  # the lower and the upper side of the band
    above: np.ndarray
    colours: tuple[str, str]  # of line and band


class Dots(NamedTuple):
    """Points of one colour."""

    along: np.ndarray
    heights: np.ndarray
    colour: str


def profile_chart(
    name: str,
    line: ChartLine,
    dots: Sequence[Dots],
    units: tuple[str, str],
    ends: Mapping[str, str],
) -> Html:
    """Return a chart with distances along and heights up, in units that the axes name; `ends` are
    words below the left and the right end.
    """
    every = [line.heights, line.below, line.above, *(some.heights for some in dots)]
    known = np.concatenate([heights[np.isfinite(heights)] for heights in every])
    if not len(known):
        return Html("")
    room = _ROOM * max(float(np.ptp(known)), 0.1)
    low, high = float(known.min()) - room, float(known.max()) + room
    length = float(line.along[-1]) or 1.0

    def place(along: np.ndarray, heights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        return along / length * _WIDTH, _HEIGHT * (high - heights) / (high - low)

    parts = [_axes(length, (low, high), units, ends)]
    parts += [_band(line, place), *(_dots(some, place) for some in dots)]
    x, y = place(line.along, line.heights)
    path = "".join(_path(x[part], y[part]) for part in _runs(np.isfinite(y)))
    parts.append(f'<path d="{path}" fill="none" stroke="{line.colours[0]}" stroke-width="2"/>')
    box = f"{-_LEFT} -24 {_WIDTH + _LEFT + 24} {_HEIGHT + _BELOW + 24}"
    return Html(
        f'<svg viewBox="{box}" role="img"\n aria-label="{text(name)}">{"".join(parts)}</svg>'
    )


def _axes(
    length: float, heights: tuple[float, float], units: tuple[str, str], ends: Mapping[str, str]
) -> str:
    """Return both axes with ticks and units."""
    low, high = heights
    across, up = units
    lines, labels = [f'<path d="M0 0V{_HEIGHT}H{_WIDTH}" fill="none" stroke="#555"/>'], []
    for value in _ticks(0.0, length):
        x = value / length * _WIDTH
        lines.append(f'<path d="M{x:.1f} {_HEIGHT}v5" stroke="#555"/>')
        labels.append(_label(x, _HEIGHT + 19, "middle", f"{value:g}"))
    for value in _ticks(low, high):
        y = _HEIGHT * (high - value) / (high - low)
        lines.append(f'<path d="M-5 {y:.1f}H{_WIDTH}" stroke="#e4e4e4"/>')
        labels.append(_label(-9, y + 4, "end", f"{value:g}"))
    labels.append(_label(0, -9, "end", f"height, {up}"))
    labels.append(_label(_WIDTH / 2, _HEIGHT + 38, "middle", f"along the line, {across}"))
    labels.append(_label(0, _HEIGHT + 38, "start", ends.get("left", "")))
    labels.append(_label(_WIDTH, _HEIGHT + 38, "end", ends.get("right", "")))
    return f'{"".join(lines)}<g font-size="12" fill="#333">{"".join(labels)}</g>'


def _ticks(low: float, high: float) -> list[float]:
    """Return round values between two others."""
    rough = (high - low) / _TICKS
    power = 10.0 ** np.floor(np.log10(rough))
    step = next(power * one for one in (1, 2, 5, 10) if power * one >= rough * (1 - 1e-9))
    first = int(np.ceil(low / step - 1e-9))
    return [round(number * step, 9) for number in range(first, int(high / step + 1e-9) + 1)]


def _band(line: ChartLine, place: _Place) -> str:
    """Return the band round a line."""
    x, lower = place(line.along, line.below)
    _, upper = place(line.along, line.above)
    area = ""
    for part in _runs(np.isfinite(lower + upper)):
        there = np.concatenate((x[part], x[part][::-1]))
        area += _path(there, np.concatenate((upper[part], lower[part][::-1]))) + "Z"
    return f'<path d="{area}" fill="{line.colours[1]}" fill-opacity="0.3"/>'


def _dots(some: Dots, place: _Place) -> str:
    """Return points, those at the same spot once, as short strokes with round ends."""
    spots = np.rint(np.column_stack(place(some.along, some.heights))).astype(np.int64)
    path = "".join(f"M{x} {y}h.1" for x, y in np.unique(spots, axis=0).tolist())
    return (
        f'<path d="{path}" stroke="{some.colour}" stroke-width="3" stroke-linecap="round"'
        ' fill="none"/>'
    )


def _runs(known: np.ndarray) -> list[slice]:
    """Return the runs of values that are known."""
    ends = np.flatnonzero(np.diff(np.concatenate(([False], known, [False]))))
    return [slice(start, end) for start, end in ends.reshape(-1, 2).tolist()]


def _path(x: np.ndarray, y: np.ndarray) -> str:
    return "M" + "L".join(f"{a:.1f} {b:.1f}" for a, b in zip(x.tolist(), y.tolist()))


def _label(x: float, y: float, anchor: str, words: str) -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{text(words)}</text>'
