"""The command that clears the cache of remote point clouds."""

from __future__ import annotations

import argparse
from typing import Sequence

from .options import DONE, Command


def _add(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> None:
    parser.add_argument(
        "--cache", metavar="FOLDER",
        help="the folder of the cache; without it that of BARE_EARTH_CACHE, or one of the user",
    )  # fmt: skip


def _clear(options: argparse.Namespace) -> int:
    from ..remote.cache import cache_of, clear
    from ..remote.fetching import in_words

    folder = cache_of(options.cache)
    print(f"{folder}: {in_words(clear(folder))} were removed.")
    return DONE


COMMANDS = (
    Command(
        "clear-cache",
        "remove what is kept of remote point clouds",
        "Removes the parts of remote point clouds that runs have fetched and kept, and tells how"
        " many bytes that were.",
        _add,
        _clear,
    ),
)
