"""Temporary files whose names say who writes them, and the removal of those that were left."""

from __future__ import annotations

import contextlib
import functools
import os
import re
import secrets
import shutil
import socket
import sys
import time
from pathlib import Path
from typing import Container

# The computer and the process that hold a temporary file, and what nobody can foresee.
_TEMPORARY = re.compile(r"\.(\w+)-(\d+)-(\w+)\.part\.")
_LONGEST_NAME = 255
# Whether a process of another computer is gone cannot be seen, but whether it still writes.
_FORGOTTEN_SECONDS = 86_400.0
# The marks of what this process writes right now.
_held: set[str] = set()


def make_temporary(target: Path, mode: int | None = None) -> Path:
    """Make an empty file beside the target whose name says who writes it.

    A file that is there already is never taken: whoever knew the name could have put a link there.
    """
    while True:
        marks = new_marks()
        temporary = target.with_name(marks + _cut(target.name, len(marks)))
        try:
            flags = os.O_CREAT | os.O_EXCL | os.O_WRONLY
            os.close(os.open(temporary, flags, 0o666 if mode is None else mode | 0o600))
        except FileExistsError:
            _held.discard(marks)
            continue
        except OSError:
            _held.discard(marks)
            raise
        return temporary


def new_marks() -> str:
    """Return how the name of a new temporary file begins, and hold it.

    Before it is there: another thread must not take it for one that was left.
    """
    marks = f".{_computer()}-{os.getpid()}-{secrets.token_hex(8)}.part."
    _held.add(marks)
    return marks


def _cut(name: str, taken: int) -> str:
    """Return the end of a file name, so long that it fits behind some other bytes."""
    if len(os.fsencode(name)) > _LONGEST_NAME:
        return name  # too long by itself, which the operating system says better
    while len(os.fsencode(name)) + taken > _LONGEST_NAME:
        name = name[1:]
    return name


@functools.cache
def _computer() -> str:
    """Return the name of this computer, as it stands in the names of temporary files."""
    return re.sub(r"\W", "_", socket.gethostname(), flags=re.ASCII)[:32] or "_"


def remove_temporary(temporary: Path) -> None:
    """Remove a temporary file or folder, if it is still there, and hold it no longer."""
    _delete(temporary)
    if marks := _TEMPORARY.match(temporary.name):
        _held.discard(marks[0])


def _delete(path: str | Path) -> None:
    """Remove a file, or a folder with all in it, as far as that can be done; follow no link."""
    with contextlib.suppress(OSError):
        if os.path.isdir(path) and not os.path.islink(path):
            shutil.rmtree(path)
        else:
            os.unlink(path)


def remove_leftovers(folder: Path, processes: Container[int] | None = None) -> None:
    """Remove what `replacing` left in a folder when its process was killed.

    Files of processes that are still there stay. Files of other computers, on a disk that several
    share, are removed if nobody wrote to them for a day.

    Parameters
    ----------
    folder : Path
        The folder.
    processes : container of int, optional
        Only the files of these processes; of all if it is not given.
    """
    if not folder.is_dir():
        return
    with os.scandir(folder) as entries:
        found = [(each, _TEMPORARY.match(each.name)) for each in entries]
    for entry, marks in found:
        if marks and (processes is None or int(marks[2]) in processes):
            with contextlib.suppress(OSError):
                if _is_left(entry, marks):
                    _delete(entry.path)


def _is_left(entry: os.DirEntry[str], marks: re.Match[str]) -> bool:
    """Return whether nobody writes a temporary file any more."""
    computer, process = marks[1], int(marks[2])
    if computer != _computer():
        age = time.time() - entry.stat(follow_symlinks=False).st_mtime
        return age > _FORGOTTEN_SECONDS
    if process == os.getpid():
        return marks[0] not in _held
    return not _is_running(process)


def _is_running(process: int) -> bool:
    """Return whether a process of this computer is there."""
    if sys.platform == "win32":
        import ctypes

        kernel, code = ctypes.windll.kernel32, ctypes.c_ulong()
        handle = kernel.OpenProcess(0x1000, False, process)  # to ask for its state, no more
        if not handle:
            return kernel.GetLastError() == 5  # access denied: it is there
        try:
            return bool(kernel.GetExitCodeProcess(handle, ctypes.byref(code))) and code.value == 259
        finally:
            kernel.CloseHandle(handle)
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except PermissionError:
        return True
    try:
        state = Path(f"/proc/{process}/stat").read_bytes().rpartition(b")")[2].split()[:1]
    except OSError:  # not every system has it
        return True
    return state not in ([b"Z"], [b"X"])  # one that ended, but nobody asked how


def shown(path: object) -> str:
    """Return a path, or a text that names one, without the marks of `replacing`."""
    return _TEMPORARY.sub("", str(path))
