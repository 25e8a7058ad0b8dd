"""Opening input files, and telling in a sentence what is wrong with them."""

from __future__ import annotations

import contextlib
import os
import stat
from pathlib import Path
from typing import BinaryIO, Iterator, NamedTuple

from ..core.errors import BareEarthError


def read_text(path: Path) -> str:
    """Return what stands in a text file in UTF-8.

    Raises
    ------
    BareEarthError
        If it cannot be read.
    UnicodeDecodeError
        If it is no such text.
    """
    with open_source(path) as file:
        return file.read().decode("utf-8-sig")


def open_source(path: Path) -> BinaryIO:
    """Open a file to read its bytes.

    Raises
    ------
    BareEarthError
        If it is missing, a folder, no ordinary file, or may not be read.
    """
    try:
        kind = os.stat(path).st_mode
        if stat.S_ISDIR(kind):
            raise BareEarthError(f"{path} is a folder. Give a file.")
        if not stat.S_ISREG(kind):  # to open a pipe would wait for somebody to write to it
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
    """By what it is seen that a file is still the same.

    Attributes
    ----------
    size : int
        Its bytes.
    modified : int
        When it was written to, in nanoseconds.
    inode, device : int
        Which file it is on which disk: another one may have taken its name.
    """

    size: int
    modified: int
    inode: int
    device: int

    @classmethod
    def of(cls, file: BinaryIO) -> FileState:
        """Return the state of an open file."""
        now = os.fstat(file.fileno())
        return cls(now.st_size, now.st_mtime_ns, now.st_ino, now.st_dev)

    def is_same(self, other: FileState) -> bool:
        """Return whether two states are those of one file that nobody wrote to between them.

        Another computer of a cluster has other numbers for the same disk and file.
        """
        is_here = self.device == other.device
        return self[:2] == other[:2] and (self.inode == other.inode or not is_here)


def changed(path: Path) -> BareEarthError:
    """Return the error for a file that is not what it was when it was first read."""
    return BareEarthError(f"{path} has changed while it was worked on. Run it again.")


def damaged(path: Path) -> BareEarthError:
    """Return the error for a file whose points cannot be read to their end."""
    return BareEarthError(
        f"{path} is damaged or cut off: not all of its points can be read. Copy or download it"
        " again."
    )


@contextlib.contextmanager
def damage_told(path: Path) -> Iterator[None]:
    """Turn whatever the libraries raise on a damaged file into one sentence.

    Wrap nothing but their calls in it: what they raise is of many kinds, and panics of the
    decompressor, written in Rust, are not even exceptions of the usual sort.
    """
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
