"""Locks against other runs, on files."""

from __future__ import annotations

import contextlib
import errno
import sys
import time
from pathlib import Path
from typing import Callable, Iterator

from .errors import BareEarthError
from .files import describe_write_error

# Errors of the system for a file that another process has locked.
_LOCKED = (errno.EACCES, errno.EAGAIN, errno.EDEADLK)
# Seconds between two attempts of a run that waits.
_BEAT = 0.05


@contextlib.contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Lock the file `lock` in an existing folder until the block ends; refuse a folder in which
    another run works, or that is not writable.
    """
    # The operating system removes the lock when the process ends or is killed. If the file system
    # has no locks, other runs are not refused.
    path = folder / "lock"
    with contextlib.ExitStack() as opened:
        try:
            file = opened.enter_context(open(path, "ab"))
        except OSError as error:
            raise describe_write_error(path, error) from error
        is_locked = True
        with contextlib.suppress(OSError):
            is_locked = _is_locked(file.fileno())
        if not is_locked:
            raise BareEarthError(
                f"Another run writes into {folder.parent}. Wait until it ends, or choose another"
                " folder."
            )
        yield


@contextlib.contextmanager
def one_at_a_time(path: Path, waiting: Callable[[], object] = lambda: None) -> Iterator[None]:
    """Run the block when no other thread or process is in such a block with the same path, a file
    that is made and kept; `waiting` is called meanwhile, and may raise an exception.
    """
    # If the file system has no locks, several blocks run at the same time.
    with contextlib.ExitStack() as opened:
        with contextlib.suppress(OSError):
            number = opened.enter_context(open(path, "ab")).fileno()
            while not _is_locked(number):
                waiting()
                time.sleep(_BEAT)
        yield


def _is_locked(number: int) -> bool:
    """Lock an open file; return False if another one has locked it."""
    try:
        _lock(number)
    except OSError as error:
        if error.errno not in _LOCKED:
            raise
        return False
    return True


def _lock(number: int) -> None:
    """Lock an open file, or fail at once."""
    if sys.platform == "win32":
        import msvcrt

        msvcrt.locking(number, msvcrt.LK_NBLCK, 1)
    else:
        import fcntl

        fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
