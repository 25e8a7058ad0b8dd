"""Locks against other runs, on files."""

from __future__ import annotations

import contextlib
import errno
import sys
from pathlib import Path
from typing import Iterator

from .errors import BareEarthError
from .files import describe_write_error

# Errors of the system for a file that another process has locked.
_LOCKED = (errno.EACCES, errno.EAGAIN, errno.EDEADLK)


@contextlib.contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Lock the file `lock` in an existing folder until the block ends; refuse a folder in which
    another run works, or that cannot be written to.
    """
    # The operating system removes the lock when the process ends, even if it is killed. If the file
    # system has no locks, other runs are not refused.
    path = folder / "lock"
    with contextlib.ExitStack() as opened:
        try:
            file = opened.enter_context(open(path, "ab"))
        except OSError as error:
            raise describe_write_error(path, error) from error
        try:
            _lock(file.fileno())
        except OSError as error:
            if error.errno in _LOCKED:
                raise BareEarthError(
                    f"Another run writes into {folder.parent}. Wait until it ends, or choose"
                    " another folder."
                ) from error
        yield


@contextlib.contextmanager
def one_at_a_time(path: Path) -> Iterator[None]:
    """Wait until no other thread or process is in such a block for the same path, a file that is
    made and stays.
    """
    # If the file system has no locks, nobody waits.
    with contextlib.ExitStack() as opened:
        with contextlib.suppress(OSError):
            _lock(opened.enter_context(open(path, "ab")).fileno(), waits=True)
        yield


def _lock(number: int, waits: bool = False) -> None:
    """Lock an open file; if it is locked, wait or fail at once."""
    if sys.platform == "win32":
        import msvcrt

        msvcrt.locking(number, msvcrt.LK_LOCK if waits else msvcrt.LK_NBLCK, 1)
    else:
        import fcntl

        fcntl.flock(number, fcntl.LOCK_EX | (0 if waits else fcntl.LOCK_NB))
