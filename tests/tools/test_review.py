"""Places to review: where the expected error is large, why, and without what has an answer."""

import json

import laspy
import numpy as np
import pytest
from surveys import write_points

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.rasters import content, windows
from bare_earth.algorithms.report.units import Units
from bare_earth.algorithms.tools.review.places import Rasters, Review, places_of

pyogrio = pytest.importorskip("pyogrio")
pytest.importorskip("shapely")
GAP = (40.0, 70.0)


@pytest.fixture(scope="module")
def rasters(tmp_path_factory):
    """Return the rasters of level land of 100 m with a gap of 30 m in its ground, below trees."""
    folder = tmp_path_factory.mktemp("review")
    random = np.random.default_rng(7)
    x, y = random.uniform(0, 100, (2, 30_000))
    gap = (x > GAP[0]) & (x < GAP[1]) & (y > GAP[0]) & (y < GAP[1])
    z = 50.0 + random.normal(0, 0.02, len(x)) + np.where(gap, 9.0, 0.0)
    classes = np.where(gap, 5, 2)
    write_points(folder / "in.laz", x, y, z, classes, offset=(500_000.0, 5_600_000.0, 0.0))
    paths = {name: folder / f"{name}.tif" for name in ("dtm", "expected_error", "error_cause")}
    bare_earth.terrain(folder / "in.laz", crs=25832, dtm_cell_size=1.0, **paths)
    return folder


def reviewed(folder, **values):
    """Return the places of a review, as a GeoDataFrame, and its summary."""
    places = folder / "places.gpkg"
    summary = bare_earth.review(
        folder / "expected_error.tif", places, dtm=folder / "dtm.tif",
        cause=folder / "error_cause.tif", **values,
    )  # fmt: skip
    return pyogrio.read_dataframe(places), summary


def test_the_first_place_is_the_gap_with_its_reason_and_its_page(rasters):
    page = rasters / "page.html"
    found, summary = reviewed(rasters, page=page)
    first = found.iloc[0]
    assert list(found.RANK) == list(range(1, len(found) + 1))
    assert found["class"].isna().all() and found.answer.isna().all()
    # The line of the profile goes through the gap.
    assert abs((first.X1 + first.X2) / 2 - 500_055) < 16
    assert np.hypot(first.X2 - first.X1, first.Y2 - first.Y1) > 30
    shown = found[["LOW", "HIGH", "ERROR", "X1", "Y2"]].to_numpy()
    np.testing.assert_array_equal(shown, shown.round(2))
    assert "gap" in first.REASON or "hardly any ground" in first.REASON
    middle = first.geometry.centroid
    assert abs(middle.x - 500_055) < 5 and abs(middle.y - 5_600_055) < 5
    assert found.crs.to_epsg() == 25832
    assert 49.8 < first.LOW <= first.HIGH < 50.3
    assert summary.place_count == len(found) and 0.02 < summary.expected_rmse < 1.0
    text = page.read_text(encoding="utf-8")
    assert first.REASON in text and "<svg" in text and "nothing was measured" in text
    assert "http://" not in text.replace("http://www.w3.org", "")


def test_few_places_are_written_and_the_others_counted(rasters):
    found, summary = reviewed(rasters, least_error=0.11, least_area=1.0, most_places=1)
    assert len(found) == summary.place_count == 1
    assert summary.left_out > 0 and f"{summary.left_out:,} place" in summary.text
    assert found.SHARE[0] < 1.0


def test_answers_are_left_out_and_become_corrections(rasters, tmp_path, capsys):
    found, summary = reviewed(rasters)
    found.loc[0, "class"] = 5
    answered = tmp_path / "answered.gpkg"
    pyogrio.write_dataframe(found, answered)
    left, again = reviewed(rasters, corrections=answered)
    assert (again.answered, again.carried) == (1, 1)
    assert again.place_count == summary.place_count - 1 and len(left) == summary.place_count
    # Those without a class correct nothing.
    words = ["classify", rasters / "in.laz", tmp_path / "out.laz", "--crs", "EPSG:25832"]
    words += ["--method", "slope", "--corrections", answered, "--verbose"]
    assert main([str(word) for word in words]) == 0
    assert "1 polygon of the corrections" in capsys.readouterr().err
    inside = laspy.read(tmp_path / "out.laz")
    x, y = np.asarray(inside.x) - 500_000, np.asarray(inside.y) - 5_600_000
    middle = (np.abs(x - 55) < 10) & (np.abs(y - 55) < 10)
    assert (inside.classification[middle] == 5).all()


def test_corrections_of_which_none_has_a_class_are_refused(rasters, tmp_path):
    reviewed(rasters)
    with pytest.raises(BareEarthError, match="a class or an answer"):
        bare_earth.classify(
            rasters / "in.laz", tmp_path / "out.laz", crs=25832,
            corrections=rasters / "places.gpkg",
        )  # fmt: skip


def test_rasters_of_two_runs_are_refused(rasters, tmp_path):
    bare_earth.terrain(rasters / "in.laz", crs=25832, dtm_cell_size=2.0, dtm=tmp_path / "dtm.tif")
    with pytest.raises(BareEarthError, match="other cells"):
        bare_earth.review(
            rasters / "expected_error.tif", tmp_path / "p.gpkg", dtm=tmp_path / "dtm.tif"
        )
    assert not (tmp_path / "p.gpkg").exists()


def test_a_raster_that_holds_no_causes_is_refused(rasters, tmp_path):
    with pytest.raises(BareEarthError, match="no causes"):
        bare_earth.review(
            rasters / "expected_error.tif", tmp_path / "p.gpkg", cause=rasters / "dtm.tif"
        )


def test_a_place_inside_of_another_is_its_hole():
    error = np.full((40, 40), 0.1, dtype=np.float32)
    error[2:38, 2:38] = 1.0
    error[4:36, 4:36] = 0.1
    error[10:30, 10:30] = 2.0
    rasters = Rasters(error, None, None, 1.0)
    error[0, 0] = 0.9
    found, small = places_of(rasters, Review(), 0.5, Units())
    assert small == 1  # 1 m2, and the least is 4
    assert [place.error for place in found] == [2.0, 1.0]
    assert [len(place.rings) for place in found] == [1, 2]


def test_the_command_without_a_terrain_model_or_causes(rasters, tmp_path, capsys):
    places = tmp_path / "places.geojson"
    page = tmp_path / "page.html"
    arguments = [str(rasters / "expected_error.tif"), str(places), "--page", str(page), "--json"]
    assert main(["review", *arguments]) == 0
    told = json.loads(capsys.readouterr().out)
    content = json.loads(places.read_text(encoding="utf-8"))
    assert len(content["features"]) == told["place_count"] > 0
    assert content["features"][0]["properties"]["LOW"] is None
    assert "Without a terrain model" in page.read_text(encoding="utf-8")


@pytest.mark.parametrize("least", [0.5, None])
def test_last_bits_of_errors_decide_nothing(least):
    # Two places of equal weight, each of two causes of equal weight, and many cells at the limit,
    # which is that of the user or the error that 95 of 100 cells do not exceed.
    error = np.full((40, 40), 0.2, np.float32)
    error[12:18] = error[28:] = 0.5
    error[2:8, 2:8] = error[20:26, 20:26] = 0.9
    cause = np.where(np.arange(40) % 2 == 0, 2, 3) * np.ones((40, 1))
    how, units = Review(least_error=least), Units(1.0, 1.0)

    def found(values):
        rasters = Rasters(values.astype(np.float32), None, cause, 1.0)
        places, _ = places_of(rasters, how, how.limit(rasters.error), units)
        return [(place.worst, place.reason, int(place.cells.sum())) for place in places]

    expected = found(error)
    assert [place[0] for place in expected] == [(2, 2), (20, 20)]
    for seed in range(5):
        random = np.random.default_rng(seed)
        assert found(error * (1.0 + random.uniform(-2e-7, 2e-7, error.shape))) == expected


@pytest.mark.rest
def test_answers_of_all_rounds_are_in_the_newest_layer(rasters, tmp_path):
    how = {"least_error": 0.1, "least_area": 0.0}
    first, _ = reviewed(rasters, **how)
    assert len(first) > 3
    first.loc[0, "answer"], first.loc[1, "answer"], first.loc[2, "class"] = "right", "skip", 1
    answered = tmp_path / "one.gpkg"
    pyogrio.write_dataframe(first, answered)
    second, summary = reviewed(rasters, corrections=answered, **how)
    assert (summary.answered, summary.carried) == (2, 2)
    assert summary.place_count == len(first) - 2 and len(second) == len(first)
    new, old = second.iloc[: summary.place_count], second.iloc[summary.place_count :]
    # The skipped place comes last, and has no answer yet.
    assert new.answer.isna().all() and new.iloc[-1].geometry.equals(first.geometry[1])
    assert old.answer.fillna("").tolist() == ["right", ""] and old["class"].tolist()[1] == 1
    assert list(second.RANK) == list(range(1, len(second) + 1))
    for column in ("REASON", "ERROR", "AREA", "LOW", "HIGH", "X1", "Y1", "X2", "Y2"):
        assert old[column].tolist() == first[column][[0, 2]].tolist()
    assert all(a.equals(b) for a, b in zip(old.geometry, first.geometry[[0, 2]]))
    # The next round needs only the newest layer.
    second.loc[0, "answer"] = "not ground"
    newest = tmp_path / "two.gpkg"
    pyogrio.write_dataframe(second, newest)
    third, summary = reviewed(rasters, corrections=newest, **how)
    assert summary.carried == 3
    assert sorted(map(str, third.answer.dropna())) == ["not ground", "right"]


def test_the_page_shows_points_in_their_classes_with_axes(rasters, tmp_path):
    page, plain = tmp_path / "page.html", tmp_path / "plain.html"
    reviewed(rasters, page=plain)
    reviewed(rasters, page=page, points=rasters / "in.laz")
    text = page.read_text(encoding="utf-8")
    for words in ("high vegetation", "ground", "along the line, m", "height, m", "the line of the"):
        assert words in text, words
    assert "high vegetation" not in plain.read_text(encoding="utf-8")
    # The trees over the gap are 9 m above the ground, so the axis goes beyond them.
    assert ">55</text>" in text and ">55</text>" not in plain.read_text(encoding="utf-8")


@pytest.mark.rest
def test_what_answers_changed_is_told_for_all_and_for_each_place(rasters, tmp_path):
    found, _ = reviewed(rasters)
    found.loc[0, "class"] = 2
    answered, page = tmp_path / "answered.gpkg", tmp_path / "page.html"
    pyogrio.write_dataframe(found.iloc[:1], answered)
    new = {name: tmp_path / f"{name}.tif" for name in ("dtm", "expected_error")}
    bare_earth.classify(
        rasters / "in.laz", tmp_path / "out.laz", crs=25832, dtm_cell_size=1.0,
        corrections=answered, **new,
    )  # fmt: skip
    summary = bare_earth.review(
        new["expected_error"], tmp_path / "p.gpkg", dtm=new["dtm"], earlier=rasters / "dtm.tif",
        corrections=answered, page=page,
    )  # fmt: skip
    assert "changed in" in summary.text and "+9.0" in summary.text
    text = page.read_text(encoding="utf-8")
    assert "What your answers changed" in text and "place 1" in text and "class 2" in text
    same = bare_earth.review(
        rasters / "expected_error.tif", tmp_path / "q.gpkg", dtm=rasters / "dtm.tif",
        earlier=rasters / "dtm.tif",
    )  # fmt: skip
    assert "same as in the run before" in same.text


@pytest.mark.rest
def test_one_run_classifies_and_makes_the_places_with_carried_answers(rasters, tmp_path):
    places, again = tmp_path / "places.gpkg", tmp_path / "again.gpkg"
    how = {"crs": 25832, "dtm_cell_size": 1.0}
    bare_earth.classify(rasters / "in.laz", tmp_path / "a.laz", places=places, **how)
    found = pyogrio.read_dataframe(places)
    assert len(found) and "a large expected error" not in " ".join(found.REASON)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.laz", "places.gpkg"]
    found.loc[0, "answer"] = "right"
    pyogrio.write_dataframe(found, places)
    dtm = tmp_path / "dtm.tif"
    bare_earth.classify(
        rasters / "in.laz", tmp_path / "b.laz", places=again, dtm=dtm, corrections=places, **how
    )
    assert dtm.exists()
    assert pyogrio.read_dataframe(again).answer.dropna().tolist() == ["right"]
    bare_earth.terrain(tmp_path / "b.laz", places=tmp_path / "t.geojson", **how)
    content = json.loads((tmp_path / "t.geojson").read_text(encoding="utf-8"))
    assert len(content["features"]) == len(found)


@pytest.mark.rest
def test_rasters_that_do_not_fit_into_memory_are_read_in_parts(rasters, tmp_path, monkeypatch):
    def made(name):
        files = [tmp_path / f"{name}{ending}" for ending in (".geojson", ".html")]
        summary = bare_earth.review(
            rasters / "expected_error.tif", files[0], page=files[1], dtm=rasters / "dtm.tif",
            cause=rasters / "error_cause.tif", earlier=rasters / "dtm.tif",
            least_area=1.0,
        )  # fmt: skip
        return summary, [file.read_text(encoding="utf-8") for file in files]

    summary, whole = made("whole")
    monkeypatch.setattr(content, "MOST_CELLS", 5000)
    monkeypatch.setattr(windows, "_CELLS", 1500)
    in_parts, parts = made("parts")
    assert in_parts == summary and parts == whole
    assert summary.place_count > 2 and "same as in the run before" in summary.text
