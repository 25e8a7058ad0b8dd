"""What a command tells: what it does on standard error, what it did on standard output."""

from __future__ import annotations

import argparse
import dataclasses
import json
import sys
from typing import Any

from ..core.errors import printable
from ..core.progress import Progress


class Terminal(Progress):
    """Messages on standard error, and a progress bar where that is a terminal.

    Parameters
    ----------
    verbose : bool
        Whether to tell what is done even if nobody looks on.
    """

    def __init__(self, verbose: bool) -> None:
        self._talks = verbose or sys.stderr.isatty()
        self._bar = _progress_bar() if sys.stderr.isatty() else None

    def report(self, fraction: float) -> None:
        """Move the bar."""
        if self._bar is not None:
            self._bar.update(round(100 * fraction) - self._bar.n)

    def info(self, text: str) -> None:
        """Tell a message to who looks on or asked for it."""
        if self._talks:
            self._write(text)

    def warning(self, text: str) -> None:
        """Tell a warning, whoever listens."""
        self._write(f"Warning: {text}")

    def _write(self, text: str) -> None:
        if self._bar is not None:
            self._bar.clear()
        print(printable(text), file=sys.stderr)

    def __enter__(self) -> Terminal:
        return self

    def __exit__(self, *exception: object) -> None:
        if self._bar is not None:
            self._bar.close()


def _progress_bar() -> Any:
    try:
        from tqdm import tqdm
    except ImportError:
        return None
    layout = "{percentage:3.0f} % |{bar}| {elapsed}"
    return tqdm(total=100, bar_format=layout, leave=False, file=sys.stderr)


def tell(options: argparse.Namespace, summary: Any, text: str) -> None:
    """Print what was done, as JSON if so asked; a sentence only to who looks on.

    Parameters
    ----------
    options : argparse.Namespace
        With `json` and `verbose`.
    summary : object
        A dataclass of what was done.
    text : str
        The sentence.
    """
    if options.json:
        print(json.dumps(dataclasses.asdict(summary)))
    elif options.verbose or sys.stdout.isatty():
        print(text)
