"""Writes output files that are complete or do not exist."""

from __future__ import annotations

import contextlib
import errno
import itertools
import os
import sys
import tempfile
from pathlib import Path
from typing import BinaryIO, Iterable, Iterator

from .errors import BareEarthError
from .temporary import make_temporary, new_marks, remove_leftovers, remove_temporary, shown

# Errors of the system for a file that another process has locked.
_LOCKED = (errno.EACCES, errno.EAGAIN, errno.EDEADLK)
# Errors of Windows if a file that a program has open is to be replaced: access denied, in use.
_IN_USE = (5, 32)
_REASONS = {
    errno.ENOSPC: "the disk is full. Free some space or choose another folder",
    errno.EDQUOT: "your disk quota is used up. Free some space or choose another folder",
    errno.EACCES: "you have no permission to write there. Choose another folder",
    errno.EPERM: "you have no permission to write there. Choose another folder",
    errno.EROFS: "the disk is read-only. Choose another folder",
    errno.ENAMETOOLONG: "the name is too long. Choose a shorter one",
    errno.ESTALE: "the network disk lost the file. Run it again",
    errno.EBUSY: "another program uses it, or QGIS shows it as a layer. Close it there, or choose"
    " another name",
    errno.EXDEV: "the folder spans two disks. Choose another folder",
}


# Endings of files; ".copc.laz" must come before ".laz".
_ENDINGS = (".copc.laz", ".las", ".laz", ".vpc", ".txt", ".tif", ".tiff")


def split_name(path: Path) -> tuple[str, str]:
    """Return the name of a file without its ending, and the ending, such as ``.copc.laz``.

    The ending is empty for folders and other kinds of files.
    """
    ending = next((each for each in _ENDINGS if path.name.lower().endswith(each)), "")
    stem = path.name[: -len(ending) or None]
    return stem, path.name[len(stem) :]


def check_output(target: Path, sources: tuple[Path, ...] = ()) -> None:
    """Refuse, before any work is done, an output that could not be written at the end.

    Temporary files of killed runs in the folder are removed, since their space may be needed.

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
                f"Cannot write {target}: it is a device or a pipe, not a file. Choose another"
                " output."
            )
        for source in sources:
            if is_same_file(source, target):
                raise BareEarthError(
                    f"Input and output are the same file, {source}. Choose another output."
                )
        remove_leftovers(target.parent)
        remove_temporary(make_temporary(target))
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
    """Return whether two paths name the same file, which need not exist yet."""
    if one.exists() and other.exists():
        return os.path.samefile(one, other)
    return os.path.normcase(one.resolve()) == os.path.normcase(other.resolve())


@contextlib.contextmanager
def replacing(target: Path) -> Iterator[Path]:
    """Yield a temporary file beside `target`; rename it to `target` when the block ends.

    After an exception (including a cancel), the temporary file is removed and an old target stays
    unchanged. The temporary name keeps the suffixes of the target, since libraries choose the
    format by them. The permissions of an old target are kept.

    Raises
    ------
    BareEarthError
        If the operating system refuses to write; the text says what to do.
    """
    temporary = None
    try:
        mode = _mode_of(target)
        temporary = make_temporary(target, mode)
        yield temporary
        if mode is not None:
            with contextlib.suppress(OSError):  # not every file system has permissions
                os.chmod(temporary, mode)
        _rename(temporary, target)
    except OSError as error:
        raise describe_write_error(target, error) from error
    finally:
        if temporary is not None:
            remove_temporary(temporary)


@contextlib.contextmanager
def new_folder(path: Path) -> Iterator[Path]:
    """Make a folder if it does not exist, and yield it; remove it at the end if it is empty.

    Raises
    ------
    BareEarthError
        If the operating system refuses to make it.
    """
    try:
        path.mkdir(exist_ok=True)
    except OSError as error:
        raise describe_write_error(path, error) from error
    try:
        yield path
    finally:
        with contextlib.suppress(OSError):  # it contains files
            path.rmdir()


@contextlib.contextmanager
def temporary_folder(beside: Path) -> Iterator[Path]:
    """Yield a new folder inside `beside`; remove it with its contents when the block ends.

    If the process is killed, `remove_leftovers` removes it.

    Raises
    ------
    BareEarthError
        If the operating system refuses to make it.
    """
    folder = beside / f"{new_marks()}work"
    try:
        try:
            folder.mkdir(mode=0o700)
        except OSError as error:
            raise describe_write_error(beside, error) from error
        yield folder
    finally:
        remove_temporary(folder)


@contextlib.contextmanager
def unnamed_file(folder: Path) -> Iterator[BinaryIO]:
    """Yield a temporary file without a name. It disappears when the block or the process ends.

    Parameters
    ----------
    folder : Path
        The folder on whose disk the data are stored.
    """
    with contextlib.ExitStack() as opened:
        file = opened.enter_context(tempfile.TemporaryFile(dir=folder))
        opened.callback(_close, file)
        yield file


def _close(file: BinaryIO) -> None:
    """Close a file that is no longer needed; ignore errors, such as those of a full disk."""
    with contextlib.suppress(OSError):
        file.close()


def reach_disk(file: BinaryIO) -> None:
    """Hand what was written to the disk, before it is read again.

    A full network disk may report an error only when a file is closed. Until then, reading the
    file can return wrong data. A local disk reports the error at once, so this costs nothing there.

    Raises
    ------
    OSError
        If the disk does not accept the data.
    """
    file.flush()
    os.close(os.dup(file.fileno()))


def replace_with_files_of(folder: Path, target: Path, beside: Iterable[str]) -> None:
    """Move the files of a temporary folder beside `target`, for formats with several files.

    Parameters
    ----------
    folder : Path
        A folder of `temporary_folder`, with `target.name` and the files that belong to it.
    target : Path
        The file to be made.
    beside : iterable of str
        Names of files that may belong to an old target. Those that are not replaced are removed.

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
    """Rename a temporary file to its target.

    A network disk may report an error although it has renamed the file: if its first answer was
    lost, it answers the repeated request that the temporary file does not exist.
    """
    written = os.stat(temporary)
    try:
        os.replace(temporary, target)
    except OSError as error:
        with contextlib.suppress(OSError):
            if os.path.samestat(written, os.stat(target)):
                return
        if getattr(error, "winerror", None) in _IN_USE and os.path.exists(target):
            raise OSError(errno.EBUSY, os.strerror(errno.EBUSY)) from error
        raise


def _mode_of(target: Path) -> int | None:
    """Return the permissions of a file, None if it does not exist."""
    try:
        return os.stat(target).st_mode & 0o777
    except FileNotFoundError:
        return None


@contextlib.contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Lock a folder against other runs until the block ends.

    The operating system removes the lock when the process ends, even if it is killed. If the file
    system has no locks, other runs are not refused.

    Parameters
    ----------
    folder : Path
        An existing folder that only such runs write into. The file `lock` in it is locked.

    Raises
    ------
    BareEarthError
        If another run works in the folder, or nothing can be written there.
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


@contextlib.contextmanager
def one_at_a_time(path: Path) -> Iterator[None]:
    """Wait until no other thread or process is in such a block for the same path.

    If the file system has no locks, nobody waits.

    Parameters
    ----------
    path : Path
        A file that is made and locked; it stays.
    """
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


@contextlib.contextmanager
def write_errors_told(target: Path) -> Iterator[None]:
    """Turn errors of the operating system into a sentence on what cannot be written.

    Raises
    ------
    BareEarthError
        In place of each OSError.
    """
    try:
        yield
    except OSError as error:
        raise describe_write_error(target, error) from error


def describe_write_error(target: Path, error: OSError | ValueError) -> BareEarthError:
    """Return a sentence for an error of the operating system while writing `target`."""
    reason = str(error)
    if isinstance(error, OSError):
        reason = _REASONS.get(error.errno or 0, error.strerror or reason)
    return BareEarthError(f"Cannot write {shown(target)}: {reason}.")
