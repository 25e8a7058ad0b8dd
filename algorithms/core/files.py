"""Output files that are there whole or not at all."""

from __future__ import annotations

import contextlib
import errno
import itertools
import os
import re
import sys
from pathlib import Path
from typing import Container, Iterator

from .errors import BareEarthError

_numbers = itertools.count()
_TEMPORARY = re.compile(r"\.(\d+)-\d+\.part\.")

# What a system says of a file that another process has locked.
_LOCKED = (errno.EACCES, errno.EAGAIN, errno.EDEADLK)
_REASONS = {
    errno.ENOSPC: "the disk is full. Free some space or choose another folder",
    errno.EDQUOT: "your disk quota is used up. Free some space or choose another folder",
    errno.EACCES: "you have no permission to write there. Choose another folder",
    errno.EPERM: "you have no permission to write there. Choose another folder",
    errno.EROFS: "the disk is read-only. Choose another folder",
}


def check_output(target: Path, sources: tuple[Path, ...] = ()) -> None:
    """Refuse, before any work is done, an output that could not be written at the end.

    Parameters
    ----------
    target : Path
        The file to be made.
    sources : tuple of Path
        Files that must not be overwritten.

    Raises
    ------
    BareEarthError
        If the folder is missing, or the target is a folder or one of the sources.
    """
    if not target.parent.is_dir():
        raise BareEarthError(
            f"Cannot write {target}: the folder {target.parent} does not exist. Create it first."
        )
    if target.is_dir():
        raise BareEarthError(f"Cannot write {target}: it is a folder. Give a file name.")
    for source in sources:
        if target.exists() and source.exists() and os.path.samefile(source, target):
            raise BareEarthError(
                f"Input and output are the same file, {source}. Choose another output."
            )


@contextlib.contextmanager
def replacing(target: Path) -> Iterator[Path]:
    """Give a temporary name beside `target` to write to; rename it when the block ends well.

    If the block ends with any exception (a cancel among them), the temporary file is removed and
    what was at `target` before is untouched. The temporary name keeps the suffixes of the target,
    since libraries choose the format by them.

    Raises
    ------
    BareEarthError
        If the operating system refuses to write, with what to do about it.
    """
    temporary = target.with_name(f".{os.getpid()}-{next(_numbers)}.part.{target.name}")
    try:
        yield temporary
        os.replace(temporary, target)
    except OSError as error:
        raise describe_write_error(target, error) from error
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink()


@contextlib.contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Let no other run work in a folder while the block does.

    The lock is the operating system's: it ends with the process, however that ends. Where the
    file system has no locks, nothing is refused.

    Parameters
    ----------
    folder : Path
        It must exist, and be one that only such runs write into; `lock` in it is the file.

    Raises
    ------
    BareEarthError
        If another run works in it, or nothing can be written there.
    """
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


def _lock(number: int) -> None:
    """Lock an open file, or fail at once if it is locked."""
    if sys.platform == "win32":
        import msvcrt

        msvcrt.locking(number, msvcrt.LK_NBLCK, 1)
    else:
        import fcntl

        fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)


def remove_leftovers(folder: Path, processes: Container[int] | None = None) -> None:
    """Remove what `replacing` left in a folder when its process was killed.

    Parameters
    ----------
    folder : Path
        The folder; nothing else may be writing into it.
    processes : container of int, optional
        Only the files of these processes; of all if it is not given.
    """
    for path in folder.iterdir() if folder.is_dir() else ():
        found = _TEMPORARY.match(path.name)
        if found and (processes is None or int(found.group(1)) in processes):
            with contextlib.suppress(OSError):
                path.unlink()


def describe_write_error(target: Path, error: OSError) -> BareEarthError:
    """Turn an operating system error met while writing `target` into a sentence."""
    reason = _REASONS.get(error.errno or 0, error.strerror or str(error))
    return BareEarthError(f"Cannot write {shown(target)}: {reason}.")


def shown(path: object) -> str:
    """Return a path, or a text that names one, without the marks of `replacing`."""
    return _TEMPORARY.sub("", str(path))
