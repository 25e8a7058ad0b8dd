"""The labelled point clouds that tests use where they are there."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

FOLDER = Path(os.environ.get("BARE_EARTH_DATA", Path(__file__).parents[3] / "shared" / "data"))


def real(name: str) -> Path:
    """Return the path of a cloud; skip the test where it is not there."""
    path = FOLDER / name
    if not path.is_file():
        pytest.skip(f"{path} is not here")
    return path
