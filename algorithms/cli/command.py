"""What a command of `bare-earth` is."""

from __future__ import annotations

import argparse
from typing import Callable, NamedTuple, Sequence

# Exit codes.
DONE, FAILED, USAGE = 0, 1, 2


class Command(NamedTuple):
    """One command.

    Attributes
    ----------
    name : str
        As it is typed.
    help, description : str
        What it does: in a line, and in one or two sentences.
    add : callable
        ``add(parser, arguments)`` adds its options to a parser; `arguments` is the whole command
        line, for what to offer may depend on it.
    run : callable
        ``run(options)`` does it and returns the exit code.
    """

    name: str
    help: str
    description: str
    add: Callable[[argparse.ArgumentParser, Sequence[str]], None]
    run: Callable[[argparse.Namespace], int]
