"""How a long computation talks to whoever called it: a terminal, a QGIS dialog or a test."""

from __future__ import annotations

import time
from itertools import accumulate
from typing import Iterator

# Seconds that a piece of a long step is to take: a cancel waits for its end.
_PIECE_SECONDS = 0.4
_FIRST_PIECE, _LEAST_PIECE = 500_000, 100_000


class Progress:
    """Receives how far a computation is and what it noticed; this base class ignores both.

    A front end subclasses it and overrides `report`, `info` and `warning`. To cancel, `report`
    raises `Cancelled`. An object is used instead of the logging module because several computations
    may run in threads of one process, each with a log of its own.
    """

    def __call__(self, fraction: float) -> None:
        """Say that `fraction` (0 to 1) is done; call it at least once a second.

        Raises
        ------
        Cancelled
            If the user asked to stop.
        """
        self.report(min(max(float(fraction), 0.0), 1.0))

    def report(self, fraction: float) -> None:
        """Show how far the whole computation is."""

    def info(self, text: str) -> None:
        """Tell the user something worth knowing about the data or the choices made."""

    def choice(self, text: str) -> None:
        """Tell the user what was chosen for the data at hand, where nothing was asked for."""
        self.info(text)

    def warning(self, text: str) -> None:
        """Tell the user something that may make the result worse than expected."""

    def part(self, start: float, end: float) -> Progress:
        """Return a progress whose 0 to 1 is the range `start` to `end` of this one."""
        return _Part(self, start, end)

    def shares(self, *weights: float) -> list[Progress]:
        """Return parts that follow each other, as long as their weights; 0 for what is left out."""
        ends, whole = list(accumulate(weights)), sum(weights) or 1.0
        return [
            self.part((end - weight) / whole, end / whole) for weight, end in zip(weights, ends)
        ]

    def quiet(self) -> Progress:
        """Return one that passes on how far it is, and no messages: they are told elsewhere."""
        return _Quiet(self)


class _Part(Progress):
    def __init__(self, whole: Progress, start: float, end: float) -> None:
        self._whole, self._start, self._end = whole, start, end

    def report(self, fraction: float) -> None:
        self._whole(self._start + fraction * (self._end - self._start))

    def info(self, text: str) -> None:
        self._whole.info(text)

    def choice(self, text: str) -> None:
        self._whole.choice(text)

    def warning(self, text: str) -> None:
        self._whole.warning(text)


class _Quiet(Progress):
    def __init__(self, whole: Progress) -> None:
        self._whole = whole

    def report(self, fraction: float) -> None:
        self._whole(fraction)


class Notes(Progress):
    """Keeps messages, to be told later or elsewhere.

    Attributes
    ----------
    messages : list of tuple of str
        Kind (the name of the method that was called) and text of each.
    """

    def __init__(self) -> None:
        self.messages: list[tuple[str, str]] = []

    def info(self, text: str) -> None:
        """Keep it."""
        self.keep("info", text)

    def choice(self, text: str) -> None:
        """Keep it."""
        self.keep("choice", text)

    def warning(self, text: str) -> None:
        """Keep it."""
        self.keep("warning", text)

    def keep(self, kind: str, text: str) -> None:
        """Keep a message."""
        self.messages.append((kind, text))


def paced(count: int, most: int) -> Iterator[slice]:
    """Yield the pieces of a range, each as long as the pace of the last one lets it be.

    Parameters
    ----------
    count : int
        Length of the range, in points.
    most : int
        No piece is longer.
    """
    start, size = 0, _FIRST_PIECE
    while start < count:
        piece = slice(start, min(start + min(size, most), count))
        begun = time.perf_counter()
        yield piece
        took = max(time.perf_counter() - begun, 1e-9)
        fitting = int((piece.stop - start) * _PIECE_SECONDS / took)
        # At most twice as many: the first ones may have been quick for once.
        start, size = piece.stop, min(max(fitting, _LEAST_PIECE), 2 * size)


SILENT = Progress()
