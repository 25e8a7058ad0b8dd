"""What a person answers about places: right and skip change nothing, ground is continued."""

import json

import laspy
import numpy as np
import pytest
from runs import Heard
from surveys import ORIGIN, classes_of, cut, finished, points_of, write

from bare_earth import BareEarthError, classify

# A bank that the filter takes off, a house on it, and trees beside it.
BANK, HOUSE, TREES = (60.0, 30.0, 72.0, 70.0), (62.0, 40.0, 69.0, 50.0), (100.0, 40.0, 112.0, 60.0)
PLACE = (58.0, 28.0, 74.0, 72.0)
HOW = {"method": "grid-minimum", "preset": "paper"}


def _within(box, x, y):
    return (x > box[0]) & (x < box[2]) & (y > box[1]) & (y < box[3])


@pytest.fixture(scope="module")
def integers():
    """Return level land with a terrace of 4 m that a slope of 40 degrees leads onto, and a house
    of 5 m on it.
    """
    random, count = np.random.default_rng(5), 30_000
    x, y = random.uniform(0, 160, count), random.uniform(0, 100, count)
    beside = np.minimum(np.minimum(x - BANK[0], BANK[2] - x), np.minimum(y - BANK[1], BANK[3] - y))
    z = 60 + random.normal(0, 0.02, count) + np.clip(0.8 * (beside + 1.0), 0.0, 4.0)
    z[_within(HOUSE, x, y)] += 5.0
    trees = _within(TREES, x, y) & (random.random(count) < 0.8)
    z[trees] += random.uniform(2, 9, trees.sum())
    return np.round(np.column_stack((x, y, z)) * 100).astype(np.int64)


@pytest.fixture
def cloud(integers, tmp_path):
    return write(tmp_path / "cloud.laz", integers)


def _answers(path, *features):
    """Write boxes with their properties."""
    content = []
    for (west, south, east, north), properties in features:
        corners = [(west, south), (east, south), (east, north), (west, north), (west, south)]
        ring = [[x + ORIGIN[0], y + ORIGIN[1]] for x, y in corners]
        shape = {"type": "Polygon", "coordinates": [ring]}
        content.append({"type": "Feature", "properties": properties, "geometry": shape})
    path.write_text(json.dumps({"type": "FeatureCollection", "features": content}))
    return path


def _ground(path, box):
    las = laspy.read(path)
    inside = _within(box, np.asarray(las.x) - ORIGIN[0], np.asarray(las.y) - ORIGIN[1])
    return np.asarray(las.classification)[inside] == 2


@pytest.mark.rest
def test_right_and_skip_change_nothing(cloud, tmp_path):
    plain, answered = tmp_path / "plain.laz", tmp_path / "answered.laz"
    classify(cloud, plain, **HOW)
    answers = _answers(
        tmp_path / "a.geojson", (PLACE, {"answer": "right"}), (TREES, {"answer": "Skip"}),
        (PLACE, {"answer": None, "class": None}),
    )  # fmt: skip
    heard = Heard()
    classify(cloud, answered, corrections=answers, progress=heard, **HOW)
    np.testing.assert_array_equal(classes_of(answered), classes_of(plain))
    assert not any("answer" in text for text in heard.warnings)
    assert any("1 polygon of the corrections" in text for text in heard.infos)


@pytest.mark.rest
def test_ground_continues_the_ground_and_takes_no_roof(cloud, tmp_path):
    plain, answered = tmp_path / "plain.laz", tmp_path / "answered.laz"
    classify(cloud, plain, **HOW)
    answers = _answers(tmp_path / "a.geojson", (PLACE, {"answer": "ground"}))
    heard = Heard()
    classify(cloud, answered, corrections=answers, progress=heard, **HOW)
    terrace = (61.0, 52.0, 71.0, 69.0)
    assert _ground(plain, terrace).mean() < 0.3  # so that the answer is needed
    assert _ground(answered, terrace).mean() > 0.6
    assert not _ground(answered, (63.0, 41.0, 68.0, 49.0)).any()
    assert any("the answer 'ground'" in text for text in heard.infos)


@pytest.mark.rest
def test_an_answer_is_the_same_in_tiles_and_from_disk(integers, cloud, tmp_path):
    whole, disk, tiles = tmp_path / "whole.laz", tmp_path / "disk.laz", tmp_path / "tiles"
    how = {**HOW, "corrections": _answers(tmp_path / "a.geojson", (PLACE, {"answer": "ground"}))}
    classify(cloud, whole, **how)
    classify(cloud, disk, threads=2, memory=0.001, **how)
    np.testing.assert_array_equal(classes_of(disk), classes_of(whole))
    classify([cut(tmp_path / "in", integers, 6)], tiles, **how)
    np.testing.assert_array_equal(points_of(finished(tiles)), points_of([whole]))


def test_ground_where_nothing_continues_it_is_told(cloud, tmp_path):
    answers = _answers(tmp_path / "a.geojson", ((63.0, 41.0, 68.0, 49.0), {"answer": "ground"}))
    heard = Heard()
    classify(cloud, tmp_path / "o.laz", corrections=answers, progress=heard, **HOW)
    assert any("changes nothing" in text and "class 2" in text for text in heard.warnings)
    assert not _ground(tmp_path / "o.laz", (63.0, 41.0, 68.0, 49.0)).any()


def test_not_ground_demotes_and_keeps_classes_that_are_not_decided(integers, tmp_path):
    x, y = integers[:, 0] / 100, integers[:, 1] / 100
    classes = np.where(_within(TREES, x, y) & (x < 106), 14, 1)  # wires
    cloud = write(tmp_path / "c.laz", integers, classes=classes)
    answers = _answers(tmp_path / "a.geojson", (TREES, {"answer": "not ground", "class": 2}))
    classify(cloud, tmp_path / "o.laz", corrections=answers, **HOW)
    found = classes_of(tmp_path / "o.laz")[_within(TREES, x, y)]
    assert set(found.tolist()) == {1, 14}


def test_class_2_that_lifts_the_terrain_over_the_expected_error_is_told(cloud, tmp_path):
    roof = {"class": 2, "HIGH": 64.1, "ERROR": 0.36, "RANK": 3}
    low = {"class": 2, "HIGH": 60.1, "ERROR": 0.36, "RANK": 4}
    answers = _answers(tmp_path / "a.geojson", (HOUSE, roof), ((20.0, 20.0, 30.0, 30.0), low))
    heard = Heard()
    classify(cloud, tmp_path / "o.laz", corrections=answers, progress=heard, **HOW)
    (told,) = (text for text in heard.warnings if text.startswith("Place "))
    assert told.startswith("Place 3: ") and "by 4.9 m" in told and "error is 0.36 m" in told


@pytest.mark.parametrize(
    ("properties", "words"),
    [
        ({"answer": "maybe"}, "right, not ground, ground, skip, not maybe"),
        ({"kind": 2}, "'class' or 'answer'; .* kind"),
        ({"class": None}, "a class or an answer"),
    ],
)
def test_what_cannot_be_an_answer_is_refused(properties, words, cloud, tmp_path):
    answers = _answers(tmp_path / "a.geojson", (HOUSE, properties))
    with pytest.raises(BareEarthError, match=words):
        classify(cloud, tmp_path / "o.laz", corrections=answers, **HOW)


def test_attributes_are_found_in_any_case(cloud, tmp_path):
    answers = _answers(tmp_path / "a.geojson", (HOUSE, {"CLASS": "6"}))
    classify(cloud, tmp_path / "o.laz", corrections=answers, **HOW)
    las = laspy.read(tmp_path / "o.laz")
    inside = _within(HOUSE, np.asarray(las.x) - ORIGIN[0], np.asarray(las.y) - ORIGIN[1])
    assert set(np.asarray(las.classification)[inside].tolist()) == {6}


def test_each_feature_may_write_its_attributes_in_another_case(cloud, tmp_path):
    features = (PLACE, {"ANSWER": "right"}), (HOUSE, {"Class": 6}), (TREES, {"class": 5})
    answers = _answers(tmp_path / "a.geojson", *features)
    classify(cloud, tmp_path / "o.laz", corrections=answers, **HOW)
    las = laspy.read(tmp_path / "o.laz")
    for box, code in ((HOUSE, 6), (TREES, 5)):
        inside = _within(box, np.asarray(las.x) - ORIGIN[0], np.asarray(las.y) - ORIGIN[1])
        assert set(np.asarray(las.classification)[inside].tolist()) == {code}
