"""Inputs that somebody replaces, cuts off, deletes or appends to while they are worked on.

Each run ends with a sentence, or with what it would have written had nobody touched the file.
"""

import os
import sys

import numpy as np
import pytest
import surveys
from matrices import covering
from runs import FAST

from bare_earth import BareEarthError, Progress, classify, heights, key_points, terrain

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="open files are locked there")
HERE, DISK = {"threads": 1}, {"threads": 1, "memory": 0.001}
RUNS = {
    "classify": (classify, {**FAST, **HERE}),
    "classify from disk": (classify, {**FAST, **DISK}),
    "height": (heights, HERE),
    "height from disk": (heights, DISK),
    "key points": (key_points, {}),
    "terrain": (terrain, HERE),
}


def run(name, source, out, progress=None):
    action, how = RUNS[name]
    files = {"dtm": out} if action is terrain else {"output": out}
    action(source, progress=progress, **files, **how)


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
            run(name, source, out)
            made[name, suffix] = source.read_bytes(), out.read_bytes()
        return made[name, suffix]

    return of


@pytest.mark.rest(but="0.5-classify-written over-.laz")
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
    progress = Meanwhile(source, CHANGES[change], when)
    told = ("has changed while", "does not exist", "damaged", "is not a LAS")
    try:
        run(name, source, out, progress)
    except BareEarthError as error:
        assert any(words in str(error) for words in told), error
        assert out.read_bytes() == b"old"
    else:
        assert out.read_bytes() == expected
    assert progress.done
    assert not list(tmp_path.glob(".*"))


@pytest.mark.rest(but="written over-0.8")
@pytest.mark.parametrize(("change", "when"), covering(list(CHANGES), [0.4, 0.6, 0.1, 0.8]))
def test_a_changed_tile_of_a_survey_is_told_or_made_no_difference(tmp_path, change, when):
    def survey(name, progress=None):
        folder, out = tmp_path / name, tmp_path / f"{name}-out"
        surveys.cut(folder, surveys.strip(12_000), 6)
        if progress is not None:
            progress.path = folder / "2.laz"
        done = classify([folder], out, progress=progress, **FAST)
        return done, surveys.bytes_of(out)

    _, expected = survey("undisturbed")
    progress = Meanwhile(None, CHANGES[change], when)
    done, found = survey("disturbed", progress)
    assert progress.done
    names = {os.path.basename(path) for path in done.failures}
    assert set(found) == set(expected) - names
    assert all(found[name] == expected[name] for name in found)
