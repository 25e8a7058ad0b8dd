"""Outputs whose paths are nearly as long as Windows lets them be; see `sitecustomize.py` here."""

import os

import pytest
import surveys
from runs import said

pytestmark = pytest.mark.processes
SLOPE = ("--method", "slope", "--threads", "1", "--crs", "EPSG:25832")
LONGEST = 230


@pytest.fixture(scope="module")
def survey(tmp_path_factory):
    folder = tmp_path_factory.mktemp("in")
    surveys.write(folder / "one.laz", surveys.strip(9000, 150.0, 130.0))
    surveys.cut(folder / "many", surveys.strip(9000, 150.0, 130.0), 2)
    return folder


def folder_for(tmp_path, longest):
    """Return a new folder in which a file of this name has the longest path."""
    folder = tmp_path / "f"
    length = LONGEST - len(str(tmp_path)) - len(longest) - 2
    while length > 200:
        folder, length = folder.with_name("f" * 100) / "f", length - 101
    folder = folder.with_name("f" * length)
    folder.mkdir(parents=True)
    assert len(str(folder / longest)) == LONGEST
    return folder


def test_this_is_as_on_windows(tmp_path):
    path = tmp_path / ("a" * (260 - len(str(tmp_path)) - 1))
    assert len(str(path)) == 260
    log = os.environ["WINDOWS_FILES_LOG"]
    try:
        os.environ["WINDOWS_FILES_LOG"] = str(tmp_path / "log")
        with pytest.raises(FileNotFoundError):
            path.write_text("")
        with open(tmp_path / "b", "w") as file, pytest.raises(PermissionError):
            os.replace(file.name, tmp_path / "c")
    finally:
        os.environ["WINDOWS_FILES_LOG"] = log
    assert "260 characters" in (tmp_path / "log").read_text()


@pytest.mark.parametrize(
    ("longest", "words"),
    [
        ("ground.copc.laz", "classify {one} {out}/ground.copc.laz --memory 0.001"),
        ("d.tif", "classify {one} {out}/c.las --dtm {out}/d.tif --hillshade {out}/h.tif"),
        ("0.laz", "classify {many} {out} --height-above-ground --dtm {out}/d.tif"),
    ],
)
def test_classified_files_and_rasters(survey, tmp_path, longest, words):
    out = folder_for(tmp_path, longest)
    given = words.format(one=survey / "one.laz", many=survey / "many", out=out).split()
    code, _, errors = said(*given, *SLOPE)
    assert code == 0 and ".~" not in errors and (out / longest).stat().st_size
    assert not [name for name in os.listdir(out) if name.startswith(".~")]


@pytest.mark.parametrize("source", ["one.laz", "many"])
def test_a_delivery(survey, tmp_path, source):
    longest = "quality/ground_density.tif"
    out = folder_for(tmp_path, longest)
    words = ("deliver", "drone-site", survey / source, out, "--threads", "1")
    for _ in range(2):  # a new one, and in place of that
        code, said_of_it, errors = said(*words)
        assert code == 0, errors
        assert (out / longest).stat().st_size and ".~" not in said_of_it + errors
    assert os.listdir(out.parent) == [out.name]


def test_a_path_that_is_too_long_is_refused_before_any_work(survey, tmp_path):
    out = folder_for(tmp_path, "d.tif") / ("f" * 16)
    out.mkdir()
    log, os.environ["WINDOWS_FILES_LOG"] = os.environ["WINDOWS_FILES_LOG"], str(tmp_path / "log")
    try:
        for words in ("classify {0} {1}/c.las", "deliver flood {0} {1}"):
            code, _, errors = said(*words.format(survey / "one.laz", out).split())
            assert code == 1 and "its path is too long" in errors
    finally:
        os.environ["WINDOWS_FILES_LOG"] = log
    assert not os.listdir(out)
