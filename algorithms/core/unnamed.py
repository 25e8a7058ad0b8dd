"""Temporary files without a name, for data that wait on disk."""

from __future__ import annotations

import contextlib
import os
import tempfile
from pathlib import Path
from typing import BinaryIO, Iterator


@contextlib.contextmanager
def unnamed_file(folder: Path) -> Iterator[BinaryIO]:
    """Yield a temporary file without a name on the disk of a folder, which is removed when the
    block or the process ends.
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
    """Write buffered data to the disk, before they are read again; OSError if the disk does not
    accept them.
    """
    # A full network disk may report an error only when a file is closed. Until then, reading the
    # file can return wrong data. A local disk reports the error at once, so this costs nothing
    # there.
    file.flush()
    os.close(os.dup(file.fileno()))
