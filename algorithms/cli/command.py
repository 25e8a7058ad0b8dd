"""A command of `bare-earth`."""

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
        Its name in the command line.
    help, description : str
        What it does: in one line, and in one or two sentences.
    add : callable
        ``add(parser, arguments)`` adds its options to a parser. They can depend on `arguments`, the
        whole command line.
    run : callable
        ``run(options)`` runs it and returns the exit code.
    """

    name: str
    help: str
    description: str
    add: Callable[[argparse.ArgumentParser, Sequence[str]], None]
    run: Callable[[argparse.Namespace], int]
