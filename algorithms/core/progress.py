"""Progress and messages of a computation, for a terminal, a QGIS dialog or a test."""

from __future__ import annotations

import time
from itertools import accumulate
from typing import Iterator

# Seconds that a piece of a long step should take. A cancel waits for the end of the piece.
_PIECE_SECONDS = 0.4
# Points of the first piece, whose time is not known.
_FIRST_PIECE = 500_000
# Points of the smallest piece.
_LEAST_PIECE = 100_000


class Progress:
    """Receives the progress and messages of a computation; this base class ignores both.

    A front end derives a class from it and overrides `report`, `info` and `warning`. To cancel,
    `report` raises `Cancelled`. The logging module is not used, because several computations can
    run in threads of one process, each with its own log.
    """

    def __call__(self, fraction: float) -> None:
        """Report that `fraction` (0 to 1) is done. Call this at least once a second.

        Raises
        ------
        Cancelled
            If the user asked to stop.
        """
        self.report(min(max(float(fraction), 0.0), 1.0))

    def report(self, fraction: float) -> None:
        """Show the progress of the whole computation."""

    def info(self, text: str) -> None:
        """Tell the user something useful about the data or the settings."""

    def choice(self, text: str) -> None:
        """Tell the user which setting was chosen automatically."""
        self.info(text)

    def warning(self, text: str) -> None:
        """Tell the user something that may make the result worse than expected."""

    def took(self, stage: str, seconds: float) -> None:
        """Tell how long a stage of the computation took."""

    def part(self, start: float, end: float) -> Progress:
        """Return the progress of a part: its 0 to 1 is `start` to `end` of this one."""
        return _Part(self, start, end)

    def shares(self, *weights: float) -> list[Progress]:
        """Return consecutive parts with lengths in proportion to the weights."""
        ends, whole = list(accumulate(weights)), sum(weights) or 1.0
        return [
            self.part((end - weight) / whole, end / whole) for weight, end in zip(weights, ends)
        ]

    def once(self) -> Progress:
        """Return a progress that passes on each warning only once."""
        return _Once(self)

    def quiet(self) -> Progress:
        """Return a progress that passes on fractions, but drops messages."""
        return _Quiet(self)


class PassingOn(Progress):
    """Passes on progress and messages to another progress; a base class."""

    def __init__(self, whole: Progress) -> None:
        self._whole = whole

    def report(self, fraction: float) -> None:
        """Pass on how much is done."""
        self._whole(fraction)

    def info(self, text: str) -> None:
        """Pass on a message."""
        self._whole.info(text)

    def choice(self, text: str) -> None:
        """Pass on a choice."""
        self._whole.choice(text)

    def warning(self, text: str) -> None:
        """Pass on a warning."""
        self._whole.warning(text)

    def took(self, stage: str, seconds: float) -> None:
        """Pass on how long a stage took."""
        self._whole.took(stage, seconds)


class _Part(PassingOn):
    def __init__(self, whole: Progress, start: float, end: float) -> None:
        super().__init__(whole)
        self._start, self._end = start, end

    def report(self, fraction: float) -> None:
        self._whole(self._start + fraction * (self._end - self._start))


class _Once(PassingOn):
    def __init__(self, whole: Progress) -> None:
        super().__init__(whole)
        self._told: set[str] = set()

    def warning(self, text: str) -> None:
        if text not in self._told:
            self._told.add(text)
            self._whole.warning(text)


class _Quiet(Progress):
    def __init__(self, whole: Progress) -> None:
        self._whole = whole

    def report(self, fraction: float) -> None:
        self._whole(fraction)

    def took(self, stage: str, seconds: float) -> None:
        self._whole.took(stage, seconds)


class Notes(Progress):
    """Stores messages, which are shown later or elsewhere, and passes on fractions."""

    def __init__(self, whole: Progress = Progress()) -> None:
        self._whole = whole
        self.messages: list[tuple[str, str]] = []  # kind (the called method) and text
        self.seconds: dict[str, float] = {}  # by stage, in the order of their first ends

    def report(self, fraction: float) -> None:
        """Pass on how much is done."""
        self._whole(fraction)

    def info(self, text: str) -> None:
        """Store a message."""
        self.keep("info", text)

    def choice(self, text: str) -> None:
        """Store a choice."""
        self.keep("choice", text)

    def warning(self, text: str) -> None:
        """Store a warning."""
        self.keep("warning", text)

    def took(self, stage: str, seconds: float) -> None:
        """Add up how long a stage took."""
        self.seconds[stage] = self.seconds.get(stage, 0.0) + seconds

    def keep(self, kind: str, text: str) -> None:
        """Store a message of any kind."""
        self.messages.append((kind, text))


def paced(count: int, most: int) -> Iterator[slice]:
    """Yield consecutive pieces of a range of points, of at most `most` points; the size of a piece
    follows from the time that the previous one took.
    """
    start, size = 0, _FIRST_PIECE
    while start < count:
        piece = slice(start, min(start + min(size, most), count))
        begun = time.perf_counter()
        yield piece
        took = max(time.perf_counter() - begun, 1e-9)
        fitting = int((piece.stop - start) * _PIECE_SECONDS / took)
        # At most twice as many, in case the last piece was fast by chance.
        start, size = piece.stop, min(max(fitting, _LEAST_PIECE), 2 * size)


SILENT = Progress()
