"""Makes a process and its children treat files as Windows does, wherever the tests run.

Python imports a module of this name at its start if its folder is in PYTHONPATH; `tools/test
windows` puts it there. A file that any process has open (Python, GDAL and the C runtime open
without FILE_SHARE_DELETE) or mapped cannot be removed, renamed or replaced; a folder with such a
file cannot be renamed; a mapped file cannot be made empty; a read-only file cannot be replaced;
os.rename does not replace; names with <>:"|?*, or that end in a dot or a space, do not exist;
neither do paths of 260 characters or more, and folders of 248.

WINDOWS_FILES_LOG names a file for the errors and where they came from, also those that the code
suppresses: it has to be empty at the end. Only processes with the same WINDOWS_FILES_SESSION are
asked for open files.

An audit hook sees what Python does to files before it happens, and looks at /proc of these
processes. What C libraries do without Python, such as GDAL, is not seen.
"""

from __future__ import annotations

import errno
import os
import sys
import tempfile
import traceback

_FORBIDDEN = set('<>:"|?*')
_LONGEST, _LONGEST_FOLDER = 259, 247
_ERRORS = {
    3: errno.ENOENT, 5: errno.EACCES, 32: errno.EACCES, 123: errno.EINVAL, 183: errno.EEXIST,
    1224: errno.EINVAL,
}  # fmt: skip
_EVENTS = ("open", "os.mkdir", "os.remove", "os.rename", "os.rmdir", "os.truncate")
_is_busy = False
# Processes that are none of these, by their numbers.
_foreign: set[str] = set()
# Files of tempfile.TemporaryFile, which have names on Windows, and go when they are closed.
_pending: set[str] = set()


def _refuse(winerror: int, path: str, why: str) -> None:
    """Raise an error as Windows does, and log it."""
    error = OSError(_ERRORS[winerror], f"[WinError {winerror}] as on Windows: {why}", path)
    error.winerror = winerror
    if log := os.environ.get("WINDOWS_FILES_LOG"):
        where = "".join(traceback.format_stack()[:-3])
        with open(log, "a", encoding="utf-8") as file:
            file.write(f"=== {path}: {why}\n{where}\n")
    raise error


def _processes():
    session = f"WINDOWS_FILES_SESSION={os.environ['WINDOWS_FILES_SESSION']}".encode()
    for name in filter(str.isdigit, os.listdir("/proc")):
        if name in _foreign:
            continue
        try:
            if int(name) != os.getpid():
                with open(f"/proc/{name}/environ", "rb") as file:
                    if session not in file.read().split(b"\0"):
                        _foreign.add(name)
                        continue
        except OSError:  # it has ended, or is another user's
            continue
        yield name


def _held(path: str, inside: bool = False, mapped_only: bool = False) -> bool:
    """Return whether a file, or any in a folder if `inside`, is open or mapped."""

    def is_it(other: str) -> bool:
        return other == path or (inside and other.startswith(f"{path}/"))

    path = os.path.join(os.path.realpath(os.path.dirname(path) or "."), os.path.basename(path))
    for process in _processes():
        try:
            opened = [] if mapped_only else os.listdir(f"/proc/{process}/fd")
            for number in opened:
                other = os.path.realpath(f"/proc/{process}/fd/{number}")
                if is_it(other) and not os.path.isdir(other):
                    return True
            with open(f"/proc/{process}/maps", "rb") as file:
                mapped = (line.rstrip(b"\n").split(None, 5)[5:] for line in file)
                if any(is_it(os.fsdecode(value[0])) for value in mapped if value):
                    return True
        except OSError:
            continue
    return False


def _full(path: str | bytes | os.PathLike, folder: int = -1) -> str:
    """Return the whole path of a file, which may be given in an open folder."""
    inside = os.readlink(f"/proc/self/fd/{folder}") if folder >= 0 else ""
    return os.path.abspath(os.path.join(inside, os.fsdecode(path)))


def _hook(event: str, arguments: tuple) -> None:
    global _is_busy
    if _is_busy or event not in _EVENTS or not isinstance(arguments[0], (str, bytes, os.PathLike)):
        return
    _is_busy = True
    try:
        # Behind the paths stand the numbers of open folders.
        folders = {"os.rename": 2, "os.remove": 1, "os.rmdir": 1}
        path = _full(arguments[0], arguments[folders[event]] if event in folders else -1)
        if not path.startswith(("/proc/", "/dev/", "/sys/")):
            if event != "open":
                _delete_closed()
            _CHECKS[event](path, arguments)
    finally:
        _is_busy = False


def _delete_closed() -> None:
    for path in list(_pending):
        if not _held(path):
            _pending.discard(path)
            if os.path.exists(path):
                os.unlink(path)


def _check_new(path: str, longest: int) -> None:
    """Check the name of a file or folder that is made."""
    if len(path) > longest:
        _refuse(3, path, f"a path of {len(path)} characters")
    for part in filter(None, path.split("/")):
        if _FORBIDDEN & set(part) or part[-1] in ". ":
            _refuse(123, path, "no name on Windows")


def _check_open(path: str, arguments: tuple) -> None:
    flags = arguments[2] if isinstance(arguments[2], int) else 0
    if flags & os.O_CREAT:
        _check_new(path, _LONGEST)
    if flags & os.O_TRUNC and os.path.exists(path) and _held(path, mapped_only=True):
        _refuse(1224, path, "mapped")


def _check_removal(path: str, arguments: tuple) -> None:
    if os.path.lexists(path) and not os.path.islink(path):
        if _held(path):
            _refuse(32, path, "open")
        if os.path.isfile(path) and not os.stat(path).st_mode & 0o200:
            _refuse(5, path, "read-only")


def _check_rename(source: str, arguments: tuple) -> None:
    target = _full(arguments[1], arguments[3])
    is_folder = os.path.isdir(source)
    if target != source:
        _check_new(target, _LONGEST_FOLDER if is_folder else _LONGEST)
        if os.path.isdir(target):
            _refuse(5, target, "a folder")
    if _held(source, inside=is_folder):
        _refuse(5 if is_folder else 32, source, "open")
    if target != source and os.path.exists(target):
        if _held(target):
            _refuse(5, target, "open")
        if not os.stat(target).st_mode & 0o200:
            _refuse(5, target, "read-only")


_CHECKS = {
    "open": _check_open,
    "os.mkdir": lambda path, _: _check_new(path, _LONGEST_FOLDER),
    "os.remove": _check_removal,
    "os.rmdir": lambda path, _: None,
    "os.rename": _check_rename,
    "os.truncate": lambda path, _: _held(path, mapped_only=True) and _refuse(1224, path, "mapped"),
}


def _temporary_file(mode="w+b", buffering=-1, encoding=None, newline=None, suffix=None,
                    prefix=None, dir=None, *, errors=None):  # fmt: skip
    number, name = tempfile.mkstemp(suffix or "", prefix or "tmp", dir)
    _pending.add(os.path.realpath(name))
    return os.fdopen(number, mode, buffering, encoding, errors, newline)


def _rename(source, target, *, rename=os.rename, **more):
    if os.path.lexists(target):
        _refuse(183, _full(target), "os.rename does not replace")
    return rename(source, target, **more)


if "WINDOWS_FILES_LOG" in os.environ and os.path.isdir("/proc/self/fd"):
    tempfile.TemporaryFile = _temporary_file
    os.rename = _rename
    sys.addaudithook(_hook)
