"""The benchmark on a scene small enough for every run: no data, no peers, so that it cannot rot."""

import importlib.util
import re

import numpy as np
import pytest

from bare_earth.algorithms.core.parameters import Declaration
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.core.progress import SILENT
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.las.reading import read_cloud
from bare_earth.algorithms.tools.assess import compare
from benchmarks import (
    accuracy,
    cache,
    data,
    maps,
    measure,
    peers,
    places,
    report,
    spikes,
    tables,
    work,
)
from benchmarks.measure import Filter
from benchmarks.scenes import KINDS, make
from benchmarks.scenes.simple import village
from benchmarks.sensitivity import Place, scaled, sensitivity

# Imported by what draws alone.
pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("matplotlib") is None, reason="there is no matplotlib"
)


def write_village(path):
    """Write a village whose ground is easy to find."""
    write_labelled(path, *village(size=60.0, density=1.0))


def write_labelled(path, points, ground):
    """Write points as LAS with classes 2 and 1, as the data of the benchmark are."""
    import laspy

    las = laspy.LasData(laspy.LasHeader(version="1.2", point_format=0))
    las.header.scales, las.header.offsets = [0.01] * 3, [0.0] * 3
    las.x, las.y, las.z = points
    las.classification = np.where(ground, 2, 1)
    las.return_number[:] = las.number_of_returns[:] = 1
    path.parent.mkdir(parents=True, exist_ok=True)
    las.write(path)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A data folder with a sample and a tile, and nothing written into the repository."""
    for name in ("isprs/samp11.laz", "real/ahn3_urban.laz"):
        write_village(tmp_path / "data" / name)
    monkeypatch.setattr(data, "FOLDER", tmp_path / "data")
    monkeypatch.setattr(cache, "FOLDER", tmp_path / "cache")
    monkeypatch.setattr(report, "IMAGES", tmp_path / "images")
    monkeypatch.setattr(report, "PAGE", tmp_path / "accuracy.md")
    monkeypatch.setattr(peers, "PEERS", (Lowest(), Absent()))
    monkeypatch.setattr(work, "PROCESSES", 1)
    return tmp_path


class Lowest(peers.Peer):
    """A peer that is always installed: all below the median is ground."""

    name, module, package, note = "lowest", "numpy", "numpy", "a test"

    def __init__(self):
        self.calls = 0

    def classify(self, cloud):
        self.calls += 1
        return cloud.z < np.median(cloud.z)


class Absent(peers.Peer):
    name, module, package = "absent", "no_such_module", "no-such-package==1"


class Broken:
    name = "broken"

    def ground(self, cloud):
        raise RuntimeError("no licence")


@pytest.mark.long
def test_the_whole_benchmark_writes_the_page(folder, capsys, monkeypatch):
    monkeypatch.setattr(accuracy, "DENSE_TILE", "")  # for time's sake
    kinds = {name: KINDS[name] for name in ("drone_50", "dense_canopy")}
    monkeypatch.setattr(accuracy, "KINDS", kinds)
    hard = make("hillside_village", 1, size=70.0, density=1.0)
    write_labelled(folder / "data" / "isprs" / "samp52.laz", hard.points, hard.ground)
    accuracy.main(["--write", "--isprs", "--real", "--peers", "--scenes", "--sensitivity"])
    printed = capsys.readouterr().out
    page = "".join((folder / f"{name}.md").read_text("utf-8") for name in ("accuracy", "scenes"))
    assert "no-such-package==1" in printed
    assert "no-such-package==1" in page
    for method in METHODS.values():
        assert f"**{method.label}**" in printed
        assert f"### {method.label}" in page
        for declaration in method.parameters.declarations():
            moved = declaration.kind in ("number", "numbers") and declaration.default != 0
            assert not moved or f"| {declaration.label} " in page
    assert "| lowest " in page
    assert "PDAL SMRF (quoted)" in page
    assert "$" not in page
    assert "(rules.md)" in page
    assert "| drone_50 " in page and "tuning: I" in page
    assert re.search(r"\*\*Slope filter\*\*.* \d+\.\d\d \(\d+\.\d to \d+\.\d\)", page)
    pictures = "accuracy-worst-1.png", "accuracy-relief-ahn3-urban.png", "accuracy-scene-2.png"
    for picture in pictures:
        assert f"(images/{picture})" in page
        assert (folder / "images" / picture).stat().st_size > 1000


@pytest.mark.long
def test_parts_print_what_was_asked_for(folder, capsys):
    accuracy.main(["--isprs", "--method", "slope"])
    printed = capsys.readouterr().out
    assert "Slope filter" in printed
    assert "Grid minimum" not in printed
    assert "lowest" not in printed
    assert "RMSE" not in printed
    accuracy.main(["--real", "--peers", "--method", "slope"])
    printed = capsys.readouterr().out
    assert "| lowest " in printed
    assert "RMSE" in printed
    assert "Kappa" not in printed
    assert not (folder / "accuracy.md").exists()


def test_page_is_of_all_methods(folder, capsys):
    with pytest.raises(SystemExit):
        accuracy.main(["--write", "--method", "slope"])
    assert "is about all methods" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        accuracy.main(["--write", "--real"])
    assert "--isprs --real or --scenes --sensitivity" in capsys.readouterr().err


def test_no_data_is_said(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(data, "FOLDER", tmp_path)
    with pytest.raises(SystemExit) as stopped:
        accuracy.main([])
    assert stopped.value.code == 1
    assert "no labelled data" in capsys.readouterr().err


def test_a_filter_that_fails_is_told_and_does_not_end_it(folder):
    tile = data.REAL[0]
    results = {tile.title: measure.score_tile([Broken()], tile, *data.load(data.real(tile.name)))}
    assert tables.problems(results) == ["broken on ahn3_urban: RuntimeError: no licence"]
    assert "failed" in "\n".join(tables.labels(results) + tables.dtm(results, "RMSE", "rmse", 3))


def test_peers_are_asked_once(folder):
    cloud, _ = data.load(data.isprs()[0])
    peer = peers.PEERS[0]
    first, second = peer.ground(cloud), peer.ground(cloud)
    assert peer.calls == 1
    np.testing.assert_array_equal(first, second)
    cloud.z[0] += 1
    peer.ground(cloud)
    assert peer.calls == 2


def test_las_for_peers_holds_the_same_points(folder):
    cloud, _ = data.load(data.isprs()[0])
    cloud.number_of_returns[:] = 3
    peers.write_las(cloud, folder / "out.las")
    copy = read_cloud(folder / "out.las")
    for name in ("x", "y", "z", "return_number", "number_of_returns", "classification"):
        np.testing.assert_array_equal(getattr(copy, name), getattr(cloud, name))
    assert (copy.scale, copy.offset) == (cloud.scale, cloud.offset)


def test_terrain_model_of_the_reference_has_no_error(folder):
    cloud, reference = data.load(data.isprs()[0])
    model = measure.ReferenceModel(cloud, reference)
    error = model.error(reference == 2)
    assert error[:5] == (0.0, 0.0, 0.0, 0.0, 0.0)
    assert error.spikes == error.pits == (0, 0.0) and error.seen == "0 / 0"
    half = (reference == 2) & (cloud.x < np.median(cloud.x))
    assert 40.0 < model.error(half).bare < 60.0


def test_spikes_and_pits_are_places_of_three_cells_more_than_a_metre_off():
    difference = np.zeros((20, 30))
    difference[2:4, 2:4] = 1.5  # a spike of 4 cells
    difference[10, 10], difference[11, 11], difference[12, 12] = 2.0, 3.0, 1.2  # corner to corner
    difference[15, 3:5] = 4.0  # too small
    difference[5:8, 20:25] = 0.9  # too low
    difference[16:18, 20:23] = -7.0
    difference[0, :] = np.nan
    found = places.places_off(difference)
    assert [(place.height, place.cells) for place in found] == [(-7.0, 6), (3.0, 3), (1.5, 4)]
    assert places.counted(found) == ((2, 3.0), (1, 7.0))


@pytest.mark.rest
def test_each_spike_is_drawn_with_the_rule_that_decided(folder, capsys):
    # A mound that the reference leaves out is a spike of ours.
    x, y = np.random.default_rng(1).uniform(0, 60, (2, 8000))
    away = np.hypot(x - 30, y - 30)
    mound = np.clip(3.0 - away / 4.0, 0.0, None)
    write_labelled(folder / "data/real/ahn3_urban.laz", (x, y, 50.0 + mound), mound < 0.1)
    spikes.main(["--tile", "ahn3_urban", "--folder", str(folder / "pictures")])
    (line,) = capsys.readouterr().out.splitlines()
    (picture,) = (folder / "pictures").iterdir()
    stem, _, told = line.partition(": ")
    assert stem.startswith("ahn3_urban-spike-01-") and picture.name == f"{stem}.png"
    assert (
        stem[20:]
        in METHODS["tin-densification"]
        .pipeline(Points(*np.eye(3)), METHODS["tin-densification"].parameters(), SILENT)
        .names
    )
    assert float(told.split()[0]) == pytest.approx(3.0, abs=0.3) and "(30, 30)" in told


def test_classes_left_out_do_not_count(folder):
    cloud, reference = data.load(data.isprs()[0])
    reference[reference != 2] = 26
    tile = data.RealTile("any.laz", True, (26,))
    score = measure.score_tile([Everything()], tile, cloud, reference)["everything"]
    assert score.assessment.total_error == 0.0
    assert score.shares == {26: 100.0}


class Everything:
    name = "everything"

    def ground(self, cloud):
        return np.ones(cloud.count, dtype=bool)


@pytest.mark.parametrize(
    ("kind", "value", "factor", "expected"),
    [
        ("number", 4.0, 2.0, (8.0, False)),
        ("number", 6.0, 2.0, (10.0, True)),
        ("number", 1.5, 0.5, (1.0, True)),
        ("integer", 5, 0.5, (2, False)),
        ("numbers", (5.0, 4.0, 2.0), 0.5, ((2.5, 2.0, 1.0), False)),
        ("numbers", (6.0, 2.0), 2.0, ((10.0, 4.0), True)),
    ],
)
def test_scaling_respects_kind_and_limits(kind, value, factor, expected):
    declaration = Declaration("a", kind, value, "A", "", minimum=1.0, maximum=10.0)
    assert scaled(declaration, value, factor) == expected


@pytest.mark.long
def test_sensitivity_moves_defaults_that_are_chosen(folder):
    cloud, reference = data.load(data.isprs()[0])
    rows = sensitivity(["slope"], {"here": Place(tuple(data.isprs()))})["slope"]["here"]
    radius = next(row for row in rows if row.declaration.name == "search_radius")
    assert radius.defaults == ("18",)
    assert [change.values for change in radius.changes] == [("9",), ("36",)]
    expected = compare(Filter("slope", search_radius=9.0).ground(cloud), reference)
    assert radius.changes[0].total_error == expected.total_error
    assert "18 m, chosen" in "\n".join(tables.sensitivity(rows))
    assert "min_neighbours" not in [row.declaration.name for row in rows]


@pytest.mark.rest
def test_error_map_shows_both_errors(folder):
    from matplotlib.image import imread

    cloud, reference = data.load(data.isprs()[0])
    ground = np.where(np.arange(cloud.count) % 2 == 0, reference != 2, reference == 2)
    target = folder / "map.png"
    maps.error_map(cloud, ground, reference, compare(ground, reference), "a", target)
    red, _, blue = imread(target)[..., :3].transpose(2, 0, 1)
    assert np.count_nonzero(red - blue > 0.5) > 1000
    assert np.count_nonzero(blue - red > 0.5) > 1000
