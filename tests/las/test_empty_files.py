"""Sound files without points: described, written unchanged, and told."""

import json
import pickle

import laspy
import numpy as np
import pytest
from runs import FAST_WORDS
from surveys import write_points

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.las.opening import NoPoints, open_las


def write(path, count, west=0.0):
    random = np.random.default_rng(1)
    x, y = random.uniform(0, 40, (2, count))
    return write_points(path, west + x, y, 50 + 0.1 * x, 2, scale=0.01)


@pytest.fixture(scope="module")
def tiles(tmp_path_factory):
    folder = tmp_path_factory.mktemp("tiles")
    write(folder / "a.laz", 1000)
    write(folder / "b.laz", 0)
    write(folder / "c.las", 0)
    return folder


@pytest.mark.parametrize("name", ["b.laz", "c.las"])
def test_a_file_without_points_is_described(tiles, name, capsys):
    assert main(["info", str(tiles / name)]) == 0
    assert "minimum    none" in capsys.readouterr().out
    assert main(["info", str(tiles / name), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["point_count"] == 0 and found["minimum"] is None and found["density"] is None


@pytest.mark.parametrize("name", ["b.laz", "c.las"])
@pytest.mark.parametrize("command", ["classify", "height", "key-points", "above-ground"])
def test_a_file_without_points_is_written_unchanged(tiles, name, command, tmp_path, capsys):
    target = tmp_path / name
    outputs = ["--dtm", str(tmp_path / "d.tif"), "--contours", str(tmp_path / "c.geojson")]
    more = outputs if command == "classify" else []
    assert main([command, str(tiles / name), str(target), *more]) == 0
    told = capsys.readouterr()
    assert "holds no points" in told.err and ("d.tif cannot be made" in told.err) == bool(more)
    assert target.read_bytes() == (tiles / name).read_bytes()
    assert [path.name for path in tmp_path.iterdir()] == [name]


@pytest.mark.parametrize("name, target", [("b.laz", "b.las"), ("c.las", "c.laz")])
def test_compression_is_that_of_the_name(tiles, tmp_path, name, target):
    assert bare_earth.classify(tiles / name, tmp_path / target).point_count == 0
    with laspy.open(tmp_path / target) as las:
        assert las.header.point_count == 0
        assert las.header.are_points_compressed == target.endswith("z")


@pytest.mark.parametrize("command", ["classify", "height"])
def test_many_files_some_without_points(tiles, command, tmp_path, capsys):
    assert main([command, str(tiles), str(tmp_path / "out")]) == 0
    assert "b.laz, c.las hold no" in capsys.readouterr().err
    for name in ("b.laz", "c.las"):
        assert (tmp_path / "out" / name).read_bytes() == (tiles / name).read_bytes()
    assert laspy.read(tmp_path / "out" / "a.laz").header.point_count == 1000


def test_many_files_none_with_points(tiles, tmp_path):
    found = bare_earth.classify([tiles / "b.laz", tiles / "c.las"], tmp_path / "out")
    assert found.done_count == found.tile_count == 2 and not found.failures
    assert (tmp_path / "out" / "c.las").read_bytes() == (tiles / "c.las").read_bytes()


def test_tools_that_read_many_files_leave_out_those_without_points(tiles, tmp_path):
    one, all_of_them = tmp_path / "one.tif", tmp_path / "all.tif"
    bare_earth.terrain(tiles / "a.laz", dtm=one)
    bare_earth.terrain(tiles, dtm=all_of_them)
    assert one.read_bytes() == all_of_them.read_bytes()
    assert bare_earth.quality(tiles).points == 1000
    with pytest.raises(BareEarthError, match="no points"):
        bare_earth.terrain(tiles / "b.laz", dtm=tmp_path / "none.tif")
    with pytest.raises(BareEarthError, match="None of the files holds"):
        bare_earth.quality([tiles / "b.laz", tiles / "c.las"])


@pytest.mark.rest
def test_a_delivery_holds_files_without_points(tiles, tmp_path):
    assert main(["deliver", "survey", str(tiles), str(tmp_path / "out"), *FAST_WORDS]) == 0
    (copied,) = (tmp_path / "out").rglob("b.laz")
    assert copied.read_bytes() == (tiles / "b.laz").read_bytes()


def test_a_file_that_was_not_written_to_its_end_is_refused(tiles, tmp_path):
    layout = open_las(tiles / "a.laz")
    for name in ("las", "laz"):
        path = write(tmp_path / f"cut.{name}", 500)
        data = bytearray(path.read_bytes())
        data[247:255], data[107:111] = bytes(8), bytes(4)  # numbers of points in the header
        path.write_bytes(data)
        with pytest.raises(BareEarthError, match="not written to its end"):
            bare_earth.classify(path, tmp_path / "out.laz")
    assert layout.count and isinstance(pickle.loads(pickle.dumps(NoPoints("none"))), NoPoints)
