"""Temporary files on a disk that becomes full, and says so in one of two ways."""

import errno
import io
import itertools
import os
import tempfile

import pytest

# A local disk takes nothing more; a network disk takes all, and says it when a file is closed.
TELLS = pytest.mark.parametrize("tells", ["write", "close"])


def become_full(monkeypatch, room, tells, spared=0):
    """Let files without a name, but the first few, hold no more than `room` bytes."""
    made, small, close = itertools.count(), set(), os.close

    def full():
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    class File(io.FileIO):
        def write(self, data):
            if tells == "write" and self.tell() + len(data) > room:
                full()
            return super().write(data)

        def close(self):
            if self.closed:
                return
            is_full = tells == "close" and os.fstat(self.fileno()).st_size > room
            super().close()
            if is_full:
                full()

    def temporary_file(dir):
        if next(made) < spared:
            return whole(dir=dir)
        number, name = tempfile.mkstemp(dir=dir)
        small.add(os.fstat(number).st_ino)
        close(number)
        file = io.BufferedRandom(File(name, "r+b"))
        os.unlink(name)
        return file

    def closed(number):
        told = os.fstat(number)
        close(number)
        if tells == "close" and told.st_ino in small and told.st_size > room:
            full()

    whole = tempfile.TemporaryFile
    monkeypatch.setattr(tempfile, "TemporaryFile", temporary_file)
    monkeypatch.setattr(os, "close", closed)
