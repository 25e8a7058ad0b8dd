"""Output files that are there whole or not at all."""

from __future__ import annotations

import contextlib
import errno
import functools
import itertools
import os
import re
import secrets
import shutil
import socket
import sys
import time
from pathlib import Path
from typing import Container, Iterable, Iterator

from .errors import BareEarthError

# The computer and the process that hold a temporary file, and what nobody can foresee.
_TEMPORARY = re.compile(r"\.(\w+)-(\d+)-(\w+)\.part\.")
_LONGEST_NAME = 255
# Whether a process of another computer is gone cannot be seen, but whether it still writes.
_FORGOTTEN_SECONDS = 86_400.0
# The marks of what this process writes right now.
_held: set[str] = set()

# What a system says of a file that another process has locked.
_LOCKED = (errno.EACCES, errno.EAGAIN, errno.EDEADLK)
_REASONS = {
    errno.ENOSPC: "the disk is full. Free some space or choose another folder",
    errno.EDQUOT: "your disk quota is used up. Free some space or choose another folder",
    errno.EACCES: "you have no permission to write there. Choose another folder",
    errno.EPERM: "you have no permission to write there. Choose another folder",
    errno.EROFS: "the disk is read-only. Choose another folder",
    errno.ENAMETOOLONG: "the name is too long. Choose a shorter one",
    errno.ESTALE: "the network disk lost the file. Run it again",
    errno.EBUSY: "another program holds it. Close it there, or choose another name",
    errno.EXDEV: "the folder lies across two disks. Choose another folder",
}


def check_output(target: Path, sources: tuple[Path, ...] = ()) -> None:
    """Refuse, before any work is done, an output that could not be written at the end.

    What killed runs left in the folder is removed: its space may be needed.

    Parameters
    ----------
    target : Path
        The file to be made.
    sources : tuple of Path
        Files that must not be overwritten.

    Raises
    ------
    BareEarthError
        If the folder is missing or not writable, or the target is a folder, no ordinary file, one
        of the sources, or has a name that is too long.
    """
    try:
        if not target.parent.is_dir():
            raise BareEarthError(
                f"Cannot write {target}: the folder {target.parent} does not exist. Create it"
                " first."
            )
        if target.is_dir():
            raise BareEarthError(f"Cannot write {target}: it is a folder. Give a file name.")
        if target.exists() and not target.is_file():
            raise BareEarthError(
                f"Cannot write {target}: it is no file, but a device or a pipe. Choose another"
                " output."
            )
        for source in sources:
            if is_same_file(source, target):
                raise BareEarthError(
                    f"Input and output are the same file, {source}. Choose another output."
                )
        remove_leftovers(target.parent)
        _remove(_make_temporary(target))
    except (OSError, ValueError) as error:  # a name with a null character is a ValueError
        raise describe_write_error(target, error) from error


def check_distinct(outputs: Iterable[Path | None]) -> None:
    """Refuse, before any work is done, outputs of one run that would overwrite each other.

    Parameters
    ----------
    outputs : iterable of Path or None
        The files to be made; None for those that are not wanted.

    Raises
    ------
    BareEarthError
        If two of them are the same file.
    """
    wanted = [each for each in outputs if each is not None]
    for one, other in itertools.combinations(wanted, 2):
        if is_same_file(one, other):
            raise BareEarthError(f"Two outputs are the same file, {one}. Give each its own name.")


def is_same_file(one: Path, other: Path) -> bool:
    """Return whether two paths name the same file, which need not be there yet."""
    if one.exists() and other.exists():
        return os.path.samefile(one, other)
    return os.path.normcase(one.resolve()) == os.path.normcase(other.resolve())


@contextlib.contextmanager
def replacing(target: Path) -> Iterator[Path]:
    """Give a temporary file beside `target` to write to; rename it when the block ends well.

    If the block ends with any exception (a cancel among them), the temporary file is removed and
    what was at `target` before is untouched. The temporary name keeps the suffixes of the target,
    since libraries choose the format by them. The permissions of a former target are kept.

    Raises
    ------
    BareEarthError
        If the operating system refuses to write, with what to do about it.
    """
    temporary = None
    try:
        mode = _mode_of(target)
        temporary = _make_temporary(target, mode)
        yield temporary
        if mode is not None:
            with contextlib.suppress(OSError):  # not every file system has them
                os.chmod(temporary, mode)
        _rename(temporary, target)
    except OSError as error:
        raise describe_write_error(target, error) from error
    finally:
        if temporary is not None:
            _remove(temporary)


@contextlib.contextmanager
def temporary_folder(beside: Path) -> Iterator[Path]:
    """Give a folder within `beside` that is removed, with all in it, when the block ends.

    If the process is killed, `remove_leftovers` removes it.

    Raises
    ------
    BareEarthError
        If the operating system refuses to make it.
    """
    folder = beside / f"{_new_marks()}work"
    try:
        try:
            folder.mkdir(mode=0o700)
        except OSError as error:
            raise describe_write_error(beside, error) from error
        yield folder
    finally:
        _remove(folder)


def replace_with_files_of(folder: Path, target: Path, beside: Iterable[str]) -> None:
    """Put the files of a temporary folder into that of `target`, for formats of several files.

    Parameters
    ----------
    folder : Path
        What `temporary_folder` gave, with `target.name` and what belongs to it.
    target : Path
        The file to be made.
    beside : iterable of str
        Names of what may belong to the former target: what is not replaced of it is removed.

    Raises
    ------
    BareEarthError
        If the operating system refuses to write.
    """
    try:
        new = sorted(each.name for each in folder.iterdir())
        for name in new:
            _rename(folder / name, target.with_name(name))
        for name in set(beside) - set(new):
            target.with_name(name).unlink(missing_ok=True)
    except OSError as error:
        raise describe_write_error(target, error) from error


def _rename(temporary: Path, target: Path) -> None:
    """Put a temporary file into the place of its target.

    A network disk may report an error for what it has done: its first answer was lost, and to the
    same question once more it says that there is no such file.
    """
    written = os.stat(temporary)
    try:
        os.replace(temporary, target)
    except OSError:
        with contextlib.suppress(OSError):
            if os.path.samestat(written, os.stat(target)):
                return
        raise


def _remove(temporary: Path) -> None:
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


def _mode_of(target: Path) -> int | None:
    """Return the permissions of a file, None if there is none."""
    try:
        return os.stat(target).st_mode & 0o777
    except FileNotFoundError:
        return None


def _make_temporary(target: Path, mode: int | None = None) -> Path:
    """Make an empty file beside the target whose name says who writes it.

    Never one that is there already: whoever knew the name could have put a link in its place.
    """
    while True:
        marks = _new_marks()
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


def _new_marks() -> str:
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

    Files of processes that are still there stay. Of those of other computers, on a disk that
    several share, only what nobody wrote to for a day is removed.

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


def describe_write_error(target: Path, error: OSError | ValueError) -> BareEarthError:
    """Turn an operating system error met while writing `target` into a sentence."""
    reason = str(error)
    if isinstance(error, OSError):
        reason = _REASONS.get(error.errno or 0, error.strerror or reason)
    return BareEarthError(f"Cannot write {shown(target)}: {reason}.")


def shown(path: object) -> str:
    """Return a path, or a text that names one, without the marks of `replacing`."""
    return _TEMPORARY.sub("", str(path))
