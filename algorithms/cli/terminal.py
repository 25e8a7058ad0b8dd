"""Output of commands: messages on standard error, results on standard output."""

from __future__ import annotations

import argparse
import dataclasses
import json
import sys
from typing import Any

from ..core.errors import printable
from ..core.progress import Progress


class Terminal(Progress):
    """Shows messages on standard error, without `verbose` only warnings unless it is a terminal,
    where there is also a progress bar.
    """

    def __init__(self, verbose: bool) -> None:
        self._talks = verbose or sys.stderr.isatty()
        self._seconds: dict[str, float] | None = {} if verbose else None
        self._bar = _progress_bar() if sys.stderr.isatty() else None

    def report(self, fraction: float) -> None:
        """Move the bar."""
        if self._bar is not None:
            self._bar.update(round(100 * fraction) - self._bar.n)

    def info(self, text: str) -> None:
        """Show a message, in a terminal or if the user asked for it."""
        if self._talks:
            self._write(text)

    def warning(self, text: str) -> None:
        """Show a warning, in any case."""
        self._write(f"Warning: {text}")

    def took(self, stage: str, seconds: float) -> None:
        """Add up how long a stage took; the sums are shown at the end, if the user asked for it."""
        if self._seconds is not None:
            self._seconds[stage] = self._seconds.get(stage, 0.0) + seconds

    def _write(self, text: str) -> None:
        if self._bar is not None:
            self._bar.clear()
        print(printable(text), file=sys.stderr)

    def __enter__(self) -> Terminal:
        return self

    def __exit__(self, *exception: object) -> None:
        if self._bar is not None:
            self._bar.close()
        if self._seconds and exception[0] is None:
            stages = ", ".join(f"{name} {took:.2f}" for name, took in self._seconds.items())
            print(f"Seconds by stage: {stages}.", file=sys.stderr)


def _progress_bar() -> Any:
    try:
        from tqdm import tqdm
    except ImportError:
        return None
    layout = "{percentage:3.0f} % |{bar}| {elapsed}"
    return tqdm(total=100, bar_format=layout, leave=False, file=sys.stderr)


def report(options: argparse.Namespace, summary: Any, text: str, always: bool = False) -> None:
    """Print the result as JSON, or in words: in a terminal, with `verbose`, or with `always`."""
    if options.json:
        is_own = hasattr(summary, "as_dict")
        print(json.dumps(summary.as_dict() if is_own else dataclasses.asdict(summary)))
    elif always or options.verbose or sys.stdout.isatty():
        print(text)
