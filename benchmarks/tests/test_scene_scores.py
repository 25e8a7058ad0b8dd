"""Scores on generated scenes, and the phases in which the samples are measured."""

import numpy as np
import pytest

from benchmarks import accuracy, cache, generated, tables, work
from benchmarks.measure import Filter
from benchmarks.phases import PHASES, Phased, over_samples, shifted
from benchmarks.scenes import make


@pytest.fixture(scope="module")
def hall():
    return make("hall_flat", seed=1, density=1.0)


@pytest.mark.rest
def test_the_truth_has_no_error(hall):
    score = generated.score_scene(hall, hall.ground)
    assert (score.type_1, score.type_2, score.share_wrong_1m) == (0.0, 0.0, 0.0)
    assert score.dtm_rmse < 0.1
    assert all(share == 0.0 for share in score.kept.values())


@pytest.mark.rest
def test_a_roof_that_is_kept_is_seen_in_every_figure_but_type_1(hall):
    roof = hall.classes == 6
    score = generated.score_scene(hall, hall.ground | roof)
    others = ~hall.ground & (hall.classes != 9)
    assert score.type_1 == 0.0
    assert score.type_2 == pytest.approx(100.0 * roof.sum() / others.sum())
    assert score.kept[6] == 100.0 and score.kept[5] == 0.0
    share = 100.0 * roof.sum() / len(roof)
    assert score.share_wrong_1m == pytest.approx(share, rel=0.25)
    height = hall.settings.height
    assert score.dtm_rmse == pytest.approx(height * np.sqrt(share / 100.0), rel=0.25)


@pytest.mark.rest
def test_ground_that_is_missed_is_type_1_and_cells_without_height_are_wrong(hall):
    west = hall.points.x < np.median(hall.points.x)
    score = generated.score_scene(hall, hall.ground & west)
    assert score.type_1 == pytest.approx(50.0, abs=5.0)
    assert score.type_2 == 0.0
    assert 35.0 < score.share_wrong_1m < 65.0
    nothing = generated.score_scene(hall, np.zeros(hall.points.count, dtype=bool))
    assert nothing.type_1 == nothing.share_wrong_1m == 100.0
    assert np.isnan(nothing.dtm_rmse)


def test_points_on_water_do_not_count():
    scene = make("bridge_over_river", seed=1)
    water = scene.classes == 9
    assert water.sum() > 100
    score = generated.score_scene(scene, scene.ground | water, with_dtm=False)
    assert (score.type_1, score.type_2) == (0.0, 0.0)
    assert np.isnan(score.dtm_rmse)


@pytest.mark.rest
def test_a_scene_is_remembered_whole(tmp_path, monkeypatch):
    monkeypatch.setattr(cache, "FOLDER", tmp_path)
    first, model = generated.remembered_scene("drone_50", 3)
    again, same = generated.remembered_scene("drone_50", 3)
    assert len(list(tmp_path.rglob("drone_50-3-*.npz"))) == 1
    for one, loaded in zip((*first.points, first.classes), (*again.points, again.classes)):
        np.testing.assert_array_equal(one, loaded)
    for one, loaded in zip(model, same):
        np.testing.assert_array_equal(one, loaded)
    x, y = first.points.x[:50], first.points.y[:50]
    np.testing.assert_array_equal(first.terrain(x, y), again.terrain(x, y))
    one, loaded = first.cloud(), again.cloud()
    for name in ("x", "y", "z", "return_number", "number_of_returns"):
        np.testing.assert_array_equal(getattr(one, name), getattr(loaded, name))


@pytest.mark.long
def test_scenes_are_told_from_the_command_line(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(cache, "FOLDER", tmp_path)
    monkeypatch.setattr(work, "PROCESSES", 1)
    accuracy.main(["--scenes", "--method", "tin", "--seeds", "tuning", "--kinds", "drone_50"])
    printed = capsys.readouterr().out
    assert "TIN densification, tuning seeds" in printed
    assert "| drone_50 " in printed and "| village " not in printed
    assert "Slope" not in printed
    scores = generated.score_scenes([Filter("tin-densification")], (0, 2), ["drone_50"])
    mean = generated.mean(scores["tin-densification"]["drone_50"], "type_1")
    assert f" {mean:.2f} |" in printed


def test_a_method_is_found_by_how_its_name_begins(capsys):
    with pytest.raises(SystemExit):
        accuracy.main(["--scenes", "--method", "no-such"])
    assert "tin-densification" in capsys.readouterr().err


def test_phases_are_many_and_spread_over_the_cell():
    assert len(PHASES) >= 8 and PHASES[0] == (0.0, 0.0)
    places = np.array(PHASES)
    assert ((places >= 0) & (places < 1)).all()
    apart = np.abs(places[:, None] - places[None])
    apart = np.hypot(*np.minimum(apart, 1 - apart).transpose(2, 0, 1))
    assert apart[~np.eye(len(places), dtype=bool)].min() > 0.15


@pytest.mark.rest
def test_a_shift_moves_the_points_against_the_cells_and_nothing_else():
    cloud = make("village", seed=1, density=1.0, size=100.0).cloud()
    moved = shifted(cloud, 0.26, 0.71)
    for name in ("x", "y", "z", "scale", "return_number"):
        np.testing.assert_array_equal(getattr(cloud, name), getattr(moved, name))
    frame = cloud.frame
    assert moved.frame == frame  # where cells begin does not move along
    still, displaced = (some.points(slice(None), frame) for some in (cloud, moved))
    for one, two, by in zip(still, displaced, (0.26, 0.71, 0.0)):
        np.testing.assert_allclose(two - one, by, atol=1e-6)
    ground = [Filter("grid-minimum").ground(some) for some in (cloud, moved)]
    assert 0 < np.count_nonzero(ground[0] != ground[1]) < 0.2 * cloud.count


def test_ranges_are_those_of_the_phases():
    class Fake:
        def __init__(self, total):
            self.total_error = total

    one, two = Phased((Fake(1.0), Fake(3.0))), Phased((Fake(2.0), Fake(6.0)))
    assert one.total_error == 2.0
    assert one.range("total_error") == (2.0, 1.0, 3.0)
    assert over_samples({"a": one, "b": two}, "total_error") == (3.0, 1.5, 4.5)
    assert tables.ranged(one.range("total_error")) == "2.00 (1.0 to 3.0)"
    assert tables.ranged(Phased((Fake(2.5),)).range("total_error")) == "2.50"
