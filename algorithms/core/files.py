"""Writes output files that are complete or do not exist."""

from __future__ import annotations

import contextlib
import errno
import itertools
import os
import stat
from pathlib import Path
from types import TracebackType
from typing import Iterable, Iterator

from .errors import BareEarthError, OutputInUse
from .temporary import (
    IN_USE,
    MARKS_LENGTH,
    is_temporary,
    make_temporary,
    make_temporary_folder,
    patiently,
    remove,
    remove_leftovers,
    remove_temporary,
    shown,
)

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


MARKS = "x" * MARKS_LENGTH  # as long as the marks of a temporary folder
_MADE_BESIDE = f"{MARKS}/{'x' * 16}"  # as long as the files that runs make in one
# No file system that is met allows names of more than 255 characters.
_LONGEST_ENDING = 240


# Endings of files; ".copc.laz" must come before ".laz".
_ENDINGS = (".copc.laz", ".las", ".laz", ".vpc", ".txt", ".tif", ".tiff")


def split_name(path: Path) -> tuple[str, str]:
    """Return the name of a file without its ending, and the ending, such as ``.copc.laz``; the
    ending is empty for folders and for other kinds of files.
    """
    ending = next((known for known in _ENDINGS if path.name.lower().endswith(known)), "")
    stem = path.name[: -len(ending) or None]
    return stem, path.name[len(stem) :]


def check_output(target: Path, sources: tuple[Path, ...] = ()) -> None:
    """Refuse, before any work is done, an output that could not be written at the end, or is one of
    the sources.
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
        _mode_of(target)  # fails if the name is too long
        check_lengths(target.parent, [_MADE_BESIDE, f"{MARKS}/{target.name}"])
        remove_temporary(make_temporary(target))
        check_free(target)
    except (OSError, ValueError) as error:  # a name with a null character is a ValueError
        raise describe_write_error(target, error) from error


def make_work_folder(path: Path) -> None:
    """Make a hidden folder in a folder of outputs, in which a run may remove all files; refuse a
    link.
    """
    # With a link, another user of a shared folder could make a run remove files elsewhere.
    path.mkdir(exist_ok=True)
    # Windows has more than one kind of links.
    if path.resolve() != path.parent.resolve() / path.name:
        raise BareEarthError(f"{path} is a link to another folder. Remove it, and run it again.")


def check_lengths(folder: Path, names: Iterable[str]) -> None:
    """Refuse a folder, which need not exist yet, if the paths of files in it would be too long;
    `names` are relative paths.
    """
    # Windows allows most programs, QGIS among them, 259 characters.
    existing = next((parent for parent in (folder, *folder.parents) if parent.is_dir()), folder)
    longest = max(len(os.path.abspath(folder / name)) for name in names)
    length = longest - len(os.path.abspath(existing)) - MARKS_LENGTH - 2
    ending = "x" * min(max(length, 1), _LONGEST_ENDING)
    try:
        remove_temporary(make_temporary(existing / f"x.{ending}"))
    except FileNotFoundError as error:
        raise BareEarthError(
            f"Cannot write into {folder}: its path is too long. With the names of files it would"
            f" have {longest} characters. Choose a folder with a shorter path."
        ) from error


def check_distinct(outputs: Iterable[Path | None]) -> None:
    """Refuse, before any work is done, outputs of one run if two are the same file."""
    wanted = [path for path in outputs if path is not None]
    for first, second in itertools.combinations(wanted, 2):
        if is_same_file(first, second):
            raise BareEarthError(f"Two outputs are the same file, {first}. Give each its own name.")


def is_same_file(first: Path, second: Path) -> bool:
    """Return whether two paths name the same file, which need not exist yet."""
    if first.exists() and second.exists():
        return os.path.samefile(first, second)
    return os.path.normcase(first.resolve()) == os.path.normcase(second.resolve())


class Outputs(contextlib.ExitStack):
    """The output files of a run, which get their names together when the block ends; after an
    exception, such as a cancel, they are removed, and old files stay unchanged.
    """

    def __init__(self) -> None:
        super().__init__()
        # The temporary file or folder of each output, its target, and the names of files that it
        # makes out of date.
        self._unnamed: list[tuple[Path, Path, tuple[str, ...]]] = []

    def file(self, target: Path, outdated: Iterable[str] = ()) -> Path:
        """Return a temporary file beside the target, with its ending and the permissions of an old
        target; at the end, `outdated` files beside the target, which describe the old one, are
        removed.
        """
        # Libraries choose the format by the ending.
        with write_errors_told(target):
            temporary = make_temporary(target, _mode_of(target))
        return self._add(temporary, target, outdated)

    def files(self, target: Path, outdated: Iterable[str] = ()) -> Path:
        """Return the target in a temporary folder, for formats with several files."""
        with write_errors_told(target):
            folder = make_temporary_folder(target.parent)
        return self._add(folder, target, outdated) / target.name

    def waiting(self, target: Path) -> Path:
        """Return the temporary path of an output; the target itself if it has none."""
        for temporary, name, _ in self._unnamed:
            if name == target:
                return temporary / target.name if temporary.is_dir() else temporary
        return target

    def _add(self, temporary: Path, target: Path, outdated: Iterable[str]) -> Path:
        self.callback(remove_temporary, temporary)
        self._unnamed.append((temporary, target, tuple(outdated)))
        return temporary

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> bool | None:
        if error is None:
            try:
                self._finish()
            except BaseException as raised:
                super().__exit__(type(raised), raised, raised.__traceback__)
                raise
        elif isinstance(error, OSError) and self._unnamed:
            _, target, _ = next(
                (output for output in self._unnamed if str(output[0]) in str(error.filename)),
                self._unnamed[-1],
            )
            super().__exit__(kind, error, traceback)
            raise describe_write_error(target, error) from error
        return super().__exit__(kind, error, traceback)

    def _finish(self) -> None:
        """Give all files their names; if another program has an old file open, keep all new files
        under other names, which the error states.
        """
        moves = []
        for temporary, target, _ in self._unnamed:
            names = sorted(os.listdir(temporary)) if temporary.is_dir() else None
            new = [target] if names is None else [target.with_name(name) for name in names]
            moves += [(temporary / path.name if names else temporary, path) for path in new]
        outdated = {target.with_name(name) for _, target, names in self._unnamed for name in names}
        outdated -= {target for _, target in moves}
        try:
            for path in (*(target for _, target in moves), *outdated):
                check_free(path)
            for source, target in moves:
                with write_errors_told(target):
                    mode = _mode_of(target)
                    if mode is not None:
                        with contextlib.suppress(OSError):  # not every file system has permissions
                            os.chmod(source, mode)
                    rename(source, target)
        except OutputInUse as error:
            raise OutputInUse(f"{error} {_kept(moves)}") from error
        for path in outdated:
            remove(path)


def _kept(moves: Iterable[tuple[Path, Path]]) -> str:
    """Give new files free names, and return a sentence with these."""
    names = []
    for source, target in moves:
        if source.exists() and not is_temporary(target):
            name = free_path(target)
            patiently(os.rename, source, name)
            names.append(str(name))
    return f"What was made is kept as {' and '.join(names)}." if names else ""


def free_path(path: Path) -> Path:
    """Return a path with a similar name in the same folder that does not exist yet."""
    ending = split_name(path)[1] or path.suffix
    stem = path.name[: -len(ending) or None]
    numbers = itertools.chain([""], itertools.count(2))
    names = (path.with_name(f"{stem}-new{number}{ending}") for number in numbers)
    return next(name for name in names if not os.path.lexists(name))


@contextlib.contextmanager
def replacing(target: Path) -> Iterator[Path]:
    """Yield a temporary file, which becomes `target` when the block ends, as in `Outputs`."""
    with Outputs() as outputs:
        yield outputs.file(target)


@contextlib.contextmanager
def new_folder(path: Path) -> Iterator[Path]:
    """Make a folder if it does not exist, and yield it; remove it at the end if it is empty."""
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
def temporary_folder(parent: Path) -> Iterator[Path]:
    """Yield a new folder inside `parent`, which is removed with its contents when the block ends;
    if the process is killed, `remove_leftovers` does so later.
    """
    with write_errors_told(parent):
        folder = make_temporary_folder(parent)
    try:
        yield folder
    finally:
        remove_temporary(folder)


def check_free(target: Path) -> None:
    """Refuse (`OutputInUse`) a file that the system would not replace, as Windows does not if the
    file is read-only or open in another program.
    """
    try:
        if target.is_file():
            if os.name == "nt" and not os.stat(target).st_mode & stat.S_IWRITE:
                raise _in_use(target)
            patiently(os.replace, target, target)  # fails in Windows if it would fail at the end
    except OSError as error:
        if getattr(error, "winerror", None) in IN_USE:
            raise _in_use(target) from error


def _in_use(target: Path) -> OutputInUse:
    """Return the error for a file that cannot be replaced."""
    writable = os.stat(target).st_mode & stat.S_IWRITE
    reason = (
        _REASONS[errno.EBUSY]
        if writable
        else "it is read-only. Allow changes of it, or choose another name"
    )
    return OutputInUse(f"Cannot write {shown(target)}: {reason}.")


def rename(temporary: Path, target: Path) -> None:
    """Rename a file on the same disk; an old target is replaced."""
    # A network disk may report an error although it has renamed the file: if its first answer is
    # lost, the request is repeated, and the answer is that the temporary file does not exist.
    written = os.stat(temporary)
    try:
        patiently(os.replace, temporary, target)
    except OSError as error:
        with contextlib.suppress(OSError):
            # Some network disks of Windows have no inode numbers.
            if written.st_ino and os.path.samestat(written, os.stat(target)):
                return
        if getattr(error, "winerror", None) in IN_USE and os.path.exists(target):
            raise _in_use(target) from error
        raise


def _mode_of(target: Path) -> int | None:
    """Return the permissions of a file, None if it does not exist."""
    try:
        return os.stat(target).st_mode & 0o777
    except FileNotFoundError:
        return None


@contextlib.contextmanager
def write_errors_told(target: Path) -> Iterator[None]:
    """Turn errors of the operating system into a `BareEarthError` that names the target."""
    try:
        yield
    except OSError as error:
        raise describe_write_error(target, error) from error


def describe_write_error(target: Path, error: OSError | ValueError) -> BareEarthError:
    """Return the error for an error of the operating system while writing `target`."""
    reason = str(error)
    if isinstance(error, OSError):
        reason = _REASONS.get(error.errno or 0, error.strerror or reason)
    return BareEarthError(f"Cannot write {shown(target)}: {reason}.")
