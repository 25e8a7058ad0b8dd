"""A command of `bare-earth`."""

from __future__ import annotations

import argparse
from typing import Callable, NamedTuple, Sequence

# Exit codes.
DONE, FAILED, USAGE = 0, 1, 2


class Command(NamedTuple):
    """One command."""

    name: str
    help: str  # one line
    description: str  # one or two sentences; empty if `add` sets it
    # adds options to a parser; they can depend on the whole command line
    add: Callable[[argparse.ArgumentParser, Sequence[str]], None]
    run: Callable[[argparse.Namespace], int]  # returns the exit code
