"""Overviews of virtual point clouds: a few points of all files, shown at small scales."""

import json

import laspy
import numpy as np
import pytest
from runs import FAST

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.survey import overview
from bare_earth.algorithms.survey.files import find_files
from bare_earth.algorithms.survey.vpc import read_vpc, write_vpc

SIDE, LONG = 40.0, pytest.mark.long


def write_tile(path, west, point_format=6, scale=0.001, extra=False):
    """Write a plane of 60 x 60 m with a roof, and the number of each point as its intensity."""
    x, y = (axis.ravel() for axis in np.meshgrid(*[np.arange(0.2, SIDE, 0.4)] * 2))
    header = laspy.LasHeader(point_format=point_format, version="1.4")
    header.scales, header.offsets = [scale] * 3, [west, 5_000_000.0, 0.0]
    if extra:
        header.add_extra_dim(laspy.ExtraBytesParams("Amplitude", "u2"))
    las = laspy.LasData(header)
    las.x, las.y = x + west, y + 5_000_000.0
    las.z = np.where((x > 20) & (x < 32) & (y > 20) & (y < 35), 60.0, 50.0)
    las.intensity = np.arange(len(x)) % 60_000
    las.return_number[:] = las.number_of_returns[:] = 1
    if extra:
        las["Amplitude"] = np.arange(len(x)) % 60_000
    las.write(str(path))
    return len(x)


@pytest.fixture
def tiles(tmp_path):
    (tmp_path / "in").mkdir()
    for number in range(3):
        write_tile(tmp_path / "in" / f"{number}.laz", 500_000.0 + number * SIDE)
    return tmp_path / "in"


def classify(tiles, folder, kind="copc.laz", overview=True):
    return bare_earth.classify(tiles, folder, format=kind, overview=overview, **FAST)


def assets_of(vpc):
    return [feature["assets"] for feature in json.loads(vpc.read_text())["features"]]


def rounded(las):
    return {
        (round(x, 3), round(y, 3), round(z, 3), int(c), int(i))
        for x, y, z, c, i in zip(las.x, las.y, las.z, las.classification, las.intensity)
    }


@pytest.mark.rest
def test_a_run_with_copc_writes_points_of_every_file(tiles, tmp_path):
    summary = classify(tiles, tmp_path / "out")
    target = tmp_path / "out" / "classified-overview.copc.laz"
    for assets in assets_of(tmp_path / "out" / "classified.vpc"):
        assert assets["overview"] == {"href": f"./{target.name}", "roles": ["overview"]}
    with laspy.CopcReader.open(str(target)) as reader:
        sample = reader.query()
    assert 0.05 * summary.point_count < len(sample) <= 0.11 * summary.point_count
    # They are points of the files, with their new classes, from everywhere.
    whole = set()
    for path in read_vpc(tmp_path / "out" / "classified.vpc"):
        whole |= rounded(laspy.read(path))
    assert rounded(sample) <= whole and len(rounded(sample)) == len(sample)
    counts, *_ = np.histogram2d(sample.x, sample.y, bins=(9, 3))
    assert counts.min() > 0.3 * counts.mean()
    assert set(np.unique(sample.classification)) == {1, 2}
    assert summary.class_counts == {
        value: sum(int((laspy.read(path).classification == value).sum()) for path in read_vpc(
            tmp_path / "out" / "classified.vpc"))
        for value in (1, 2)
    }  # fmt: skip


@pytest.mark.parametrize(
    ("kind", "wanted"), [("laz", True), pytest.param("copc.laz", False, marks=pytest.mark.long)]
)
def test_without_copc_or_without_the_option_there_is_none(kind, wanted, tiles, tmp_path):
    classify(tiles, tmp_path / "out")
    assert overview.overview_of(tmp_path / "out" / "classified.vpc").is_file()
    classify(tiles, tmp_path / "out", kind, overview=wanted)
    # That of the earlier run is gone.
    assert not overview.overview_of(tmp_path / "out" / "classified.vpc").exists()
    assert all(
        list(assets) == ["data"] for assets in assets_of(tmp_path / "out" / "classified.vpc")
    )


def test_the_files_of_a_folder_do_not_include_it(tiles, tmp_path):
    classify(tiles, tmp_path / "out")
    folder = tmp_path / "out"
    expected = [folder / f"{number}.copc.laz" for number in range(3)]
    assert find_files([folder]) == find_files([folder / "classified.vpc"]) == expected
    # Without its list it is a file like others.
    (folder / "classified.vpc").unlink()
    assert len(find_files([folder])) == 4


def test_it_is_small_however_large_the_survey_is(tiles, tmp_path, monkeypatch):
    monkeypatch.setattr(overview, "_MOST_POINTS", 600)
    classify(tiles, tmp_path / "out")
    target = overview.overview_of(tmp_path / "out" / "classified.vpc")
    assert 300 <= len(laspy.read(target).points) <= 1200


@pytest.mark.rest
def test_files_of_different_kinds_share_one(tmp_path):
    kinds = [(6, 0.001, True), (7, 0.01, False), (6, 0.001, False)]
    files = []
    for number, (point_format, scale, extra) in enumerate(kinds):
        raw = tmp_path / f"{number}.las"
        write_tile(raw, 500_000.0 + number * SIDE, point_format, scale, extra)
        files.append(tmp_path / f"{number}.copc.laz")
        bare_earth.classify(raw, files[-1], **FAST)
    write_vpc(tmp_path / "a.vpc", files, overview=True)
    sample = laspy.read(tmp_path / "a-overview.copc.laz")
    assert sample.header.point_format.id == 6
    for number, file in enumerate(files):
        west = 500_000.0 + number * SIDE
        mine = sample[(sample.x >= west) & (sample.x < west + SIDE)]
        assert len(mine) > 100 and rounded(mine) <= rounded(laspy.read(file))
    first = sample[sample.x < 500_000.0 + SIDE]
    assert (np.asarray(first["Amplitude"]) == np.asarray(first.intensity)).all()


def test_a_file_with_its_name_is_not_overwritten(tmp_path):
    write_tile(tmp_path / "raw.las", 500_000.0)
    mine = tmp_path / "a-overview.copc.laz"
    bare_earth.classify(tmp_path / "raw.las", mine, **FAST)
    before = mine.read_bytes()
    write_vpc(tmp_path / "a.vpc", [mine], overview=True)
    assert mine.read_bytes() == before and list(assets_of(tmp_path / "a.vpc")[0]) == ["data"]


def test_a_failure_leaves_nothing_half_written(tiles, tmp_path, monkeypatch):
    classify(tiles, tmp_path / "out")
    vpc = tmp_path / "out" / "classified.vpc"
    files, before = read_vpc(vpc), set((tmp_path / "out").iterdir())

    def failing(edited, target, *_):
        target.write_bytes(b"half")
        raise BareEarthError("The disk is full.")

    monkeypatch.setattr(overview, "write_copc", failing)
    write_vpc(vpc, files, overview=True)
    assert set((tmp_path / "out").iterdir()) == before - {overview.overview_of(vpc)}
    assert read_vpc(vpc) == files


@pytest.mark.rest
def test_the_command_line_makes_one_on_demand(tiles, tmp_path):
    words = ["classify", str(tiles), str(tmp_path / "out"), "--format", "copc.laz"]
    for more, exists in (([], False), (["--overview"], True)):
        assert main([*words, *more]) == 0
        assert overview.overview_of(tmp_path / "out" / "classified.vpc").exists() == exists
