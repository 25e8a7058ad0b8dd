"""Opens input files, and makes the errors for files that cannot be read."""

from __future__ import annotations

import contextlib
import os
import stat
from pathlib import Path
from typing import BinaryIO, Iterator, NamedTuple

from ..core.errors import BareEarthError


def read_text(path: Path) -> str:
    """Return the contents of a text file, or raise UnicodeDecodeError if it is not UTF-8."""
    with open_source(path) as file:
        return file.read().decode("utf-8-sig")


def open_source(path: Path) -> BinaryIO:
    """Open a file to read its bytes; refuse a path that is missing, not readable, a folder, or
    another kind of file, such as a pipe.
    """
    try:
        kind = os.stat(path).st_mode
        if stat.S_ISDIR(kind):
            raise BareEarthError(f"{path} is a folder. Give a file.")
        if not stat.S_ISREG(kind):  # to open a pipe would wait for a writer
            raise BareEarthError(f"{path} is a pipe or a device, not a file. Give a file.")
        return open(path, "rb")
    except FileNotFoundError:
        raise BareEarthError(f"{path} does not exist. Check the path.") from None
    except PermissionError:
        raise BareEarthError(
            f"You have no permission to read {path}. Ask for it, or copy the file."
        ) from None
    except OSError as error:
        raise BareEarthError(f"Cannot read {path}: {error.strerror or error}.") from error
    except ValueError as error:  # a null character in the name
        raise BareEarthError(f"Cannot read {path}: {error}.") from error


class FileState(NamedTuple):
    """The state of a file, which shows whether it has changed."""

    size: int  # bytes
    modified: int  # nanoseconds
    inode: int  # shows whether another file has replaced it
    device: int

    @classmethod
    def of(cls, file: BinaryIO) -> FileState:
        """Return the state of an open file."""
        now = os.fstat(file.fileno())
        return cls(now.st_size, now.st_mtime_ns, now.st_ino, now.st_dev)

    def is_same(self, state: FileState) -> bool:
        """Return whether two states belong to the same, unchanged file."""
        # Other computers of a cluster have other inodes and devices for the same file.
        is_here = self.device == state.device
        return self[:2] == state[:2] and (self.inode == state.inode or not is_here)


def changed(path: Path) -> BareEarthError:
    """Return the error for a file that has changed since it was first read."""
    return BareEarthError(f"{path} has changed while it was worked on. Run it again.")


def damaged(path: Path) -> BareEarthError:
    """Return the error for a file whose points cannot all be read."""
    return BareEarthError(
        f"{path} is damaged or cut off: not all of its points can be read. Copy or download it"
        " again."
    )


@contextlib.contextmanager
def damage_told(path: Path) -> Iterator[None]:
    """Turn all errors of the libraries into the error for a damaged file; the block must only call
    libraries.
    """
    # The errors have many types, and panics of the decompressor, which is written in Rust, do not
    # even derive from `Exception`.
    try:
        yield
    except (MemoryError, BareEarthError):
        raise
    except OSError as error:
        raise BareEarthError(f"Cannot read {path}: {error.strerror or error}.") from error
    except Exception as error:
        raise damaged(path) from error
    except BaseException as error:
        if type(error).__name__ == "PanicException":
            raise damaged(path) from error
        raise
