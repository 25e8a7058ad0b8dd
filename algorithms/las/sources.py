"""Opening input files, and telling in a sentence what is wrong with them."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import BinaryIO, Iterator

from ..core.errors import BareEarthError


def open_source(path: Path) -> BinaryIO:
    """Open a file to read its bytes.

    Raises
    ------
    BareEarthError
        If it is missing, a folder, or may not be read.
    """
    if path.is_dir():
        raise BareEarthError(f"{path} is a folder. Give a .las or .laz file.")
    try:
        return open(path, "rb")
    except FileNotFoundError:
        raise BareEarthError(f"{path} does not exist. Check the path.") from None
    except PermissionError:
        raise BareEarthError(
            f"You have no permission to read {path}. Ask for it, or copy the file."
        ) from None
    except OSError as error:
        raise BareEarthError(f"Cannot read {path}: {error.strerror or error}.") from error


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
