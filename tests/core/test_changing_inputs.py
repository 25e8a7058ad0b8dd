"""Inputs that somebody replaces, cuts off, deletes or appends to while they are worked on.

Each run ends with a sentence, or with what it would have written had nobody touched the file.
"""

import os
import sys

import numpy as np
import pytest
import surveys
from runs import (
    classify_file,
    classify_tiles,
    write_height_above_ground,
    write_key_points,
)

from bare_earth import BareEarthError, Progress
from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.filters.slope import SlopeFilter
from bare_earth.algorithms.runs.entry import terrain
from bare_earth.algorithms.runs.requests import TerrainRequest
from bare_earth.algorithms.tools.rasters.step import RasterFiles

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="open files are locked there")
METHOD = SlopeFilter(preset="whitebox")
HERE, DISK = Resources(threads=1), Resources(threads=1, memory=0.001)
RUNS = {
    "classify": lambda one, out, heard: classify_file(
        one, out, METHOD, resources=HERE, progress=heard
    ),
    "classify from disk": lambda one, out, heard: classify_file(
        one, out, METHOD, resources=DISK, progress=heard
    ),
    "height": lambda one, out, heard: write_height_above_ground(
        one, out, resources=HERE, progress=heard
    ),
    "height from disk": lambda one, out, heard: write_height_above_ground(
        one, out, resources=DISK, progress=heard
    ),
    "key points": lambda one, out, heard: write_key_points(one, out, progress=heard),
    "terrain": lambda one, out, heard: terrain(
        one, TerrainRequest(rasters=RasterFiles(dtm=out), resources=HERE), heard
    ),
}


def replaced(path):
    other = path.with_name("other")
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 0xFF
    other.write_bytes(data)
    other.replace(path)


def written_over(path):
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 0xFF
    path.write_bytes(data)


def appended_to(path):
    with open(path, "ab") as file:
        file.write(b"more")


CHANGES = {
    "replaced": replaced,
    "written over": written_over,
    "cut off": lambda path: os.truncate(path, path.stat().st_size // 2),
    "emptied": lambda path: os.truncate(path, 0),
    "deleted": os.unlink,
    "appended to": appended_to,
}


class Meanwhile(Progress):
    """Changes a file as soon as a share of the work is done."""

    def __init__(self, path, change, when):
        self.path, self.change, self.when, self.done = path, change, when, False

    def report(self, fraction):
        if fraction >= self.when and not self.done:
            self.done = True
            self.change(self.path)


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory):
    """Return the bytes of an input, and of what each run makes of it."""
    folder, made = tmp_path_factory.mktemp("undisturbed"), {}

    def of(name, suffix):
        if (name, suffix) not in made:
            points = surveys.strip(6000, 150.0, 90.0)
            classes = 1 + (np.arange(len(points)) % 3 > 0)
            source = surveys.write(folder / f"in{suffix}", points, classes=classes)
            out = folder / ("out.tif" if name == "terrain" else f"out{suffix}")
            RUNS[name](source, out, Progress())
            made[name, suffix] = source.read_bytes(), out.read_bytes()
        return made[name, suffix]

    return of


@pytest.mark.parametrize("suffix", [pytest.param(".las", marks=pytest.mark.long), ".laz"])
@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize("name", RUNS)
@pytest.mark.parametrize(
    "when", [0.5, *(pytest.param(when, marks=pytest.mark.long) for when in (0.01, 0.3, 0.8, 0.95))]
)
def test_a_changed_input_is_told_or_made_no_difference(
    undisturbed, tmp_path, name, change, when, suffix
):
    source = tmp_path / f"in{suffix}"
    out = tmp_path / ("out.tif" if name == "terrain" else f"out{suffix}")
    data, expected = undisturbed(name, suffix)
    source.write_bytes(data)
    out.write_bytes(b"old")
    heard = Meanwhile(source, CHANGES[change], when)
    told = ("has changed while", "does not exist", "damaged", "is not a LAS")
    try:
        RUNS[name](source, out, heard)
    except BareEarthError as error:
        assert any(each in str(error) for each in told), error
        assert out.read_bytes() == b"old"
    else:
        assert out.read_bytes() == expected
    assert heard.done
    assert not list(tmp_path.glob(".*"))


@pytest.mark.parametrize("change", CHANGES)
@pytest.mark.parametrize(
    "when", [0.4, *(pytest.param(when, marks=pytest.mark.long) for when in (0.1, 0.6, 0.8))]
)
def test_a_changed_tile_of_a_survey_is_told_or_made_no_difference(tmp_path, change, when):
    def survey(name, heard=None):
        folder, out = tmp_path / name, tmp_path / f"{name}-out"
        surveys.cut(folder, surveys.strip(12_000), 6)
        if heard is not None:
            heard.path = folder / "2.laz"
        done = classify_tiles([folder], out, METHOD, progress=heard or Progress())
        return done, surveys.bytes_of(out)

    _, expected = survey("undisturbed")
    heard = Meanwhile(None, CHANGES[change], when)
    done, found = survey("disturbed", heard)
    assert heard.done
    names = {os.path.basename(each) for each in done.failures}
    assert set(found) == set(expected) - names
    assert all(found[each] == expected[each] for each in found)
