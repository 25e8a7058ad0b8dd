"""Temporary files whose names say which process writes them, and the removal of old ones."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import os
import re
import secrets
import shutil
import socket
import sys
import time
from pathlib import Path
from typing import Callable, Container, TypeVar

_Result = TypeVar("_Result")

# Marks: computer, random characters, and process. An ending follows in the names of files. They are
# short, since Windows allows most programs 259 characters for a whole path.
_MARKS = r"\.~([0-9a-z]{4})[0-9a-z]{3}([0-9a-z]{1,7})"
_TEMPORARY = re.compile(rf"({_MARKS})((?:\.[\w-]+)*)")
_IN_A_PATH = re.compile(rf"({_MARKS})(?:\.[\w-]*\w)*([/\\]?)")
_ENDING = re.compile(r"(?:\.copc)?\.\w+$", re.IGNORECASE)
_DIGITS = "0123456789abcdefghijklmnopqrstuvwxyz"
# Characters of marks.
MARKS_LENGTH = 13
# It cannot be seen whether a process of another computer still runs, only when it last wrote.
_FORGOTTEN_SECONDS = 86_400.0
# The marks of the files that this process writes now, with the names of the outputs, which are
# empty for folders.
_written_now: dict[str, list[str]] = {}
# Errors of Windows for a file that a program has open: access denied, in use.
IN_USE = (5, 32)
# Seconds for which a virus scanner or a copying service may have a file open.
_PATIENCE = 5.0
# Seconds between two attempts to use such a file.
_PAUSE = 0.05


def patiently(action: Callable[..., _Result], *arguments: object) -> _Result:
    """Call a function of the file system; on Windows, wait some seconds for files that are in use
    before its OSError is raised.
    """
    # Virus scanners, indexers and copying services open each new file for a moment.
    end = time.monotonic() + _PATIENCE
    while True:
        try:
            return action(*arguments)
        except OSError as error:
            if getattr(error, "winerror", None) not in IN_USE or time.monotonic() > end:
                raise
        time.sleep(_PAUSE)


def remove(path: str | Path) -> None:
    """Remove a file, or a folder with its contents, if possible; do not follow links."""
    with contextlib.suppress(OSError):
        if not os.path.isdir(path) or os.path.islink(path):
            patiently(os.unlink, path)
            return
        try:
            patiently(shutil.rmtree, path)
        except OSError:
            shutil.rmtree(path, ignore_errors=True)


def make_temporary(target: Path, mode: int | None = None) -> Path:
    """Make an empty file beside the target, with the same ending, and a name that says which
    process writes it.
    """
    # Libraries choose the format by the ending. An existing file is never used: another user could
    # have put a link there.
    match = _ENDING.search(target.name)
    ending = match[0] if match else ""
    flags = os.O_CREAT | os.O_EXCL | os.O_WRONLY
    permissions = 0o666 if mode is None else mode | 0o600

    def make(path: Path) -> None:
        os.close(os.open(path, flags, permissions))

    return _make_marked(target.parent, ending, shown(target.name), make)


def make_temporary_folder(parent: Path) -> Path:
    """Make a folder in `parent`, or, if this is in a temporary folder, beside the latter."""
    # Paths in nested temporary folders would become too long.
    for folder in reversed((parent, *parent.parents)):
        if _TEMPORARY.fullmatch(folder.name):
            parent = folder.parent
            break
    return _make_marked(parent, "", "", lambda path: path.mkdir(mode=0o700))


def _make_marked(folder: Path, ending: str, name: str, make: Callable[[Path], object]) -> Path:
    """Make a file or folder with a new temporary name; messages show `name` instead."""
    # The marks must be registered before it exists, so that no other thread removes it.
    known = [name]
    while True:
        random = _short(secrets.randbelow(36**3), 3)
        marks = f".~{_computer()}{random}{_short(os.getpid())}"
        if _written_now.setdefault(marks, known) is not known:
            continue
        try:
            make(folder / f"{marks}{ending}")
        except FileExistsError:
            del _written_now[marks]
            continue
        except BaseException:
            del _written_now[marks]
            raise
        return folder / f"{marks}{ending}"


def _short(number: int, length: int = 1) -> str:
    """Return a number with the digits 0 to z."""
    digits = ""
    while number or len(digits) < length:
        number, last = divmod(number, 36)
        digits = _DIGITS[last] + digits
    return digits


@functools.cache
def _computer() -> str:
    """Return four characters for this computer, for the names of temporary files."""
    digest = hashlib.sha256(os.fsencode(socket.gethostname())).digest()
    return _short(int.from_bytes(digest, "big") % 36**4, 4)


def remove_temporary(temporary: Path) -> None:
    """Remove a temporary file or folder, if it still exists, and its registration."""
    remove(temporary)
    if marks := _TEMPORARY.match(temporary.name):
        _written_now.pop(marks[1], None)


def is_temporary(path: Path) -> bool:
    """Return whether a path has the name of a temporary file or folder."""
    return _TEMPORARY.fullmatch(path.name) is not None


def remove_leftovers(folder: Path, processes: Container[int] | None = None) -> None:
    """Remove the temporary files of killed processes, by default of all, from a folder."""
    # Files of running processes stay. On a shared disk, files of other computers are removed if
    # they have not changed for a day.
    if not folder.is_dir():
        return
    with os.scandir(folder) as entries:
        matches = [(entry, _TEMPORARY.fullmatch(entry.name)) for entry in entries]
    for entry, marks in matches:
        if marks and (processes is None or int(marks[3], 36) in processes):
            with contextlib.suppress(OSError):
                if _is_left(entry, marks):
                    remove(entry.path)


def _is_left(entry: os.DirEntry[str], marks: re.Match[str]) -> bool:
    """Return whether a temporary file is no longer written."""
    process = int(marks[3], 36)
    if marks[2] != _computer():
        age = time.time() - entry.stat(follow_symlinks=False).st_mtime
        return age > _FORGOTTEN_SECONDS
    if process == os.getpid():
        return marks[1] not in _written_now
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
    """Return a path, or a text with paths, with the names of outputs in place of temporary ones."""
    return _IN_A_PATH.sub(_known, str(path))


def _known(match: re.Match[str]) -> str:
    (name,), separator = _written_now.get(match[1], [""]), match[4]
    if name:
        return name + separator
    # A temporary folder is left out of the path. A file of another process keeps its name.
    return "" if separator else match[0]
