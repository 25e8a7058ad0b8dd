"""What is made of many files in one go, and the public API."""

import json

import laspy
import numpy as np
import pytest
from runs import FAST
from surveys import bytes_of, cut, finished, strip, write
from toy_sink import CountPoints

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.engine.run import Run
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.survey.files import Inputs
from bare_earth.algorithms.tools.ground.step import LabelGround


@pytest.fixture
def survey(tmp_path):
    """One file, and the same points in six."""
    points = strip(9000, 240.0, 130.0)
    cut(tmp_path / "in", points, 6)
    return write(tmp_path / "one.laz", points)


def _rows(paths, *names):
    rows = []
    for path in paths:
        las = laspy.read(path)
        rows.append(np.column_stack([np.asarray(las[name]) for name in ("x", "y", "z", *names)]))
    rows = np.round(np.concatenate(rows), 3)
    return rows[np.lexsort(rows.T)]


@pytest.mark.rest
def test_classes_rasters_and_heights_of_many_files_in_one_go(survey, tmp_path):
    words = ["--method", "slope", "--height-above-ground"]
    dtm, shade = tmp_path / "dtm.tif", tmp_path / "shade.tif"
    one = ["classify", str(survey), str(tmp_path / "out.laz"), "--dtm", str(tmp_path / "1.tif")]
    assert main([*one, *words]) == 0
    many = ["classify", str(tmp_path / "in"), str(tmp_path / "out"), "--dtm", str(dtm)]
    assert main([*many, "--hillshade", str(shade), *words]) == 0
    names = ("classification", "HeightAboveGround")
    found = _rows(finished(tmp_path / "out"), *names)
    expected = _rows([tmp_path / "out.laz"], *names)
    assert np.array_equal(found[:, :4], expected[:, :4])
    assert np.allclose(found[:, 4], expected[:, 4], atol=1e-3) and np.ptp(found[:, 4]) > 5.0
    assert dtm.stat().st_size and shade.stat().st_size
    assert not list((tmp_path / "out" / ".bare-earth").glob("waiting*"))


@pytest.mark.rest
def test_ground_alone_of_many_files_with_heights_and_without(survey, tmp_path):
    bare_earth.classify(survey, tmp_path / "all.laz", **FAST)
    ground = _rows([tmp_path / "all.laz"], "classification")
    ground = ground[ground[:, 3] == 2]
    for heights in (False, True):
        folder, outputs = tmp_path / f"{heights}", {"height_above_ground": heights}
        summary = bare_earth.classify(tmp_path / "in", folder, ground_only=True, **outputs, **FAST)
        assert np.array_equal(_rows(finished(folder), "classification"), ground)
        assert summary.ground_count == len(ground)


def test_of_ground_alone_there_is_no_surface_of_many_files(survey, tmp_path):
    dsm = tmp_path / "dsm.tif"
    with pytest.raises(BareEarthError, match="need all points"):
        bare_earth.classify(tmp_path / "in", tmp_path / "out", dsm=dsm, ground_only=True, **FAST)


@pytest.mark.rest
def test_the_expected_error_of_a_run_that_classifies_is_that_of_its_output(survey, tmp_path):
    # It is told from the points that are not ground as well.
    one, many, after = (tmp_path / f"{name}.tif" for name in ("one", "many", "after"))
    bare_earth.classify(survey, tmp_path / "out.laz", expected_error=one, **FAST)
    bare_earth.classify(tmp_path / "in", tmp_path / "many", expected_error=many, **FAST)
    bare_earth.terrain(tmp_path / "out.laz", expected_error=after)
    assert one.read_bytes() == many.read_bytes() == after.read_bytes()


@pytest.mark.rest
def test_heights_go_on_where_a_run_ended(survey, tmp_path):
    sources, folder = tmp_path / "classified", tmp_path / "out"
    bare_earth.classify(tmp_path / "in", sources, **FAST)
    bare_earth.heights(sources, folder)
    before = bytes_of(folder)
    (folder / "3.laz").unlink()
    summary = bare_earth.heights(sources, folder, resume=True)
    assert summary.kept_count == 5 and summary.done_count == 6
    assert bytes_of(folder) == before
    assert [path.name for path in summary.tiles] == [path.name for path in finished(folder)]


@pytest.mark.rest
def test_key_points_of_many_files_are_as_good_as_those_of_one(survey, tmp_path):
    bare_earth.classify(tmp_path / "in", tmp_path / "classified", **FAST)
    bare_earth.classify(survey, tmp_path / "classified.laz", **FAST)
    one = bare_earth.key_points(tmp_path / "classified.laz", tmp_path / "keys.laz")
    words = ["key-points", str(tmp_path / "classified"), str(tmp_path / "keys")]
    assert main(words) == 0
    # The blocks are the same, whatever the files.
    names = ("classification",)
    found = _rows(finished(tmp_path / "keys"), *names)
    assert np.array_equal(found, _rows([tmp_path / "keys.laz"], *names))
    assert one.key_point_count == np.count_nonzero(found[:, 3] == 8) > 100
    assert main([*words, "--resume", "--json"]) == 0


def test_the_public_functions_take_one_file_and_many(survey, tmp_path):
    one = bare_earth.classify(str(survey), tmp_path / "one-out.laz", **FAST)
    many = bare_earth.classify(tmp_path / "in", tmp_path / "many", **FAST)
    assert one.ground_count == many.ground_count > 5000
    heights = bare_earth.heights(tmp_path / "one-out.laz", tmp_path / "heights.laz")
    assert heights.maximum > 5.0 and heights.unit == "metre"
    shares, files = [], {name: tmp_path / f"{name}.tif" for name in ("dtm", "dsm")}
    size = bare_earth.terrain([tmp_path / "many"], **files, progress=shares.append)
    assert size.ground_count == one.ground_count and files["dsm"].stat().st_size
    assert shares and shares == sorted(shares) and shares[-1] == 1.0
    assert json.dumps(many.failures) == "{}"
    again = bare_earth.classify(tmp_path / "in", tmp_path / "many", **FAST, resume=True)
    assert again.kept_count == many.done_count


@pytest.mark.rest
def test_a_run_knows_nothing_of_what_its_sinks_make(survey, tmp_path):
    sinks = {name: CountPoints(tmp_path / f"{name}.csv") for name in ("one", "many", "classified")}
    count = Run((sinks["one"],)).work(Inputs(survey))
    assert Run((sinks["many"],)).work(Inputs(tmp_path / "in")) == count > 10
    one, many = ((tmp_path / f"{name}.csv").read_text() for name in ("one", "many"))
    assert one == many
    rows = np.loadtxt(tmp_path / "one.csv", delimiter=",", dtype=int)
    assert rows[:, 2].sum() == 9000 and not rows[:, 3].any()
    # Behind another step, it sees what that has found.
    ground = LabelGround(METHODS["slope"].parameters(preset="whitebox"))
    run = Run((ground, sinks["classified"]))
    out = tmp_path / "out"
    done = run.work(Inputs(tmp_path / "in"), out, vpc=out / "classified.vpc")
    rows = np.loadtxt(tmp_path / "classified.csv", delimiter=",", dtype=int)
    assert rows[:, 3].sum() == done.ground_count > 1000
