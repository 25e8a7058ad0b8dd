"""Output files that are there whole or not at all."""

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
    errno.EBUSY: "another program uses it. Close it there, or choose another name",
    errno.EXDEV: "the folder spans two disks. Choose another folder",
}


# Endings of files; the longest first, since it ends as another does.
_ENDINGS = (".copc.laz", ".las", ".laz", ".vpc", ".txt", ".tif", ".tiff")


def split_name(path: Path) -> tuple[str, str]:
    """Return the name of a file without its ending, and the ending, such as ``.copc.laz``.

    A folder, and a file of another kind, has no ending.
    """
    ending = next((each for each in _ENDINGS if path.name.lower().endswith(each)), "")
    stem = path.name[: -len(ending) or None]
    return stem, path.name[len(stem) :]


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
        temporary = make_temporary(target, mode)
        yield temporary
        if mode is not None:
            with contextlib.suppress(OSError):  # not every file system has them
                os.chmod(temporary, mode)
        _rename(temporary, target)
    except OSError as error:
        raise describe_write_error(target, error) from error
    finally:
        if temporary is not None:
            remove_temporary(temporary)


@contextlib.contextmanager
def new_folder(path: Path) -> Iterator[Path]:
    """Give a folder, made if it is not there; it is removed again if it is empty at the end.

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
        with contextlib.suppress(OSError):  # there are files in it
            path.rmdir()


@contextlib.contextmanager
def temporary_folder(beside: Path) -> Iterator[Path]:
    """Give a folder within `beside` that is removed, with all in it, when the block ends.

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
    """Give a temporary file without a name, which is gone when the block ends, or the process.

    Parameters
    ----------
    folder : Path
        Where it is to be.
    """
    with contextlib.ExitStack() as opened:
        file = opened.enter_context(tempfile.TemporaryFile(dir=folder))
        opened.callback(_close, file)
        yield file


def _close(file: BinaryIO) -> None:
    """Close a file in which nobody wants anything more: a full disk may say so once more."""
    with contextlib.suppress(OSError):
        file.close()


def reach_disk(file: BinaryIO) -> None:
    """Let the disk take what was written, and tell if it does not.

    A network disk may say only when a file is closed that it is full, and what is read before is
    not what was written. A local disk says so at once: for it this costs nothing.

    Raises
    ------
    OSError
        If the disk does not take it.
    """
    file.flush()
    os.close(os.dup(file.fileno()))


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


def _mode_of(target: Path) -> int | None:
    """Return the permissions of a file, None if there is none."""
    try:
        return os.stat(target).st_mode & 0o777
    except FileNotFoundError:
        return None


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


def describe_write_error(target: Path, error: OSError | ValueError) -> BareEarthError:
    """Turn an operating system error met while writing `target` into a sentence."""
    reason = str(error)
    if isinstance(error, OSError):
        reason = _REASONS.get(error.errno or 0, error.strerror or reason)
    return BareEarthError(f"Cannot write {shown(target)}: {reason}.")
