"""Puts files in the places of others: all of them or none."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path
from typing import Sequence

from .files import check_free, rename, write_errors_told
from .temporary import patiently


def exchange(moves: Sequence[tuple[Path, Path]], outdated: Sequence[Path], aside: Path) -> None:
    """Move files to their places and remove others, all or, after an error such as `OutputInUse`,
    none; `aside` is a temporary folder on the same disk, for the old files.
    """
    targets = [*(target for _, target in moves), *outdated]
    for path in targets:
        check_free(path)
    done: list[tuple[Path, Path]] = []
    try:
        for number, target in enumerate(targets):
            with write_errors_told(target):
                old = aside / str(number)
                if os.path.lexists(target):
                    _set_aside(target, old)
                    done.append((old, target))
                if number < len(moves):
                    target.parent.mkdir(parents=True, exist_ok=True)
                    rename(moves[number][0], target)
                    done.append((target, moves[number][0]))
                elif os.path.lexists(target):
                    patiently(os.unlink, target)
    except BaseException:
        for now, before in reversed(done):
            with contextlib.suppress(OSError):  # the first error is the one to tell
                if not (before.exists() and os.path.samefile(now, before)):
                    patiently(os.replace, now, before)
        raise


def _set_aside(path: Path, old: Path) -> None:
    """Keep an old file under another name; where the disk can do so, also under its own."""
    try:
        os.link(path, old)
    except OSError:
        rename(path, old)
