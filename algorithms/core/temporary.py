"""Temporary files whose names say which process writes them, and the removal of old ones."""

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

# Computer, process, and random characters.
_TEMPORARY = re.compile(r"\.(\w+)-(\d+)-(\w+)\.part\.")
_LONGEST_NAME = 255
# It cannot be seen whether a process of another computer still runs, only when it last wrote.
_FORGOTTEN_SECONDS = 86_400.0
# The marks of the files that this process writes now.
_held: set[str] = set()


def make_temporary(target: Path, mode: int | None = None) -> Path:
    """Make an empty file beside the target; its name says which process writes it.

    An existing file is never used: somebody who knew the name could have put a link there.
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
    """Return the start of the name of a new temporary file, and register it.

    It must be registered before the file exists, so that no other thread removes the file.
    """
    marks = f".{_computer()}-{os.getpid()}-{secrets.token_hex(8)}.part."
    _held.add(marks)
    return marks


def _cut(name: str, taken: int) -> str:
    """Return the end of a file name that fits behind `taken` other bytes."""
    if len(os.fsencode(name)) > _LONGEST_NAME:
        return name  # too long in any case: the operating system gives the error
    while len(os.fsencode(name)) + taken > _LONGEST_NAME:
        name = name[1:]
    return name


@functools.cache
def _computer() -> str:
    """Return the name of this computer for the names of temporary files."""
    return re.sub(r"\W", "_", socket.gethostname(), flags=re.ASCII)[:32] or "_"


def remove_temporary(temporary: Path) -> None:
    """Remove a temporary file or folder, if it still exists, and its registration."""
    _delete(temporary)
    if marks := _TEMPORARY.match(temporary.name):
        _held.discard(marks[0])


def _delete(path: str | Path) -> None:
    """Remove a file, or a folder with its contents, if possible; do not follow links."""
    with contextlib.suppress(OSError):
        if os.path.isdir(path) and not os.path.islink(path):
            shutil.rmtree(path)
        else:
            os.unlink(path)


def remove_leftovers(folder: Path, processes: Container[int] | None = None) -> None:
    """Remove temporary files of killed processes from a folder.

    Files of running processes stay. On a shared disk, files of other computers are removed if they
    have not changed for a day.

    Parameters
    ----------
    folder : Path
        The folder.
    processes : container of int, optional
        Remove only files of these processes. By default, of all processes.
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
    """Return whether a temporary file is no longer written."""
    computer, process = marks[1], int(marks[2])
    if computer != _computer():
        age = time.time() - entry.stat(follow_symlinks=False).st_mtime
        return age > _FORGOTTEN_SECONDS
    if process == os.getpid():
        return marks[0] not in _held
    return not _is_running(process)


def _is_running(process: int) -> bool:
    """Return whether a process of this computer still runs."""
    if sys.platform == "win32":
        import ctypes

        kernel, code = ctypes.windll.kernel32, ctypes.c_ulong()
        handle = kernel.OpenProcess(0x1000, False, process)  # only the right to read its state
        if not handle:
            return kernel.GetLastError() == 5  # access denied: it runs
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
    return state not in ([b"Z"], [b"X"])  # ended, but not yet collected by its parent


def shown(path: object) -> str:
    """Return a path, or a text with a path, without the marks of temporary files."""
    return _TEMPORARY.sub("", str(path))
