"""The labelled point clouds that tests use where they are there."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks.data import find


def real(name: str) -> Path:
    """Return the path of a cloud; skip the test where it is not there."""
    path = find(name)
    if not path.is_file():
        pytest.skip(f"{path} is not here")
    return path
